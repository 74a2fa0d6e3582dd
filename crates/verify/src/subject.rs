//! What can be tried: [`Subject`].

use std::fmt::Debug;

use sparrow_models::{About, FibreKind, ModelKind, ParamBlock, ParamInfo, SurfaceKind};

use crate::column::{Batch, Column, Scalar, narrow};

/// Something with the contract of a model. Every registered model is one.
pub trait Subject: Debug + Sync {
    /// Its name.
    fn name(&self) -> &'static str;
    /// Its parameter table.
    fn params(&self) -> &'static [ParamInfo];
    /// What it is and lacks.
    fn about(&self) -> About;
    /// It is a fibre: inclinations are measured from the plane across x, and rays have an offset.
    fn is_fibre(&self) -> bool {
        false
    }
    /// The model with these parameters in every number type it can be had in; `f64` first.
    fn columns(&self, p: &ParamBlock<f64>) -> Vec<Box<dyn Column>>;
}

impl Subject for SurfaceKind {
    fn name(&self) -> &'static str {
        SurfaceKind::name(*self)
    }
    fn params(&self) -> &'static [ParamInfo] {
        SurfaceKind::params(*self)
    }
    fn about(&self) -> About {
        SurfaceKind::about(*self)
    }
    fn columns(&self, p: &ParamBlock<f64>) -> Vec<Box<dyn Column>> {
        let single = narrow(p);
        vec![
            Box::new(Scalar::double(self.bind(p))),
            Box::new(Scalar::single(self.bind(&single))),
            Box::new(Batch::new(*self, single)),
        ]
    }
}

impl Subject for FibreKind {
    fn name(&self) -> &'static str {
        FibreKind::name(*self)
    }
    fn params(&self) -> &'static [ParamInfo] {
        FibreKind::params(*self)
    }
    fn about(&self) -> About {
        FibreKind::about(*self)
    }
    fn is_fibre(&self) -> bool {
        true
    }
    fn columns(&self, p: &ParamBlock<f64>) -> Vec<Box<dyn Column>> {
        let single = narrow(p);
        vec![
            Box::new(Scalar::double_of_fibre(self.bind(p))),
            Box::new(Scalar::single_of_fibre(self.bind(&single))),
            Box::new(Batch::new(*self, single)),
        ]
    }
}

/// Asks the table that the model is in.
macro_rules! ask {
    ($kind:expr, $k:ident => $answer:expr) => {
        match $kind {
            ModelKind::Surface($k) => $answer,
            ModelKind::Fibre($k) => $answer,
        }
    };
}

impl Subject for ModelKind {
    fn name(&self) -> &'static str {
        ModelKind::name(*self)
    }
    fn params(&self) -> &'static [ParamInfo] {
        ModelKind::params(*self)
    }
    fn about(&self) -> About {
        ModelKind::about(*self)
    }
    fn is_fibre(&self) -> bool {
        ask!(self, k => k.is_fibre())
    }
    fn columns(&self, p: &ParamBlock<f64>) -> Vec<Box<dyn Column>> {
        ask!(self, k => k.columns(p))
    }
}

//! What can be tried: [`Subject`].

use std::fmt::Debug;

use sparrow_models::{About, ParamBlock, ParamInfo, SurfaceKind};

use crate::column::{Batch, Column, Scalar, narrow};

/// Something with the contract of a model. Every registered model is one.
pub trait Subject: Debug + Sync {
    /// Its name.
    fn name(&self) -> &'static str;
    /// Its parameter table.
    fn params(&self) -> &'static [ParamInfo];
    /// What it is and lacks.
    fn about(&self) -> About;
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

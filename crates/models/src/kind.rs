//! Any registered model, of a surface or of a fibre: [`ModelKind`].

use crate::{About, FibreKind, ParamInfo, SurfaceKind};

/// Names a registered model of either table; no two have the same name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ModelKind {
    /// Of a surface.
    Surface(SurfaceKind),
    /// Of a fibre.
    Fibre(FibreKind),
}

impl ModelKind {
    /// Every registered model, surfaces first.
    pub fn all() -> impl Iterator<Item = ModelKind> + Clone {
        let surfaces = SurfaceKind::ALL.iter().map(|k| ModelKind::Surface(*k));
        surfaces.chain(FibreKind::ALL.iter().map(|k| ModelKind::Fibre(*k)))
    }
    /// The model of that name.
    pub fn from_name(name: &str) -> Option<ModelKind> {
        let surface = SurfaceKind::from_name(name).map(ModelKind::Surface);
        surface.or_else(|| FibreKind::from_name(name).map(ModelKind::Fibre))
    }
    /// The name in scenes and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            ModelKind::Surface(k) => k.name(),
            ModelKind::Fibre(k) => k.name(),
        }
    }
    /// The model's parameter table.
    pub fn params(self) -> &'static [ParamInfo] {
        match self {
            ModelKind::Surface(k) => k.params(),
            ModelKind::Fibre(k) => k.params(),
        }
    }
    /// What the model is and lacks.
    pub fn about(self) -> About {
        match self {
            ModelKind::Surface(k) => k.about(),
            ModelKind::Fibre(k) => k.about(),
        }
    }
}

impl From<SurfaceKind> for ModelKind {
    fn from(kind: SurfaceKind) -> ModelKind {
        ModelKind::Surface(kind)
    }
}
impl From<FibreKind> for ModelKind {
    fn from(kind: FibreKind) -> ModelKind {
        ModelKind::Fibre(kind)
    }
}

//! The macro that makes one table of models: the enum, its dispatch, the names and the constructor.

use crate::batch::{DirColumns, EvalColumns, ParamColumns, SampleColumns};
use crate::{ParamBlock, ParamInfo, ParamKind};

/// A property that reflection ought to have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// No more light leaves than arrived.
    Energy,
    /// Viewer and light may be exchanged.
    Reciprocity,
}

impl Property {
    /// The words in lists and reports.
    pub fn name(self) -> &'static str {
        match self {
            Property::Energy => "energy conservation",
            Property::Reciprocity => "reciprocity",
        }
    }
}

/// A property that a model lacks, and for which of its choices.
#[derive(Clone, Copy, Debug)]
pub struct Lack {
    /// What is missing.
    pub property: Property,
    /// Why.
    pub reason: &'static str,
    /// Parameters with those of their choices for which it is missing; all have to be met. Empty: always.
    pub when: &'static [(&'static str, &'static [&'static str])],
}

impl Lack {
    /// More light may leave than arrived, for this reason.
    pub const fn energy(reason: &'static str) -> Lack {
        Lack { property: Property::Energy, reason, when: &[] }
    }
    /// Viewer and light may not be exchanged, for this reason.
    pub const fn reciprocity(reason: &'static str) -> Lack {
        Lack { property: Property::Reciprocity, reason, when: &[] }
    }
    /// Only where every one of these parameters is at one of the choices named with it.
    pub const fn when(mut self, when: &'static [(&'static str, &'static [&'static str])]) -> Lack {
        self.when = when;
        self
    }
    /// The choices, in the order of `table`, are such that the property is missing.
    pub fn applies(&self, table: &[ParamInfo], choices: &[u8]) -> bool {
        self.when
            .iter()
            .all(|(param, of)| chosen(table, choices, param).is_some_and(|name| of.contains(&name)))
    }
}

/// The name that a choice of the table stands at.
fn chosen(table: &[ParamInfo], choices: &[u8], param: &str) -> Option<&'static str> {
    let all = table.iter().filter_map(|p| match p.kind {
        ParamKind::Choice(names) => Some((p.name, names)),
        ParamKind::Real | ParamKind::Albedo | ParamKind::Unbounded => None,
    });
    let ((_, names), place) = all.zip(choices).find(|((name, _), _)| *name == param)?;
    names.get(usize::from(*place)).copied()
}

/// What a model is, for lists, help and the verifier.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// One line.
    pub summary: &'static str,
    /// Where it comes from, as keys of `docs/references.bib`.
    pub sources: &'static str,
    /// What it lacks; the verifier shows these as known and everything else as a fault.
    pub lacks: &'static [Lack],
    /// The direction of the tangent matters.
    pub anisotropic: bool,
    /// Light passes to the other side.
    pub transmits: bool,
}

impl About {
    /// An opaque, isotropic model that lacks nothing.
    pub const fn new(summary: &'static str, sources: &'static str) -> About {
        About { summary, sources, lacks: &[], anisotropic: false, transmits: false }
    }
    /// The direction of the tangent matters.
    pub const fn anisotropic(mut self) -> About {
        self.anisotropic = true;
        self
    }
    /// Light passes to the other side.
    pub const fn transmits(mut self) -> About {
        self.transmits = true;
        self
    }
    /// Says what is missing, why, and for which choices.
    pub const fn lacks(mut self, lacks: &'static [Lack]) -> About {
        self.lacks = lacks;
        self
    }
}

/// What the registry asks of a model besides its contract.
pub trait Model<R>: Sized {
    /// What it is.
    const ABOUT: About;
    /// The parameters, in the order in which [`ParamBlock`] holds them.
    const PARAMS: &'static [ParamInfo];
    /// Binds the parameters. Values lie in the ranges of the table.
    fn new(params: &ParamBlock<R>) -> Self;
}

/// A table of models: what a `SurfaceKind` and a `FibreKind` can both do.
pub trait Kind: Copy + core::fmt::Debug + Send + Sync + 'static {
    /// Every registered model.
    const ALL: &'static [Self];
    /// The name in scenes and on the command line.
    fn name(self) -> &'static str;
    /// The model's parameter table.
    fn params(self) -> &'static [ParamInfo];
    /// What the model is and lacks.
    fn about(self) -> About;
    /// Values and densities at many points; see [`batch::f_cos_pdf`](crate::batch::f_cos_pdf).
    fn eval_columns(
        self,
        p: &ParamColumns<'_>,
        wo: &DirColumns<'_>,
        wi: &DirColumns<'_>,
        out: &mut EvalColumns<'_>,
    );
    /// Samples at many points; see [`batch::sample`](crate::batch::sample).
    fn sample_columns(
        self,
        p: &ParamColumns<'_>,
        wo: &DirColumns<'_>,
        u: &[&[f32]; 3],
        out: &mut SampleColumns<'_>,
    );
}

/// What a fibre answers besides: its value by lobes.
macro_rules! dispatch_lobes {
    ($Enum:ident, Bsdf, $R:ty: $($Variant:ident)*) => {};
    ($Enum:ident, Bcsdf, $R:ty: $($Variant:ident)*) => {
        fn lobes(
            &self,
            wo: sparrow_math::LocalDir<$R>,
            wi: sparrow_math::LocalDir<$R>,
        ) -> [sparrow_spectra::Spectrum<$R>; $crate::N_LOBES] {
            match self {
                $( $Enum::$Variant(m) => m.lobes(wo, wi), )*
            }
        }
    };
}
pub(crate) use dispatch_lobes;

/// The contract of the enum over one number type.
///
/// Not generic, so that it is compiled here once and not again in every crate that calls it.
macro_rules! dispatch {
    ($Enum:ident, $Trait:ident, $R:ty: $($Variant:ident)*) => {
        impl $crate::$Trait<$R> for $Enum<$R> {
            fn f_cos_pdf(
                &self,
                wo: sparrow_math::LocalDir<$R>,
                wi: sparrow_math::LocalDir<$R>,
            ) -> (sparrow_spectra::Spectrum<$R>, $R) {
                match self {
                    $( $Enum::$Variant(m) => m.f_cos_pdf(wo, wi), )*
                }
            }
            fn sample(
                &self,
                wo: sparrow_math::LocalDir<$R>,
                u: $crate::Uniforms<$R>,
            ) -> $crate::BsdfSample<$R> {
                match self {
                    $( $Enum::$Variant(m) => m.sample(wo, u), )*
                }
            }
            fn has_smooth_lobe(&self) -> bool {
                match self {
                    $( $Enum::$Variant(m) => m.has_smooth_lobe(), )*
                }
            }
            fn regularized(self) -> Self {
                match self {
                    $( $Enum::$Variant(m) => $Enum::$Variant(m.regularized()), )*
                }
            }
            $crate::registry::dispatch_lobes! { $Enum, $Trait, $R: $($Variant)* }
        }
    };
}
pub(crate) use dispatch;

macro_rules! models {
    (
        $(#[$doc:meta])*
        $Enum:ident, $Kind:ident: $Trait:ident {
            $( $Variant:ident = $module:ident :: $Type:ident, $name:literal; )*
        }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub enum $Enum<R: sparrow_math::Real> {
            $(
                #[doc = concat!("`", $name, "`")]
                $Variant($module::$Type<R>),
            )*
        }

        /// Names a registered model, without its parameters.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $Kind {
            $(
                #[doc = concat!("`", $name, "`")]
                $Variant,
            )*
        }

        impl $Kind {
            /// Every registered model.
            pub const ALL: &'static [$Kind] = &[$( $Kind::$Variant ),*];

            /// The name in scenes and on the command line.
            pub fn name(self) -> &'static str {
                match self {
                    $( $Kind::$Variant => $name, )*
                }
            }
            /// The model of that name.
            pub fn from_name(name: &str) -> Option<$Kind> {
                match name {
                    $( $name => Some($Kind::$Variant), )*
                    _ => None,
                }
            }
            /// The model's parameter table.
            pub fn params(self) -> &'static [$crate::ParamInfo] {
                match self {
                    $( $Kind::$Variant => <$module::$Type<f32> as $crate::Model<f32>>::PARAMS, )*
                }
            }
            /// What the model is and lacks.
            pub fn about(self) -> $crate::About {
                match self {
                    $( $Kind::$Variant => <$module::$Type<f32> as $crate::Model<f32>>::ABOUT, )*
                }
            }
            /// Binds the parameters, which lie in the ranges of the table.
            #[inline(always)]
            pub fn bind<R: sparrow_math::Real>(self, params: &$crate::ParamBlock<R>) -> $Enum<R> {
                match self {
                    $( $Kind::$Variant => $Enum::$Variant($crate::Model::new(params)), )*
                }
            }
        }

        /// The models without their number type.
        mod family {
            use sparrow_math::{LocalDir, Real};
            use sparrow_spectra::Spectrum;

            use $crate::{$Trait, BsdfSample, ParamBlock, Uniforms};

            $(
                pub(super) struct $Variant;
                impl $crate::batch::Family for $Variant {
                    type Of<R: Real> = super::$module::$Type<R>;
                    #[inline(always)]
                    fn f_cos_pdf<R: Real>(m: &Self::Of<R>, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
                        m.f_cos_pdf(wo, wi)
                    }
                    #[inline(always)]
                    fn sample<R: Real>(m: &Self::Of<R>, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
                        m.sample(wo, u)
                    }
                    fn f_cos_pdf_alone(
                        p: &ParamBlock<f32>,
                        wo: LocalDir<f32>,
                        wi: LocalDir<f32>,
                    ) -> (Spectrum<f32>, f32) {
                        super::$Kind::$Variant.bind(p).f_cos_pdf(wo, wi)
                    }
                    fn sample_alone(p: &ParamBlock<f32>, wo: LocalDir<f32>, u: Uniforms<f32>) -> BsdfSample<f32> {
                        super::$Kind::$Variant.bind(p).sample(wo, u)
                    }
                }
            )*
        }

        /// One match for a whole batch; the loops are monomorphic.
        impl $crate::Kind for $Kind {
            const ALL: &'static [Self] = $Kind::ALL;
            fn name(self) -> &'static str {
                $Kind::name(self)
            }
            fn params(self) -> &'static [$crate::ParamInfo] {
                $Kind::params(self)
            }
            fn about(self) -> $crate::About {
                $Kind::about(self)
            }
            fn eval_columns(
                self,
                p: &$crate::batch::ParamColumns<'_>,
                wo: &$crate::batch::DirColumns<'_>,
                wi: &$crate::batch::DirColumns<'_>,
                out: &mut $crate::batch::EvalColumns<'_>,
            ) {
                match self {
                    $( $Kind::$Variant => $crate::batch::eval::<family::$Variant>(p, wo, wi, out), )*
                }
            }
            fn sample_columns(
                self,
                p: &$crate::batch::ParamColumns<'_>,
                wo: &$crate::batch::DirColumns<'_>,
                u: &[&[f32]; 3],
                out: &mut $crate::batch::SampleColumns<'_>,
            ) {
                match self {
                    $( $Kind::$Variant => $crate::batch::draw::<family::$Variant>(p, wo, u, out), )*
                }
            }
        }

        $crate::registry::dispatch! { $Enum, $Trait, f32: $($Variant)* }
        $crate::registry::dispatch! { $Enum, $Trait, f64: $($Variant)* }
    };
}
pub(crate) use models;

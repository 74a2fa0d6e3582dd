//! Materials, made once all statements are read: pbrt-v4's by their meaning, our own models by their tables.

use std::collections::HashMap;
use std::rc::Rc;

use sparrow_models::{ModelKind, ParamInfo, ParamKind, SurfaceKind};

use super::Builder;
use super::spectrum::{Role, SPECTRUM_TYPES};
use crate::check;
use crate::desc::{MaterialDesc, MaterialId, RealParam, SpectrumDesc, SpectrumParam, SpectrumTexture};
use crate::diagnostic::Span;
use crate::params::Params;
use crate::suggest::remedy;
use crate::tables::{Category, Kind, Row, TYPE_ROW, Type, Use};

/// What a shape says its material is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum MaterialRef {
    /// Index into the materials, 0 for the default.
    Index(u32),
    /// By name, with the place where it was named.
    Named(Rc<str>, Span),
}

/// A `Material` or `MakeNamedMaterial` statement.
#[derive(Debug)]
pub(super) struct PendingMaterial {
    pub(super) name: Option<Rc<str>>,
    pub(super) type_name: String,
    pub(super) type_at: Span,
    pub(super) params: Params,
}

/// A model and where its parameters come from, by name; what is missing takes the table's default.
#[derive(Default)]
pub(super) struct Parts {
    model: Option<ModelKind>,
    reals: Vec<(&'static str, RealParam)>,
    spectra: Vec<(&'static str, SpectrumParam)>,
    pub(super) choices: Vec<(&'static str, u8)>,
}

impl Parts {
    pub(super) fn of(model: impl Into<ModelKind>) -> Self {
        Parts { model: Some(model.into()), ..Parts::default() }
    }
    pub(super) fn real(mut self, name: &'static str, from: RealParam) -> Self {
        self.reals.push((name, from));
        self
    }
    pub(super) fn spectrum(mut self, name: &'static str, from: SpectrumParam) -> Self {
        self.spectra.push((name, from));
        self
    }
}

/// The materials made, and which of them have names.
#[derive(Debug, Default)]
pub(super) struct Materials {
    pub(super) all: Vec<MaterialDesc>,
    pub(super) names: HashMap<Rc<str>, MaterialId>,
}

impl Builder {
    /// Makes all materials: named ones first, in file order, since mixtures name them.
    pub(super) fn make_materials(&mut self) -> Materials {
        let pending = std::mem::take(&mut self.materials);
        let grey = self.diffuse_grey();
        let default = self.material_desc(grey, None, "diffuse", Span::default());
        let mut out = Materials { all: vec![default; pending.len() + 1], names: HashMap::new() };
        for named in [true, false] {
            for (i, m) in pending.iter().enumerate().filter(|(_, m)| m.name.is_some() == named) {
                let parts = self.material(m, &out);
                out.all[i + 1] = self.material_desc(parts, m.name.as_deref(), &m.type_name, m.params.at);
                if let Some(name) = &m.name {
                    out.names.insert(Rc::clone(name), MaterialId(i as u32 + 1));
                }
            }
        }
        out
    }

    fn material(&mut self, m: &PendingMaterial, made: &Materials) -> Parts {
        let name = m.type_name.as_str();
        let entity = Category::Material.find(name);
        if let (None, Some(kind)) = (entity, ModelKind::from_name(name)) {
            return self.own_model(kind, m);
        }
        let Some(entity) = check::entity(&mut self.report, Category::Material, name, m.type_at) else {
            return self.diffuse_grey();
        };
        let mut params = m.params.clone();
        self.check_material(m, entity.rows(), &mut params);
        if params.broken {
            return self.diffuse_grey();
        }
        let p = &params;
        match entity.name {
            "diffuse" => {
                let reflectance = self.spectrum_param(p, "reflectance", Role::Albedo, 0.5);
                Parts::of(SurfaceKind::Lambert).spectrum("reflectance", SpectrumParam::Texture(reflectance))
            }
            "diffusetransmission" => self.diffuse_transmission(p),
            "coateddiffuse" => self.coated_diffuse(p),
            "conductor" => self.conductor(p),
            "coatedconductor" => self.coated_conductor(p),
            "dielectric" => {
                let eta = self.index_of_refraction(p, "eta");
                let [alpha_x, alpha_y] = self.alphas(p, "");
                Parts::of(SurfaceKind::Dielectric)
                    .real("eta", eta)
                    .real("alpha_x", alpha_x)
                    .real("alpha_y", alpha_y)
            }
            "thindielectric" => {
                let eta = self.index_of_refraction(p, "eta");
                Parts::of(SurfaceKind::ThinDielectric).real("eta", eta)
            }
            "interface" | "none" | "" => Parts::default(),
            "mix" => self.mix(p, made),
            "hair" => self.hair(p),
            _ => self.diffuse_grey(),
        }
    }

    fn check_material<'a>(
        &mut self,
        m: &PendingMaterial,
        rows: impl Iterator<Item = &'a Row> + Clone,
        params: &mut Params,
    ) {
        let what = format!("material \"{}\"", m.type_name);
        let named = m.name.is_some().then_some(&TYPE_ROW);
        check::params(&mut self.report, Category::Material, &what, rows.chain(named), params);
    }

    /// The stand-in for what is not supported, and pbrt-v4's default.
    fn diffuse_grey(&mut self) -> Parts {
        let grey = self.made.grey(0.5);
        Parts::of(SurfaceKind::Lambert).spectrum("reflectance", SpectrumParam::Texture(grey))
    }

    fn diffuse_transmission(&mut self, p: &Params) -> Parts {
        let scale = p.float_or("scale", 1.0);
        let mut both =
            ["reflectance", "transmittance"].map(|n| self.spectrum_param(p, n, Role::Albedo, 0.25));
        if scale < 0.0 {
            self.report.error(p.place("scale"), format!("\"scale\" is {scale}; give one from 0"));
        }
        if scale.to_bits() != 1.0_f32.to_bits() {
            let scale = self.made.constant(scale);
            both = both.map(|t| self.made.add_spectrum(SpectrumTexture::Scale(t, scale)));
        }
        Parts::of(SurfaceKind::DiffuseTransmission)
            .spectrum("reflectance", SpectrumParam::Texture(both[0]))
            .spectrum("transmittance", SpectrumParam::Texture(both[1]))
    }

    fn coated_diffuse(&mut self, p: &Params) -> Parts {
        let reflectance = self.spectrum_param(p, "reflectance", Role::Albedo, 0.5);
        let eta = self.index_of_refraction(p, "eta");
        let [alpha_x, alpha_y] = self.alphas(p, "");
        let thickness = self.float_param(p, "thickness", 0.01);
        Parts::of(SurfaceKind::CoatedDiffuse)
            .real("alpha_x", alpha_x)
            .real("alpha_y", alpha_y)
            .real("eta", eta)
            .real("thickness", RealParam::Texture(thickness))
            .spectrum("reflectance", SpectrumParam::Texture(reflectance))
    }

    fn conductor(&mut self, p: &Params) -> Parts {
        let (eta, k) = self.metal(p, "");
        let [alpha_x, alpha_y] = self.alphas(p, "");
        Parts::of(SurfaceKind::Conductor)
            .real("alpha_x", alpha_x)
            .real("alpha_y", alpha_y)
            .spectrum("eta", eta)
            .spectrum("k", k)
    }

    fn coated_conductor(&mut self, p: &Params) -> Parts {
        let (eta_base, k_base) = self.metal(p, "conductor.");
        let eta = self.index_of_refraction(p, "interface.eta");
        let [alpha_x, alpha_y] = self.alphas(p, "interface.");
        let [base_x, base_y] = self.alphas(p, "conductor.");
        let thickness = self.float_param(p, "thickness", 0.01);
        Parts::of(SurfaceKind::CoatedConductor)
            .real("alpha_x", alpha_x)
            .real("alpha_y", alpha_y)
            .real("alpha_base_x", base_x)
            .real("alpha_base_y", base_y)
            .real("eta", eta)
            .real("thickness", RealParam::Texture(thickness))
            .spectrum("eta_base", eta_base)
            .spectrum("k_base", k_base)
    }

    /// Indices of a metal, given as such or by its reflectance; `prefix` goes before the names of the coated one.
    fn metal(&mut self, p: &Params, prefix: &str) -> (SpectrumParam, SpectrumParam) {
        let (eta_name, k_name) = (format!("{prefix}eta"), format!("{prefix}k"));
        let eta = self.spectrum_param_given(p, &eta_name, Role::Unbounded);
        let k = self.spectrum_param_given(p, &k_name, Role::Unbounded);
        let reflectance = self.spectrum_param_given(p, "reflectance", Role::Albedo);
        if reflectance.is_some() && (eta.is_some() || k.is_some()) {
            let message = format!(
                "a conductor has either \"reflectance\" or \"{eta_name}\" and \"{k_name}\"; remove one"
            );
            self.report.error(p.place("reflectance"), message);
        }
        if let Some(r) = reflectance {
            return (SpectrumParam::Texture(self.made.grey(1.0)), SpectrumParam::ReflectanceToK(r));
        }
        let mut or_copper = |given: Option<_>, name: &str| {
            SpectrumParam::Texture(given.unwrap_or_else(|| {
                self.made.add_spectrum(SpectrumTexture::Constant(SpectrumDesc::Named(name.into())))
            }))
        };
        (or_copper(eta, "metal-Cu-eta"), or_copper(k, "metal-Cu-k"))
    }

    /// Slope widths along u and v.
    fn alphas(&mut self, p: &Params, prefix: &str) -> [RealParam; 2] {
        let remap = p.bool_or("remaproughness", true);
        ["uroughness", "vroughness"].map(|name| {
            let own = self.float_param_given(p, &format!("{prefix}{name}"));
            let t = own.unwrap_or_else(|| self.float_param(p, &format!("{prefix}roughness"), 0.0));
            if remap { RealParam::RoughnessToAlpha(t) } else { RealParam::Texture(t) }
        })
    }

    /// Index of a dielectric: a number goes before a spectrum.
    fn index_of_refraction(&mut self, p: &Params, name: &str) -> RealParam {
        let constant = match p.float(name) {
            Some(eta) => Some(eta),
            None => match self.spectrum(p, name, Role::Unbounded) {
                Some(SpectrumDesc::Constant(eta)) => Some(eta),
                // Equal components are a constant spectrum.
                Some(SpectrumDesc::Rgb([r, g, b], _))
                    if r.to_bits() == g.to_bits() && g.to_bits() == b.to_bits() =>
                {
                    Some(r)
                }
                Some(spectrum) => return RealParam::Dispersive(spectrum),
                None => None,
            },
        };
        let eta = constant.unwrap_or(1.5);
        if eta <= 0.0 {
            self.report.error(p.place(name), format!("\"{name}\" is {eta}; give one above zero"));
        }
        RealParam::Texture(self.made.constant(eta))
    }

    /// The first material of a mixture that has a surface.
    fn mix(&mut self, p: &Params, made: &Materials) -> Parts {
        let names = p.texts("materials");
        if names.len() != 2 {
            let message = format!("\"materials\" names {} materials; name two", names.len());
            self.report.error(p.place("materials"), message);
        }
        let mut first = None;
        for (name, at) in names {
            let Some(&id) = made.names.get(name.as_str()) else {
                let remedy = remedy(name, made.names.keys().map(AsRef::as_ref));
                self.report.error(*at, format!("there is no material \"{name}\" before this one; {remedy}"));
                continue;
            };
            let desc = &made.all[id.0 as usize];
            if first.is_none() && desc.model.is_some() {
                first = Some(desc);
            }
        }
        let Some(desc) = first else { return self.diffuse_grey() };
        let Some(model) = desc.model else { return self.diffuse_grey() };
        let reals = names_of(model, |k| matches!(k, ParamKind::Real));
        let spectra = names_of(model, |k| matches!(k, ParamKind::Albedo | ParamKind::Unbounded));
        let choices = names_of(model, |k| matches!(k, ParamKind::Choice(_)));
        Parts {
            model: Some(model),
            reals: reals.zip(desc.reals.iter().cloned()).collect(),
            spectra: spectra.zip(desc.spectra.iter().cloned()).collect(),
            choices: choices.zip(desc.choices.iter().copied()).collect(),
        }
    }

    /// A model of the registry, by its own table.
    fn own_model(&mut self, kind: ModelKind, m: &PendingMaterial) -> Parts {
        let rows: Vec<Row> = kind.params().iter().map(row_of).collect();
        let mut params = m.params.clone();
        self.check_material(m, rows.iter(), &mut params);
        let mut parts = Parts::of(kind);
        for info in kind.params() {
            match info.kind {
                ParamKind::Real => {
                    if let Some(from) = self.own_real(kind, info, &params) {
                        parts = parts.real(info.name, from);
                    }
                }
                ParamKind::Albedo | ParamKind::Unbounded => {
                    let role = if info.kind == ParamKind::Albedo { Role::Albedo } else { Role::Unbounded };
                    if let Some(t) = self.spectrum_param_given(&params, info.name, role) {
                        self.check_constant(kind, info, t.0 as usize, &params);
                        parts = parts.spectrum(info.name, SpectrumParam::Texture(t));
                    }
                }
                ParamKind::Choice(names) => {
                    let places: Vec<(&'static str, u8)> = names.iter().copied().zip(0..).collect();
                    let default = names.get(info.default as usize).copied().unwrap_or_default();
                    if let Some(place) = self.choice(&params, info.name, &places, default) {
                        parts.choices.push((info.name, place));
                    }
                }
            }
        }
        parts
    }

    fn own_real(&mut self, kind: ModelKind, info: &ParamInfo, p: &Params) -> Option<RealParam> {
        let [rgb, spectrum, blackbody] = SPECTRUM_TYPES;
        let param = p.find(info.name, &[Type::Float, Type::Texture, rgb, spectrum, blackbody])?;
        if param.ty == Type::Float {
            self.check_range(kind, info, param.values.floats().iter().copied(), param.at);
        }
        if matches!(param.ty, Type::Float | Type::Texture) {
            return self.float_param_given(p, info.name).map(RealParam::Texture);
        }
        let spectrum = self.spectrum_of(param, Role::Unbounded)?;
        let SpectrumDesc::Constant(v) = spectrum else { return Some(RealParam::Dispersive(spectrum)) };
        self.check_range(kind, info, [v].into_iter(), param.at);
        Some(RealParam::Texture(self.made.constant(v)))
    }

    /// Checks a spectrum that is the same everywhere against the table.
    fn check_constant(&mut self, kind: ModelKind, info: &ParamInfo, texture: usize, p: &Params) {
        let Some(SpectrumTexture::Constant(spectrum)) = self.made.spectra.get(texture) else { return };
        let values: Vec<f32> = match spectrum {
            SpectrumDesc::Constant(v) => vec![*v],
            SpectrumDesc::Rgb(rgb, _) => rgb.to_vec(),
            SpectrumDesc::Samples(s) => s.iter().map(|s| s.1).collect(),
            SpectrumDesc::Blackbody(_) | SpectrumDesc::Named(_) => return,
        };
        self.check_range(kind, info, values.into_iter(), p.place(info.name));
    }

    fn check_range(
        &mut self,
        kind: ModelKind,
        info: &ParamInfo,
        values: impl Iterator<Item = f32>,
        at: Span,
    ) {
        let [lo, hi] = info.range;
        // The limits are decimal numbers, and values have been rounded to single precision.
        let (lo32, hi32) = (lo as f32, hi as f32);
        for v in values.filter(|v| !(lo32..=hi32).contains(v)).take(1) {
            let limits = if hi.is_finite() {
                format!("values from {lo} to {hi}")
            } else {
                format!("values from {lo}")
            };
            let message =
                format!("\"{}\" of material \"{}\" is {v}; it takes {limits}", info.name, kind.name());
            self.report.error(at, message);
        }
    }

    /// Puts the parts in the order of the model's table.
    fn material_desc(&mut self, parts: Parts, name: Option<&str>, type_name: &str, at: Span) -> MaterialDesc {
        let (mut reals, mut spectra, mut choices) = (Vec::new(), Vec::new(), Vec::new());
        for info in parts.model.map_or(&[][..], ModelKind::params) {
            match info.kind {
                ParamKind::Real => {
                    let given = parts.reals.iter().find(|(n, _)| *n == info.name).map(|(_, v)| v.clone());
                    reals.push(
                        given.unwrap_or_else(|| RealParam::Texture(self.made.constant(info.default as f32))),
                    );
                }
                ParamKind::Albedo | ParamKind::Unbounded => {
                    let given = parts.spectra.iter().find(|(n, _)| *n == info.name).map(|(_, v)| v.clone());
                    spectra.push(
                        given.unwrap_or_else(|| SpectrumParam::Texture(self.made.grey(info.default as f32))),
                    );
                }
                ParamKind::Choice(_) => {
                    let given = parts.choices.iter().find(|(n, _)| *n == info.name);
                    choices.push(given.map_or(info.default as u8, |g| g.1));
                }
            }
        }
        let (name, type_name) = (name.map(String::from), type_name.to_string());
        MaterialDesc { name, type_name, model: parts.model, reals, spectra, choices, at }
    }
}

/// Names of a model's parameters of some kind, in the table's order.
fn names_of(model: ModelKind, of: fn(ParamKind) -> bool) -> impl Iterator<Item = &'static str> {
    model.params().iter().filter(move |i| of(i.kind)).map(|i| i.name)
}

/// What a parameter of a model's own table takes in a scene.
fn row_of(info: &ParamInfo) -> Row {
    let kind = match info.kind {
        // An index of refraction may depend on the wavelength.
        ParamKind::Real if info.name.starts_with("eta") => Kind::FloatTextureOrSpectrum,
        ParamKind::Real => Kind::FloatTexture,
        ParamKind::Albedo | ParamKind::Unbounded => Kind::SpectrumTexture,
        ParamKind::Choice(_) => Kind::Text,
    };
    Row { name: info.name, kind, used: Use::Yes }
}

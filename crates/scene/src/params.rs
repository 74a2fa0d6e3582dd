//! The parameters of a statement: [`Params`].

use std::rc::Rc;

use sparrow_math::{Vec3, vec3};
use sparrow_spectra::ColorSpace;

use crate::diagnostic::Span;
use crate::tables::Type;

/// The values of a parameter, in the form that suits its type.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Values {
    Bools(Vec<bool>),
    Ints(Vec<i32>),
    /// Of the types `float` and `blackbody`, and of `spectrum` where it lists samples.
    Floats(Vec<f32>),
    Pairs(Vec<[f32; 2]>),
    Triples(Vec<[f32; 3]>),
    /// Of the types `string` and `texture`, and of `spectrum` where it names one.
    Texts(Vec<(String, Span)>),
}

impl Values {
    /// How many items there are.
    pub(crate) fn len(&self) -> usize {
        match self {
            Values::Bools(v) => v.len(),
            Values::Ints(v) => v.len(),
            Values::Floats(v) => v.len(),
            Values::Pairs(v) => v.len(),
            Values::Triples(v) => v.len(),
            Values::Texts(v) => v.len(),
        }
    }
    /// Numbers; empty where these are other values, as for all of the following.
    pub(crate) fn floats(&self) -> &[f32] {
        if let Values::Floats(v) = self { v } else { &[] }
    }
    /// Integers.
    pub(crate) fn ints(&self) -> &[i32] {
        if let Values::Ints(v) = self { v } else { &[] }
    }
    /// Booleans.
    pub(crate) fn bools(&self) -> &[bool] {
        if let Values::Bools(v) = self { v } else { &[] }
    }
    /// Triples of numbers.
    pub(crate) fn triples(&self) -> &[[f32; 3]] {
        if let Values::Triples(v) = self { v } else { &[] }
    }
    /// Strings.
    pub(crate) fn texts(&self) -> &[(String, Span)] {
        if let Values::Texts(v) = self { v } else { &[] }
    }
}

/// One parameter as the file gives it.
#[derive(Clone, Debug)]
pub(crate) struct Param {
    pub(crate) ty: Type,
    pub(crate) name: String,
    pub(crate) values: Values,
    /// Of RGB values.
    pub(crate) color_space: ColorSpace,
    /// The declaration, `"type name"`.
    pub(crate) at: Span,
}

/// The parameters of one statement, with those that `Attribute` statements set for it.
///
/// As in pbrt-v4 the last one of a name counts, and the statement's own before the inherited ones.
#[derive(Clone, Debug)]
pub(crate) struct Params {
    pub(crate) own: Vec<Param>,
    pub(crate) inherited: Rc<Vec<Rc<Param>>>,
    /// In force at the statement.
    pub(crate) color_space: ColorSpace,
    /// A parameter was left out because it is faulty: what seems to be missing need not be.
    pub(crate) broken: bool,
    /// The statement.
    pub(crate) at: Span,
}

impl Params {
    /// The parameter that counts, of the name and one of the types.
    pub(crate) fn find(&self, name: &str, types: &[Type]) -> Option<&Param> {
        let fits = |p: &&Param| p.name == name && types.contains(&p.ty) && p.values.len() > 0;
        let own = self.own.iter().rev().find(fits);
        own.or_else(|| self.inherited.iter().rev().map(Rc::as_ref).find(fits))
    }
    /// Where a parameter stands, or the statement where it is not given.
    pub(crate) fn place(&self, name: &str) -> Span {
        let own = self.own.iter().rev().find(|p| p.name == name);
        own.or_else(|| self.inherited.iter().rev().map(Rc::as_ref).find(|p| p.name == name))
            .map_or(self.at, |p| p.at)
    }
    /// A parameter of that name was given, of whatever type.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.own.iter().any(|p| p.name == name) || self.inherited.iter().any(|p| p.name == name)
    }

    /// One number.
    pub(crate) fn float(&self, name: &str) -> Option<f32> {
        self.floats(name).first().copied()
    }
    /// One number, or the default.
    pub(crate) fn float_or(&self, name: &str, default: f32) -> f32 {
        self.float(name).unwrap_or(default)
    }
    /// One integer.
    pub(crate) fn int(&self, name: &str) -> Option<i32> {
        self.ints(name).first().copied()
    }
    /// One boolean.
    pub(crate) fn bool_or(&self, name: &str, default: bool) -> bool {
        self.find(name, &[Type::Bool]).and_then(|p| p.values.bools().first().copied()).unwrap_or(default)
    }
    /// One string, with its place.
    pub(crate) fn text(&self, name: &str) -> Option<(&str, Span)> {
        self.texts(name).first().map(|(s, at)| (s.as_str(), *at))
    }
    /// All strings.
    pub(crate) fn texts(&self, name: &str) -> &[(String, Span)] {
        self.find(name, &[Type::Text]).map_or(&[], |p| p.values.texts())
    }
    /// The name of a texture, with its place.
    pub(crate) fn texture(&self, name: &str) -> Option<(&str, Span)> {
        let first = self.find(name, &[Type::Texture])?.values.texts().first();
        first.map(|(s, at)| (s.as_str(), *at))
    }
    /// All points.
    pub(crate) fn triples(&self, name: &str) -> &[[f32; 3]] {
        self.find(name, &[Type::Point3]).map_or(&[], |p| p.values.triples())
    }
    /// One point, vector or normal.
    pub(crate) fn triple(&self, name: &str) -> Option<Vec3<f64>> {
        let first = self.find(name, &[Type::Point3, Type::Vector3, Type::Normal])?.values.triples().first();
        first.map(|&[x, y, z]| vec3(x.into(), y.into(), z.into()))
    }
    /// All numbers.
    pub(crate) fn floats(&self, name: &str) -> &[f32] {
        self.find(name, &[Type::Float]).map_or(&[], |p| p.values.floats())
    }
    /// All integers.
    pub(crate) fn ints(&self, name: &str) -> &[i32] {
        self.find(name, &[Type::Integer]).map_or(&[], |p| p.values.ints())
    }
    /// Takes all triples of a type out of the statement's own parameters; inherited ones are copied.
    pub(crate) fn take_triples(&mut self, name: &str, ty: Type) -> Vec<[f32; 3]> {
        if let Some(Values::Triples(v)) = self.take(name, ty) { v } else { Vec::new() }
    }
    /// Takes all pairs, as [`take_triples`](Self::take_triples) does.
    pub(crate) fn take_pairs(&mut self, name: &str, ty: Type) -> Vec<[f32; 2]> {
        if let Some(Values::Pairs(v)) = self.take(name, ty) { v } else { Vec::new() }
    }
    fn take(&mut self, name: &str, ty: Type) -> Option<Values> {
        if let Some(p) = self.own.iter_mut().rev().find(|p| p.name == name && p.ty == ty) {
            return Some(std::mem::replace(&mut p.values, Values::Bools(Vec::new())));
        }
        self.find(name, &[ty]).map(|p| p.values.clone())
    }
}

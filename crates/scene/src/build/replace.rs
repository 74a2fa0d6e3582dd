//! Materials from outside the scene that stand for named ones in it.

use super::Builder;
use crate::diagnostic::{Diagnostic, Span};
use crate::params::Params;
use crate::parser::Parser;
use crate::suggest::remedy;

/// A material for all uses of a name.
#[derive(Debug)]
pub(super) struct Replacement {
    name: String,
    at: Span,
    params: Params,
    used: bool,
}

impl Builder {
    /// Reads `"NAME" "string type" "TYPE" "float roughness" 0.2 ...`: what follows `MakeNamedMaterial` in a scene.
    pub(crate) fn replace_material(&mut self, text: &str) {
        let file = self.report.add_file("--material".into());
        let mut parser = Parser::new(text.as_bytes(), file);
        if let Err(fault) = self.replacement(&mut parser, Span { file, ..Span::default() }) {
            self.report.push(fault);
        }
    }

    fn replacement(&mut self, parser: &mut Parser<'_>, at: Span) -> Result<(), Diagnostic> {
        let (name, name_at) = parser.text()?;
        let params = self.read_params(parser, crate::tables::Category::Material, at);
        if let Some((_, rest)) = parser.directive()? {
            return Err(Diagnostic::error(rest, "a material ends before the next statement; remove this"));
        }
        self.replacements.push(Replacement { name, at: name_at, params, used: false });
        Ok(())
    }

    /// The parameters that stand for those of the material `name`, if there are any.
    pub(super) fn replaced(&mut self, name: &str) -> Option<Params> {
        let found = self.replacements.iter_mut().rev().find(|r| r.name == name)?;
        found.used = true;
        Some(found.params.clone())
    }

    /// Reports replacements for which the scene has no material.
    pub(super) fn check_replacements(&mut self) {
        for r in std::mem::take(&mut self.replacements).iter().filter(|r| !r.used) {
            let remedy = remedy(&r.name, self.named_materials.keys().map(|n| &**n));
            let message = format!("the scene has no named material \"{}\" to replace; {remedy}", r.name);
            self.report.error(r.at, message);
        }
    }
}

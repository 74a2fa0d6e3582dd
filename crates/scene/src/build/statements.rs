//! One statement: where it may stand, and who reads it.

use super::Builder;
use crate::diagnostic::{Diagnostic, Span};
use crate::parser::Parser;

/// Statements that belong behind `WorldBegin`.
const WORLD: [&str; 15] = [
    "AreaLightSource",
    "AttributeBegin",
    "AttributeEnd",
    "Import",
    "LightSource",
    "MakeNamedMaterial",
    "Material",
    "NamedMaterial",
    "ObjectBegin",
    "ObjectEnd",
    "ObjectInstance",
    "ReverseOrientation",
    "Shape",
    "Texture",
    "TransformBegin",
];

/// Statements that belong before it.
const SETUP: [&str; 7] =
    ["Accelerator", "Camera", "Film", "Integrator", "PixelFilter", "Sampler", "TransformTimes"];

impl Builder {
    /// Reads one statement, whose directive has been read.
    pub(super) fn statement(
        &mut self,
        parser: &mut Parser<'_>,
        directive: &'static str,
        at: Span,
    ) -> Result<(), Diagnostic> {
        self.check_place(directive, at);
        if self.entity_statement(parser, directive, at)? {
            return Ok(());
        }
        self.count(directive, "");
        let read = self.transform_statement(parser, directive, at)?
            || self.block_statement(parser, directive, at)?
            || self.file_statement(parser, directive)?
            || self.name_statement(parser, directive, at)?;
        if read {
            return Ok(());
        }
        Err(Diagnostic::error(at, format!("`{directive}` is of an early pbrt; write `Integrator`")))
    }

    fn check_place(&mut self, directive: &str, at: Span) {
        if self.world.is_none() && WORLD.contains(&directive) && !self.said_before_world {
            self.said_before_world = true;
            let message = format!(
                "`{directive}` stands before `WorldBegin`; put `WorldBegin` before the first light, material or shape"
            );
            self.report.error(at, message);
        }
        if self.world.is_some() && SETUP.contains(&directive) {
            self.report.error(at, format!("`{directive}` stands behind `WorldBegin`; move it before"));
        }
    }
}

//! Blocks: attributes, objects and their instances, `WorldBegin`.

use std::sync::Arc;

use sparrow_math::Transform;

use super::Builder;
use super::graphics::{Graphics, Target};
use super::shapes::{Object, PendingInstance};
use crate::diagnostic::{Diagnostic, Span};
use crate::parser::Parser;
use crate::suggest::remedy;

/// What opened a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BlockKind {
    Attribute,
    Object,
    /// An object within an object, which is a fault.
    Nested,
}

impl BlockKind {
    fn opener(self) -> &'static str {
        match self {
            BlockKind::Attribute => "AttributeBegin",
            BlockKind::Object | BlockKind::Nested => "ObjectBegin",
        }
    }
    fn closer(self) -> &'static str {
        match self {
            BlockKind::Attribute => "AttributeEnd",
            BlockKind::Object | BlockKind::Nested => "ObjectEnd",
        }
    }
}

/// A block that is open, and what its end brings back.
#[derive(Debug)]
pub(super) struct Block {
    kind: BlockKind,
    at: Span,
    saved: Graphics,
}

impl Builder {
    /// Reads a statement about blocks; false where it is another statement.
    pub(super) fn block_statement(
        &mut self,
        parser: &mut Parser<'_>,
        directive: &'static str,
        at: Span,
    ) -> Result<bool, Diagnostic> {
        match directive {
            "WorldBegin" => self.world_begin(at),
            "WorldEnd" => self.report.warn(at, "`WorldEnd` is of pbrt-v3 and has no effect; remove it"),
            "AttributeBegin" => self.open(BlockKind::Attribute, at),
            "AttributeEnd" => self.attribute_end(directive, at),
            "TransformBegin" => {
                let message = "`TransformBegin` and `TransformEnd` are of pbrt-v3 and save all attributes; \
                               write `AttributeBegin` and `AttributeEnd`";
                self.report.warn(at, message);
                self.open(BlockKind::Attribute, at);
            }
            "TransformEnd" => self.attribute_end(directive, at),
            "ObjectBegin" => {
                let name = parser.text()?;
                self.object_begin(name, at);
            }
            "ObjectEnd" => self.object_end(at),
            "ObjectInstance" => {
                let name = parser.text()?;
                self.object_instance(name, at);
            }
            "Attribute" => self.attribute(parser)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn world_begin(&mut self, at: Span) {
        if let Some(first) = self.world {
            let first = self.report.place(first);
            self.report.error(at, format!("`WorldBegin` stood already at {first}; remove one"));
            return;
        }
        self.world = Some(at);
        self.graphics.ctm = [Transform::IDENTITY; 2];
        self.graphics.active = [true; 2];
        self.coordinate_systems.insert("world".into(), self.graphics.ctm);
    }

    pub(super) fn open(&mut self, kind: BlockKind, at: Span) {
        self.blocks.push(Block { kind, at, saved: self.graphics.clone() });
    }

    /// How many blocks are open.
    pub(super) fn n_open(&self) -> usize {
        self.blocks.len()
    }

    /// Reports blocks beyond `n_open` that are still open, and closes them.
    pub(super) fn close_all(&mut self, n_open: usize) {
        while self.blocks.len() > n_open {
            let Some(block) = self.blocks.pop() else { return };
            let (opener, closer) = (block.kind.opener(), block.kind.closer());
            self.report.error(block.at, format!("`{opener}` is never closed; add `{closer}`"));
            if block.kind == BlockKind::Object {
                self.open_object = None;
            }
            self.graphics = block.saved;
        }
    }

    fn attribute_end(&mut self, directive: &str, at: Span) {
        if let Some(block) = self.blocks.pop_if(|b| b.kind == BlockKind::Attribute) {
            self.graphics = block.saved;
            return;
        }
        let message = match self.blocks.last() {
            Some(block) => self.crossed(directive, block),
            None => format!("`{directive}` closes nothing; remove it or add `AttributeBegin`"),
        };
        self.report.error(at, message);
    }

    fn object_end(&mut self, at: Span) {
        let Some(i) = self.blocks.iter().rposition(|b| b.kind != BlockKind::Attribute) else {
            self.report.error(at, "`ObjectEnd` closes no object; remove it or add `ObjectBegin`");
            return;
        };
        // What is still open inside the object ends with it, after one message.
        if let Some(inner) = self.blocks.get(i + 1) {
            let message = self.crossed("ObjectEnd", inner);
            self.report.error(at, message);
        }
        self.blocks.truncate(i + 1);
        let Some(block) = self.blocks.pop() else { return };
        if block.kind == BlockKind::Object {
            self.open_object = None;
        }
        self.graphics = block.saved;
    }

    fn crossed(&self, directive: &str, open: &Block) -> String {
        let (opener, closer) = (open.kind.opener(), open.kind.closer());
        let place = self.report.place(open.at);
        format!("`{directive}` stands where `{opener}` of {place} is open; close that with `{closer}` first")
    }

    fn object_begin(&mut self, (name, name_at): (String, Span), at: Span) {
        let nested = self.open_object.and_then(|i| self.objects.get(i)).map(|o| o.at);
        if let Some(outer) = nested {
            let place = self.report.place(outer);
            let message = format!(
                "objects cannot be nested, and that of {place} is open; close it with `ObjectEnd` first"
            );
            self.report.error(at, message);
            self.open(BlockKind::Nested, at);
            return;
        }
        self.open(BlockKind::Object, at);
        let first = self.object_names.get(name.as_str()).and_then(|&i| self.objects.get(i));
        if let Some(first) = first {
            let place = self.report.place(first.at);
            self.report
                .error(name_at, format!("the object \"{name}\" is defined already at {place}; rename one"));
        }
        let name: Arc<str> = name.into();
        self.open_object = Some(self.objects.len());
        self.object_names.insert(Arc::clone(&name), self.objects.len());
        self.objects.push(Object { name, at, shapes: Vec::new() });
    }

    fn object_instance(&mut self, (name, name_at): (String, Span), at: Span) {
        if self.open_object.is_some() {
            self.report.error(at, "instances cannot stand inside an object; close it with `ObjectEnd` first");
            return;
        }
        let (to_world, moves_to) = self.moving(at);
        self.instances.push(PendingInstance { name, at: name_at, to_world, moves_to });
    }

    fn attribute(&mut self, parser: &mut Parser<'_>) -> Result<(), Diagnostic> {
        let (name, at) = parser.text()?;
        let params = parser.params(self.graphics.color_space, |d| self.report.push(d));
        match Target::ALL.iter().find(|(n, _)| *n == name) {
            Some(&(_, target)) => {
                for p in &params {
                    self.check_attribute(target, p);
                }
                self.graphics.inherit(target, params);
            }
            None => {
                let remedy = remedy(&name, Target::ALL.iter().map(|t| t.0));
                self.report.error(at, format!("`Attribute` has no target \"{name}\"; {remedy}"));
            }
        }
        Ok(())
    }
}

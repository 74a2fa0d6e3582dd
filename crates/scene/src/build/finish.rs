//! The end of the scene: names become indices.

use std::collections::HashSet;
use std::rc::Rc;

use super::Builder;
use super::materials::{MaterialRef, Materials};
use super::shapes::{Alpha, Object, PendingInstance, PendingShape};
use crate::desc::{
    FloatTextureId, InstanceDesc, MaterialId, PrototypeDesc, PrototypeId, SceneDesc, ShapeDesc,
};
use crate::diagnostic::{SceneError, Span};
use crate::suggest::remedy;

impl Builder {
    /// Resolves all names and returns the scene, or everything that is wrong with it.
    ///
    /// # Errors
    /// All faults, in file order.
    pub(crate) fn finish(mut self) -> Result<SceneDesc, SceneError> {
        self.close_all(0);
        self.read_meshes();
        let whole = Span::default();
        if self.world.is_none() && self.report.is_clean() {
            let message = if self.statements.is_empty() {
                "the scene is empty; a scene has a camera, `WorldBegin`, lights and shapes"
            } else {
                "the scene has no `WorldBegin`; add it before the first light, material or shape"
            };
            self.report.error(whole, message);
        }
        let camera = self.make_camera();
        let film = self.make_film(camera.shutter);
        let (filter, sampler) = (self.make_filter(), self.make_sampler());
        let integrator = self.make_integrator();
        self.check_media();
        self.check_replacements();
        self.make_textures();
        let materials = self.make_materials();
        let mut resolver = Resolver { materials: &materials, said: HashSet::new() };
        let shapes = std::mem::take(&mut self.shapes);
        let shapes = shapes.into_iter().map(|s| self.resolved(s, &mut resolver)).collect();
        let prototypes = self.make_prototypes(&mut resolver);
        let instances = self.make_instances(&prototypes);
        if !self.report.is_clean() {
            return Err(self.report.into_error());
        }
        let statements = self.statements.iter().flat_map(|(directive, types)| {
            types.iter().map(move |(name, &n)| match name.as_str() {
                "" => (directive.to_string(), n),
                _ => (format!("{directive} {name}"), n),
            })
        });
        let statements = statements.collect();
        let (warnings, files) = self.report.into_warnings();
        Ok(SceneDesc {
            camera,
            film,
            filter,
            sampler,
            integrator,
            seed: self.setup.seed,
            shapes,
            prototypes,
            instances,
            materials: materials.all,
            lights: self.lights,
            area_lights: self.area_lights,
            float_textures: self.made.floats,
            spectrum_textures: self.made.spectra,
            warnings,
            files,
            statements,
        })
    }

    fn check_media(&mut self) {
        for (name, at) in std::mem::take(&mut self.medium_uses) {
            if !name.is_empty() && !self.media.contains_key(&name) {
                let remedy = remedy(&name, self.media.keys().map(String::as_str));
                self.report.error(at, format!("there is no medium \"{name}\"; {remedy}"));
            }
        }
    }

    fn make_prototypes(&mut self, resolver: &mut Resolver<'_>) -> Vec<PrototypeDesc> {
        let objects = std::mem::take(&mut self.objects);
        let prototype = |Object { name, at, shapes }| {
            let shapes = shapes.into_iter().map(|s| self.resolved(s, resolver)).collect();
            PrototypeDesc { name, shapes, at }
        };
        objects.into_iter().map(prototype).collect()
    }

    /// Instances; those of objects without shapes are left out, as there is nothing of them to see.
    fn make_instances(&mut self, prototypes: &[PrototypeDesc]) -> Vec<InstanceDesc> {
        let pending = std::mem::take(&mut self.instances);
        let mut instances = Vec::with_capacity(pending.len());
        for PendingInstance { name, at, to_world, moves_to } in pending {
            match self.object_names.get(name.as_str()) {
                Some(&i) if prototypes.get(i).is_some_and(|p| p.shapes.is_empty()) => {}
                Some(&i) => {
                    instances.push(InstanceDesc { prototype: PrototypeId(i as u32), to_world, moves_to });
                }
                None => {
                    let remedy = remedy(&name, self.object_names.keys().map(AsRef::as_ref));
                    self.report.error(at, format!("there is no object \"{name}\"; {remedy}"));
                }
            }
        }
        instances
    }

    fn resolved(&mut self, shape: PendingShape, resolver: &mut Resolver<'_>) -> ShapeDesc {
        let material = self.material_id(&shape.material, resolver);
        let mut area_light = shape.area_light;
        let passes = resolver.materials.all.get(material.0 as usize).is_some_and(|m| m.model.is_none());
        if passes && area_light.is_some() {
            let message =
                "a shape of material \"interface\" emits no light, as in pbrt-v4; the area light is ignored";
            self.report.warn(shape.at, message);
            area_light = None;
        }
        ShapeDesc {
            kind: shape.kind,
            to_world: shape.to_world,
            moves_to: shape.moves_to,
            reverse_orientation: shape.reverse_orientation,
            material,
            area_light,
            alpha: self.alpha_id(shape.alpha),
            at: shape.at,
        }
    }

    fn material_id(&mut self, material: &MaterialRef, resolver: &mut Resolver<'_>) -> MaterialId {
        let (name, at) = match material {
            MaterialRef::Index(i) => return MaterialId(*i),
            MaterialRef::Named(name, at) => (name, *at),
        };
        if let Some(&id) = resolver.materials.names.get(name) {
            return id;
        }
        // One `NamedMaterial` may stand for many shapes; those whose definition failed are known by name.
        if resolver.said.insert((Rc::clone(name), at)) && !self.named_materials.contains_key(name) {
            let remedy = remedy(name, resolver.materials.names.keys().map(AsRef::as_ref));
            self.report.error(at, format!("there is no material \"{name}\"; {remedy}"));
        }
        MaterialId(0)
    }

    fn alpha_id(&mut self, alpha: Alpha) -> Option<FloatTextureId> {
        match alpha {
            Alpha::Opaque => None,
            Alpha::Constant(v) => Some(self.made.constant(v)),
            Alpha::Texture(name, at) => self.float_named(&name, at),
        }
    }
}

struct Resolver<'a> {
    materials: &'a Materials,
    /// Names that were reported as missing.
    said: HashSet<(Rc<str>, Span)>,
}

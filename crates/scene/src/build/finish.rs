//! The end of the scene: names become indices, instances become shapes.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use sparrow_math::Transform;

use super::Builder;
use super::materials::{MaterialRef, Materials};
use super::shapes::{Alpha, Item, Object, PendingShape, Use};
use crate::desc::{FloatTextureId, MaterialId, SceneDesc, ShapeDesc};
use crate::diagnostic::{SceneError, Span};
use crate::suggest::remedy;

/// Instances make shapes of their own; more than this would fill the memory before a ray is traced.
const MAX_SHAPES: usize = 10_000_000;

impl Builder {
    /// Resolves all names and returns the scene, or everything that is wrong with it.
    ///
    /// # Errors
    /// All faults, in file order.
    pub(crate) fn finish(mut self) -> Result<SceneDesc, SceneError> {
        self.close_all(0);
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
        let shapes = self.make_shapes(&materials);
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

    fn make_shapes(&mut self, materials: &Materials) -> Vec<ShapeDesc> {
        let items = std::mem::take(&mut self.items);
        let objects = std::mem::take(&mut self.objects);
        let mut resolver = Resolver { materials, said: HashSet::new() };
        let Some(n) = self.n_shapes(&items, &objects) else { return Vec::new() };
        let mut out = Vec::with_capacity(n);
        // Shapes of objects are resolved once, also for objects that are never used.
        let mut resolved: HashMap<String, Vec<ShapeDesc>> = HashMap::new();
        for (name, object) in objects {
            let shapes = object.shapes.into_iter().map(|s| self.resolved(s, &mut resolver)).collect();
            resolved.insert(name, shapes);
        }
        for item in items {
            match item {
                Item::Shape(shape) => out.push(self.resolved(*shape, &mut resolver)),
                Item::Use(u) => self.instantiate(&u, &resolved, &mut out),
            }
        }
        out
    }

    /// How many shapes there will be; `None`, and a fault, where there are too many.
    fn n_shapes(&mut self, items: &[Item], objects: &HashMap<String, Object>) -> Option<usize> {
        let mut n = 0_usize;
        for item in items {
            n = n.saturating_add(match item {
                Item::Shape(_) => 1,
                Item::Use(u) => objects.get(&u.name).map_or(0, |o| o.shapes.len()),
            });
            if let (Item::Use(u), true) = (item, n > MAX_SHAPES) {
                let message = format!(
                    "with this instance the scene has more than {MAX_SHAPES} shapes; join shapes to meshes"
                );
                self.report.error(u.at, message);
                return None;
            }
        }
        Some(n)
    }

    fn instantiate(&mut self, u: &Use, objects: &HashMap<String, Vec<ShapeDesc>>, out: &mut Vec<ShapeDesc>) {
        let Some(shapes) = objects.get(&u.name) else {
            let remedy = remedy(&u.name, objects.keys().map(String::as_str));
            self.report.error(u.at, format!("there is no object \"{}\"; {remedy}", u.name));
            return;
        };
        for shape in shapes {
            let to_world: Transform = u.to_world.then_first(&shape.to_world);
            out.push(ShapeDesc { to_world, ..shape.clone() });
        }
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

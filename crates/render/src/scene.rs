//! The compiled scene: immutable, shared by all threads, in flat arrays. It knows no file.

use sparrow_geometry::{Geometry, Hit, Ray, SurfacePoint};
use sparrow_math::Vec3;
use sparrow_mis::Mis;
use sparrow_scene::FloatTextureId;
use sparrow_spectra::{Spectrum, Wavelengths};

use crate::camera::Camera;
use crate::light::{LightSample, Lights, LitPoint, Target};
use crate::material::Material;
use crate::scatter::Scatter;
use crate::texture::{TextureContext, Textures};

/// A scene ready to be rendered.
#[derive(Debug)]
pub struct Scene {
    pub(crate) geometry: Geometry,
    /// Material of each shape of the geometry; none for surfaces that rays pass unchanged.
    pub(crate) material_of_shape: Vec<Option<u32>>,
    /// Cut-out texture of each shape.
    pub(crate) alpha_of_shape: Vec<Option<FloatTextureId>>,
    pub(crate) materials: Vec<Material>,
    pub(crate) textures: Textures,
    pub(crate) lights: Lights,
    pub(crate) camera: Camera,
    /// Some shape has a cut-out or is passed unchanged, so that hits must be asked about.
    pub(crate) asks_hits: bool,
    /// The camera or something in the scene moves.
    pub(crate) moves: bool,
    /// Distance between samples on the film, in pixels, for the width of texture filters.
    pub(crate) sample_spacing: f32,
    /// Some texture filter asks for that width.
    pub(crate) needs_footprint: bool,
}

/// The last vertex that scattered by a lobe that is no delta: what MIS compares with.
#[derive(Clone, Copy, Debug)]
pub struct LastVertex {
    /// Where it was.
    pub at: LitPoint,
    /// Density of the direction taken, in 1/sr; zero where it does not look for lights.
    pub pdf: f32,
}

impl Scene {
    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }
    /// The geometry.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }
    /// The lights.
    pub fn lights(&self) -> &Lights {
        &self.lights
    }
    /// The number of compiled materials.
    pub fn n_materials(&self) -> usize {
        self.materials.len()
    }
    /// Memory of geometry and images, in bytes.
    pub fn bytes(&self) -> usize {
        self.geometry.stats().bytes.total() + self.image_bytes()
    }
    /// Memory of images, in bytes.
    pub fn image_bytes(&self) -> usize {
        self.textures.bytes()
    }

    /// The nearest surface along a ray.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<SurfacePoint> {
        let hit = if self.asks_hits {
            self.geometry.intersect_where(ray, |h| self.is_there(ray, h))
        } else {
            self.geometry.intersect(ray)
        };
        hit.map(|h| self.geometry.surface(ray, &h))
    }

    /// Something blocks the ray before its end.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        if self.asks_hits {
            self.geometry.occluded_where(ray, |h| {
                self.material_of_shape[h.shape as usize].is_some() && self.is_there(ray, h)
            })
        } else {
            self.geometry.occluded(ray)
        }
    }

    /// Light that a ray found: from the surface `hit`, or from all around where it left the scene.
    ///
    /// Each light is weighted against the chance that light sampling at `last` would have found it; `found` is told what it
    /// sends and the weight, but of no light that this ray does not look for.
    pub fn emitted(
        &self,
        ray: &Ray,
        hit: Option<&SurfacePoint>,
        last: Option<&LastVertex>,
        mis: Mis,
        w: &Wavelengths,
        mut found: impl FnMut(Spectrum<f32>, f32),
    ) -> Spectrum<f32> {
        let Some(point) = hit else {
            return self.lights.infinite().iter().fold(Spectrum::ZERO, |sum, &light| {
                let place = self.lights.place_of(light, ray.d);
                let l = self.lights.escaped(light, place, w);
                let pdf = |at: &LitPoint| self.lights.pdf_of_escape(light, at, ray.d, place);
                sum + self.weighted((light, l), last, mis, pdf, &mut found)
            });
        };
        let Some(light) = self.lights.of_primitive(point.shape, point.prim) else { return Spectrum::ZERO };
        let l = self.lights.emitted(light, point, -ray.d, w);
        if l.is_black() {
            return l;
        }
        self.weighted((light, l), last, mis, |at| self.lights.pdf_of_point(&self.geometry, at, point), found)
    }

    /// What a ray found of one light, which is sampled from a point with density `pdf` where it is chosen.
    #[inline]
    pub(crate) fn weighted(
        &self,
        (light, l): (u32, Spectrum<f32>),
        last: Option<&LastVertex>,
        mis: Mis,
        pdf: impl FnOnce(&LitPoint) -> f32,
        mut found: impl FnMut(Spectrum<f32>, f32),
    ) -> Spectrum<f32> {
        let weight = match last {
            None => 1.0,
            Some(v) if v.pdf > 0.0 => {
                mis.bsdf_weight(v.pdf, self.lights.probability(&v.at, light) * pdf(&v.at))
            }
            Some(_) => return Spectrum::ZERO,
        };
        found(l, weight);
        l * weight
    }

    /// The reflection model at a point, turned to the world; none where rays pass unchanged.
    ///
    /// Ends the companion wavelengths where the index of refraction varies with wavelength.
    #[inline]
    pub fn scatter(&self, point: &SurfacePoint, w: &mut Wavelengths) -> Option<Scatter> {
        let material = &self.materials[self.material_of_shape[point.shape as usize]? as usize];
        if material.dispersive {
            w.terminate_secondary();
        }
        let ctx = self.texture_context_of(material, point);
        let h = fibre_offset(point.uv[1]);
        Some(Scatter::new(point, material.bind(&self.textures, &ctx, h, w)))
    }

    /// Chooses a light for a point and draws a direction towards it; the density includes the choice.
    #[inline]
    pub fn sample_light(
        &self,
        at: &LitPoint,
        choice: f32,
        u: [f32; 2],
        w: &Wavelengths,
    ) -> Option<LightSample> {
        let (light, probability) = self.lights.choose(at, choice)?;
        let s = self.lights.sample(&self.geometry, light, at, u, w)?;
        Some(LightSample { pdf: s.pdf * probability, ..s })
    }

    /// The light of a sample reaches the point.
    #[inline]
    pub fn unoccluded(&self, point: &SurfacePoint, s: &LightSample) -> bool {
        !self.occluded(&shadow_ray(point, s))
    }

    /// What [`intersect`](Self::intersect) finds for each of `rays`, into `hits`.
    pub(crate) fn intersect_many(&self, rays: &[Ray], hits: &mut Vec<Option<Hit>>) {
        hits.clear();
        hits.resize(rays.len(), None);
        if self.asks_hits {
            self.geometry.intersect_many_where(rays, hits, |i, h| self.is_there(&rays[i], h));
        } else {
            self.geometry.intersect_many(rays, hits);
        }
    }

    /// [`occluded`](Self::occluded) for each of `rays`, into as many places of `out`.
    pub(crate) fn occluded_many(&self, rays: &[Ray], out: &mut Vec<bool>) {
        out.clear();
        if self.asks_hits {
            out.extend(rays.iter().map(|ray| self.occluded(ray)));
            return;
        }
        out.resize(rays.len(), false);
        self.geometry.occluded_many(rays, out);
    }

    /// Shapes, lamps without a material among them.
    pub(crate) fn n_shapes(&self) -> usize {
        self.material_of_shape.len()
    }
    /// The material of a shape; none where rays pass unchanged.
    #[inline]
    pub(crate) fn material_of(&self, shape: u32) -> Option<u32> {
        self.material_of_shape[shape as usize]
    }
    /// The textures.
    pub(crate) fn textures(&self) -> &Textures {
        &self.textures
    }
    /// A compiled material.
    #[inline]
    pub(crate) fn material(&self, index: u32) -> &Material {
        &self.materials[index as usize]
    }

    /// Cut-outs: the hit counts with the probability that its alpha texture gives.
    fn is_there(&self, ray: &Ray, hit: &Hit) -> bool {
        let Some(alpha) = self.alpha_of_shape[hit.shape as usize] else { return true };
        let point = self.geometry.surface(ray, hit);
        let a = self.textures.float(alpha, &self.texture_context(&point, false));
        // Decided by a hash of ray and surface, so that the same ray always gets the same answer.
        a >= 1.0 || (a > 0.0 && hash_to_unit(ray, hit) < a)
    }

    /// What the material's textures need of the point.
    #[inline]
    pub(crate) fn texture_context_of(&self, material: &Material, point: &SurfacePoint) -> TextureContext {
        self.texture_context(point, material.textured && self.needs_footprint)
    }

    fn texture_context(&self, point: &SurfacePoint, footprint: bool) -> TextureContext {
        let mut ctx =
            TextureContext { p: point.p, uv: point.uv, dp: [Vec3::default(); 2], duv: [[0.0; 2]; 2] };
        if footprint {
            ctx.dp = self.camera.footprint(point.p, point.ns, self.sample_spacing);
            ctx.duv = ctx.dp.map(|dp| along_surface(point, dp));
        }
        ctx
    }
}

/// The ray from a point to where a light was sampled.
#[inline]
pub(crate) fn shadow_ray(point: &SurfacePoint, s: &LightSample) -> Ray {
    match &s.target {
        Target::Surface(on_light) => point.spawn_to_sample(on_light),
        Target::Point(p) => point.spawn_to(*p),
        Target::Infinity => point.spawn(s.wi),
    }
}

/// The ray's offset from the axis of a fibre, in radii: `2 v - 1`, as pbrt-v4 has it on any shape.
pub(crate) fn fibre_offset(v: f32) -> f32 {
    (2.0 * v - 1.0).clamp(-1.0, 1.0)
}

/// The change of (u, v) that comes nearest to moving the point by `dp`, by least squares.
fn along_surface(point: &SurfacePoint, dp: Vec3<f32>) -> [f32; 2] {
    let (du, dv) = (point.dpdu, point.dpdv);
    let (a, b, c) = (du.dot(du), du.dot(dv), dv.dot(dv));
    let det = a * c - b * b;
    if !(det.abs() > 1e-20) {
        return [0.0; 2];
    }
    let (x, y) = (du.dot(dp), dv.dot(dp));
    [(c * x - b * y) / det, (a * y - b * x) / det].map(|v| v.clamp(-1e8, 1e8))
}

/// A uniform number from a ray and the primitive it met.
fn hash_to_unit(ray: &Ray, hit: &Hit) -> f32 {
    let words = [ray.o.x, ray.o.y, ray.o.z, ray.d.x, ray.d.y, ray.d.z].map(f32::to_bits);
    let mut h = 0x9e37_79b9_7f4a_7c15_u64;
    for v in words.into_iter().chain([hit.shape, hit.prim]).chain(hit.instance) {
        h = (h ^ u64::from(v)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        h ^= h >> 32;
    }
    (h >> 40) as f32 / (1u64 << 24) as f32
}

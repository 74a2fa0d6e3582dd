//! Statements to a scene: [`Builder`].
//!
//! As in pbrt-v4, statements only collect while the files are read; textures, materials and names are resolved
//! when all is known, so that a shape may use a material that is defined behind it.

mod blocks;
mod camera;
mod curves;
mod files;
mod film;
mod finish;
mod graphics;
mod hair;
mod integrator;
mod lights;
mod materials;
mod mesh;
mod replace;
mod shapes;
mod spectrum;
mod statements;
mod textures;
mod world;

use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;

use sparrow_math::Transform;

use crate::desc::{AreaLightDesc, ColourMode, LightDesc};
use crate::diagnostic::Span;
use crate::params::Params;
use crate::report::Report;
use crate::tables::Entity;

use blocks::Block;
use graphics::Graphics;
use materials::PendingMaterial;
use mesh::PendingMeshes;
use replace::Replacement;
use shapes::{Object, PendingInstance, PendingShape};
use textures::{PendingTexture, Textures};

/// A statement before `WorldBegin`, checked; the last one of its kind counts.
#[derive(Debug)]
struct Statement {
    entity: &'static Entity,
    params: Params,
    /// The current transforms where it stands.
    ctm: [Transform; 2],
}

/// The statements before `WorldBegin`.
#[derive(Debug)]
struct Setup {
    camera: Option<Statement>,
    film: Option<Statement>,
    filter: Option<Statement>,
    sampler: Option<Statement>,
    integrator: Option<Statement>,
    seed: u64,
    colour: ColourMode,
    /// When motion starts and ends.
    transform_times: [f64; 2],
}

impl Default for Setup {
    fn default() -> Self {
        Setup {
            camera: None,
            film: None,
            filter: None,
            sampler: None,
            integrator: None,
            seed: 0,
            colour: ColourMode::Spectral,
            transform_times: [0.0, 1.0],
        }
    }
}

/// Takes statements and makes a [`SceneDesc`](crate::SceneDesc) of them.
#[derive(Debug)]
pub(crate) struct Builder {
    report: Report,
    /// Where relative paths start: the folder of the scene file, also for included files.
    base_dir: PathBuf,
    /// The files being read, outermost first, by their true paths.
    open_files: Vec<PathBuf>,
    n_includes: usize,
    statements: BTreeMap<&'static str, BTreeMap<String, usize>>,

    graphics: Graphics,
    blocks: Vec<Block>,
    /// `WorldBegin`, once it was read.
    world: Option<Span>,
    /// A statement that belongs behind `WorldBegin` stood before it; said once.
    said_before_world: bool,
    coordinate_systems: HashMap<String, [Transform; 2]>,

    setup: Setup,
    textures: Vec<PendingTexture>,
    materials: Vec<PendingMaterial>,
    named_materials: HashMap<Rc<str>, Span>,
    /// Materials that stand for named ones of the scene.
    replacements: Vec<Replacement>,
    media: HashMap<String, Span>,
    /// Uses of media by name, to be checked at the end.
    medium_uses: Vec<(String, Span)>,
    lights: Vec<LightDesc>,
    area_lights: Vec<AreaLightDesc>,
    /// Shapes outside of objects.
    shapes: Vec<PendingShape>,
    /// Objects in file order, and where each name's lies among them.
    objects: Vec<Object>,
    object_names: HashMap<Arc<str>, usize>,
    /// The object between `ObjectBegin` and `ObjectEnd`.
    open_object: Option<usize>,
    instances: Vec<PendingInstance>,

    /// Meshes that are still in files.
    meshes: PendingMeshes,
    spectra: spectrum::Cache,
    made: Textures,
}

impl Builder {
    /// An empty scene; relative paths start at `base_dir`.
    pub(crate) fn new(base_dir: PathBuf) -> Self {
        Builder {
            report: Report::default(),
            base_dir,
            open_files: Vec::new(),
            n_includes: 0,
            statements: BTreeMap::new(),
            graphics: Graphics::default(),
            blocks: Vec::new(),
            world: None,
            said_before_world: false,
            coordinate_systems: HashMap::new(),
            setup: Setup::default(),
            textures: Vec::new(),
            materials: Vec::new(),
            named_materials: HashMap::new(),
            replacements: Vec::new(),
            media: HashMap::new(),
            medium_uses: Vec::new(),
            lights: Vec::new(),
            area_lights: Vec::new(),
            shapes: Vec::new(),
            objects: Vec::new(),
            object_names: HashMap::new(),
            open_object: None,
            instances: Vec::new(),
            meshes: PendingMeshes::default(),
            spectra: spectrum::Cache::default(),
            made: Textures::default(),
        }
    }

    /// Counts a statement for [`SceneDesc::statements`](crate::SceneDesc::statements).
    fn count(&mut self, directive: &'static str, type_name: &str) {
        let types = self.statements.entry(directive).or_default();
        match types.get_mut(type_name) {
            Some(n) => *n += 1,
            None => {
                types.insert(type_name.to_string(), 1);
            }
        }
    }
}

//! What figures are made with: [`Studio`].

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use sparrow_render::{RenderOptions, RenderPlan, compile, render};
use sparrow_scene::{SamplerName, SceneDesc};

use crate::error::LectureError;
use crate::photo::Photo;
use crate::quality::Quality;
use crate::scenes::SCENES;

/// What figures are made with: the quality, and a folder of scenes that can be rendered.
#[derive(Debug)]
pub struct Studio<'a> {
    quality: Quality,
    scenes: PathBuf,
    stop: &'a AtomicBool,
}

impl<'a> Studio<'a> {
    /// Writes the lecture's scenes to the folder `scenes`, which is made where it is missing. `stop` ends the work.
    ///
    /// # Errors
    /// Where the folder cannot be written.
    pub fn new(quality: Quality, scenes: &Path, stop: &'a AtomicBool) -> Result<Studio<'a>, LectureError> {
        let studio = Studio { quality, scenes: scenes.to_path_buf(), stop };
        let file = |source| LectureError::File { path: scenes.to_path_buf(), source };
        std::fs::create_dir_all(scenes).map_err(file)?;
        SCENES.iter().try_for_each(|(name, text)| studio.lay(name, text))?;
        Ok(studio)
    }
    /// How much work goes into a figure.
    pub fn quality(&self) -> Quality {
        self.quality
    }
    /// [`Quality::pick`] of this studio's quality.
    pub fn pick<T>(&self, draft: T, last: T) -> T {
        self.quality.pick(draft, last)
    }
    /// Lays a file beside the scenes, such as strands that are generated; it becomes part of the book.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn lay(&self, name: &str, bytes: impl AsRef<[u8]>) -> Result<(), LectureError> {
        let path = self.path(name);
        if let Some(folder) = path.parent() {
            let file = |source| LectureError::File { path: folder.to_path_buf(), source };
            std::fs::create_dir_all(folder).map_err(file)?;
        }
        std::fs::write(&path, bytes).map_err(|source| LectureError::File { path, source })
    }
    /// Where a file of the folder lies: `lecture/plate.inc`.
    pub fn path(&self, name: &str) -> PathBuf {
        self.scenes.join(name)
    }
    /// Reads a scene of the folder: `lecture/plate-45.pbrt`.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn open(&self, scene: &str) -> Result<SceneDesc, LectureError> {
        sparrow_scene::read(&self.path(scene)).map_err(|e| fault(scene, &e))
    }
    /// Reads a scene, with other materials in the place of some of its named ones; see [`sparrow_scene::read_with_materials`].
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn open_with(&self, scene: &str, materials: &[String]) -> Result<SceneDesc, LectureError> {
        let path = self.path(scene);
        sparrow_scene::read_with_materials(&path, materials).map_err(|e| fault(scene, &e))
    }
    /// Renders a description, with `spp` samples per pixel.
    ///
    /// # Errors
    /// Where it cannot be rendered, or was stopped.
    pub fn take(&self, mut desc: SceneDesc, size: [u32; 2], spp: u32) -> Result<Photo, LectureError> {
        desc.film.resolution = size;
        desc.film.pixel_bounds = [0, size[0], 0, size[1]];
        desc.sampler.samples_per_pixel = spp;
        if desc.sampler.name == SamplerName::Stratified {
            desc.sampler.strata = [spp, 1];
        }
        let name = desc.files.first().map_or(String::new(), |f| f.display().to_string());
        let plan = RenderPlan::new(&desc).map_err(|e| fault(&name, &e.join("\n")))?;
        let scene = compile(desc).map_err(|e| fault(&name, &e))?.scene;
        let options = RenderOptions { threads: 0, variance: true, time_limit: None };
        let (film, _) = render(&scene, &plan, &options, self.stop, &|_| {}).map_err(|e| fault(&name, &e))?;
        self.go_on()?;
        let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        let views: Vec<_> = pixels.map(|(x, y)| film.pixel(x, y)).collect();
        Ok(Photo {
            size: size.map(|v| v as usize),
            rgb: views.iter().map(|p| p.rgb.map(|v| v as f32)).collect(),
            variance: views.iter().map(|p| p.variance.map(|v| v as f32)).collect(),
            camera: scene.camera().clone(),
        })
    }
    /// Reads and renders a scene.
    ///
    /// # Errors
    /// Where it cannot be read or rendered, or was stopped.
    pub fn render(&self, scene: &str, size: [u32; 2], spp: u32) -> Result<Photo, LectureError> {
        self.take(self.open(scene)?, size, spp)
    }
    /// Reads and renders a scene with another material in the place of one of its named ones.
    ///
    /// # Errors
    /// Where it cannot be read or rendered, or was stopped.
    pub fn render_with(
        &self,
        scene: &str,
        material: &str,
        size: [u32; 2],
        spp: u32,
    ) -> Result<Photo, LectureError> {
        self.take(self.open_with(scene, &[material.to_owned()])?, size, spp)
    }
    /// Nothing, unless the work is to end.
    ///
    /// # Errors
    /// [`LectureError::Interrupted`].
    pub fn go_on(&self) -> Result<(), LectureError> {
        if self.stop.load(Ordering::SeqCst) { Err(LectureError::Interrupted) } else { Ok(()) }
    }
}

fn fault(scene: &str, message: &dyn core::fmt::Display) -> LectureError {
    LectureError::Scene { scene: scene.to_owned(), message: message.to_string() }
}

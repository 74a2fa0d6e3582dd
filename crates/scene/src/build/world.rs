//! Statements with a type and parameters, and those with names alone.

use std::rc::Rc;

use super::graphics::Target;
use super::materials::{MaterialRef, PendingMaterial};
use super::textures::PendingTexture;
use super::{Builder, Setup, Statement};
use crate::check;
use crate::desc::ColourMode;
use crate::diagnostic::{Diagnostic, Span};
use crate::params::{Param, Params};
use crate::parser::Parser;
use crate::suggest::remedy;
use crate::tables::{Category, Entity, OPTIONS, OptionValue};
use sparrow_spectra::ColorSpace;

/// A type with its place.
type TypeName = (String, Span);

impl Builder {
    /// Reads a statement with a type and parameters; false where it is another statement.
    pub(super) fn entity_statement(
        &mut self,
        parser: &mut Parser<'_>,
        directive: &'static str,
        at: Span,
    ) -> Result<bool, Diagnostic> {
        let category = match directive {
            "Shape" => Category::Shape,
            "LightSource" => Category::Light,
            "AreaLightSource" => Category::AreaLight,
            "Material" | "MakeNamedMaterial" => Category::Material,
            "MakeNamedMedium" => Category::Medium,
            "Camera" => Category::Camera,
            "Film" => Category::Film,
            "PixelFilter" => Category::Filter,
            "Sampler" => Category::Sampler,
            "Integrator" => Category::Integrator,
            "Accelerator" => Category::Accelerator,
            "Texture" => {
                self.texture_statement(parser, at)?;
                return Ok(true);
            }
            _ => return Ok(false),
        };
        let name = parser.text()?;
        let params = self.read_params(parser, category, at);
        if matches!(directive, "MakeNamedMaterial" | "MakeNamedMedium") {
            let type_name = params.text("type").map_or("", |t| t.0).to_string();
            self.count(directive, &type_name);
        } else {
            self.count(directive, &name.0);
        }
        match directive {
            "MakeNamedMaterial" => self.make_named_material(name, params),
            "MakeNamedMedium" => self.make_named_medium(name, params),
            _ => self.entity(category, name, params),
        }
        Ok(true)
    }

    pub(super) fn read_params(&mut self, parser: &mut Parser<'_>, category: Category, at: Span) -> Params {
        let color_space = self.graphics.color_space;
        let mut broken = false;
        let own = parser.params(color_space, |d| {
            broken = true;
            self.report.push(d);
        });
        let target = match category {
            Category::Shape => Some(Target::Shape),
            Category::Light | Category::AreaLight => Some(Target::Light),
            Category::Material => Some(Target::Material),
            Category::Medium => Some(Target::Medium),
            Category::FloatTexture | Category::SpectrumTexture => Some(Target::Texture),
            Category::Camera | Category::Film | Category::Filter | Category::Sampler => None,
            Category::Integrator | Category::Accelerator => None,
        };
        let inherited = target.map_or_else(Rc::default, |t| self.graphics.inherited(t));
        Params { own, inherited, color_space, broken, at }
    }

    fn entity(&mut self, category: Category, (name, name_at): TypeName, params: Params) {
        if category == Category::Material {
            let index = self.materials.len();
            self.materials.push(PendingMaterial { name: None, type_name: name, type_at: name_at, params });
            // Index 0 is the default material.
            self.graphics.material = MaterialRef::Index(index as u32 + 1);
            return;
        }
        if category == Category::AreaLight && name.is_empty() {
            self.graphics.area_light = None;
            return;
        }
        let Some((entity, params)) = self.checked(category, (name, name_at), params) else { return };
        if category == Category::Shape {
            self.shape(entity, params);
        } else if category == Category::Light {
            self.light(entity, params);
        } else if category == Category::AreaLight {
            self.area_light(params);
        } else {
            self.setup(category, entity, params);
        }
    }

    /// Finds the type and checks the parameters against its table. `None` where there was a fault that makes
    /// others look as if they were there.
    pub(super) fn checked(
        &mut self,
        category: Category,
        (name, at): TypeName,
        mut params: Params,
    ) -> Option<(&'static Entity, Params)> {
        let entity = check::entity(&mut self.report, category, &name, at)?;
        let what = format!("{} \"{name}\"", category.noun());
        check::params(&mut self.report, category, &what, entity.rows(), &mut params);
        (!params.broken).then_some((entity, params))
    }

    fn setup(&mut self, category: Category, entity: &'static Entity, params: Params) {
        let ctm = self.graphics.ctm;
        if category == Category::Camera {
            self.coordinate_systems.insert("camera".into(), self.graphics.ctm.map(|t| t.inverse()));
        }
        // Sparrow has one acceleration structure; the statement that chooses has no bearing on the picture.
        if let Some(slot) = entity_slot(&mut self.setup, category) {
            *slot = Some(Statement { entity, params, ctm });
        }
    }

    fn make_named_material(&mut self, (name, name_at): TypeName, params: Params) {
        let params = self.replaced(&name).unwrap_or(params);
        let name: Rc<str> = name.into();
        let Some((type_name, type_at)) = params.text("type").map(|(t, at)| (t.to_string(), at)) else {
            let message =
                format!("the material \"{name}\" has no type; add \"string type\" \"diffuse\" or another");
            self.report.error(name_at, message);
            self.named_materials.insert(name, name_at);
            return;
        };
        if let Some(&first) = self.named_materials.get(&name) {
            let place = self.report.place(first);
            self.report
                .error(name_at, format!("the material \"{name}\" is defined already at {place}; rename one"));
            return;
        }
        self.named_materials.insert(Rc::clone(&name), name_at);
        self.materials.push(PendingMaterial { name: Some(name), type_name, type_at, params });
    }

    fn make_named_medium(&mut self, (name, name_at): TypeName, params: Params) {
        if let Some(&first) = self.media.get(&name) {
            let place = self.report.place(first);
            self.report
                .error(name_at, format!("the medium \"{name}\" is defined already at {place}; rename one"));
            return;
        }
        let type_name = params.text("type").map(|(t, at)| (t.to_string(), at));
        match type_name {
            Some(type_name) => {
                self.checked(Category::Medium, type_name, params);
            }
            None => {
                let message = format!(
                    "the medium \"{name}\" has no type; add \"string type\" \"homogeneous\" or another"
                );
                self.report.error(name_at, message);
            }
        }
        self.report.warn(name_at, "media are not rendered yet; light passes them unchanged");
        self.media.insert(name, name_at);
    }

    fn texture_statement(&mut self, parser: &mut Parser<'_>, at: Span) -> Result<(), Diagnostic> {
        let (name, name_at) = parser.text()?;
        let (class, class_at) = parser.text()?;
        let type_name = parser.text()?;
        let category = match class.as_str() {
            "float" => Category::FloatTexture,
            "spectrum" => Category::SpectrumTexture,
            _ => {
                let remedy =
                    if class == "color" { "write \"spectrum\"" } else { "write \"float\" or \"spectrum\"" };
                let message = format!("\"{class}\" is no class of texture; {remedy}");
                self.report.error(class_at, message);
                Category::SpectrumTexture
            }
        };
        let params = self.read_params(parser, category, at);
        self.count("Texture", &type_name.0);
        let to_world = self.standing("a texture", at);
        let earlier = self.textures.iter().find(|t| t.category == category && t.name == name);
        if let Some(first) = earlier.map(|t| t.name_at) {
            let place = self.report.place(first);
            let message =
                format!("the {} \"{name}\" is defined already at {place}; rename one", category.noun());
            self.report.error(name_at, message);
            return Ok(());
        }
        let Some((entity, params)) = self.checked(category, type_name, params) else {
            self.made.failed(category, name);
            return Ok(());
        };
        self.textures.push(PendingTexture { name, name_at, category, entity, params, to_world });
        Ok(())
    }

    /// Reads a statement with names alone; false where it is another statement.
    pub(super) fn name_statement(
        &mut self,
        parser: &mut Parser<'_>,
        directive: &'static str,
        at: Span,
    ) -> Result<bool, Diagnostic> {
        match directive {
            "NamedMaterial" => {
                let (name, at) = parser.text()?;
                self.graphics.material = MaterialRef::Named(name.into(), at);
            }
            "MediumInterface" => {
                let (inside, inside_at) = parser.text()?;
                let outside = parser.optional_text()?;
                self.medium_uses.push((inside, inside_at));
                self.medium_uses.extend(outside.map(|(name, at)| (name.into_owned(), at)));
            }
            "ColorSpace" => {
                let (name, at) = parser.text()?;
                match ColorSpace::from_name(&name) {
                    Some(space) => self.graphics.color_space = space,
                    None => {
                        let remedy = remedy(&name, ColorSpace::ALL.iter().map(|s| s.name()));
                        self.report.error(at, format!("there is no colour space \"{name}\"; {remedy}"));
                    }
                }
            }
            "Option" => self.option(parser, at)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn option(&mut self, parser: &mut Parser<'_>, at: Span) -> Result<(), Diagnostic> {
        let (name, name_at) = parser.text()?;
        let (value, is_quoted, value_at) = parser.option_value()?;
        let key: String = name.chars().filter(|c| !matches!(c, '-' | '_')).collect::<String>().to_lowercase();
        let Some(&(_, kind)) = OPTIONS.iter().find(|(n, _)| *n == key) else {
            let remedy = remedy(&name, OPTIONS.iter().map(|o| o.0));
            self.report.error(name_at, format!("there is no option \"{name}\"; {remedy}"));
            return Ok(());
        };
        let wants = match kind {
            OptionValue::Seed => match value.parse::<i64>() {
                Ok(seed) if !is_quoted => {
                    // A negative seed is as good as any other.
                    self.setup.seed = seed as u64;
                    return Ok(());
                }
                Ok(_) | Err(_) => "a whole number",
            },
            OptionValue::Colour => match value.as_str() {
                "spectral" if is_quoted => {
                    self.setup.colour = ColourMode::Spectral;
                    return Ok(());
                }
                "rgb" if is_quoted => {
                    self.setup.colour = ColourMode::Rgb;
                    return Ok(());
                }
                _ => "\"spectral\" or \"rgb\"",
            },
            OptionValue::Flag | OptionValue::MootFlag => match (value.as_str(), kind) {
                ("true", OptionValue::Flag) => {
                    self.report
                        .warn(at, format!("the option \"{name}\" is not supported yet; it is ignored"));
                    return Ok(());
                }
                ("true" | "false", _) => return Ok(()),
                _ => "`true` or `false`",
            },
            OptionValue::MootNumber if value.parse::<f64>().is_ok() => return Ok(()),
            OptionValue::MootText if is_quoted => return Ok(()),
            OptionValue::MootNumber => "a number",
            OptionValue::MootText => "a string in quotes",
        };
        self.report.error(value_at, format!("the option \"{name}\" takes {wants}; write one"));
        Ok(())
    }

    /// Looks whether any statement of an `Attribute`'s target takes such a parameter.
    pub(super) fn check_attribute(&mut self, target: Target, p: &Param) {
        let categories: &[Category] = match target {
            Target::Shape => &[Category::Shape],
            Target::Light => &[Category::Light, Category::AreaLight],
            Target::Material => &[Category::Material],
            Target::Medium => &[Category::Medium],
            Target::Texture => &[Category::FloatTexture, Category::SpectrumTexture],
        };
        let mut rows = categories.iter().flat_map(|c| c.entities()).flat_map(|e| e.rows());
        if rows.any(|r| r.name == p.name && r.kind.types().contains(&p.ty)) {
            return;
        }
        let noun = categories[0].noun();
        let message = format!("no {noun} takes a parameter \"{} {}\"; it has no effect", p.ty.name(), p.name);
        self.report.warn(p.at, message);
    }
}

/// Where a statement before `WorldBegin` is kept.
fn entity_slot(setup: &mut Setup, category: Category) -> Option<&mut Option<Statement>> {
    let slots = [
        (Category::Camera, &mut setup.camera),
        (Category::Film, &mut setup.film),
        (Category::Filter, &mut setup.filter),
        (Category::Sampler, &mut setup.sampler),
        (Category::Integrator, &mut setup.integrator),
    ];
    slots.into_iter().find(|(c, _)| *c == category).map(|(_, slot)| slot)
}

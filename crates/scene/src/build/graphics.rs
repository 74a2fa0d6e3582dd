//! What `AttributeBegin` saves: transforms and the current attributes, [`Graphics`].

use std::rc::Rc;

use sparrow_math::{Motion, Transform, vec3};
use sparrow_spectra::ColorSpace;

use super::Builder;
use super::materials::MaterialRef;
use crate::desc::AreaLightId;
use crate::diagnostic::{Diagnostic, Span};
use crate::params::Param;
use crate::parser::Parser;

/// Parameters set by `Attribute`, shared between the states that hold them.
type Inherited = Rc<Vec<Rc<Param>>>;

/// What `Attribute` may set parameters for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    Shape,
    Light,
    Material,
    Medium,
    Texture,
}

impl Target {
    pub(super) const ALL: [(&'static str, Target); 5] = [
        ("shape", Target::Shape),
        ("light", Target::Light),
        ("material", Target::Material),
        ("medium", Target::Medium),
        ("texture", Target::Texture),
    ];
}

/// The graphics state.
#[derive(Clone, Debug)]
pub(super) struct Graphics {
    /// Object to world, where motion starts and where it ends.
    pub(super) ctm: [Transform; 2],
    /// Which of the two transform statements act on.
    pub(super) active: [bool; 2],
    pub(super) reverse_orientation: bool,
    pub(super) color_space: ColorSpace,
    pub(super) material: MaterialRef,
    pub(super) area_light: Option<AreaLightId>,
    inherited: [Inherited; 5],
}

impl Default for Graphics {
    fn default() -> Self {
        Graphics {
            ctm: [Transform::IDENTITY; 2],
            active: [true; 2],
            reverse_orientation: false,
            color_space: ColorSpace::Srgb,
            material: MaterialRef::Index(0),
            area_light: None,
            inherited: Default::default(),
        }
    }
}

impl Graphics {
    /// What `Attribute` set for a kind of statement.
    pub(super) fn inherited(&self, target: Target) -> Inherited {
        Rc::clone(&self.inherited[target as usize])
    }
    /// Adds to what `Attribute` set.
    pub(super) fn inherit(&mut self, target: Target, params: Vec<Param>) {
        let list = Rc::make_mut(&mut self.inherited[target as usize]);
        list.extend(params.into_iter().map(Rc::new));
    }
}

impl Builder {
    /// The current transform of something that cannot move: where motion starts.
    pub(super) fn standing(&mut self, what: &str, at: Span) -> Transform {
        let [start, end] = self.graphics.ctm;
        if start != end {
            self.report.warn(at, format!("{what} cannot move; it stands where motion starts"));
        }
        start
    }

    /// The current transform of something that may move, and the one where its motion ends.
    pub(super) fn moving(&mut self, at: Span) -> (Transform, Option<Transform>) {
        let [start, end] = self.graphics.ctm;
        if start == end {
            return (start, None);
        }
        if Motion::new(&start, &end).is_none() {
            let message = "only one of the two transforms between which this moves mirrors space: in between it would be flat; \
                           mirror both or none";
            self.report.error(at, message);
        }
        (start, Some(end))
    }

    /// Reads a statement that changes the transform; false where it is another statement.
    pub(super) fn transform_statement(
        &mut self,
        parser: &mut Parser<'_>,
        directive: &'static str,
        at: Span,
    ) -> Result<bool, Diagnostic> {
        match directive {
            "Identity" => self.each_active(at, directive, |_| Some(Transform::IDENTITY)),
            "Translate" => {
                let [x, y, z] = parser.numbers()?;
                self.concat(at, directive, Some(Transform::translate(vec3(x, y, z))));
            }
            "Scale" => {
                let [x, y, z] = parser.numbers()?;
                self.concat(at, directive, Transform::scale(vec3(x, y, z)));
            }
            "Rotate" => {
                let [angle, x, y, z] = parser.numbers()?;
                self.concat(at, directive, Transform::rotate(angle, vec3(x, y, z)));
            }
            "LookAt" => {
                let [ex, ey, ez, x, y, z, ux, uy, uz] = parser.numbers()?;
                self.concat(
                    at,
                    directive,
                    Transform::look_at(vec3(ex, ey, ez), vec3(x, y, z), vec3(ux, uy, uz)),
                );
            }
            "Transform" => {
                let t = from_columns(&parser.matrix()?);
                self.each_active(at, directive, |_| t);
            }
            "ConcatTransform" => {
                let t = from_columns(&parser.matrix()?);
                self.concat(at, directive, t);
            }
            "ReverseOrientation" => {
                self.graphics.reverse_orientation = !self.graphics.reverse_orientation;
            }
            "CoordinateSystem" => {
                let (name, _) = parser.text()?;
                self.coordinate_systems.insert(name, self.graphics.ctm);
            }
            "CoordSysTransform" => self.recall(parser)?,
            "ActiveTransform" => self.activate(parser)?,
            "TransformTimes" => {
                let [start, end]: [f64; 2] = parser.numbers()?;
                if end <= start {
                    let message = format!("motion starts at {start} and ends at {end}; let it end later");
                    self.report.error(at, message);
                }
                self.setup.transform_times = [start, end];
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn recall(&mut self, parser: &mut Parser<'_>) -> Result<(), Diagnostic> {
        let (name, at) = parser.text()?;
        match self.coordinate_systems.get(&name) {
            Some(ctm) => self.graphics.ctm = *ctm,
            None => {
                let remedy =
                    crate::suggest::remedy(&name, self.coordinate_systems.keys().map(String::as_str));
                self.report.error(at, format!("there is no coordinate system \"{name}\"; {remedy}"));
            }
        }
        Ok(())
    }

    fn activate(&mut self, parser: &mut Parser<'_>) -> Result<(), Diagnostic> {
        let (word, at) = parser.word()?;
        self.graphics.active = match word {
            "All" => [true, true],
            "StartTime" => [true, false],
            "EndTime" => [false, true],
            _ => {
                let message = format!("`{word}` is no transform; write `All`, `StartTime` or `EndTime`");
                return Err(Diagnostic::error(at, message));
            }
        };
        Ok(())
    }

    fn concat(&mut self, at: Span, directive: &str, t: Option<Transform>) {
        self.each_active(at, directive, |ctm| t.map(|t| ctm.then_first(&t)));
    }

    fn each_active(&mut self, at: Span, directive: &str, f: impl Fn(&Transform) -> Option<Transform>) {
        for i in 0..2 {
            if !self.graphics.active[i] {
                continue;
            }
            let finite = |t: &Transform| t.rows().iter().flatten().all(|v| v.is_finite());
            match f(&self.graphics.ctm[i]).filter(|t| finite(t) && finite(&t.inverse())) {
                Some(t) => self.graphics.ctm[i] = t,
                None => {
                    self.report.error(at, singular(directive));
                    return;
                }
            }
        }
    }
}

fn singular(directive: &str) -> String {
    let remedy = match directive {
        "Scale" => "a factor is zero, too small or too large; change it",
        "Rotate" => "its axis has no length; give an axis that is not zero",
        "LookAt" => {
            "the eye, the point looked at and the up vector span no frame; move one of them off the line of the others"
        }
        _ => "it flattens space; give a matrix with an inverse",
    };
    format!("`{directive}` gives a transform without an inverse: {remedy}")
}

/// Scene files list the matrix column by column.
fn from_columns(m: &[f64; 16]) -> Option<Transform> {
    Transform::from_rows(std::array::from_fn(|row| std::array::from_fn(|column| m[4 * column + row])))
}

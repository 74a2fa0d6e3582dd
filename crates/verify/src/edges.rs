//! The edges of a formula: directions at grazing, normal, equal, opposite; uniform numbers at 0 and just below 1.

use sparrow_math::{LocalDir, Real, vec3};

use crate::column::{Column, Dir};
use crate::comparison::{fair, show};
use crate::question::{ColumnName, Question};
use crate::report::Finding;
use crate::tally::sound;

/// Cosines of the views, on both sides.
const COSINES: [f64; 5] = [1.0, 0.3, 1e-3, 1e-4, 1e-7];

/// Asks every column for values and samples at the edges; one finding each.
pub(crate) fn ask(columns: &[Box<dyn Column>], findings: &mut Vec<Finding>) {
    for column in columns {
        let name = column.name();
        let wrong = COSINES
            .into_iter()
            .flat_map(|z| [z, -z])
            .find_map(|z| values(&**column, z).or_else(|| samples(&**column, z)));
        let severity = if wrong.is_some() { f64::INFINITY } else { 0.0 };
        findings.push(Finding::new(Question::Finite, name, severity, wrong.unwrap_or_default()));
    }
}

fn view(z: f64, phi: f64) -> Dir {
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (s, c) = Real::sin_cos(phi);
    LocalDir::new(vec3(r * c, r * s, z))
}

fn values(column: &dyn Column, z: f64) -> Option<String> {
    let mut pairs = Vec::new();
    for phi in [0.0, 0.6] {
        let wo = view(z, phi);
        let mirror = LocalDir::new(vec3(-wo.x(), -wo.y(), wo.z()));
        let up = LocalDir::new(vec3(0.0, 0.0, 1.0));
        let (along, aside) = (LocalDir::new(vec3(1.0, 0.0, 0.0)), LocalDir::new(vec3(0.0, 1.0, 0.0)));
        for wi in [wo, mirror, -wo, -mirror, up, -up, along, -along, aside, view(1e-7, 2.0), view(-1e-4, 4.0)]
        {
            pairs.push([wo, wi]);
        }
    }
    let mut values = Vec::new();
    column.eval(&pairs, &mut values);
    let bad = pairs.iter().zip(&values).find(|(_, v)| !fair(v));
    bad.map(|(p, v)| format!("{v:?} at wo {}, wi {}", show(p[0]), show(p[1])))
}

fn samples(column: &dyn Column, z: f64) -> Option<String> {
    let last = match column.name() {
        ColumnName::F64 => 1.0 - f64::EPSILON / 2.0,
        ColumnName::F32 | ColumnName::Lanes => f64::from(sparrow_math::ONE_MINUS_EPSILON),
    };
    let ends = [0.0, 0.5, last];
    let mut u = Vec::new();
    for a in ends {
        for b in ends {
            u.extend(ends.map(|c| [a, b, c]));
        }
    }
    let wo = view(z, 0.4);
    let mut drawn = Vec::new();
    column.sample(wo, &u, &mut drawn);
    let bad = u.iter().zip(&drawn).find(|(_, s)| {
        let numbers = s.weight.iter().chain([&s.density]);
        // What ends the path is not looked at by renderers, but a NaN there may still spread.
        if s.valid { !sound(s, column.name()) } else { numbers.into_iter().any(|v| !v.is_finite()) }
    });
    bad.map(|(u, s)| format!("{s:?} at wo {}, u {u:?}", show(wo)))
}

//! The words of a command to series: [`parse_series`].

use sparrow_models::suggest::remedy;
use sparrow_models::{FibreKind, ModelKind, ParamInfo, ParamKind};

use crate::draw::theme::MAX_SERIES;
use crate::error::{Fault, PlotError};
use crate::series::{Family, Series, meaning, targets};

/// A value as written, and as the number that a model gets.
type Value = (String, f64);

/// One model and the lists of values that were given for it.
struct Wish<K> {
    kind: Option<K>,
    lists: Vec<(String, Vec<Value>)>,
}

/// The words name a model of a fibre, so that they are for [`parse_series`] of fibres.
pub fn names_a_fibre(words: &[String]) -> bool {
    words.iter().any(|w| FibreKind::from_name(w).is_some())
}

/// Series from words: `MODEL NAME=VALUE,.. .. + MODEL .. wo=THETA,PHI`.
///
/// A name is that of a parameter, or the common stem of one along and one across the grain. Values parted by commas make
/// one series each; several lists make one for every combination. A `+` begins another model. `wo` is the direction
/// towards the viewer in degrees, for all models; given again, each view makes series of its own. Spectra take
/// one number, for all wavelengths. Fibres take `h=OFFSET`, where rays meet them, too; without, their mean over the width is meant.
///
/// # Errors
/// All that is wrong with the words: unknown models, parameters and choices, values that are no numbers or out of range,
/// nothing to plot, too many series.
pub fn parse_series<K: Family>(words: &[String]) -> Result<Vec<Series<K>>, PlotError> {
    let mut faults = Vec::new();
    let mut views: Vec<[f64; 2]> = Vec::new();
    let mut wishes: Vec<Wish<K>> = Vec::new();
    let mut expects_model = true;
    for (i, word) in words.iter().enumerate() {
        let mut fault = |message: String| faults.push(Fault::at(i + 1, word, message));
        if word == "+" {
            if expects_model {
                fault("a model has to stand before `+`; name one".to_owned());
            }
            expects_model = true;
        } else if let Some(view) = word.strip_prefix("wo=") {
            match parse_view::<K>(view) {
                Ok(v) => views.push(v),
                Err(e) => fault(e),
            }
        } else if expects_model {
            expects_model = false;
            let kind = K::ALL.iter().copied().find(|k| k.name() == word);
            if kind.is_none() {
                fault(unknown_model::<K>(word));
            }
            wishes.push(Wish { kind, lists: Vec::new() });
        } else if let Some(wish) = wishes.last_mut()
            && let Err(message) = wish.add(word)
        {
            fault(message);
        }
    }
    if wishes.is_empty() {
        faults.push(Fault { word: None, message: "there is no model to plot; name one".to_owned() });
    } else if expects_model {
        faults.push(Fault::at(words.len(), "+", "a model has to follow `+`; name one"));
    }
    if views.is_empty() {
        views.push([K::VIEW, 0.0]);
    }
    let n: usize = wishes.iter().map(Wish::count).sum::<usize>().saturating_mul(views.len());
    if n > MAX_SERIES {
        let message = format!(
            "these are {n} series, and no more than {MAX_SERIES} can be told apart; give fewer values"
        );
        faults.push(Fault { word: None, message });
    }
    if !faults.is_empty() {
        return Err(PlotError { faults });
    }
    Ok(wishes
        .iter()
        .flat_map(Wish::series)
        .flat_map(|s| views.iter().map(move |v| Series { wo_deg: *v, ..s.clone() }))
        .collect())
}

fn unknown_model<K: Family>(word: &str) -> String {
    if word.contains('=') {
        return "a model has to come first; put its name before its parameters".to_owned();
    }
    if ModelKind::from_name(word).is_some() {
        return "this is a model of a surface, and the others are of fibres; plot them apart".to_owned();
    }
    let all = ModelKind::all().map(ModelKind::name);
    let own: Vec<&str> = if K::FIBRES { K::ALL.iter().map(|k| k.name()).collect() } else { all.collect() };
    format!("there is no model of this name; {}", remedy(word, own))
}

fn parse_view<K: Family>(text: &str) -> Result<[f64; 2], String> {
    let form = if K::FIBRES {
        "give THETA or THETA,PHI in degrees, THETA the inclination between -90 and 90"
    } else {
        "give THETA or THETA,PHI in degrees, THETA from 0 up to but not 90 for a view from above, above 90 and up to 180 \
         for one from below"
    };
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|v| v.trim().parse::<f64>()).collect();
    let view = match numbers.as_deref() {
        Ok([theta]) => [*theta, 0.0],
        Ok([theta, phi]) => [*theta, *phi],
        _ => return Err(form.to_owned()),
    };
    let theta = view[0];
    let sound = match K::FIBRES {
        true => theta.abs() < 90.0 - 1e-3,
        false => (0.0..=180.0).contains(&theta) && (theta - 90.0).abs() > 1e-3,
    };
    if sound && view[1].abs() <= 360.0 { Ok(view) } else { Err(form.to_owned()) }
}

impl<K: Family> Wish<K> {
    /// Adds `NAME=VALUE,..`; nothing is checked for a model that is not known.
    fn add(&mut self, word: &str) -> Result<(), String> {
        let Some((name, values)) = word.split_once('=') else {
            return Err("write parameters as NAME=VALUE, and `+` before a further model".to_owned());
        };
        let Some(kind) = self.kind else { return Ok(()) };
        let Some(info) = meaning(kind, name) else {
            return Err(format!("{} has no parameter `{name}`; {}", kind.name(), remedy(name, known(kind))));
        };
        if let Some((other, _)) = self.lists.iter().find(|(n, _)| overlap(kind, n, name)) {
            return Err(format!("`{other}` has set this already; leave one of them out"));
        }
        let values: Result<Vec<Value>, String> =
            values.split(',').map(|v| parse_value(info, v.trim())).collect();
        self.lists.push((name.to_owned(), values?));
        Ok(())
    }

    fn count(&self) -> usize {
        self.lists.iter().fold(1, |n, (_, values)| n.saturating_mul(values.len()))
    }

    /// One series for every combination of values; the last list runs fastest.
    fn series(&self) -> Vec<Series<K>> {
        let Some(kind) = self.kind else { return Vec::new() };
        let mut all = vec![Series::new(kind)];
        for (name, values) in &self.lists {
            let with = |s: &Series<K>, (text, value): &Value| {
                let mut s = s.clone();
                s.set(name, *value);
                s.pins.push((name.clone(), text.clone()));
                s
            };
            all = all.iter().flat_map(|s| values.iter().map(move |v| with(s, v))).collect();
        }
        all
    }
}

/// Both names set a parameter in common.
fn overlap<K: Family>(kind: K, a: &str, b: &str) -> bool {
    let others = targets(kind, b);
    a == b || targets(kind, a).iter().any(|t| others.contains(t))
}

/// Every name that can be set: the parameters, and the stems of pairs.
fn known<K: Family>(kind: K) -> Vec<&'static str> {
    let names = kind.params().iter().map(|p| p.name);
    let stems = names.clone().filter_map(|n| n.strip_suffix("_x")).filter(|s| targets(kind, s).len() == 2);
    let offset = K::FIBRES.then_some("h");
    stems.chain(names).chain(offset).collect()
}

/// One value of a parameter.
fn parse_value(info: &ParamInfo, text: &str) -> Result<Value, String> {
    if let ParamKind::Choice(names) = info.kind {
        return match names.iter().position(|n| *n == text) {
            Some(place) => Ok((text.to_owned(), place as f64)),
            None => {
                Err(format!("`{}` cannot be `{text}`; {}", info.name, remedy(text, names.iter().copied())))
            }
        };
    }
    let [lo, hi] = info.range;
    let value: f64 = text.parse().map_err(|_| format!("`{text}` is no number; give one{}", range(info)))?;
    if value.is_finite() && value >= lo && value <= hi {
        Ok((text.to_owned(), value))
    } else {
        Err(format!("`{}` cannot be {text}; give a number{}", info.name, range(info)))
    }
}

fn range(info: &ParamInfo) -> String {
    let [lo, hi] = info.range;
    let unit = if info.unit == "1" { String::new() } else { format!(" {}", info.unit) };
    if hi.is_finite() { format!(" from {lo} to {hi}{unit}") } else { format!(" of at least {lo}{unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_models::SurfaceKind;

    fn parse<K: Family>(text: &str) -> Result<Vec<Series<K>>, PlotError> {
        parse_series(&text.split_whitespace().map(String::from).collect::<Vec<_>>())
    }

    #[test]
    fn lists_make_series() {
        let s = parse::<SurfaceKind>("conductor alpha=0.1,0.3 k=2,3,4 + lambert wo=60,20").unwrap();
        assert_eq!(s.len(), 7);
        assert_eq!(s[1].name(), "conductor alpha=0.1 k=3");
        assert!(
            (s[5].params.reals[1] - 0.3).abs() < 1e-15 && (s[5].params.spectra[1][2] - 4.0).abs() < 1e-15
        );
        assert!(s.iter().all(|s| s.wo_deg.map(|d| d as i32) == [60, 20]));
        assert_eq!(parse::<SurfaceKind>("lambert wo=0 wo=30 wo=60").unwrap().len(), 3);
    }

    #[test]
    fn all_faults_are_told_at_once() {
        let e = parse::<SurfaceKind>("conductor alpah=0.1 k=x,2 + lambret reflectance=7 wo=90").unwrap_err();
        let places: Vec<_> = e.faults.iter().map(|f| f.word.as_ref().map_or(0, |w| w.0)).collect();
        assert_eq!(places, [2, 3, 5, 7], "{e}");
        assert!(
            e.to_string().contains("did you mean \"alpha\"?") && e.to_string().contains("\"lambert\"?"),
            "{e}"
        );
    }

    #[test]
    fn each_fault_has_its_sentence() {
        for (words, part) in [
            ("", "no model to plot"),
            ("+ lambert", "before `+`"),
            ("lambert +", "follow `+`"),
            ("lambert phong", "NAME=VALUE"),
            ("reflectance=0.5", "has to come first"),
            ("lambert reflectance=1.5", "from 0 to 1"),
            ("lambert reflectance=nan", "from 0 to 1"),
            ("lambert reflectance=", "is no number"),
            ("conductor k=-1", "at least 0"),
            ("conductor alpha=0.1 alpha_x=0.2", "already"),
            ("ward form=dur", "did you mean \"duer\"?"),
            ("lambert wo=10,20,30", "degrees"),
            ("phong exponent=1,2,3,4,5 diffuse=0,0.1,0.2,0.3,0.4", "25 series"),
        ] {
            let e = parse::<SurfaceKind>(words).unwrap_err();
            assert!(e.to_string().contains(part), "`{words}`: {e}");
        }
    }

    #[test]
    fn fibres_take_offsets_and_inclinations_and_stand_alone() {
        let s = parse::<FibreKind>("hair h=-0.5,0.5 beta_n=0.1 + deon wo=-40,30").unwrap();
        assert_eq!(s.len(), 3);
        assert!(s[0].h == Some(-0.5) && s[2].h.is_none() && (s[2].wo_deg[0] + 40.0).abs() < 1e-15);
        for (words, part) in [
            ("hair + lambert", "plot them apart"),
            ("hair h=2", "from -1 to 1"),
            ("hair h=0 h=1", "already"),
            ("hair wo=90", "inclination"),
            ("hiar", "did you mean \"hair\"?"),
        ] {
            let e = parse::<FibreKind>(words).unwrap_err();
            assert!(e.to_string().contains(part), "`{words}`: {e}");
        }
    }
}

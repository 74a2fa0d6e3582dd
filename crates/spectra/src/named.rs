//! Spectra a scene can call by name: metals, glasses, illuminants.

use std::collections::HashMap;
use std::sync::OnceLock;

use crate::{DenseSpectrum, cie};

/// The names [`named_spectrum`] knows, in the spelling of pbrt-v4, grouped by kind.
const NAMES: [&str; 40] = [
    "glass-BK7",
    "glass-BAF10",
    "glass-FK51A",
    "glass-LASF9",
    "glass-F5",
    "glass-F10",
    "glass-F11",
    "glass-SF5",
    "glass-SF10",
    "glass-SF11",
    "metal-Ag-eta",
    "metal-Ag-k",
    "metal-Al-eta",
    "metal-Al-k",
    "metal-Au-eta",
    "metal-Au-k",
    "metal-Cu-eta",
    "metal-Cu-k",
    "metal-CuZn-eta",
    "metal-CuZn-k",
    "metal-MgO-eta",
    "metal-MgO-k",
    "metal-TiO2-eta",
    "metal-TiO2-k",
    "stdillum-A",
    "stdillum-D50",
    "stdillum-D65",
    "stdillum-F1",
    "stdillum-F2",
    "stdillum-F3",
    "stdillum-F4",
    "stdillum-F5",
    "stdillum-F6",
    "stdillum-F7",
    "stdillum-F8",
    "stdillum-F9",
    "stdillum-F10",
    "stdillum-F11",
    "stdillum-F12",
    "illum-acesD60",
];

/// Sellmeier coefficients `B_1, C_1, B_2, C_2, B_3, C_3`, `C` in square micrometres, of Schott's lead-free
/// glasses: refractiveindex.info (CC0), after Schott's catalogue of 2017.
const GLASSES: [(&str, [f64; 6]); 7] = [
    ("glass-BK7", [1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653]),
    ("glass-BAF10", [1.5851495, 0.00926681282, 0.143559385, 0.0424489805, 1.08521269, 105.613573]),
    ("glass-FK51A", [0.971247817, 0.00472301995, 0.216901417, 0.0153575612, 0.904651666, 168.68133]),
    ("glass-LASF9", [2.00029547, 0.0121426017, 0.298926886, 0.0538736236, 1.80691843, 156.530829]),
    ("glass-SF5", [1.52481889, 0.011254756, 0.187085527, 0.0588995392, 1.42729015, 129.141675]),
    ("glass-SF10", [1.62153902, 0.0122241457, 0.256287842, 0.0595736775, 1.64447552, 147.468793]),
    ("glass-SF11", [1.73759695, 0.013188707, 0.313747346, 0.0623068142, 1.89878101, 155.23629]),
];

/// The spectrum of that name, or `None` for a name not in [`spectrum_names`].
///
/// * `glass-*`: index of refraction. pbrt-v4 calls the glasses SF5, SF10 and SF11 `F5`, `F10`, `F11`;
///   both spellings are understood.
/// * `metal-*-eta`, `metal-*-k`: complex index of refraction. Where a table ends inside 360 to 830 nm
///   (MgO at 768 nm) its last value holds on; pbrt-v4 falls to zero there.
/// * `stdillum-*`, `illum-acesD60`: scaled as in pbrt-v4, to the luminance of a constant spectrum of one
///   ([`xyz_of`](crate::xyz_of) gives Y = 1); the fluorescent F series is zero outside 380 to 780 nm.
pub fn named_spectrum(name: &str) -> Option<DenseSpectrum> {
    library().get(name).cloned()
}

/// Every name that [`named_spectrum`] answers.
pub fn spectrum_names() -> &'static [&'static str] {
    &NAMES
}

/// A named spectrum that is part of the library; black should it be missing, which a test rules out.
pub(crate) fn builtin(name: &str) -> &'static DenseSpectrum {
    static BLACK: OnceLock<DenseSpectrum> = OnceLock::new();
    library().get(name).unwrap_or_else(|| BLACK.get_or_init(|| DenseSpectrum::constant(0.0)))
}

fn library() -> &'static HashMap<&'static str, DenseSpectrum> {
    static LIBRARY: OnceLock<HashMap<&str, DenseSpectrum>> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        let mut all = HashMap::new();
        for (name, b) in GLASSES {
            all.insert(name, DenseSpectrum::from_fn(|l| sellmeier(&b, f64::from(l) * 1e-3)));
        }
        for (alias, name) in
            [("glass-F5", "glass-SF5"), ("glass-F10", "glass-SF10"), ("glass-F11", "glass-SF11")]
        {
            if let Some(s) = all.get(name).cloned() {
                all.insert(alias, s);
            }
        }
        for (name, samples) in tables(include_str!("data/metals.txt")) {
            all.insert(name, held(samples));
        }
        for (name, samples) in tables(include_str!("data/illuminants.txt")) {
            let s = DenseSpectrum::from_samples(&samples);
            let y = cie::photometric(&s);
            all.insert(name, s.scaled(cie::Y_INTEGRAL / y));
        }
        all
    })
}

/// Index of refraction at `um` micrometres.
fn sellmeier(b: &[f64; 6], um: f64) -> f32 {
    let l2 = um * um;
    let terms: f64 = b.chunks_exact(2).map(|bc| bc[0] * l2 / (l2 - bc[1])).sum();
    (1.0 + terms).sqrt() as f32
}

/// The polyline with its end values held on both sides.
fn held(mut samples: Vec<(f32, f32)>) -> DenseSpectrum {
    if let (Some(first), Some(last)) = (samples.first().copied(), samples.last().copied()) {
        samples.insert(0, (0.0, first.1));
        samples.push((f32::MAX, last.1));
    }
    DenseSpectrum::from_samples(&samples)
}

/// Reads the format of the data folder: `#` comments, `@name`, then (wavelength, value) pairs.
pub(crate) fn tables(text: &str) -> Vec<(&str, Vec<(f32, f32)>)> {
    let mut out: Vec<(&str, Vec<(f32, f32)>)> = Vec::new();
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        if let Some(name) = line.strip_prefix('@') {
            out.push((name, Vec::new()));
        } else if let Some((_, samples)) = out.last_mut() {
            let mut words = line.split_ascii_whitespace().map_while(|w| w.parse().ok());
            while let (Some(l), Some(v)) = (words.next(), words.next()) {
                samples.push((l, v));
            }
        }
    }
    out
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "parsing is exact")]
mod tests {
    use super::*;
    use crate::xyz_of;

    #[test]
    fn every_name_is_answered_with_sane_values() {
        for name in spectrum_names() {
            let s = named_spectrum(name).unwrap_or_else(|| panic!("{name} is listed but missing"));
            let (lo, hi) = s.values().iter().fold((f32::MAX, f32::MIN), |(a, b), &v| (a.min(v), b.max(v)));
            let range = match name.split('-').collect::<Vec<_>>()[..] {
                ["glass", _] => 1.45..2.1,
                ["metal", "TiO2", "eta"] => 2.7..3.9,
                ["metal", _, "eta"] => 0.1..3.0,
                ["metal", _, "k"] => 0.0..9.0,
                _ => 0.0..8.0,
            };
            assert!(range.contains(&lo) && range.contains(&hi), "{name}: {lo} to {hi}");
        }
        assert_eq!(library().len(), NAMES.len());
        assert!(named_spectrum("metal-Xx-eta").is_none());
    }

    #[test]
    fn copper_at_600_nm() {
        // Between the table's 590.400818 and 604.800842 nm.
        let (eta, k) = (named_spectrum("metal-Cu-eta").unwrap(), named_spectrum("metal-Cu-k").unwrap());
        assert!((eta.value(600.0) - 0.390_17).abs() < 1e-4, "{}", eta.value(600.0));
        assert!((k.value(600.0) - 2.943_49).abs() < 1e-4, "{}", k.value(600.0));
    }

    #[test]
    fn glasses_have_their_catalogue_index() {
        // n_d of Schott's catalogue, at 587.6 nm.
        let catalogue = [
            ("glass-BK7", 1.5168),
            ("glass-BAF10", 1.67003),
            ("glass-FK51A", 1.48656),
            ("glass-LASF9", 1.85025),
            ("glass-F5", 1.67271),
            ("glass-F10", 1.72828),
            ("glass-F11", 1.78472),
        ];
        for (name, n_d) in catalogue {
            let s = named_spectrum(name).unwrap();
            assert!((s.value(587.56) - n_d).abs() < 8e-5, "{name}: {}", s.value(587.56));
            assert!(s.value(400.0) > s.value(700.0), "{name}: no dispersion");
        }
    }

    #[test]
    fn illuminants_have_unit_luminance_and_their_white() {
        // Chromaticities of [CIE15, tables T.3 and T.8.1]; D60 as ACES has it.
        let whites = [
            ("stdillum-A", 0.44758, 0.40745),
            ("stdillum-D50", 0.34567, 0.35851),
            ("stdillum-D65", 0.31272, 0.32903),
            ("illum-acesD60", 0.32168, 0.33767),
            ("stdillum-F2", 0.3721, 0.3751),
            ("stdillum-F7", 0.3129, 0.3292),
            ("stdillum-F11", 0.3805, 0.3769),
        ];
        for (name, x, y) in whites {
            let xyz = xyz_of(&named_spectrum(name).unwrap());
            let c = cie::chromaticity(xyz);
            assert!((xyz[1] - 1.0).abs() < 1e-5, "{name}: Y {}", xyz[1]);
            assert!((c[0] - x).abs() < 3e-4 && (c[1] - y).abs() < 3e-4, "{name}: {c:?}");
        }
    }

    #[test]
    fn the_format_skips_comments_and_stops_at_nonsense() {
        let t = tables("# note\n@a\n400 1  410 2\n420 3\n@b\nx 1\n");
        assert_eq!(t, [("a", vec![(400.0, 1.0), (410.0, 2.0), (420.0, 3.0)]), ("b", vec![])]);
        assert_eq!(tables(include_str!("data/swatches.txt")).len(), 24);
    }
}

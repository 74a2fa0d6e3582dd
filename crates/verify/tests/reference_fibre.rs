//! The reference fibre against what is known of fibres in closed form.

use std::f64::consts::TAU;

use serde_json::Value;
use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::cylinder::far_field::FarField;
use sparrow_spectra::Spectrum;
use sparrow_stats::Random;
use sparrow_verify::reference_fibre::{Core, Photon, ReferenceFibre, Section, Surface};

fn smooth(section: Section) -> ReferenceFibre {
    ReferenceFibre {
        section,
        surface: Surface { alpha: [0.0; 2], eta: 1.55 },
        tilt: 0.0,
        sigma_a: [0.0, 0.2, 1.0, 4.0],
        core: None,
    }
}

/// The direction of an inclination and an azimuth in degrees.
fn dir(theta: f64, phi: f64) -> LocalDir<f64> {
    let ((st, ct), (sp, cp)) = (Real::sin_cos(theta.to_radians()), Real::sin_cos(phi.to_radians()));
    LocalDir::new(vec3(st, ct * cp, ct * sp))
}

fn azimuth(w: LocalDir<f64>) -> f64 {
    Real::atan2(w.z(), w.y()).to_degrees()
}

#[test]
fn a_smooth_fibre_sends_light_where_the_records_say() {
    let records: Value =
        serde_json::from_str(include_str!("../../models/tests/reference/values_fibres.json")).unwrap();
    let traces = records
        .as_array()
        .unwrap()
        .iter()
        .filter(|r| r["id"].as_str().unwrap().starts_with("ellipse.trace."));
    let mut n = 0;
    for r in traces {
        let input = |name: &str| r["inputs"][name].as_f64().unwrap();
        let fibre = smooth(Section { b: input("b") });
        let mut rng = Random::new(3);
        let mut seen = [0; 3];
        // Sides of offsets: the records count from the other one.
        for _ in 0..4000 {
            let Some(p) = fibre.send(dir(0.0, input("phi_i")), -input("h"), &mut rng) else { continue };
            if p.lobe > 2 {
                continue;
            }
            let want = &r["value"][format!("p{}", p.lobe)];
            let turn = azimuth(p.wi) - want[0].as_f64().unwrap();
            let turn = turn - 360.0 * (turn / 360.0).round();
            assert!(turn.abs() < 1e-6, "{}: lobe {} at {}", r["id"], p.lobe, azimuth(p.wi));
            let chord = -Real::ln(p.weight[1]) / 0.2;
            assert!((chord - want[1].as_f64().unwrap()).abs() < 1e-8, "{}: {chord}", r["id"]);
            seen[p.lobe] += 1;
        }
        assert!(seen.iter().all(|s| *s > 10), "{}: {seen:?}", r["id"]);
        n += 1;
    }
    assert_eq!(n, 4);
}

#[test]
fn a_smooth_fibre_has_the_shares_of_the_formula() {
    let (fibre, theta) = (smooth(Section::CIRCLE), 40.0_f64);
    let mut rng = Random::new(5);
    let n = 200_000;
    let mut sum = [[0.0; 4]; 4];
    for _ in 0..n {
        let h = rng.within(-1.0, 1.0);
        if let Some(p) = fibre.send(dir(theta, 20.0), h, &mut rng) {
            (0..4).for_each(|k| sum[p.lobe][k] += p.weight[k] / f64::from(n));
        }
    }
    let theta: [f64; 2] = Real::sin_cos(theta.to_radians()).into();
    let want = FarField { theta, eta: 1.55, sigma_a: Spectrum(fibre.sigma_a) }.shares(4000);
    for lobe in 0..4 {
        for k in 0..4 {
            // Five standard errors of a share, whose weights are at most 1.
            let bound = 5.0 * (want[lobe].0[k].max(1e-6) / f64::from(n)).sqrt();
            assert!((sum[lobe][k] - want[lobe].0[k]).abs() < bound, "{lobe} {k}: {sum:?} {want:?}");
        }
    }
}

/// Rays over the whole width of a fibre.
fn rays(fibre: &ReferenceFibre, n: u32, mut each: impl FnMut(Option<Photon>)) {
    let mut rng = Random::new(11);
    for _ in 0..n {
        let wo = dir(rng.within(-80.0, 80.0), rng.within(-180.0, 180.0));
        let h = rng.within(-1.0, 1.0);
        each(fibre.send(wo, h, &mut rng));
    }
}

#[test]
fn nothing_is_lost_in_a_rough_tilted_elliptical_fibre_with_a_core() {
    let core = Core { kappa: 0.6, sigma_s: 3.0, sigma_a: 0.0, g: 0.5 };
    for (alpha, core) in [([0.05, 0.1], None), ([0.4, 0.3], None), ([0.2, 0.2], Some(core))] {
        let fibre = ReferenceFibre {
            surface: Surface { alpha, eta: 1.55 },
            tilt: 0.05,
            sigma_a: [0.0; 4],
            core,
            ..smooth(Section { b: 0.7 })
        };
        let (mut lost, mut scattered) = (0, 0);
        rays(&fibre, 20_000, |p| match p {
            None => lost += 1,
            Some(p) => {
                assert!((p.wi.v().length() - 1.0).abs() < 1e-9 && p.weight[0] > 1.0 - 1e-12, "{p:?}");
                scattered += u32::from(p.scattered);
            }
        });
        assert!(lost <= 2, "{lost} of 20000 are lost at {alpha:?}");
        assert_eq!(scattered > 5000, core.is_some(), "{scattered}");
    }
}

#[test]
fn light_crosses_cortex_and_core_as_far_as_the_records_say() {
    let records: Value =
        serde_json::from_str(include_str!("../../models/tests/reference/values_fibres.json")).unwrap();
    let chords =
        records.as_array().unwrap().iter().filter(|r| r["id"].as_str().unwrap().starts_with("fur.chords."));
    let mut n = 0;
    for r in chords {
        let input = |name: &str| r["inputs"][name].as_f64().unwrap();
        let core = Core { kappa: input("kappa"), sigma_s: 0.0, sigma_a: 0.7, g: 0.0 };
        let fibre = ReferenceFibre { core: Some(core), ..smooth(Section::CIRCLE) };
        let mut rng = Random::new(5);
        let mut photons = (0..100).filter_map(|_| fibre.send(dir(0.0, 0.0), input("h"), &mut rng));
        let tt = photons.find(|p| p.lobe == 1).unwrap();
        // Absorptions 0 and 0.2 of the cortex part the two.
        let core = -Real::ln(tt.weight[0]) / 0.7;
        let cortex = -Real::ln(tt.weight[1] / tt.weight[0]) / 0.2;
        for (got, name) in [(core, "s_medulla"), (cortex, "s_cortex_total")] {
            let want = r["value"][name].as_f64().unwrap();
            assert!((got - want).abs() < 1e-9, "{}: {name} {got}, want {want}", r["id"]);
        }
        n += 1;
    }
    assert_eq!(n, 4);
}

#[test]
fn a_rough_mirror_fibre_scatters_as_computed() {
    // Single scattering dominates: the density of R with F = 1 is the record's where both are far from grazing. An index of 1e6 reflects
    // all.
    let records: Value =
        serde_json::from_str(include_str!("../../models/tests/reference/values_fibres.json")).unwrap();
    let record = records.as_array().unwrap().iter().find(|r| r["id"] == "huang.R.F4").unwrap();
    let fibre = ReferenceFibre { surface: Surface { alpha: [0.3; 2], eta: 1e6 }, ..smooth(Section::CIRCLE) };
    let (wo, mut rng) = (dir(0.0, 0.0), Random::new(17));
    let (n, cone) = (400_000, 12.0_f64.to_radians());
    let mut hits = 0.0;
    for _ in 0..n {
        let h = rng.within(-1.0, 1.0);
        if let Some(p) = fibre.send(wo, h, &mut rng) {
            hits += f64::from(u8::from(p.wi.dot(wo) > Real::cos(cone)));
        }
    }
    let density = hits / f64::from(n) / (TAU * (1.0 - Real::cos(cone)));
    let want = record["value"].as_f64().unwrap();
    // Light of more facets adds some percent; the peak is flat over the cone.
    assert!(density > 0.97 * want && density < 1.12 * want, "{density}, want {want}");
}

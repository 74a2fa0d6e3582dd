//! The models themselves, as they are registered.

use std::f64::consts::PI;

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::{Bcsdf, Fibre, FibreKind, ParamBlock, Uniforms};
use sparrow_spectra::Spectrum;

use crate::records::{check, input, of, want};

/// Runs every check; the ids of the records they asked for.
pub(crate) fn all() -> Vec<&'static str> {
    [mirror(), kajiya_kay(), lambert(), marschner(), glints(), eccentricity(), chiang(), roughness(), huang()]
        .concat()
}

/// The direction of an inclination and an azimuth in degrees.
fn dir(theta: f64, phi: f64) -> LocalDir<f64> {
    let ((st, ct), (sp, cp)) = (Real::sin_cos(theta.to_radians()), Real::sin_cos(phi.to_radians()));
    LocalDir::new(vec3(st, ct * cp, ct * sp))
}

/// (i, o) of a record.
fn pair(r: &serde_json::Value) -> (LocalDir<f64>, LocalDir<f64>) {
    let a = |k: usize| r["inputs"]["pair"][k].as_f64().expect("the record has a pair");
    (dir(a(0), a(1)), dir(a(2), a(3)))
}

fn cosine(w: LocalDir<f64>) -> f64 {
    sparrow_models::fibre_cosine(w)
}

fn bind(kind: FibreKind, h: f64, choices: &[u8], reals: &[f64], spectra: &[f64]) -> Fibre<f64> {
    let mut p = ParamBlock { h, ..ParamBlock::defaults(kind.params()) };
    p.choices[..choices.len()].copy_from_slice(choices);
    p.reals[..reals.len()].copy_from_slice(reals);
    for (slot, v) in p.spectra.iter_mut().zip(spectra) {
        *slot = Spectrum::splat(*v);
    }
    kind.bind(&p)
}

/// `int g(w) domega` over the sphere, by the trapezoid rule along and around the fibre.
fn over_sphere(n: u32, g: impl Fn(LocalDir<f64>) -> f64) -> f64 {
    let (dt, dp) = (180.0 / f64::from(n), 360.0 / f64::from(n));
    let mut sum = 0.0;
    for i in 0..n {
        let theta = -90.0 + (f64::from(i) + 0.5) * dt;
        let ring: f64 = (0..n).map(|k| g(dir(theta, (f64::from(k) + 0.5) * dp))).sum();
        sum += ring * Real::cos(theta.to_radians());
    }
    sum * dt.to_radians() * dp.to_radians()
}

fn mirror() -> Vec<&'static str> {
    let cone = of("cylinder.cone");
    for (_, r) in &cone {
        let wo = dir(input(r, "theta_i"), input(r, "phi_i"));
        for k in r["value"].as_array().expect("a list of normals") {
            let gamma = (input(r, "phi_i") - k["normal_azimuth"].as_f64().expect("an azimuth")).to_radians();
            let m = bind(FibreKind::MirrorCylinder, Real::sin(gamma), &[0], &[], &[1.0]);
            let s = m.sample(wo, Uniforms { lobe: 0.5, dir: [0.5; 2] });
            // Beyond the rim the normal faces away from the ray.
            if Real::cos(gamma) > 0.0 {
                let v = s.wi.v();
                for (got, axis) in [v.x, v.y, v.z].into_iter().zip(0..3) {
                    let want = k["r"][axis].as_f64().expect("a component");
                    assert!((got - want).abs() < 1e-12, "{r}: {got} {want}");
                }
            }
            assert!((s.wi.x() + wo.x()).abs() < 1e-12, "{s:?}");
        }
    }
    let around = of("cylinder.NR");
    for (id, r) in &around {
        // The share of light that the far field sends within the azimuth is the integral of N.
        let m = bind(FibreKind::MirrorCylinder, 0.0, &[1], &[], &[1.0]);
        for (k, n) in r["value"].as_array().expect("a list").iter().enumerate() {
            let phi = r["inputs"]["phi_deg"][k].as_f64().expect("an azimuth").to_radians();
            let e = 1e-4;
            // u of an azimuth: phi = -2 asin h, h = 2 u - 1.
            let share = |phi: f64| 0.5 - 0.5 * Real::sin(0.5 * phi);
            let s = m.sample(dir(0.0, 0.0), Uniforms { lobe: 0.0, dir: [share(phi), 0.0] });
            let at = Real::atan2(s.wi.z(), s.wi.y());
            assert!((at - phi).abs() < 1e-9, "{id}: {at} {phi}");
            let slope = (share(phi - e) - share(phi + e)) / (2.0 * e);
            assert!((slope - n.as_f64().expect("a number")).abs() < 1e-8, "{id}");
        }
    }
    cone.iter().chain(&around).map(|r| r.0).collect()
}

fn kajiya_kay() -> Vec<&'static str> {
    let pairs = of("kk.F");
    for (_, r) in &pairs {
        let (i, o) = pair(r);
        let lecture =
            |sign, kd, ks| bind(FibreKind::KajiyaKay, 0.0, &[1, sign], &[20.0], &[kd, ks]).f_cos(o, i).0[0];
        check(r, &["diffuse sin"], lecture(0, 1.0, 0.0));
        check(r, &["specular physical (si so - ti to)^s"], lecture(0, 0.0, 1.0));
        check(r, &["specular literal (ti to + si so)^s"], lecture(1, 0.0, 1.0));
    }
    let norms = of("kk.norm.");
    for (_, r) in &norms {
        let s = input(r, "s");
        let m = bind(FibreKind::KajiyaKay, 0.0, &[0, 0], &[s], &[0.0, 1.0]);
        // At theta = 0 the lobe returns all; at 60 degrees the ratio of the integrals.
        let peak = m.f(dir(0.0, 0.0), dir(0.0, 0.0)).0[0];
        check(r, &["closed 2*pi*B((s+3)/2,1/2)"], 1.0 / peak);
        let slanted = over_sphere(2000, |w| m.f_cos(dir(60.0, 0.0), w).0[0]) / peak;
        // The rule of midpoints ends at the kink of low powers.
        let want = want(r, &["theta_i=60"]);
        assert!((slanted / want - 1.0).abs() < 2e-6, "{}: {slanted} {want}", r["id"]);
    }
    let matt = of("kk.diffuse_norm");
    for (_, r) in &matt {
        let m = bind(FibreKind::KajiyaKay, 0.0, &[0, 0], &[20.0], &[1.0, 0.0]);
        check(r, &[], 1.0 / m.f(dir(10.0, 0.0), dir(20.0, 90.0)).0[0]);
    }
    pairs.iter().chain(&norms).chain(&matt).map(|r| r.0).collect()
}

fn lambert() -> Vec<&'static str> {
    let values = of("lambert_cylinder.N");
    let m = bind(FibreKind::LambertFibre, 0.0, &[1], &[], &[1.0]);
    for (_, r) in &values {
        for (k, name) in ["0", "1", "2", "3", "4"].into_iter().enumerate() {
            let phi = r["inputs"]["phi_deg"][k].as_f64().expect("an azimuth");
            // S = 2 rho N / pi
            check(r, &[name], m.f(dir(0.0, 0.0), dir(0.0, phi)).0[0] * 0.5 * PI);
        }
    }
    let whole = of("lambert_cylinder.int");
    for (_, r) in &whole {
        let n = 4000;
        let at = |k: u32| m.f(dir(0.0, 0.0), dir(0.0, f64::from(k) * 360.0 / f64::from(n))).0[0];
        let sum: f64 = (0..n).map(at).sum::<f64>() * 2.0 * PI / f64::from(n);
        assert!((sum * 4.0 * PI / want(r, &[]) - 1.0).abs() < 1e-9, "{sum}");
    }
    values.iter().chain(&whole).map(|r| r.0).collect()
}

/// Marschner's model with the sheet's absorption; `reals` begin with eta, alpha, beta.
fn marschner_with(form: u8, alpha: f64, beta: f64, glint: [f64; 4], a: f64) -> Fibre<f64> {
    let reals = [1.55, alpha, beta, glint[0], glint[1], glint[2], glint[3], a];
    bind(FibreKind::Marschner, 0.0, &[form], &reals, &[0.2])
}

fn marschner() -> Vec<&'static str> {
    let furnaces = of("marschner.furnace.");
    for (_, r) in &furnaces {
        // M as printed has twice the light of ours. The record's integrand with F = 1 is asked of M alone.
        let (alpha, beta, theta) = (input(r, "alpha_R"), input(r, "beta_R"), input(r, "theta_r"));
        let m = marschner_with(0, alpha, beta, [0.0, 15.0, 0.3, 0.5], 1.0);
        let n = 40_000;
        let step = 180.0 / f64::from(n);
        let at = |k: u32| {
            let t = -90.0 + (f64::from(k) + 0.5) * step;
            let (o, i) = (dir(theta, 0.0), dir(t, 0.0));
            let d = (0.5 * (theta - t)).to_radians();
            // N_R at phi = 0 is F / 4, F that of the difference angle.
            let f = sparrow_models::fresnel::dielectric(Real::cos(d), 1.55).0;
            2.0 * m.lobes(o, i)[0].0[0] / (0.25 * f) * cosine(i) * step.to_radians()
        };
        check(r, &[], (0..n).map(at).sum());
    }
    let pairs = [of("marschner.F1"), of("marschner.F2"), of("marschner.F3")].concat();
    for (_, r) in &pairs {
        let (i, o) = pair(r);
        let m = marschner_with(0, -7.5, 7.5, [0.0, 15.0, 0.3, 0.5], 1.0);
        let lobes = m.lobes(o, i).map(|q| 2.0 * q.0[0] / cosine(i));
        let theta = |w: LocalDir<f64>| Real::asin(w.x());
        let d = Real::cos(0.5 * (theta(o) - theta(i)));
        for (p, (m, n)) in [("M0", "N0"), ("M1", "N1"), ("M2", "N2")].into_iter().enumerate() {
            let want = want(r, &[m]) * want(r, &[n]) / (d * d);
            assert!((lobes[p] - want).abs() <= 1e-6 * want + 1e-12, "{} {p}: {} {want}", r["id"], lobes[p]);
        }
        check(r, &["S (no caustic smoothing, no eccentricity, literal M)"], lobes.iter().sum());
    }
    furnaces.iter().chain(&pairs).map(|r| r.0).collect()
}

fn glints() -> Vec<&'static str> {
    let records = of("marschner.NTRT.");
    for (_, r) in &records {
        let (phi, d) = (input(r, "phi_deg"), input(r, "theta_d"));
        // theta_o = -theta_i = theta_d, where theta_h = 0.
        let (o, i) = (dir(d, 0.0), dir(-d, phi));
        let scale = cosine(i) / Real::cos(d.to_radians()).sqr() * 0.5
            / (2.0 * 7.5_f64.to_radians() * Real::sqrt(2.0 * PI));
        let m = marschner_with(0, 0.0, 7.5, [2.0, 15.0, 0.3, 0.5], 1.0);
        check(r, &["smoothed"], m.lobes(o, i)[2].0[0] / scale);
    }
    records.iter().map(|r| r.0).collect()
}

fn eccentricity() -> Vec<&'static str> {
    let records = of("eccentricity.");
    for (_, r) in &records {
        // The index shows in where the light of TRT ends: no caustics, backward directions.
        let a = input(r, "a");
        for (k, name) in ["0", "1", "2"].into_iter().enumerate() {
            let half = r["inputs"]["phi_h_deg"][k].as_f64().expect("an angle");
            let eta = want(r, &[name]);
            let like =
                bind(FibreKind::Marschner, 0.0, &[0], &[eta, -7.5, 7.5, 1.0, 15.0, 0.3, 0.5, 1.0], &[0.2]);
            let m = marschner_with(0, -7.5, 7.5, [1.0, 15.0, 0.3, 0.5], a);
            // Four degrees around the half angle.
            let (o, i) = (dir(10.0, half - 2.0), dir(5.0, half + 2.0));
            let (got, want) = (m.lobes(o, i)[2].0[0], like.lobes(o, i)[2].0[0]);
            assert!(want > 0.0 && (got / want - 1.0).abs() < 1e-7, "{} {half}: {got} {want}", r["id"]);
        }
    }
    records.iter().map(|r| r.0).collect()
}

fn chiang() -> Vec<&'static str> {
    let pairs: Vec<_> = of("chiang.F");
    for (_, r) in &pairs {
        let (i, o) = pair(r);
        let at = |name| input(r, name);
        let reals = [at("eta"), at("beta_m"), at("beta_n"), at("alpha_deg")];
        let m = bind(FibreKind::Hair, at("h"), &[0], &reals, &[at("sigma_a")]);
        let (q, pdf) = m.f_cos_pdf(o, i);
        check(r, &["f_cos"], q.0[0]);
        check(r, &["pdf"], pdf);
        check(r, &["ratio=sum Ap"], q.0[0] / pdf);
        assert!((m.f(o, i).0[0] * cosine(i) / q.0[0] - 1.0).abs() < 1e-12);
    }
    let furnace = of("chiang.furnace");
    for (_, r) in &furnace {
        let m = bind(FibreKind::Hair, 0.3, &[0], &[1.55, 0.3, 0.3, 2.0], &[0.0]);
        check(r, &[], over_sphere(400, |w| m.f_cos(dir(30.0, 0.0), w).0[0]));
    }
    pairs.iter().chain(&furnace).map(|r| r.0).collect()
}

fn roughness() -> Vec<&'static str> {
    use sparrow_models::cylinder::roughness::{logistic_scale, variance};
    let records = of("chiang.map.");
    for (_, r) in &records {
        let v = variance(input(r, "beta_m"));
        for (p, scale) in [("0", 1.0), ("1", 0.25), ("2", 4.0), ("3", 4.0)] {
            check(r, &["v", p], scale * v);
        }
        check(r, &["s"], logistic_scale(input(r, "beta_n")));
    }
    records.iter().map(|r| r.0).collect()
}

/// R of a mirror with facets in the far field.
fn huang() -> Vec<&'static str> {
    let records = of("huang.R.");
    let m = bind(FibreKind::MicrofacetHair, 0.0, &[1, 1], &[1.55, 0.3, 0.3, 0.0, 1.0], &[0.0]);
    for (id, r) in &records {
        if *id == "huang.R.furnace" {
            let wo = dir(20.0, 0.0);
            check(r, &[], over_sphere(150, |wi| m.f_cos(wo, wi).0[0]));
        } else {
            let (i, o) = pair(r);
            check(r, &[], m.f_cos(i, o).0[0]);
        }
    }
    records.iter().map(|r| r.0).collect()
}

#[test]
fn the_far_field_of_facets_is_the_mean_of_the_near_field() {
    for (aspect, tilt) in [(1.0, 0.0), (0.6, 0.0), (0.6, 5.0)] {
        let reals = [1.55, 0.3, 0.2, tilt, aspect];
        let far = bind(FibreKind::MicrofacetHair, 0.0, &[1], &reals, &[0.2]);
        let (wo, wi) = (dir(20.0, 35.0), dir(-10.0, 80.0));
        let n = 2000;
        let near = |k: i32| {
            let h = (f64::from(k) + 0.5) / f64::from(n) * 2.0 - 1.0;
            bind(FibreKind::MicrofacetHair, h, &[0], &reals, &[0.2]).lobes(wo, wi)[0].0[0]
        };
        let mean = (0..n).map(near).sum::<f64>() / f64::from(n);
        let whole = far.lobes(wo, wi)[0].0[0];
        assert!((mean / whole - 1.0).abs() < 1e-4, "{aspect} {tilt}: {mean} {whole}");
    }
}

/// The mean over h of all lobes of a model, its last choice `field`, against its far field.
#[test]
fn far_fields_are_the_mean_of_near_fields() {
    use FibreKind::{EllipticalHair, Fur, Hair, ZinkeWeber};
    let fur = [1.55, 0.6, 2.0, 0.4, 1.5, 0.3, 0.3, 3.0];
    // Segments hold the light of their middle: half a percent, and more where the medulla ends within one.
    let cases: [(FibreKind, &[u8], &[f64], f64); 4] = [
        (Hair, &[0], &[1.55, 0.3, 0.35, 3.0], 5e-3),
        (Fur, &[], &fur, 1e-2),
        (ZinkeWeber, &[], &[1.55, 0.3, 0.35, 3.0], 5e-3),
        (EllipticalHair, &[], &[1.55, 0.3, 0.35, 3.0, 0.7], 5e-3),
    ];
    for (kind, choices, reals, tolerance) in cases {
        let at = |h: f64, field: u8| bind(kind, h, &[choices, &[field]].concat(), reals, &[0.2]);
        for (wo, wi) in [(dir(20.0, 35.0), dir(-10.0, 80.0)), (dir(-50.0, 0.0), dir(40.0, 170.0))] {
            let n = 2000;
            // Evenly in the angle, as the light at the rims changes fast.
            let near = |k: i32| {
                let gamma = ((f64::from(k) + 0.5) / f64::from(n) - 0.5) * PI;
                at(Real::sin(gamma), 0).f_cos(wo, wi).0[0] * Real::cos(gamma) * PI / f64::from(2 * n)
            };
            let (mean, far) = ((0..n).map(near).sum::<f64>(), at(0.0, 1).f_cos(wo, wi).0[0]);
            assert!((mean - far).abs() < tolerance * far + 1e-6, "{kind:?}: {mean} {far}");
        }
    }
}

#[test]
fn facets_that_lean_away_are_left_out_of_the_density() {
    // Scales of 20 degrees on a flat fibre, seen from where a part of them is turned away.
    let m = bind(FibreKind::MicrofacetHair, 0.0, &[1, 1], &[1.34, 0.06, 0.66, 20.0, 2.0], &[0.0]);
    let wo = LocalDir::new(vec3(-0.5765, -0.4216, 0.7).normalized());
    let whole = over_sphere(400, |wi| m.pdf(wo, wi));
    // Most of what is lost depends on the place across the fibre.
    let [n, few] = [4096, 8];
    let u = |k: u32, n: u32| (f64::from(k) + 0.5) / f64::from(n);
    let kept = (0..n * few * few)
        .filter(|k| {
            let dir = [u(k / n % few, few), u(k / (n * few), few)];
            m.sample(wo, Uniforms { lobe: u(k % n, n), dir }).valid
        })
        .count();
    let share = kept as f64 / f64::from(n * few * few);
    assert!(share < 0.99 && (whole - share).abs() < 1e-3, "{whole} {share}");
}

//! Terms that the models share.

use std::f64::consts::PI;

use sparrow_math::Real;
use sparrow_models::cylinder::attenuation::Inside;
use sparrow_models::cylinder::azimuthal::{TrimmedLogistic, WrappedGauss, wrapped};
use sparrow_models::cylinder::colour::{absorption_of_melanin, absorption_of_tuft};
use sparrow_models::cylinder::elliptic::Elliptic;
use sparrow_models::cylinder::far_field::FarField;
use sparrow_models::cylinder::longitudinal::Longitudinal;
use sparrow_models::cylinder::medulla::chords;
use sparrow_models::cylinder::roots::{self, Root};
use sparrow_models::cylinder::section::{Section, dot};
use sparrow_spectra::Spectrum;

use crate::records::{check, input, of, want};

/// Runs every check; the ids of the records they asked for.
pub(crate) fn all() -> Vec<&'static str> {
    [
        bravais(),
        roots(),
        caustics(),
        shares(),
        longitudinal(),
        bessel(),
        azimuthal(),
        colours(),
        samples(),
        ellipses(),
        furs(),
    ]
    .concat()
}

/// Sine and cosine of an angle in degrees.
fn angle(deg: f64) -> [f64; 2] {
    Real::sin_cos(deg.to_radians()).into()
}

/// Cosine and sine of an angle in degrees.
fn azimuth(deg: f64) -> [f64; 2] {
    let [sin, cos] = angle(deg);
    [cos, sin]
}

fn close(got: f64, want: f64, tol: f64, what: &str) {
    assert!((got - want).abs() <= tol * want.abs() + 1e-12, "{what}: {got}, want {want}");
}

fn bravais() -> Vec<&'static str> {
    let records = of("bravais.");
    for (_, r) in &records {
        let theta = angle(input(r, "theta_d"));
        for (deg, name) in [(30.0, "F_true(gamma=30)"), (70.0, "F_true(gamma=70)")] {
            let inside = Inside::new(theta, angle(deg)[0], 1.55);
            check(r, &["eta_perp'"], 1.0 / inside.over_eta);
            check(r, &[name], inside.fresnel);
        }
    }
    records.iter().map(|r| r.0).collect()
}

fn roots() -> Vec<&'static str> {
    let records = of("roots.");
    for (id, r) in &records {
        let (phi, eta) = (input(r, "phi_deg").to_radians(), input(r, "eta'"));
        let found: Vec<Root<f64>> = match input(r, "p") as u32 {
            0 => vec![roots::of_r(phi)],
            1 => vec![roots::of_tt(phi, eta)],
            _ => roots::of_trt(phi, eta).to_vec(),
        };
        let found: Vec<Root<f64>> = found.into_iter().filter(|x| x.density > 0.0).collect();
        let exact = r["value"]["h_exact"].as_array().expect("the record lists roots");
        assert_eq!(found.len(), exact.len(), "{id}: {found:?}");
        for (x, h) in found.iter().zip(exact) {
            close(x.h, h.as_f64().expect("a root"), 1e-7, id);
        }
        check(r, &["density_exact"], found.iter().map(|x| x.density).sum());
    }
    records.iter().map(|r| r.0).collect()
}

fn caustics() -> Vec<&'static str> {
    let records = of("caustic.");
    for (_, r) in &records {
        let eta = input(r, "eta'");
        let [phi, bend] = roots::caustic_azimuth(eta);
        check(r, &["h_c"], roots::caustic(eta));
        check(r, &["phi_c_deg(wrapped)"], phi.abs().to_degrees());
        check(r, &["phi''_exact"], bend);
    }
    records.iter().map(|r| r.0).collect()
}

fn shares() -> Vec<&'static str> {
    let means = of("attenuation.mean.");
    for (_, r) in &means {
        let theta = angle(input(r, "theta_d"));
        let sigma_a = Spectrum([0.2, 0.0, 0.0, 0.0]);
        let a = FarField { theta, eta: 1.55, sigma_a }.shares(20_000);
        for (p, name) in ["A0", "A1", "A2"].into_iter().enumerate() {
            check(r, &[name], a[p].0[0]);
        }
        check(r, &["sum_p sigma=0"], a.iter().map(|a| a.0[1]).sum());
        let straight = Inside::new(theta, 0.0, 1.55);
        check(r, &["T_chord_gt0"], Real::exp(-0.2 * straight.length));
    }
    let near = of("chiang.Ap.");
    for (id, r) in &near {
        let inside = Inside::new(angle(input(r, "theta_o")), input(r, "h"), input(r, "eta"));
        let a = inside.attenuation(Spectrum([0.5, 0.0, 0.0, 0.0]));
        for (p, name) in ["0", "1", "2", "3"].into_iter().enumerate() {
            check(r, &["Ap", name], a[p].0[0]);
        }
        check(r, &["gamma_t"], inside.angle());
        close(a.iter().map(|a| a.0[1]).sum(), want(r, &["sum_if_sigma0"]), 1e-12, id);
    }
    means.iter().chain(&near).map(|r| r.0).collect()
}

fn longitudinal() -> Vec<&'static str> {
    let records = of("deon.M.");
    for (_, r) in &records {
        let (v, theta) = (input(r, "v"), input(r, "theta_i"));
        let m = Longitudinal::new(v);
        check(r, &["M(theta_o=-theta_i)"], m.value(angle(theta), angle(-theta)));
        check(r, &["M(theta_o=10deg)"], m.value(angle(theta), angle(10.0)));
        // The trapezoid rule is off by step^2 / 12 times the slopes at the ends, which are M.
        let n = 200_000;
        let step = PI / f64::from(n);
        let at = |k: i32| {
            let t: [f64; 2] = Real::sin_cos(-0.5 * PI + f64::from(k) * step).into();
            m.value(angle(theta), t) * t[1] * step
        };
        check(r, &["int M cos"], (0..=n).map(at).sum());
    }
    records.iter().map(|r| r.0).collect()
}

fn bessel() -> Vec<&'static str> {
    let records = of("logI0.");
    for (_, r) in &records {
        let x = input(r, "x");
        check(r, &["exact"], x + Real::ln(Real::i0e(x)));
    }
    records.iter().map(|r| r.0).collect()
}

fn azimuthal() -> Vec<&'static str> {
    let records = of("deon.N.");
    let std = |deg: f64| WrappedGauss::new(deg.to_radians());
    for (_, r) in &records {
        let phi = wrapped(input(r, "phi_deg").to_radians());
        let far = FarField { theta: [0.0, 1.0], eta: 1.55, sigma_a: Spectrum::splat(0.2) };
        let n = far.around(phi, &[std(10.0), std(10.0), std(20.0)], 40_000).n;
        for (p, name) in ["N0", "N1", "N2"].into_iter().enumerate() {
            check(r, &[name], n[p].0[0]);
        }
    }
    records.iter().map(|r| r.0).collect()
}

fn colours() -> Vec<&'static str> {
    let tufts = of("chiang.sigma.");
    for (_, r) in &tufts {
        check(r, &[], absorption_of_tuft(Spectrum::splat(input(r, "C")), input(r, "beta_n")).0[0]);
    }
    let melanins = of("melanin.");
    for (_, r) in &melanins {
        let sigma_a = absorption_of_melanin(input(r, "eumelanin"), input(r, "pheomelanin"));
        for (k, name) in ["0", "1", "2"].into_iter().enumerate() {
            check(r, &[name], sigma_a[k]);
        }
    }
    tufts.iter().chain(&melanins).map(|r| r.0).collect()
}

fn samples() -> Vec<&'static str> {
    let around = of("trimlog.");
    for (_, r) in &around {
        check(r, &[], TrimmedLogistic::new(input(r, "s")).sample(input(r, "u")));
    }
    let along = of("msample.");
    for (_, r) in &along {
        let m = Longitudinal::new(input(r, "v"));
        check(r, &[], m.sample(angle(25.0), [input(r, "u1"), input(r, "u2")]));
    }
    around.iter().chain(&along).map(|r| r.0).collect()
}

/// Rays through an ellipse, and the density around it with which a mirror sends light of all offsets.
fn ellipses() -> Vec<&'static str> {
    let traces = of("ellipse.trace.");
    for (_, r) in &traces {
        let section = Section { b: input(r, "b") };
        let rays = Elliptic { section, theta: [0.0, 1.0], eta: 1.55, sigma_a: Spectrum::ZERO };
        // Our h lies to the other side.
        let exits = rays.exits(azimuth(input(r, "phi_i")), -input(r, "h"));
        let lengths = [0.0, exits.chords[0], exits.chords[1]];
        for (p, (d, length)) in exits.directions.into_iter().zip(lengths).enumerate() {
            let name = format!("p{p}");
            check(r, &[&name, "0"], Real::atan2(d[1], d[0]).to_degrees());
            check(r, &[&name, "1"], length);
        }
    }
    // int (R cos(D / 2) / (4 W)) dphi_o, the radius of curvature R at the normal halfway between.
    let section = Section { b: 0.7 };
    let density = |from: f64, to: f64| {
        let (n, phi) = (0.5 * (from + to), azimuth(from));
        let n = azimuth(n);
        0.25 * section.radius(n) * dot(n, phi) / section.half_width(phi)
    };
    let densities = of("ellipse.R.");
    for (id, r) in &densities {
        let from = input(r, "phi_i");
        if *id == "ellipse.R.int" {
            let n = 2000;
            let at = |k: i32| density(from, from - 180.0 + (f64::from(k) + 0.5) * 360.0 / f64::from(n));
            let whole = (0..n).map(at).sum::<f64>() * 2.0 * PI / f64::from(n);
            close(whole, want(r, &[]), 1e-6, id);
        } else {
            check(r, &[], density(from, input(r, "phi_o")));
        }
    }
    traces.iter().chain(&densities).map(|r| r.0).collect()
}

/// Ways through cortex and medulla.
fn furs() -> Vec<&'static str> {
    let records = of("fur.chords.");
    for (_, r) in &records {
        let sin = input(r, "h") / 1.55;
        let [cortex, medulla] = chords(input(r, "kappa"), [sin, (1.0 - sin * sin).sqrt()]);
        check(r, &["s_cortex_total"], cortex);
        check(r, &["s_medulla"], medulla);
    }
    records.iter().map(|r| r.0).collect()
}

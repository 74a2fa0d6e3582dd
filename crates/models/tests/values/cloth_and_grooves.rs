//! Charlie sheen, and bounces in V-grooves.

use sparrow_math::{LocalDir, Real};
use sparrow_models::microfacet::{charlie, groove};
use sparrow_models::{Bsdf, SurfaceKind};

use crate::read::{bind, check, dir, pair};
use crate::reference::record;

pub(crate) fn charlie_sheen() {
    for roughness in ["0.2", "0.5", "1.0"] {
        let r: f64 = roughness.parse().expect("a number");
        let of_d = record(&format!("charlie.D.r{roughness}"));
        check(&of_d, "/D(30)", charlie::d(dir(30.0, 10.0), r));
        check(&of_d, "/D(80)", charlie::d(dir(80.0, 10.0), r));
        let of_lambda = record(&format!("charlie.Lambda.r{roughness}"));
        for mu in [0.1, 0.4, 0.9] {
            check(&of_lambda, &format!("/mu={mu}"), charlie::lambda(mu, r));
        }
    }
    let white = |r| bind(SurfaceKind::Charlie, &[0], &[r], &[1.0]);
    for k in 1..=5 {
        let r = record(&format!("charlie.f.r0.4.P{k}"));
        let (i, o) = pair(&r);
        check(&r, "", white(0.4).f(o, i)[0]);
    }
    for roughness in ["0.1", "0.3", "1.0"] {
        let r = record(&format!("charlie.albedo.r{roughness}"));
        let m = white(roughness.parse().expect("a number"));
        for th in [0, 45, 75, 89] {
            let o = dir(f64::from(th), 0.0);
            let n = 400;
            let mut sum = 0.0;
            for k in 0..n * n {
                // Points crowd at the horizon, where the sheen is: cos = x^2.
                let x = (f64::from(k % n) + 0.5) / f64::from(n);
                let phi = core::f64::consts::PI * (f64::from(k / n) + 0.5) / f64::from(n);
                let i = LocalDir::from_angles(Real::acos(x * x), phi);
                sum += m.f_cos(o, i)[0] * 2.0 * x * core::f64::consts::TAU / f64::from(n * n);
            }
            check(&r, &format!("/{th}"), sum);
        }
    }
}

pub(crate) fn bounces_in_v_grooves() {
    for beta in [20, 45, 60, 75] {
        for psi in [0, 30, 60] {
            let r = record(&format!("vgroove.beta{beta}.psi{psi}"));
            let (g, psi) = (f64::from(90 - beta).to_radians(), f64::from(psi).to_radians());
            let mut told = 0.0;
            for (key, want) in r["value"].as_object().expect("shares") {
                let (k, exit) = key.split_once(':').expect("bounces and exit angle");
                let (k, exit): (u32, f64) = (k.parse().expect("bounces"), exit.parse().expect("an angle"));
                let mut got = 0.0;
                for side in [1.0, -1.0] {
                    // The record counts exit angles positive on the far side of the normal.
                    let out = -side * groove::exit(side * psi, g, k).to_degrees();
                    got += if (out - exit).abs() < 1e-6 { groove::share(side * psi, g, k) } else { 0.0 };
                }
                let want = want.as_f64().expect("a share");
                // 2000 rays.
                assert!((got - want).abs() < 2.0 / 2000.0, "{} {key}: {got}, want {want}", r["id"]);
                told += got;
            }
            assert!((told - 1.0).abs() < 1e-9, "{}: {told}", r["id"]);
        }
    }
}

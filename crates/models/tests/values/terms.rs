//! Terms of microfacet models: Fresnel's, distributions, masking, visible normals.

use sparrow_math::{LocalDir, Real};
use sparrow_models::microfacet::special::gauss_quantile;
use sparrow_models::microfacet::{Facets, Masking, Ndf, NdfKind, Sampling, visible_slope};
use sparrow_models::{fresnel, ggx::Ggx};

use crate::read::{at, check, dir, pair};
use crate::reference::record;

fn cos_deg(deg: f64) -> f64 {
    Real::cos(deg.to_radians())
}

pub(crate) fn fresnel_terms() {
    for (id, eta) in [("1.5000", 1.5), ("0.6667", 2.0 / 3.0), ("1.7000", 1.7), ("1.3300", 1.33)] {
        for th in [0, 30, 60, 80] {
            let r = record(&format!("fresnel.dielectric.eta{id}.th{th}"));
            check(&r, "", fresnel::dielectric(cos_deg(f64::from(th)), eta).0);
        }
    }
    for metal in ["Al-500nm-approx", "Au-550nm-approx", "Al-650-approx"] {
        for th in [0, 45, 75, 85] {
            let r = record(&format!("fresnel.conductor.{metal}.th{th}"));
            let (n, k) = (at(&r, "/inputs/n"), at(&r, "/inputs/k"));
            let c = cos_deg(f64::from(th));
            let (s, p) = fresnel::conductor_polarized(c, n, k);
            check(&r, "/Rs", s);
            check(&r, "/Rp", p);
            check(&r, "/R", fresnel::conductor(c, n, k));
        }
        let r = record(&format!("fresnel.conductor.{metal}.pseudoBrewster"));
        let (n, k) = (at(&r, "/inputs/n"), at(&r, "/inputs/k"));
        let (deg, least) = least(|deg| fresnel::conductor_polarized(cos_deg(deg), n, k).1);
        check(&r, "/theta_deg", deg);
        check(&r, "/Rp_min", least);
    }
    let r = record("fresnel.conductor.Al.min_unpolarised");
    let (deg, least) = least(|deg| fresnel::conductor(cos_deg(deg), 0.77, 6.08));
    check(&r, "/theta_deg", deg);
    check(&r, "/F", least);
}

/// Where a function of degrees is least, to 1e-4 degrees.
fn least(f: impl Fn(f64) -> f64) -> (f64, f64) {
    (0..900_000)
        .map(|i| f64::from(i) * 1e-4)
        .map(|deg| (deg, f(deg)))
        .fold((0.0, f64::INFINITY), |best, x| if x.1 < best.1 { x } else { best })
}

pub(crate) fn fresnel_approximations_and_averages() {
    for f0 in [0.04, 0.9] {
        for th in [0, 60, 85] {
            let r = record(&format!("fresnel.schlick.f0_{f0}.th{th}"));
            check(&r, "", fresnel::schlick(cos_deg(f64::from(th)), f0));
        }
    }
    check(&record("fresnel.schlick.avg.f0_0.04"), "", fresnel::schlick_average(0.04));
    for (f0, tint) in [(0.9, 0.8), (0.5, 0.3)] {
        let r = record(&format!("fresnel.f82.{f0}.{tint}"));
        check(&r, "/F(1~17)", fresnel::f82_tint(1.0 / 7.0, f0, tint));
        check(&r, "/F(0.5)", fresnel::f82_tint(0.5, f0, tint));
        check(&r, "/avg", fresnel::f82_average(f0, tint));
    }
    for (id, n, k) in [("0.77.6.08", 0.77, 6.08), ("1.7.0.0", 1.7, 0.0), ("0.43.2.455", 0.43, 2.455)] {
        let r = record(&format!("fresnel.lazanyi.{id}"));
        for (i, deg) in [0.0, 60.0, 85.0].into_iter().enumerate() {
            check(&r, &format!("/{i}"), fresnel::lazanyi(cos_deg(deg), n, k));
        }
    }
    for (id, eta) in [("1.5", 1.5), ("1.33", 1.33), ("2.4", 2.4)] {
        let r = record(&format!("fresnel.diffuse_avg.{id}"));
        // Simpson's rule in sin theta, where the curve is smooth up to the critical angle.
        let mean = |eta: f64| {
            let end = eta.min(1.0);
            let f = |x: f64| {
                let s = end * (1.0 - (1.0 - x).powi(4));
                let slope = end * 4.0 * (1.0 - x).powi(3);
                fresnel::dielectric((1.0 - s * s).sqrt(), eta).0 * 2.0 * s * slope
            };
            let n = 20_000;
            let h = 1.0 / f64::from(n);
            let sum: f64 = (0..n)
                .map(|i| {
                    let x = f64::from(i) * h;
                    (f(x) + 4.0 * f(x + 0.5 * h) + f(x + h)) * h / 6.0
                })
                .sum();
            sum + 1.0 - end * end
        };
        check(&r, "/outside", mean(eta));
        check(&r, "/inside", mean(1.0 / eta));
        assert!((fresnel::average(|c| fresnel::dielectric(c, eta).0) - mean(eta)).abs() < 1e-3);
    }
}

pub(crate) fn distributions() {
    let ndf = |kind, a: f64, shape| Ndf::new(kind, a, a, shape);
    let blinn = |s| ndf(NdfKind::Blinn, 1.0, s);
    for (id, d) in [
        ("ggx.a0.2", ndf(NdfKind::Ggx, 0.2, 0.0)),
        ("ggx.a0.8", ndf(NdfKind::Ggx, 0.8, 0.0)),
        ("beckmann.a0.3", ndf(NdfKind::Beckmann, 0.3, 0.0)),
        ("blinn.s40", blinn(40.0)),
        ("gtr.a0.3.g1", ndf(NdfKind::Gtr, 0.3, 1.0)),
        ("gtr.a0.3.g1.5", ndf(NdfKind::Gtr, 0.3, 1.5)),
        ("gtr.a0.3.g3", ndf(NdfKind::Gtr, 0.3, 3.0)),
        ("std.a0.3.g2", ndf(NdfKind::StudentT, 0.3, 2.0)),
        ("std.a0.3.g5", ndf(NdfKind::StudentT, 0.3, 5.0)),
    ] {
        let r = record(&format!("ndf.{id}"));
        check(&r, "/D(0)", d.d(dir(0.0, 0.0)));
        check(&r, "/D(20deg)", d.d(dir(20.0, 50.0)));
        check(&r, "/D(60deg)", d.d(dir(60.0, 110.0)));
    }
    for (id, kind) in [("ggx", NdfKind::Ggx), ("beckmann", NdfKind::Beckmann)] {
        let r = record(&format!("ndf.{id}.aniso"));
        let d = Ndf::new(kind, 0.1, 0.4, 0.0);
        check(&r, "/D", d.d(dir(25.0, 40.0)));
        check(&r, "/Lambda", d.lambda(dir(25.0, 40.0)));
    }
    for u in [0.1, 0.5, 0.95] {
        let r = record(&format!("ndf.sample.u{u}"));
        for (key, d) in [
            ("ggx", ndf(NdfKind::Ggx, 0.3, 0.0)),
            ("beckmann", ndf(NdfKind::Beckmann, 0.3, 0.0)),
            ("blinn", blinn(40.0)),
            ("std(gamma=3)", ndf(NdfKind::StudentT, 0.3, 3.0)),
            ("gtr(gamma=3)", ndf(NdfKind::Gtr, 0.3, 3.0)),
            ("gtr1", ndf(NdfKind::Gtr, 0.3, 1.0)),
        ] {
            check(&r, &format!("/theta_rad/{key}"), Real::acos(d.sample([u, 0.3]).z()));
        }
    }
}

pub(crate) fn masking() {
    for th in [30, 60, 80, 89] {
        let r = record(&format!("smith.lambda.a0.5.th{th}"));
        let w = dir(f64::from(th), 70.0);
        check(&r, "/ggx", Ndf::new(NdfKind::Ggx, 0.5, 0.5, 0.0).lambda(w));
        check(&r, "/beckmann", Ndf::new(NdfKind::Beckmann, 0.5, 0.5, 0.0).lambda(w));
        let r = record(&format!("smith.lambda.std.g3.a0.5.th{th}"));
        check(&r, "", Ndf::new(NdfKind::StudentT, 0.5, 0.5, 3.0).lambda(w));
    }
    for k in 1..=5 {
        let r = record(&format!("G.ggx.a0.4.P{k}"));
        let (i, o) = pair(&r);
        let ndf = Ndf::new(NdfKind::Ggx, 0.4, 0.4, 0.0);
        check(&r, "/G1i", ndf.g1(i));
        check(&r, "/G1o", ndf.g1(o));
        let four = 4.0 * i.z() * o.z();
        let g = |masking| Facets::new(ndf, masking, Sampling::Visible).g2_over_4cos(o, i) * four;
        check(&r, "/G_uncorrelated", g(Masking::Separable));
        check(&r, "/G_height_correlated", g(Masking::Smith));
        check(&r, "/G_Vcavity", g(Masking::VCavity));
        let t = Facets::new(ndf, Masking::Smith, Sampling::Visible).transmitted_g2_over_4cos(o, i) * four;
        check(&r, "/G_transmission_beta", t);
    }
}

pub(crate) fn visible_normals() {
    for th in [20, 60, 85] {
        for u in [0.2, 0.7] {
            let r = record(&format!("beckmann.vndf.slope.th{th}.u{u}"));
            let (sin, cos) = Real::sin_cos(f64::from(th).to_radians());
            check(&r, "/x", visible_slope(sin, cos, u));
            let w = dir(f64::from(th), 0.0);
            check(&r, "/1+Lambda", 1.0 + Ndf::new(NdfKind::Beckmann, 1.0, 1.0, 0.0).lambda(w));
        }
    }
    assert!(gauss_quantile(0.5_f64).abs() < 1e-15);
    for id in ["0.3.0.3.40.0.25", "0.1.0.6.70.0.9", "0.8.0.8.85.0.5"] {
        let r = record(&format!("vndf.sample.{id}"));
        let a = |k: &str| at(&r, &format!("/inputs/{k}"));
        let (w, u) = (dir(a("theta"), a("phi")), [a("u1"), a("u2")]);
        let ggx = Ggx::new(a("ax"), a("ay"));
        for (key, v) in [
            ("caps_m", ggx.sample_visible(w, u)),
            ("heitz2018_m", ggx.sample_visible_disk(w, u)),
            ("bounded_o", w.reflect(ggx.sample_bounded(w, u))),
        ] {
            for (k, c) in [v.x(), v.y(), v.z()].into_iter().enumerate() {
                check(&r, &format!("/{key}/{k}"), c);
            }
        }
    }
}

pub(crate) fn projections_of_visible_facets() {
    for th in [20, 60, 85] {
        let r = record(&format!("G1.projection.th{th}"));
        let w = dir(f64::from(th), 0.0);
        for (name, kind) in [("ggx", NdfKind::Ggx), ("beckmann", NdfKind::Beckmann)] {
            let ndf = Ndf::new(kind, 0.5, 0.5, 0.0);
            let (mut smith, mut groove) = (0.0, 0.0);
            let n = 600;
            for i in 0..n * n {
                // Points crowd at the horizon: u = 1 - v^3.
                let v = (f64::from(i % n) + 0.5) / f64::from(n);
                let m = ndf.sample([1.0 - v * v * v, (f64::from(i / n) + 0.5) / f64::from(n)]);
                let weight = 3.0 * v * v / f64::from(n * n);
                let cos = w.dot(m).max(0.0);
                smith += weight * cos / m.z() * ndf.g1(w);
                // [Blinn1977]: G_1 (w.m) = min(w.m, 2 (n.m) (n.w)).
                groove += weight * cos.min(2.0 * m.z() * w.z()) / m.z();
            }
            check(&r, &format!("/{name}_smith"), smith / w.z());
            check(&r, &format!("/{name}_vcavity"), groove / w.z());
        }
    }
}

pub(crate) fn walter_s_rational_masking() {
    let r = record("smith.walter_rational_fit_maxrelerr");
    // [Walter2007, eq. 27], for c = 1 / (a tan theta) below 1.6.
    let worst = (1..=16_000)
        .map(|k| {
            let c = f64::from(k) * 1e-4;
            let fit = (3.535 * c + 2.181 * c * c) / (1.0 + 2.276 * c + 2.577 * c * c);
            let exact = Ndf::new(NdfKind::Beckmann, 1.0, 1.0, 0.0)
                .g1(LocalDir::from_angles(Real::atan2(1.0, c), 0.0));
            (fit / exact - 1.0).abs()
        })
        .skip(99)
        .fold(0.0, f64::max);
    check(&r, "", worst);
}

pub(crate) fn bouguer_s_best_distribution() {
    // The best D of each degree of alpha is what mu_i mu_o is worth there on average: error over pairs of directions.
    let r = record("bouguer.best_fit");
    let mut bins = [[0.0f64; 3]; 90];
    let n = 1200u32;
    for k in 0..n * n {
        // Additive sequences in three dimensions: two heights and an azimuth.
        let x = f64::from(k);
        let z = [(x * 0.819_172_513_396_164_4 + 0.5).fract(), (x * 0.671_043_606_703_789_1 + 0.5).fract()];
        let phi = core::f64::consts::TAU * (x * 0.549_700_477_901_970_4 + 0.5).fract();
        let (o, i) =
            (LocalDir::from_angles(Real::acos(z[0]), 0.0), LocalDir::from_angles(Real::acos(z[1]), phi));
        let alpha = Real::acos(o.half(i).z()).to_degrees();
        let product = z[0] * z[1];
        let bin = &mut bins[(alpha as usize).min(89)];
        *bin = [bin[0] + 1.0, bin[1] + product, bin[2] + product * product];
    }
    let (mut rest, mut all) = (0.0, 0.0);
    for [count, sum, squares] in bins {
        rest += squares - sum * sum / f64::max(count, 1.0);
        all += squares;
    }
    check(&r, "/rel_rms", (rest / all).sqrt());
    for (k, bin) in [10, 30, 50].into_iter().enumerate() {
        let path = format!("/pi*D~14 at alpha 10.5, 30.5, 50.5 deg/{k}");
        check(&r, &path, bins[bin][1] / bins[bin][0]);
    }
}

//! Values of the reference sheet for Fresnel terms, distributions, masking, visible normals and albedos.

mod reference;

use reference::record;
use serde_json::Value;
use sparrow_math::{LocalDir, Real};
use sparrow_models::microfacet::special::gauss_quantile;
use sparrow_models::microfacet::{Facets, Masking, Ndf, NdfKind, Sampling, albedo, visible_slope, walk};
use sparrow_models::microfacet::{charlie, groove};
use sparrow_models::{Bsdf, ParamBlock, Surface, SurfaceKind, fresnel, ggx::Ggx};
use sparrow_spectra::Spectrum;

/// A number inside a record, by its path.
fn at(v: &Value, path: &str) -> f64 {
    v.pointer(path).and_then(Value::as_f64).expect("the record has a number there")
}

#[track_caller]
fn check(r: &Value, path: &str, got: f64) {
    let want = at(r, &format!("/value{path}"));
    let tol = at(r, "/tol");
    let bound = tol * want.abs().max(1e-9) + 1e-12;
    assert!((got - want).abs() <= bound, "{} {path}: {got}, want {want}", r["id"]);
}

fn dir(theta_deg: f64, phi_deg: f64) -> LocalDir<f64> {
    LocalDir::from_angles(theta_deg.to_radians(), phi_deg.to_radians())
}

/// The directions (i, o) of a record's pair.
fn pair(r: &Value) -> (LocalDir<f64>, LocalDir<f64>) {
    let a = |k: usize| at(r, &format!("/inputs/pair/{k}"));
    (dir(a(0), a(1)), dir(a(2), a(3)))
}

fn cos_deg(deg: f64) -> f64 {
    Real::cos(deg.to_radians())
}

#[test]
fn fresnel_terms() {
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

#[test]
fn fresnel_approximations_and_averages() {
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

#[test]
fn distributions() {
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

#[test]
fn masking() {
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

#[test]
fn visible_normals() {
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

/// A model at given choices and numbers; spectra of one value each.
fn bind(kind: SurfaceKind, choices: &[u8], reals: &[f64], spectra: &[f64]) -> Surface<f64> {
    let mut p = ParamBlock::defaults(kind.params());
    p.choices[..choices.len()].copy_from_slice(choices);
    p.reals[..reals.len()].copy_from_slice(reals);
    for (slot, v) in p.spectra.iter_mut().zip(spectra) {
        *slot = Spectrum::splat(*v);
    }
    kind.bind(&p)
}

/// Reflecting facets with constant reflectance 1.
fn white(ndf: u8, masking: u8, sampling: u8, energy: u8, ax: f64, ay: f64) -> Surface<f64> {
    bind(
        SurfaceKind::MicrofacetReflection,
        &[ndf, masking, 4, sampling, energy],
        &[ax, ay, 40.0, 2.0],
        &[1.0, 0.0, 1.0, 1.0],
    )
}

#[test]
fn reflecting_facets() {
    for (id, ax, ay) in [("0.3_0.3", 0.3, 0.3), ("0.15_0.5", 0.15, 0.5)] {
        for k in 1..=5 {
            let r = record(&format!("microfacet.F1.a{id}.P{k}"));
            let (i, o) = pair(&r);
            let f = |ndf, masking| white(ndf, masking, 0, 0, ax, ay).f(o, i)[0];
            check(&r, "/ggx_corr", f(0, 0));
            check(&r, "/ggx_uncorr", f(0, 1));
            check(&r, "/beckmann_corr", f(1, 0));
            check(&r, "/beckmann_vcavity", f(1, 2));
            check(&r, "/pdf_vndf_from_o", white(0, 0, 0, 0, ax, ay).pdf(o, i));
            check(&r, "/pdf_vndf_from_o", white(0, 0, 1, 0, ax, ay).pdf(o, i));
            check(&r, "/pdf_bounded_vndf_from_o", white(0, 0, 3, 0, ax, ay).pdf(o, i));
            if ax > 0.2 {
                let r = record(&format!("cooktorrance.m0.3.P{k}"));
                check(&r, "/with_4_and_normalised_D", f(1, 2));
            }
        }
    }
}

#[test]
fn refracting_facets() {
    for (a, b, c) in [(30, 160, 180), (60, 150, 175), (10, 175, 170), (45, 130, 150)] {
        let r = record(&format!("walter.ft.{a}.{b}.{c}"));
        let (i, o) = (dir(f64::from(a), 0.0), dir(f64::from(b), f64::from(c)));
        let m = bind(SurfaceKind::MicrofacetDielectric, &[0, 1, 0], &[1.5, 0.3, 0.3], &[]);
        check(&r, "/f_t", m.f(o, i)[0]);
        let h = (i.v() + o.v() * 1.5).normalized();
        let transmitted = 1.0 - fresnel::dielectric(i.v().dot(h).abs(), 1.5).0;
        check(&r, "/pdf_vndf*jacobian (no Fresnel factor)", m.pdf(i, o) / transmitted);
    }
}

#[test]
fn projections_of_visible_facets() {
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

#[test]
fn albedos_and_compensation() {
    for a in ["0.1", "0.3", "0.5", "0.8", "1.0"] {
        let r = record(&format!("ggx.albedo.a{a}"));
        let alpha: f64 = a.parse().expect("a number");
        for (i, mu) in [0.1, 0.3, 0.5, 0.8, 1.0].into_iter().enumerate() {
            let want = at(&r, &format!("/value/E/{i}"));
            let (e, table) = (albedo::single(mu, alpha, [48, 96]), albedo::ggx().albedo(mu, alpha));
            assert!((e - want).abs() < 5e-4, "{a} {mu}: {e}, want {want}");
            assert!((table - want).abs() < 1e-3, "table {a} {mu}: {table}, want {want}");
        }
        let (mean, want) = (albedo::ggx().mean(alpha), at(&r, "/value/Eavg"));
        assert!((mean - want).abs() < 1e-3, "{a}: {mean}, want {want}");
    }
}

/// A small generator with a fixed seed. [Steele2014]
fn generator(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[test]
fn walks_match_their_records_and_lose_nothing() {
    for (id, mu, alpha, f0) in [
        ("mu0.3.a1.0.f0_None", 0.3, 1.0, None),
        ("mu0.3.a1.0.f0_0.8", 0.3, 1.0, Some(0.8)),
        ("mu0.8.a0.5.f0_0.8", 0.8, 0.5, Some(0.8)),
        ("mu0.1.a0.5.f0_0.5", 0.1, 0.5, Some(0.5)),
    ] {
        let r = record(&format!("ms_walk.{id}"));
        let wo = LocalDir::from_angles(Real::acos(mu), 0.0);
        let mut u = generator(1);
        let n = 150_000;
        let (mut all, mut first) = (0.0, 0.0);
        for _ in 0..n {
            let end =
                walk(&Ggx::new(alpha, alpha), wo, |c| f0.map_or(1.0, |f0| fresnel::schlick(c, f0)), &mut u);
            all += end.weight / f64::from(n);
            first += if end.bounces == 1 { end.weight / f64::from(n) } else { 0.0 };
        }
        // Four standard errors of a share of 150 000.
        let noise = 4.0 * 0.5 / f64::from(n).sqrt();
        let want = at(&r, "/value/albedo_all_orders");
        assert!((all - want).abs() < 2.5e-3, "{id}: {all}, want {want}");
        let want = at(&r, "/value/first_order_quadrature");
        assert!((first - want).abs() < noise, "{id}: {first}, want {want}");
    }
    // The white furnace at all angles.
    let mut u = generator(2);
    for alpha in [0.05, 0.2, 0.5, 1.0] {
        for mu in [1e-3, 0.02, 0.1, 0.3, 0.6, 1.0] {
            let wo = LocalDir::from_angles(Real::acos(mu), 0.4);
            let n = 4000;
            let sum: f64 = (0..n).map(|_| walk(&Ggx::new(alpha, alpha), wo, |_| 1.0, &mut u).weight).sum();
            assert!((sum / f64::from(n) - 1.0).abs() < 1e-3, "{alpha} {mu}: {sum}");
        }
    }
}

/// Mean weight over a grid of the sampling square.
fn furnace(m: &Surface<f64>, mu: f64) -> f64 {
    let wo = LocalDir::from_angles(Real::acos(mu), 0.0);
    let n = 1000;
    let mut sum = 0.0;
    for i in 0..n * n {
        let u = [(f64::from(i % n) + 0.5) / f64::from(n), (f64::from(i / n) + 0.5) / f64::from(n)];
        let s = m.sample(wo, sparrow_models::Uniforms { lobe: 0.5, dir: u });
        sum += if s.valid { s.weight[0] / f64::from(n * n) } else { 0.0 };
    }
    sum
}

#[test]
fn white_furnace_of_each_energy_choice() {
    for alpha in [0.05, 0.2, 0.5, 1.0] {
        for mu in [0.05, 0.1, 0.3, 0.6, 1.0] {
            let single = furnace(&white(0, 0, 0, 0, alpha, alpha), mu);
            let tabulated = albedo::ggx().albedo(mu, alpha);
            assert!((single - tabulated).abs() < 1e-3, "single {alpha} {mu}: {single}, table {tabulated}");
            let turquin = furnace(&white(0, 0, 0, 1, alpha, alpha), mu);
            assert!((turquin - 1.0).abs() < 3e-3, "turquin {alpha} {mu}: {turquin}");
            // The diffuse lobe is the same all around; on smooth surfaces it is bright at grazing angles alone.
            let (both, one) = (white(0, 0, 0, 2, alpha, alpha), white(0, 0, 0, 0, alpha, alpha));
            let wo = LocalDir::from_angles(Real::acos(mu), 0.0);
            let n = 2000;
            let diffuse: f64 = (0..n)
                .map(|i| {
                    let x = (f64::from(i) + 0.5) / f64::from(n);
                    let wi = LocalDir::from_angles(Real::acos(x * x), 1.5);
                    let f = both.f(wo, wi)[0] - one.f(wo, wi)[0];
                    f * x * x * core::f64::consts::TAU * 2.0 * x / f64::from(n)
                })
                .sum();
            let kulla_conty = single + diffuse;
            assert!((kulla_conty - 1.0).abs() < 3e-3, "kulla-conty {alpha} {mu}: {kulla_conty}");
        }
    }
}

#[test]
fn charlie_sheen() {
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

#[test]
fn bounces_in_v_grooves() {
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

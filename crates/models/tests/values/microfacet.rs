//! Models of facets: values, densities, albedos, and what is done about light that meets several facets.

use sparrow_math::{LocalDir, Real};
use sparrow_models::microfacet::{albedo, walk};
use sparrow_models::{Bsdf, Surface, SurfaceKind, Uniforms, fresnel, ggx::Ggx};

use crate::read::{at, bind, check, dir, pair};
use crate::reference::record;

/// Reflecting facets with constant reflectance 1.
fn white(ndf: u8, masking: u8, sampling: u8, energy: u8, ax: f64, ay: f64) -> Surface<f64> {
    bind(
        SurfaceKind::MicrofacetReflection,
        &[ndf, masking, 4, sampling, energy],
        &[ax, ay, 40.0, 2.0],
        &[1.0, 0.0, 1.0, 1.0],
    )
}

pub(crate) fn reflecting_facets() {
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

pub(crate) fn refracting_facets() {
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

pub(crate) fn albedos_and_compensation() {
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

pub(crate) fn walks_match_their_records_and_lose_nothing() {
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
        let s = m.sample(wo, Uniforms { lobe: 0.5, dir: u });
        sum += if s.valid { s.weight[0] / f64::from(n * n) } else { 0.0 };
    }
    sum
}

pub(crate) fn white_furnace_of_each_energy_choice() {
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

/// Mean weights reflected and transmitted, as energy, over a grid of uniform numbers.
fn sides(m: &Surface<f64>, wo: LocalDir<f64>, n: usize) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for k in 0..n * n {
        let u = [(k % n) as f64 + 0.5, (k / n) as f64 + 0.5].map(|x| x / n as f64);
        let lobe = (k as f64 * 0.618_033_988_749_894_9).fract();
        let s = m.sample(wo, Uniforms { lobe, dir: u });
        let to = usize::from(!wo.same_side(s.wi));
        sum[to] += if s.valid { s.weight[0] * s.eta * s.eta / (n * n) as f64 } else { 0.0 };
    }
    sum
}

/// Mean over samples of the first wavelength's weight as energy, and its standard error.
fn mean_energy(m: &Surface<f64>, wo: LocalDir<f64>, n: u32, seed: u64) -> (f64, f64) {
    let mut u = generator(seed);
    let (mut sum, mut squares) = (0.0, 0.0);
    for _ in 0..n {
        let s = m.sample(wo, Uniforms { lobe: u(), dir: [u(), u()] });
        let w = if s.valid { s.weight[0] * s.eta * s.eta } else { 0.0 };
        (sum, squares) = (sum + w, squares + w * w);
    }
    let mean = sum / f64::from(n);
    (mean, ((squares / f64::from(n) - mean * mean) / f64::from(n)).max(0.0).sqrt())
}

pub(crate) fn models_that_walk_lose_nothing() {
    // Refraction of a narrow lobe into itself makes the walk through boundaries much noisier.
    let near = |(mean, error): (f64, f64), case: &str| {
        assert!((mean - 1.0).abs() < 1e-3 + 4.0 * error, "{case}: {mean} +- {error}");
        let says_little = if case.starts_with("mirrors") { 3e-3 } else { 1.6e-2 };
        assert!(error < says_little, "{case}: +- {error} says little");
    };
    for alpha in [0.05, 0.2, 0.5, 1.0] {
        for mu in [0.01, 0.1, 0.3, 0.6, 1.0] {
            let wo = LocalDir::from_angles(Real::acos(mu), 0.4);
            let m = white(0, 0, 0, 3, alpha, alpha);
            near(mean_energy(&m, wo, 400_000, 1), &format!("mirrors {alpha} {mu}"));
        }
        for (eta, mu) in [(1.5, 0.7), (1.5, 0.1), (1.5, -0.7), (1.5, -0.2), (2.4, 0.4), (0.7, 0.3)] {
            let wo = LocalDir::from_angles(Real::acos(mu), 0.4);
            let m = bind(SurfaceKind::MicrofacetDielectric, &[0, 0, 0, 3], &[eta, alpha, alpha], &[]);
            near(mean_energy(&m, wo, 400_000, 2), &format!("boundary {alpha} {eta} {mu}"));
        }
    }
    // Two widths.
    let wo = dir(70.0, 20.0);
    near(mean_energy(&white(0, 0, 0, 3, 0.2, 0.9), wo, 400_000, 3), "mirrors of two widths");
    let m = bind(SurfaceKind::MicrofacetDielectric, &[0, 0, 0, 3], &[1.5, 0.2, 0.9], &[]);
    near(mean_energy(&m, wo, 400_000, 4), "boundary of two widths");
    // Coloured facets.
    for (id, mu, alpha, f0) in [
        ("mu0.3.a1.0.f0_0.8", 0.3, 1.0, 0.8),
        ("mu0.8.a0.5.f0_0.8", 0.8, 0.5, 0.8),
        ("mu0.1.a0.5.f0_0.5", 0.1, 0.5, 0.5),
    ] {
        let reals = [alpha, alpha, 40.0, 2.0];
        let m = bind(SurfaceKind::MicrofacetReflection, &[0, 0, 2, 0, 3], &reals, &[1.0, 0.0, f0, 1.0]);
        let (mean, error) = mean_energy(&m, LocalDir::from_angles(Real::acos(mu), 0.0), 400_000, 5);
        let want = at(&record(&format!("ms_walk.{id}")), "/value/albedo_all_orders");
        // The record is itself a mean of walks.
        assert!((mean - want).abs() < 2e-3 + 4.0 * error, "{id}: {mean} +- {error}, want {want}");
    }
}

pub(crate) fn walks_of_a_pair_are_the_same_either_way_round() {
    let pairs = [(40.0, 10.0, 70.0, 100.0), (40.0, 10.0, 120.0, 200.0), (95.0, 10.0, 100.0, 30.0)];
    for (eta, (a, b, c, d)) in [1.5, 0.6].into_iter().flat_map(|eta| pairs.map(|p| (eta, p))) {
        let (o, i) = (dir(a, b), dir(c, d));
        let m = bind(SurfaceKind::MicrofacetDielectric, &[0, 0, 0, 3], &[eta, 0.7, 0.4], &[]);
        let squeeze = match (o.above(), i.above()) {
            (true, false) => eta * eta,
            (false, true) => 1.0 / (eta * eta),
            _ => 1.0,
        };
        let (there, back) = (m.f(o, i)[0] * squeeze, m.f(i, o)[0]);
        assert!(there > 0.0 && (there - back).abs() < 1e-9 * there, "{eta} {o:?} {i:?}: {there} {back}");
        assert_eq!(m.f(o, i), m.f(o, i));
        let m = white(0, 0, 0, 3, 0.7, 0.4);
        let (there, back) = (m.f(o, i)[0], m.f(i, o)[0]);
        assert!((there - back).abs() <= 1e-9 * there, "mirrors {o:?} {i:?}: {there} {back}");
    }
}

pub(crate) fn light_on_either_side_of_a_boundary() {
    for (mu, alpha, id) in
        [(0.9, 0.3, "mu0.9.a0.3.1to1.5"), (0.3, 0.5, "mu0.3.a0.5.1to1.5"), (0.7, 0.3, "mu0.7.a0.3.1.5to1.0")]
    {
        let r = record(&format!("walter.albedo.{id}"));
        let below = id.ends_with("1.0");
        let wo = LocalDir::from_angles(Real::acos(if below { -mu } else { mu }), 0.0);
        let shares = |masking| {
            let m = bind(SurfaceKind::MicrofacetDielectric, &[0, masking, 0, 0], &[1.5, alpha, alpha], &[]);
            let (n, mut sum) = (512, [0.0; 2]);
            for k in 0..n * n {
                let dir = [f64::from(k % n) + 0.5, f64::from(k / n) + 0.5].map(|x| x / f64::from(n));
                // Either lobe for each facet, weighed by its chance.
                let [up, down] = [0.0, 1.0 - 1e-12].map(|lobe| m.sample(wo, Uniforms { lobe, dir }));
                let chance =
                    fresnel::dielectric(wo.dot(wo.half(up.wi)).abs(), if below { 1.0 / 1.5 } else { 1.5 }).0;
                sum[0] += if up.valid { up.weight[0] * chance } else { 0.0 };
                sum[1] += if down.valid && !wo.same_side(down.wi) {
                    down.weight[0] * (1.0 - chance) * down.eta * down.eta
                } else {
                    0.0
                };
            }
            sum.map(|s| s / f64::from(n * n))
        };
        let [up, down] = shares(0);
        check(&r, "/R(corr G)", up);
        check(&r, "/T(beta G)", down);
        check(&r, "/R+T(beta)", up + down);
        check(&r, "/T(separable G)", shares(1)[1]);
    }
}

pub(crate) fn white_furnace_of_each_energy_choice_of_a_boundary() {
    for (alpha, eta) in [(0.1, 1.5), (0.4, 1.5), (0.9, 1.33), (0.6, 2.4)] {
        for mu in [1.0, 0.7, 0.3, 0.1] {
            for from in [mu, -mu] {
                let wo = LocalDir::from_angles(Real::acos(from), 0.3);
                let m = |energy| {
                    bind(SurfaceKind::MicrofacetDielectric, &[0, 0, 0, energy], &[eta, alpha, alpha], &[])
                };
                for energy in [1, 2] {
                    let [up, down] = sides(&m(energy), wo, 300);
                    // The table errs by 0.014, the grid by 0.005.
                    assert!((up + down - 1.0).abs() < 0.019, "{energy}: {alpha} {eta} {from}: {up} + {down}");
                }
            }
        }
        // The diffuse lobes are reciprocal up to the square of the index.
        let m = bind(SurfaceKind::MicrofacetDielectric, &[0, 0, 0, 2], &[eta, alpha, alpha], &[]);
        let (up, down) = (dir(40.0, 10.0), dir(120.0, 200.0));
        let (a, b) = (m.f(up, down)[0] * eta * eta, m.f(down, up)[0]);
        assert!((a - b).abs() < 1e-9 * a, "{alpha} {eta}: {a} {b}");
        let (a, b) = (m.f(up, dir(70.0, 100.0))[0], m.f(dir(70.0, 100.0), up)[0]);
        assert!((a - b).abs() < 1e-9 * a, "{alpha} {eta}: {a} {b}");
    }
}

pub(crate) fn masses_of_densities_above() {
    for (id, ax, ay, theta) in
        [("0.5.0.5.70", 0.5, 0.5, 70.0), ("0.2.0.6.60", 0.2, 0.6, 60.0), ("1.0.1.0.80", 1.0, 1.0, 80.0)]
    {
        let r = record(&format!("vndf.pdfmass.{id}"));
        let wo = dir(theta, 25.0);
        for (key, sampling) in [("/vndf", 0), ("/bounded_vndf", 3)] {
            let m = white(0, 0, sampling, 0, ax, ay);
            let n = 700;
            let mut sum = 0.0;
            for k in 0..n * n {
                let z = (f64::from(k % n) + 0.5) / f64::from(n);
                let phi = core::f64::consts::TAU * (f64::from(k / n) + 0.5) / f64::from(n);
                sum += m.pdf(wo, LocalDir::from_angles(Real::acos(z), phi));
            }
            check(&r, key, sum * core::f64::consts::TAU / f64::from(n * n));
        }
    }
}

pub(crate) fn compensation_of_reflecting_facets() {
    for alpha in ["0.5", "1.0"] {
        for f0 in ["0.5", "0.9"] {
            let r = record(&format!("kullaconty.a{alpha}.f0_{f0}"));
            let (a, f0): (f64, f64) = (alpha.parse().expect("a number"), f0.parse().expect("a number"));
            let f = |fresnel, energy, o, i| {
                let choices = [0, 0, fresnel, 0, energy];
                bind(SurfaceKind::MicrofacetReflection, &choices, &[a, a, 40.0, 2.0], &[1.0, 0.0, f0, 1.0])
                    .f(o, i)[0]
            };
            let (i, o) =
                (LocalDir::from_angles(Real::acos(0.3), 2.0), LocalDir::from_angles(Real::acos(0.8), 0.0));
            let lobe = f(2, 2, o, i) - f(2, 0, o, i);
            let white = white(0, 0, 0, 2, a, a).f(o, i)[0] - white(0, 0, 0, 0, a, a).f(o, i)[0];
            let turquin = f(2, 1, i, o) / f(2, 0, i, o);
            // The table of albedos is exact to 1e-3, of which the lobe takes differences from one.
            for (key, got, tol) in [
                ("/f_ms(F=1)", white, 1e-2),
                ("/Fms_corrected", lobe / white, 3e-3),
                ("/turquin_scale(mu_o=0.3)", turquin, 2e-3),
            ] {
                let want = at(&r, &format!("/value{key}"));
                assert!((got - want).abs() < tol * want, "{} {key}: {got}, want {want}", r["id"]);
            }
        }
    }
}

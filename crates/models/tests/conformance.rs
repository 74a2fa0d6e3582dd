//! Every registered model, over random parameters of its own table: density, weights, energy, edges. Lanes are held to scalars in `batch.rs`.

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::{
    Bsdf, Lack, MAX_CHOICES, MAX_REALS, MAX_SPECTRA, ParamBlock, ParamKind, Surface, SurfaceKind, Uniforms,
};
use sparrow_spectra::Spectrum;

/// A small generator with a fixed seed. [Steele2014]
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Parameters whose square is a slope width.
const ROUGHNESS: [&str; 2] = ["specular_roughness", "coat_roughness"];

/// The model has lobes too narrow for the grids of a test.
fn is_narrow(kind: SurfaceKind, p: &ParamBlock<f64>) -> bool {
    let reals = kind.params().iter().filter(|p| p.kind == ParamKind::Real);
    reals.zip(&p.reals).any(|(info, &v)| {
        (info.name.starts_with("alpha") && v > 0.0 && v < 0.1)
            || (ROUGHNESS.contains(&info.name) && v * v < 0.1)
    })
}

/// Random parameters from the model's table; spectra without an upper bound stay below 8.
fn random_params(kind: SurfaceKind, rng: &mut Random) -> ParamBlock<f64> {
    let mut block = ParamBlock::<f64>::defaults(kind.params());
    let (mut r, mut s, mut c) = (0, 0, 0);
    for p in kind.params() {
        let draw = |rng: &mut Random, lo: f64, hi: f64| lo + (hi - lo) * rng.next();
        match p.kind {
            ParamKind::Real => {
                // Roughness is drawn evenly in its logarithm, down to where the surface counts as a mirror.
                block.reals[r] = if p.name.starts_with("alpha") {
                    Real::exp(draw(rng, Real::ln(0.02), 0.0))
                } else if ROUGHNESS.contains(&p.name) {
                    Real::exp(0.5 * draw(rng, Real::ln(0.02), 0.0))
                } else {
                    draw(rng, p.soft[0], p.soft[1])
                };
                r += 1;
            }
            ParamKind::Albedo => {
                // Models with several shares promise energy only where their sum stays below one.
                let n = kind.params().iter().filter(|p| p.kind == ParamKind::Albedo).count() as f64;
                block.spectra[s] = Spectrum([(); 4].map(|()| rng.next() / n));
                s += 1;
            }
            ParamKind::Unbounded => {
                block.spectra[s] = Spectrum([(); 4].map(|()| 0.1 + 8.0 * rng.next()));
                s += 1;
            }
            ParamKind::Choice(names) => {
                block.choices[c] = ((rng.next() * names.len() as f64) as usize).min(names.len() - 1) as u8;
                c += 1;
            }
        }
    }
    block.lambda = Spectrum([(); 4].map(|()| 360.0 + 470.0 * rng.next()));
    block
}

fn direction(rng: &mut Random, lower: bool) -> LocalDir<f64> {
    let z = 0.02 + 0.98 * rng.next();
    let phi = core::f64::consts::TAU * rng.next();
    let r = (1.0 - z * z).sqrt();
    let (s, c) = Real::sin_cos(phi);
    LocalDir::new(vec3(r * c, r * s, if lower { -z } else { z }))
}

/// Every model at several parameter sets and views, from above and from below.
fn trials(
    n: usize,
    mut ask: impl FnMut(SurfaceKind, &ParamBlock<f64>, Surface<f64>, LocalDir<f64>, &mut Random),
) {
    for &kind in SurfaceKind::ALL {
        let mut rng = Random(0x5eed);
        for i in 0..n {
            let p = random_params(kind, &mut rng);
            let wo = direction(&mut rng, i % 3 == 2);
            ask(kind, &p, kind.bind(&p), wo, &mut rng);
        }
    }
}

#[test]
fn tables_fit_the_parameter_block_and_names_are_unique() {
    let mut names: Vec<&str> = SurfaceKind::ALL.iter().map(|k| k.name()).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), SurfaceKind::ALL.len());
    for &kind in SurfaceKind::ALL {
        let count = |of: fn(&ParamKind) -> bool| kind.params().iter().filter(|p| of(&p.kind)).count();
        assert!(count(|k| matches!(k, ParamKind::Real)) <= MAX_REALS, "{}", kind.name());
        assert!(count(|k| matches!(k, ParamKind::Choice(_))) <= MAX_CHOICES, "{}", kind.name());
        assert!(
            count(|k| matches!(k, ParamKind::Albedo | ParamKind::Unbounded)) <= MAX_SPECTRA,
            "{}",
            kind.name()
        );
        assert_eq!(SurfaceKind::from_name(kind.name()), Some(kind));
        for p in kind.params() {
            assert!(p.range[0] <= p.default && p.default <= p.range[1] && !p.doc.is_empty(), "{}", p.name);
        }
    }
}

#[test]
fn every_file_of_the_folder_is_registered() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/surface");
    let files: Vec<String> = std::fs::read_dir(folder)
        .expect("the folder of models")
        .filter_map(|f| f.ok()?.file_name().to_str()?.strip_suffix(".rs").map(String::from))
        .filter(|f| f != "mod")
        .collect();
    assert_eq!(files.len(), SurfaceKind::ALL.len(), "{files:?}");
    for f in files {
        assert!(SurfaceKind::from_name(&f).is_some(), "{f}.rs is not in the table of surface/mod.rs");
    }
}

#[test]
fn weight_is_value_over_density_and_the_density_is_that_of_pdf() {
    trials(400, |kind, p, m, wo, rng| {
        for _ in 0..20 {
            let s = m.sample(wo, Uniforms { lobe: rng.next(), dir: [rng.next(), rng.next()] });
            if !s.valid || s.delta {
                continue;
            }
            let (f_cos, pdf) = m.f_cos_pdf(wo, s.wi);
            // Half vectors of refraction near grazing lose digits: (eta i.m + o.m)^2 nearly cancels.
            assert!((pdf - s.density).abs() <= 1e-5 * pdf, "{} {p:?} {wo:?} {s:?} pdf {pdf}", kind.name());
            for i in 0..4 {
                let want = f_cos[i] / pdf;
                assert!(
                    (s.weight[i] - want).abs() <= 1e-5 * want.max(1e-6),
                    "{} {p:?} {s:?}: {want}",
                    kind.name()
                );
            }
            let length = s.wi.v().length();
            assert!((length - 1.0).abs() < 1e-9, "{} {length}", kind.name());
        }
    });
}

/// Integral over the sphere by the midpoint rule in (cos theta, phi).
fn integrate_sphere(n: usize, f: impl Fn(LocalDir<f64>) -> f64) -> f64 {
    let mut sum = 0.0;
    for i in 0..n {
        let z = -1.0 + 2.0 * (i as f64 + 0.5) / n as f64;
        let r = (1.0 - z * z).sqrt();
        for j in 0..2 * n {
            let phi = core::f64::consts::PI * (j as f64 + 0.5) / n as f64;
            let (s, c) = Real::sin_cos(phi);
            sum += f(LocalDir::new(vec3(r * c, r * s, z)));
        }
    }
    sum * 2.0 * core::f64::consts::PI / (n * n) as f64
}

#[test]
fn the_density_integrates_to_what_sampling_keeps() {
    trials(8, |kind, p, m, wo, rng| {
        if !m.has_smooth_lobe() || is_narrow(kind, p) {
            return; // Narrow lobes need a finer grid than a unit test can pay for.
        }
        let total = integrate_sphere(400, |wi| m.pdf(wo, wi));
        let n = 4000;
        let kept = (0..n)
            .filter(|_| m.sample(wo, Uniforms { lobe: rng.next(), dir: [rng.next(), rng.next()] }).valid)
            .count() as f64
            / f64::from(n);
        // Quadrature 1 %, and four standard errors of the share.
        assert!(
            (total - kept).abs() < 0.01 + 4.0 * 0.5 / f64::from(n).sqrt(),
            "{} {p:?} {wo:?}: {total} against {kept}",
            kind.name()
        );
        assert!(total < 1.01, "{} {p:?}: {total}", kind.name());
    });
}

#[test]
fn samples_follow_the_density() {
    // Chi-square over 8 x 16 cells of equal solid angle against the density, integrated on a 16 x 16 grid per cell.
    trials(4, |kind, p, m, wo, rng| {
        if !m.has_smooth_lobe() || is_narrow(kind, p) {
            return;
        }
        let (nz, np, n) = (8usize, 16usize, 20_000);
        let mut counts = vec![0.0; nz * np];
        for _ in 0..n {
            let s = m.sample(wo, Uniforms { lobe: rng.next(), dir: [rng.next(), rng.next()] });
            if s.valid {
                let phi = Real::atan2(s.wi.y(), s.wi.x()).rem_euclid(2.0 * core::f64::consts::PI);
                let i = (((s.wi.z() + 1.0) / 2.0 * nz as f64) as usize).min(nz - 1);
                let j = ((phi / (2.0 * core::f64::consts::PI) * np as f64) as usize).min(np - 1);
                counts[i * np + j] += 1.0;
            }
        }
        let (mut chi2, mut cells) = (0.0, 0.0);
        let sub = 24;
        for i in 0..nz {
            for j in 0..np {
                let mut expected = 0.0;
                for a in 0..sub * sub {
                    let z = -1.0 + 2.0 * (i as f64 + ((a % sub) as f64 + 0.5) / sub as f64) / nz as f64;
                    let phi =
                        2.0 * core::f64::consts::PI * (j as f64 + ((a / sub) as f64 + 0.5) / sub as f64)
                            / np as f64;
                    let (s, c) = Real::sin_cos(phi);
                    let r = (1.0 - z * z).sqrt();
                    expected += m.pdf(wo, LocalDir::new(vec3(r * c, r * s, z)));
                }
                expected *= f64::from(n) * 4.0 * core::f64::consts::PI / (nz * np * sub * sub) as f64;
                if expected > 5.0 {
                    chi2 += (counts[i * np + j] - expected).powi(2) / expected;
                    cells += 1.0;
                }
            }
        }
        // Six standard deviations of chi-square, and 3 % of the cells for the quadrature.
        assert!(
            chi2 < 1.03 * cells + 6.0 * f64::sqrt(2.0 * cells),
            "{} {p:?} {wo:?}: chi2 {chi2} over {cells} cells",
            kind.name()
        );
    });
}

#[test]
fn no_more_light_leaves_than_arrived() {
    trials(200, |kind, p, m, wo, rng| {
        if kind.about().lacks.iter().any(|(what, _)| *what == Lack::Energy) {
            return;
        }
        let n = 2000;
        let (mut sum, mut sum2) = (0.0, 0.0);
        for _ in 0..n {
            let s = m.sample(wo, Uniforms { lobe: rng.next(), dir: [rng.next(), rng.next()] });
            // Energy, not radiance: the squeeze of refraction is taken back.
            let w = if s.valid { s.weight.max_value() * s.eta * s.eta } else { 0.0 };
            sum += w;
            sum2 += w * w;
        }
        let mean = sum / f64::from(n);
        let error = ((sum2 / f64::from(n) - mean * mean).max(0.0) / f64::from(n)).sqrt();
        assert!(mean < 1.0 + 4.0 * error + 1e-9, "{} {p:?} {wo:?}: {mean} +- {error}", kind.name());
    });
}

#[test]
fn reciprocity_up_to_the_square_of_eta() {
    trials(300, |kind, p, m, wo, rng| {
        if kind.about().lacks.iter().any(|(what, _)| *what == Lack::Reciprocity) {
            return;
        }
        let below = rng.next() < 0.5;
        let wi = direction(rng, below);
        let (a, b) = (m.f(wo, wi), m.f(wi, wo));
        // A transmitted value is in proportion to the squared index of its viewer's side.
        let eta = p.reals[0];
        let transmits = kind.params()[0].name == "eta" && kind.about().transmits && wo.z() * wi.z() < 0.0;
        let squeeze = if !transmits {
            1.0
        } else if wo.z() > 0.0 {
            eta * eta
        } else {
            1.0 / (eta * eta)
        };
        for i in 0..4 {
            let (x, y) = (a[i] * squeeze, b[i]);
            // Values far below any lobe carry no light; rounding decides their last digits.
            assert!(
                (x - y).abs() <= 1e-7 * x.abs().max(y.abs()) + 1e-12,
                "{} {p:?} {wo:?} {wi:?}: {x} {y}",
                kind.name()
            );
        }
    });
}

#[test]
fn edges_give_no_nan_and_nothing_negative() {
    let grazing = [1.0, 0.3, 1e-3, 1e-4, 1e-7];
    for &kind in SurfaceKind::ALL {
        let mut rng = Random(7);
        for alpha in [0.0, 1e-3, 0.05, 1.0] {
            let mut p = random_params(kind, &mut rng);
            for (i, info) in kind.params().iter().filter(|p| p.kind == ParamKind::Real).enumerate() {
                if info.name.starts_with("alpha") {
                    p.reals[i] = alpha;
                }
            }
            let p32 = to_f32(&p);
            let m = kind.bind(&p32);
            for z in grazing {
                for sign in [1.0f32, -1.0] {
                    let wo = LocalDir::new(vec3((1.0 - z * z).sqrt(), 0.0, sign * z));
                    let mirror = LocalDir::new(vec3(-wo.x(), 0.0, wo.z()));
                    for wi in [wo, mirror, -wo, -mirror, LocalDir::new(vec3(0.0, 1.0, 0.0))] {
                        let (f, pdf) = m.f_cos_pdf(wo, wi);
                        assert!(
                            f.0.iter().all(|v| *v >= 0.0 && v.is_finite()) && pdf >= 0.0 && pdf.is_finite(),
                            "{} {p32:?} {wo:?} {wi:?}: {f:?} {pdf}",
                            kind.name()
                        );
                    }
                    for u in [0.0, 0.5, sparrow_math::ONE_MINUS_EPSILON] {
                        let s = m.sample(wo, Uniforms { lobe: u, dir: [u, u] });
                        assert!(
                            s.weight.is_finite() && s.density.is_finite() && s.wi.v().is_finite(),
                            "{} {p32:?} {wo:?} {s:?}",
                            kind.name()
                        );
                        assert!(s.weight.0.iter().all(|v| *v >= 0.0) && s.density >= 0.0);
                    }
                }
            }
        }
    }
}

fn to_f32(p: &ParamBlock<f64>) -> ParamBlock<f32> {
    ParamBlock {
        reals: p.reals.map(|v| v as f32),
        spectra: p.spectra.map(|s| Spectrum(s.0.map(|v| v as f32))),
        choices: p.choices,
        lambda: Spectrum(p.lambda.0.map(|v| v as f32)),
    }
}

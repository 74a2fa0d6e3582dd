//! The batch form against one call per point, bit for bit, tails included.

use sparrow_math::{LocalDir, vec3};
use sparrow_models::batch::{self, DirColumns, EvalColumns, ParamColumns, SampleColumns};
use sparrow_models::{
    Bcsdf, Bsdf, BsdfSample, Fibre, FibreKind, Kind, ParamBlock, ParamKind, Surface, SurfaceKind, Uniforms,
};
use sparrow_spectra::Spectrum;

/// Not a multiple of eight, so that the tail is used.
const N: usize = 203;

fn noise(seed: u32) -> Vec<f32> {
    let mut s = u64::from(seed) * 7919 + 1;
    (0..N)
        .map(|_| {
            s = s.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (s >> 40) as f32 / (1u64 << 24) as f32
        })
        .collect()
}

fn directions(seed: u32) -> [Vec<f32>; 3] {
    let (a, b) = (noise(seed), noise(seed + 1));
    let d: Vec<[f32; 3]> = a
        .iter()
        .zip(&b)
        .map(|(&a, &b)| vec3(a - 0.5, b - 0.5, (a * 13.0).fract() - 0.3).normalized().to_array())
        .collect();
    [0, 1, 2].map(|k| d.iter().map(|v| v[k]).collect())
}

#[test]
fn batches_equal_single_calls_bit_for_bit() {
    // Every choice at its first, second and third place.
    for place in [0, 1, 2] {
        for &kind in SurfaceKind::ALL {
            hold(kind, place, |block, wo, wi, u| {
                let m: Surface<f32> = kind.bind(block);
                (m.f_cos_pdf(wo, wi), m.sample(wo, u))
            });
        }
        for &kind in FibreKind::ALL {
            hold(kind, place, |block, wo, wi, u| {
                let m: Fibre<f32> = kind.bind(block);
                (m.f_cos_pdf(wo, wi), m.sample(wo, u))
            });
        }
    }
}

type Answer = ((Spectrum<f32>, f32), BsdfSample<f32>);

/// One model, its choices at the `place`-th name.
fn hold<K: Kind>(
    kind: K,
    place: u8,
    single: impl Fn(&ParamBlock<f32>, LocalDir<f32>, LocalDir<f32>, Uniforms<f32>) -> Answer,
) {
    let (wo, wi) = (directions(1), directions(3));
    let u = [noise(5), noise(6), noise(7)];
    let alpha: Vec<f32> = noise(8).iter().map(|v| 0.01 + 0.8 * v).collect();
    let spectrum = [noise(9), noise(10), noise(11), noise(12)];
    let nm = noise(13).iter().map(|v| 360.0 + 470.0 * v).collect::<Vec<f32>>();
    let h: Vec<f32> = noise(14).iter().map(|v| 2.0 * v - 1.0).collect();
    let mut p = ParamColumns { h: &h, lambda: [&nm, &[450.0], &nm, &[600.0]], ..ParamColumns::default() };
    let (mut r, mut s, mut c) = (0, 0, 0);
    for info in kind.params() {
        if info.kind == ParamKind::Real {
            // A column where roughness varies, one number for all where it does not.
            p.reals[r] = if info.name.starts_with("alpha") { &alpha } else { &[1.5] };
            r += 1;
        } else if let ParamKind::Choice(names) = info.kind {
            p.choices[c] = (names.len() as u8 - 1).min(place);
            c += 1;
        } else {
            p.spectra[s] = [&spectrum[0], &spectrum[1], &spectrum[2], &spectrum[3]];
            s += 1;
        }
    }
    let mut e = [(); 5].map(|()| vec![0.0; N]);
    let [a, b, c, d, pdf] = &mut e;
    let from = DirColumns { x: &wo[0], y: &wo[1], z: &wo[2] };
    let to = DirColumns { x: &wi[0], y: &wi[1], z: &wi[2] };
    batch::f_cos_pdf(kind, &p, &from, &to, &mut EvalColumns { f_cos: [a, b, c, d], pdf });
    let mut t = [(); 10].map(|()| vec![0.0; N]);
    let [wx, wy, wz, a, b, c, d, density, eta, delta] = &mut t;
    let mut out = SampleColumns { wi: [wx, wy, wz], weight: [a, b, c, d], density, eta, delta };
    batch::sample(kind, &p, &from, &[&u[0], &u[1], &u[2]], &mut out);
    for i in 0..N {
        let mut block = ParamBlock::<f32> { choices: p.choices, ..ParamBlock::default() };
        let at = |c: &[f32]| match c {
            [] => 0.0,
            [one] => *one,
            all => all[i],
        };
        for k in 0..block.reals.len() {
            block.reals[k] = at(p.reals[k]);
        }
        for k in 0..block.spectra.len() {
            block.spectra[k].0 = p.spectra[k].map(at);
        }
        block.lambda.0 = p.lambda.map(at);
        block.h = at(p.h);
        let at = |d: &[Vec<f32>; 3]| LocalDir::new(vec3(d[0][i], d[1][i], d[2][i]));
        let u = Uniforms { lobe: u[0][i], dir: [u[1][i], u[2][i]] };
        let ((f, pdf), s) = single(&block, at(&wo), at(&wi), u);
        let same = |a: f32, b: f32| a.to_bits() == b.to_bits() || (a.abs() < 1e-37 && b.abs() < 1e-37);
        for w in 0..4 {
            assert!(same(e[w][i], f[w]), "{} f at {i}: {} {}", kind.name(), e[w][i], f[w]);
            let want = if s.valid { s.weight[w] } else { 0.0 };
            assert!(same(t[3 + w][i], want), "{} weight at {i}", kind.name());
        }
        assert!(same(e[4][i], pdf), "{} pdf at {i}", kind.name());
        assert!(same(t[7][i], if s.valid { s.density } else { 0.0 }), "{} density at {i}", kind.name());
        assert!(same(t[2][i], s.wi.z()), "{} wi at {i}", kind.name());
    }
}

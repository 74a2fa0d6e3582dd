//! Time of one evaluation of each model: one call each in `f32` and `f64`, and the batch form in lanes.
//!
//! `cargo bench -p sparrow-models`; figures are per 4096 points, thus ns per point = time / 4096.

#![allow(missing_docs, reason = "macros of the harness make undocumented items")]

use criterion::{Criterion, criterion_group, criterion_main};
use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::batch::{self, DirColumns, EvalColumns, ParamColumns, SampleColumns};
use sparrow_models::{
    Bcsdf, Bsdf, Fibre, FibreKind, Kind, ParamBlock, ParamKind, Surface, SurfaceKind, Uniforms,
};
use std::hint::black_box;

const N: usize = 4096;

/// Columns of inputs, from a small generator with a fixed seed.
struct Inputs {
    wo: [Vec<f32>; 3],
    wi: [Vec<f32>; 3],
    u: [Vec<f32>; 3],
    h: Vec<f32>,
    reals: Vec<f32>,
    spectra: Vec<f32>,
}

impl Inputs {
    fn new(kind: impl Kind) -> Inputs {
        let mut state = 1u64;
        let mut next = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1u64 << 24) as f32
        };
        let mut dirs = |lower: f32| {
            let mut c = [(); 3].map(|()| Vec::with_capacity(N));
            for _ in 0..N {
                let z = 0.05 + 0.95 * next();
                let r = (1.0 - z * z).sqrt();
                let (sin, cos) = Real::sin_cos(core::f32::consts::TAU * next());
                let z = if next() < lower { -z } else { z };
                for (column, v) in c.iter_mut().zip([r * cos, r * sin, z]) {
                    column.push(v);
                }
            }
            c
        };
        let (wo, wi) = (dirs(0.0), dirs(0.3));
        let u = [(); 3].map(|()| (0..N).map(|_| next()).collect());
        let h = (0..N).map(|_| 2.0 * next() - 1.0).collect();
        let table = kind.params();
        let reals = table.iter().filter(|p| p.kind == ParamKind::Real);
        let reals = reals
            .map(|p| if p.name.starts_with("alpha") && p.unit == "1" { 0.2 } else { p.default as f32 })
            .collect();
        let spectra = table
            .iter()
            .filter(|p| matches!(p.kind, ParamKind::Albedo | ParamKind::Unbounded))
            .map(|p| p.default as f32)
            .collect();
        Inputs { wo, wi, u, h, reals, spectra }
    }
    fn columns(&self) -> ParamColumns<'_> {
        let mut p = ParamColumns { h: &self.h, ..ParamColumns::default() };
        for (slot, v) in p.reals.iter_mut().zip(self.reals.chunks(1)) {
            *slot = v;
        }
        for (slot, v) in p.spectra.iter_mut().zip(self.spectra.chunks(1)) {
            *slot = [v; 4];
        }
        p
    }
    fn block<R: Real>(&self) -> ParamBlock<R> {
        let mut b = ParamBlock::default();
        for (slot, v) in b.reals.iter_mut().zip(&self.reals) {
            *slot = R::of(f64::from(*v));
        }
        for (slot, v) in b.spectra.iter_mut().zip(&self.spectra) {
            *slot = sparrow_spectra::Spectrum::splat(R::of(f64::from(*v)));
        }
        b
    }
}

fn columns(c: &[Vec<f32>; 3]) -> DirColumns<'_> {
    DirColumns { x: &c[0], y: &c[1], z: &c[2] }
}

fn dir<R: Real>(c: &[Vec<f32>; 3], i: usize) -> LocalDir<R> {
    LocalDir::new(vec3(R::of(f64::from(c[0][i])), R::of(f64::from(c[1][i])), R::of(f64::from(c[2][i]))))
}

fn scalar<R: Real>(c: &mut Criterion, kind: SurfaceKind, label: &str)
where
    Surface<R>: Bsdf<R>,
{
    let x = Inputs::new(kind);
    let block = black_box(x.block::<R>());
    c.bench_function(&format!("{} f+pdf {label}", kind.name()), |b| {
        b.iter(|| {
            for i in 0..N {
                black_box(kind.bind(black_box(&block)).f_cos_pdf(dir(&x.wo, i), dir(&x.wi, i)));
            }
        });
    });
    c.bench_function(&format!("{} sample {label}", kind.name()), |b| {
        b.iter(|| {
            for i in 0..N {
                let at = |k: usize| R::of(f64::from(x.u[k][i]));
                let u = Uniforms { lobe: at(0), dir: [at(1), at(2)] };
                black_box(kind.bind(black_box(&block)).sample(dir(&x.wo, i), u));
            }
        });
    });
}

fn scalar_fibre(c: &mut Criterion, kind: FibreKind) {
    let x = Inputs::new(kind);
    let block = |i: usize| ParamBlock { h: x.h[i], ..x.block::<f32>() };
    c.bench_function(&format!("{} f+pdf f32", kind.name()), |b| {
        b.iter(|| {
            for i in 0..N {
                let m: Fibre<f32> = kind.bind(black_box(&block(i)));
                black_box(m.f_cos_pdf(dir(&x.wo, i), dir(&x.wi, i)));
            }
        });
    });
    c.bench_function(&format!("{} sample f32", kind.name()), |b| {
        b.iter(|| {
            for i in 0..N {
                let u = Uniforms { lobe: x.u[0][i], dir: [x.u[1][i], x.u[2][i]] };
                let m: Fibre<f32> = kind.bind(black_box(&block(i)));
                black_box(m.sample(dir(&x.wo, i), u));
            }
        });
    });
}

fn lanes(c: &mut Criterion, kind: impl Kind) {
    let x = Inputs::new(kind);
    // Written again and again: fresh memory would cost its first use.
    let mut out = [(); 10].map(|()| vec![0.0f32; N]);
    c.bench_function(&format!("{} f+pdf lanes", kind.name()), |bench| {
        bench.iter(|| {
            let [a, b, c, d, pdf, ..] = &mut out;
            let mut to = EvalColumns { f_cos: [a, b, c, d], pdf };
            batch::f_cos_pdf(kind, &x.columns(), &columns(&x.wo), &columns(&x.wi), &mut to);
            black_box(&mut out);
        });
    });
    c.bench_function(&format!("{} sample lanes", kind.name()), |bench| {
        bench.iter(|| {
            let [wx, wy, wz, a, b, c, d, density, eta, delta] = &mut out;
            let mut to = SampleColumns { wi: [wx, wy, wz], weight: [a, b, c, d], density, eta, delta };
            batch::sample(kind, &x.columns(), &columns(&x.wo), &[&x.u[0], &x.u[1], &x.u[2]], &mut to);
            black_box(&mut out);
        });
    });
}

fn all(c: &mut Criterion) {
    for &kind in SurfaceKind::ALL {
        scalar::<f32>(c, kind, "f32");
        scalar::<f64>(c, kind, "f64");
        lanes(c, kind);
    }
    for &kind in FibreKind::ALL {
        scalar_fibre(c, kind);
        lanes(c, kind);
    }
}

criterion_group!(benches, all);
criterion_main!(benches);

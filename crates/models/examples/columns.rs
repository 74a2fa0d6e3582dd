//! Evaluates one model on columns of numbers from a file: the door through which other programs compare themselves with it.
//!
//! `columns MODEL [NAME=VALUE ...] IN OUT [REPEAT]`; a spectrum takes one value or four with commas, a choice its word.
//! `IN` holds nine columns of little-endian `f32`, one after another: x, y, z of the viewer's direction, x, y, z of the
//! light's, three uniform numbers. `OUT` gets seven: value times cosine and density of the pair; x, y, z, weight and density of
//! a sample. Prints the time of one evaluation in lanes, in nanoseconds, on one thread: the best of `REPEAT` runs.

#![allow(clippy::print_stdout, reason = "a program of the command line")]

use std::error::Error;
use std::time::Instant;

use sparrow_models::batch::{self, DirColumns, EvalColumns, ParamColumns, SampleColumns};
use sparrow_models::{ParamBlock, ParamKind, SurfaceKind};

/// The parameter block of a model with the values of `words`.
fn parameters(kind: SurfaceKind, words: &[String]) -> Result<ParamBlock<f32>, Box<dyn Error>> {
    let table = kind.params();
    let mut block = ParamBlock::<f32>::defaults(table);
    for word in words {
        let (name, value) = word.split_once('=').ok_or_else(|| format!("\"{word}\" is not NAME=VALUE"))?;
        let info = table.iter().find(|p| p.name == name).ok_or_else(|| format!("no parameter \"{name}\""))?;
        let like = |k: &ParamKind| std::mem::discriminant(k) == std::mem::discriminant(&info.kind);
        let spectral = |k: &ParamKind| matches!(k, ParamKind::Albedo | ParamKind::Unbounded);
        let before = table.iter().take_while(|p| p.name != name);
        match info.kind {
            ParamKind::Choice(names) => {
                let at =
                    names.iter().position(|n| *n == value).ok_or_else(|| format!("no choice \"{value}\""))?;
                block.choices[before.filter(|p| like(&p.kind)).count()] = u8::try_from(at)?;
            }
            ParamKind::Real => block.reals[before.filter(|p| like(&p.kind)).count()] = value.parse()?,
            ParamKind::Albedo | ParamKind::Unbounded => {
                let v = value.split(',').map(str::parse).collect::<Result<Vec<f32>, _>>()?;
                let slot = &mut block.spectra[before.filter(|p| spectral(&p.kind)).count()].0;
                for (k, s) in slot.iter_mut().enumerate() {
                    *s = v[k.min(v.len() - 1)];
                }
            }
        }
    }
    Ok(block)
}

/// The shortest of `repeat` runs, in ns for each of `n` points.
fn best(repeat: usize, n: usize, mut run: impl FnMut()) -> f64 {
    let time = |()| {
        let start = Instant::now();
        run();
        start.elapsed().as_secs_f64() * 1e9 / n as f64
    };
    (0..repeat).map(|_| ()).map(time).fold(f64::INFINITY, f64::min)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut args: Vec<String> = std::env::args().skip(1).collect();
    let repeat = args.last().and_then(|a| a.parse().ok());
    args.truncate(args.len() - usize::from(repeat.is_some()));
    let [model, words @ .., input, output] = &args[..] else {
        return Err("usage: columns MODEL [NAME=VALUE ...] IN OUT [REPEAT]".into());
    };
    let kind = SurfaceKind::from_name(model).ok_or_else(|| format!("no model \"{model}\""))?;
    let block = parameters(kind, words)?;
    let mut p = ParamColumns { choices: block.choices, ..ParamColumns::default() };
    for (column, value) in p.reals.iter_mut().zip(block.reals.chunks(1)) {
        *column = value;
    }
    for (columns, value) in p.spectra.iter_mut().zip(&block.spectra) {
        for (column, v) in columns.iter_mut().zip(value.0.chunks(1)) {
            *column = v;
        }
    }

    let numbers: Vec<f32> =
        std::fs::read(input)?.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    let n = numbers.len() / 9;
    let column = |k: usize| &numbers[k * n..(k + 1) * n];
    let wo = DirColumns { x: column(0), y: column(1), z: column(2) };
    let wi = DirColumns { x: column(3), y: column(4), z: column(5) };
    let u = [column(6), column(7), column(8)];
    let mut e = [(); 5].map(|()| vec![0.0; n]);
    let [a, b, c, d, pdf] = &mut e;
    let mut to = EvalColumns { f_cos: [a, b, c, d], pdf };
    let mut t = [(); 10].map(|()| vec![0.0; n]);
    let [x, y, z, a, b, c, d, density, eta, delta] = &mut t;
    let mut drawn = SampleColumns { wi: [x, y, z], weight: [a, b, c, d], density, eta, delta };
    let repeat = repeat.unwrap_or(1);
    let eval = best(repeat, n, || batch::f_cos_pdf(kind, &p, &wo, &wi, &mut to));
    let sample = best(repeat, n, || batch::sample(kind, &p, &wo, &u, &mut drawn));
    let out = [&e[0], &e[4], &t[0], &t[1], &t[2], &t[3], &t[7]];
    let bytes: Vec<u8> = out.iter().flat_map(|c| c.iter()).flat_map(|v| v.to_le_bytes()).collect();
    std::fs::write(output, bytes)?;
    println!("{eval:.3} {sample:.3}");
    Ok(())
}

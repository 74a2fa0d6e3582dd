//! No file, however damaged, makes a reader panic.
#![allow(clippy::unwrap_used, reason = "a test may fail loudly")]

use std::path::Path;

use image::{ExtendedColorType, ImageEncoder};
use proptest::prelude::*;
use sparrow_image::{Image, OutputImage, write_exr};

/// Overwrites, cuts and appends.
fn mutate(mut file: Vec<u8>, edits: &[(usize, u8)], cut: usize, tail: &[u8]) -> Vec<u8> {
    for &(at, value) in edits {
        let n = file.len();
        file[at % n] = value;
    }
    file.truncate(file.len().saturating_sub(cut));
    file.extend(tail);
    file
}

/// One small sound file of each format.
fn seeds() -> Vec<(&'static str, Vec<u8>)> {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("seed.exr");
    let n = 20 * 20;
    let exr = OutputImage::new(20, 20).with_f32("R", vec![0.5; n]).with_f16("Z", &vec![0.1; n]);
    write_exr(&path, &exr).unwrap();
    let codes: Vec<u8> = (0..192u32).map(|i| (i * 7 % 251) as u8).collect();
    let (mut png, mut jpg, mut tga, mut qoi) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let rgb = ExtendedColorType::Rgb8;
    image::codecs::png::PngEncoder::new(&mut png).write_image(&codes, 8, 8, rgb).unwrap();
    image::codecs::jpeg::JpegEncoder::new(&mut jpg).write_image(&codes, 8, 8, rgb).unwrap();
    image::codecs::tga::TgaEncoder::new(&mut tga).write_image(&codes, 8, 8, rgb).unwrap();
    image::codecs::qoi::QoiEncoder::new(&mut qoi).write_image(&codes, 8, 8, rgb).unwrap();
    let hdr =
        b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n\x02\x02\0\x08\x88\x01\x88\x02\x88\x03\x88\x81";
    let pfm = b"PF\n2 1\n-1\nabcdefghijklmnopqrstuvwx";
    vec![
        ("a.exr", std::fs::read(path).unwrap()),
        ("a.png", png),
        ("a.jpg", jpg),
        ("a.tga", tga),
        ("a.qoi", qoi),
        ("a.hdr", hdr.to_vec()),
        ("a.pfm", pfm.to_vec()),
    ]
}

#[test]
fn mutated_files_never_panic() {
    let edit = (any::<usize>(), prop_oneof![any::<u8>(), Just(0), Just(0xff), Just(b'9'), Just(b'-')]);
    let edits = prop::collection::vec(edit, 0..6);
    let tail = prop::collection::vec(any::<u8>(), 0..4);
    for (name, seed) in seeds() {
        // A runner counts its cases over all runs, so each format needs its own.
        let mut runner = proptest::test_runner::TestRunner::new_with_rng(
            ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() },
            proptest::test_runner::TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha),
        );
        let mutations = (edits.clone(), prop_oneof![Just(0usize), 0usize..64], tail.clone());
        runner
            .run(&mutations, |(edits, cut, tail)| {
                let file = mutate(seed.clone(), &edits, cut, &tail);
                if let Ok(image) = Image::decode(&file, Path::new(name), None) {
                    prop_assert_eq!(image.pixels.len(), image.width * image.height * image.n_channels());
                }
                Ok(())
            })
            .unwrap();
    }
}

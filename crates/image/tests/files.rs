//! What is written comes back when read, and damaged files are refused with a reason.
#![allow(
    clippy::float_cmp,
    clippy::unwrap_used,
    reason = "storage must not change a value; a test may fail loudly"
)]

use std::fs;
use std::path::{Path, PathBuf};

use half::f16;
use image::{ExtendedColorType, ImageEncoder};
use sparrow_image::{
    Attribute, Chromaticities, Encoding, Image, ImageError, OutputChannel, OutputImage, Pixels, read_exr,
    write_exr, write_png,
};

/// A path for one test's file; each test uses its own name.
fn temporary(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn decode(bytes: &[u8]) -> Result<Image, ImageError> {
    Image::decode(bytes, Path::new("given"), None)
}

fn refusal(bytes: &[u8]) -> String {
    decode(bytes).err().map(|e| e.to_string()).unwrap_or_default()
}

fn ramp(n: usize, scale: f32) -> Vec<f32> {
    (0..n).map(|i| i as f32 * scale).collect()
}

fn full_exr() -> OutputImage {
    let rgb: Vec<[f32; 3]> = (0..35).map(|i| [i as f32 * 0.1, 1e-3 * i as f32, -1e6 * i as f32]).collect();
    OutputImage {
        chromaticities: Some(Chromaticities::REC_709),
        world_to_camera: Some([[1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, 8.0], [9.0; 4], [0.0, 0.0, 0.0, 1.0]]),
        world_to_ndc: Some([[0.5; 4]; 4]),
        ..OutputImage::new(7, 5)
    }
    .cropped([3, 2], [640, 480])
    .with_rgb("", &rgb)
    .with_f32("variance.R", ramp(35, 0.25))
    .with_f16("depth.Z", &ramp(35, 0.5))
    .with_attribute("software", Attribute::Text("a test".into()))
    .with_attribute("sparrow.seed", Attribute::Int(-7))
    .with_attribute("sparrow.seconds", Attribute::Double(1.0 / 3.0))
    .with_attribute("sparrow.command", Attribute::Text("Zürich → x".into()))
    .with_attribute("sparrow.spp", Attribute::Float(64.0))
    .with_attribute("sparrow.cameraToWorld", Attribute::Matrix([[1.0, 0.0, 0.0, 9.0]; 4]))
}

#[test]
fn exr_comes_back_whole() {
    let path = temporary("whole.exr");
    let out = full_exr();
    write_exr(&path, &out).unwrap();
    let (image, header) = read_exr(&path).unwrap();
    assert_eq!(image.channels, ["R", "G", "B", "depth.Z", "variance.R"]);
    assert_eq!((image.width, image.height, image.chromaticities), (7, 5, Some(Chromaticities::REC_709)));
    for (i, c) in image.channels.iter().enumerate() {
        let given = out.channels.iter().find(|g| g.name == *c).unwrap();
        for p in 0..35 {
            let want = match &given.samples {
                Pixels::F16(v) => v[p].to_f32(),
                Pixels::F32(v) => v[p],
                Pixels::U8(_) => unreachable!("none was given"),
            };
            assert_eq!(image.value(p % 7, p / 7, i), want, "{c} {p}");
        }
    }
    assert_eq!((header.origin, header.display_origin, header.display_size), ([3, 2], [0, 0], [640, 480]));
    assert_eq!((header.world_to_camera, header.world_to_ndc), (out.world_to_camera, out.world_to_ndc));
    for (name, value) in &out.attributes {
        assert_eq!(header.attribute(name), Some(value), "{name}");
    }
    assert!(header.attributes.is_sorted_by(|a, b| a.0 < b.0));
}

#[test]
fn the_same_exr_has_the_same_bytes() {
    let paths = [temporary("same-a.exr"), temporary("same-b.exr")];
    for p in &paths {
        write_exr(p, &full_exr()).unwrap();
    }
    assert!(fs::read(&paths[0]).unwrap() == fs::read(&paths[1]).unwrap());
}

#[test]
fn half_floats_stay_half_and_grey_is_grey() {
    let path = temporary("half.exr");
    write_exr(&path, &OutputImage::new(2, 2).with_f16("Y", &[0.0, 0.5, 70000.0, -0.125])).unwrap();
    let image = Image::read(&path, Some(Encoding::Srgb)).unwrap();
    assert_eq!(image.pixels, Pixels::F16([0.0, 0.5, f32::INFINITY, -0.125].map(f16::from_f32).to_vec()));
    assert_eq!((image.rgb(1, 1), image.has_colour(), image.bytes()), ([-0.125; 3], false, 8));
}

#[test]
fn an_exr_of_many_blocks_comes_back() {
    let (path, n) = (temporary("large.exr"), 1024 * 300);
    write_exr(&path, &OutputImage::new(1024, 300).with_f32("Y", ramp(n, 1.0))).unwrap();
    assert_eq!(Image::read(&path, None).unwrap().pixels, Pixels::F32(ramp(n, 1.0)));
}

#[test]
fn threads_change_no_byte_and_no_fault() {
    let n = 640 * 900;
    let picture = OutputImage::new(640, 900).with_f32("Y", ramp(n, 0.37)).with_f16("Z", &ramp(n, 0.01));
    let path = temporary("threads.exr");
    write_exr(&path, &picture).unwrap();
    let file = fs::read(&path).unwrap();
    // The data of two blocks: both are damaged, in different ways.
    let mut damaged = file.clone();
    let (early, late) = (file.len() / 3, file.len() / 3 * 2);
    damaged[early..early + 40].fill(0xff);
    damaged[late..late + 40].fill(0x55);
    let faults = [damaged.as_slice(), &file[..late]];
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            write_exr(&path, &picture).unwrap();
            (fs::read(&path).unwrap(), decode(&file).unwrap().pixels, faults.map(refusal))
        })
    };
    let (one, three) = (on(1), on(3));
    assert!(one == three && one.0 == file);
    assert!(one.2.iter().all(|f| !f.is_empty()), "{:?}", one.2);
}

#[test]
fn parts_become_layers_where_they_cover_the_same_pixels() {
    use exr::prelude::*;
    let part = |name: &str, size: (usize, usize), channels: &[&str]| {
        let plane = |c: &&str| AnyChannel::new(*c, FlatSamples::F32(vec![c.len() as f32; size.0 * size.1]));
        let list = AnyChannels::sort(channels.iter().map(plane).collect());
        Layer::new(size, LayerAttributes::named(name), exr::image::Encoding::FAST_LOSSLESS, list)
    };
    let parts = vec![
        part("beauty", (70, 66), &["A", "B", "G", "R"]),
        part("normal", (70, 66), &["X", "Y", "normal.Z"]),
        part("small", (3, 2), &["R"]),
    ];
    let path = temporary("parts.exr");
    let file = exr::image::Image::from_layers(ImageAttributes::with_size((70, 66)), parts);
    file.write().to_file(&path).unwrap();
    let image = sparrow_image::Image::read(&path, None).unwrap();
    let want = ["beauty.R", "beauty.G", "beauty.B", "beauty.A", "normal.X", "normal.Y", "normal.Z"];
    assert_eq!(image.channels, want);
    assert_eq!((image.value(69, 65, 5), image.value(69, 65, 6)), (1.0, 8.0), "tiles of 64 are put together");
}

#[test]
fn what_cannot_be_written_is_refused_and_leaves_nothing() {
    let path = temporary("refused.exr");
    let good = || OutputImage::new(2, 2).with_f32("R", vec![0.0; 4]);
    let cases = [
        (OutputImage::new(2, 2), "no channel"),
        (OutputImage::new(0, 2).with_f32("R", vec![]), "window of 0 x 2"),
        (OutputImage::new(2, 2).with_f32("R", vec![0.0; 3]), "has 3 samples"),
        (good().with_f32("R", vec![0.0; 4]), "two channels are called `R`"),
        (good().with_f32("Ω", vec![0.0; 4]), "`Ω` cannot name"),
        (good().with_f32("", vec![0.0; 4]), "`` cannot name"),
        (good().with_attribute("dataWindow", Attribute::Int(1)), "fixed meaning"),
        (
            good().with_attribute("a", Attribute::Int(1)).with_attribute("a", Attribute::Int(2)),
            "two attributes",
        ),
        (
            OutputImage {
                channels: vec![OutputChannel { name: "R".into(), samples: Pixels::U8(vec![0; 4]) }],
                ..good()
            },
            "8-bit",
        ),
    ];
    for (image, want) in cases {
        let e = write_exr(&path, &image).unwrap_err().to_string();
        assert!(e.contains(want) && e.contains("refused.exr"), "{e:?} lacks {want:?}");
    }
    let e = write_exr(&temporary("no/such/folder.exr"), &good()).unwrap_err().to_string();
    assert!(e.contains("cannot be written"), "{e}");
    let left = fs::read_dir(env!("CARGO_TARGET_TMPDIR")).unwrap();
    assert_eq!(
        left.filter(|f| f.as_ref().unwrap().file_name().to_string_lossy().contains("refused")).count(),
        0
    );
}

#[test]
fn png_comes_back_within_half_a_code() {
    let path = temporary("view.png");
    let rgb: Vec<[f32; 3]> = (0..100).map(|i| [i as f32 / 99.0, -1.0, 9.0]).collect();
    write_png(&path, 20, 5, &rgb).unwrap();
    let image = Image::read(&path, None).unwrap();
    assert_eq!((image.width, image.height, image.n_channels()), (20, 5, 3));
    assert!(matches!(&image.pixels, Pixels::U8(v) if v.len() == 300));
    for (i, want) in rgb.iter().enumerate() {
        let got = image.rgb(i % 20, i / 20);
        // The curve's largest slope is 2.4/1.055 at white: half a code is 0.0045.
        assert!((got[0] - want[0]).abs() < 0.0045 && got[1..] == [0.0, 1.0], "{i}: {got:?} {want:?}");
    }
    assert!(write_png(&path, 20, 6, &rgb).is_err());
}

/// A file of the `image` crate's encoders.
fn coded(kind: ExtendedColorType, codes: &[u8], w: u32, h: u32, format: &str) -> Vec<u8> {
    let mut b = Vec::new();
    match format {
        "png" => image::codecs::png::PngEncoder::new(&mut b).write_image(codes, w, h, kind).unwrap(),
        "tga" => image::codecs::tga::TgaEncoder::new(&mut b).write_image(codes, w, h, kind).unwrap(),
        "qoi" => image::codecs::qoi::QoiEncoder::new(&mut b).write_image(codes, w, h, kind).unwrap(),
        _ => {
            image::codecs::jpeg::JpegEncoder::new_with_quality(&mut b, 100)
                .write_image(codes, w, h, kind)
                .unwrap();
        }
    }
    b
}

#[test]
fn integer_formats_keep_their_channels_and_codes() {
    use ExtendedColorType::{L8, L16, La8, Rgb8, Rgb16, Rgba8};
    let codes: Vec<u8> = (0..48).map(|i| i * 5).collect();
    let cases = [
        (L8, "png", "Y"),
        (La8, "png", "YA"),
        (Rgb8, "png", "RGB"),
        (Rgba8, "png", "RGBA"),
        (Rgb8, "tga", "RGB"),
        (Rgba8, "tga", "RGBA"),
        (Rgb8, "qoi", "RGB"),
        (Rgba8, "qoi", "RGBA"),
    ];
    for (kind, format, channels) in cases {
        let n = channels.len();
        let file = coded(kind, &codes[..6 * n], 3, 2, format);
        let path = PathBuf::from(format!("a.{format}"));
        let image = Image::decode(&file, &path, None).unwrap();
        assert_eq!(image.channels.concat(), channels, "{format}");
        assert_eq!(image.pixels, Pixels::U8(codes[..6 * n].to_vec()), "{format} {channels}");
        let linear = Image::decode(&file, &path, Some(Encoding::Linear)).unwrap();
        assert_eq!(linear.value(1, 1, 0), f32::from(codes[4 * n]) / 255.0);
        assert!(image.value(1, 1, 0) < linear.value(1, 1, 0));
    }
    for (kind, n) in [(L16, 1), (Rgb16, 3)] {
        let image = Image::decode(
            &coded(kind, &codes[..12 * n], 3, 2, "png"),
            Path::new("x"),
            Some(Encoding::Linear),
        );
        let first = f32::from(u16::from_ne_bytes([codes[0], codes[1]])) / 65535.0;
        let image = image.unwrap();
        assert!(matches!(&image.pixels, Pixels::F32(v) if v.len() == 6 * n && (v[0] - first).abs() < 1e-7));
    }
    let grey = decode(&coded(Rgb8, &[188; 3 * 64], 8, 8, "jpg")).unwrap();
    assert!(grey.rgb(3, 3).iter().all(|v| (v - 0.503).abs() < 0.01), "{:?}", grey.rgb(3, 3));
}

#[test]
fn palettes_are_looked_up() {
    // 2 x 1 pixels of one bit: code 1, then code 0; palette: red, blue.
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    let chunks: [(&[u8], &[u8]); 4] = [
        (b"IHDR", &[0, 0, 0, 2, 0, 0, 0, 1, 1, 3, 0, 0, 0]),
        (b"PLTE", &[255, 0, 0, 0, 0, 255]),
        // zlib, one stored block of two bytes: filter 0, bits 10.
        (b"IDAT", &[0x78, 0x01, 1, 2, 0, 0xfd, 0xff, 0, 0x80, 0, 0x82, 0, 0x81]),
        (b"IEND", &[]),
    ];
    for (name, data) in chunks {
        file.extend((data.len() as u32).to_be_bytes());
        let body = [name, data].concat();
        file.extend(&body);
        file.extend(crc32(&body).to_be_bytes());
    }
    let image = decode(&file).unwrap();
    assert_eq!(image.pixels, Pixels::U8(vec![0, 0, 255, 255, 0, 0]));
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, b| {
        (0..8).fold(crc ^ u32::from(*b), |c, _| if c & 1 == 1 { c >> 1 ^ 0xedb8_8320 } else { c >> 1 })
    })
}

fn hdr(size: &str, data: &[u8]) -> Vec<u8> {
    [b"#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_rgbe\n\n", size.as_bytes(), b"\n", data].concat()
}

#[test]
fn radiance_pixels_flat_and_run_length_coded() {
    // Mantissa m and exponent e stand for m * 2^(e - 136).
    let flat = decode(&hdr("-Y 1 +X 2", &[128, 64, 32, 129, 1, 0, 0, 136])).unwrap();
    assert_eq!(flat.pixels, Pixels::F32(vec![1.0, 0.5, 0.25, 1.0, 0.0, 0.0]));
    let runs = [2, 2, 0, 8, 0x88, 128, 0x88, 64, 0x88, 32, 0x88, 129];
    let image = decode(&hdr("-Y 1 +X 8", &runs)).unwrap();
    assert!((0..8).all(|x| image.rgb(x, 0) == [1.0, 0.5, 0.25]));
    let xyze = b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n\0\0\0\0";
    assert!(refusal(xyze).contains("XYZ"), "{}", refusal(xyze));
}

#[test]
fn files_cut_short_are_refused_everywhere() {
    let codes: Vec<u8> = (0..192u32).map(|i| (i * 7 % 251) as u8).collect();
    write_exr(&temporary("cut.exr"), &full_exr()).unwrap();
    let files = [
        ("cut.exr", fs::read(temporary("cut.exr")).unwrap()),
        ("cut.png", coded(ExtendedColorType::Rgb8, &codes, 8, 8, "png")),
        ("cut.tga", coded(ExtendedColorType::Rgb8, &codes, 8, 8, "tga")),
        ("cut.hdr", hdr("-Y 1 +X 8", &[2, 2, 0, 8, 0x88, 128, 0x88, 64, 0x88, 32, 0x88, 129])),
        ("cut.pfm", b"Pf\n1 1\n-1\n\0\0\0\0".to_vec()),
    ];
    for (name, whole) in files {
        assert!(Image::decode(&whole, Path::new(name), None).is_ok(), "{name}");
        // The last chunk of a PNG holds no pixels; everything else matters to the last byte.
        let spared = if name.ends_with("png") { 16 } else { 0 };
        for len in 0..whole.len() - spared {
            let e = Image::decode(&whole[..len], Path::new(name), None);
            let e = e.err().map(|e| e.to_string()).unwrap_or_default();
            assert!(e.starts_with(name) && e.contains("; "), "{name} cut to {len} bytes: {e:?}");
        }
    }
}

#[test]
fn headers_that_claim_too_much_are_refused_before_memory_is_taken() {
    let mut png = coded(ExtendedColorType::L8, &[0], 1, 1, "png");
    png[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
    let ihdr = crc32(&png[12..29]).to_be_bytes();
    png[29..33].copy_from_slice(&ihdr);
    write_exr(&temporary("huge.exr"), &OutputImage::new(1, 1).with_f32("R", vec![0.0])).unwrap();
    let mut exr = fs::read(temporary("huge.exr")).unwrap();
    let name = b"dataWindow\0box2i\0";
    let at = exr.windows(name.len()).position(|w| w == name).unwrap() + name.len() + 4 + 8;
    exr[at..at + 4].copy_from_slice(&0x3fff_0000i32.to_le_bytes());
    let qoi = [b"qoif".as_slice(), &[0x7f, 0, 0, 0, 0x7f, 0, 0, 0, 3, 0], &[0; 16]].concat();
    let hdr = hdr("-Y 2000000000 +X 2000000000", &[0; 64]);
    for (name, bytes) in [("png", png), ("exr", exr), ("qoi", qoi), ("hdr", hdr)] {
        let e = refusal(&bytes);
        assert!(e.contains("given: "), "{name}: {e:?}");
    }
}

#[test]
fn what_is_no_image_is_refused_by_name() {
    assert!(refusal(b"").contains("the file is empty"));
    assert!(refusal(b"Film \"rgb\"").contains("give a PNG"));
    let e = Image::read(&temporary("not-there.png"), None).unwrap_err().to_string();
    assert!(e.contains("not-there.png: cannot be read"), "{e}");
}

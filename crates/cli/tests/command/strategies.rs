//! `render --strategies`: what each sampling technique finds, in a folder.

use sparrow_image::Image;

use crate::scratch::Scratch;

#[test]
fn the_folder_holds_layers_pictures_and_a_sheet_and_the_picture_stays() {
    let s = Scratch::new();
    s.run("render room.pbrt -o plain.exr --quiet").ok();
    let ran = s.run("render room.pbrt -o room.exr --strategies parts --json").ok();
    let outputs = ran.json()["outputs"].as_array().unwrap().len();
    assert_eq!(outputs, 2 + 3 + 2 * 4, "{ran:?}");
    let rgb = |name: &str| Image::read(&s.path(name), None).unwrap().to_rgb();
    assert!(rgb("plain.exr") == rgb("room.exr"), "looking on changed the picture");

    let layers = Image::read(&s.path("parts/strategies.exr"), None).unwrap();
    let channel = |name: &str| {
        let c = layers.channel_index(name).unwrap_or_else(|| panic!("no {name} in {:?}", layers.channels));
        (0..48 * 64).map(|i| layers.value(i % 64, i / 64, c)).collect::<Vec<f32>>()
    };
    let [picture, seen, light, bsdf] = ["G", "seen.G", "light.weighted.G", "bsdf.weighted.G"].map(channel);
    for i in 0..picture.len() {
        let sum = seen[i] + light[i] + bsdf[i];
        assert!((picture[i] - sum).abs() < 1e-5 * (0.1 + sum), "pixel {i}: {} and {sum}", picture[i]);
    }
    for technique in ["light", "bsdf"] {
        let weight = channel(&format!("{technique}.weight.Y"));
        assert!(weight.iter().all(|w| (0.0..=1.000_01).contains(w)) && weight.iter().any(|w| *w > 0.1));
        for layer in ["unweighted.variance.B", "weighted.variance.R"] {
            let variance = channel(&format!("{technique}.{layer}"));
            assert!(variance.iter().all(|v| *v >= 0.0 && v.is_finite()));
            assert!(variance.iter().any(|v| *v > 0.0), "{technique}.{layer}");
        }
        for picture in ["unweighted", "weight", "weighted", "deviation"] {
            let png = Image::read(&s.path(&format!("parts/{technique}-{picture}.png")), None).unwrap();
            assert_eq!((png.width, png.height), (64, 48));
        }
    }
    let sheet = Image::read(&s.path("parts/sheet.png"), None).unwrap();
    assert!(sheet.width > 4 * 64 && sheet.height > 3 * 48, "{} x {}", sheet.width, sheet.height);
}

#[test]
fn what_cannot_be_shown_or_written_is_told_before_any_time_is_spent() {
    let s = Scratch::new();
    s.put("parts", "a file");
    for (words, code, told) in [
        ("--strategies missing/parts", 1, "there is no folder `missing`; create it first"),
        ("--strategies parts --mis optimal", 2, "use --mis balance"),
    ] {
        let ran = s.run(&format!("render room.pbrt {words}"));
        assert_eq!(ran.code, Some(code), "{ran:?}");
        assert!(ran.err.contains(told) && !ran.err.contains("rendering"), "{ran:?}");
    }
    let ran = s.run("render room.pbrt --strategies parts");
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(ran.err.contains("this is a file") && !ran.err.contains("rendering"), "{ran:?}");
}

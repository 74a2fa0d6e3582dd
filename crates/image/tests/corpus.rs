//! Reads pictures made by other programs: environment maps, textures, reference renders.

use std::env;
use std::path::{Path, PathBuf};

use sparrow_image::Image;

/// Where the data lie: `$SPARROW_DATA`, or beside the workspace; `None` where they do not.
fn data() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let root = env::var_os("SPARROW_DATA").map_or(beside, PathBuf::from);
    root.is_dir().then_some(root)
}

/// File, width, height, number of channels.
const PICTURES: [(&str, usize, usize, usize); 17] = [
    ("envmaps/city.hdr", 1024, 512, 3),
    ("envmaps/studio.hdr", 1024, 512, 3),
    ("envmaps/venice.hdr", 1024, 512, 3),
    ("envmaps/blender-courtyard.exr", 1024, 512, 3),
    ("envmaps/blender-studio.exr", 1024, 512, 3),
    ("envmaps/blender-sunset.exr", 1024, 512, 3),
    ("pbrt4-bitterli/classroom/reference.exr", 1280, 720, 3),
    ("pbrt4-bitterli/classroom/textures/Skydome.pfm", 512, 512, 3),
    ("pbrt4-bitterli/classroom/textures/blackboard.tga", 1600, 1600, 3),
    ("pbrt4-bitterli/classroom/textures/wood1.tga", 259, 194, 3),
    ("pbrt4-bitterli/classroom/textures/wood2.tga", 1265, 627, 3),
    ("pbrt4-bitterli/coffee/reference.exr", 800, 1000, 3),
    ("pbrt4-bitterli/cornell-box/reference.exr", 1024, 1024, 3),
    ("pbrt4-bitterli/material-testball/textures/envmap.exr", 512, 512, 3),
    ("pbrt4-bitterli/veach-bidir/reference.exr", 1024, 1024, 3),
    ("pbrt4-bitterli/veach-mis/reference.exr", 1280, 720, 3),
    ("gltf/sheen-chair/SheenChairLabelBaseColor.jpg", 1024, 512, 3),
];

/// Means of the green channel, by the OpenEXR library: PIZ and DWAB compression, half and float.
const MEANS: [(&str, f64); 4] = [
    ("envmaps/blender-sunset.exr", 0.4130071729817928),
    ("envmaps/blender-studio.exr", 0.5542952427366572),
    ("pbrt4-bitterli/veach-mis/reference.exr", 0.6107188672010347),
    ("pbrt4-bitterli/cornell-box/reference.exr", 0.1275314458675325),
];

#[test]
fn pictures_of_other_programs_are_read() {
    let Some(root) = data() else {
        println!("skipped: no data");
        return;
    };
    for (name, width, height, n) in PICTURES {
        let path = root.join(name);
        if !path.exists() {
            println!("skipped: {name}");
            continue;
        }
        let image = Image::read(&path, None).unwrap();
        assert_eq!((image.width, image.height, image.n_channels()), (width, height, n), "{name}");
        let rgb = image.to_rgb();
        // The coding of the environment maps leaves a little below zero in the dark.
        assert!(rgb.iter().flatten().all(|v| v.is_finite() && *v > -1e-3), "{name}");
        let green = rgb.iter().map(|v| f64::from(v[1])).sum::<f64>() / rgb.len() as f64;
        assert!(green > 0.0, "{name} is black");
        if let Some((_, want)) = MEANS.iter().find(|(n, _)| *n == name) {
            assert!((green / want - 1.0).abs() < 1e-9, "{name}: mean {green}, want {want}");
        }
    }
}

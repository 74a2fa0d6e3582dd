//! `sparrow groom`: files, their sameness, refusals.

use std::fs;
use std::path::Path;

use crate::scratch::Scratch;

/// A unit square of one quad in the plane y = 0, its normal up.
const SQUARE: &str = "\
ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
0 0 1
1 0 1
1 0 0
4 0 1 2 3
";
const NO_FACES: &str = "\
ply
format ascii 1.0
element vertex 1
property float x
property float y
property float z
end_header
0 0 0
";

fn scratch() -> Scratch {
    let s = Scratch::new();
    s.put("square.ply", SQUARE);
    s
}

#[test]
fn what_grows_is_rendered() {
    let s = scratch();
    let words = "groom square.ply --density 300 --length 0.3 --lean 40 --flow 1,0,0 --gravity 0,-0.5,0 --noise 0.3 \
                 --curl 0.01 --clump 0.4 --clump-size 10 --width-root 0.01 --width-tip 0.002 --json";
    let json = s.run(words).ok().json();
    assert_eq!((&json["strands"], &json["points"]), (&300.into(), &2700.into()));
    let size = fs::metadata(s.path("square.hair")).unwrap().len();
    assert_eq!((size, &json["bytes"]), (128 + 16 * 2700, &size.into()));
    s.put(
        "fur.pbrt",
        "LookAt 0.5 1 -2 0.5 0.1 0.5 0 1 0 Camera \"perspective\"\nWorldBegin LightSource \"infinite\"\n\
         Material \"hair\" Shape \"hair\" \"string filename\" \"square.hair\"\n",
    );
    let info = s.run("info fur.pbrt").ok();
    assert!(info.out.contains("300") && info.err.is_empty(), "{info:?}");
    s.run("render fur.pbrt --resolution 16x12 --spp 1 --quiet").ok();
    assert!(s.path("fur.exr").exists());
}

#[test]
fn strands_stay_outside_of_the_body() {
    let s = scratch();
    let lowest = |words: &str| {
        s.run(&format!("groom square.ply -o a.hair --count 50 --length 2 --gravity 0,-30,0 --quiet {words}"))
            .ok();
        // Nothing but points follows the header of 128 bytes: x y z each.
        let bytes = fs::read(s.path("a.hair")).unwrap();
        let numbers = bytes[128..].chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap()));
        numbers.skip(1).step_by(3).fold(f32::INFINITY, f32::min)
    };
    assert!(lowest("") < -1.0, "without a body strands fall through");
    assert!(lowest("--body square.ply --clearance 0.05") >= 0.0);
}

#[test]
fn the_same_words_give_the_same_bytes() {
    let s = scratch();
    let grown = |out: &str, seed: u32| {
        s.run(&format!("groom square.ply -o {out} --count 50 --noise 1 --seed {seed} --quiet")).ok();
        fs::read(s.path(out)).unwrap()
    };
    assert_eq!(grown("a.hair", 1), grown("b.hair", 1));
    assert_ne!(grown("a.hair", 1), grown("b.hair", 2));
    assert_eq!(s.files(), ["a.hair", "b.hair", "room.pbrt", "square.ply"]);
}

#[test]
fn what_cannot_be_grown_is_told() {
    let s = scratch();
    s.put("bare.ply", NO_FACES);
    s.put("line.ply", &SQUARE.replace("4 0 1 2 3", "3 0 1 1"));
    s.put("broken.ply", &SQUARE.replace("1 0 1\n", "1 nan 1\n"));
    let refused = [
        ("missing.ply", "missing.ply: cannot be read"),
        ("bare.ply", "bare.ply"),
        ("line.ply", "line.ply: the faces have no area"),
        ("broken.ply", "broken.ply"),
        ("square.ply --body missing.ply", "missing.ply: cannot be read"),
        ("square.ply --body line.ply --body broken.ply", "broken.ply"),
        ("square.ply --clearance -1", "the clearance is -1; give a number not below 0"),
        ("square.ply --length 0", "the length is 0; give a number above 0"),
        ("square.ply --clump 2", "the clump is 2; give a number from 0 to 1"),
        ("square.ply --density 0.1", "raise the density"),
        ("square.ply --flow u", "has none; give a direction instead"),
        ("square.ply -o missing/a.hair", "there is no folder `missing`"),
    ];
    for (words, told) in refused {
        let ran = s.run(&format!("groom {words}"));
        assert_eq!(ran.code, Some(1), "{words}: {ran:?}");
        assert!(ran.err.contains(told), "{words}: {}", ran.err);
    }
    let wrong = ["", "square.ply -o a.exr", "square.ply --flow w", "square.ply --count 5 --density 5"];
    for words in wrong {
        assert_eq!(s.run(&format!("groom {words}")).code, Some(2), "{words}");
    }
    assert_eq!(s.files(), ["bare.ply", "broken.ply", "line.ply", "room.pbrt", "square.ply"]);
}

/// The words of a groom's command, which end the first comment of a scene.
fn command_of(scene: &str) -> Option<String> {
    let comment = scene.lines().map_while(|l| l.strip_prefix('#')).collect::<Vec<_>>().join(" ");
    comment.split_once("sparrow groom ").map(|(_, words)| words.to_owned())
}

/// The strands beside our scenes are those that the scenes' own words grow.
#[test]
fn strands_of_our_scenes_are_current() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let s = Scratch::new();
    let mut grown = Vec::new();
    let folders = ["fibres", "lecture"].map(|f| fs::read_dir(scenes.join(f)).unwrap());
    for scene in folders.into_iter().flatten().map(|f| f.unwrap().path()) {
        let folder = scene.parent().unwrap();
        let Some(words) = fs::read_to_string(&scene).ok().as_deref().and_then(command_of) else { continue };
        let (before, rest) = words.split_once("-o ").unwrap();
        let (name, options) = rest.split_once(' ').unwrap();
        let fresh = s.path(name);
        let words = format!("groom {before} -o {} {options} --quiet", fresh.display());
        let ran = s.command(&words).current_dir(folder).output().unwrap();
        assert!(ran.status.success(), "{words}: {ran:?}");
        let [new, old] = [&fresh, &folder.join(name)].map(|p| fs::read(p).unwrap());
        assert!(new == old, "{name} is not what {} says", scene.display());
        assert!(new.len() < 1_000_000, "{name} has {} bytes", new.len());
        grown.push(name.to_owned());
    }
    grown.sort();
    assert_eq!(grown, ["bundle.hair", "head.hair", "herbert.hair", "horse.hair", "tress.hair"]);
}

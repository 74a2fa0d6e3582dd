//! What happens when something is wrong: exit codes, places, and nothing left behind.

use crate::scratch::Scratch;

const FAULTY: &str = "\
Camera \"perspective\" \"float fuv\" 45
WorldBegin
Material \"diffus\"
Shape \"sphere\" \"float radus\" 1
";

#[test]
fn a_wrong_command_line_ends_with_2() {
    let s = Scratch::new();
    let wrong = [
        "",
        "rendre room.pbrt",
        "render",
        "render room.pbrt --no-such-flag",
        "render room.pbrt --spp 0",
        "render room.pbrt --spp many",
        "render room.pbrt --threads 0",
        "render room.pbrt --mis blance",
        "render room.pbrt --integrator bdpt",
        "render room.pbrt --crop 0,1,0",
        "render room.pbrt --resolution 64",
        "render room.pbrt --time -1",
        "render room.pbrt --noise 0",
        "render room.pbrt --noise=-0.1",
        "render room.pbrt --noise nan",
        "render room.pbrt --noise 0.1 --spp 7",
        "render room.pbrt -o picture.jpg",
        "render room.pbrt --mis optimal --strategies parts",
        "render room.pbrt --mis optimal --noise 0.1",
        "render room.pbrt --strategies parts --noise 0.1",
        "render room.pbrt -o a.exr --stats a.png",
        "info",
    ];
    for words in wrong {
        let ran = s.run(words);
        assert_eq!(ran.code, Some(2), "`{words}`: {ran:?}");
        assert!(!(ran.err.is_empty() && ran.out.is_empty()), "`{words}` says nothing");
    }
    assert_eq!(s.files(), ["room.pbrt"]);
    let ran = s.run("render room.pbrt --mis blance --json");
    assert_eq!((ran.code, &ran.json()["status"]), (Some(2), &"error".into()));
}

#[test]
fn help_and_version_are_no_errors() {
    let s = Scratch::new();
    assert!(s.run("--version").ok().out.starts_with("sparrow "));
    let help = s.run("render --help").ok().out;
    let options = help.lines().filter(|l| l.trim_start().starts_with("--") || l.contains("-o, --"));
    assert_eq!(options.count(), 22, "{help}");
    // Help, version and the scene have no default.
    assert_eq!(help.matches("[default:").count(), 22, "every option says its default: {help}");
    assert!(s.run("").out.contains("Usage: sparrow"));
}

#[test]
fn all_faults_of_a_scene_are_told_with_their_places() {
    let s = Scratch::new();
    s.put("faulty.pbrt", FAULTY);
    for verb in ["render", "info"] {
        let ran = s.run(&format!("{verb} faulty.pbrt --json"));
        assert_eq!(ran.code, Some(1), "{ran:?}");
        for place in ["faulty.pbrt:1:", "faulty.pbrt:3:10: ", "faulty.pbrt:4:16: "] {
            assert!(ran.err.lines().any(|l| l.starts_with(place)), "{place} is not in {}", ran.err);
        }
        let json = ran.json();
        assert_eq!((&json["status"], &json["exit_code"]), (&"error".into(), &1.into()));
        let errors = json["errors"].as_array().unwrap();
        assert_eq!(errors.len(), 3, "{json}");
        assert_eq!((&errors[1]["line"], &errors[1]["column"]), (&3.into(), &10.into()));
        assert_eq!(errors[1]["file"], "faulty.pbrt");
    }
    assert_eq!(s.files(), ["faulty.pbrt", "room.pbrt"], "nothing is written");
}

#[test]
fn what_cannot_be_read_or_written_ends_with_1() {
    let s = Scratch::new();
    let ran = s.run("render nothing.pbrt");
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(ran.err.contains("nothing.pbrt: ") && ran.err.contains("; "), "{ran:?}");
    for words in ["-o missing/a.exr", "-o a.exr --stats missing/s.json"] {
        let ran = s.run(&format!("render room.pbrt {words}"));
        assert_eq!(ran.code, Some(1), "{ran:?}");
        assert!(ran.err.contains("there is no folder `missing`; create it first"), "{ran:?}");
        assert!(!ran.err.contains("rendering"), "checked before any time is spent: {ran:?}");
    }
    std::fs::create_dir(s.path("taken.exr")).unwrap();
    assert_eq!(s.run("render room.pbrt -o taken.exr").code, Some(1));
    let ran = s.run("render room.pbrt --resolution 65535x65535");
    assert!(ran.code != Some(1) || ran.err.contains("needs"), "{ran:?}");
    assert_eq!(s.files(), ["room.pbrt", "taken.exr"]);
}

#[test]
fn a_broken_image_is_told_where_it_is_used() {
    let s = Scratch::new();
    s.put("broken.png", "no picture");
    let texture = "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"broken.png\"\n";
    let material = "Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n";
    s.put("image.pbrt", &format!("WorldBegin\n{texture}{material}{material}"));
    let ran = s.run("render image.pbrt --json");
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let told: Vec<&str> = ran.err.lines().filter(|l| l.contains("broken.png: ")).collect();
    assert_eq!(told.len(), 1, "{ran:?}");
    assert!(told[0].starts_with("image.pbrt:2:"), "{ran:?}");
    assert_eq!(ran.json()["errors"][0]["line"], 2);
    assert_eq!(s.files(), ["broken.png", "image.pbrt", "room.pbrt"]);
}

#[test]
fn no_input_is_overwritten() {
    let s = Scratch::new();
    let ran = s.run("render room.pbrt --stats room.pbrt");
    assert_eq!(ran.code, Some(1), "{ran:?}");
    s.run("render room.pbrt -o sky.exr --resolution 8x8 --quiet").ok();
    let before = std::fs::read(s.path("sky.exr")).unwrap();
    let sky = "WorldBegin\nLightSource \"infinite\" \"string filename\" \"sky.exr\"\n";
    s.put("sky.pbrt", sky);
    let ran = s.run("render sky.pbrt -o sky.exr --resolution 8x8");
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(ran.err.contains("the scene itself reads this file"), "{ran:?}");
    assert_eq!(std::fs::read(s.path("sky.exr")).unwrap(), before);
}

#[test]
fn nobody_listening_is_no_fault() {
    let s = Scratch::new();
    let mut child = s.command("info room.pbrt").spawn().unwrap();
    drop(child.stdout.take());
    let ran = crate::scratch::Ran::from(child.wait_with_output().unwrap());
    assert_eq!(ran.code, Some(0), "{ran:?}");
}

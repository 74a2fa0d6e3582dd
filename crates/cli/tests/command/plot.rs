//! `sparrow plot`: files, faults, and what is said.

use crate::scratch::Scratch;

#[test]
fn a_picture_and_its_numbers_are_written() {
    let s = Scratch::new();
    let ran = s.run("plot conductor alpha=0.1,0.3 wo=30 -o lobes.svg").ok();
    assert!(ran.out.is_empty() && ran.err.contains("wrote lobes.svg and lobes.csv"), "{ran:?}");
    assert_eq!(s.files(), ["lobes.csv", "lobes.svg", "room.pbrt"]);
    let csv = std::fs::read_to_string(s.path("lobes.csv")).unwrap();
    let head = "theta_i_deg,conductor alpha=0.1: f [1/sr],conductor alpha=0.3: f [1/sr]";
    assert_eq!(csv.lines().next(), Some(head));
    assert!(std::fs::read_to_string(s.path("lobes.svg")).unwrap().starts_with("<svg xmlns="));
    let json = s.run("plot phong + lambert --kind cartesian --csv --json").ok().json();
    assert_eq!((&json["csv"], &json["svg"]), (&"phong-lambert-cartesian.csv".into(), &().into()));
    assert_eq!(json["series"], serde_json::json!(["phong", "lambert"]));
    assert_eq!(s.files(), ["lobes.csv", "lobes.svg", "phong-lambert-cartesian.csv", "room.pbrt"]);
}

#[test]
fn all_faults_of_the_words_are_told_and_nothing_is_written() {
    let s = Scratch::new();
    let ran = s.run("plot conductor alpah=0.1 k=-2 + lambret wo=95x --json");
    assert_eq!(ran.code, Some(2), "{ran:?}");
    let json = ran.json();
    let told: Vec<&str> =
        json["errors"].as_array().unwrap().iter().filter_map(|e| e["text"].as_str()).collect();
    assert_eq!(told.len(), 4, "{told:?}");
    assert!(
        told[0].starts_with("word 2, `alpah=0.1`: ") && told[0].ends_with("did you mean \"alpha\"?"),
        "{told:?}"
    );
    for words in [
        "plot",
        "plot lambert --kind pie",
        "plot lambert --quantity g",
        "plot lambert -o lobes.png",
        "plot lambert -o folder/",
        "plot lambert --width 10",
        "plot lambert --kind albedo-map",
        "plot lambert + ",
    ] {
        let ran = s.run(words);
        assert_eq!(ran.code, Some(2), "`{words}`: {ran:?}");
        assert!(!ran.err.is_empty(), "`{words}` says nothing");
    }
    assert_eq!(s.run("plot lambert -o missing/a.svg").code, Some(1));
    assert_eq!(s.files(), ["room.pbrt"]);
}

#[test]
fn help_names_every_kind() {
    let help = Scratch::new().run("plot --help").ok().out;
    let surfaces = ["polar", "cartesian", "lobe3d", "half-difference", "samples", "albedo", "albedo-map"];
    for kind in surfaces.into_iter().chain(["azimuthal", "longitudinal", "caustic", "fibre-map"]) {
        assert!(help.contains(kind), "{kind} is not in {help}");
    }
    let options = help.lines().filter(|l| l.trim_start().starts_with("--") || l.contains("-o, --"));
    // Every option but help and version; and the views of surfaces and of fibres have one too.
    assert_eq!(
        help.matches("[default:").count(),
        options.count() + 2,
        "every option says its default: {help}"
    );
}

#[test]
fn fibres_have_kinds_of_their_own() {
    let s = Scratch::new();
    s.run("plot hair h=0.2 -o hair.svg").ok();
    s.run("plot lambert_fibre --kind longitudinal -o matt").ok();
    let csv = std::fs::read_to_string(s.path("hair.csv")).unwrap();
    assert!(csv.starts_with("phi_deg,R,TT,TRT,more,all\n"));
    for (words, part) in [
        ("plot hair --kind polar", "for fibres there are azimuthal"),
        ("plot lambert --kind caustic", "for surfaces there are polar"),
        ("plot hair + lambert", "plot them apart"),
        ("plot lambert --reference", "none is named"),
        ("plot hair --kind fibre-map --reference", "leave it out"),
        ("plot kajiya_kay --reference", "no fibre that could be traced"),
    ] {
        let ran = s.run(words);
        assert!(ran.code == Some(2) && ran.err.contains(part), "`{words}`: {ran:?}");
    }
}

//! `sparrow models` and `sparrow verify`: what a script sees of them.

use crate::scratch::Scratch;

#[test]
fn every_model_is_listed_with_its_table() {
    let s = Scratch::new();
    let text = s.run("models").ok().out;
    let all = s.run("models --json").ok().json();
    for m in all.as_array().unwrap() {
        let name = m["name"].as_str().unwrap();
        assert!(text.lines().any(|l| l.starts_with(&format!("{name} "))), "{name} is not in {text}");
    }
    let glass = s.run("models dielectric --json").ok().json();
    assert_eq!((&glass["transmissive"], &glass["reciprocal"]), (&true.into(), &true.into()));
    assert_eq!(glass["parameters"][0]["name"], "eta");
    assert_eq!(glass["parameters"][0]["range"], serde_json::json!([0.1, 10.0]));
    // What has no end is null.
    let metal = s.run("models conductor --json").ok().json();
    let eta = metal["parameters"].as_array().unwrap().iter().find(|p| p["name"] == "eta").unwrap();
    assert_eq!(eta["range"], serde_json::json!([0.0, null]));
    assert!(s.run("models conductor").ok().out.contains("Walter2007"));
}

#[test]
fn a_model_that_holds_ends_with_0() {
    let s = Scratch::new();
    let words = "verify lambert reflectance=0.5 wo=60,10 --samples 5000";
    let text = s.run(words).ok().out;
    for part in ["reciprocity", "chi2", "sparrow verify lambert reflectance=0.5 wo=60,10", "0 fail"] {
        assert!(text.contains(part), "`{part}` is not in {text}");
    }
    let one = s.run(&format!("{words} --threads 1 --json")).ok().json();
    let two = s.run(&format!("{words} --threads 2 --json")).ok().json();
    assert_eq!(one["status"], "holds");
    assert_eq!(one["models"][0]["rows"], two["models"][0]["rows"]);
    let rows = one["models"][0]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 27);
    assert!(rows.iter().all(|r| r["verdict"] == "pass"), "{rows:?}");
}

#[test]
fn light_from_nothing_ends_with_1() {
    // A sheet that reflects and transmits nine tenths each makes light, as it was told to.
    let s = Scratch::new();
    let words = "verify diffuse_transmission reflectance=0.9 transmittance=0.9 wo=30,0 --samples 5000";
    let run = s.run(&format!("{words} --json"));
    assert_eq!(run.code, Some(1));
    let json = run.json();
    let rows = json["models"][0]["rows"].as_array().unwrap();
    let wrong: Vec<_> = rows.iter().filter(|r| r["verdict"] == "fail").map(|r| &r["question"]).collect();
    assert_eq!(wrong, ["furnace"; 3]);
}

#[test]
fn what_cannot_be_asked_is_told() {
    let s = Scratch::new();
    for (words, told) in [
        ("verify", "name one model, or give --all"),
        ("verify chrome", "there is no model `chrome`"),
        ("verify lambert shine=1", "no parameter `shine`; there are reflectance, wo"),
        ("verify lambert reflectance=2", "give a number from 0 to 1"),
        ("models chrome", "`sparrow models` lists them"),
    ] {
        let run = s.run(words);
        assert_eq!(run.code, Some(2), "{words}");
        assert!(run.err.contains(told), "`{told}` is not in {}", run.err);
    }
}

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
    // Double precision has nobody to agree with.
    let asked: Vec<_> = rows.iter().filter(|r| r["verdict"] != "not_asked").collect();
    assert_eq!(asked.len(), 26);
    assert!(asked.iter().all(|r| r["verdict"] == "pass"), "{rows:?}");
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
fn a_lack_excuses_the_choices_it_is_said_of_and_no_others() {
    let s = Scratch::new();
    let about = s.run("models cook_torrance --json").ok().json();
    assert_eq!(about["lacks"][0]["when"], serde_json::json!({ "form": ["printed"] }));
    assert!(s.run("models cook_torrance").ok().out.contains("energy conservation where form is printed:"));
    let verdict = |form: &str| {
        let words = format!("verify cook_torrance diffuse=1 eta=0 form={form} wo=10,0 --samples 5000 --json");
        let model = s.run(&words).ok().json()["models"][0].clone();
        let furnace = model["rows"].as_array().unwrap().iter().find(|r| r["question"] == "furnace").unwrap();
        (furnace["verdict"].clone(), model["claims"][0]["found"].clone())
    };
    assert_eq!(verdict("printed"), ("known".into(), 1.into()));
    assert_eq!(verdict("normalized"), ("pass".into(), 0.into()));
    // A claim that nothing bears out is told: at a reflectance of a tenth four times too much is no gain.
    let quiet =
        s.run("verify cook_torrance specular=0.1 diffuse=0 form=printed wo=10,0 --samples 5000").ok().out;
    assert!(quiet.contains("said to lack energy conservation"), "{quiet}");
}

#[test]
fn what_cannot_be_asked_is_told() {
    let s = Scratch::new();
    for (words, told) in [
        ("verify", "name one model, or give --all"),
        ("verify chrome", "there is no model `chrome`"),
        ("verify lambret", "did you mean \"lambert\"?"),
        ("verify lambert shine=1", "no parameter `shine`; known are reflectance, wo"),
        ("verify lambert reflectance=2", "give a number from 0 to 1"),
        ("models chrome", "`sparrow models` lists them"),
    ] {
        let run = s.run(words);
        assert_eq!(run.code, Some(2), "{words}");
        assert!(run.err.contains(told), "`{told}` is not in {}", run.err);
    }
}

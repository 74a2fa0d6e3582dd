//! Every rendered figure in draft quality passes its own checks. The whole book has a test of its own.

use std::sync::atomic::AtomicBool;

use sparrow_lecture::{Quality, Studio, select};

fn holds(id: &str) {
    let folder = std::env::temp_dir().join(format!("sparrow-lecture-{}-{id}", std::process::id()));
    let stop = AtomicBool::new(false);
    let studio = Studio::new(Quality::Draft, &folder, &stop).unwrap();
    for (_, entry) in select(Some(id)).unwrap() {
        let start = std::time::Instant::now();
        let figure = (entry.make)(&studio).unwrap_or_else(|e| unreachable!("{id}: {e}"));
        let wrong: Vec<_> = figure.checks.iter().filter(|c| !c.holds()).collect();
        if let Ok(out) = std::env::var("LOOK") {
            for p in &figure.pictures {
                let (end, bytes) = match &p.content { sparrow_lecture::Content::Svg(s) => ("svg", s.as_bytes().to_vec()), sparrow_lecture::Content::Png(b) => ("png", b.clone()) };
                std::fs::write(format!("{out}/{id}-{}.{end}", p.name), bytes).unwrap();
            }
            if let Some(t) = &figure.table { std::fs::write(format!("{out}/{id}.csv"), t.csv()).unwrap(); }
            for c in &figure.checks { eprintln!("{} {id}: {} = {:.5} ({:?})", if c.holds() {"ok"} else {"NO"}, c.what, c.measured, c.bound); }
            eprintln!("{id} took {:?}", start.elapsed());
        }
        assert!(wrong.is_empty() && figure.passed(), "{id}: {wrong:#?}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

macro_rules! figures {
    ($($name:ident $id:literal)*) => {
        $(#[test]
        fn $name() {
            holds($id);
        })*
    };
}

figures! {
    brushed "brushed"
    horse "quarterhorse"
    wound "wound"
    sphere "highlight-sphere"
    cylinder "highlight-cylinder"
    disc "highlight-disc"
    aluminium "plates-aluminium"
    oxide "plates-magnesium-oxide"
    cone "cone-on-screen"
    caustic "caustic-on-screen"
    herbert "herbert"
    tresses "tresses"
    strand "strand"
    circular "circular-light"
    plates "plate-scene"
    surfaces "gallery-surfaces"
    fibres "gallery-fibres"
}

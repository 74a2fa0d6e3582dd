//! Every rendered figure in draft quality passes its own checks; the whole book has a test of its own.

use std::sync::atomic::AtomicBool;

use sparrow_lecture::{Check, Quality, Studio, select};

fn holds(id: &str) {
    let folder = std::env::temp_dir().join(format!("sparrow-lecture-{}-{id}", std::process::id()));
    let stop = AtomicBool::new(false);
    let studio = Studio::new(Quality::Draft, &folder, &stop).unwrap();
    for (_, entry) in select(Some(id)).unwrap() {
        let figure = (entry.make)(&studio).unwrap_or_else(|e| unreachable!("{id}: {e}"));
        let wrong: Vec<&Check> = figure.checks.iter().filter(|c| !c.holds()).collect();
        assert!(figure.passed(), "{id}: {wrong:#?}");
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

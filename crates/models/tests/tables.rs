//! The tables of all registered models: parameters, names, files, lacks. What the models compute is tried by `sparrow-verify`,
//! lanes are held to scalars in `batch.rs`.

use sparrow_models::{FibreKind, MAX_CHOICES, MAX_REALS, MAX_SPECTRA, ModelKind, ParamKind, SurfaceKind};

#[test]
fn tables_fit_the_parameter_block_and_names_are_unique() {
    let mut names: Vec<&str> = ModelKind::all().map(ModelKind::name).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), ModelKind::all().count());
    for kind in ModelKind::all() {
        let count = |of: fn(&ParamKind) -> bool| kind.params().iter().filter(|p| of(&p.kind)).count();
        assert!(count(|k| matches!(k, ParamKind::Real)) <= MAX_REALS, "{}", kind.name());
        assert!(count(|k| matches!(k, ParamKind::Choice(_))) <= MAX_CHOICES, "{}", kind.name());
        assert!(
            count(|k| matches!(k, ParamKind::Albedo | ParamKind::Unbounded)) <= MAX_SPECTRA,
            "{}",
            kind.name()
        );
        assert_eq!(ModelKind::from_name(kind.name()), Some(kind));
        for p in kind.params() {
            assert!(p.range[0] <= p.default && p.default <= p.range[1] && !p.doc.is_empty(), "{}", p.name);
        }
    }
}

#[test]
fn every_file_of_the_folders_is_registered() {
    let surfaces: Vec<&str> = SurfaceKind::ALL.iter().map(|k| k.name()).collect();
    let fibres: Vec<&str> = FibreKind::ALL.iter().map(|k| k.name()).collect();
    for (folder, names) in [("surface", surfaces), ("fibre", fibres)] {
        let path = format!("{}/src/{folder}", env!("CARGO_MANIFEST_DIR"));
        let files: Vec<String> = std::fs::read_dir(path)
            .expect("the folder of models")
            .filter_map(|f| f.ok()?.file_name().to_str()?.strip_suffix(".rs").map(String::from))
            .filter(|f| f != "mod")
            .collect();
        assert_eq!(files.len(), names.len(), "{files:?}");
        for f in files {
            assert!(names.contains(&f.as_str()), "{f}.rs is not in the table of {folder}/mod.rs");
        }
    }
}

#[test]
fn what_a_model_lacks_is_said_of_choices_that_it_has() {
    for kind in ModelKind::all() {
        for lack in kind.about().lacks {
            assert!(!lack.reason.is_empty(), "{}", kind.name());
            for (param, choices) in lack.when {
                let known = kind.params().iter().find(|p| p.name == *param).map(|p| p.kind);
                let Some(ParamKind::Choice(names)) = known else {
                    panic!("{} has no choice `{param}`", kind.name())
                };
                let all = choices.iter().all(|c| names.contains(c));
                assert!(all && !choices.is_empty(), "{} {param}: {choices:?}", kind.name());
            }
        }
    }
}

#[test]
fn a_lack_applies_where_all_its_choices_are_made() {
    let kind = SurfaceKind::MicrofacetReflection;
    let turquin = kind.about().lacks.iter().find(|l| l.property == sparrow_models::Property::Reciprocity);
    let turquin = turquin.expect("turquin is not reciprocal");
    // ndf, masking, fresnel, sampling, energy.
    for (choices, applies) in
        [([0, 0, 0, 0, 1], true), ([0, 0, 3, 2, 1], true), ([1, 0, 0, 0, 1], false), ([0, 0, 0, 0, 2], false)]
    {
        assert_eq!(turquin.applies(kind.params(), &choices), applies, "{choices:?}");
    }
}

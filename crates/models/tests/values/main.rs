//! The models against reference values that were computed independently: every record is asked for, or its absence has a
//! reason.
//!
//! One test, because only then the records that nobody asked for are known. Its checks run side by side, each under its own
//! name; `SPARROW_CHECK=charlie` runs those whose name holds that word.

#[path = "../reference/mod.rs"]
mod reference;

mod classic;
mod cloth_and_grooves;
mod microfacet;
mod read;
mod terms;

/// Every check, by its path.
macro_rules! checks {
    ($($module:ident :: $check:ident,)*) => {
        &[$((concat!(stringify!($module), "::", stringify!($check)), $module::$check)),*]
    };
}

const CHECKS: &[(&str, fn())] = checks! {
        classic::phong_family_and_the_lecture_s_microfacets,
        classic::phong_albedos,
        classic::oren_nayar_and_eon,
        classic::eon_samples_the_clipped_lobe,
        classic::torrance_and_sparrow_s_grooves,
        classic::torrance_and_sparrow_s_peaks_lie_off_the_mirror_direction,
        classic::cook_torrance_as_printed_and_put_right,
        classic::ashikhmin_and_shirley_s_highlight_and_base,
        classic::ward_and_its_repairs,
        classic::bouguer_s_facets_are_matt_at_normal_incidence_only,
        classic::banks_s_threads,
        classic::velvet_s_layer,
        classic::mirror_cylinders_return_what_tracing_finds,
        terms::fresnel_terms,
        terms::fresnel_approximations_and_averages,
        terms::distributions,
        terms::masking,
        terms::visible_normals,
        terms::projections_of_visible_facets,
        terms::walter_s_rational_masking,
        terms::bouguer_s_best_distribution,
        microfacet::masses_of_densities_above,
        microfacet::compensation_of_reflecting_facets,
        microfacet::reflecting_facets,
        microfacet::refracting_facets,
        microfacet::albedos_and_compensation,
        microfacet::walks_match_their_records_and_lose_nothing,
        microfacet::models_that_walk_lose_nothing,
        microfacet::walks_of_a_pair_are_the_same_either_way_round,
        microfacet::white_furnace_of_each_energy_choice,
        microfacet::light_on_either_side_of_a_boundary,
        microfacet::white_furnace_of_each_energy_choice_of_a_boundary,
        cloth_and_grooves::charlie_sheen,
        cloth_and_grooves::bounces_in_v_grooves,
};

/// Records that no check here asks for: the beginning of their ids, how many there are, and why.
const ELSEWHERE: [(&str, usize, &str); 3] = [
    ("he.dd.", 3, "there is no model of physical optics yet"),
    ("poulin.visible.", 8, "what is seen of a cylinder is private: src/surface/poulin_fournier.rs asks"),
    ("poulin.phimax.", 2, "the steepest facet is private: src/surface/poulin_fournier.rs asks"),
];

#[test]
#[allow(clippy::print_stdout, reason = "the count is the test's report")]
fn every_record_is_asked_for_and_holds() {
    let word = std::env::var("SPARROW_CHECK").unwrap_or_default();
    let chosen: Vec<_> = CHECKS.iter().filter(|(name, _)| name.contains(&word)).collect();
    let failed: Vec<&str> = std::thread::scope(|scope| {
        let running: Vec<_> = chosen
            .into_iter()
            .map(|&(name, check)| {
                let thread = std::thread::Builder::new().name(name.to_owned());
                (name, thread.spawn_scoped(scope, check).expect("a thread"))
            })
            .collect();
        running.into_iter().filter_map(|(name, thread)| thread.join().is_err().then_some(name)).collect()
    });
    assert!(failed.is_empty(), "{failed:?}");
    if !word.is_empty() {
        return;
    }

    let mut unused = reference::unused();
    let all = reference::count();
    println!("{} of {all} records hold", all - unused.len());
    for (prefix, count, why) in ELSEWHERE {
        let before = unused.len();
        unused.retain(|id| !id.starts_with(prefix));
        println!("{count} records {prefix}* are not asked for here: {why}");
        assert_eq!(before - unused.len(), count, "records {prefix}*");
    }
    assert!(unused.is_empty(), "nobody asks for {unused:?}");

    let poulin = include_str!("../../src/surface/poulin_fournier.rs");
    assert!(poulin.contains("\"poulin.visible.\"") && poulin.contains("\"poulin.phimax.\""), "see ELSEWHERE");
}

//! Figures against the models they show, and the text of pictures.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use sparrow_math::Real;
use sparrow_models::{Bsdf, FibreKind, SurfaceKind};
use sparrow_plot::figure::{Traced, albedo, draw_samples, plane_direction};
use sparrow_plot::{Figure, Kind, Options, Quantity, Series, draw_fibres, draw_figure, parse_series};
use sparrow_stats::cubature::Stop;
use sparrow_stats::integrate_sphere;

fn series(text: &str) -> Vec<Series> {
    parse_series(&text.split_whitespace().map(String::from).collect::<Vec<_>>()).unwrap()
}

fn figure(text: &str, options: &Options) -> Figure {
    draw_figure(&series(text), options).unwrap()
}

fn of(kind: Kind) -> Options {
    Options { kind, ..Options::default() }
}

/// The fields of a table of numbers, without its head.
fn numbers(csv: &str) -> Vec<Vec<f64>> {
    let row = |line: &str| line.split(',').map(|v| v.parse().unwrap()).collect();
    csv.lines().skip(1).map(row).collect()
}

/// Every text of a picture that has to be a whole SVG document.
fn texts(svg: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let root = document.root_element();
    assert!(root.has_tag_name(("http://www.w3.org/2000/svg", "svg")));
    let size: Vec<f64> = root.attribute("viewBox").unwrap().split(' ').map(|v| v.parse().unwrap()).collect();
    assert!(size.len() == 4 && size[2] >= 320.0 && size[3] >= 320.0, "{size:?}");
    for node in document.descendants().filter(|n| n.is_element()) {
        assert!(!node.has_tag_name("script"), "works without scripts");
        for a in node.attributes() {
            assert!(!a.value().contains("NaN") && !a.value().contains("inf"), "{}: {}", a.name(), a.value());
        }
    }
    let of_text = |n: roxmltree::Node<'_, '_>| {
        n.descendants().filter(|d| d.is_text()).filter_map(|d| d.text()).collect::<String>()
    };
    document.descendants().filter(|n| n.has_tag_name("text")).map(of_text).collect()
}

#[test]
fn tables_hold_the_values_of_the_models() {
    for (quantity, head) in
        [(Quantity::F, "f [1/sr]"), (Quantity::FCos, "f_cos [1/sr]"), (Quantity::Pdf, "pdf [1/sr]")]
    {
        let words = "microfacet_dielectric alpha_x=0.3 eta=1.4 + lambert wo=55,20";
        let csv = figure(words, &Options { quantity, ..of(Kind::Cartesian) }).table.csv();
        assert!(csv.lines().next().unwrap().contains(head), "{head}");
        let rows = numbers(&csv);
        assert!(rows.len() > 360, "both sides, a degree apart or less");
        for row in &rows {
            for (s, v) in series(words).iter().zip(&row[1..]) {
                let (wo, wi) = (s.wo(), plane_direction([55.0, 20.0], row[0]));
                let want = match quantity {
                    Quantity::F => s.model().f(wo, wi)[0],
                    Quantity::FCos => s.model().f_cos(wo, wi)[0],
                    Quantity::Pdf => s.model().pdf(wo, wi),
                };
                assert_eq!(v.to_bits(), want.to_bits(), "{} at {}", s.name(), row[0]);
            }
        }
        // The other picture of the plane has the same numbers.
        assert_eq!(figure(words, &Options { quantity, ..of(Kind::Polar) }).table.csv(), csv);
    }
}

#[test]
fn the_albedo_of_lambert_is_its_reflectance() {
    let rows = numbers(&figure("lambert reflectance=0,0.3,1", &of(Kind::Albedo)).table.csv());
    assert!(rows.len() == 90 && (rows[89][0] - 89.0).abs() < 1e-12);
    for row in rows {
        for (got, want) in row[1..].iter().zip([0.0, 0.3, 1.0]) {
            assert!((got - want).abs() < 1e-4, "{row:?}");
        }
    }
}

#[test]
fn no_light_is_lost_where_none_is_absorbed() {
    // Smooth glass keeps all; a pair of lobes in one density has to be told from the power behind the surface.
    for (words, tolerance) in [
        ("dielectric wo=40", 1e-9),
        ("thin_dielectric wo=70", 1e-9),
        ("diffuse_transmission reflectance=0.3 transmittance=0.7 wo=20", 1e-4),
        // Rough glass loses what meets two facets, not much of it.
        ("dielectric alpha=0.1 wo=30", 0.01),
    ] {
        let s = &series(words)[0];
        let a = albedo(&s.model(), s.wo());
        assert!((a - 1.0).abs() < tolerance, "{words}: {a}");
    }
}

#[test]
fn samples_follow_their_density() {
    for words in [
        "conductor alpha_x=0.2 alpha_y=0.5 wo=50,30",
        "phong exponent=10 wo=30",
        "dielectric alpha=0.3 wo=50",
    ] {
        let s = &series(words)[0];
        let (n, seen) = (20_000, draw_samples(s, 20_000, 7));
        let importance: Vec<_> = seen.iter().map(|d| d.wi).collect();
        for (from, degrees) in [(50.0, 12.0), (50.0, 40.0), (0.0, 35.0), (150.0, 20.0)] {
            let axis = plane_direction(s.wo_deg, from);
            let cosine = Real::cos(f64::to_radians(degrees));
            let share = integrate_sphere(
                |w| if w.dot(axis) > cosine { s.model().pdf(s.wo(), w) } else { 0.0 },
                &importance,
                Stop { error: 1e-3, evaluations: 200_000 },
            );
            let got = seen.iter().filter(|d| d.wi.dot(axis) > cosine).count() as f64 / f64::from(n);
            // Four standard errors of a share, and what the integral may miss.
            let allowed = 4.0 * (share * (1.0 - share).max(0.0) / f64::from(n)).sqrt() + 3e-3;
            assert!((got - share).abs() < allowed, "{words}, {degrees} around {from}: {got}, not {share}");
        }
        let again = draw_samples(s, 100, 7);
        assert!(again.iter().zip(&seen).all(|(a, b)| a.wi == b.wi), "a seed fixes the samples");
    }
}

#[test]
fn every_model_makes_whole_pictures() {
    for kind in SurfaceKind::ALL {
        for plot in [Kind::Polar, Kind::Cartesian, Kind::Lobe3d, Kind::HalfDifference, Kind::Samples] {
            for log in [false, true] {
                let options = Options { log, samples: 50, dark: log, ..of(plot) };
                let figure = draw_figure(&[Series::new(*kind)], &options).unwrap();
                let texts = texts(&figure.svg);
                let what = format!("{} as {}", kind.name(), plot.name());
                assert!(texts.iter().any(|t| t == kind.name()), "{what} has its title");
                assert!(texts.iter().any(|t| t.contains("[1/sr]")), "{what} has a unit");
                assert!(figure.svg.len() < 250_000, "{what}: {} bytes", figure.svg.len());
            }
        }
    }
}

#[test]
fn the_same_wish_gives_the_same_bytes() {
    for kind in [Kind::Polar, Kind::Lobe3d, Kind::Samples, Kind::Albedo] {
        let draw = || figure("conductor alpha=0.2,0.5 wo=30", &of(kind));
        let (a, b) = (draw(), draw());
        assert!(a.svg == b.svg && a.table.csv() == b.table.csv(), "{}", kind.name());
    }
}

#[test]
fn legends_name_what_sets_series_apart() {
    let all = texts(&figure("conductor alpha=0.1,0.3 k=2 wo=60", &of(Kind::Polar)).svg);
    let has = |t: &str| all.iter().any(|x| x.contains(t));
    assert!(has("alpha = 0.1") && has("alpha = 0.3"), "{all:?}");
    // What all have in common stands in the subtitle, once.
    assert_eq!(all.iter().filter(|t| t.contains("k = 2")).count(), 1, "{all:?}");
    let all = texts(&figure("phong exponent=50 + lambert", &of(Kind::Cartesian)).svg);
    assert!(all.iter().any(|t| t == "phong, exponent = 50") && all.iter().any(|t| t == "lambert"), "{all:?}");
}

#[test]
fn mirrors_are_not_lost() {
    // Fresnel's reflectance of 0.2 + 3.9 i at 45 degrees is 0.95.
    for kind in [Kind::Polar, Kind::Cartesian, Kind::Lobe3d, Kind::Samples] {
        let all = texts(&figure("conductor", &of(kind)).svg);
        assert!(all.iter().any(|t| t.starts_with("δ 0.95")), "{}: {all:?}", kind.name());
        assert!(all.iter().any(|t| t.contains("(delta) lobes")), "{}: {all:?}", kind.name());
    }
    // Both lobes of glass are there, the refracted one below the surface.
    let all = texts(&figure("dielectric", &of(Kind::Polar)).svg);
    assert_eq!(all.iter().filter(|t| t.starts_with('δ')).count(), 2, "{all:?}");
    assert!(all.iter().any(|t| t == "180°"), "{all:?}");
}

#[test]
fn texts_of_users_are_escaped() {
    let title = "a < b & \"c\" </svg>";
    let options = Options { title: Some(title.to_owned()), ..Options::default() };
    assert!(texts(&figure("lambert", &options).svg).iter().any(|t| t == title));
}

#[test]
fn maps_run_over_the_roughness() {
    let f = figure("eon", &of(Kind::AlbedoMap));
    assert!(texts(&f.svg).iter().any(|t| t == "roughness"));
    assert!(
        f.table.csv().starts_with("series,theta_o_deg,roughness,albedo\neon,0.0,0.0,0."),
        "{}",
        &f.table.csv()[..80]
    );
    let refuse = |words: &str, over: Option<&str>| {
        let options = Options { over: over.map(String::from), ..of(Kind::AlbedoMap) };
        draw_figure(&series(words), &options).unwrap_err().to_string()
    };
    assert!(refuse("lambert", None).contains("has no roughness"));
    // The axis goes over a value that was given, and says so; what is left then is one series.
    let f = figure(
        "lambert reflectance=0.2,0.7",
        &Options { over: Some("reflectance".to_owned()), ..of(Kind::AlbedoMap) },
    );
    assert!(texts(&f.svg).iter().any(|t| t.starts_with("reflectance is the axis")));
    let csv = f.table.csv();
    let rows: Vec<Vec<f64>> =
        csv.lines().skip(1).map(|l| l.split(',').skip(1).map(|v| v.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 31 * 25);
    assert!(rows.iter().all(|r| (r[1] - r[2]).abs() < 1e-4), "the albedo of Lambert is its reflectance");
    assert!(refuse("eon", Some("rougness")).contains("did you mean \"roughness\"?"));
    assert!(refuse("microfacet_reflection", Some("ndf")).contains("has no number `ndf`"));
    let many = series("conductor alpha=0.1,0.2,0.3,0.4,0.5,0.6,0.7");
    assert!(draw_figure(&many, &of(Kind::Lobe3d)).unwrap_err().to_string().contains("room for 6"));
}

#[test]
fn small_pages_and_numbers_without_range_are_drawn() {
    for kind in Kind::ALL.into_iter().filter(|k| !k.of_fibres()) {
        let options = Options { size: [Some(320.0), Some(320.0)], samples: 0, ..of(kind) };
        // No light at all, hardly any, and a lobe near the limit of numbers.
        for words in
            ["phong diffuse=0 specular=0", "phong diffuse=1e-300 specular=0", "phong exponent=10000 wo=89.99"]
        {
            // Albedo takes long, and has no unit to lose.
            if matches!(kind, Kind::Albedo | Kind::AlbedoMap) {
                continue;
            }
            for (log, normalize) in [(false, false), (true, true)] {
                texts(&figure(words, &Options { log, normalize, ..options.clone() }).svg);
            }
        }
    }
}

#[test]
fn views_from_below_are_drawn() {
    for words in ["lambert wo=130", "dielectric alpha=0.3 wo=120,40", "conductor wo=180"] {
        for kind in [Kind::Polar, Kind::Cartesian, Kind::Lobe3d, Kind::Samples] {
            let all = texts(&figure(words, &of(kind)).svg);
            assert!(all.iter().any(|t| t.starts_with('ω')), "{words} as {}: {all:?}", kind.name());
        }
    }
}

#[test]
fn every_fibre_makes_whole_pictures() {
    for kind in FibreKind::ALL {
        for plot in Kind::ALL.into_iter().filter(|k| k.of_fibres()) {
            let mut s = Series::new(*kind);
            // One ray, since some models take long over the width.
            s.h = Some(0.3);
            let drawn = draw_fibres(&[s], &[], &of(plot));
            if *kind == FibreKind::MirrorCylinder {
                assert!(drawn.unwrap_err().to_string().contains("is a mirror"));
                continue;
            }
            let (texts, what) = (texts(&drawn.unwrap().svg), format!("{} as {}", kind.name(), plot.name()));
            assert!(
                texts.iter().any(|t| t == kind.name())
                    && texts.iter().any(|t| t.contains("rad]") || t.contains("/sr]")),
                "{what}: {texts:?}"
            );
        }
    }
    let refused = draw_figure(&series("lambert"), &of(Kind::Caustic)).unwrap_err().to_string();
    assert!(refused.contains("show fibres; for surfaces there are polar"), "{refused}");
}

#[test]
fn a_section_of_white_hair_holds_all_light() {
    let words = "hair sigma_a=0 wo=30".split(' ').map(String::from).collect::<Vec<_>>();
    let hair = parse_series::<FibreKind>(&words).unwrap();
    let csv = draw_fibres(&hair, &[], &of(Kind::Azimuthal)).unwrap().table.csv();
    assert!(csv.starts_with("phi_deg,R,TT,TRT,more,all\n"), "{csv:.80}");
    let all: Vec<f64> = csv.lines().skip(1).map(|l| l.rsplit(',').next().unwrap().parse().unwrap()).collect();
    // Steps of one degree; both ends are the same place.
    let light = all[1..].iter().sum::<f64>().to_radians();
    assert!((light - 1.0).abs() < 2e-3, "{light}");
}

#[test]
fn what_was_traced_lies_over_a_section() {
    let angles: Vec<f64> = (-35..=35).map(|k| 5.0 * f64::from(k)).collect();
    let traced = Traced { lobes: vec![[0.1, 0.2, 0.3, 0.4]; angles.len()], angles };
    let figure = draw_fibres(&[Series::new(FibreKind::DEon)], &[traced], &of(Kind::Azimuthal)).unwrap();
    let all = texts(&figure.svg);
    assert!(all.iter().any(|t| t == "TRT") && all.iter().any(|t| t == "TRT traced"), "{all:?}");
    let csv = figure.table.csv();
    let row = csv.lines().find(|l| l.starts_with("-5.0,")).unwrap();
    assert!(row.ends_with(",0.1,0.2,0.3,0.4,1.0"), "{row}");
    let between = csv.lines().find(|l| l.starts_with("-4.0,")).unwrap();
    assert!(between.ends_with(",,,,,"), "{between}");
}

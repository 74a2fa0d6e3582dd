use super::*;

/// A unit square in the plane y = 0, its normal up; u runs along x.
const P: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0]];
const UV: [[f32; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
const TRIANGLES: [[u32; 3]; 2] = [[0, 2, 1], [0, 3, 2]];

fn square() -> Surface<'static> {
    Surface { p: &P, n: &[], uv: &UV, triangles: &TRIANGLES }
}

fn plain() -> Style {
    Style { count: Count::Strands(400), length: 0.5, length_spread: 0.0, ..Style::default() }
}

fn tip(strand: &[[f32; 4]]) -> [f32; 3] {
    let [x, y, z, _] = strand[strand.len() - 1];
    [x, y, z]
}

#[test]
fn plain_strands_are_straight_and_of_the_length_asked_for() {
    let groom = grow(&square(), &[], &plain()).unwrap();
    assert_eq!(groom.strands().len(), 400);
    for s in groom.strands() {
        assert_eq!(s.len(), 9);
        assert!(s[0][1].abs() < 1e-7 && (0.0..=1.0).contains(&s[0][0]) && (0.0..=1.0).contains(&s[0][2]));
        let [x, y, z] = tip(s);
        assert!((x - s[0][0]).abs() < 1e-6 && (y - 0.5).abs() < 1e-6 && (z - s[0][2]).abs() < 1e-6, "{s:?}");
        assert!((s[0][3] - 1e-3).abs() < 1e-9 && (s[8][3] - 2e-4).abs() < 1e-9);
    }
}

#[test]
fn roots_are_spread_by_area() {
    // The second triangle is a quarter of the first.
    let p = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [-0.5, 0.0, 0.0], [0.0, 0.0, -0.5]];
    let surface = Surface { p: &p, triangles: &[[0, 2, 1], [0, 4, 3]], ..Surface::default() };
    let groom = grow(&surface, &[], &plain()).unwrap();
    let small = groom.strands().filter(|s| s[0][0] < 0.0).count();
    assert_eq!(small, 80);
    let by_area = Style { count: Count::PerArea(1000.0), ..plain() };
    assert_eq!(grow(&surface, &[], &by_area).unwrap().strands().len(), 625);
}

#[test]
fn strands_lean_along_the_flow() {
    let cases = [
        (Flow::Along(vec3(1.0, 5.0, 0.0)), [1.0, 0.0]),
        (Flow::U, [1.0, 0.0]),
        (Flow::V, [0.0, 1.0]),
        (Flow::From(vec3(0.5, 0.0, -1e6)), [0.0, 1.0]),
        (Flow::Parting([vec3(-1.0, 0.0, -1.0), vec3(2.0, 0.0, -1.0)]), [0.0, 1.0]),
    ];
    for (flow, [x, z]) in cases {
        let groom = grow(&square(), &[], &Style { flow, lean_deg: 60.0, ..plain() }).unwrap();
        for s in groom.strands() {
            let t = tip(s);
            let d = [t[0] - s[0][0], t[1], t[2] - s[0][2]].map(|v| v / 0.5);
            let want = [0.75_f32.sqrt() * x, 0.5, 0.75_f32.sqrt() * z];
            assert!((0..3).all(|i| (d[i] - want[i]).abs() < 1e-5), "{flow:?}: {d:?}");
        }
    }
    let around = Flow::Around(vec3(0.0, 1.0, 0.0));
    let groom = grow(&square(), &[], &Style { flow: around, lean_deg: 90.0, ..plain() }).unwrap();
    for s in groom.strands() {
        let d = [tip(s)[0] - s[0][0], tip(s)[2] - s[0][2]];
        assert!(d[0] >= 0.0 && d[1] <= 0.0, "by the right hand, +z turns to +x and +x to -z: {d:?}");
    }
}

#[test]
fn gravity_bends_and_keeps_the_length() {
    let groom = grow(&square(), &[], &Style { gravity: vec3(3.0, 0.0, 0.0), ..plain() }).unwrap();
    for s in groom.strands() {
        assert!(tip(s)[0] - s[0][0] > 0.2, "{s:?}");
        let length: f32 =
            s.windows(2).map(|w| (0..3).map(|i| (w[1][i] - w[0][i]).powi(2)).sum::<f32>().sqrt()).sum();
        assert!((length - 0.5).abs() < 1e-5, "{length}");
    }
}

/// A ball of radius 1 around the origin: rings from pole to pole.
fn ball() -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let (around, along) = (32, 16);
    let corner = |j: u32, i: u32| {
        let (sin_phi, cos_phi) = Real::sin_cos(core::f64::consts::TAU * f64::from(i) / f64::from(around));
        let (sin, cos) = Real::sin_cos(core::f64::consts::PI * f64::from(j) / f64::from(along));
        [sin * sin_phi, cos, sin * cos_phi].map(|v| v as f32)
    };
    let p = (0..=along).flat_map(|j| (0..around).map(move |i| corner(j, i))).collect();
    let cells =
        (0..along).flat_map(|j| (0..around).map(move |i| (j * around + i, j * around + (i + 1) % around)));
    (p, cells.flat_map(|(a, b)| [[a, a + around, b + around], [a, b + around, b]]).collect())
}

#[test]
fn long_hair_hangs_around_the_body() {
    let (p, triangles) = ball();
    let ball = Surface { p: &p, triangles: &triangles, ..Surface::default() };
    let scalp = Surface { triangles: &triangles[..256], ..ball };
    let style = Style {
        length: 3.0,
        n_segments: 40,
        lean_deg: 60.0,
        flow: Flow::From(vec3(0.0, 1.0, 0.0)),
        gravity: vec3(0.0, -30.0, 0.0),
        clearance: 0.1,
        noise: 0.3,
        clump: 0.5,
        curl: 0.02,
        ..plain()
    };
    let least = |groom: &Groom| {
        let radii = groom.points.iter().map(|p| p[0].hypot(p[1]).hypot(p[2]));
        radii.fold(f32::INFINITY, f32::min)
    };
    // Where cells are flat, their middles lie up to 1.5 % within the ball.
    let hair = grow(&scalp, &[ball], &style).unwrap();
    assert!(least(&hair) > 0.984, "a strand enters the ball: {}", least(&hair));
    assert!(least(&grow(&scalp, &[], &style).unwrap()) < 0.5, "without a body strands fall through");
    let straight = Style { clump: 0.0, curl: 0.0, ..style };
    for s in grow(&scalp, &[ball], &straight).unwrap().strands() {
        let sides = s.windows(2).map(|w| (0..3).map(|i| (w[1][i] - w[0][i]).powi(2)).sum::<f32>().sqrt());
        let length: f32 = sides.sum();
        assert!((2.9..3.001).contains(&length), "turned, not shortened: {length}");
        let [x, y, z] = tip(s);
        assert!(x.hypot(z) > 0.9 && y < -0.5, "tips hang beside the ball: {:?}", tip(s));
    }
}

#[test]
fn clumps_draw_tips_together() {
    let spread = |clump: f64| {
        let groom = grow(&square(), &[], &Style { clump, clump_size: 20, ..plain() }).unwrap();
        let mut tips: Vec<[i32; 2]> =
            groom.strands().map(|s| [tip(s)[0], tip(s)[2]].map(|v| (v * 1e4).round() as i32)).collect();
        tips.sort_unstable();
        tips.dedup();
        tips.len()
    };
    assert_eq!(spread(1.0), 20, "all tips of a clump meet in one point");
    assert!(spread(0.5) > 300);
}

#[test]
fn curls_stay_at_their_radius() {
    let style = Style { curl: 0.03, curl_turns: 4.0, n_segments: 64, ..plain() };
    for s in grow(&square(), &[], &style).unwrap().strands() {
        for p in &s[16..] {
            let r = ((p[0] - s[0][0]).powi(2) + (p[2] - s[0][2]).powi(2)).sqrt();
            assert!((r - 0.03).abs() < 1e-5, "{r}");
        }
    }
}

#[test]
fn equal_seeds_give_equal_bits() {
    let style = Style { noise: 1.0, curl: 0.01, clump: 0.3, ..plain() };
    let once = grow(&square(), &[], &style).unwrap();
    assert_eq!(once, grow(&square(), &[], &style).unwrap());
    assert_ne!(once, grow(&square(), &[], &Style { seed: 1, ..style }).unwrap());
}

#[test]
fn what_cannot_be_grown_on_is_told() {
    let of = |surface: Surface| grow(&surface, &[], &plain()).unwrap_err();
    assert_eq!(of(Surface { triangles: &[], ..square() }), GroomError::NoFaces);
    assert_eq!(of(Surface { triangles: &[[0, 1, 1]], ..square() }), GroomError::NoArea);
    assert_eq!(
        of(Surface { triangles: &[[0, 1, 2], [0, 1, 9]], ..square() }),
        GroomError::BadFace { face: 1 }
    );
    let p = [[0.0; 3], [f32::NAN, 0.0, 0.0], [1.0; 3]];
    assert_eq!(of(Surface { p: &p, triangles: &[[0, 1, 2]], ..square() }), GroomError::BadFace { face: 0 });
    let styled = |style: Style| grow(&Surface { uv: &[], ..square() }, &[], &style).unwrap_err();
    assert_eq!(styled(Style { flow: Flow::U, ..plain() }), GroomError::NoCoordinates);
    assert_eq!(styled(Style { count: Count::PerArea(0.1), ..plain() }), GroomError::NoStrands { area: 1.0 });
    let many = Style { count: Count::PerArea(1e12), ..plain() };
    assert!(matches!(styled(many), GroomError::TooMany { .. }));
    assert_eq!(styled(Style { length: 1e300, ..plain() }), GroomError::TooLarge);
    for bad in [
        Style { length: 0.0, ..plain() },
        Style { length: f64::NAN, ..plain() },
        Style { length_spread: 1.0, ..plain() },
        Style { n_segments: 0, ..plain() },
        Style { width: [-1.0, 0.0], ..plain() },
        Style { lean_deg: 91.0, ..plain() },
        Style { clump: 1.1, ..plain() },
        Style { clump_size: 0, ..plain() },
        Style { curl: f64::INFINITY, ..plain() },
        Style { flow: Flow::Along(Vec3::splat(0.0)), ..plain() },
        Style { gravity: vec3(f64::NAN, 0.0, 0.0), ..plain() },
        Style { count: Count::Strands(0), ..plain() },
        Style { clearance: -1.0, ..plain() },
        Style { flow: Flow::Parting([Vec3::splat(1.0); 2]), ..plain() },
    ] {
        assert!(matches!(styled(bad.clone()), GroomError::OutOfRange { .. }), "{bad:?}");
    }
}

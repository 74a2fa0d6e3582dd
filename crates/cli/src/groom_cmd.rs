//! `sparrow groom`: hair and fur grown on a mesh, as a `.hair` file.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};
use serde::Serialize;
use sparrow_groom::{Count, Flow, Style, Surface, grow};
use sparrow_math::{Vec3, vec3};
use sparrow_scene::curve_files::hair_bytes;
use sparrow_scene::obj::{self, ObjMesh};
use sparrow_scene::ply;

use crate::failure::{DONE, Failure};
use crate::{console, paths};

/// Grow hair or fur on a mesh, as a .hair file for Shape "hair"
#[derive(Debug, Args)]
#[command(after_help = "\
Lengths are those of the mesh. A strand starts along the normal, leaning towards the flow, and is bent by gravity and noise; clumps \
draw tips together; curl winds what comes out. With --body strands stay outside of it, each at a distance of its own up to the \
clearance. The same meshes, options and seed give the same file, byte for byte.")]
#[command(allow_negative_numbers = true)]
pub(crate) struct GroomArgs {
    /// Mesh, in the PLY or the OBJ format
    mesh: PathBuf,

    /// Name of the file [default: the mesh's, in the current folder]
    #[arg(short, long, value_name = "OUT.hair", value_parser = PathBufValueParser::new().try_map(parse_output))]
    output: Option<PathBuf>,

    /// Closed mesh that strands stay outside of, in the coordinates of the other; several, that may be parts of one, are given one by
    /// one [default: none]
    #[arg(long, value_name = "MESH")]
    body: Vec<PathBuf>,

    /// Number of strands
    #[arg(long, value_name = "N", default_value_t = 10_000, conflicts_with = "density")]
    count: u32,

    /// Strands per unit of area, in the place of --count [default: none]
    #[arg(long, value_name = "X")]
    density: Option<f64>,

    /// Length of the longest strands
    #[arg(long, value_name = "X", default_value_t = 0.1)]
    length: f64,

    /// Share by which the shortest strands are shorter, below 1
    #[arg(long, value_name = "X", default_value_t = 0.2)]
    length_spread: f64,

    /// Segments of each strand
    #[arg(long, value_name = "N", default_value_t = 8)]
    segments: u16,

    /// Width (diameter) at the root
    #[arg(long, value_name = "X", default_value_t = 1e-3)]
    width_root: f64,

    /// Width at the tip [default: that at the root]
    #[arg(long, value_name = "X")]
    width_tip: Option<f64>,

    /// Direction in which the coat lies: x,y,z, the same everywhere; from:x,y,z, away from a point; parting:x,y,z:x,y,z, away
    /// from a line between two points; around:x,y,z, around an axis through the origin; u or v, where a texture coordinate grows
    #[arg(long, value_name = "FLOW", default_value = "0,-1,0", value_parser = parse_flow)]
    flow: Flow,

    /// Angle between normal and strand at the root, towards the flow, in degrees
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0)]
    lean: f64,

    /// What is added to a strand's direction, of length 1, from root to tip
    #[arg(long, value_name = "x,y,z", default_value = "0,0,0", value_parser = parse_vector)]
    gravity: Vec3<f64>,

    /// As gravity, in a direction of each strand's own that turns along it
    #[arg(long, value_name = "X", default_value_t = 0.0)]
    noise: f64,

    /// How far tips are drawn to the middle of their clump, up to 1
    #[arg(long, value_name = "X", default_value_t = 0.0)]
    clump: f64,

    /// Strands in a clump, on average
    #[arg(long, value_name = "N", default_value_t = 40)]
    clump_size: u32,

    /// Radius of curls
    #[arg(long, value_name = "X", default_value_t = 0.0)]
    curl: f64,

    /// Windings of curls from root to tip
    #[arg(long, value_name = "X", default_value_t = 3.0)]
    curl_turns: f64,

    /// Most distance from the body, of which each strand keeps its own share
    #[arg(long, value_name = "X", default_value_t = 0.0)]
    clearance: f64,

    /// Seed of all that is random
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,

    /// Print nothing but errors [default: off]
    #[arg(long)]
    pub(crate) quiet: bool,

    /// Print one JSON object about the outcome on standard output [default: off]
    #[arg(long)]
    pub(crate) json: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Outcome {
    status: &'static str,
    version: &'static str,
    hair: String,
    strands: usize,
    points: usize,
    bytes: usize,
}

/// Grows, writes, and gives the exit code.
///
/// # Errors
/// A mesh that cannot be read or grown on, parameters out of range, a file that cannot be written.
pub(crate) fn run(args: &GroomArgs) -> Result<u8, Failure> {
    let style = style(args);
    let output = args.output.clone().unwrap_or_else(|| {
        PathBuf::from(args.mesh.file_stem().unwrap_or(OsStr::new("groom"))).with_extension("hair")
    });
    paths::check_writable(&output)?;
    let in_mesh = |e: &dyn std::fmt::Display| Failure::input(format!("{}: {e}", args.mesh.display()));
    let mesh = read_mesh(&args.mesh, args)?;
    let body = args.body.iter().map(|path| read_mesh(path, args)).collect::<Result<Vec<_>, _>>()?;
    let body: Vec<_> = body.iter().map(surface).collect();
    let groom = grow(&surface(&mesh), &body, &style).map_err(|e| in_mesh(&e))?;
    let bytes = hair_bytes(groom.strands())
        .ok_or_else(|| in_mesh(&"the strands do not fit into a .hair file; lower density or segments"))?;
    paths::write_whole(&output, &bytes)?;
    let outcome = Outcome {
        status: "done",
        version: env!("CARGO_PKG_VERSION"),
        hair: output.display().to_string(),
        strands: groom.strands().len(),
        points: groom.points.len(),
        bytes: bytes.len(),
    };
    report(args, &outcome)
}

fn surface(mesh: &ObjMesh) -> Surface<'_> {
    Surface { p: &mesh.p, n: &mesh.n, uv: &mesh.uv, triangles: &mesh.triangles }
}

/// A mesh: OBJ where the file's name ends so, else PLY.
fn read_mesh(path: &Path, args: &GroomArgs) -> Result<ObjMesh, Failure> {
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("obj")) {
        return obj::read(path).map_err(|e| Failure::input(e.to_string()));
    }
    let mesh = ply::read(path).map_err(|e| Failure::input(e.to_string()))?;
    for note in mesh.notes.iter().filter(|_| !args.quiet) {
        console::log(format!("{}: {note}", path.display()));
    }
    let mut triangles = mesh.triangles;
    triangles.extend(mesh.quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]));
    Ok(ObjMesh { p: mesh.p, n: mesh.n, uv: mesh.uv, triangles })
}

fn report(args: &GroomArgs, outcome: &Outcome) -> Result<u8, Failure> {
    if args.json {
        let text = serde_json::to_string(outcome)
            .map_err(|e| Failure::input(format!("the result is no JSON: {e}; please report this")))?;
        console::print(text)?;
    } else if !args.quiet {
        let Outcome { hair, strands, points, bytes, .. } = outcome;
        console::log(format!("wrote {hair}: {strands} strands, {points} points, {bytes} bytes"));
    }
    Ok(DONE)
}

fn style(args: &GroomArgs) -> Style {
    Style {
        count: args.density.map_or(Count::Strands(args.count), Count::PerArea),
        length: args.length,
        length_spread: args.length_spread,
        n_segments: args.segments,
        width: [args.width_root, args.width_tip.unwrap_or(args.width_root)],
        flow: args.flow,
        lean_deg: args.lean,
        gravity: args.gravity,
        noise: args.noise,
        clump: args.clump,
        clump_size: args.clump_size,
        curl: args.curl,
        curl_turns: args.curl_turns,
        clearance: args.clearance,
        seed: args.seed,
    }
}

fn parse_output(path: PathBuf) -> Result<PathBuf, String> {
    match path.extension() {
        Some(e) if e.eq_ignore_ascii_case("hair") => Ok(path),
        None if path.file_name().is_some() => Ok(Path::new(&path).with_extension("hair")),
        _ => Err("strands are written as .hair; end the name in it".to_owned()),
    }
}

fn parse_vector(s: &str) -> Result<Vec3<f64>, String> {
    const FORM: &str = "give three numbers x,y,z";
    let numbers: Result<Vec<f64>, _> = s.split(',').map(|v| v.trim().parse()).collect();
    match numbers.map_err(|_| FORM)?.as_slice() {
        &[x, y, z] if [x, y, z].iter().all(|v| v.is_finite()) => Ok(vec3(x, y, z)),
        _ => Err(FORM.to_owned()),
    }
}

fn parse_flow(s: &str) -> Result<Flow, String> {
    match s.split_once(':') {
        None if s == "u" => Ok(Flow::U),
        None if s == "v" => Ok(Flow::V),
        None => parse_vector(s).map(Flow::Along),
        Some(("from", p)) => parse_vector(p).map(Flow::From),
        Some(("around", axis)) => parse_vector(axis).map(Flow::Around),
        Some(("parting", line)) => match line.split_once(':') {
            Some((a, b)) => Ok(Flow::Parting([parse_vector(a)?, parse_vector(b)?])),
            None => Err("give the two ends of the parting, parting:x,y,z:x,y,z".to_owned()),
        },
        Some(_) => Err("give x,y,z, from:x,y,z, parting:x,y,z:x,y,z, around:x,y,z, u or v".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flows_are_read() {
        assert_eq!(parse_flow("1, 0,-2"), Ok(Flow::Along(vec3(1.0, 0.0, -2.0))));
        assert_eq!(parse_flow("from:0,1,0"), Ok(Flow::From(vec3(0.0, 1.0, 0.0))));
        assert_eq!(parse_flow("around:0,1,0"), Ok(Flow::Around(vec3(0.0, 1.0, 0.0))));
        let line = [vec3(0.0, 1.0, 2.0), vec3(0.0, 1.0, -1.0)];
        assert_eq!(parse_flow("parting:0,1,2:0,1,-1"), Ok(Flow::Parting(line)));
        assert_eq!((parse_flow("u"), parse_flow("v")), (Ok(Flow::U), Ok(Flow::V)));
        for bad in ["", "w", "1,2", "1,2,3,4", "nan,0,0", "to:1,0,0", "from:u", "parting:0,1,2"] {
            assert!(parse_flow(bad).is_err(), "{bad}");
        }
    }
}

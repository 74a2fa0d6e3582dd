//! Embree 4 as a tracer, found when the program runs.
//!
//! Only what the race needs of its interface, declared by hand; sizes and numbers are those of the default build.

#![allow(unsafe_code, reason = "a C library is called")]

use std::ffi::{CString, c_char, c_void};
use std::path::Path;
use std::ptr::null;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicI64, Ordering::Relaxed};

use libloading::{Library, Symbol};
use sparrow_geometry::{Ray, TriangleMesh};

use crate::race::{MISS, Tracer, cpu_seconds};

type Object = *mut c_void;

#[repr(C, align(16))]
#[derive(Clone, Copy)]
struct RtcRay {
    o: [f32; 3],
    near: f32,
    d: [f32; 3],
    time: f32,
    far: f32,
    mask: u32,
    id: u32,
    flags: u32,
}

#[repr(C, align(16))]
#[derive(Clone, Copy)]
struct RtcHit {
    ng: [f32; 3],
    u: f32,
    v: f32,
    prim: u32,
    geom: u32,
    instance: [u32; 2],
}

#[repr(C, align(16))]
#[derive(Clone, Copy)]
struct RtcRayHit {
    ray: RtcRay,
    hit: RtcHit,
}

impl RtcRayHit {
    fn new(ray: &Ray) -> RtcRayHit {
        let (o, d) = (ray.o.to_array(), ray.d.to_array());
        RtcRayHit {
            ray: RtcRay { o, near: 0.0, d, time: 0.0, far: ray.t_max, mask: !0, id: 0, flags: 0 },
            hit: RtcHit { ng: [0.0; 3], u: 0.0, v: 0.0, prim: !0, geom: !0, instance: [!0; 2] },
        }
    }
}

static LIBRARY: OnceLock<Library> = OnceLock::new();

/// Bytes that Embree holds.
static HELD: AtomicI64 = AtomicI64::new(0);

extern "C" fn count(_: *mut c_void, bytes: isize, _: bool) -> bool {
    HELD.fetch_add(bytes as i64, Relaxed);
    true
}

const TRIANGLES: i32 = 0;
const INDEX_BUFFER: i32 = 0;
const VERTEX_BUFFER: i32 = 1;
const UINT3: i32 = 0x5003;
const FLOAT3: i32 = 0x9003;

/// How a scene is built.
struct Setting {
    name: &'static str,
    config: &'static str,
    /// 1 medium, 2 high.
    quality: i32,
    /// 4 robust.
    flags: i32,
}

const SETTINGS: [Setting; 5] = [
    Setting { name: "embree", config: "", quality: 1, flags: 0 },
    Setting { name: "embree avx2", config: "isa=avx2", quality: 1, flags: 0 },
    Setting { name: "embree sse4.2", config: "isa=sse4.2", quality: 1, flags: 0 },
    Setting { name: "embree robust", config: "", quality: 1, flags: 4 },
    Setting { name: "embree high", config: "", quality: 2, flags: 0 },
];

/// A scene of Embree.
pub(crate) struct Embree {
    name: &'static str,
    device: Object,
    scene: Object,
    library: &'static Library,
    /// Embree reads these, the last vertex with four bytes behind it.
    _shared: (Vec<f32>, Vec<u32>),
}

impl Drop for Embree {
    fn drop(&mut self) {
        // SAFETY: both were made by this library and are released once.
        unsafe {
            let release: Symbol<extern "C" fn(Object)> = self.library.get(b"rtcReleaseScene").unwrap();
            release(self.scene);
            let release: Symbol<extern "C" fn(Object)> = self.library.get(b"rtcReleaseDevice").unwrap();
            release(self.device);
        }
    }
}

/// The library; nothing where no folder is named.
fn library() -> Option<&'static Library> {
    let Ok(dir) = std::env::var("EMBREE_LIB_DIR") else {
        println!("  EMBREE_LIB_DIR is not set: Sparrow runs alone");
        return None;
    };
    let path = Path::new(&dir).join("libembree4.so");
    // SAFETY: loading Embree runs nothing but the constructors of its own statics. It is never unloaded: its threads may outlive us.
    Some(LIBRARY.get_or_init(|| unsafe { Library::new(path) }.unwrap()))
}

/// The mesh, built with the first `settings` of the list.
#[allow(dead_code, reason = "the benchmark of curves has no meshes")]
pub(crate) fn all(mesh: &TriangleMesh, settings: usize) -> Vec<Embree> {
    let Some(library) = library() else { return Vec::new() };
    SETTINGS.iter().take(settings).map(|s| Embree::new(library, mesh, s)).collect()
}

/// Looks up a function by its name in Embree and its type.
macro_rules! function {
    ($library:expr, $name:ident, ($($arg:ty),*) $(-> $result:ty)?) => {{
        let f: Symbol<extern "C" fn($($arg),*) $(-> $result)?> =
            $library.get(stringify!($name).as_bytes()).unwrap();
        f
    }};
}

impl Embree {
    fn new(library: &'static Library, mesh: &TriangleMesh, s: &Setting) -> Embree {
        let mut p: Vec<f32> = mesh.p.iter().flatten().copied().collect();
        p.push(0.0);
        let indices: Vec<u32> = mesh.indices.iter().flatten().copied().collect();
        let config = CString::new(format!("threads=1,{}", s.config)).unwrap();
        // SAFETY: types and order of arguments are those of Embree 4's header; the buffers live as long as the scene.
        unsafe {
            let device = function!(library, rtcNewDevice, (*const c_char) -> Object)(config.as_ptr());
            let monitor = function!(
                library,
                rtcSetDeviceMemoryMonitorFunction,
                (Object, extern "C" fn(*mut c_void, isize, bool) -> bool, *mut c_void)
            );
            monitor(device, count, std::ptr::null_mut());
            let scene = function!(library, rtcNewScene, (Object) -> Object)(device);
            function!(library, rtcSetSceneBuildQuality, (Object, i32))(scene, s.quality);
            function!(library, rtcSetSceneFlags, (Object, i32))(scene, s.flags);
            let geometry = function!(library, rtcNewGeometry, (Object, i32) -> Object)(device, TRIANGLES);
            function!(library, rtcSetGeometryBuildQuality, (Object, i32))(geometry, s.quality);
            let share = function!(
                library,
                rtcSetSharedGeometryBuffer,
                (Object, i32, u32, i32, *const c_void, usize, usize, usize)
            );
            share(geometry, VERTEX_BUFFER, 0, FLOAT3, p.as_ptr().cast(), 0, 12, mesh.p.len());
            share(geometry, INDEX_BUFFER, 0, UINT3, indices.as_ptr().cast(), 0, 12, mesh.indices.len());
            function!(library, rtcCommitGeometry, (Object))(geometry);
            function!(library, rtcAttachGeometry, (Object, Object) -> u32)(scene, geometry);
            function!(library, rtcReleaseGeometry, (Object))(geometry);
            let (start, held) = (cpu_seconds(), HELD.load(Relaxed));
            function!(library, rtcCommitScene, (Object))(scene);
            let (seconds, bytes) = (cpu_seconds() - start, HELD.load(Relaxed) - held);
            assert_eq!(
                function!(library, rtcGetDeviceError, (Object) -> i32)(device),
                0,
                "Embree refused the scene"
            );
            println!("  {} built in {seconds:.3} s: {:.1} MB without the mesh", s.name, 1e-6 * bytes as f64);
            Embree { name: s.name, device, scene, library, _shared: (p, indices) }
        }
    }
}

impl Tracer for Embree {
    fn name(&self) -> &str {
        self.name
    }
    fn closest(&self, rays: &[Ray], out: &mut [(f32, u32)]) {
        // SAFETY: as in `new`.
        let intersect =
            unsafe { function!(self.library, rtcIntersect1, (Object, *mut RtcRayHit, *const c_void)) };
        for (ray, out) in rays.iter().zip(out) {
            let mut r = RtcRayHit::new(ray);
            intersect(self.scene, &raw mut r, null());
            *out = if r.hit.geom == !0 { MISS } else { (r.ray.far, r.hit.prim) };
        }
    }
    fn occluded(&self, rays: &[Ray], out: &mut [bool]) {
        // SAFETY: as in `new`.
        let occluded = unsafe { function!(self.library, rtcOccluded1, (Object, *mut RtcRay, *const c_void)) };
        for (ray, out) in rays.iter().zip(out) {
            let mut r = RtcRayHit::new(ray).ray;
            occluded(self.scene, &raw mut r, null());
            *out = r.far < 0.0;
        }
    }
}

const ROUND_B_SPLINE: i32 = 32;
const FLAT_B_SPLINE: i32 = 33;
const UINT: i32 = 0x5001;
const FLOAT4: i32 = 0x9004;

/// B-spline strands, round or flat, each given by the first control point of its segments.
#[allow(dead_code, reason = "the benchmark of triangles has no curves")]
pub(crate) fn curves(points: &[[f32; 4]], segments: &[u32], round: bool, settings: usize) -> Vec<Embree> {
    let Some(library) = library() else { return Vec::new() };
    let kind = if round { ROUND_B_SPLINE } else { FLAT_B_SPLINE };
    SETTINGS.iter().take(settings).map(|s| Embree::of_curves(library, points, segments, kind, s)).collect()
}

impl Embree {
    fn of_curves(
        library: &'static Library,
        points: &[[f32; 4]],
        segments: &[u32],
        kind: i32,
        s: &Setting,
    ) -> Embree {
        let (p, indices) = (points.iter().flatten().copied().collect::<Vec<f32>>(), segments.to_vec());
        let config = CString::new(format!("threads=1,{}", s.config)).unwrap();
        // SAFETY: types and order of arguments are those of Embree 4's header; the buffers live as long as the scene.
        unsafe {
            let device = function!(library, rtcNewDevice, (*const c_char) -> Object)(config.as_ptr());
            let monitor = function!(
                library,
                rtcSetDeviceMemoryMonitorFunction,
                (Object, extern "C" fn(*mut c_void, isize, bool) -> bool, *mut c_void)
            );
            monitor(device, count, std::ptr::null_mut());
            let scene = function!(library, rtcNewScene, (Object) -> Object)(device);
            function!(library, rtcSetSceneBuildQuality, (Object, i32))(scene, s.quality);
            function!(library, rtcSetSceneFlags, (Object, i32))(scene, s.flags);
            let geometry = function!(library, rtcNewGeometry, (Object, i32) -> Object)(device, kind);
            let share = function!(
                library,
                rtcSetSharedGeometryBuffer,
                (Object, i32, u32, i32, *const c_void, usize, usize, usize)
            );
            share(geometry, VERTEX_BUFFER, 0, FLOAT4, p.as_ptr().cast(), 0, 16, points.len());
            share(geometry, INDEX_BUFFER, 0, UINT, indices.as_ptr().cast(), 0, 4, segments.len());
            function!(library, rtcCommitGeometry, (Object))(geometry);
            function!(library, rtcAttachGeometry, (Object, Object) -> u32)(scene, geometry);
            function!(library, rtcReleaseGeometry, (Object))(geometry);
            let (start, held) = (cpu_seconds(), HELD.load(Relaxed));
            function!(library, rtcCommitScene, (Object))(scene);
            let (seconds, bytes) = (cpu_seconds() - start, HELD.load(Relaxed) - held);
            assert_eq!(
                function!(library, rtcGetDeviceError, (Object) -> i32)(device),
                0,
                "Embree refused the scene"
            );
            println!("  {} built in {seconds:.3} s: {:.1} MB without points", s.name, 1e-6 * bytes as f64);
            Embree { name: s.name, device, scene, library, _shared: (p, indices) }
        }
    }
}

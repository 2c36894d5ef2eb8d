//! Surfaces a network in T. Stanko's format (.net) and writes the mesh as OBJ. No crates:
//!
//!     rustc -O surface_net.rs -L DIR_OF_LIBRARY -l static=wireskin -l m
//!     ./surface_net ../data/sphere.net sphere.obj

use std::ffi::{c_char, c_void, CStr};
use std::fmt::Write;

/// wsk_curve of src/wireskin.h.
#[repr(C)]
struct Curve {
    sample_count: usize,
    positions: *const f64,
    position_stride: usize,
    normals: *const f64,
    normal_stride: usize,
    nodes: *const u32,
    closed: i32,
    boundary: i32,
    soft: f64,
    sharp: i32,
    normals_right: *const f64,
    normal_right_stride: usize,
}

/// wsk_surface_view, as far as it is used here: the library writes no more than it is told to.
#[repr(C)]
struct View {
    size: usize,
    vertex_count: u32,
    triangle_count: u32,
    patch_count: u32,
    curve_edge_count: u32,
    positions: *const f64,
    normals: *const f64,
    mean_curvature: *const f64,
    gaussian_curvature: *const f64,
    vertex_curve: *const u32,
    constraint_normals: *const f64,
    triangles: *const u32,
    triangle_patch: *const u32,
    curve_edges: *const u32,
    curve_edge_curve: *const u32,
}

extern "C" {
    fn wsk_build(
        curves: *const Curve,
        count: usize,
        options: *const c_void,
        surface: *mut *mut c_void,
        report: *mut c_void,
    ) -> i32;
    fn wsk_status_name(status: i32) -> *const c_char;
    fn wsk_surface_get_view(surface: *const c_void, view: *mut View, size: usize);
    fn wsk_surface_free(surface: *mut c_void);
}

#[derive(Default)]
struct Samples {
    positions: Vec<f64>,
    normals: Vec<f64>,
    nodes: Vec<u32>,
    closed: bool,
    boundary: bool,
}

/// The network, or None if the text is not in the format.
fn read_net(text: &str) -> Option<Vec<Samples>> {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let vertex_count: usize = lines.next()?.trim().parse().ok()?;
    let mut vertices: Vec<Vec<f64>> = Vec::new();
    for _ in 0..vertex_count {
        let row = lines.next()?.split_whitespace().map(|word| word.parse().ok());
        vertices.push(row.collect::<Option<_>>()?);
    }
    let curve_count: usize = lines.next()?.trim().parse().ok()?;
    let mut curves = Vec::new();
    for _ in 0..curve_count {
        let mut curve = Samples { boundary: lines.next()?.trim() == "1", ..Default::default() };
        let indices = lines.next()?.split_whitespace().map(|word| word.parse().ok());
        curve.nodes = indices.collect::<Option<_>>()?;
        curve.closed = curve.nodes.first() == curve.nodes.last();
        if curve.closed {
            curve.nodes.pop();
        }
        for &node in &curve.nodes {
            let row = vertices.get(node as usize)?;
            curve.positions.extend_from_slice(row.get(0..3)?);
            curve.normals.extend_from_slice(row.get(3..6)?);
        }
        curves.push(curve);
    }
    Some(curves)
}

/// Positions and triangles, or the name of what is wrong.
fn build(network: &[Samples]) -> Result<(Vec<f64>, Vec<u32>), String> {
    let curves: Vec<Curve> = network
        .iter()
        .map(|samples| Curve {
            sample_count: samples.nodes.len(),
            positions: samples.positions.as_ptr(),
            position_stride: 0,
            normals: samples.normals.as_ptr(),
            normal_stride: 0,
            nodes: samples.nodes.as_ptr(),
            closed: samples.closed as i32,
            boundary: samples.boundary as i32,
            soft: 0.0,
            sharp: 0,
            normals_right: std::ptr::null(),
            normal_right_stride: 0,
        })
        .collect();
    let null = std::ptr::null_mut::<c_void>();
    let mut surface = null;
    // The curves point into `network`, which outlives the call; the view's arrays are copied before
    // the surface is freed.
    unsafe {
        let status = wsk_build(curves.as_ptr(), curves.len(), null, &mut surface, null);
        if status != 0 {
            return Err(CStr::from_ptr(wsk_status_name(status)).to_string_lossy().into_owned());
        }
        let mut view: View = std::mem::zeroed();
        wsk_surface_get_view(surface, &mut view, std::mem::size_of::<View>());
        let positions = std::slice::from_raw_parts(view.positions, 3 * view.vertex_count as usize);
        let triangles = std::slice::from_raw_parts(view.triangles, 3 * view.triangle_count as usize);
        let mesh = (positions.to_vec(), triangles.to_vec());
        wsk_surface_free(surface);
        Ok(mesh)
    }
}

fn run() -> Result<(), String> {
    let words: Vec<String> = std::env::args().collect();
    if words.len() != 3 {
        return Err("usage: surface_net INPUT.net OUTPUT.obj".into());
    }
    let text = std::fs::read_to_string(&words[1]).map_err(|error| error.to_string())?;
    let network = read_net(&text).ok_or("the input is not in the format .net")?;
    let (positions, triangles) = build(&network)?;
    let mut obj = String::new();
    for p in positions.chunks(3) {
        let _ = writeln!(obj, "v {} {} {}", p[0], p[1], p[2]);
    }
    for t in triangles.chunks(3) {
        let _ = writeln!(obj, "f {} {} {}", t[0] + 1, t[1] + 1, t[2] + 1);
    }
    std::fs::write(&words[2], obj).map_err(|error| error.to_string())?;
    println!("{} vertices, {} triangles", positions.len() / 3, triangles.len() / 3);
    Ok(())
}

fn main() {
    if let Err(sentence) = run() {
        eprintln!("surface_net: {sentence}");
        std::process::exit(1);
    }
}

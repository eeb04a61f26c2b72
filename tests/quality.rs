//! Heavy measurements (`make quality`): time and memory of whole processes and of loading, on a model of 1.1 million
//! triangles that is made here. Limits are twice the goals, because machines are noisy; what counts is printed.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the numbers are what it is for")]

mod common;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use common::median;
use hachure::document::ViewSettings;
use hachure::export::session::topology;
use hachure::geometry::stripes::StripeVertex;
use hachure::geometry::{DirectionField, FieldOptions, Mesh, StripeField, primitives};
use hachure::import::{ImportOptions, Progress, load};

/// A GLB with positions and 32-bit indices only.
fn glb(mesh: &Mesh) -> Vec<u8> {
    let positions: &[u8] = bytemuck::cast_slice(&mesh.positions);
    let indices: &[u8] = bytemuck::cast_slice(&mesh.indices);
    let bounds = mesh.bounds();
    let json = serde_json::json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "name": "ball" }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": mesh.positions.len(), "type": "VEC3",
              "min": bounds.min.to_array(), "max": bounds.max.to_array() },
            { "bufferView": 1, "componentType": 5125, "count": mesh.indices.len(), "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": positions.len() },
            { "buffer": 0, "byteOffset": positions.len(), "byteLength": indices.len() },
        ],
        "buffers": [{ "byteLength": positions.len() + indices.len() }],
    });
    let mut json = serde_json::to_vec(&json).unwrap();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut file = Vec::new();
    let word = |n: usize| u32::try_from(n).unwrap().to_le_bytes();
    file.extend(b"glTF");
    file.extend(word(2));
    file.extend(word(28 + json.len() + positions.len() + indices.len()));
    file.extend(word(json.len()));
    file.extend(b"JSON");
    file.extend(&json);
    file.extend(word(positions.len() + indices.len()));
    file.extend(b"BIN\0");
    file.extend(positions);
    file.extend(indices);
    file
}

/// A wrinkled ball of about that many triangles.
fn ball(triangles: u32) -> Mesh {
    let rings = (f64::from(triangles) / 2.0).sqrt() as u32;
    let mut mesh = primitives::sphere(1.0, rings, rings);
    for p in &mut mesh.positions {
        let (t, u) = (p.y.clamp(-1.0, 1.0).acos(), p.z.atan2(p.x));
        *p *= 1.0 + 0.05 * (9.0 * t).sin() * (11.0 * u).cos();
    }
    mesh
}

/// Seconds and peak resident megabytes of one whole process.
fn run(model: &Path, output: &Path) -> (f64, f64) {
    let began = Instant::now();
    let mut child = Command::new(env!("CARGO_BIN_EXE_hachure"))
        .args(["render", "--resolution", "800,800", "--samples", "1", "-o"])
        .arg(output)
        .arg(model)
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut peak = 0.0_f64;
    loop {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        if let Some(line) = text.lines().find_map(|l| l.strip_prefix("VmHWM:")) {
            peak = peak.max(line.trim().trim_end_matches(" kB").parse::<f64>().unwrap() / 1024.0);
        }
        if let Some(ended) = child.try_wait().unwrap() {
            assert!(ended.success());
            return (began.elapsed().as_secs_f64(), peak);
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[test]
#[ignore = "heavy: run by `make quality`"]
fn whole_processes_are_quick_and_small() {
    let folder = tempfile::tempdir().unwrap();
    let large = folder.path().join("ball.glb");
    std::fs::write(&large, glb(&ball(1_100_000))).unwrap();
    let crank: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/models/crank.glb");
    let output = folder.path().join("out.png");
    println!("start to PNG, 800 × 800, Gooch with edges, median of 7:");
    for (name, model, seconds, megabytes) in
        [("crank", &crank, 0.25, 450.0), ("1.1 million triangles", &large, 0.6, 450.0)]
    {
        run(model, &output);
        let runs: Vec<_> = (0..7).map(|_| run(model, &output)).collect();
        let time = median(runs.iter().map(|r| r.0).collect());
        let memory = median(runs.iter().map(|r| r.1).collect());
        println!("  {name:<24}{time:>6.2} s (goal {seconds}){memory:>7.0} MB (goal {megabytes})");
        assert!(time <= 2.0 * seconds && memory <= megabytes, "{name}");
    }
}

#[test]
#[ignore = "heavy: run by `make quality`"]
fn loading_with_topology_is_quick() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ball.glb");
    std::fs::write(&path, glb(&ball(1_100_000))).unwrap();
    let times = (0..7).map(|_| {
        let began = Instant::now();
        let scene = load(&path, &ImportOptions::default(), &Progress::default()).unwrap();
        let loaded = began.elapsed().as_secs_f64();
        let found = topology(&scene, ViewSettings::default().creases());
        assert!(found[0].is_solid);
        (loaded, began.elapsed().as_secs_f64())
    });
    let (load, all): (Vec<_>, Vec<_>) = times.unzip();
    let (load, all) = (median(load), median(all));
    println!("file of 1.1 million triangles to scene {load:.3} s, with topology {all:.3} s (goal 0.35)");
    assert!(all <= 0.7);
}

#[test]
#[ignore = "heavy: run by `make quality`"]
fn directions_and_stripes_of_hatching_are_found_quickly() {
    let options = FieldOptions::default();
    let field = ball(100_000);
    let times = (0..5).map(|_| {
        let began = Instant::now();
        DirectionField::solve(&field, &options, &|_| true).unwrap();
        began.elapsed().as_secs_f64()
    });
    let time = median(times.collect());
    println!("directions of 100,000 triangles {time:.2} s (goal 0.5)");
    assert!(time <= 1.0);
    for (triangles, goal) in [(52_000, 4.0), (1_100_000, 40.0)] {
        let mesh = ball(triangles);
        let began = Instant::now();
        let field = StripeField::solve(&mesh, &options, &|_| true).unwrap();
        let time = began.elapsed().as_secs_f64();
        println!("directions and stripes of {} triangles {time:.2} s (goal {goal})", mesh.triangle_count());
        assert!(time <= 2.0 * goal);
        let bytes = field.vertices.len() * size_of::<StripeVertex>() / mesh.positions.len();
        println!("  {bytes} bytes a vertex (goal 64)");
        assert!(bytes <= 64);
    }
}

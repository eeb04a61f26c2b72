//! Scenes whose visible edges are known without a doubt, and the models that pictures of lines are measured on.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DMat4, DVec3, EulerRot, Vec3};
use hachure::geometry::Mesh;
use hachure::geometry::normals::by_crease_angle;
use hachure::geometry::primitives::{cube, cube_split, from_triangles, plane, sphere, torus};
use hachure::import::{ImportOptions, Progress, load};
use hachure::scene::{AlphaMode, Scene, Texture, TextureRef, UvTransform, Wrap};

use super::at;

/// A scene with a name.
#[derive(Clone)]
pub struct Subject {
    pub name: String,
    pub scene: Arc<Scene>,
}

/// The analytic scenes.
pub fn analytic() -> Vec<Subject> {
    vec![
        one("box", cube(2.0)),
        one("sphere", sphere(1.0, 48, 96)),
        one("torus", torus(1.0, 0.35, 96, 48)),
        one("stairs", stairs(5)),
        one("open sheet", wave(1.0, 24)),
        one("seam-split", cube_split(2.0)),
        one("T-junctions", patched_box()),
        one("double wall", double_wall()),
        one(
            "crossing parts",
            joined(&[(cube(1.4), DMat4::IDENTITY), (rod(0.25, 3.0, 32), turned(0.5, 0.4, 0.3))]),
        ),
        many("tilted planes", tilted_planes()),
        many("wires", wires()),
        many("nested", nested()),
        many("coplanar", coplanar()),
        many("intersecting", intersecting()),
        many("mirrored", mirrored()),
        perforated(),
    ]
}

/// A closed surface with bumps, of triangles that are coarse for how much it bends.
pub fn pebble() -> Subject {
    let mut mesh = sphere(1.0, 28, 44);
    for p in &mut mesh.positions {
        let bumps = (5.0 * p.x).sin() * (4.0 * p.y + 1.0).cos() + (4.0 * p.z + 2.0 * p.x).sin();
        *p *= 1.0 + 0.12 * bumps;
    }
    one("pebble", by_crease_angle(mesh, 180.0))
}

/// The analytic scene of that name.
pub fn named(name: &str) -> Subject {
    analytic().into_iter().find(|subject| subject.name == name).unwrap()
}

/// The samples, and the models of others as far as they are here.
pub fn models() -> Vec<Subject> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let samples = ["assets/models/crank.glb", "assets/models/ogre.glb"].map(|file| root.join(file));
    let (_, whole): (Vec<_>, Vec<_>) = of_others().into_iter().partition(|file| is_in_patches(file));
    loaded(samples.into_iter().chain(whole))
}

/// Models as a CAD program leaves them: each face a patch with borders of its own. Their exact edges have needles in the cracks
/// that no picture should show: how well they are drawn is told by `tests/seams.rs`.
pub fn models_in_patches() -> Vec<Subject> {
    loaded(of_others().into_iter().filter(|file| is_in_patches(file)))
}

fn is_in_patches(file: &Path) -> bool {
    file.components().any(|part| part.as_os_str() == "repatched")
}

fn of_others() -> Vec<PathBuf> {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/models");
    let index = std::fs::read_to_string(shared.join("INDEX.tsv")).unwrap_or_default();
    if index.is_empty() {
        println!("no shared models here: only the samples are measured");
    }
    index.lines().skip(1).filter_map(|line| Some(shared.join(line.split('\t').next()?))).collect()
}

fn loaded(files: impl Iterator<Item = PathBuf>) -> Vec<Subject> {
    let present = |file: &PathBuf| {
        let is_there = file.exists();
        if !is_there {
            println!("{} is not here: left out", file.display());
        }
        is_there
    };
    files
        .filter(present)
        .map(|file| Subject {
            name: file.file_stem().unwrap().to_string_lossy().into_owned(),
            scene: Arc::new(load(&file, &ImportOptions::default(), &Progress::default()).unwrap()),
        })
        .collect()
}

fn one(name: &str, mesh: Mesh) -> Subject {
    many(name, vec![(mesh, DMat4::IDENTITY)])
}

/// Each mesh an object of its own.
fn many(name: &str, objects: Vec<(Mesh, DMat4)>) -> Subject {
    let names: Vec<String> = (0..objects.len()).map(|i| format!("part {i}")).collect();
    let objects = objects.into_iter().zip(&names);
    let objects = objects.map(|((mesh, place), name)| (name.as_str(), mesh, place, [0.7; 3])).collect();
    Subject { name: name.to_owned(), scene: super::scene(objects) }
}

fn turned(x: f64, y: f64, z: f64) -> DMat4 {
    DMat4::from_euler(EulerRot::XYZ, x, y, z)
}

fn scaled(x: f64, y: f64, z: f64) -> DMat4 {
    DMat4::from_scale(DVec3::new(x, y, z))
}

/// All parts in one mesh.
fn joined(parts: &[(Mesh, DMat4)]) -> Mesh {
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for (mesh, place) in parts {
        let base = positions.len() as u32;
        positions.extend(mesh.positions.iter().map(|p| place.transform_point3(p.as_dvec3()).as_vec3()));
        indices.extend(mesh.indices.iter().map(|i| base + i));
    }
    from_triangles(positions, indices)
}

/// A closed prism: an outline in the XY plane, counter-clockwise, star-shaped about its first corner, along Z.
fn prism(outline: &[[f32; 2]], depth: f32) -> Mesh {
    let n = outline.len() as u32;
    let layer = |z: f32| outline.iter().map(move |&[x, y]| Vec3::new(x, y, z));
    let positions = layer(depth * 0.5).chain(layer(-depth * 0.5)).collect();
    let caps = (1..n - 1).flat_map(|i| [0, i, i + 1, n, n + i + 1, n + i]);
    let sides = (0..n).flat_map(|i| {
        let j = (i + 1) % n;
        [i, n + i, n + j, i, n + j, j]
    });
    from_triangles(positions, caps.chain(sides).collect())
}

/// Along Z.
fn rod(radius: f32, length: f32, sides: u32) -> Mesh {
    let corner = |i: u32| {
        let (sin, cos) = (i as f32 / sides as f32 * std::f32::consts::TAU).sin_cos();
        [radius * cos, radius * sin]
    };
    prism(&(0..sides).map(corner).collect::<Vec<_>>(), length)
}

fn stairs(steps: u32) -> Mesh {
    let size = 2.0 / steps as f32;
    // Seen from the lower right corner, every corner of the steps is in view.
    let mut outline = vec![[1.0, -1.0], [1.0, 1.0]];
    for step in (0..steps).rev() {
        let (x, y) = (-1.0 + step as f32 * size, -1.0 + step as f32 * size);
        outline.extend([[x, y + size], [x, y]]);
    }
    outline.dedup();
    prism(&outline, 1.5)
}

/// An open sheet over a square, with waves of that height.
fn wave(height: f32, cells: u32) -> Mesh {
    let along = |i: u32| 2.0 * i as f32 / cells as f32 - 1.0;
    let positions = (0..=cells)
        .flat_map(|j| (0..=cells).map(move |i| (along(i), along(j))))
        .map(|(x, y)| Vec3::new(x, y, 0.25 * height * ((3.0 * x).sin() + (2.0 * x + 2.5 * y).cos())))
        .collect();
    let corner = |i: u32, j: u32| j * (cells + 1) + i;
    let indices = (0..cells * cells)
        .map(|k| (k % cells, k / cells))
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            [a, b, c, a, c, d]
        })
        .collect();
    from_triangles(positions, indices)
}

/// A box of which each side is divided in another way, so that no vertices meet along the edges.
fn patched_box() -> Mesh {
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for side in 0..6_u32 {
        let (axis, sign) = ((side / 2) as usize, if side % 2 == 0 { 1.0 } else { -1.0 });
        let cells = 1 + side;
        let base = positions.len() as u32;
        for j in 0..=cells {
            for i in 0..=cells {
                let mut p = Vec3::ZERO;
                p[axis] = sign;
                p[(axis + 1) % 3] = 2.0 * i as f32 / cells as f32 - 1.0;
                p[(axis + 2) % 3] = 2.0 * j as f32 / cells as f32 - 1.0;
                positions.push(p);
            }
        }
        for k in 0..cells * cells {
            let a = base + k / cells * (cells + 1) + k % cells;
            let (b, c, d) = (a + 1, a + cells + 2, a + cells + 1);
            indices.extend(if sign > 0.0 { [a, b, c, a, c, d] } else { [a, c, b, a, d, c] });
        }
    }
    from_triangles(positions, indices)
}

/// An open box whose walls are there twice, the second time turned inside out and with the other diagonals.
fn double_wall() -> Mesh {
    let mut outside = cube(2.0);
    outside.indices.truncate(30);
    let mut inside = outside.clone();
    for quad in inside.indices.chunks_exact_mut(6) {
        let [a, b, c, d] = [quad[0], quad[1], quad[2], quad[5]];
        quad.copy_from_slice(&[d, c, b, d, b, a]);
    }
    joined(&[(outside, DMat4::IDENTITY), (inside, DMat4::IDENTITY)])
}

/// Six sheets behind each other, each steeper than the last one; no line may be drawn inside of any.
fn tilted_planes() -> Vec<(Mesh, DMat4)> {
    let sheet = |i: i32| {
        let i = f64::from(i);
        (plane(0.9), at(0.7 * (i - 2.5), 0.25 * i, -0.3 * i) * turned(0.28 * i, 0.2 * i, 0.0))
    };
    (0..6).map(sheet).collect()
}

/// Rods of a few pixels.
fn wires() -> Vec<(Mesh, DMat4)> {
    let wire = |i: i32| {
        let i = f64::from(i);
        (rod(0.012, 2.4, 16), at(0.3 * (i - 2.0), 0.1 * i, 0.2 * (i - 2.0)) * turned(0.5 * i, 0.7 * i, 0.0))
    };
    (0..5).map(wire).chain([(torus(1.2, 0.012, 128, 16), turned(0.6, 0.0, 0.3))]).collect()
}

/// A ball in a ring, and a cube that a closed one hides.
fn nested() -> Vec<(Mesh, DMat4)> {
    vec![
        (sphere(0.6, 48, 96), at(-1.0, 0.0, 0.0)),
        (torus(0.85, 0.15, 96, 32), at(-1.0, 0.0, 0.0) * turned(0.4, 0.0, 0.2)),
        (cube(1.2), at(1.0, 0.0, 0.0)),
        (cube(0.9), at(1.0, 0.0, 0.0)),
    ]
}

/// Boxes that touch: side by side with their tops in one plane, and one upon them.
fn coplanar() -> Vec<(Mesh, DMat4)> {
    vec![(cube(1.0), at(-0.5, 0.0, 0.0)), (cube(1.0), at(0.5, 0.0, 0.0)), (cube(0.5), at(0.25, 0.75, 0.125))]
}

/// A ball and a rod through a plate, a box through a box.
fn intersecting() -> Vec<(Mesh, DMat4)> {
    vec![
        (cube(1.0), scaled(3.0, 0.2, 2.0)),
        // Its equator is not in the plane of the plate: the truth has no crossings along edges.
        (sphere(0.45, 32, 64), at(-0.8, 0.13, 0.2)),
        (rod(0.2, 1.6, 32), at(0.2, 0.2, -0.2) * turned(1.2, 0.2, 0.0)),
        (cube(0.7), at(0.95, 0.2, 0.3) * turned(0.3, 0.5, 0.2)),
    ]
}

/// Stairs and their mirror image.
fn mirrored() -> Vec<(Mesh, DMat4)> {
    vec![
        (stairs(3), at(1.3, 0.0, 0.0) * turned(0.0, 0.3, 0.0)),
        (stairs(3), at(-1.3, 0.0, 0.0) * scaled(-1.0, 1.0, 1.0) * turned(0.0, 0.3, 0.0)),
    ]
}

/// A sheet with round holes before a box and a ball.
fn perforated() -> Subject {
    const SIDE: u32 = 256;
    let parts = vec![
        (plane(2.4), at(0.0, 0.0, 0.9)),
        (cube(0.9), at(-0.5, 0.1, -0.1) * turned(0.3, 0.6, 0.0)),
        (sphere(0.5, 32, 64), at(0.55, -0.2, -0.1)),
    ];
    let mut subject = many("perforated", parts);
    let scene = Arc::make_mut(&mut subject.scene);
    let alpha = |i: u32| {
        let from_hole = |c: u32| f64::from(c % 64) - 31.5;
        let distance = from_hole(i % SIDE).hypot(from_hole(i / SIDE));
        ((distance - 22.0) * 60.0 + 128.0).clamp(0.0, 255.0) as u8
    };
    let rgba = (0..SIDE * SIDE).flat_map(|i| [255, 255, 255, alpha(i)]).collect();
    scene.textures.push(Arc::new(Texture { name: "holes".to_owned(), width: SIDE, height: SIDE, rgba }));
    scene.materials[0].alpha = AlphaMode::Mask(0.5);
    scene.materials[0].base_color_texture = Some(TextureRef {
        texture: 0,
        transform: UvTransform::default(),
        wrap: [Wrap::Clamp; 2],
        nearest: false,
    });
    subject
}

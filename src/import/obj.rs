//! OBJ with MTL: objects and groups become nodes.
//!
//! A reader of our own: lines that make no sense are counted and skipped, and every message names a line.

mod materials;
mod mtl;
mod parse;

use std::path::Path;

use glam::{Vec2, Vec3};

use super::assemble::{Assembly, Branch};
use super::text::linear;
use super::{ImportError, ImportOptions, Progress};
use crate::geometry::{Mesh, MeshPart, Triangulator};
use crate::scene::Scene;
use parse::{Group, NONE, Parsed};

/// Makes a scene of an OBJ file. Faces before the first `o` or `g` are in a node `mesh`; groups inside an object hang
/// below it. An object that gives every corner a normal keeps them; else they come from the crease angle.
///
/// # Errors
/// `Empty` when no triangle can be drawn, `Malformed` when no line makes sense, `Cancelled`.
pub(super) fn load(
    path: &Path,
    data: &[u8],
    options: &ImportOptions,
    progress: &Progress,
) -> Result<Scene, ImportError> {
    let mut assembly = Assembly::new(path, options, progress);
    let parsed = parse::parse(data, progress)?;
    if parsed.positions.is_empty() && parsed.groups.is_empty() && parsed.bad_lines.count() > 0 {
        return Err(assembly.malformed("this is no OBJ file: it has neither vertices nor faces"));
    }
    warn(&parsed, &mut assembly);
    let material_of = materials::load(path, &parsed, &mut assembly, progress)?;

    let mut mesher = Mesher::new(&parsed, material_of);
    let mut branches: Vec<Branch> = Vec::new();
    for group in &parsed.groups {
        progress.check()?;
        hang(&mut branches, group, mesher.mesh(group));
    }
    for (count, what) in [(mesher.bad_uvs, "texture coordinates"), (mesher.bad_normals, "normals")] {
        if count > 0 {
            assembly.warn("", format!("ignored {count} references to {what} that do not exist"));
        }
    }
    progress.report(0.5);
    let reason = if parsed.points_and_lines.count() > 0 {
        "it holds only points and lines; Hachure draws surfaces"
    } else if parsed.free_form.count() > 0 {
        "it holds only free-form surfaces; export it as polygons"
    } else {
        "it holds no faces"
    };
    assembly.finish(branches, reason)
}

fn warn(parsed: &Parsed, assembly: &mut Assembly<'_>) {
    for (fault, message) in [
        (&parsed.bad_lines, "cannot be understood and is skipped"),
        (&parsed.short_faces, "a face has fewer than three corners"),
        (&parsed.points_and_lines, "points and lines are not drawn"),
        (&parsed.free_form, "free-form curves and surfaces are not drawn; export them as polygons"),
    ] {
        if let Some(place) = fault.place() {
            assembly.warn(&place, message);
        }
    }
}

/// Puts the mesh of a group where it belongs: below the root, or below its object.
fn hang(branches: &mut Vec<Branch>, group: &Group, mesh: Mesh) {
    let named = |name: &str| Branch {
        name: if name.is_empty() { "mesh".into() } else { name.to_owned() },
        ..Branch::default()
    };
    if group.object.is_empty() || group.group.is_empty() || group.group == group.object {
        let name = if group.object.is_empty() { &group.group } else { &group.object };
        // An object's node may exist already, for one of its groups.
        let open =
            branches.last_mut().filter(|b| !group.object.is_empty() && b.name == *name && b.mesh.is_none());
        match open {
            Some(branch) => branch.mesh = Some(mesh),
            None => branches.push(Branch { mesh: Some(mesh), ..named(name) }),
        }
        return;
    }
    if branches.last().is_none_or(|b| b.name != group.object) {
        branches.push(named(&group.object));
    }
    if let Some(object) = branches.last_mut() {
        object.children.push(Branch { mesh: Some(mesh), ..named(&group.group) });
    }
}

/// A vertex of the group in work: its texture coordinates and normal, its index, and the next vertex at the same
/// position.
struct Variant {
    uv: u32,
    normal: u32,
    vertex: u32,
    next: u32,
}

/// Makes indexed meshes of groups of faces.
struct Mesher<'a> {
    parsed: &'a Parsed,
    /// Material in the scene for each name in the file, and for none at the end.
    material_of: Vec<usize>,
    /// Divisor of vertex colours: 255 when one of them exceeds 1.
    color_range: f32,
    /// First entry of `variants` for each position of the file.
    first_variant: Vec<u32>,
    variants: Vec<Variant>,
    triangulator: Triangulator,
    bad_uvs: usize,
    bad_normals: usize,
}

impl<'a> Mesher<'a> {
    fn new(parsed: &'a Parsed, material_of: Vec<usize>) -> Self {
        let bright = parsed.colors.iter().any(|c| c.max_element() > 1.0);
        Self {
            parsed,
            material_of,
            color_range: if bright { 255.0 } else { 1.0 },
            first_variant: vec![NONE; parsed.positions.len()],
            variants: Vec::new(),
            triangulator: Triangulator::default(),
            bad_uvs: 0,
            bad_normals: 0,
        }
    }

    fn mesh(&mut self, group: &Group) -> Mesh {
        let corners = || group.runs.iter().flat_map(|run| &run.corners);
        let (uv_count, normal_count) = (self.parsed.uvs.len(), self.parsed.normals.len());
        let bad = |index: u32, count: usize| index != NONE && index as usize >= count;
        self.bad_uvs += corners().filter(|c| bad(c[1], uv_count)).count();
        self.bad_normals += corners().filter(|c| bad(c[2], normal_count)).count();
        let has_uvs = corners().any(|c| (c[1] as usize) < uv_count);
        let has_normals = corners().all(|c| (c[2] as usize) < normal_count);

        let mut mesh = Mesh::default();
        let mut points = Vec::new();
        let mut vertices = Vec::new();
        for run in &group.runs {
            let first_index = mesh.indices.len() as u32;
            let mut start = 0;
            for &end in &run.ends {
                let face = run.corners.get(start..end).unwrap_or_default();
                start = end;
                points.clear();
                vertices.clear();
                for &[position, uv, normal] in face {
                    let uv = if has_uvs { uv } else { NONE };
                    let normal = if has_normals { normal } else { NONE };
                    vertices.push(self.vertex([position, uv, normal], &mut mesh));
                    let point = self.parsed.positions.get(position as usize);
                    points.push(point.copied().unwrap_or(Vec3::NAN));
                }
                self.triangulator.cut(&points, |triangle| {
                    for corner in triangle {
                        let vertex = vertices.get(corner as usize);
                        mesh.indices.push(vertex.copied().unwrap_or(NONE));
                    }
                });
            }
            let material = run.material.and_then(|m| self.material_of.get(m));
            mesh.parts.push(MeshPart {
                first_index,
                index_count: mesh.indices.len() as u32 - first_index,
                material: material.or(self.material_of.last()).copied().unwrap_or(0),
            });
        }
        self.attributes(&mut mesh, has_uvs, has_normals);
        self.variants.clear();
        for &[position, ..] in corners() {
            if let Some(first) = self.first_variant.get_mut(position as usize) {
                *first = NONE;
            }
        }
        mesh
    }

    /// The vertex for this combination, made at its first use; [`NONE`] if the position does not exist.
    fn vertex(&mut self, [position, uv, normal]: [u32; 3], mesh: &mut Mesh) -> u32 {
        let Some(&at) = self.parsed.positions.get(position as usize) else {
            return NONE;
        };
        let Some(&first) = self.first_variant.get(position as usize) else {
            return NONE;
        };
        let mut link = first;
        while let Some(variant) = self.variants.get(link as usize) {
            if variant.uv == uv && variant.normal == normal {
                return variant.vertex;
            }
            link = variant.next;
        }
        let vertex = mesh.positions.len() as u32;
        mesh.positions.push(at);
        if !self.parsed.colors.is_empty() {
            mesh.colors.push(self.color(position as usize));
        }
        if let Some(head) = self.first_variant.get_mut(position as usize) {
            *head = self.variants.len() as u32;
        }
        self.variants.push(Variant { uv, normal, vertex, next: first });
        vertex
    }

    fn color(&self, position: usize) -> [u8; 4] {
        let color = self.parsed.colors.get(position).copied();
        let byte = |c: f32| (linear(c / self.color_range) * 255.0).round() as u8;
        color.map_or([255; 4], |c| [byte(c.x), byte(c.y), byte(c.z), 255])
    }

    /// Texture coordinates and normals of the vertices, which are in the order of the variants.
    fn attributes(&self, mesh: &mut Mesh, has_uvs: bool, has_normals: bool) {
        if has_uvs {
            mesh.uvs.extend(self.variants.iter().map(|v| {
                let uv = self.parsed.uvs.get(v.uv as usize);
                uv.map_or(Vec2::ZERO, |uv| Vec2::new(uv.x, 1.0 - uv.y))
            }));
        }
        if has_normals {
            mesh.normals.extend(self.variants.iter().map(|v| {
                let normal = self.parsed.normals.get(v.normal as usize);
                normal.copied().unwrap_or_default()
            }));
        }
    }
}

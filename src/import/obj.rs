//! OBJ with MTL, read by `tobj`: objects and groups become nodes.
//!
//! `tobj` refuses a whole file for one bad line, so the text is scrubbed first; messages about bad lines come from there.

mod materials;
mod mtl;
mod scrub;

use std::cell::Cell;
use std::collections::HashMap;
use std::io::{BufReader, Read};
use std::path::Path;

use glam::{Vec2, Vec3};

use super::assemble::{Assembly, Branch};
use super::text::linear;
use super::{ImportError, ImportOptions, Progress};
use crate::geometry::{Mesh, Submesh, Triangulator};
use crate::scene::Scene;
use scrub::Scrubbed;

/// Makes a scene of an OBJ file. Faces before the first `o` or `g` are in a node `mesh`; groups inside an object hang
/// below it. An object that gives every corner a normal keeps them; else they come from the crease angle.
///
/// # Errors
/// `Empty` when no triangle can be drawn, `Malformed` when no line makes sense, `Canceled`.
pub(super) fn load(
    path: &Path,
    data: &[u8],
    options: &ImportOptions,
    progress: &Progress,
) -> Result<Scene, ImportError> {
    let mut assembly = Assembly::new(path, options, progress);
    let text = scrub::scrub(data, progress)?;
    if text.counts[0] == 0 && text.faces == 0 && text.bad_lines.count() > 0 {
        return Err(assembly.malformed("this is no OBJ file: it has neither vertices nor faces"));
    }
    warn(&text, &mut assembly);
    let material_of = materials::load(path, &text, &mut assembly, progress)?;
    let models = read(&text, progress)?
        .map_err(|error| assembly.malformed(format!("this OBJ file cannot be read: {error}")))?;
    progress.report(0.4);

    let mut mesher = Mesher {
        material_of: &material_of,
        color_range: if text.bright { 255.0 } else { 1.0 },
        triangulator: Triangulator::default(),
    };
    let mut branches: Vec<Branch> = Vec::new();
    for (name, models) in by_name(models) {
        progress.check()?;
        hang(&mut branches, &name, mesher.mesh(models));
    }
    progress.report(0.5);
    let reason = if text.points_and_lines.count() > 0 {
        "it holds only points and lines; Hachure draws surfaces"
    } else if text.free_form.count() > 0 {
        "it holds only free-form surfaces; export it as polygons"
    } else {
        "it holds no faces"
    };
    assembly.finish(branches, reason)
}

fn warn(text: &Scrubbed<'_>, assembly: &mut Assembly<'_>) {
    for (fault, message) in [
        (&text.bad_lines, "cannot be understood and is skipped"),
        (&text.short_faces, "a face has fewer than three corners"),
        (&text.points_and_lines, "points and lines are not drawn"),
        (&text.free_form, "free-form curves and surfaces are not drawn; export them as polygons"),
    ] {
        if let Some(place) = fault.place() {
            assembly.warn(&place, message);
        }
    }
    if let Some(place) = text.lost_faces.place() {
        assembly.lost(&place, text.lost_triangles);
    }
    for (count, what) in text.bad_references.iter().zip(["texture coordinates", "normals"]) {
        if *count > 0 {
            assembly.warn("", format!("ignored {count} references to {what} that do not exist"));
        }
    }
}

/// Bytes that report how far they are read, and can be read no more once the person has canceled.
struct Watched<'a> {
    rest: &'a [u8],
    size: usize,
    progress: &'a Progress,
}

impl Read for Watched<'_> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        self.progress.check().map_err(std::io::Error::other)?;
        self.progress.report(0.4 - 0.2 * self.rest.len() as f32 / self.size as f32);
        self.rest.read(into)
    }
}

/// The models that `tobj` finds. The identity of a material is its place among the names of the text.
fn read(
    text: &Scrubbed<'_>,
    progress: &Progress,
) -> Result<Result<Vec<tobj::Model>, tobj::LoadError>, ImportError> {
    let names = text.materials.iter().enumerate();
    let ids: HashMap<String, usize> = names.map(|(id, name)| (name.clone(), id)).collect();
    // All materials are there from the first line on: their files have been read, and names in none of them count too.
    let ids = Cell::new(Some(ids));
    let body = Watched { rest: &text.body, size: text.body.len(), progress };
    let first = &b"mtllib all\n"[..];
    let mut reader = BufReader::with_capacity(1 << 18, first.chain(text.head.as_bytes()).chain(body));
    let options = tobj::LoadOptions { single_index: true, ..tobj::LoadOptions::default() };
    let result =
        tobj::load_obj_buf(&mut reader, &options, |_| Ok((Vec::new(), ids.take().unwrap_or_default())));
    progress.check()?;
    Ok(result.map(|(models, _)| models))
}

/// The models that have faces, together with others of their name, in the order of the names' first use.
fn by_name(models: Vec<tobj::Model>) -> Vec<(String, Vec<tobj::Mesh>)> {
    let mut groups: Vec<(String, Vec<tobj::Mesh>)> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    for tobj::Model { mesh, name } in models.into_iter().filter(|m| !m.mesh.indices.is_empty()) {
        let place = *places.entry(name).or_insert_with_key(|name| {
            groups.push((name.clone(), Vec::new()));
            groups.len() - 1
        });
        if let Some((_, meshes)) = groups.get_mut(place) {
            meshes.push(mesh);
        }
    }
    groups
}

/// Puts the mesh of a group where it belongs: below the root, or below its object.
fn hang(branches: &mut Vec<Branch>, name: &str, mesh: Mesh) {
    let named = |name: &str| Branch {
        // What `tobj` calls faces without a name.
        name: if name == "unnamed_object" { "mesh".into() } else { name.to_owned() },
        ..Branch::default()
    };
    let Some((object, group)) = name.split_once(scrub::INSIDE) else {
        // An object's node may exist already, for one of its groups.
        match branches.last_mut().filter(|b| b.name == name && b.mesh.is_none()) {
            Some(branch) => branch.mesh = Some(mesh),
            None => branches.push(Branch { mesh: Some(mesh), ..named(name) }),
        }
        return;
    };
    if branches.last().is_none_or(|b| b.name != object) {
        branches.push(named(object));
    }
    if let Some(branch) = branches.last_mut() {
        branch.children.push(Branch { mesh: Some(mesh), ..named(group) });
    }
}

/// Makes one mesh of the models of a name.
struct Mesher<'a> {
    /// Material in the scene for each name in the file, and for none at the end.
    material_of: &'a [usize],
    /// Divisor of vertex colors: 255 when one of them exceeds 1.
    color_range: f32,
    triangulator: Triangulator,
}

impl Mesher<'_> {
    fn mesh(&mut self, mut models: Vec<tobj::Mesh>) -> Mesh {
        models.sort_by_key(|model| model.material_id);
        let has_uvs = models.iter().any(|m| !m.texcoords.is_empty());
        let has_normals = models.iter().all(|m| !m.normals.is_empty());
        let mut mesh = Mesh::default();
        for model in &models {
            let first_vertex = mesh.positions.len();
            mesh.positions.extend(triples(&model.positions));
            let vertices = mesh.positions.len();
            if has_uvs {
                let (pairs, _) = model.texcoords.as_chunks::<2>();
                mesh.uvs.extend(pairs.iter().map(|&[u, v]| Vec2::new(u, 1.0 - v)));
                mesh.uvs.resize(vertices, Vec2::Y);
            }
            if has_normals {
                mesh.normals.extend(triples(&model.normals));
            }
            mesh.colors.extend(triples(&model.vertex_color).map(|c| self.color(c)));
            self.triangulate(model, first_vertex, &mut mesh);
        }
        mesh
    }

    /// Divides the polygons of a model into the triangles of a part.
    fn triangulate(&mut self, model: &tobj::Mesh, first_vertex: usize, mesh: &mut Mesh) {
        let first_index = mesh.indices.len() as u32;
        let mut rest = &model.indices[..];
        let mut points = Vec::new();
        // Where all are triangles, `tobj` leaves the list empty.
        let arities = model.face_arities.iter().map(|&n| n as usize);
        let triangles = if model.face_arities.is_empty() { rest.len() / 3 } else { 0 };
        for arity in arities.chain(std::iter::repeat_n(3, triangles)) {
            let Some((face, behind)) = rest.split_at_checked(arity) else { break };
            rest = behind;
            points.clear();
            points.extend(face.iter().map(|&v| {
                let point = mesh.positions.get(first_vertex + v as usize);
                point.copied().unwrap_or(Vec3::NAN)
            }));
            self.triangulator.triangulate(&points, |triangle| {
                for corner in triangle {
                    let vertex = face.get(corner as usize);
                    mesh.indices.push(vertex.map_or(u32::MAX, |v| first_vertex as u32 + v));
                }
            });
        }
        let material = model.material_id.and_then(|id| self.material_of.get(id));
        let material = material.or(self.material_of.last()).copied().unwrap_or(0);
        let index_count = mesh.indices.len() as u32 - first_index;
        match mesh.submeshes.last_mut().filter(|part| part.material == material) {
            Some(part) => part.index_count += index_count,
            None => mesh.submeshes.push(Submesh { first_index, index_count, material }),
        }
    }

    fn color(&self, color: Vec3) -> [u8; 4] {
        let byte = |c: f32| (linear(c / self.color_range) * 255.0).round() as u8;
        [byte(color.x), byte(color.y), byte(color.z), 255]
    }
}

fn triples(values: &[f32]) -> impl Iterator<Item = Vec3> {
    values.as_chunks().0.iter().copied().map(Vec3::from_array)
}

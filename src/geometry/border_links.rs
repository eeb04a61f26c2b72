//! Where a mesh goes on beyond its borders: as another mesh, in which an exporter has put the rest of a body.
//!
//! Each mesh stays an object of its own. Its border edges only know the triangle of the other mesh that they have in
//! common, so that a seam between them is what it is: nothing where the surface goes on smoothly, a crease where it bends,
//! an outline where it turns away.

use glam::{Vec2, Vec3, Vec4};

use super::edge::FOLDED;
use super::mend::{SeamTolerance, mend};
use super::{Adjacency, EdgeKind, Mesh, Submesh};

/// A border edge at which another mesh in the same place goes on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BorderLink {
    /// Vertices at the ends of the edge.
    pub vertices: [u32; 2],
    /// The corner of the other mesh's triangle that is not on the edge, in the units of the mesh.
    pub apex: Vec3,
    /// The other mesh: an index into `Scene::meshes`.
    pub mesh: usize,
    /// As [`super::Edge::is_soft`].
    pub is_soft: bool,
    /// Whether the two triangles have different materials.
    pub materials_differ: bool,
}

/// Meshes in one space that an exporter may have cut from one body, each with its index in `Scene::meshes`: lets their
/// borders know each other, and mends the seams between them. The result is in the same order; `None` for meshes that
/// meet no other.
pub fn link_meshes(meshes: &[(usize, &Mesh)], tolerance: SeamTolerance) -> Vec<Option<Mesh>> {
    let mut merged = Merged::new(meshes);
    let mut adjacency = Adjacency::new(&merged.mesh);
    let mut mended = None;
    if let Some((mesh, report)) = mend(&merged.mesh, &adjacency, tolerance) {
        merged.mesh = mesh;
        adjacency = Adjacency::new(&merged.mesh);
        mended = Some(report);
    }
    let mut beyond: Vec<Vec<BorderLink>> = vec![Vec::new(); meshes.len()];
    for edge in &adjacency.edges {
        let has_two_sides = matches!(edge.kind, EdgeKind::Manifold | EdgeKind::Flipped);
        if !has_two_sides || edge.dihedral.abs() > FOLDED {
            continue;
        }
        let [one, two] = edge.faces.map(|face| merged.part_of(face));
        if one.member == two.member {
            continue;
        }
        let has_own_normals = |part: Member| meshes[part.member].1.has_own_normals();
        for (own, other, own_face, face) in
            [(one, two, edge.faces[0], edge.faces[1]), (two, one, edge.faces[1], edge.faces[0])]
        {
            let point = |v: u32| adjacency.weld.representative[v as usize];
            let ends = edge.vertices.map(point);
            let triangles = merged.mesh.triangles();
            let own_vertex = |end: u32| triangles[own_face as usize].into_iter().find(|&v| point(v) == end);
            let apex = triangles[face as usize].into_iter().find(|&v| !ends.contains(&point(v)));
            let ([Some(a), Some(b)], Some(apex)) = (ends.map(own_vertex), apex) else { continue };
            beyond[own.member].push(BorderLink {
                vertices: [a, b],
                apex: merged.mesh.positions[apex as usize],
                mesh: meshes[other.member].0,
                is_soft: edge.is_soft && has_own_normals(own) && has_own_normals(other),
                materials_differ: own.material != other.material,
            });
        }
    }
    beyond
        .into_iter()
        .enumerate()
        .map(|(member, beyond)| {
            if beyond.is_empty() {
                return None;
            }
            let (_, old) = meshes[member];
            let mut mesh = merged.member(member, old, &beyond);
            if let Some(report) = mended
                && mesh.positions != old.positions
            {
                mesh.mended = old.mended.or(Some(report));
            }
            Some(mesh)
        })
        .collect()
}

/// A part of the merged: which mesh it is of, and its material.
#[derive(Clone, Copy)]
struct Member {
    member: usize,
    material: usize,
}

/// Several meshes as one; the materials of its submeshes are indices into `members`.
struct Merged {
    mesh: Mesh,
    members: Vec<Member>,
}

impl Merged {
    fn new(meshes: &[(usize, &Mesh)]) -> Self {
        let mut merged = Mesh::default();
        let mut members = Vec::new();
        let has = |attribute: fn(&Mesh) -> usize| meshes.iter().any(|(_, mesh)| attribute(mesh) > 0);
        let has_errors = has(|mesh| mesh.position_errors.len());
        let has_normals = has(|mesh| mesh.normals.len());
        let has_uvs = has(|mesh| mesh.uvs.len());
        let has_colors = has(|mesh| mesh.colors.len());
        let has_tangents = has(|mesh| mesh.tangents.len());
        for (member, (_, mesh)) in meshes.iter().enumerate() {
            let first = merged.positions.len() as u32;
            merged.positions.extend(&mesh.positions);
            let count = merged.positions.len();
            // What some of them lack is filled up, and left out again at the end.
            if has_errors {
                merged.position_errors.extend(&mesh.position_errors);
                merged.position_errors.resize(count, 0.0);
            }
            if has_normals {
                merged.normals.extend(&mesh.normals);
                merged.normals.resize(count, Vec3::ZERO);
            }
            if has_uvs {
                merged.uvs.extend(&mesh.uvs);
                merged.uvs.resize(count, Vec2::ZERO);
            }
            if has_colors {
                merged.colors.extend(&mesh.colors);
                merged.colors.resize(count, [255; 4]);
            }
            if has_tangents {
                merged.tangents.extend(&mesh.tangents);
                merged.tangents.resize(count, Vec4::ZERO);
            }
            for part in &mesh.submeshes {
                let first_index = merged.indices.len() as u32 + part.first_index;
                merged.submeshes.push(Submesh { first_index, material: members.len(), ..*part });
                members.push(Member { member, material: part.material });
            }
            merged.indices.extend(mesh.indices.iter().map(|v| first + v));
        }
        Self { mesh: merged, members }
    }

    fn part_of(&self, face: u32) -> Member {
        let submeshes = &self.mesh.submeshes;
        let number = submeshes.partition_point(|submesh| submesh.first_index <= 3 * face).saturating_sub(1);
        self.members[submeshes[number].material]
    }

    /// One of the meshes again.
    fn member(&self, member: usize, old: &Mesh, beyond: &[BorderLink]) -> Mesh {
        let mut new_index = vec![u32::MAX; self.mesh.positions.len()];
        let mut sources = Vec::new();
        let mut indices = Vec::new();
        let mut submeshes = Vec::new();
        for submesh in &self.mesh.submeshes {
            let Member { member: owner, material } = self.members[submesh.material];
            if owner != member {
                continue;
            }
            submeshes.push(Submesh {
                first_index: indices.len() as u32,
                index_count: submesh.index_count,
                material,
            });
            for &v in &self.mesh.indices[submesh.first_index as usize..][..submesh.index_count as usize] {
                let new = &mut new_index[v as usize];
                if *new == u32::MAX {
                    *new = sources.len() as u32;
                    sources.push(v);
                }
                indices.push(*new);
            }
        }
        let mut mesh = Mesh {
            indices,
            submeshes,
            has_computed_normals: old.has_computed_normals,
            mended: old.mended,
            ..self.mesh.gather(&sources)
        };
        let lacks =
            [old.normals.is_empty(), old.uvs.is_empty(), old.colors.is_empty(), old.tangents.is_empty()];
        if lacks[0] {
            mesh.normals.clear();
        }
        if lacks[1] {
            mesh.uvs.clear();
        }
        if lacks[2] {
            mesh.colors.clear();
        }
        if lacks[3] {
            mesh.tangents.clear();
        }
        mesh.border_links = beyond
            .iter()
            .map(|beyond| BorderLink { vertices: beyond.vertices.map(|v| new_index[v as usize]), ..*beyond })
            .collect();
        mesh
    }
}

#[cfg(test)]
#[path = "border_links_tests.rs"]
mod tests;

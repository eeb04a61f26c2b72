//! Stripes on meshes, kept in the cache once they have been found.

use super::cache::{Cache, Key, KeyMaker};
use crate::geometry::stripes::{StripeVertex, WORDS};
use crate::geometry::{DirectionSource, FieldOptions, Mesh, StripeField};

/// Raised whenever the same mesh gets other stripes.
const VERSION: u32 = 9;

/// Smaller meshes are not kept: they take no longer than reading a file.
const MIN_TRIANGLES: usize = 2000;

/// The stripes of a mesh, from the cache or found anew; `None` when `progress` said not to go on, see [`StripeField::solve`].
pub fn stripes_of(
    cache: &Cache,
    mesh: &Mesh,
    options: &FieldOptions,
    progress: &(dyn Fn(f32) -> bool + Sync),
) -> Option<StripeField> {
    if mesh.triangle_count() < MIN_TRIANGLES {
        return StripeField::solve(mesh, options, progress);
    }
    let key = key_of(mesh, options);
    let kept = cache.load(key).and_then(|bytes| from_bytes(&bytes));
    if let Some(field) = kept.filter(|field| field.corner_vertices.len() == mesh.indices.len()) {
        return Some(field);
    }
    let field = StripeField::solve(mesh, options, progress)?;
    cache.store(key, &to_bytes(&field));
    Some(field)
}

fn key_of(mesh: &Mesh, options: &FieldOptions) -> Key {
    let FieldOptions { extent, source, smoothing, crease_angle, crease_rule, up, level } = *options;
    let (number, axis) = match source {
        DirectionSource::Curvature => (0, None),
        DirectionSource::TextureU => (1, None),
        DirectionSource::TextureV => (2, None),
        DirectionSource::Axis(axis) => (3, Some(axis)),
    };
    let uvs: &[u8] = if matches!(number, 1 | 2) { bytemuck::cast_slice(&mesh.uvs) } else { &[] };
    KeyMaker::new("stripes", VERSION)
        .bytes(bytemuck::cast_slice(&mesh.positions))
        .bytes(bytemuck::cast_slice(&mesh.normals))
        .bytes(bytemuck::cast_slice(&mesh.indices))
        .bytes(uvs)
        .integers(&[number, crease_rule as u64, u64::from(mesh.has_computed_normals)])
        .numbers(&axis.map_or([0.0; 3], |axis| axis.to_array()))
        .numbers(&[extent, smoothing, crease_angle, level])
        .numbers(&up.to_array())
        .key()
}

/// Words: lines per unit, number of vertices, the vertices, the vertex of each corner.
fn to_bytes(field: &StripeField) -> Vec<u8> {
    let mut words = vec![field.cycles_per_unit.to_bits(), field.vertices.len() as u32];
    words.extend(field.vertices.iter().flat_map(StripeVertex::words));
    words.extend(&field.corner_vertices);
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

fn from_bytes(bytes: &[u8]) -> Option<StripeField> {
    let (chunks, rest) = bytes.as_chunks::<4>();
    let words: Vec<u32> = chunks.iter().map(|word| u32::from_le_bytes(*word)).collect();
    let (&[frequency, count], words) = words.split_first_chunk::<2>()?;
    let (vertices, corner_vertices) = words.split_at_checked(count as usize * WORDS)?;
    let (vertices, _) = vertices.as_chunks::<WORDS>();
    let is_sound = rest.is_empty() && corner_vertices.iter().all(|vertex| *vertex < count);
    is_sound.then(|| StripeField {
        vertices: vertices.iter().map(|words| StripeVertex::from(*words)).collect(),
        corner_vertices: corner_vertices.to_vec(),
        cycles_per_unit: f32::from_bits(frequency),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::primitives;

    #[test]
    fn stripes_come_back_from_the_cache_as_they_were() {
        let mesh = primitives::torus(1.0, 0.4, 48, 32);
        let options = FieldOptions::default();
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::at(folder.path(), super::super::cache::LIMIT);
        let first = stripes_of(&cache, &mesh, &options, &|_| true).unwrap();
        let refused = stripes_of(&cache, &mesh, &options, &|_| false).unwrap();
        assert!(first == refused && !first.vertices.is_empty(), "the second comes from the cache");
        let other = FieldOptions { smoothing: 0.2, ..options };
        assert_eq!(stripes_of(&cache, &mesh, &other, &|_| false), None);
        let mut bytes = to_bytes(&first);
        assert_eq!(from_bytes(&bytes), Some(first));
        bytes.truncate(bytes.len() / 2);
        assert_eq!(from_bytes(&bytes), None);
    }
}

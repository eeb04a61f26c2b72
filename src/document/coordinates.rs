//! Styles that ask for texture coordinates which a model does not have.

use super::Document;
use crate::scene::{Scene, Warning};
use crate::style::Technique;
use crate::style::hatching::{Direction, Hatching, Mapping};

impl Document {
    /// A warning for each object whose hatching follows texture coordinates that it does not have, at most so many and how many
    /// more.
    pub fn coordinate_faults(&self, scene: &Scene) -> Vec<Warning> {
        const MOST: usize = 3;
        let lacks = |mesh: Option<usize>| {
            mesh.and_then(|mesh| scene.meshes.get(mesh)).is_some_and(|mesh| mesh.uvs.is_empty())
        };
        let resolved = self.resolve(scene);
        let hatched = resolved
            .iter()
            .zip(&scene.nodes)
            .filter(|(r, node)| r.visible && r.style.technique == Technique::Hatching && lacks(node.mesh));
        let said: Vec<(String, &str)> =
            hatched.filter_map(|(r, node)| Some((node.path.clone(), instead(&r.style.hatching)?))).collect();
        let warnings = said.iter().take(MOST).map(|(path, instead)| Warning {
            place: path.clone(),
            message: format!("it has no texture coordinates: {instead}"),
        });
        let more = said.len().saturating_sub(MOST);
        let rest = (more > 0).then(|| Warning {
            place: "hatching".to_owned(),
            message: format!("{more} more objects have no texture coordinates"),
        });
        warnings.chain(rest).collect()
    }
}

/// What is drawn where there are no coordinates; `None`: none are asked for.
fn instead(hatching: &Hatching) -> Option<&'static str> {
    let by_direction = matches!(hatching.direction, Direction::TextureU | Direction::TextureV);
    match hatching.mapping {
        Mapping::Uv => Some("strokes lie in stripes instead"),
        _ if by_direction => Some("strokes follow its curvature instead"),
        Mapping::Stripes | Mapping::ImageSpace => None,
    }
}

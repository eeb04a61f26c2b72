//! The color of each surface that a ray meets, from pictures of its ring alone.

use std::collections::BTreeMap;

use glam::DVec4;
use hachure::export::Session;
use hachure::scene::{Camera, NodeId};
use hachure::style::Technique;

use super::looks::{GLASS, Kind, Look};
use super::picture::Picture;
use super::rays::{Cast, Hit, pixels};
use super::stage::Stage;

/// Least share of what rays meet of a ring, away from its edges, that its own picture shows.
const MIN_SEEN: f64 = 0.99;

/// What a ring, or the rings of one blueprint, are alone.
enum Alone {
    /// Its nearest surface.
    Surface(Picture),
    /// Each layer, the nearest first.
    Layers(Vec<Picture>),
    /// Parts of its surface of which no ray meets one twice, and which part each triangle is in.
    Parts(Vec<usize>, Vec<Picture>),
    /// It is drawn by its lines only: a picture of them.
    Bare(Picture),
}

/// What a ray meets, with its color.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    pub node: NodeId,
    pub depth: f64,
    /// NaN where it is not known.
    pub color: DVec4,
    /// Whether nothing is seen behind it.
    pub hides: bool,
}

/// A stage seen by a camera.
pub struct Shot<'a> {
    pub stage: &'a Stage,
    pub camera: Camera,
    /// By place.
    pub casts: Vec<Cast>,
    alone: BTreeMap<Vec<NodeId>, Alone>,
}

impl<'a> Shot<'a> {
    /// A shot by the camera of that number; the stage has been entered.
    pub fn new(stage: &'a Stage, number: usize) -> Self {
        let camera = stage.camera(number);
        let links = &stage.links;
        let casts = links.places.iter().map(|place| Cast::new(&links.mesh, place, &camera)).collect();
        Self { stage, camera, casts, alone: BTreeMap::new() }
    }

    /// What rays meet of a ring.
    pub fn cast(&self, node: NodeId) -> &Cast {
        &self.casts[self.stage.rings[node].place]
    }

    /// Per pixel, what a ray meets of some rings, the nearest first and nothing behind what hides it.
    pub fn steps(&mut self, session: &mut Session, company: &[NodeId]) -> Vec<Vec<Step>> {
        let mut steps = vec![Vec::new(); pixels()];
        for group in self.groups(company) {
            let alone = self.alone.remove(&group).unwrap_or_else(|| {
                let alone = self.draw_alone(session, &group);
                self.check_seen(&group, &alone);
                alone
            });
            for (px, steps) in steps.iter_mut().enumerate() {
                let step = |(layer, (node, hit)): (usize, (NodeId, Hit))| {
                    let (color, hides) = alone.color(px, layer, hit);
                    Step { node, depth: hit.depth, color, hides }
                };
                steps.extend(self.hits(&group, px).into_iter().enumerate().map(step));
            }
            self.alone.insert(group, alone);
        }
        for steps in &mut steps {
            steps.sort_by(|a, b| a.depth.total_cmp(&b.depth));
            let shown = steps.iter().position(|step| step.hides).map_or(steps.len(), |i| i + 1);
            steps.truncate(shown);
        }
        steps
    }

    /// Each ring by itself, those of one blueprint together.
    fn groups(&self, company: &[NodeId]) -> Vec<Vec<NodeId>> {
        let mut groups: Vec<Vec<NodeId>> = Vec::new();
        for &node in company {
            let look = |node: NodeId| &self.stage.rings[node].look;
            let is_blueprint = look(node).kind == Kind::Blueprint;
            match groups.iter_mut().find(|group| is_blueprint && look(group[0]) == look(node)) {
                Some(group) => group.push(node),
                None => groups.push(vec![node]),
            }
        }
        groups
    }

    fn draw_alone(&self, session: &mut Session, group: &[NodeId]) -> Alone {
        match self.stage.rings[group[0]].look.kind {
            Kind::Surface => Alone::Surface(self.stage.picture(session, self.camera, group, |look| look)),
            Kind::Glass => {
                let part_of = self.parts(group[0]);
                let pictures = self.stage.pictures_of_parts(session, self.camera, group[0], &part_of);
                let is_drawn = pictures.iter().any(|picture| picture.colors.iter().any(|c| c.w > 0.0));
                if is_drawn {
                    Alone::Parts(part_of, pictures)
                } else {
                    Alone::Bare(self.stage.picture(session, self.camera, group, |look| look))
                }
            }
            Kind::Blueprint => {
                let count =
                    |px: usize| group.iter().map(|node| self.cast(*node).hits[px].len()).sum::<usize>();
                let layers = (0..pixels()).map(count).max().unwrap_or(0) as u32;
                let layer = |i| {
                    let only = |look: Look| look.only_layer(i);
                    self.stage.picture(session, self.camera, group, only)
                };
                Alone::Layers((1..=layers).map(layer).collect())
            }
        }
    }

    /// Where rays meet rings, they are in their own picture: of blank pictures all others would be blank, and right.
    fn check_seen(&self, group: &[NodeId], alone: &Alone) {
        let look = &self.stage.rings[group[0]].look;
        let is_steady = |px: &usize| group.iter().all(|node| self.cast(*node).is_steady[*px]);
        let (mut met, mut seen) = (0, 0);
        for px in (0..pixels()).filter(is_steady) {
            for (layer, (_, hit)) in self.hits(group, px).into_iter().enumerate() {
                let (color, hides) = alone.color(px, layer, hit);
                met += 1;
                seen += usize::from(color.w > 0.0);
                if hides {
                    break;
                }
            }
        }
        if look.style.technique == Technique::Blank {
            assert_eq!(seen, 0, "{} has a surface", look.name);
            let is_inked = |picture: &Picture| picture.colors.iter().any(|color| color.w > 0.0);
            let is_seen =
                matches!(alone, Alone::Surface(picture) | Alone::Bare(picture) if is_inked(picture));
            assert!(is_seen, "{} has no lines", look.name);
        } else {
            let share = seen as f64 / met as f64;
            assert!(share > MIN_SEEN, "{} is seen in {share:.4} of its {met} places", look.name);
        }
    }

    /// What a ray meets of some rings, the nearest first.
    fn hits(&self, group: &[NodeId], px: usize) -> Vec<(NodeId, Hit)> {
        let of_node = |&node: &NodeId| self.cast(node).hits[px].iter().map(move |hit| (node, *hit));
        let mut hits: Vec<_> = group.iter().flat_map(of_node).collect();
        hits.sort_by(|(_, a), (_, b)| a.depth.total_cmp(&b.depth));
        hits
    }

    /// Parts of a ring's triangles of which no ray meets one twice.
    fn parts(&self, node: NodeId) -> Vec<usize> {
        let count = self.stage.links.mesh.triangle_count();
        let mut rivals = vec![Vec::new(); count];
        for hits in &self.cast(node).hits {
            for hit in hits {
                rivals[hit.triangle].extend(hits.iter().map(|h| h.triangle).filter(|t| *t != hit.triangle));
            }
        }
        let mut parts = vec![usize::MAX; count];
        for triangle in 0..count {
            let is_free = |part: &usize| rivals[triangle].iter().all(|rival| parts[*rival] != *part);
            parts[triangle] = (0..count).find(is_free).unwrap_or(0);
        }
        parts
    }
}

impl Alone {
    /// The color of a hit, which is in that layer of its group, and whether nothing is seen behind it.
    fn color(&self, px: usize, layer: usize, hit: Hit) -> (DVec4, bool) {
        match self {
            Self::Surface(picture) => (picture.colors[px], true),
            Self::Layers(pictures) => (pictures[layer].colors[px], false),
            Self::Parts(part_of, pictures) => {
                let color = pictures[part_of[hit.triangle]].colors[px];
                // On the edge of a triangle it may be its neighbor that is drawn, and that is another part.
                (if color.w > 0.0 { color * f64::from(GLASS) } else { DVec4::NAN }, false)
            }
            Self::Bare(_) => (DVec4::ZERO, false),
        }
    }
}

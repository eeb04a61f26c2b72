//! Measures the final picture of a scene against its exact visible edges.

use glam::{DVec2, DVec3, Vec2, Vec4};
use hachure::document::Document;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::line_score::{InkImage, LineScore, TOLERANCE, score};
use hachure::geometry::visible_edges::{EdgeScene, LineRules, PlacedMesh, SurfacePoint, VisibleEdges};
use hachure::geometry::{Adjacency, Lens, Projector};
use hachure::scene::{AlphaMode, Camera, Projection, Scene, Texture, TextureRef, Wrap};
use hachure::style::{Color, Style, Technique};

use super::curved::CurvedSurfaces;
use super::line_scenes::Subject;

/// The ways of finding edges that the program has, of those that are worth measuring.
pub fn modes() -> Vec<&'static str> {
    let has_modes = Style::default().params().iter().any(|param| param.key == "edges.mode");
    if has_modes { vec!["image_space", "exact"] } else { vec!["image_space"] }
}

/// A view of a scene.
#[derive(Debug, Clone, Copy)]
pub struct Look {
    pub towards_viewer: DVec3,
    pub orthographic: bool,
}

/// So many directions, evenly over the sphere (spherical Fibonacci points), none along an axis.
pub fn directions(count: u32) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        let y = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(count);
        let (sin, cos) = (f64::from(i) * 2.399_963 + 0.37).sin_cos();
        DVec3::new((1.0 - y * y).sqrt() * cos, y, (1.0 - y * y).sqrt() * sin)
    })
}

/// A scene on the device and as edges.
pub struct Stage {
    opened: Opened,
    edges: EdgeScene,
    /// Found when they are first asked for.
    curved: Option<CurvedSurfaces>,
    /// The nodes that are objects, in the order of the edges' meshes.
    nodes: Vec<usize>,
}

/// What is there and what was drawn.
pub struct Measured {
    pub score: LineScore,
    /// The part of the inked pixels that only have edges of triangles near them, none of the surface that those stand for.
    pub barbs: f64,
    pub side: u32,
    /// The edges at which there has to be a line.
    pub truth: VisibleEdges,
    /// Those at which there may be one.
    pub edges: VisibleEdges,
    /// Whether there is a line, per pixel.
    pub lines: Vec<bool>,
    /// Pixels that count neither way.
    pub ignored: Vec<bool>,
}

impl Stage {
    /// Uploads a scene, to be drawn as black lines on white paper.
    pub fn new(session: &mut Session, subject: &Subject) -> Self {
        let scene = &subject.scene;
        let mut document = Document { style: Style::default(), ..Document::default() };
        document.view.background = Some(Color([255; 3]));
        document.style.technique = Technique::Blank;
        let opened = Opened { document, scene: scene.clone() };
        session.set_scene(&opened).unwrap();

        let adjacencies: Vec<Adjacency> = scene.meshes.iter().map(|mesh| Adjacency::new(mesh)).collect();
        let nodes: Vec<usize> = (0..scene.nodes.len()).filter(|&n| scene.nodes[n].mesh.is_some()).collect();
        let placed: Vec<PlacedMesh<'_>> = nodes
            .iter()
            .map(|&n| {
                let mesh = scene.nodes[n].mesh.unwrap();
                PlacedMesh {
                    mesh: &scene.meshes[mesh],
                    adjacency: &adjacencies[mesh],
                    world_from_local: scene.nodes[n].world_from_local,
                    object: n as u32,
                }
            })
            .collect();
        Self { edges: EdgeScene::new(&placed), curved: None, opened, nodes }
    }

    /// What is seen of the edges in a square picture, and the pixels of it in which they do not count.
    pub fn visible(&self, projector: &Projector) -> (VisibleEdges, Vec<bool>) {
        let scene = &self.opened.scene;
        let is_masked = scene.materials.iter().any(|material| material.alpha != AlphaMode::Opaque);
        let is_hole = |point: SurfacePoint| is_hole(scene, self.nodes[point.mesh], point);
        let rules =
            LineRules { is_hole: if is_masked { Some(&is_hole) } else { None }, ..LineRules::default() };
        let side = projector.size[0];
        let ignored = if is_masked {
            near_changes(&self.edges.holes_before(projector, &rules), side as usize)
        } else {
            vec![false; (side * side) as usize]
        };
        (self.edges.visible(projector, &rules), ignored)
    }

    /// Draws a view in each of these modes and scores the pictures.
    pub fn measure(&mut self, session: &mut Session, look: Look, side: u32, modes: &[&str]) -> Vec<Measured> {
        let scene = &self.opened.scene;
        let up = self.opened.document.up(scene).vector();
        let extent = scene.extent();
        let camera = Camera::looking_from(look.towards_viewer, up, &extent, 1.0)
            .with_orthographic(look.orthographic)
            .framing(&extent, 1.0);
        let projector = projector(&camera, side);
        let (edges, ignored) = self.visible(&projector);
        let curved = self.curved.get_or_insert_with(|| CurvedSurfaces::new(&self.opened.scene));
        let truth = curved.lines_of(&edges, &projector, &LineRules::default());

        self.opened.document.camera = Some(camera);
        // As wide as in a picture of 800 pixels: in smaller ones thin lines would not count as ink.
        for (group, width) in [("profile", 2.5), ("inner", 2.2)] {
            let width = width * 800.0 / f64::from(side);
            super::set(&mut self.opened, &format!("edges.{group}.width"), &format!("{width}"));
        }
        let pictures = modes.iter().map(|mode| {
            if super::line_truth::modes().len() > 1 {
                super::set(&mut self.opened, "edges.mode", mode);
            }
            let picture = session.image(&self.opened, [side, side], false).unwrap();
            let ink: Vec<f32> =
                picture.pixels().map(|p| 1.0 - f32::from(p.0[0].max(p.0[1]).max(p.0[2])) / 255.0).collect();
            let picture = InkImage::new(side as usize, side as usize, &ink).unwrap();
            let picture = picture.ignoring(&ignored).unwrap();
            let precision = score(picture, &edges, TOLERANCE).precision;
            let of_surface = score(picture, &truth, TOLERANCE);
            Measured {
                score: LineScore { precision, ..of_surface },
                barbs: precision - of_surface.precision,
                side,
                truth: truth.clone(),
                edges: edges.clone(),
                lines: picture.lines(),
                ignored: ignored.clone(),
            }
        });
        pictures.collect()
    }
}

/// The projector of a square picture by a camera.
pub fn projector(camera: &Camera, side: u32) -> Projector {
    Projector {
        view_from_world: camera.view_from_world(),
        lens: match camera.projection {
            Projection::Perspective { view_angle } => {
                Lens::Perspective { tan_half_angle: (view_angle.to_radians() * 0.5).tan() }
            }
            Projection::Orthographic { view_height } => Lens::Orthographic { half_height: view_height * 0.5 },
        },
        size: [side; 2],
        near: camera.distance() * 1e-3,
        far: camera.distance() * 10.0,
    }
}

/// The pixels within two of which the number changes.
fn near_changes(numbers: &[u32], side: usize) -> Vec<bool> {
    let differs = |at: usize| {
        let (x, y) = (at % side, at / side);
        let rows = y.saturating_sub(2)..(y + 3).min(side);
        rows.flat_map(|y| (x.saturating_sub(2)..(x + 3).min(side)).map(move |x| y * side + x))
            .any(|other| numbers[other] != numbers[at])
    };
    (0..side * side).map(differs).collect()
}

/// The alpha test of the renderer, at full resolution.
fn is_hole(scene: &Scene, node: usize, point: SurfacePoint) -> bool {
    let mesh = &scene.meshes[scene.nodes[node].mesh.unwrap()];
    let part = mesh.submeshes.iter().rfind(|part| part.first_index as usize <= 3 * point.triangle).unwrap();
    let Some(material) = scene.materials.get(part.material) else { return false };
    let AlphaMode::Mask(cutoff) = material.alpha else { return false };
    let corners = mesh.triangles()[point.triangle].map(|v| v as usize);
    let weights = point.weights.as_vec3().to_array();
    let mut alpha = material.base_color.w;
    if let Some(texture) = &material.base_color_texture {
        let uv: Vec2 = corners.iter().zip(weights).map(|(&v, w)| mesh.uvs[v] * w).sum();
        alpha *= texel(&scene.textures[texture.texture], texture, uv).w;
    }
    if !mesh.colors.is_empty() {
        alpha *=
            corners.iter().zip(weights).map(|(&v, w)| f32::from(mesh.colors[v][3]) / 255.0 * w).sum::<f32>();
    }
    alpha < cutoff
}

/// A texture's value, filtered as asked for.
fn texel(texture: &Texture, used: &TextureRef, uv: Vec2) -> Vec4 {
    let size = DVec2::new(f64::from(texture.width), f64::from(texture.height));
    let at = used.transform.0.transform_point2(uv).as_dvec2() * size;
    let wrapped = |c: f64, size: u32, wrap: Wrap| {
        let (c, size) = (c as i64, i64::from(size));
        (match wrap {
            Wrap::Mirror if c.div_euclid(size) % 2 != 0 => size - 1 - c.rem_euclid(size),
            Wrap::Mirror | Wrap::Repeat => c.rem_euclid(size),
            Wrap::Clamp => c.clamp(0, size - 1),
        }) as usize
    };
    let value = |p: DVec2| {
        let (x, y) = (wrapped(p.x, texture.width, used.wrap[0]), wrapped(p.y, texture.height, used.wrap[1]));
        let at = 4 * (y * texture.width as usize + x);
        Vec4::from_array([0, 1, 2, 3].map(|c| f32::from(texture.rgba[at + c]) / 255.0))
    };
    if used.nearest {
        return value(at.floor());
    }
    let corner = (at - 0.5).floor();
    let [x, y] = (at - 0.5 - corner).as_vec2().to_array();
    let row = |y: f64| value(corner + DVec2::new(0.0, y)).lerp(value(corner + DVec2::new(1.0, y)), x);
    row(0.0).lerp(row(1.0), y)
}

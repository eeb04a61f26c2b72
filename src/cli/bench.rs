//! `hachure bench`: milliseconds per stage and frame, and ratios, which hold on noisy machines too.

use std::sync::Arc;
use std::time::Instant;

use glam::DMat4;
use serde_json::json;

use super::args::BenchArgs;
use super::{CliError, print_json, print_line, sample, session};
use crate::document::{LayersBy, Lighting};
use crate::export::Session;
use crate::export::session::{Opened, initial_camera, open, topology};
use crate::geometry::{EdgeClass, primitives};
use crate::gpu::Gpu;
use crate::import::Progress;
use crate::render::MAX_LAYERS;
use crate::render::Request;
use crate::scene::{Camera, Material, Node, Scene};
use crate::style::halftone::{Mapping, Space};
use crate::style::hidden::HiddenLayers;
use crate::style::indication::DetailBy;
use crate::style::sketch::Anchor;
use crate::style::toon::Smoothing;
use crate::style::{EdgeMode, EdgeOperator, HiddenMode, Style, StyleError, Technique, hatching, preset};

/// What is measured: a style in some light, and what stands behind the model.
struct BenchLook {
    name: &'static str,
    style: Style,
    lighting: Lighting,
    behind: Behind,
    layers_by: LayersBy,
}

/// What stands behind the model.
#[derive(Clone, Copy, PartialEq)]
enum Behind {
    Nothing,
    Wall,
    Mirror,
}

/// One look, measured.
struct Row {
    name: &'static str,
    frame_ms: Vec<f64>,
    stages: Vec<Stage>,
}

/// The passes of one name.
struct Stage {
    name: &'static str,
    /// Of all of them, in each frame.
    ms: Vec<f64>,
    /// How many there are in a frame.
    passes: usize,
}

impl Row {
    /// Notes what the passes of a frame took.
    fn add_passes(&mut self, passes: &[(&'static str, f64)]) {
        for &(name, _) in passes {
            if self.stages.iter().all(|stage| stage.name != name) {
                self.stages.push(Stage { name, ms: Vec::new(), passes: 0 });
            }
        }
        for stage in &mut self.stages {
            let own: Vec<f64> =
                passes.iter().filter(|(name, _)| *name == stage.name).map(|(_, ms)| *ms).collect();
            stage.ms.push(own.iter().sum());
            stage.passes = stage.passes.max(own.len());
        }
    }

    /// How often it takes the time of another row: frame by frame against the one drawn in the same round.
    fn ratio_to(&self, other: &Self) -> f64 {
        median(&self.frame_ms.iter().zip(&other.frame_ms).map(|(a, b)| a / b).collect::<Vec<_>>())
    }
}

pub(super) fn run(args: &BenchArgs) -> Result<(), CliError> {
    let files =
        if args.files.is_empty() { vec![sample().ok_or(CliError::NoSample)?] } else { args.files.clone() };
    let started = Instant::now();
    let opened = open(&files, |_| {}, &Progress::default())?;
    let load_ms = started.elapsed().as_secs_f64() * 1e3;
    let mut bench = Bench::new(opened, args.resolution.0)?;

    let has_uvs = bench.opened.scene.meshes.iter().any(|mesh| !mesh.uvs.is_empty());
    let mut looks = looks(has_uvs, &bench.layers()?, args.resolution.0)?;
    if let Some(only) = &args.only {
        let is_asked = |look: &BenchLook| look.name.contains(only.as_str());
        if !looks.iter().any(is_asked) {
            return Err(CliError::NoRow(only.clone()));
        }
        let mut number = 0..;
        looks.retain(|look| number.next() == Some(0) || is_asked(look));
    }
    let mut rows: Vec<Row> =
        looks.iter().map(|look| Row { name: look.name, frame_ms: Vec::new(), stages: Vec::new() }).collect();
    // The looks take turns, so that a slow moment of the machine hits all of them alike.
    for frame in 0..args.frames + WARM_UP {
        for (i, (row, look)) in rows.iter_mut().zip(&looks).enumerate() {
            bench.get_ready(look, turn(frame, i))?;
            let ms = bench.frame(look, turn(frame, i))?;
            if frame >= WARM_UP {
                row.frame_ms.push(ms);
            }
        }
    }
    // Timing each pass holds the device up, so it is done by itself.
    bench.session.renderer().enable_timers();
    for frame in 0..args.frames.min(10) + WARM_UP {
        for (i, (row, look)) in rows.iter_mut().zip(&looks).enumerate() {
            bench.get_ready(look, turn(frame, i))?;
            bench.session.renderer().timings()?;
            bench.frame(look, turn(frame, i))?;
            let passes = bench.session.renderer().timings()?;
            if frame >= WARM_UP {
                row.add_passes(&passes);
            }
        }
    }
    report(args, &mut bench, load_ms, &rows)
}

/// The first frames compile shaders and fault pages in.
const WARM_UP: u32 = 2;

/// Degrees of a frame's direction: it differs from the last frame's, so that every stage has to run, and those of one
/// round are nearly equal.
fn turn(frame: u32, row: usize) -> f64 {
    f64::from(frame % 10) * 3.0 + row as f64 * 0.01
}

/// So many degrees before each of these directions frames are drawn that do not count: whoever turns a model has just seen it
/// from a little farther on, what there was to learn of it is known, and the first frame, which knew nothing, is forgotten.
const BEFORE: [f64; 2] = [1.0, 0.5];

/// The middle of all turns.
const MIDDLE: f64 = 13.5;

/// The last look.
const MIRROR: &str = "before a mirror";

/// Path of the node that stands behind the model.
const WALL: &str = "/behind the model";

/// A flat wall behind a scene that faces a camera and fills its picture.
fn wall(camera: &Camera, scene: &Scene) -> Scene {
    let bounds = scene.bounds();
    let (size, back) = (bounds.diagonal(), -camera.forward());
    let place = DMat4::from_cols(
        camera.right().extend(0.0),
        camera.up().extend(0.0),
        back.extend(0.0),
        (bounds.center() - 0.6 * size * back).extend(1.0),
    );
    let node = Node {
        name: "wall".to_owned(),
        path: WALL.to_owned(),
        parent: None,
        descendants: 0,
        world_from_local: place,
        mesh: Some(0),
    };
    Scene {
        nodes: vec![node],
        meshes: vec![Arc::new(primitives::plane(3.0 * size as f32))],
        materials: vec![Material::default()],
        ..Scene::default()
    }
}

/// A scene on the device, ready to be drawn again and again.
struct Bench {
    session: Session,
    /// What is drawn, with the wall behind it.
    scene: Arc<Scene>,
    opened: Opened,
    size: [u32; 2],
    camera: Camera,
    topology_ms: f64,
}

impl Bench {
    fn new(opened: Opened, size: [u32; 2]) -> Result<Self, CliError> {
        let Opened { document, scene } = &opened;
        let camera = initial_camera(document, scene, f64::from(size[0]) / f64::from(size[1]));
        let mut session = session(Gpu::headless()?)?;
        // The window knows it too, as soon as a background job has found it out.
        let started = Instant::now();
        let mut found = topology(scene, document.view.creases());
        let topology_ms = started.elapsed().as_secs_f64() * 1e3;
        let wall = wall(&camera.orbited(document.up(scene).vector(), MIDDLE, 0.0), scene);
        found.extend(topology(&wall, document.view.creases()));
        let mut with_wall = (**scene).clone();
        with_wall.append(wall);
        let with_wall = Arc::new(with_wall);
        session.renderer().set_scene(&with_wall, &found)?;
        Ok(Self { session, scene: with_wall, opened, size, camera, topology_ms })
    }

    /// How many pixels each depth layer of the model has.
    fn layers(&mut self) -> Result<Vec<u32>, CliError> {
        let look = BenchLook {
            name: "all layers",
            style: blueprint(MAX_LAYERS)?,
            lighting: Lighting::default(),
            behind: Behind::Nothing,
            layers_by: LayersBy::Auto,
        };
        self.frame(&look, MIDDLE)?;
        let reports = self.session.renderer().layer_reports()?;
        let pixels = reports.first().map_or(&[][..], |p| p.pixels.get(..p.layers as usize).unwrap_or(&[]));
        Ok(pixels.to_vec())
    }

    /// Draws what comes before a frame that counts.
    fn get_ready(&mut self, look: &BenchLook, turn: f64) -> Result<(), CliError> {
        for degrees in BEFORE {
            self.frame(look, turn - degrees)?;
        }
        Ok(())
    }

    /// Draws everything in one look, turned by so many degrees; returns milliseconds.
    fn frame(&mut self, look: &BenchLook, turn: f64) -> Result<f64, CliError> {
        let mut document = self.opened.document.clone();
        document.style = look.style.clone();
        document.lighting = look.lighting.clone();
        document.view.layer_method = look.layers_by;
        document.nodes.clear();
        let wall = document.node_mut(WALL);
        wall.visible = Some(look.behind != Behind::Nothing);
        wall.mirror = Some(look.behind == Behind::Mirror);
        let camera = self.camera.orbited(document.up(&self.opened.scene).vector(), turn, 0.0);
        let started = Instant::now();
        self.session.find_stripes(&document, &self.scene)?;
        self.session.renderer().render(&Request {
            document: &document,
            camera: &camera,
            size: self.size,
            transparent: false,
            selected: &[],
            samples: 1,
        })?;
        self.session.renderer().gpu().wait()?;
        Ok(started.elapsed().as_secs_f64() * 1e3)
    }
}

/// A blueprint of so many layers, however small they are.
fn blueprint(layers: u32) -> Result<Style, StyleError> {
    let mut style = preset::load("blueprint")?.style;
    (style.blueprint.max_layers, style.blueprint.min_coverage) = (layers, 0.0);
    Ok(style)
}

/// A blueprint that ends by itself after six layers, of which the next one has so few pixels; `None`: there are no more. An odd
/// number would not do: in solids, layers come in pairs of the same pixels.
fn ending(pixels: &[u32], [width, height]: [u32; 2]) -> Result<Option<Style>, StyleError> {
    let [.., last, next] = pixels.get(..7).unwrap_or(&[]) else { return Ok(None) };
    let mut style = blueprint(MAX_LAYERS)?;
    style.blueprint.min_coverage = 50.0 * (*last as f32 + *next as f32) / (width as f32 * height as f32);
    Ok(Some(style))
}

const ONE: [&str; 2] = ["blueprint, 1 layer", "blueprint, 1 peeled layer"];
const FIVE: [&str; 2] = ["blueprint, 5 layers", "blueprint, 5 peeled layers"];
const SIX: [&str; 2] = ["blueprint, 6 layers", "blueprint, 6 peeled layers"];
/// As many layers as that, but nobody has said that there are no more.
const ENDING: [&str; 2] = ["blueprint, ends after 6", "blueprint, peeled, ends so"];
/// In the same order.
const WAYS: [LayersBy; 2] = [LayersBy::Lists, LayersBy::Peeling];

/// Styles that are timed in the usual light, by name.
fn styles(has_uvs: bool) -> Result<Vec<(&'static str, Style)>, CliError> {
    let gooch = preset::load("gooch")?.style;
    let mut diagonal = gooch.clone();
    diagonal.edges.mode = EdgeMode::ImageSpace;
    let mut c1 = diagonal.clone();
    c1.edges.operator = EdgeOperator::C1;
    let mut no_edges = gooch.clone();
    no_edges.edges.profile.show = false;
    no_edges.edges.inner.show = false;
    let mut metal = no_edges.clone();
    metal.gooch.metal = 1.0;
    let toon = |smoothing| {
        let mut style = no_edges.clone();
        style.technique = Technique::Toon;
        style.toon.smoothing = smoothing;
        style
    };
    let halftone = |space, mapping| {
        let mut style = no_edges.clone();
        style.technique = Technique::Halftone;
        (style.halftone.space, style.halftone.mapping) = (space, mapping);
        style
    };
    let lines = exact(2.0)?;
    let hidden = |layers| {
        let mut style = lines.clone();
        (style.edges.hidden.mode, style.edges.hidden.layers) = (HiddenMode::Dashed, layers);
        style
    };
    let loose = preset::load("loose-ink")?.style;
    let sketch = |anchor, passes| {
        let mut style = loose.clone();
        (style.sketch.wander.anchor, style.sketch.passes) = (anchor, passes);
        style
    };
    let hatching = |mapping, directions| {
        let mut style = lines.clone();
        style.technique = Technique::Hatching;
        (style.hatching.mapping, style.hatching.cross_hatching.directions) = (mapping, directions);
        style.hatching.indication.amount = if mapping == hatching::Mapping::ImageSpace { 0.5 } else { 0.0 };
        style
    };
    let mut styles = vec![
        ("plain", preset::load("plain")?.style),
        ("toon, nearest", toon(Smoothing::Nearest)),
        ("toon, cartoon map", toon(Smoothing::CartoonMap)),
        ("toon, analytic", toon(Smoothing::Analytic)),
        ("halftone, screen", halftone(Space::Screen, Mapping::Triplanar)),
        ("halftone, triplanar", halftone(Space::Surface, Mapping::Triplanar)),
        ("gooch, no edges", no_edges.clone()),
        ("gooch, metal", metal),
        ("gooch + edges, diagonal", diagonal),
        ("gooch + edges, C1", c1),
        ("gooch + edges, 2 px", lines.clone()),
        ("gooch + edges, 32 px", exact(32.0)?),
        ("gooch + hidden lines, next", hidden(HiddenLayers::Next)),
        ("gooch + hidden lines, all", hidden(HiddenLayers::All)),
        ("hatching, one direction", hatching(hatching::Mapping::Stripes, 1)),
        ("hatching, two directions", hatching(hatching::Mapping::Stripes, 2)),
        ("hatching, three directions", hatching(hatching::Mapping::Stripes, 3)),
        ("hatching, on the paper", hatching(hatching::Mapping::ImageSpace, 3)),
        ("lines", preset::load("lines")?.style),
        ("sketch, screen", sketch(Anchor::Screen, 1)),
        ("sketch, surface", sketch(Anchor::Surface, 1)),
        ("sketch, four passes", sketch(Anchor::Surface, 4)),
        ("crayon", preset::load("crayon")?.style),
    ];
    // Without texture coordinates it would be the triplanar one again.
    if has_uvs {
        styles.push(("halftone, uv", halftone(Space::Surface, Mapping::Uv)));
    }
    Ok(styles)
}

fn exact(width: f32) -> Result<Style, CliError> {
    let mut style = preset::load("gooch")?.style;
    (style.edges.profile.width, style.edges.inner.width) = (width, width);
    style.edges.class_mut(EdgeClass::Intersection).width = None;
    Ok(style)
}

/// `pixels`: how many each depth layer of the model has, in a picture of this size.
fn looks(has_uvs: bool, pixels: &[u32], size: [u32; 2]) -> Result<Vec<BenchLook>, CliError> {
    let plain = preset::load("plain")?.style;
    let unshadowed = Lighting::default();
    let hard = Lighting { shadows: true, ..Lighting::default() };
    let soft = Lighting { shadow_softness: 2.0, ..hard.clone() };
    let look = |name, style, lighting: &Lighting| BenchLook {
        name,
        style,
        lighting: lighting.clone(),
        behind: Behind::Nothing,
        layers_by: LayersBy::Auto,
    };
    let mut looks: Vec<BenchLook> =
        styles(has_uvs)?.into_iter().map(|(name, style)| look(name, style, &unshadowed)).collect();
    let mut hatching_image_space = exact(2.0)?;
    hatching_image_space.technique = Technique::Hatching;
    hatching_image_space.hatching.mapping = hatching::Mapping::ImageSpace;
    (
        hatching_image_space.hatching.cross_hatching.directions,
        hatching_image_space.hatching.indication.amount,
    ) = (3, 0.5);
    (hatching_image_space.edges.mode, hatching_image_space.edges.operator) =
        (EdgeMode::ImageSpace, EdgeOperator::Sobel);
    hatching_image_space.hatching.indication.by = DetailBy::Fields;
    looks.push(look("hatching, all of its paper", hatching_image_space, &hard));
    let mut as_in_paper = blueprint(5)?;
    as_in_paper.edges.mode = EdgeMode::ImageSpace;
    for (way, layers_by) in WAYS.into_iter().enumerate() {
        let one = look(ONE[way], blueprint(1)?, &unshadowed);
        let five = look(FIVE[way], blueprint(5)?, &unshadowed);
        let six = look(SIX[way], blueprint(6)?, &unshadowed);
        let ends = ending(pixels, size)?.map(|style| look(ENDING[way], style, &unshadowed));
        looks.extend([one, five, six].into_iter().chain(ends).map(|look| BenchLook { layers_by, ..look }));
    }
    looks.push(look("blueprint, 5, image-space mode", as_in_paper, &unshadowed));
    looks.push(look("blueprint, all layers", blueprint(MAX_LAYERS)?, &unshadowed));
    looks.push(look("plain, shadow", plain.clone(), &hard));
    looks.push(look("plain, soft shadow", plain, &soft));
    for (name, behind) in [("before a wall", Behind::Wall), (MIRROR, Behind::Mirror)] {
        looks.push(BenchLook { behind, ..look(name, exact(2.0)?, &unshadowed) });
    }
    Ok(looks)
}

/// What depth layers cost, ms, made in either way: each one more, to find out that there are no more, and for comparison to
/// traverse the scene once.
fn layer_costs(rows: &[Row]) -> Vec<(&'static str, f64)> {
    let find = |name: &str| rows.iter().find(|row| row.name == name);
    let more = |a: &str, b: &str| {
        let (a, b) = (find(a)?, find(b)?);
        Some(median(&a.frame_ms.iter().zip(&b.frame_ms).map(|(a, b)| b - a).collect::<Vec<_>>()))
    };
    let traversal = |row: &Row| {
        let peel = row.stages.iter().find(|stage| stage.name == "peel")?;
        Some(median(&peel.ms) / peel.passes as f64)
    };
    let costs = [
        ("each layer more, from lists", more(ONE[0], SIX[0]).map(|ms| ms / 5.0)),
        ("each layer more, by peeling", more(ONE[1], SIX[1]).map(|ms| ms / 5.0)),
        ("the end of the layers, from lists", more(SIX[0], ENDING[0])),
        ("the end of the layers, by peeling", more(SIX[1], ENDING[1])),
        ("one traversal of the scene", find(SIX[1]).and_then(traversal)),
    ];
    costs.into_iter().filter_map(|(name, ms)| Some((name, ms?))).collect()
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}

fn report(args: &BenchArgs, bench: &mut Bench, load_ms: f64, rows: &[Row]) -> Result<(), CliError> {
    let adapter = bench.session.renderer().gpu().adapter_name.clone();
    let [w, h] = args.resolution.0;
    let triangles = bench.opened.scene.triangle_count();
    let plain = rows.first().map_or(0.0, |r| median(&r.frame_ms));
    let ratio = |row: &Row| rows.first().map_or(1.0, |plain| row.ratio_to(plain));
    let mirror = match rows {
        [.., wall, mirror] if mirror.name == MIRROR => Some(mirror.ratio_to(wall)),
        _ => None,
    };
    if args.json {
        let styles: Vec<_> = rows
            .iter()
            .map(|row| {
                let stages: serde_json::Map<_, _> =
                    row.stages.iter().map(|stage| (stage.name.to_owned(), json!(median(&stage.ms)))).collect();
                json!({ "style": row.name, "frame_ms": median(&row.frame_ms), "ratio_to_plain": ratio(row), "stages_ms": stages })
            })
            .collect();
        return print_json(&json!({
            "adapter": adapter, "resolution": [w, h], "triangles": triangles, "frames": args.frames,
            "load_ms": load_ms, "topology_ms": bench.topology_ms, "plain_ms": plain, "mirror_ratio": mirror, "styles": styles,
            "layers_ms": layer_costs(rows).into_iter().map(|(name, ms)| (name.to_owned(), json!(ms))).collect::<serde_json::Map<_, _>>(),
        }));
    }
    print_line(&format!("{adapter}, {w} × {h}, {triangles} triangles, median of {} frames", args.frames))?;
    print_line(&format!("loading {load_ms:.0} ms, topology {:.0} ms", bench.topology_ms))?;
    print_line(&format!("{:<26}{:>9}{:>9}   stages (ms)", "style", "ms", "× plain"))?;
    for row in rows {
        let stages: Vec<_> =
            row.stages.iter().map(|stage| format!("{} {:.1}", stage.name, median(&stage.ms))).collect();
        print_line(&format!(
            "{:<26}{:>9.1}{:>9.2}   {}",
            row.name,
            median(&row.frame_ms),
            ratio(row),
            stages.join(", ")
        ))?;
    }
    if let Some(mirror) = mirror {
        print_line(&format!("a mirror: × {mirror:.2} of the frame with a wall in its place"))?;
    }
    for (name, ms) in layer_costs(rows) {
        print_line(&format!("{name}: {ms:.1} ms, × {:.2} of plain", ms / plain.max(1e-9)))?;
    }
    Ok(())
}

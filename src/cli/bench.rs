//! `hachure bench`: milliseconds per stage and frame, and ratios, which hold on noisy machines too.

use std::time::Instant;

use serde_json::json;

use super::args::BenchArgs;
use super::{CliError, print_json, print_line, sample};
use crate::document::Lighting;
use crate::export::Session;
use crate::export::session::{Opened, initial_camera, open, topology};
use crate::gpu::Gpu;
use crate::import::Progress;
use crate::render::Request;
use crate::scene::Camera;
use crate::style::halftone::{Mapping, Space};
use crate::style::toon::Border;
use crate::style::{DepthOperator, EdgeMode, Style, Technique, preset};

/// What is measured: a style in some light.
struct Look {
    name: &'static str,
    style: Style,
    lighting: Lighting,
}

/// One look, measured.
struct Row {
    name: &'static str,
    frame_ms: Vec<f64>,
    stages: Vec<(&'static str, Vec<f64>)>,
}

pub(super) fn run(args: &BenchArgs) -> Result<(), CliError> {
    let files = if args.files.is_empty() { sample().into_iter().collect() } else { args.files.clone() };
    let started = Instant::now();
    let opened = open(&files, None, &Progress::default())?;
    let load_ms = started.elapsed().as_secs_f64() * 1e3;
    let mut bench = Bench::new(opened, args.resolution.0)?;

    let looks = looks()?;
    let mut rows: Vec<Row> =
        looks.iter().map(|look| Row { name: look.name, frame_ms: Vec::new(), stages: Vec::new() }).collect();
    // The looks take turns, so that a slow moment of the machine hits all of them alike.
    for frame in 0..args.frames + WARM_UP {
        for (i, (row, look)) in rows.iter_mut().zip(&looks).enumerate() {
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
            bench.frame(look, turn(frame, i))?;
            for (label, ms) in bench.session.renderer().timings()?.into_iter().filter(|_| frame >= WARM_UP) {
                match row.stages.iter_mut().find(|(known, _)| *known == label) {
                    Some((_, all)) => all.push(ms),
                    None => row.stages.push((label, vec![ms])),
                }
            }
        }
    }
    report(args, &mut bench, load_ms, &rows)
}

/// The first frames compile shaders and fault pages in.
const WARM_UP: u32 = 2;

/// Degrees of a frame's direction: each has one of its own, so that every stage has to run, and those of one round are
/// nearly equal.
fn turn(frame: u32, row: usize) -> f64 {
    f64::from(frame) * 3.0 + row as f64 * 0.01
}

/// A scene on the device, ready to be drawn again and again.
struct Bench {
    session: Session,
    opened: Opened,
    size: [u32; 2],
    camera: Camera,
    topology_ms: f64,
}

impl Bench {
    fn new(opened: Opened, size: [u32; 2]) -> Result<Self, CliError> {
        let Opened { document, scene } = &opened;
        let camera = initial_camera(document, scene, f64::from(size[0]) / f64::from(size[1]));
        let mut session = Session::new(Gpu::headless()?);
        session.set_scene(&opened)?;
        // The window knows it too, as soon as a background job has found it out.
        let started = Instant::now();
        let topology = topology(scene, document.view.crease_angle);
        let topology_ms = started.elapsed().as_secs_f64() * 1e3;
        session.renderer().set_scene(scene, &topology)?;
        Ok(Self { session, opened, size, camera, topology_ms })
    }

    /// Draws everything in one look, turned by so many degrees; returns milliseconds.
    fn frame(&mut self, look: &Look, turn: f64) -> Result<f64, CliError> {
        let mut document = self.opened.document.clone();
        document.style = look.style.clone();
        document.lighting = look.lighting.clone();
        document.nodes.clear();
        let camera = self.camera.orbited(document.up(&self.opened.scene).vector(), turn, 0.0);
        let started = Instant::now();
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

fn looks() -> Result<Vec<Look>, CliError> {
    let gooch = preset::load("gooch")?.style;
    let mut diagonal = gooch.clone();
    diagonal.edges.mode = EdgeMode::Paper;
    let mut c1 = diagonal.clone();
    c1.edges.operator = DepthOperator::C1;
    let mut no_edges = gooch.clone();
    no_edges.edges.profile.show = false;
    no_edges.edges.inner.show = false;
    let mut metal = no_edges.clone();
    metal.gooch.metal = 1.0;
    let toon = |border| {
        let mut style = no_edges.clone();
        style.technique = Technique::Toon;
        style.toon.border = border;
        style
    };
    let halftone = |space, mapping| {
        let mut style = no_edges.clone();
        style.technique = Technique::Halftone;
        (style.halftone.space, style.halftone.mapping) = (space, mapping);
        style
    };
    let exact = |width: f32| {
        let mut style = gooch.clone();
        (style.edges.profile.width, style.edges.inner.width) = (width, width);
        style
    };
    let plain = preset::load("plain")?.style;
    let unshadowed = Lighting::default();
    let hard = Lighting { shadows: true, ..Lighting::default() };
    let soft = Lighting { shadow_softness: 2.0, ..hard.clone() };
    let styles = [
        ("plain", plain.clone()),
        ("toon, nearest", toon(Border::Nearest)),
        ("toon, cartoon map", toon(Border::CartoonMap)),
        ("toon, analytic", toon(Border::Analytic)),
        ("halftone, screen", halftone(Space::Screen, Mapping::Triplanar)),
        ("halftone, triplanar", halftone(Space::Surface, Mapping::Triplanar)),
        ("halftone, uv", halftone(Space::Surface, Mapping::Uv)),
        ("gooch, no edges", no_edges),
        ("gooch, metal", metal),
        ("gooch + edges, diagonal", diagonal),
        ("gooch + edges, C1", c1),
        ("gooch + edges, 2 px", exact(2.0)),
        ("gooch + edges, 32 px", exact(32.0)),
        ("lines", preset::load("lines")?.style),
    ];
    let look = |name, style, lighting: &Lighting| Look { name, style, lighting: lighting.clone() };
    let mut looks: Vec<Look> =
        styles.into_iter().map(|(name, style)| look(name, style, &unshadowed)).collect();
    looks.push(look("plain, shadow", plain.clone(), &hard));
    looks.push(look("plain, soft shadow", plain, &soft));
    Ok(looks)
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
    // Frame by frame against the plain frame drawn beside it.
    let ratio = |row: &Row| {
        let plain = rows.first().map_or(&[][..], |r| &r.frame_ms);
        median(&row.frame_ms.iter().zip(plain).map(|(a, b)| a / b).collect::<Vec<_>>())
    };
    if args.json {
        let styles: Vec<_> = rows
            .iter()
            .map(|row| {
                let stages: serde_json::Map<_, _> =
                    row.stages.iter().map(|(label, ms)| ((*label).to_owned(), json!(median(ms)))).collect();
                json!({ "style": row.name, "frame_ms": median(&row.frame_ms), "ratio_to_plain": ratio(row), "stages_ms": stages })
            })
            .collect();
        return print_json(&json!({
            "adapter": adapter, "resolution": [w, h], "triangles": triangles, "frames": args.frames,
            "load_ms": load_ms, "topology_ms": bench.topology_ms, "plain_ms": plain, "styles": styles,
        }));
    }
    print_line(&format!("{adapter}, {w} × {h}, {triangles} triangles, median of {} frames", args.frames))?;
    print_line(&format!("loading {load_ms:.0} ms, topology {:.0} ms", bench.topology_ms))?;
    print_line(&format!("{:<26}{:>9}{:>9}   stages (ms)", "style", "ms", "× plain"))?;
    for row in rows {
        let stages: Vec<_> =
            row.stages.iter().map(|(label, ms)| format!("{label} {:.1}", median(ms))).collect();
        print_line(&format!(
            "{:<26}{:>9.1}{:>9.2}   {}",
            row.name,
            median(&row.frame_ms),
            ratio(row),
            stages.join(", ")
        ))?;
    }
    Ok(())
}

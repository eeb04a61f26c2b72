//! `hachure bench`: milliseconds per stage and frame, and ratios, which hold on noisy machines too.

use std::time::Instant;

use serde_json::json;

use super::args::BenchArgs;
use super::{CliError, print_json, print_line, sample};
use crate::export::Session;
use crate::export::session::{Opened, initial_camera, open};
use crate::gpu::Gpu;
use crate::import::Progress;
use crate::render::Request;
use crate::style::{DepthOperator, Style, preset};

/// One style, measured.
struct Row {
    name: &'static str,
    frame_ms: Vec<f64>,
    stages: Vec<(&'static str, Vec<f64>)>,
}

pub(super) fn run(args: &BenchArgs) -> Result<(), CliError> {
    let files = if args.files.is_empty() { sample().into_iter().collect() } else { args.files.clone() };
    let started = Instant::now();
    let opened = open(&files, &Progress::default())?;
    let load_ms = started.elapsed().as_secs_f64() * 1e3;
    let mut session = Session::new(Gpu::headless()?);
    session.set_scene(&opened)?;

    let mut rows: Vec<Row> =
        styles()?.iter().map(|(name, _)| Row { name, frame_ms: Vec::new(), stages: Vec::new() }).collect();
    // The styles take turns, so that a slow moment of the machine hits all of them alike.
    for frame in 0..args.frames + 2 {
        for (i, (row, (_, style))) in rows.iter_mut().zip(styles()?).enumerate() {
            measure(&mut session, &opened, args.resolution.0, &style, frame, turn(frame, i), row)?;
        }
    }
    session.renderer().enable_timers();
    for frame in 0..args.frames.min(10) + 2 {
        for (i, (row, (_, style))) in rows.iter_mut().zip(styles()?).enumerate() {
            measure_stages(&mut session, &opened, args.resolution.0, &style, frame, turn(frame, i), row)?;
        }
    }
    report(args, &opened, &mut session, load_ms, &rows)
}

fn styles() -> Result<Vec<(&'static str, Style)>, CliError> {
    let gooch = preset::load("gooch")?.style;
    let mut c1 = gooch.clone();
    c1.edges.operator = DepthOperator::C1;
    let mut no_edges = gooch.clone();
    no_edges.edges.profile.show = false;
    no_edges.edges.inner.show = false;
    Ok(vec![
        ("plain", preset::load("plain")?.style),
        ("gooch, no edges", no_edges),
        ("gooch + edges, diagonal", gooch),
        ("gooch + edges, C1", c1),
        ("lines", preset::load("lines")?.style),
    ])
}

/// Each frame has a direction of its own, so that every stage has to run; those of one round are nearly equal.
fn turn(frame: u32, row: usize) -> f64 {
    f64::from(frame) * 3.0 + row as f64 * 0.01
}

/// Draws one frame, turned by so many degrees.
fn draw(
    session: &mut Session,
    opened: &Opened,
    size: [u32; 2],
    style: &Style,
    turn: f64,
) -> Result<(), CliError> {
    let mut document = opened.document.clone();
    document.style = style.clone();
    document.nodes.clear();
    let up = document.up(&opened.scene).vector();
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    let camera = initial_camera(&document, &opened.scene, aspect).orbited(up, turn, 0.0);
    let renderer = session.renderer();
    renderer.render(&Request {
        document: &document,
        camera: &camera,
        size,
        transparent: false,
        selected: &[],
    })?;
    Ok(())
}

fn measure(
    session: &mut Session,
    opened: &Opened,
    size: [u32; 2],
    style: &Style,
    frame: u32,
    turn: f64,
    row: &mut Row,
) -> Result<(), CliError> {
    let started = Instant::now();
    draw(session, opened, size, style, turn)?;
    session.renderer().gpu().wait()?;
    // The first two frames compile shaders and fault pages in.
    if frame >= 2 {
        row.frame_ms.push(started.elapsed().as_secs_f64() * 1e3);
    }
    Ok(())
}

fn measure_stages(
    session: &mut Session,
    opened: &Opened,
    size: [u32; 2],
    style: &Style,
    frame: u32,
    turn: f64,
    row: &mut Row,
) -> Result<(), CliError> {
    draw(session, opened, size, style, turn)?;
    for (label, ms) in session.renderer().timings()? {
        if frame < 2 {
            continue;
        }
        match row.stages.iter_mut().find(|(known, _)| *known == label) {
            Some((_, all)) => all.push(ms),
            None => row.stages.push((label, vec![ms])),
        }
    }
    Ok(())
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}

fn report(
    args: &BenchArgs,
    opened: &Opened,
    session: &mut Session,
    load_ms: f64,
    rows: &[Row],
) -> Result<(), CliError> {
    let adapter = session.renderer().gpu().adapter_name.clone();
    let [w, h] = args.resolution.0;
    let triangles = opened.scene.triangle_count();
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
            "load_ms": load_ms, "plain_ms": plain, "styles": styles,
        }));
    }
    print_line(&format!("{adapter}, {w} × {h}, {triangles} triangles, median of {} frames", args.frames))?;
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

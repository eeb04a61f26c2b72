//! `hachure info`: what is in a file.

use serde_json::json;

use super::args::InfoArgs;
use super::{CliError, print_json, print_line};
use crate::export::session::{Opened, open};
use crate::geometry::Mended;
use crate::import::Progress;
use crate::scene::AlphaMode;

pub(super) fn run(args: &InfoArgs) -> Result<(), CliError> {
    let opened = open(&args.files, |_| {}, &Progress::default())?;
    if args.json { as_json(&opened) } else { as_text(&opened) }
}

fn as_text(opened: &Opened) -> Result<(), CliError> {
    let Opened { document, scene } = opened;
    for (node, resolved) in scene.nodes.iter().zip(document.resolve(scene)) {
        let depth = node.path.matches('/').count().saturating_sub(1);
        let mesh = node.mesh.and_then(|m| scene.meshes.get(m));
        let triangles = mesh.map_or(String::new(), |m| format!("  {} triangles", m.triangle_count()));
        let hidden = if resolved.visible { "" } else { "  hidden" };
        print_line(&format!("{}{}{triangles}{hidden}", "  ".repeat(depth), node.path))?;
    }
    let bounds = scene.bounds();
    let size = bounds.max - bounds.min;
    print_line(&format!(
        "{} nodes, {} meshes, {} triangles, {} materials, {} images, {} cameras, {} lights",
        scene.nodes.len(),
        scene.meshes.len(),
        scene.triangle_count(),
        scene.materials.len(),
        scene.textures.len(),
        scene.cameras.len(),
        scene.lights.len(),
    ))?;
    print_line(&format!("bounds {} to {}, size {size}", bounds.min, bounds.max))?;
    let unit = match document.meters_per_unit(scene) {
        Some(meters) => format!("{meters} m"),
        None => "not stated".to_owned(),
    };
    print_line(&format!("up {}, unit {unit}", document.up(scene).name()))?;
    let mended = Mended::of_all(scene.meshes.iter().filter_map(|mesh| mesh.mended.as_ref()));
    if let Some(mended) = mended {
        print_line(&format!(
            "seams: {:.1} % of {} of borders were joined, by up to {:.2e}; {} vertices were added",
            100.0 * mended.joined_length / mended.border_length,
            mended.border_length as f32,
            mended.farthest_move,
            mended.added_vertices,
        ))?;
    }
    for warning in &scene.warnings {
        print_line(&format!("warning: {warning}"))?;
    }
    Ok(())
}

fn as_json(opened: &Opened) -> Result<(), CliError> {
    let Opened { document, scene } = opened;
    let nodes: Vec<_> = scene
        .nodes
        .iter()
        .zip(document.resolve(scene))
        .map(|(node, resolved)| {
            json!({
                "path": node.path,
                "triangles": node.mesh.and_then(|m| scene.meshes.get(m)).map(|m| m.triangle_count()),
                "mesh": node.mesh,
                "visible": resolved.visible,
                "enhanced": resolved.enhanced,
            })
        })
        .collect();
    let meshes: Vec<_> = scene
        .meshes
        .iter()
        .map(|m| {
            json!({
                "vertices": m.positions.len(),
                "triangles": m.triangle_count(),
                "normals": !m.normals.is_empty(),
                "uvs": !m.uvs.is_empty(),
                "colors": !m.colors.is_empty(),
                "mended": m.mended.map(|mended| json!({
                    "border_length": mended.border_length,
                    "joined_length": mended.joined_length,
                    "tolerance": mended.tolerance,
                    "open_gap": mended.open_gap,
                    "farthest_move": mended.farthest_move,
                    "added_vertices": mended.added_vertices,
                    "dropped_triangles": mended.dropped_triangles,
                })),
                "materials": m.submeshes.iter().map(|p| p.material).collect::<Vec<_>>(),
            })
        })
        .collect();
    let materials: Vec<_> = scene
        .materials
        .iter()
        .map(|m| {
            json!({
                "name": m.name,
                "base_color": m.base_color.to_array(),
                "base_color_texture": m.base_color_texture.as_ref().map(|t| t.texture),
                "normal_texture": m.normal_texture.as_ref().map(|t| t.texture),
                "alpha_cutoff": match m.alpha { AlphaMode::Mask(cutoff) => Some(cutoff), _ => None },
                "blends": m.alpha == AlphaMode::Blend,
                "double_sided": m.double_sided,
                "unlit": m.unlit,
            })
        })
        .collect();
    let bounds = scene.bounds();
    print_json(&json!({
        "models": document.models.iter().map(|path| path.to_string_lossy()).collect::<Vec<_>>(),
        "triangles": scene.triangle_count(),
        "bounds": (!bounds.is_empty()).then(|| json!({ "min": bounds.min.to_array(), "max": bounds.max.to_array() })),
        "up": document.up(scene).name(),
        "meters_per_unit": document.meters_per_unit(scene),
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "images": scene.textures.iter().map(|t| json!({ "name": t.name, "width": t.width, "height": t.height })).collect::<Vec<_>>(),
        "cameras": scene.cameras.iter().map(|(name, _)| name).collect::<Vec<_>>(),
        "lights": scene.lights.len(),
        "warnings": scene.warnings.iter().map(|w| json!({ "place": w.place, "message": w.message })).collect::<Vec<_>>(),
    }))
}

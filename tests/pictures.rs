//! Golden pictures: each is one call of `hachure render`, compared with the picture in `tests/pictures/`.
//!
//! `make bless` shows what changed and, after a look, accepts it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use hachure::gpu::Gpu;
use image::RgbaImage;

/// Structural similarity (1 = equal) that a picture must reach in its worst channel.
const SIMILARITY: f64 = 0.985;
/// A pixel whose difference is greater than this, in 255ths, has changed.
const CHANGED: u8 = 32;
/// So many pixels of a block of [`BLOCK`] × [`BLOCK`] may have changed: a device rounds single ones otherwise, but a line that
/// runs elsewhere changes all along it.
const MAX_CHANGED: usize = 6;
/// The same on other devices than the software one that drew the pictures. On a graphics card up to 26 were measured.
const MAX_CHANGED_ELSEWHERE: usize = 32;
const BLOCK: u32 = 16;

// Widths as people set them; a picture of 256 pixels has about a quarter of a pixel for each.
const PROFILE_1: &str = "edges.profile.width=1";
const INNER_1: &str = "edges.inner.width=1";
const PROFILE_4: &str = "edges.profile.width=4";
const INNER_4: &str = "edges.inner.width=4";
const PROFILE_16: &str = "edges.profile.width=16";
const INNER_16: &str = "edges.inner.width=16";

/// Name, model (or a document beside the pictures) and further arguments of every golden picture.
const PICTURES: &[(&str, &str, &[&str])] = &[
    ("gooch_crank", "crank", &["--style", "gooch"]),
    ("gooch_ogre", "ogre", &["--style", "gooch"]),
    ("blueprint_crank", "crank", &["--style", "blueprint"]),
    ("blueprint_white_on_blue_crank", "crank", &["--style", "blueprint-white-on-blue"]),
    ("blueprint_vellum_crank", "crank", &["--style", "blueprint-vellum"]),
    ("wireframe_crank", "crank", &["--style", "wireframe"]),
    (
        "blueprint_mask_temple",
        "temple",
        &[
            "--style",
            "blueprint",
            "--mask",
            "/temple/statues/*",
            "--set",
            "blueprint.beyond=false",
            "--camera-azimuth-angle=-20",
            "--camera-elevation-angle=25",
        ],
    ),
    ("hidden_lines_crank", "crank", &["--style", "hidden-lines", "--set", "edges.hidden.layers=next"]),
    ("x_ray_ogre", "ogre", &["--style", "x-ray"]),
    ("comic_ogre", "ogre", &["--style", "comic"]),
    ("two_tone_crank", "crank", &["--style", "two-tone"]),
    ("plain_crank", "crank", &["--style", "plain"]),
    ("technical_illustration_crank", "crank", &["--style", "technical-illustration"]),
    ("instruction_manual_crank", "crank", &["--style", "instruction-manual"]),
    ("patent_drawing_crank", "crank", &["--style", "patent-drawing"]),
    ("line_drawing_ogre", "ogre", &["--style", "line-drawing"]),
    ("clay_with_ink_ogre", "ogre", &["--style", "clay-with-ink"]),
    ("milled_metal_crank", "crank", &["--style", "milled-metal"]),
    ("matcap_ogre", "ogre", &["--style", "matcap", "--set", "light.shadows=on"]),
    ("polished_steel_crank", "crank", &["--style", "polished-steel"]),
    ("porcelain_crank", "crank", &["--style", "porcelain"]),
    ("jade_ogre", "ogre", &["--style", "jade"]),
    ("engraving_ogre", "ogre", &["--style", "engraving"]),
    ("pen_and_ink_temple", "temple", &["--style", "pen-and-ink", "--set", "light.shadows=on"]),
    ("woodcut_ogre", "ogre", &["--style", "woodcut"]),
    ("pencil_hatching_crank", "crank", &["--style", "pencil-hatching"]),
    ("cross_hatch_crank", "crank", &["--style", "cross-hatch"]),
    ("stipple_ogre", "ogre", &["--style", "stipple"]),
    ("stroke_directions_crank", "crank", &["--style", "stroke-directions"]),
    (
        "hatching_uv_still_life",
        "still_life",
        &["--style", "pen-and-ink", "--set", "hatching.mapping=uv", "--set", "hatching.stroke.spacing=24"],
    ),
    ("pencil_draft_crank", "crank", &["--style", "pencil-draft"]),
    ("architects_sketch_temple", "temple", &["--style", "architects-sketch"]),
    ("crayon_ogre", "ogre", &["--style", "crayon"]),
    ("chalk_on_slate_crank", "crank", &["--style", "chalk-on-slate"]),
    ("charcoal_ogre", "ogre", &["--style", "charcoal"]),
    ("ballpoint_ogre", "ogre", &["--style", "ballpoint"]),
    ("loose_ink_cloister", "cloister", &["--style", "loose-ink"]),
    (
        "sketch_on_screen_ogre",
        "ogre",
        &["--style", "loose-ink", "--set", "sketch.anchor=screen", "--set", "sketch.noise=turbulence"],
    ),
    (
        "sketch_enlarged_ogre",
        "ogre",
        &["--style", "loose-ink", "--set", "sketch.anchor=curvature", "--set", "sketch.exterior=enlarged"],
    ),
    ("newspaper_ogre", "ogre", &["--style", "newspaper", "--set", "halftone.scale=30"]),
    (
        "shadows_ogre",
        "ogre",
        &["--style", "gooch", "--set", "light.shadows=true", "--set", "light.key.azimuth=-55"],
    ),
    (
        "still_life",
        "still_life",
        &[
            "--style",
            "comic",
            "--mirror",
            "glass",
            "--set",
            "edges.texture.show=true",
            "--set",
            "edges.relief.show=true",
            "--set",
            "light.shadows=true",
            "--set",
            "edges.shadow.show=true",
        ],
    ),
    ("lines_crank", "crank", &["--style", "lines"]),
    ("lines_paper_crank", "crank", &["--style", "lines", "--set", "edges.mode=image_space"]),
    ("width_1_crank", "crank", &["--style", "lines", "--set", PROFILE_1, "--set", INNER_1]),
    ("width_4_crank", "crank", &["--style", "lines", "--set", PROFILE_4, "--set", INNER_4]),
    ("width_16_crank", "crank", &["--style", "lines", "--set", PROFILE_16, "--set", INNER_16]),
    (
        "classes_crank",
        "crank",
        &[
            "--style",
            "lines",
            "--set",
            PROFILE_4,
            "--set",
            INNER_4,
            "--set",
            "edges.silhouette.color=#c02020",
            "--set",
            "edges.object.color=#e08000",
            "--set",
            "edges.ridge.color=#2050c0",
            "--set",
            "edges.valley.color=#108040",
            "--set",
            "edges.intersection.color=#a020a0",
        ],
    ),
    (
        "lines_c1_crank",
        "crank",
        &["--style", "lines", "--set", "edges.mode=image_space", "--set", "edges.operator=c1"],
    ),
    ("statue_ogre", "ogre", &["--style", "statue"]),
    ("unlit_ogre", "ogre", &["--style", "plain", "--set", "technique=unlit"]),
    ("normals_crank", "crank", &["--set", "view.show=normals"]),
    ("depth_crank", "crank", &["--set", "view.show=depth"]),
    ("surfaces_crank", "crank", &["--set", "view.show=surfaces"]),
    ("edge_map_ogre", "ogre", &["--set", "edges.mode=image_space", "--set", "view.show=edge_map"]),
    (
        "mixed_crank",
        "crank",
        &[
            "--style",
            "statue",
            "--object-style",
            "piston*=gooch",
            "--object-style",
            "flywheel=lines",
            "--set",
            "rod*:edges.profile.color=#d02020",
            "--no-enhance",
            "pulley",
            "--hide",
            "timing_gear",
        ],
    ),
    (
        "orthographic_crank",
        "crank",
        &["--camera-orthographic", "--camera-azimuth-angle", "0", "--camera-elevation-angle", "90"],
    ),
    (
        "section_temple",
        "temple",
        &["--style", "lines", "--section", "y=2", "--camera-orthographic", "--look-from", "top"],
    ),
    ("glyphs", "glyphs.hachure", &["--style", "blueprint", "--object-style", "flywheel=plain"]),
    ("transparent_ogre", "ogre", &["--no-background", "--camera-azimuth-angle=-40"]),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/pictures")
}

fn render(model: &str, args: &[&str], output: &Path) {
    let model = if model.ends_with(".hachure") {
        folder().join(model)
    } else {
        Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/models/{model}.glb"))
    };
    let result = Command::new(env!("CARGO_BIN_EXE_hachure"))
        .arg("render")
        .arg(model)
        .args(args)
        .args(["--resolution", "256,256", "--samples", "1", "--output"])
        .arg(output)
        .output()
        .unwrap();
    assert!(result.status.success(), "{}", String::from_utf8_lossy(&result.stderr));
}

/// Structural similarity of color over white and of alpha, the worse of the two.
fn similarity(a: &RgbaImage, b: &RgbaImage) -> f64 {
    if a.dimensions() != b.dimensions() {
        return 0.0;
    }
    image_compare::rgba_hybrid_compare(a, b).unwrap().score
}

/// Absolute differences, dark where equal.
fn difference(a: &RgbaImage, b: &RgbaImage) -> RgbaImage {
    RgbaImage::from_fn(a.width(), a.height(), |x, y| {
        let (a, b) = (a.get_pixel(x, y), b.get_pixel_checked(x, y).copied().unwrap_or(image::Rgba([0; 4])));
        let d = |i: usize| a.0[i].abs_diff(b.0[i]).max(a.0[3].abs_diff(b.0[3]));
        image::Rgba([d(0), d(1), d(2), 255])
    })
}

/// The most pixels that have changed in any block.
fn max_changed(a: &RgbaImage, b: &RgbaImage) -> usize {
    let mut blocks = HashMap::<[u32; 2], usize>::new();
    for (x, y, image::Rgba([r, g, b, _])) in difference(a, b).enumerate_pixels() {
        if *r.max(g).max(b) > CHANGED {
            // Blocks overlap by half, so that none cuts what it should see.
            for [column, row] in [[0, 0], [0, 1], [1, 0], [1, 1]] {
                let half = |at: u32, further: u32| 2 * at / BLOCK + further;
                *blocks.entry([half(x, column), half(y, row)]).or_default() += 1;
            }
        }
    }
    blocks.into_values().max().unwrap_or(0)
}

/// What a person would see that is not as it was, where so many pixels of a block may have changed.
fn fault(known: &RgbaImage, drawn: &RgbaImage, max_changed_pixels: usize) -> Option<String> {
    let similarity = similarity(known, drawn);
    if similarity < SIMILARITY {
        return Some(format!("similarity {similarity:.4}"));
    }
    let changed = max_changed(known, drawn);
    (changed > max_changed_pixels).then(|| format!("{changed} pixels beside each other"))
}

#[test]
fn pictures_look_as_they_did() {
    let is_software = Gpu::headless().unwrap().adapter_name.starts_with("llvmpipe");
    let max_changed_pixels = if is_software { MAX_CHANGED } else { MAX_CHANGED_ELSEWHERE };
    let mut changed = Vec::new();
    for (name, model, args) in PICTURES {
        let golden = folder().join(format!("{name}.png"));
        let new = folder().join(format!("{name}.new.png"));
        let diff = folder().join(format!("{name}.diff.png"));
        render(model, args, &new);
        let drawn = image::open(&new).unwrap().into_rgba8();
        let known = image::open(&golden).map(image::DynamicImage::into_rgba8).ok();
        let Some(fault) =
            known.as_ref().map_or(Some("new".to_owned()), |known| fault(known, &drawn, max_changed_pixels))
        else {
            std::fs::remove_file(&new).unwrap();
            let _ = std::fs::remove_file(&diff);
            continue;
        };
        if let Some(known) = known {
            difference(&drawn, &known).save(&diff).unwrap();
        }
        changed.push(format!("{name}: {fault}, see {}", new.display()));
    }
    assert!(changed.is_empty(), "pictures changed; look at them, then `make bless`:\n{}", changed.join("\n"));
}

#[test]
fn there_is_a_picture_of_every_preset() {
    for preset in hachure::style::preset::all() {
        let is_it = |args: &[&str]| args.windows(2).any(|pair| pair == ["--style", preset.id.as_str()]);
        assert!(PICTURES.iter().any(|(.., args)| is_it(args)), "{}", preset.id);
    }
}

fn golden(name: &str) -> RgbaImage {
    image::open(folder().join(format!("{name}.png"))).unwrap().into_rgba8()
}

#[test]
fn the_comparison_sees_what_a_person_would_see() {
    let known = golden("gooch_crank");
    let mut inverted = known.clone();
    image::imageops::invert(&mut inverted);
    for other in [&inverted, &golden("plain_crank")] {
        assert!(fault(&known, other, MAX_CHANGED).is_some());
    }
    for (name, ..) in PICTURES {
        let known = golden(name);
        assert_eq!(fault(&known, &known, MAX_CHANGED), None);
        let mut shifted = known.clone();
        image::imageops::replace(&mut shifted, &known, 1, 0);
        assert!(fault(&known, &shifted, MAX_CHANGED).is_some(), "{name}: shifted by a pixel");
    }
}

/// How many rows of a part of a picture are crossed by a border that nobody overlooks.
fn rows_with_border(picture: &RgbaImage, [left, top]: [u32; 2]) -> usize {
    let value = |x: u32, y: u32| i32::from(picture.get_pixel(x, y).0[1]);
    let is_crossed = |y: u32| {
        (left..left + BLOCK - 1).any(|x| (value(x, y) - value(x + 1, y)).abs() > 3 * i32::from(CHANGED))
    };
    (top..top + BLOCK).filter(|y| is_crossed(*y)).count()
}

#[test]
fn the_comparison_sees_a_piece_of_line_that_is_shifted_by_a_pixel() {
    let mut pieces = 0;
    for (name, ..) in PICTURES {
        let known = golden(name);
        let places =
            (0..known.width() / BLOCK).flat_map(|x| (0..known.height() / BLOCK).map(move |y| [x, y]));
        for [left, top] in places.map(|place| place.map(|number| number * BLOCK)) {
            if rows_with_border(&known, [left, top]) < BLOCK as usize {
                continue;
            }
            let piece = image::imageops::crop_imm(&known, left, top, BLOCK - 1, BLOCK).to_image();
            let mut shifted = known.clone();
            image::imageops::replace(&mut shifted, &piece, i64::from(left) + 1, i64::from(top));
            assert!(fault(&known, &shifted, MAX_CHANGED).is_some(), "{name}: a piece at {left}, {top}");
            pieces += 1;
        }
    }
    assert!(pieces > 100, "{pieces}");
}

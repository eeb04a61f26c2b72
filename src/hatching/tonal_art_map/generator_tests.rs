use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use super::*;
use crate::hatching::tonal_art_map::stroke::Brush;
use crate::hatching::tonal_art_map::stroke_image::StrokeImage;

fn recipe() -> Recipe {
    Recipe { side: 128, levels: 3, candidates: 60, ..Recipe::default() }
}

fn draw(recipe: &Recipe) -> DrawnMap {
    recipe.draw(&|_| true).unwrap()
}

fn mean(texels: &[u8]) -> f32 {
    texels.iter().map(|ink| f32::from(*ink)).sum::<f32>() / (255 * texels.len()) as f32
}

fn shapes() -> Vec<StrokeShape> {
    let wedge: Vec<f32> = (0..64 * 8).map(|i| if i % 64 > 8 * (i / 64) { 0.1 } else { 1.0 }).collect();
    let image = Some(Arc::new(StrokeImage::new(64, 8, &wedge).unwrap()));
    let pencil = StrokeShape { width: 3.0, pressure: 0.7, grain: 0.5, ..StrokeShape::default() };
    let dots = StrokeShape { length: 0.0, width: 3.0, ..StrokeShape::default() };
    vec![StrokeShape::default(), pencil, dots, StrokeShape { width: 4.0, image, ..StrokeShape::default() }]
}

#[test]
fn each_level_has_the_ink_of_each_tone() {
    for shape in shapes() {
        let map = draw(&Recipe { shape, ..recipe() }).map;
        for level in &map.levels {
            for (texels, ink) in level.tones.iter().zip(SIX_TONES) {
                assert!(
                    (mean(texels) - ink).abs() <= INK_TOLERANCE,
                    "{}: {} {ink}",
                    level.side,
                    mean(texels)
                );
            }
        }
    }
}

#[test]
fn strokes_of_a_tone_are_in_all_darker_ones() {
    for shape in shapes() {
        for level in draw(&Recipe { shape, ..recipe() }).map.levels {
            for (lighter, darker) in level.tones.iter().zip(&level.tones[1..]) {
                assert!(lighter.iter().zip(darker).all(|(lighter, darker)| lighter <= darker));
            }
        }
    }
}

#[test]
fn strokes_of_a_level_are_in_all_finer_ones() {
    let recipe = recipe();
    let drawn = draw(&recipe);
    // Each tone of each level is its own strokes, those of coarser levels and lighter tones, and nothing else.
    for (number, level) in drawn.map.levels.iter().enumerate() {
        let brush = Brush::new(&recipe.shape, level.side);
        for (tone, texels) in level.tones.iter().enumerate() {
            let mut paper = vec![1.0; level.side * level.side];
            for placed in drawn.strokes.iter().filter(|s| s.level >= number && s.tone <= tone) {
                brush.visit(&placed.stroke, |texel, ink| paper[texel] *= 1.0 - ink);
            }
            let inks: Vec<u8> = paper.iter().map(|paper| ((1.0 - paper) * 255.0f32).round() as u8).collect();
            assert!(inks == *texels, "level {number}, tone {tone}");
        }
    }
    for level in 0..3 {
        assert!(drawn.strokes.iter().any(|stroke| stroke.level == level), "{level}");
    }
    // In the picture: below a dark texel there is a dark one.
    for (fine, coarse) in drawn.map.levels.iter().zip(&drawn.map.levels[1..]) {
        let dark = (0..coarse.side * coarse.side).filter(|i| coarse.tones[0][*i] > 200);
        let lost = dark.filter(|i| {
            let (x, y) = (2 * (i % coarse.side), 2 * (i / coarse.side));
            let around = (0..16).map(|n| (x + fine.side + n % 4 - 1, y + fine.side + n / 4 - 1));
            let mut inks = around.map(|(x, y)| fine.tones[0][y % fine.side * fine.side + x % fine.side]);
            !inks.any(|ink| ink > 128)
        });
        assert_eq!(lost.count(), 0);
    }
}

/// Mean difference of texels on both sides of each column and of each row.
fn steps(side: usize, texels: &[u8]) -> [Vec<f32>; 2] {
    let at = |x: usize, y: usize| f32::from(texels[y % side * side + x % side]);
    let mean = |sum: f32| sum / side as f32;
    [
        (0..side).map(|x| mean((0..side).map(|y| (at(x, y) - at(x + 1, y)).abs()).sum())).collect(),
        (0..side).map(|y| mean((0..side).map(|x| (at(x, y) - at(x, y + 1)).abs()).sum())).collect(),
    ]
}

#[test]
fn tiles_have_no_seams() {
    let level = &draw(&Recipe { levels: 1, ..recipe() }).map.levels[0];
    for texels in &level.tones {
        let steps = steps(level.side, texels);
        for steps in &steps {
            let (seam, others) = steps.split_last().unwrap();
            let mean = others.iter().sum::<f32>() / others.len() as f32;
            let spread =
                (others.iter().map(|s| (s - mean) * (s - mean)).sum::<f32>() / others.len() as f32).sqrt();
            assert!((seam - mean).abs() < 4.0 * spread, "{seam}: {mean} ± {spread}");
        }
    }
    // The same is not true of a tile that is cut off in the middle.
    let half = level.side / 2;
    let quarter: Vec<u8> =
        (0..half * half).map(|i| level.tones[0][i / half * level.side + i % half]).collect();
    let [columns, _] = steps(half, &quarter);
    let (seam, others) = columns.split_last().unwrap();
    assert!(*seam > 2.0 * others.iter().sum::<f32>() / others.len() as f32);
}

#[test]
fn strokes_are_spread_evenly() {
    let level = &draw(&Recipe { levels: 1, candidates: 200, ..recipe() }).map.levels[0];
    // Means of blocks of 32 texels; strokes thrown anywhere give about 0.08 at a seventh of ink.
    for texels in &level.tones {
        let blocks: Vec<f32> = (0..16)
            .map(|b| {
                let texel = |i: usize| texels[(b / 4 * 32 + i / 32) * 128 + b % 4 * 32 + i % 32];
                mean(&(0..1024).map(texel).collect::<Vec<_>>())
            })
            .collect();
        let all = mean(texels);
        let spread = (blocks.iter().map(|b| (b - all) * (b - all)).sum::<f32>() / 16.0).sqrt();
        assert!(spread < 0.05, "{all}: {spread}");
    }
}

#[test]
fn priorities_give_all_tones() {
    for shape in shapes() {
        for level in draw(&Recipe { shape, ..recipe() }).map.levels {
            assert!(level.priorities.iter().all(|p| p.thresholds.is_sorted() && p.inks.is_sorted()));
            let picture = |ink: f32| -> Vec<f32> { level.priorities.iter().map(|p| p.ink_at(ink)).collect() };
            let texels = (level.side * level.side) as f32;
            for tone in 0..=48 {
                let ink = tone as f32 / 64.0;
                let found = picture(ink).iter().sum::<f32>() / texels;
                assert!((found - ink).abs() < 0.005, "{ink}: {found}");
            }
            for (tone, ink) in level.tones.iter().zip(SIX_TONES) {
                let picture = picture(ink);
                let off = picture.iter().zip(tone).map(|(p, t)| (p - f32::from(*t) / 255.0).powi(2));
                let rms = (off.sum::<f32>() / texels).sqrt();
                assert!(rms < 0.15, "{}, {ink}: {rms}", level.side);
            }
        }
    }
}

#[test]
fn the_same_recipe_gives_the_same_map() {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let four = rayon::ThreadPoolBuilder::new().num_threads(4).build().unwrap();
    let recipe = Recipe { side: 64, levels: 2, candidates: 300, ..recipe() };
    let first = one.install(|| draw(&recipe));
    assert!(first == four.install(|| draw(&recipe)));
    assert!(first.map != draw(&Recipe { seed: 2, ..recipe }).map);
}

#[test]
fn progress_grows_and_can_stop_the_work() {
    let last = AtomicU32::new(0);
    let hears = |share: f32| {
        let before = f32::from_bits(last.swap(share.to_bits(), Ordering::Relaxed));
        assert!((0.0..=1.0).contains(&share) && share >= before);
        share < 0.4
    };
    assert!(recipe().draw(&hears) == Err(RecipeError::Canceled));
    let share = f32::from_bits(last.load(Ordering::Relaxed));
    assert!((0.4..0.5).contains(&share), "{share}");
}

#[test]
fn bad_recipes_are_refused() {
    let refuses = |recipe: &Recipe| recipe.draw(&|_| true).unwrap_err();
    for (width, name) in [(f32::NAN, "width"), (0.0, "width"), (99.0, "width")] {
        let shape = StrokeShape { width, ..StrokeShape::default() };
        let error = refuses(&Recipe { shape, ..recipe() });
        assert!(matches!(error, RecipeError::Range { name: found, .. } if found == name), "{error}");
    }
    for inks in [vec![], vec![0.3, 0.3], vec![0.4, 0.2]] {
        let error = refuses(&Recipe { inks, ..recipe() });
        assert!(matches!(error, RecipeError::Order { .. }), "{error}");
    }
    for ink in [f32::NAN, 0.0, 1.0] {
        let error = refuses(&Recipe { inks: vec![ink], ..recipe() });
        assert!(matches!(error, RecipeError::Range { name: "inks", .. }), "{error}");
    }
    for (side, levels) in [(0, 1), (100, 1), (4096, 1), (64, 0), (64, 4), (64, 99)] {
        let error = refuses(&Recipe { side, levels, ..recipe() });
        assert!(matches!(error, RecipeError::Levels { .. }), "{error}");
    }
}

#[test]
fn strokes_without_ink_are_an_error() {
    let image = Some(Arc::new(StrokeImage::new(8, 2, &[0.97; 16]).unwrap()));
    let shape = StrokeShape { pressure: 0.05, image, ..StrokeShape::default() };
    let error = Recipe { shape, ..recipe() }.draw(&|_| true).unwrap_err();
    assert!(matches!(error, RecipeError::TooFaint { reached: 0.0, .. }), "{error}");
}

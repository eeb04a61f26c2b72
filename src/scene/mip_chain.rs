//! Images in all sizes, so that they are smooth from afar.

use rayon::prelude::*;

use super::Texture;
use crate::style::color;

/// An image at one size: width, height, and 8-bit RGBA, rows from the top.
pub type Level = (u32, u32, Vec<u8>);

/// The image and its halvings down to one texel, averaged in linear light where it is sRGB.
pub fn mip_chain(image: &Texture, srgb: bool) -> Vec<Level> {
    let to_linear: Vec<f32> =
        (0..=255u8).map(|c| if srgb { color::linear_from_srgb(c) } else { f32::from(c) / 255.0 }).collect();
    let to_byte =
        |linear: f32| if srgb { color::srgb_from_linear(linear) } else { (linear * 255.0).round() as u8 };
    let mut levels = vec![(image.width, image.height, image.rgba.to_vec())];
    while let Some((width, height, texels)) = levels.last().filter(|(w, h, _)| w.max(h) > &1) {
        let (w, h) = ((width / 2).max(1), (height / 2).max(1));
        let mut half = vec![0u8; (w * h * 4) as usize];
        half.par_chunks_mut(w as usize * 4).enumerate().for_each(|(y, row)| {
            for (x, out) in row.chunks_exact_mut(4).enumerate() {
                let corners = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| {
                    let sx = (x * 2 + dx).min(*width as usize - 1);
                    let sy = (y * 2 + dy).min(*height as usize - 1);
                    (sy * *width as usize + sx) * 4
                });
                for (channel, byte) in out.iter_mut().enumerate() {
                    let texel = |c: usize| texels.get(c + channel).copied().unwrap_or(0);
                    *byte = if channel == 3 {
                        (corners.iter().map(|c| u32::from(texel(*c))).sum::<u32>() / 4) as u8
                    } else {
                        to_byte(corners.iter().map(|c| to_linear[usize::from(texel(*c))]).sum::<f32>() * 0.25)
                    };
                }
            }
        });
        levels.push((w, h, half));
    }
    levels
}

//! The built-in ramps of toon shading.

use super::Color;
use super::slot::choice;

choice! {
    /// Where the shades of a toon come from.
    pub enum Ramp {
        /// A few flat bands, in colors of one's own.
        #[default]
        Bands,
        /// From lavender shadows to white without a step.
        Soft,
        /// Shadow and light, with a narrow soft border.
        TwoStep,
        /// Flat bands from blue shadows to warm light.
        WarmCool,
        /// Washes of gray ink, darker where each of them ends.
        InkWash,
        /// The texels of an image.
        Image,
    }
}

/// A ramp in so many even bands; the color of each lies between the stops around it, which have places from 0
/// (shadow) to 1 (light).
struct Stops {
    bands: usize,
    stops: &'static [(f32, [u8; 3])],
}

/// Many enough to be seen as a gradient.
const SMOOTH: usize = 96;

impl Ramp {
    fn stops(self) -> Option<Stops> {
        let (bands, stops): (_, &[_]) = match self {
            Self::Bands | Self::Image => return None,
            Self::Soft => {
                (SMOOTH, &[(0.0, [104, 99, 132]), (0.45, [196, 191, 212]), (0.85, [255; 3]), (1.0, [255; 3])])
            }
            Self::TwoStep => (
                SMOOTH,
                &[(0.0, [128, 122, 156]), (0.46, [134, 128, 162]), (0.54, [250; 3]), (1.0, [255; 3])],
            ),
            Self::WarmCool => (
                6,
                &[
                    (0.0, [70, 84, 150]),
                    (0.2, [104, 110, 172]),
                    (0.4, [160, 142, 182]),
                    (0.6, [222, 178, 160]),
                    (0.8, [250, 216, 168]),
                    (1.0, [255, 246, 220]),
                ],
            ),
            Self::InkWash => (
                SMOOTH,
                &[
                    (0.0, [58, 58, 66]),
                    (0.12, [52, 52, 60]),
                    (0.15, [132, 132, 138]),
                    (0.37, [112, 112, 119]),
                    (0.40, [188, 188, 190]),
                    (0.66, [168, 168, 171]),
                    (0.69, [246, 245, 241]),
                    (1.0, [255; 3]),
                ],
            ),
        };
        Some(Stops { bands, stops })
    }

    /// Its colors from shadow to light, in even steps as displayed; `None` where they are set elsewhere.
    pub fn colors(self) -> Option<Vec<Color>> {
        let Stops { bands, stops } = self.stops()?;
        Some((0..bands).map(|band| color_at(stops, band as f32 / (bands - 1) as f32)).collect())
    }
}

fn color_at(stops: &[(f32, [u8; 3])], place: f32) -> Color {
    let after = stops.iter().position(|(at, _)| *at >= place).unwrap_or(stops.len() - 1).max(1);
    let ((from, dark), (to, light)) = (stops[after - 1], stops[after]);
    Color(dark).mixed(Color(light), (place - from) / (to - from))
}

#[cfg(test)]
mod tests {
    use strum::VariantNames as _;

    use super::*;

    #[test]
    fn ramps_begin_and_end_at_their_stops_and_these_rise() {
        let mut built_in = 0;
        for name in Ramp::VARIANTS {
            let ramp: Ramp = name.parse().unwrap();
            let (Some(colors), Some(Stops { bands, stops })) = (ramp.colors(), ramp.stops()) else {
                continue;
            };
            built_in += 1;
            assert_eq!(colors.len(), bands);
            assert_eq!((colors[0].0, colors[bands - 1].0), (stops[0].1, stops[stops.len() - 1].1), "{name}");
            assert_eq!((stops[0].0, stops[stops.len() - 1].0), (0.0, 1.0), "{name}");
            assert!(stops.is_sorted_by(|a, b| a.0 < b.0), "{name}");
        }
        assert_eq!(built_in, 4);
        assert_eq!(color_at(&[(0.0, [0; 3]), (0.5, [100; 3]), (1.0, [200; 3])], 0.75), Color([150; 3]));
    }
}

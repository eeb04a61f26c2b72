//! How far the layers of a group came (blueprints paper, sections 4.2 and 4.3), as people are told.

use std::fmt;

/// What ends layers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LayersEnd {
    /// Nothing did: as many layers were drawn as were asked for.
    MaxLayers,
    /// The next layer has too few pixels, or none.
    TooFewPixels,
    /// So much of the depth mask is uncovered as was asked for.
    MaskUncovered,
}

impl fmt::Display for LayersEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::MaxLayers => "layer limit",
            Self::TooFewPixels => "too few pixels",
            Self::MaskUncovered => "mask uncovered",
        })
    }
}

/// How far the layers of a group came, from lists or by peeling.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerReport {
    /// Layers that were drawn.
    pub layers: u32,
    /// What ended it.
    pub ended: LayersEnd,
    /// So much of the designated objects was to be uncovered, 0 to 1.
    pub fraction: f32,
    /// Pixels of the depth mask, the paper's Q; 0: nothing designated is in the picture.
    pub masked: u32,
    /// Those of them that opaque surfaces hide, which no layer uncovers.
    pub hidden: u32,
    /// Fragments of its lists, those for which there was no room included; 0 without lists.
    pub fragments: u64,
    /// So many fragments there had to be room for.
    pub capacity: u64,
    /// Pixels of each layer, that which ended it included; 0 behind it.
    pub pixels: Vec<u32>,
    /// Pixels of the mask that pass the depth test against each layer, the paper's R.
    pub passed: Vec<u32>,
}

impl LayerReport {
    /// Pixels of the mask that pass the depth test against the last layer, drawn or not.
    pub fn uncovered(&self) -> u32 {
        let last = if self.ended == LayersEnd::TooFewPixels { self.layers } else { self.layers.max(1) - 1 };
        self.passed.get(last as usize).copied().unwrap_or(0)
    }

    /// The same as a share of the mask, 0 to 1.
    pub fn share_uncovered(&self) -> f64 {
        f64::from(self.uncovered()) / f64::from(self.masked.max(1))
    }

    /// Why less of the mask is uncovered than was asked for, and what to do; `None` if there is no mask in the picture, or
    /// enough of it.
    pub fn shortfall(&self) -> Option<String> {
        if self.masked == 0 {
            return None;
        }
        let asked = f64::from(self.fraction);
        let layers = self.layers;
        let plural = if layers == 1 { "" } else { "s" };
        let reached = percent(self.share_uncovered());
        let hidden = f64::from(self.hidden) / f64::from(self.masked);
        let remedy = match self.ended {
            LayersEnd::MaxLayers if layers as usize >= self.passed.len() => "no picture has more layers",
            LayersEnd::MaxLayers => "allow more layers (blueprint.to)",
            LayersEnd::TooFewPixels if self.share_uncovered() < asked => {
                "allow smaller layers (blueprint.min_coverage)"
            }
            _ if 1.0 - hidden < asked => {
                let hidden = percent(hidden);
                return Some(format!(
                    "opaque objects hide {hidden} of what is designated: hide them or make them blueprints"
                ));
            }
            _ => return None,
        };
        let asked = format!("{} %", (asked * 100.0).round());
        Some(format!(
            "{reached} of what is designated is uncovered after {layers} layer{plural}, not {asked}: {remedy}"
        ))
    }
}

/// In whole percent, rounded down: all is all.
fn percent(share: f64) -> String {
    format!("{} %", (share * 100.0 + 1e-6).floor())
}

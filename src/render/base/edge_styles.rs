//! The edge styles of all objects of a picture, each kept once: most objects share one, and what is short reaches the device as a
//! uniform, which software devices read fast.

use encase::ShaderType;
use glam::UVec4;

use super::edge_style::GpuEdgeStyle;
use crate::gpu::{ArrayBuffer, Gpu, Inputs, inputs};

/// A style is looked for among so many of the last ones: objects that share one mostly follow each other. What is found no more
/// is kept again, so that thousands of different styles cost no more than their number.
const COMPARED: usize = 32;

/// Edge styles by object id.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeStyles {
    /// Number 0 draws nothing.
    styles: Vec<GpuEdgeStyle>,
    /// By object id.
    numbers: Vec<u32>,
}

impl EdgeStyles {
    /// Of so many object ids, none of which draws anything.
    pub fn new(count: usize) -> Self {
        Self { styles: vec![GpuEdgeStyle::default()], numbers: vec![0; count] }
    }

    /// Gives an object a style; ids that are beyond the count are left out.
    pub fn set(&mut self, object: u32, style: &GpuEdgeStyle) {
        let Some(number) = self.numbers.get_mut(object as usize) else { return };
        let first = self.styles.len().saturating_sub(COMPARED);
        let known = self.styles[first..].iter().rposition(|known| known == style);
        *number = known.map_or(self.styles.len(), |index| first + index) as u32;
        if known.is_none() {
            self.styles.push(*style);
        }
    }

    /// The style of an object.
    pub fn of(&self, object: u32) -> Option<&GpuEdgeStyle> {
        self.styles.get(*self.numbers.get(object as usize)? as usize)
    }

    /// How many object ids there are.
    pub fn count(&self) -> usize {
        self.numbers.len()
    }

    /// All styles that any object has, and one that draws nothing.
    pub fn styles(&self) -> &[GpuEdgeStyle] {
        &self.styles
    }

    /// Those of the objects that are wanted.
    #[must_use]
    pub fn only(&self, is_wanted: impl Fn(u32) -> bool) -> Self {
        let mut only = Self::new(self.count());
        for object in (0..self.count() as u32).filter(|object| is_wanted(*object)) {
            if let Some(style) = self.of(object) {
                only.set(object, style);
            }
        }
        only
    }

    /// The same as far as finding edges goes, see [`GpuEdgeStyle::for_finding`].
    #[must_use]
    pub fn for_finding(&self) -> Self {
        Self {
            styles: self.styles.iter().map(GpuEdgeStyle::for_finding).collect(),
            numbers: self.numbers.clone(),
        }
    }

    /// Greatest distance from its spine at which a line has ink, px.
    pub fn greatest_radius(&self) -> f32 {
        self.styles.iter().map(GpuEdgeStyle::greatest_radius).fold(0.0, f32::max)
    }
}

impl Default for EdgeStyles {
    fn default() -> Self {
        Self::new(0)
    }
}

/// Twin of `StyleNumbers` in `shaders/common/edge_style.wgsl`.
#[derive(ShaderType)]
struct GpuStyleNumbers {
    numbers: UVec4,
}

/// [`EdgeStyles`] on the device.
pub struct EdgeStylesBuffer {
    styles: ArrayBuffer,
    numbers: ArrayBuffer,
}

impl EdgeStylesBuffer {
    /// Of no object.
    pub fn new(gpu: &Gpu) -> Self {
        Self { styles: ArrayBuffer::new(gpu, "edge styles"), numbers: ArrayBuffer::new(gpu, "style numbers") }
    }

    /// Writes all of them.
    pub fn write(&mut self, gpu: &Gpu, EdgeStyles { styles, numbers }: &EdgeStyles) {
        self.styles.write(gpu, styles);
        let number = |object: usize| numbers.get(object).copied().unwrap_or(0);
        let of_four = |first| std::array::from_fn(|i| number(first + i)).into();
        let fours =
            (0..numbers.len().max(1)).step_by(4).map(|first| GpuStyleNumbers { numbers: of_four(first) });
        self.numbers.write(gpu, &fours.collect::<Vec<_>>());
    }

    /// What `shaders/common/edge_style.wgsl` reads of them.
    pub fn inputs(&self) -> Inputs<'_> {
        inputs! { edge_styles: &self.styles, style_numbers: &self.numbers }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn style(min_length: f32) -> GpuEdgeStyle {
        let mut style = GpuEdgeStyle::default();
        style.min_length = min_length;
        style
    }

    #[test]
    fn each_style_is_kept_once_and_found_by_object() {
        let mut styles = EdgeStyles::new(5);
        for (object, length) in [(1, 3.0), (2, 4.0), (4, 3.0), (9, 5.0)] {
            styles.set(object, &style(length));
        }
        let lengths: Vec<_> = (0..5).filter_map(|object| Some(styles.of(object)?.min_length)).collect();
        assert_eq!(lengths, [0.0, 3.0, 4.0, 0.0, 3.0]);
        assert_eq!(styles.styles().len(), 3);
        assert!(styles.of(9).is_none());
        let only = styles.only(|object| object > 1);
        assert_eq!(only.of(1), Some(&GpuEdgeStyle::default()));
        assert_eq!(only.of(4), Some(&style(3.0)));
    }

    #[test]
    fn more_styles_than_are_compared_are_all_kept() {
        let mut styles = EdgeStyles::new(100);
        (0..100).for_each(|object| styles.set(object, &style(object as f32)));
        assert!((0..100).all(|object| styles.of(object) == Some(&style(object as f32))));
    }
}

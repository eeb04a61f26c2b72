//! Plain shading: the surface lit by the scene's lights.

use super::param::Params;

/// Parameters of the technique `plain`.
#[derive(Debug, Clone, PartialEq)]
pub struct Plain {
    /// Light that reaches every point from everywhere.
    pub ambient: f32,
}

impl Default for Plain {
    fn default() -> Self {
        Self { ambient: 0.2 }
    }
}

impl Plain {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.share("ambient", "Ambient", "Light that reaches every point, lit or not.", &mut self.ambient);
    }
}

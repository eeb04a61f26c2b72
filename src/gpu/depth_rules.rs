//! What passes do with depth buffers: where they draw, and what they note.

use super::Target;

/// How a pass uses its depth buffer (reversed, 0 where nothing is). What covers the picture lies at 1e-30: behind
/// everything that is drawn, and in front of texels where nothing is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DepthRule {
    /// Draws only where something has been drawn.
    Covered,
    /// Notes where it draws, or the depth that its shader gives.
    Mark,
    /// Draws only where the depth is exactly this, as a shader gave it.
    Equal(f32),
    /// Draws only where an entry point of the same program does not discard, which is run before it and marks a stencil. The
    /// buffer is one of [`STENCIL`], and holds nothing afterwards.
    Where(&'static str),
    /// Draws only where something has been drawn and an entry point of the same program, which is run before it, does not
    /// discard. The marks of that take the place of the depths there, as a device that has depth of 32 bits and a stencil in
    /// one texture is optional. A buffer can be marked so up to [`MAX_ROUNDS`] times; the number is that of the times before.
    CoveredWhere(&'static str, u32),
    /// Draws only where something has been drawn and an entry point of the same program, which is run before it, discards.
    /// Where it does not, nothing has been drawn from then on: the depths there become 0.
    CoveredUnless(&'static str),
}

/// The format of the buffers of [`DepthRule::Where`].
pub const STENCIL: wgpu::TextureFormat = wgpu::TextureFormat::Stencil8;

/// How often what is covered can be marked in one buffer.
pub const MAX_ROUNDS: u32 = 4096;

/// What one draw does with a depth buffer; a [`DepthRule`] has a draw of its own, and may have one before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DepthTest {
    /// Passes where something has been drawn.
    Covered,
    /// Passes everywhere, and notes where.
    Mark,
    /// Passes where something has been drawn, and marks that by its own depth.
    MarkCovered,
    /// Passes where the depth is that at which it is drawn: these marks.
    Equal,
    /// Passes everywhere, and marks where in a stencil.
    MarkStencil,
    /// Passes where the stencil is marked.
    Stencilled,
    /// Passes where something has been drawn, and makes it 0, as if nothing had.
    Uncover,
}

impl DepthRule {
    /// What the draw itself does.
    pub fn test(self) -> DepthTest {
        match self {
            Self::Covered | Self::CoveredUnless(_) => DepthTest::Covered,
            Self::Mark => DepthTest::Mark,
            Self::Where(_) => DepthTest::Stencilled,
            Self::CoveredWhere(..) | Self::Equal(_) => DepthTest::Equal,
        }
    }

    /// The entry point that is run before it, and what that does.
    pub fn marker(self) -> Option<(&'static str, DepthTest)> {
        match self {
            Self::Covered | Self::Mark | Self::Equal(_) => None,
            Self::Where(entry_point) => Some((entry_point, DepthTest::MarkStencil)),
            Self::CoveredWhere(entry_point, _) => Some((entry_point, DepthTest::MarkCovered)),
            Self::CoveredUnless(entry_point) => Some((entry_point, DepthTest::Uncover)),
        }
    }

    /// The depths at which a test of it draws what covers the picture: the least and the greatest one of the viewport.
    pub fn depths(self, test: DepthTest) -> [f32; 2] {
        match (self, test) {
            (Self::CoveredWhere(_, rounds), _) => {
                // Before what covers the picture, behind all that is drawn, and a hair behind the last marks.
                let depth = (1.0 - (rounds % MAX_ROUNDS) as f32 / (2 * MAX_ROUNDS) as f32) * 1e-9;
                [depth, depth]
            }
            (Self::Equal(depth), _) => [depth, depth],
            (_, DepthTest::Uncover) => [0.0, 0.0],
            _ => [0.0, 1.0],
        }
    }

    /// The buffer as the pass uses it.
    pub fn attachment(self, target: &Target) -> wgpu::RenderPassDepthStencilAttachment<'_> {
        let store = wgpu::StoreOp::Store;
        let (depth_ops, stencil_ops) = match self {
            Self::Covered | Self::Equal(_) => (None, None),
            Self::Mark => (Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store }), None),
            Self::CoveredWhere(..) | Self::CoveredUnless(_) => {
                (Some(wgpu::Operations { load: wgpu::LoadOp::Load, store }), None)
            }
            Self::Where(_) => {
                let store = wgpu::StoreOp::Discard;
                (None, Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0), store }))
            }
        };
        wgpu::RenderPassDepthStencilAttachment { view: target.view(), depth_ops, stencil_ops }
    }
}

impl DepthTest {
    /// It as the state of a pipeline.
    pub(super) fn state(self, format: wgpu::TextureFormat) -> wgpu::DepthStencilState {
        let depth = |compare, writes| (Some((compare, writes)), wgpu::StencilFaceState::IGNORE);
        let stencil =
            |compare, pass_op| (None, wgpu::StencilFaceState { compare, pass_op, ..Default::default() });
        let (depth, face) = match self {
            Self::Covered => depth(wgpu::CompareFunction::Less, false),
            Self::Mark => depth(wgpu::CompareFunction::Always, true),
            Self::MarkCovered | Self::Uncover => depth(wgpu::CompareFunction::Less, true),
            Self::Equal => depth(wgpu::CompareFunction::Equal, false),
            Self::MarkStencil => {
                stencil(wgpu::CompareFunction::Always, wgpu::StencilOperation::IncrementClamp)
            }
            // The reference is 0.
            Self::Stencilled => stencil(wgpu::CompareFunction::NotEqual, wgpu::StencilOperation::Keep),
        };
        wgpu::DepthStencilState {
            format,
            depth_write_enabled: depth.map(|(_, writes)| writes),
            depth_compare: depth.map(|(compare, _)| compare),
            stencil: wgpu::StencilState { front: face, back: face, read_mask: !0, write_mask: !0 },
            bias: wgpu::DepthBiasState::default(),
        }
    }
}

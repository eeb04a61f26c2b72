//! A step that begins and ends softly.

/// As WGSL has it: 0 up to `from`, 1 from `to` on.
pub(super) fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

//! The numbers by which pixels name objects and surfaces.

use crate::scene::NodeId;

/// Object ids are kept in 31 bits; the highest one is the enhanced flag.
pub const ENHANCED: u32 = 0x8000_0000;

/// The object id that pixels of a node carry; 0 is the background.
pub fn object_id(node: NodeId) -> u32 {
    node as u32 + 1
}

/// The node that an object id (with or without flag) stands for.
pub fn node_of(object: u32) -> Option<NodeId> {
    (object & !ENHANCED).checked_sub(1).map(|n| n as usize)
}

/// The number in the G-buffer for a surface of an object; twin of `surface_id_of` in `shaders/common/surface_id.wgsl`.
pub fn surface_id(object: u32, surface: u32) -> u32 {
    object.wrapping_mul(2_654_435_769).wrapping_add(surface).max(1)
}

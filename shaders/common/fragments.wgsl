// Fragment lists: all that the objects of a group cover, as linked lists, one per pixel. A fragment's number is its index
// plus 1; 0 is none. Twin: `FragmentLists` in src/render/passes/fragment_lists.rs.
#import common/pixel.wgsl
#import gpu/record_texture.wgsl

// How fragments lie behind each other: what the order of their layers depends on.
struct FragmentNode {
    // The one that was drawn before it.
    next: u32,
    // Bits of the reversed depth: what is nearer is greater, as a number too.
    depth: u32,
    // Of which draw and surface it is.
    order: u32,
    // The shading normal, as in common/gbuffer.wgsl, which sorting has room for.
    normal: u32,
}

// What else a fragment is, as in common/gbuffer.wgsl.
struct Payload {
    face: u32,
    // Bits of the linear depth.
    depth: u32,
    object: u32,
    surface_id: u32,
}

fn texel_of_node(node: FragmentNode) -> vec4<u32> {
    return vec4(node.next, node.depth, node.order, node.normal);
}

fn texel_of_payload(payload: Payload) -> vec4<u32> {
    return vec4(payload.face, payload.depth, payload.object, payload.surface_id);
}

fn node_of(texel: vec4<u32>) -> FragmentNode {
    return FragmentNode(texel.x, texel.y, texel.z, texel.w);
}

fn payload_of(texel: vec4<u32>) -> Payload {
    return Payload(texel.x, texel.y, texel.z, texel.w);
}

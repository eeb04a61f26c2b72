// Fragment lists: all that the objects of a group cover, as linked lists, one per pixel. A fragment's number is its index
// plus 1; 0 is none. Twin: `FragmentLists` in src/render/passes/fragment_lists.rs.
#import common/frame.wgsl

// How fragments lie behind each other: what the order of their layers depends on.
struct Link {
    // The one that was drawn before it.
    next: u32,
    // Bits of the reversed depth: what is nearer is greater, as a number too.
    depth: u32,
    // Of which draw and surface it is: this tells its object and its region too.
    order: u32,
}

// What else a fragment is, as in common/gbuffer.wgsl.
struct Payload {
    normal: u32,
    face: u32,
    // Bits of the linear depth.
    depth: u32,
}

// Index of a pixel among the lists.
fn list_of(px: vec2<u32>) -> u32 {
    return px.y * u32(frame.size.x) + px.x;
}

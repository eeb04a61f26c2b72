// Fragment lists in the order of depth layers: what is nearer comes first, and of what is equally deep what is drawn first, as
// in passes/peel.wgsl.
#import common/fragments.wgsl

// The first fragment of each pixel.
@group(1) @binding(0) var<storage, read_write> heads: array<u32>;
@group(1) @binding(1) var<storage, read_write> links: array<Link>;
// At least one: so many of each list are wanted.
@group(1) @binding(2) var<storage, read> most: array<u32>;

fn is_behind(a: Link, b: Link) -> bool {
    return a.depth < b.depth || (a.depth == b.depth && a.order > b.order);
}

// Sorts each list by insertion; what lies behind the last one that is wanted may be lost, and a surface that comes twice
// equally deep is kept once. What was drawn last comes first and is mostly the farthest: most find their place at once.
@compute @workgroup_size(8, 8)
fn cs_sort(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= vec2<u32>(frame.size)) {
        return;
    }
    let list = list_of(id.xy);
    var first = 0u;
    var at = heads[list];
    while at != 0u {
        let own = links[at - 1u];
        var before = 0u;
        var after = first;
        var passed = 0u;
        while after != 0u && passed < most[0] {
            let other = links[after - 1u];
            if !is_behind(own, other) {
                if own.depth == other.depth && own.order == other.order {
                    after = other.next;
                }
                break;
            }
            before = after;
            after = other.next;
            passed += 1u;
        }
        if passed < most[0] {
            links[at - 1u].next = after;
            if before == 0u {
                first = at;
            } else {
                links[before - 1u].next = at;
            }
        }
        at = own.next;
    }
    heads[list] = first;
}

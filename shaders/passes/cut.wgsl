// The next depth layer of fragment lists. Eight layers at a time are sorted: the first of them takes the eight fragments that
// follow the last layer and notes their order, the other seven follow it.
#import common/fragments.wgsl
#import common/fullscreen.wgsl
#import common/layer_color.wgsl

// The fragment of each pixel that was drawn last.
@group(1) @binding(0) var<storage, read> heads: array<u32>;
@group(1) @binding(1) var<storage, read> links: array<Link>;
@group(1) @binding(2) var<storage, read> payloads: array<Payload>;
@group(1) @binding(3) var<storage, read> colors: array<u32>;
// The fragment of each pixel in the next layer, as far as it is sorted.
@group(1) @binding(4) var<storage, read_write> cursors: array<u32>;
// The fragment that lies behind a fragment, as far as it is sorted.
@group(1) @binding(5) var<storage, read_write> behind: array<u32>;
// The last layer, as in passes/peel.wgsl.
@group(1) @binding(6) var last_depth_tex: texture_depth_2d;
@group(1) @binding(7) var last_order_tex: texture_2d<u32>;

// A fragment that is being sorted.
struct Sorted {
    depth: u32,
    order: u32,
    number: u32,
}

// Lies behind all others, which depth 0 does not count among: the far plane itself is not drawn.
const NONE: Sorted = Sorted(0u, 0xffffffffu, 0u);

// Whether `a` comes before `b`: what is nearer, and of what is equally deep what is drawn first.
fn is_before(a: Sorted, b: Sorted) -> bool {
    return a.depth > b.depth || (a.depth == b.depth && a.order < b.order);
}

// Of a fragment that is kept and another one, the first is kept and the other one goes on. A surface that comes twice equally
// deep is kept once, as it was drawn first.
fn sort(kept: ptr<function, Sorted>, other: ptr<function, Sorted>) {
    let a = *kept;
    let b = *other;
    let is_same = a.depth == b.depth && a.order == b.order;
    let swaps = is_before(b, a);
    let takes = swaps || is_same;
    *kept = Sorted(select(a.depth, b.depth, takes), select(a.order, b.order, takes), select(a.number, b.number, takes));
    let passes = vec3(select(b.depth, a.depth, swaps), select(b.order, a.order, swaps), select(b.number, a.number, swaps));
    *other = Sorted(
        select(passes.x, NONE.depth, is_same),
        select(passes.y, NONE.order, is_same),
        select(passes.z, NONE.number, is_same),
    );
}

struct Layer {
    @location(0) geometry: vec4<u32>,
    @location(1) base_color: vec4<f32>,
    @location(2) region: u32,
    @location(3) order: u32,
    @builtin(frag_depth) depth: f32,
}

fn layer(number: u32) -> Layer {
    let link = links[number - 1u];
    let payload = payloads[number - 1u];
    return Layer(
        vec4(payload.normal, payload.face, payload.depth, link.object),
        unpack_color(colors[number - 1u]), payload.region, link.order, bitcast<f32>(link.depth),
    );
}

fn follow(a: Sorted, b: Sorted) {
    if a.number != 0u {
        behind[a.number - 1u] = b.number;
    }
}

// The first of eight layers.
@fragment
fn fs_first(@builtin(position) position: vec4<f32>) -> Layer {
    let px = vec2<i32>(position.xy);
    let list = list_of(vec2<u32>(px));
    let last = Sorted(
        bitcast<u32>(textureLoad(last_depth_tex, px, 0)), textureLoad(last_order_tex, px, 0).x, 0u,
    );
    var a = NONE;
    var b = NONE;
    var c = NONE;
    var d = NONE;
    var e = NONE;
    var f = NONE;
    var g = NONE;
    var h = NONE;
    var number = heads[list];
    while number != 0u {
        let link = links[number - 1u];
        var own = Sorted(link.depth, link.order, number);
        if !is_before(last, own) || own.depth == 0u {
            own = NONE;
        }
        sort(&a, &own);
        sort(&b, &own);
        sort(&c, &own);
        sort(&d, &own);
        sort(&e, &own);
        sort(&f, &own);
        sort(&g, &own);
        sort(&h, &own);
        number = link.next;
    }
    if a.number == 0u {
        cursors[list] = 0u;
        discard;
    }
    cursors[list] = b.number;
    follow(b, c);
    follow(c, d);
    follow(d, e);
    follow(e, f);
    follow(f, g);
    follow(g, h);
    follow(h, NONE);
    return layer(a.number);
}

// One of the others.
@fragment
fn fs_next(@builtin(position) position: vec4<f32>) -> Layer {
    let list = list_of(vec2<u32>(position.xy));
    let number = cursors[list];
    if number == 0u {
        discard;
    }
    cursors[list] = behind[number - 1u];
    return layer(number);
}

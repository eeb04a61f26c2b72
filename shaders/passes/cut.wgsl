// Depth layers of fragment lists: the fragments of each pixel are sorted, as many layers as there are targets at a time, and
// each layer is made of its own ones.
#import common/fragments.wgsl
#import common/fullscreen.wgsl
#import common/layer_color.wgsl

// The fragment of each pixel that was drawn last.
@group(1) @binding(0) var<storage, read> heads: array<u32>;
@group(1) @binding(1) var<storage, read> links: array<Link>;
@group(1) @binding(2) var<storage, read> payloads: array<Payload>;
@group(1) @binding(3) var<storage, read> colors: array<u32>;
// Sorting: the last layer, as in passes/peel.wgsl.
@group(1) @binding(4) var last_depth_tex: texture_depth_2d;
@group(1) @binding(5) var last_order_tex: texture_2d<u32>;
// Cutting: the numbers of the fragments of the layer, plus 1; 0: none.
@group(1) @binding(6) var number_tex: texture_2d<u32>;

// Whether no more than four layers are sorted.
override FEW: bool = false;

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

// Marks pixels that have any fragments.
@fragment
fn fs_listed(@builtin(position) position: vec4<f32>) {
    if heads[list_of(vec2<u32>(position.xy))] == 0u {
        discard;
    }
}

// The numbers of fragments of up to eight layers, plus 1.
struct Numbers {
    @location(0) a: u32,
    @location(1) b: u32,
    @location(2) c: u32,
    @location(3) d: u32,
    @location(4) e: u32,
    @location(5) f: u32,
    @location(6) g: u32,
    @location(7) h: u32,
}

@fragment
fn fs_sort(@builtin(position) position: vec4<f32>) -> Numbers {
    let px = vec2<i32>(position.xy);
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
    var number = heads[list_of(vec2<u32>(px))];
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
        if !FEW {
            sort(&e, &own);
            sort(&f, &own);
            sort(&g, &own);
            sort(&h, &own);
        }
        number = link.next;
    }
    return Numbers(a.number, b.number, c.number, d.number, e.number, f.number, g.number, h.number);
}

fn number_at(position: vec4<f32>) -> u32 {
    return textureLoad(number_tex, vec2<i32>(position.xy), 0).x;
}

struct Depth {
    @builtin(frag_depth) depth: f32,
}

@fragment
fn fs_depth(@builtin(position) position: vec4<f32>) -> Depth {
    let number = number_at(position);
    if number == 0u {
        discard;
    }
    return Depth(bitcast<f32>(links[number - 1u].depth));
}

struct Layer {
    @location(0) geometry: vec4<u32>,
    @location(1) region: u32,
    @location(2) order: u32,
    @location(3) base_color: vec4<f32>,
}

// Only where there is a fragment.
@fragment
fn fs_layer(@builtin(position) position: vec4<f32>) -> Layer {
    let index = number_at(position) - 1u;
    let link = links[index];
    let payload = payloads[index];
    return Layer(
        vec4(payload.normal, payload.face, payload.depth, link.object), payload.region, link.order,
        unpack_color(colors[index]),
    );
}

// The next depth layer of sorted fragment lists: of each pixel the first fragment that is left.
#import common/fragments.wgsl
#import common/fullscreen.wgsl
#import common/layer_color.wgsl

// The first fragment that is left of each pixel.
@group(1) @binding(0) var<storage, read_write> heads: array<u32>;
@group(1) @binding(1) var<storage, read> links: array<Link>;
@group(1) @binding(2) var<storage, read> payloads: array<Payload>;
@group(1) @binding(3) var<storage, read> colors: array<u32>;

struct Layer {
    @location(0) geometry: vec4<u32>,
    @location(1) base_color: vec4<f32>,
    @location(2) region: u32,
    @location(3) order: u32,
    @builtin(frag_depth) depth: f32,
}

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> Layer {
    let list = list_of(vec2<u32>(position.xy));
    let at = heads[list];
    if at == 0u {
        discard;
    }
    let link = links[at - 1u];
    let payload = payloads[at - 1u];
    heads[list] = link.next;
    return Layer(
        vec4(payload.normal, payload.face, payload.depth, link.object),
        unpack_color(colors[at - 1u]), payload.region, link.order, bitcast<f32>(link.depth),
    );
}

// How places on surfaces change from pixel to pixel.
#import common/frame.wgsl

// How the point that a pixel shows moves with the pixel, over a plane with a normal.
fn pos_change(pos_view: vec3<f32>, normal: vec3<f32>, per_px: vec3<f32>) -> vec3<f32> {
    let orthographic = frame.orthographic == 1u;
    let ray = select(pos_view / -pos_view.z, vec3(0.0, 0.0, -1.0), orthographic);
    // Seen edge on, a plane would have no end.
    let facing = min(dot(normal, ray), -0.1 * length(ray));
    let change = per_px - ray * (dot(normal, per_px) / facing);
    return change * select(-pos_view.z, 1.0, orthographic);
}

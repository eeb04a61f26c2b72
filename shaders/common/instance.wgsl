// One part of one object: where it lies and what it is. Attributes of instances, not elements of an array: what is the same for
// a whole draw is fetched once per draw and not once per vertex. Twin: `Record` in src/render/base/instances.rs.
struct Instance {
    @location(6) view_from_local_x: vec4<f32>,
    @location(7) view_from_local_y: vec4<f32>,
    @location(8) view_from_local_z: vec4<f32>,
    @location(9) view_from_local_w: vec4<f32>,
    // Inverse transpose of its linear part; 0 where the mesh has no normals: then faces are flat.
    @location(10) normal_from_local_x: vec3<f32>,
    @location(11) normal_from_local_y: vec3<f32>,
    @location(12) normal_from_local_z: vec3<f32>,
    @location(13) base_color: vec4<f32>,
    // Object id with the enhanced flag as the highest bit; order of its first surface among those of all instances; its base color
    // with the sRGB curve, and its opacity, 8 bits each; number of its first triangle in its mesh.
    @location(14) ids: vec4<u32>,
    // How far vertices move along their normals where surfaces are drawn enlarged, px.
    @location(15) enlarged: f32,
}

fn view_from_local(i: Instance) -> mat4x4<f32> {
    return mat4x4(i.view_from_local_x, i.view_from_local_y, i.view_from_local_z, i.view_from_local_w);
}

fn normal_from_local(i: Instance) -> mat3x3<f32> {
    return mat3x3(i.normal_from_local_x, i.normal_from_local_y, i.normal_from_local_z);
}

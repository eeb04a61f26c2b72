//! The noise of sketches: what the device makes of `shaders/common/noise.wgsl` is what its Rust twin makes.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use glam::{Vec2, Vec3, Vec4};
use hachure::gpu::{Gpu, Shaders, readback};
use hachure::render::base::noise::{fine_waves, mixed_bits, waves};
use wgpu::util::DeviceExt as _;

/// What is asked of the device: waves at a place, and finer ones.
const ASKED: &str = "
@group(0) @binding(0) var<storage, read> places: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> found: array<vec4<f32>>;

@compute @workgroup_size(64)
fn cs_noise(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&places) {
        return;
    }
    let place = places[id.x];
    let turbulent = id.x % 2u == 1u;
    found[id.x] = vec4(
        waves(place.xyz, place.w, id.x, turbulent),
        fine_waves(place.xyz, place.w, id.x, turbulent),
    );
}
";

/// Greatest difference of noise of which the mean square is 1.
const TOLERANCE: f32 = 1e-3;

/// Places, and wavelengths in w: as on models of any size, near and far.
fn places() -> Vec<Vec4> {
    let random = |n: u32| mixed_bits(n) as f32 / u32::MAX as f32;
    let place = |i: u32| {
        let [x, y, z, size, wave] = [0, 1, 2, 3, 4].map(|k| random(8 * i + k));
        let direction = 2.0 * Vec3::new(x, y, z) - 1.0;
        // From a millionth to a million, with waves from twice as long to a thousandth.
        let size = 10.0_f32.powf(12.0 * size - 6.0);
        (size * direction).extend(size * 10.0_f32.powf(0.3 - 3.3 * wave))
    };
    let special = [
        Vec4::new(0.0, 0.0, 0.0, 1.0),
        Vec4::new(1e-30, -1e-30, 0.0, 1.0),
        Vec4::new(1e9, -3e9, 2e9, 1e8),
        Vec4::new(1e-9, 3e-9, -2e-9, 1e-9),
        Vec4::new(-1e-12, 2e-12, 1e-12, 3e-10),
        Vec4::new(1.0, -2.0, 3.0, 64.0),
    ];
    (0..4096).map(place).chain(special).collect()
}

/// The same on the device.
fn on_device(gpu: &Gpu, places: &[Vec4]) -> Vec<Vec4> {
    let text = Shaders::default().compose("common/noise.wgsl").unwrap().text + ASKED;
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("noise"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("noise"),
        layout: None,
        module: &module,
        entry_point: Some("cs_noise"),
        compilation_options: Default::default(),
        cache: None,
    });
    let given = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("places"),
        contents: bytemuck::cast_slice(places),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let found = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("noise"),
        size: given.size(),
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("noise"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: given.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: found.as_entire_binding() },
        ],
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(places.len().div_ceil(64) as u32, 1, 1);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
    bytemuck::pod_collect_to_vec(&readback::read_buffer(gpu, &found).unwrap())
}

#[test]
fn the_device_and_the_twin_agree_on_noise() {
    let mut session = common::session();
    let places = places();
    let found = on_device(session.renderer().gpu(), &places);
    assert_eq!(found.len(), places.len());
    let mut squares = 0.0;
    for (i, (place, found)) in (0..).zip(places.iter().zip(&found)) {
        let (at, turbulent) = (place.truncate(), i % 2 == 1);
        let twins = [waves, fine_waves].map(|noise| noise(at, place.w, i, turbulent));
        for (name, found, twin) in [
            ("waves", Vec2::new(found.x, found.y), twins[0]),
            ("fine waves", Vec2::new(found.z, found.w), twins[1]),
        ] {
            let apart = found.distance(twin);
            assert!(apart < TOLERANCE, "{name} {i} at {place}: {found} and {twin}, {apart} apart");
            squares += found.length_squared();
        }
    }
    // And it is noise.
    let square = squares / (4 * places.len()) as f32;
    assert!((0.8..1.2).contains(&square), "{square}");
}

#[test]
fn noise_stays_within_bounds_where_numbers_have_no_digits_left() {
    let mut session = common::session();
    // More than a million waves from the middle.
    let places: Vec<Vec4> = (1..200)
        .map(|i| {
            let far = 1e5 * i as f32;
            Vec4::new(far, -0.7 * far, 0.3 * far, 1e-3 / i as f32)
        })
        .collect();
    for (place, found) in places.iter().zip(on_device(session.renderer().gpu(), &places)) {
        assert!(found.is_finite() && found.abs().max_element() < 8.0, "{place}: {found}");
        for noise in [waves, fine_waves] {
            let twin = noise(place.truncate(), place.w, 1, false);
            assert!(twin.is_finite() && twin.abs().max_element() < 8.0, "{place}: {twin}");
        }
    }
}

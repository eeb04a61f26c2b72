//! How the mouse and the keys move the camera: turntable orbit, pan, zoom to the cursor.
//!
//! Everything is measured in shares of the picture, so that it feels alike at any scale of a model.

use glam::{DQuat, DVec2, DVec3};

use crate::scene::{Camera, Projection, Up};

/// Degrees that a drag over the whole height of the picture turns.
const DEGREES_PER_HEIGHT: f64 = 240.0;

/// Change of the distance per notch of the wheel.
const ZOOM_PER_NOTCH: f64 = 0.88;

/// Degrees of one step by key.
pub const STEP: f64 = 15.0;

/// Turns the camera by a drag, given in shares of the picture's height.
pub fn orbit(camera: &Camera, up: Up, drag: DVec2) -> Camera {
    camera.orbited(up.vector(), -drag.x * DEGREES_PER_HEIGHT, drag.y * DEGREES_PER_HEIGHT)
}

/// Turns the picture in its own plane by a drag to the right, given in shares of the picture's height.
pub fn roll(camera: &Camera, drag: f64) -> Camera {
    let turn = DQuat::from_axis_angle(camera.forward(), (drag * DEGREES_PER_HEIGHT).to_radians());
    Camera { view_up: turn * camera.up(), ..*camera }
}

/// Moves the picture with the pointer; the drag is in shares of the picture's height.
pub fn pan(camera: &Camera, drag: DVec2) -> Camera {
    let by = (camera.up() * drag.y - camera.right() * drag.x) * camera.view_height();
    moved(camera, by)
}

/// Shifts eye and focal point.
pub fn moved(camera: &Camera, by: DVec3) -> Camera {
    Camera { position: camera.position + by, focal_point: camera.focal_point + by, ..*camera }
}

/// Zooms in by some notches of the wheel (out when negative). What lies in the plane of the focal point under
/// `cursor` stays there; the cursor is in shares of the picture's height from the center, y upwards.
///
/// `diagonal` is the size of the model; it limits how near and how far one can get.
pub fn zoom(camera: &Camera, notches: f64, cursor: DVec2, diagonal: f64) -> Camera {
    let size = if diagonal > 0.0 { diagonal } else { 1.0 };
    let height = camera.view_height().max(f64::MIN_POSITIVE);
    let wanted = height * ZOOM_PER_NOTCH.powf(notches.clamp(-50.0, 50.0));
    // A camera that is already outside of the limits may stay there, but not go further.
    let (nearest, farthest) = ((size * 1e-4).min(height), (size * 100.0).max(height));
    let factor = wanted.clamp(nearest, farthest) / height;
    let shift = (camera.right() * cursor.x + camera.up() * cursor.y) * height * (1.0 - factor);
    let focal_point = camera.focal_point + shift;
    match camera.projection {
        Projection::Perspective { .. } => Camera {
            position: focal_point - camera.forward() * camera.distance() * factor,
            focal_point,
            ..*camera
        },
        Projection::Orthographic { view_height } => Camera {
            projection: Projection::Orthographic { view_height: view_height * factor },
            ..moved(camera, shift)
        },
    }
}

/// The same view through another angle; what lies at the focal point keeps its size. Parallel views stay as they are.
pub fn with_view_angle(camera: &Camera, degrees: f64) -> Camera {
    let Projection::Perspective { .. } = camera.projection else { return *camera };
    let degrees = degrees.clamp(1.0, 170.0);
    let distance = camera.view_height() / (2.0 * (degrees.to_radians() * 0.5).tan());
    Camera {
        position: camera.focal_point - camera.forward() * distance,
        projection: Projection::Perspective { view_angle: degrees },
        ..*camera
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Bounds;
    use crate::scene::Standard;

    fn bounds(size: f64) -> Bounds {
        Bounds { min: DVec3::splat(-size), max: DVec3::splat(size) }
    }

    /// Where a point appears, in shares of the picture's height from the center.
    fn on_screen(camera: &Camera, point: DVec3) -> DVec2 {
        let p = camera.view_from_world().transform_point3(point);
        let scale = match camera.projection {
            Projection::Perspective { .. } => camera.view_height() / camera.distance() * -p.z,
            Projection::Orthographic { view_height } => view_height,
        };
        DVec2::new(p.x, p.y) / scale
    }

    #[test]
    fn rolling_turns_the_picture_and_nothing_else() {
        let start = Standard::Home.camera(Up::PosY, &bounds(1.0).corners(), 1.5, None);
        let rolled = roll(&start, 90.0 / DEGREES_PER_HEIGHT);
        assert_eq!((rolled.position, rolled.focal_point), (start.position, start.focal_point));
        assert!((rolled.right().dot(start.up()).abs() - 1.0).abs() < 1e-9);
        assert!((roll(&rolled, -90.0 / DEGREES_PER_HEIGHT).up() - start.up()).length() < 1e-9);
    }

    #[test]
    fn zooming_keeps_what_is_under_the_cursor_at_any_scale_and_projection() {
        for size in [1e-6, 1.0, 1e6] {
            for parallel in [false, true] {
                let camera = Standard::Home
                    .camera(Up::PosY, &bounds(size).corners(), 1.5, None)
                    .with_orthographic(parallel);
                let cursor = DVec2::new(0.4, -0.3);
                let point = camera.focal_point
                    + (camera.right() * cursor.x + camera.up() * cursor.y) * camera.view_height();
                let near = zoom(&camera, 5.0, cursor, bounds(size).diagonal());
                assert!(near.view_height() < camera.view_height() * 0.6);
                assert!((on_screen(&near, point) - cursor).length() < 1e-9);
                let back = zoom(&near, -5.0, cursor, bounds(size).diagonal());
                assert!((back.position - camera.position).length() < 1e-9 * size);
            }
        }
    }

    #[test]
    fn zooming_never_runs_away() {
        let start = Standard::Home.camera(Up::PosY, &bounds(1.0).corners(), 1.5, None);
        let mut camera = start;
        for _ in 0..1000 {
            camera = zoom(&camera, 10.0, DVec2::ZERO, 3.0);
        }
        assert!(camera.view_height() >= 3e-4 * 0.99 && camera.position.is_finite());
        for _ in 0..1000 {
            camera = zoom(&camera, -10.0, DVec2::ZERO, 3.0);
        }
        assert!(camera.view_height() <= 301.0 && camera.position.is_finite());
    }

    #[test]
    fn panning_moves_the_focal_point_with_the_pointer() {
        let camera = Standard::Front.camera(Up::PosY, &bounds(1.0).corners(), 1.0, None);
        let drag = DVec2::new(0.25, 0.1);
        let moved = pan(&camera, drag);
        let there = on_screen(&moved, camera.focal_point);
        assert!((there - DVec2::new(0.25, -0.1)).length() < 1e-9, "{there}");
    }
}

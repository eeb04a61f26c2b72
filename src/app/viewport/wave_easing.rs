//! How the waves of sketches follow a camera that comes nearer in leaps, as with each notch of the wheel.
//!
//! Waves keep their length on paper: shorter ones replace them as the camera comes nearer. Where that is a third nearer from one
//! picture to the next, so many are replaced that lines jump. So waves stay on their surface then, longer on paper, and become
//! as long as they are to be in the pictures that follow.

use crate::scene::Camera;

/// Octaves by which waves get longer or shorter per second, and the longest time that counts between two pictures: in none of them
/// waves change by more than when a dolly comes nearer by a twelfth, where lines are not seen to jump.
const OCTAVES_PER_SECOND: f64 = 1.8;
const LONGEST: f64 = 1.0 / 15.0;
/// So many octaves at most waves are off, or they would need too long to come to rest.
const MOST: f64 = 5.0;
/// What comes nearer by more octaves from one picture to the next does not move but is shown anew, as when an object is framed.
const CUT: f64 = 1.0;

/// The camera of the last picture, and how waves were then.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Last {
    view_height: f64,
    seconds: f64,
    /// How much longer on paper than they are to be, octaves.
    excess: f64,
}

/// How the waves of sketches follow the camera.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WaveEasing {
    last: Option<Last>,
}

impl WaveEasing {
    /// How much longer on paper than they are to be waves are in a picture at a time (seconds), which is the next one. At 1 all
    /// is as it is to be, and stays so until the camera moves.
    pub fn scale(&mut self, camera: &Camera, seconds: f64) -> f32 {
        let view_height = camera.view_height();
        let excess = self.last.map_or(0.0, |last| {
            let nearer = (last.view_height / view_height).log2();
            if nearer.is_nan() || nearer.abs() > CUT {
                return 0.0;
            }
            let locked = last.excess + nearer;
            let most = OCTAVES_PER_SECOND * (seconds - last.seconds).clamp(0.0, LONGEST);
            (locked - locked.clamp(-most, most)).clamp(-MOST, MOST)
        });
        self.last = Some(Last { view_height, seconds, excess });
        excess.exp2() as f32
    }

    /// Forgets the last picture: what comes is another drawing.
    pub fn forget(&mut self) {
        self.last = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Projection;

    /// A camera that sees so much from top to bottom.
    fn camera(view_height: f64) -> Camera {
        Camera { projection: Projection::Orthographic { view_height }, ..Camera::default() }
    }

    #[test]
    fn slow_motion_changes_nothing() {
        let mut easing = WaveEasing::default();
        for picture in 0..100 {
            let seconds = f64::from(picture) / 30.0;
            assert_eq!(easing.scale(&camera(0.97_f64.powi(picture)), seconds), 1.0);
        }
    }

    #[test]
    fn after_a_leap_waves_stay_on_their_surface_and_change_little_by_little() {
        for leap in [0.55, 1.8] {
            let mut easing = WaveEasing::default();
            easing.scale(&camera(1.0), 7.0);
            let mut length = 1.0;
            let mut pictures = 0;
            loop {
                let scale = f64::from(easing.scale(&camera(leap), 7.0 + 0.05 * f64::from(pictures + 1)));
                let change = (leap * scale / length).log2().abs();
                assert!(change < 0.121, "{change}");
                length = leap * scale;
                if scale == 1.0 {
                    break;
                }
                pictures += 1;
            }
            assert!((5..12).contains(&pictures), "{pictures}");
        }
    }

    #[test]
    fn after_a_rest_a_leap_is_no_larger() {
        let mut easing = WaveEasing::default();
        easing.scale(&camera(1.0), 0.0);
        assert!(easing.scale(&camera(0.55), 1000.0) > 1.6);
        easing.forget();
        assert_eq!(easing.scale(&camera(0.3), 1000.1), 1.0);
        assert_eq!(easing.scale(&camera(0.1), 1000.2), 1.0, "a cut");
    }

    #[test]
    fn hostile_cameras_and_clocks_do_no_harm() {
        let mut easing = WaveEasing::default();
        let heights = [1.0, 0.0, f64::NAN, f64::INFINITY, 1e-300, 1e300, 1.0];
        for (height, seconds) in heights.into_iter().zip([0.0, -1.0, 4.0, 5.0, 1e9, 1.0, 2.0]) {
            let scale = easing.scale(&camera(height), seconds);
            assert!(scale.is_finite() && scale > 0.01 && scale < 100.0, "{height}: {scale}");
        }
    }
}

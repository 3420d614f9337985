//! Where a body is on the ground, frame by frame: the torso frame and its track
//! (`docs/method.md`, A1).

use glam::Vec2;

use crate::motion::Motion;
use crate::planar::{PlanarTransform, wrap_angle_rad};
use crate::rotation;

/// Below this certainty (`√(w² + y²)` of the root's rotation) the yaw is interpolated.
pub const MIN_YAW_CERTAINTY: f32 = 0.5;

/// Which feet are planted in a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Contacts {
    /// The left foot is planted.
    pub left: bool,
    /// The right foot is planted.
    pub right: bool,
}

impl Contacts {
    /// Whether any foot is planted.
    pub fn any(self) -> bool {
        self.left || self.right
    }
}

/// The track of a motion on the ground: one entry per frame in each list.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundTrack {
    /// The torso frame: yaw, ground projection of the root, and the level of what supports the
    /// body (0 on the floor).
    pub world_from_torso: Vec<PlanarTransform>,
    /// Planted feet.
    pub contacts: Vec<Contacts>,
}

impl GroundTrack {
    /// A track from a yaw series, the support level and the contacts of each frame.
    pub fn new(motion: &Motion, level_m: &[f32], contacts: Vec<Contacts>) -> Self {
        let yaw = yaw_series_rad(motion);
        let world_from_torso = motion
            .root_positions_m()
            .iter()
            .zip(yaw.iter().zip(level_m))
            .map(|(p, (&yaw_rad, &level))| {
                PlanarTransform::new(yaw_rad, Vec2::new(p.x, p.z), level)
            })
            .collect();
        Self { world_from_torso, contacts }
    }
}

/// The heading of every frame, radians, as one continuous series.
///
/// The heading is the twist of the root's rotation about +Y. Where that is nearly undefined
/// (certainty below [`MIN_YAW_CERTAINTY`], in rolls and cartwheels) it is interpolated linearly
/// between the nearest well-defined frames, by the smaller turn; before the first and after the
/// last such frame it stays constant. A motion without any is given heading 0.
pub fn yaw_series_rad(motion: &Motion) -> Vec<f32> {
    let twists: Vec<(f32, f32)> = (0..motion.n_frames())
        .map(|frame| rotation::twist_about_y(motion.root_rotation(frame)))
        .collect();
    let mut yaw = vec![0.0; twists.len()];
    let mut previous: Option<usize> = None;
    for (frame, &(twist_rad, certainty)) in twists.iter().enumerate() {
        if certainty < MIN_YAW_CERTAINTY {
            continue;
        }
        match previous {
            None => yaw[..=frame].fill(twist_rad),
            Some(before) => {
                let turn = wrap_angle_rad(twist_rad - yaw[before]);
                let span = (frame - before) as f32;
                for between in before + 1..=frame {
                    yaw[between] = yaw[before] + turn * (between - before) as f32 / span;
                }
            }
        }
        previous = Some(frame);
    }
    if let Some(last) = previous {
        let end = yaw[last];
        yaw[last..].fill(end);
    }
    yaw
}

#[cfg(test)]
mod tests {
    use glam::{Quat, Vec3};

    use super::*;
    use crate::units::Fps;

    fn motion_of(rotations: Vec<Quat>) -> Motion {
        Motion::new(Fps::THIRTY, 1, vec![Vec3::Y; rotations.len()], rotations)
            .expect("valid by construction")
    }

    #[test]
    fn a_spin_is_unwrapped() {
        let spin = (0..100).map(|f| Quat::from_rotation_y(0.1 * f as f32)).collect();
        let yaw = yaw_series_rad(&motion_of(spin));
        for (frame, &yaw) in yaw.iter().enumerate() {
            assert!((yaw - 0.1 * frame as f32).abs() < 1e-3, "frame {frame}: {yaw}");
        }
    }

    #[test]
    fn a_roll_does_not_turn_the_heading() {
        // A forward roll by a whole turn at heading 0.3: upside down the twist is undefined and
        // its raw value jumps by half a turn.
        let roll = (0..=60)
            .map(|f| {
                let pitch = f as f32 / 60.0 * std::f32::consts::TAU;
                Quat::from_rotation_y(0.3) * Quat::from_rotation_x(pitch)
            })
            .collect();
        for (frame, yaw) in yaw_series_rad(&motion_of(roll)).into_iter().enumerate() {
            assert!((yaw - 0.3).abs() < 1e-3, "frame {frame}: {yaw}");
        }
    }

    #[test]
    fn hanging_upside_down_all_along_is_heading_zero() {
        let upside_down = vec![Quat::from_rotation_x(std::f32::consts::PI); 3];
        assert_eq!(yaw_series_rad(&motion_of(upside_down)), [0.0; 3]);
    }
}

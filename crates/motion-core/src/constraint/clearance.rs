//! Other characters: bodies keep out of each other's way. Soft.

use glam::Vec2;

/// Bodies whose middles are nearer than this are in each other's way, metres.
pub const CLEARANCE_M: f32 = 0.60;

/// So much too near for a second counts 1, metres. It is small since who meet pass in half a second:
/// through each other's middle costs about 50 then, at half a metre from it next to nothing.
pub const CLEARANCE_TOLERANCE_M: f32 = 0.04;

/// Too near by no more than this is well: arms may brush, bodies not.
pub const CLEARANCE_LIMIT_M: f32 = 0.20;

/// Where another character is, frame by frame.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherBody {
    /// Its ground position at every frame, metres; it stays at the last. At least one.
    pub ground_m: Vec<Vec2>,
    /// Frames, both included, in which the two are meant to be near each other.
    pub together: Vec<(u32, u32)>,
}

impl OtherBody {
    /// How much too near a body at `ground_m` is at `frame`, metres.
    #[inline]
    pub fn too_near_m(&self, frame: u32, ground_m: Vec2) -> f32 {
        let there = self.ground_m[(frame as usize).min(self.ground_m.len() - 1)];
        let squared = there.distance_squared(ground_m);
        if squared >= CLEARANCE_M * CLEARANCE_M
            || self.together.iter().any(|&(from, to)| (from..=to).contains(&frame))
        {
            return 0.0;
        }
        CLEARANCE_M - squared.sqrt()
    }
}

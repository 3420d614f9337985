//! Where a planted foot does what planted feet do not.

use std::ops::Range;

use glam::Vec3;
use motion_core::contacts;
use motion_core::units::Fps;

/// A planted foot slides where it is faster than this along the ground, metres per second.
pub const SLIDE_M_S: f32 = 0.02;
/// It is in the ground where it is so much lower than it usually is in the same plant, metres.
pub const SINK_M: f32 = 0.01;

/// So long after a plant has begun the foot still lands, and so long before its end it leaves: it is
/// slow enough to count as planted, and may be faster than [`SLIDE_M_S`], seconds.
pub const LANDING_SECS: f64 = 0.1;

/// Frames of plants in which the toe joint on `path_m` slides or sinks. Speeds are taken over a
/// fifteenth of a second, as everywhere; landing and leaving are no slides.
pub fn foot_faults(path_m: &[Vec3], fps: Fps, plants: &[Range<usize>]) -> Vec<Range<usize>> {
    let landing = fps.frames_in_secs(LANDING_SECS);
    let speeds = contacts::speeds_m_s(path_m, fps);
    let mut faults = Vec::new();
    for plant in plants {
        let Some(path_m) = path_m.get(plant.clone()).filter(|path| !path.is_empty()) else {
            continue;
        };
        let mut heights_m: Vec<f32> = path_m.iter().map(|at| at.y).collect();
        heights_m.sort_by(f32::total_cmp);
        let usual_m = heights_m[heights_m.len() / 2];
        let is_wrong = |nth: usize| {
            let stands = nth >= landing && nth + landing < path_m.len();
            let slides = stands && speeds[plant.start + nth].0 > SLIDE_M_S;
            slides || path_m[nth].y < usual_m - SINK_M
        };
        let runs = contacts::runs(path_m.len(), is_wrong);
        faults.extend(runs.into_iter().map(|run| plant.start + run.start..plant.start + run.end));
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Faults in a plant from frame 5 to 35, as first frames and ends.
    #[track_caller]
    fn check(path_m: &[Vec3], expected: &[(usize, usize)]) {
        let plants = vec![Range { start: 5, end: 35 }];
        let faults = foot_faults(path_m, Fps::THIRTY, &plants);
        let faults: Vec<_> = faults.into_iter().map(|run| (run.start, run.end)).collect();
        assert_eq!(faults, expected);
    }

    #[test]
    fn slides_and_dips_are_found() {
        let mut path_m = vec![Vec3::new(0.0, 0.1, 0.0); 40];
        check(&path_m, &[]);
        path_m[12].y = 0.085;
        check(&path_m, &[(12, 13)]);
        // 2 mm a frame, 6 cm/s, from frame 20 on; it leaves from 32 on.
        for (frame, at) in path_m.iter_mut().enumerate().skip(20) {
            at.x = 0.002 * (frame - 20) as f32;
        }
        check(&path_m, &[(12, 13), (20, 32)]);
        check(&[], &[]);
    }
}

//! Whether a seam can be told from what the clips do anyway.

use glam::Vec3;

use crate::clip::ClipSet;
use crate::contacts::percentile;
use crate::motion::Motion;
use crate::skeleton::Skeleton;
use crate::units::FrameIdx;

/// The definition of `seam_acceleration_ratio`.
pub const DEFINITION: &str = "largest acceleration of any joint over the 5 frames around a seam \
     (two before the new piece's first frame to two after it), over the 99.5th percentile of the \
     same over all uncut 5-frame windows of the clips; a seam is natural at 1 or less";

/// Frames on either side of the middle one.
const HALF: usize = 2;

/// Largest joint acceleration in every frame, m/s², by second differences; the first and the
/// last frame have their neighbour's, motions of fewer than three frames have 0.
pub fn peak_accelerations_m_s2(skeleton: &Skeleton, motion: &Motion) -> Vec<f32> {
    let n_joints = motion.n_joints();
    let n_frames = motion.n_frames();
    let mut peaks = vec![0.0f32; n_frames];
    if n_frames < 3 {
        return peaks;
    }
    let at = motion.joint_positions_m(skeleton);
    let rate = (motion.fps().get() * motion.fps().get()) as f32;
    for (frame, peak) in peaks.iter_mut().enumerate().take(n_frames - 1).skip(1) {
        let pose = |frame: usize| &at[frame * n_joints..(frame + 1) * n_joints];
        let neighbours = pose(frame - 1).iter().zip(pose(frame + 1));
        let largest = pose(frame)
            .iter()
            .zip(neighbours)
            .map(|(&here, (&before, &after)): (&Vec3, _)| {
                (before - 2.0 * here + after).length_squared()
            })
            .fold(0.0, f32::max);
        *peak = largest.sqrt() * rate;
    }
    peaks[0] = peaks[1];
    peaks[n_frames - 1] = peaks[n_frames - 2];
    peaks
}

/// The statistic of one window: the largest peak over the 5 frames around `frame`, as far as
/// there are such frames.
pub fn window_peak_m_s2(peaks_m_s2: &[f32], frame: usize) -> f32 {
    let range = frame.saturating_sub(HALF)..(frame + HALF + 1).min(peaks_m_s2.len());
    peaks_m_s2.get(range).unwrap_or_default().iter().copied().fold(0.0, f32::max)
}

/// The statistic at every seam of a motion, m/s².
pub fn seam_peaks_m_s2(skeleton: &Skeleton, motion: &Motion, seams: &[FrameIdx]) -> Vec<f32> {
    let peaks = peak_accelerations_m_s2(skeleton, motion);
    seams.iter().map(|seam| window_peak_m_s2(&peaks, seam.idx())).collect()
}

/// The `share` quantile of the statistic over all whole windows of all clips, m/s²: 0.995 is
/// the limit that a natural seam stays under.
pub fn natural_peak_m_s2(set: &ClipSet, share: f64) -> f32 {
    let mut windows = Vec::new();
    for clip in set.clips() {
        let peaks = peak_accelerations_m_s2(set.skeleton(), &clip.motion);
        // Whole windows of true second differences: the ends only repeat their neighbours.
        let middles = HALF + 1..peaks.len().saturating_sub(HALF + 1);
        windows.extend(middles.map(|frame| window_peak_m_s2(&peaks, frame)));
    }
    percentile(&mut windows, share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{legs, walks};

    #[test]
    fn a_step_in_the_path_is_seen_at_its_frame_only() {
        let mut motion = walks().clips()[0].motion.clone();
        let quiet = seam_peaks_m_s2(&legs(), &motion, &[FrameIdx(30)])[0];
        for position in &mut motion.root_positions_m_mut()[30..] {
            position.z += 0.1;
        }
        let peaks = seam_peaks_m_s2(&legs(), &motion, &[FrameIdx(30), FrameIdx(20)]);
        assert!(peaks[0] > 80.0 && peaks[0] > 2.0 * quiet, "{peaks:?}, quiet {quiet}");
        assert!(peaks[1] < 60.0, "{peaks:?}");
    }

    #[test]
    fn the_limit_is_a_quantile_of_the_clips_own_windows() {
        let set = walks();
        let (low, high) = (natural_peak_m_s2(&set, 0.5), natural_peak_m_s2(&set, 0.995));
        assert!(0.0 < low && low <= high, "{low} {high}");
    }

    #[test]
    fn short_motions_have_no_acceleration() {
        let two = walks().clips()[0].motion.slice(0, 2);
        assert_eq!(peak_accelerations_m_s2(&legs(), &two), [0.0, 0.0]);
        assert_eq!(window_peak_m_s2(&[], 3), 0.0);
    }
}

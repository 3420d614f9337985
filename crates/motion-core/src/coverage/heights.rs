//! How high and how low bodies get.

use crate::clip::{Clip, ClipSet};
use crate::skeleton::{JointRole, Skeleton};
use crate::units::FrameIdx;

/// A jump that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Jump {
    /// The clip.
    pub clip: String,
    /// The frame at which the hips are highest.
    pub apex: FrameIdx,
    /// How much higher the hips are there than they usually are in the library, metres.
    pub rise_m: f32,
}

/// Heights of bodies with legs; nothing for others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heights {
    /// The hips above what supports the body, half of the time higher than this, metres.
    pub usual_hips_m: f32,
    /// The lowest hips (1st percentile), metres.
    pub lowest_hips_m: f32,
    /// Jumps, the highest first.
    pub jumps: Vec<Jump>,
    /// The highest thing that is stood on, metres; 0 where all is floor.
    pub highest_support_m: f32,
}

impl Heights {
    pub(super) fn new(clips: &ClipSet) -> Self {
        let skeleton = clips.skeleton();
        if skeleton.leg_length_m().is_none() {
            return Self::default();
        }
        let heights: Vec<Vec<f32>> =
            clips.clips().iter().map(|clip| hips_above_support_m(skeleton, clip)).collect();
        let mut all: Vec<f32> = heights.iter().flatten().copied().collect();
        let usual_hips_m = crate::contacts::percentile(&mut all, 0.5);
        let mut jumps = Vec::new();
        for (clip, heights) in clips.clips().iter().zip(&heights) {
            for span in clip.tag_spans.iter().filter(|span| span.tag == "jump") {
                let frames = span.from.idx()..=span.to.idx().min(heights.len().saturating_sub(1));
                let apex = frames.max_by(|a, b| heights[*a].total_cmp(&heights[*b]));
                jumps.extend(apex.map(|apex| Jump {
                    clip: clip.id.clone(),
                    apex: FrameIdx::from_idx(apex),
                    rise_m: heights[apex] - usual_hips_m,
                }));
            }
        }
        jumps.sort_by(|a, b| b.rise_m.total_cmp(&a.rise_m));
        let levels = clips.clips().iter().flat_map(|clip| &clip.track.world_from_torso);
        Self {
            usual_hips_m,
            lowest_hips_m: crate::contacts::percentile(&mut all, 0.01),
            jumps,
            highest_support_m: levels.map(|torso| torso.level_m).fold(0.0, f32::max),
        }
    }
}

fn hips_above_support_m(skeleton: &Skeleton, clip: &Clip) -> Vec<f32> {
    let path = match skeleton.by_role(JointRole::Hips) {
        Some(hips) => clip.motion.joint_path_m(skeleton, hips),
        None => clip.motion.root_positions_m().to_vec(),
    };
    path.iter().zip(&clip.track.world_from_torso).map(|(hips, at)| hips.y - at.level_m).collect()
}

//! A clip more in the palette: the fastest, the highest, or one with the tag.

use motion_core::clip::Clip;
use motion_core::ids::{ClipId, JointIdx};

use super::candidate::Candidate;
use super::{Case, Change};
use crate::command::Command;
use crate::palette::{TaggedClip, palette_with};
use crate::problem::has_tag;
use crate::unmet::missed::Missed;
use crate::unmet::too_fast::top_speed_m_s;

/// To allow a clip is as much of a change as this, in tolerances.
const SIZE: f32 = 2.0;

/// For each thing that is missed the clip outside the palette that has most of what it lacks.
pub(super) fn candidates(case: &Case<'_>) -> Vec<Candidate> {
    let allowed = &case.asked.problem.allowed_clips;
    if !allowed.contains(&false) {
        return Vec::new();
    }
    let clips = case.library.clips.clips();
    let tagged: Vec<TaggedClip<'_>> =
        clips.iter().map(|clip| (clip.id.as_str(), clip.tags.as_slice())).collect();
    let best = |value: &dyn Fn(usize, &Clip) -> f32, least: f32| -> Option<usize> {
        let outside = clips.iter().enumerate().filter(|(nth, _)| !allowed[*nth]);
        let valued = outside.map(|(nth, clip)| (nth, value(nth, clip)));
        let good = valued.filter(|(_, value)| *value > least);
        good.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0))).map(|(nth, _)| nth)
    };
    let speed = |nth: usize, _: &Clip| {
        let mut alone = vec![false; clips.len()];
        alone[nth] = true;
        top_speed_m_s(&alone, case.library) as f32
    };
    let of_missed = |missed: &Missed| match *missed {
        Missed::Body(_) | Missed::Follow(_) | Missed::Length => {
            best(&speed, top_speed_m_s(allowed, case.library) as f32)
        }
        Missed::Style(nth) => {
            let wish = case.wishes().styles.get(nth)?;
            let has = |_: usize, clip: &Clip| {
                if has_tag(clip, wish) { clip.n_frames() as f32 } else { 0.0 }
            };
            best(&has, 0.0)
        }
        Missed::Joint(nth) => {
            let wish = case.wishes().joints.get(nth)?;
            let height_m = wish.position_m.y;
            let near = |_: usize, clip: &Clip| -away_in_height_m(case, clip, wish.joint, height_m);
            best(&near, f32::NEG_INFINITY)
        }
        _ => None,
    };
    let mut found: Vec<usize> = case.missed.iter().filter_map(of_missed).collect();
    found.sort_unstable();
    found.dedup();
    let candidate = |nth: usize| {
        let id = &case.library.clips.clip(ClipId::from_idx(nth)).id;
        let palette = palette_with(case.document.palette(), &tagged, id, true);
        Candidate {
            change: Change::Palette,
            about: id.clone(),
            words: format!("allow the clip {id:?} too"),
            size: SIZE,
            commands: vec![Command::SetPalette { palette }],
        }
    };
    found.into_iter().map(candidate).collect()
}

/// How far a joint's height in a clip stays from `height_m`, metres.
fn away_in_height_m(case: &Case<'_>, clip: &Clip, joint: JointIdx, height_m: f32) -> f32 {
    let path_m = clip.motion.joint_path_m(case.library.clips.skeleton(), joint);
    path_m.iter().map(|at| (at.y - height_m).abs()).fold(f32::INFINITY, f32::min)
}

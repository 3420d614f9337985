//! Bridges to the beginnings of clips and from their ends.
//!
//! That a clip is in the main component does not mean that all of it can be shown: one that is
//! entered only after its first half has a first half that only a motion's start can show, and a pose
//! there could not be asked for at a later time. So clips that are entered late, or left for the last
//! time early, get the cheapest well-separated cuts to their first frames, or from their last.

use rayon::prelude::*;

use super::bridges::{Bridge, well_separated};
use super::components::Connectivity;
use super::forest::Edge;
use crate::ids::ClipId;
use crate::similarity::FeatureSet;
use crate::units::FrameIdx;

/// A clip should be entered within so many frames of its beginning, and left so near its end.
pub const WITHIN: u32 = 9;

/// Frames of the library that are compared with each of a clip's first or last at first.
const MAX_ROWS: usize = 20_000;

/// Valleys of which the bottom is looked for, the lowest of those that were found at first: with
/// thousands of clips most are far too high.
const MAX_VALLEYS: usize = 1024;

/// Bridges for every clip of which a part can only be shown at a motion's start or end.
pub fn find_entrances(
    features: &FeatureSet,
    connectivity: &Connectivity,
    clip_frames: &[u32],
) -> Vec<Bridge> {
    let n_clips = clip_frames.len();
    let n_frames: usize = clip_frames.iter().map(|&n| n as usize).sum();
    let stride = (n_frames / MAX_ROWS).max(3);
    let find = |clip: usize| {
        let n = clip_frames[clip];
        // Copies of the take are likest at the same moment, where a cut is none.
        let hand = |clip: usize| features.families.hand(ClipId::from_idx(clip));
        let is_other = |other: usize| hand(other) != hand(clip);
        let mut found = Vec::new();
        if n < 2 * WITHIN {
            return found;
        }
        if connectivity.reachable_from[clip] > WITHIN {
            // From frames that have themselves been reached, and at least one of which is shown.
            let others = |other: usize| {
                is_other(other).then(|| connectivity.reachable_from[other] + 1..clip_frames[other])
            };
            let valleys = valleys(features, clip, 0..WITHIN, clip_frames, others, stride);
            found.extend(cuts(valleys, |own, (other, frame)| bridge((other, frame), own)));
        }
        if connectivity.dead_from[clip] < n - WITHIN {
            let others = |other: usize| {
                let end = connectivity.dead_from[other].min(clip_frames[other]);
                is_other(other).then(|| 0..end.saturating_sub(1))
            };
            let valleys = valleys(features, clip, n - WITHIN..n, clip_frames, others, stride);
            found.extend(cuts(valleys, bridge));
        }
        found
    };
    (0..n_clips).into_par_iter().map(find).collect::<Vec<_>>().concat()
}

/// A frame of a clip.
type Frame = (usize, u32);

fn bridge((from, from_frame): Frame, (to, to_frame): Frame) -> Bridge {
    Bridge {
        from: ClipId::from_idx(from),
        to: ClipId::from_idx(to),
        // The cost is filled in by `cuts`.
        edge: Edge { from_frame: FrameIdx(from_frame), to_frame: FrameIdx(to_frame), cost: 0.0 },
    }
}

fn cuts(valleys: Vec<(f64, Frame, Frame)>, bridge: impl Fn(Frame, Frame) -> Bridge) -> Vec<Bridge> {
    let with_cost = valleys.into_iter().map(|(cost, own, other)| {
        let mut bridge = bridge(own, other);
        bridge.edge.cost = cost as f32;
        bridge
    });
    well_separated(with_cost.collect())
}

/// Local minima of the cost between some frames of a clip and those of others, cheapest first.
fn valleys(
    features: &FeatureSet,
    clip: usize,
    own: std::ops::Range<u32>,
    clip_frames: &[u32],
    others: impl Fn(usize) -> Option<std::ops::Range<u32>>,
    stride: usize,
) -> Vec<(f64, Frame, Frame)> {
    let row = |(clip, frame): Frame| features.frame_starts[clip] + frame as usize;
    let cost = |own: u32, other: Frame| features.cost(row((clip, own)), row(other));
    let middle = (own.start + own.end) / 2;
    let mut starts = Vec::new();
    for other in 0..clip_frames.len() {
        let Some(range) = others(other).filter(|range| !range.is_empty()) else { continue };
        let coarse: Vec<(u32, f64)> =
            range.clone().step_by(stride).map(|f| (f, cost(middle, (other, f)))).collect();
        for (nth, &(frame, here)) in coarse.iter().enumerate() {
            let beside = [nth.checked_sub(1), Some(nth + 1)];
            let mut beside = beside.into_iter().flatten().filter_map(|nth| coarse.get(nth));
            if beside.any(|&(_, there)| there < here) {
                continue;
            }
            starts.push((here, other, frame));
        }
    }
    if starts.len() > MAX_VALLEYS {
        starts.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        starts.truncate(MAX_VALLEYS);
    }
    let mut found = Vec::new();
    for (here, other, frame) in starts {
        let Some(range) = others(other) else { continue };
        // To the bottom, along both clips.
        let (mut at, mut least) = ((middle, frame), here);
        loop {
            let before = at;
            for a in before.0.saturating_sub(1)..=before.0 + 1 {
                for b in before.1.saturating_sub(1)..=before.1 + 1 {
                    if own.contains(&a) && range.contains(&b) {
                        let value = cost(a, (other, b));
                        if value < least {
                            (at, least) = ((a, b), value);
                        }
                    }
                }
            }
            if at == before {
                break;
            }
        }
        found.push((least, (clip, at.0), (other, at.1)));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    found
}

#[cfg(test)]
mod tests {
    use crate::graph::{BuildOptions, TauRule, build};
    use crate::testing::wander;

    #[test]
    fn every_clip_is_entered_near_its_beginning_and_left_near_its_end() {
        let clips = wander::clips(6, 90, false, 21);
        // So strict that hardly anything is joined by τ alone.
        let options = BuildOptions { tau: TauRule::NeighbourQuantile(0.05), ..Default::default() };
        let cancel = crate::cancel::CancelToken::new();
        let graph = build(&clips, &options, &cancel, &|_| ()).expect("a graph");
        let within = super::WITHIN;
        for clip in 0..6 {
            let (first, dead) =
                (graph.with_bridges.reachable_from[clip], graph.with_bridges.dead_from[clip]);
            assert!(first <= within + 1, "clip {clip} is entered at {first}");
            assert!(dead >= 90 - within, "clip {clip} is left for the last time at {dead}");
        }
    }
}

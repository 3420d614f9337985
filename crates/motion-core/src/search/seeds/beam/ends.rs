//! Where paths of a beam end, and the best of them.

use super::Beam;
use super::node::Node;
use crate::path::Path;
use crate::search::route::Route;
use crate::units::FrameIdx;

/// Whole paths that are laid out; the best is taken.
const N_FINALS: usize = 4;

/// Frames beside the wished length at which a path may end.
const END_SLACK: [i64; 5] = [0, -3, 3, -6, 6];

/// A path that has come to its end.
pub(super) struct Final {
    score: f32,
    node: u32,
    end: u32,
}

impl Beam<'_> {
    /// Playing on to the end, at the wished length and a little beside it.
    pub(super) fn try_ends(&mut self, idx: u32, node: &Node) {
        if node.next_anchor < self.anchors.len() {
            return;
        }
        let n_in_clip = i64::from(self.library.n_frames(node.clip));
        for slack in END_SLACK {
            let n_frames = i64::from(self.n_frames) + slack;
            let end = i64::from(node.entered) + n_frames - 1 - i64::from(node.at);
            if end + 1 < i64::from(node.must_show) || end >= n_in_clip {
                continue;
            }
            let length = self.target.frames_cost(n_frames as u32);
            if !length.is_finite() {
                continue;
            }
            let stretch = self.stretch_of(node, node.entered, end as u32 + 1);
            let mut score = node.cost + length + self.stretch_cost(&stretch);
            if let Some(wish) = &self.target.last {
                score += wish.cost(self.library, node.world_from_clip, node.clip, end as u32);
            }
            let at = self.finals.partition_point(|known| known.score <= score);
            if at < N_FINALS {
                self.finals.insert(at, Final { score, node: idx, end: end as u32 });
                self.finals.truncate(N_FINALS);
            }
        }
    }

    /// The best whole path.
    pub(super) fn best(&self) -> Option<Route> {
        let routes = self.finals.iter().filter_map(|last| {
            let mut cuts = Vec::new();
            let mut node = self.nodes[last.node as usize];
            while let Some((before, cut)) = node.before {
                cuts.push(cut);
                node = self.nodes[before as usize];
            }
            cuts.reverse();
            let (first_clip, start) = (node.clip, FrameIdx(node.entered));
            let path = Path { first_clip, start, cuts, end: FrameIdx(last.end) };
            Route::new(self.library, self.target, path)
        });
        routes.min_by(|a, b| a.score.total_cmp(&b.score))
    }
}

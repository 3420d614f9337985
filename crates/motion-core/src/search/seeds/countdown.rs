//! What it costs to show a certain frame of a clip in exactly so many frames from now, from every frame
//! of the library: a dynamic program backwards through time over the chosen cuts.
//!
//! Let `A(f, k)` be the least cost of cuts when `f` is shown now and the wished frame after `k` more.
//! Then `A(f, k)` is the least of `A(f + 1, k − 1)`, for playing on, and of `cost + A(t, k − 1)` over the
//! cuts from `f + 1` to `t`. It is exact for these cuts; others may be cheaper.

use super::super::library::SearchLibrary;
use crate::ids::ClipId;

/// Frames of all clips times frames of time that are looked at, at most.
const MAX_ENTRIES: usize = 16 << 20;

/// With no more cuts than this times frames of time, every leaf is looked at, else the chosen ones.
const MAX_STEPS: usize = 20_000_000;

/// The least cost of cuts by frame and time left.
#[derive(Debug)]
pub(crate) struct Countdown {
    /// Where each clip's frames begin in a layer.
    starts: Vec<usize>,
    /// Layer `k`: entry by frame, in τ; infinite where there is no way.
    layers: Vec<Vec<f32>>,
}

impl Countdown {
    /// For frame `frame` of `clip`, up to `longest` frames before; fewer where that would take too much
    /// memory. `None` where hardly any time could be looked at.
    pub(crate) fn new(
        library: &SearchLibrary,
        (allowed, bridges): (&[bool], bool),
        (clip, frame): (ClipId, u32),
        longest: u32,
    ) -> Option<Self> {
        let n_clips = library.graph().n_clips();
        let clips = || (0..n_clips).map(ClipId::from_idx);
        let mut starts = vec![0usize];
        for clip in clips() {
            starts.push(starts[starts.len() - 1] + library.n_frames(clip) as usize);
        }
        let n_frames = starts[n_clips];
        let n_layers = (longest as usize + 1).min(MAX_ENTRIES / n_frames.max(1));
        if n_layers < (longest as usize + 1).min(30) {
            return None;
        }
        let mut cuts: Vec<(u32, u32, f32)> = Vec::new();
        let every_leaf = library.n_leaves() * n_layers <= MAX_STEPS;
        for to in clips().filter(|to| allowed[to.idx()] && *to != clip) {
            for (from, pair) in library.pairs_into(to) {
                for cut in if every_leaf { pair.leaves } else { pair.chosen } {
                    let usable = allowed[from.idx()] && (bridges || cut.id.0 < pair.first_bridge);
                    if usable && cut.from > 0 {
                        let from = starts[from.idx()] + cut.from as usize - 1;
                        let to = starts[to.idx()] + cut.to as usize;
                        cuts.push((from as u32, to as u32, cut.cost));
                    }
                }
            }
        }
        // Into the clip itself by any leaf: the last cut settles the time.
        for (from, pair) in library.pairs_into(clip) {
            for cut in pair.leaves {
                let usable = allowed[from.idx()] && (bridges || cut.id.0 < pair.first_bridge);
                if usable && cut.from > 0 && cut.to <= frame {
                    let from = starts[from.idx()] + cut.from as usize - 1;
                    cuts.push((
                        from as u32,
                        (starts[clip.idx()] + cut.to as usize) as u32,
                        cut.cost,
                    ));
                }
            }
        }
        let mut layers: Vec<Vec<f32>> = Vec::with_capacity(n_layers);
        let mut now = vec![f32::INFINITY; n_frames];
        now[starts[clip.idx()] + frame as usize] = 0.0;
        layers.push(now);
        for _ in 1..n_layers {
            let before = &layers[layers.len() - 1];
            let mut now = vec![f32::INFINITY; n_frames];
            now[..n_frames - 1].copy_from_slice(&before[1..]);
            for clip in 0..n_clips {
                // The last frame of a clip is followed by nothing.
                if starts[clip + 1] > starts[clip] {
                    now[starts[clip + 1] - 1] = f32::INFINITY;
                }
            }
            for &(from, to, cost) in &cuts {
                let there = &mut now[from as usize];
                *there = there.min(before[to as usize] + cost);
            }
            layers.push(now);
        }
        Some(Self { starts, layers })
    }

    /// The least cost when `frame` of `clip` is shown now and the wished frame in `left` frames;
    /// `None` where so much time is not looked at.
    #[inline]
    pub(crate) fn cost(&self, clip: ClipId, frame: u32, left: u32) -> Option<f32> {
        let layer = self.layers.get(left as usize)?;
        Some(layer[self.starts[clip.idx()] + frame as usize])
    }
}

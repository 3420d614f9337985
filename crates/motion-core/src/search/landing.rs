//! The ways back from a stretch of another clip, laid out for a scan of many at once.
//!
//! A detour through clip `m` moves the rest of the route by `world_from_m · m_from_old`, where
//! `m_from_old` depends on the way back alone. So it is computed once for all ways out, and a scan needs
//! one planar product a candidate and the sums of what is read behind it.

use super::library::{Cut, PairView, SearchLibrary};
use super::moments::Moments;
use super::tables::Tables;
use super::target::Target;
use crate::graph::EdgeId;
use crate::ids::ClipId;
use crate::planar::PlanarTransform;

/// Ways back into every piece from every clip, in columns.
pub(crate) struct Landings {
    n_clips: usize,
    /// Where the ways from clip `m` into piece `r` stand: entry `r · n_clips + m`.
    ranges: Vec<Range>,
    /// Where the route's old world lies in the clip's.
    moves: Vec<PlanarTransform>,
    /// The frame of the clip at which it is left.
    left_at: Vec<u32>,
    cost: Vec<f32>,
    shift: Vec<f32>,
    cuts: Vec<EdgeId>,
}

#[derive(Clone, Copy, Default)]
struct Range {
    start: u32,
    end: u32,
    cheapest: f32,
}

/// What is the same for all candidates of one scan.
pub(crate) struct Scan {
    /// Where the clip of the detour lies in the motion's world.
    pub(crate) world_from_clip: PlanarTransform,
    /// Score without the way back, the length and the last checkpoint.
    pub(crate) base: f32,
    /// Frames of the motion are this and the cut's shift.
    pub(crate) unshifted: i64,
    /// Candidates that cannot score below this are left out.
    pub(crate) limit: f32,
    /// Frames of the route as it is.
    pub(crate) n_frames_now: i64,
    /// The motion's frame at which the route is left …
    pub(crate) left_at: u32,
    /// … and the frame of the clip that is entered then.
    pub(crate) entered: u32,
    /// The motion's frame that shows the first frame of the piece to come back to, as it is.
    pub(crate) resumes_at: u32,
}

impl Landings {
    /// Lays out the chosen ways back of a route. `usable` says which cuts may be used.
    pub(crate) fn new(
        library: &SearchLibrary,
        tables: &Tables,
        window: std::ops::Range<usize>,
        n_clips: usize,
        usable: impl Fn(&PairView<'_>, EdgeId) -> bool,
    ) -> Self {
        let mut new = Self {
            n_clips,
            ranges: vec![Range::default(); tables.spans.len() * n_clips],
            moves: vec![],
            left_at: vec![],
            cost: vec![],
            shift: vec![],
            cuts: vec![],
        };
        for resume in window {
            let tail = &tables.spans[resume];
            for (middle, pair) in library.pairs_into(tail.span.clip) {
                let torsos = library.torsos(middle);
                let start = new.cuts.len() as u32;
                for cut in pair.chosen {
                    if cut.to >= tail.span.to || !usable(&pair, cut.id) {
                        continue;
                    }
                    let clip_from_old =
                        torsos[cut.from as usize] * tail.torso[cut.to as usize].inverse();
                    new.moves.push(clip_from_old);
                    new.left_at.push(cut.from);
                    new.cost.push(cut.cost);
                    new.shift.push(cut.shift() as f32);
                    new.cuts.push(cut.id);
                }
                new.ranges[resume * n_clips + middle.idx()] =
                    Range { start, end: new.cuts.len() as u32, cheapest: pair.cheapest };
            }
        }
        new
    }

    /// The ways back from `middle` into piece `resume` that may score below the limit, by a
    /// bound of the whole score without what lies in the detour itself; calls `hit` with each.
    /// `sums(k, late)` are those of the readings from the `k`-th on. Returns how many were left out.
    #[inline]
    pub(crate) fn scan<'s>(
        &self,
        target: &Target,
        (middle, resume): (ClipId, usize),
        scan: &Scan,
        sums: impl Fn(usize, i64) -> Option<&'s Moments>,
        mut hit: impl FnMut(Cut),
    ) -> u64 {
        let range = self.ranges[resume * self.n_clips + middle.idx()];
        let n = u64::from(range.end - range.start);
        let continuity = target.weights.continuity;
        if n == 0 || scan.base + continuity * range.cheapest >= scan.limit {
            return n;
        }
        let (start, end) = (range.start as usize, range.end as usize);
        let budget = scan.limit - scan.base - continuity * range.cheapest;
        let mut window = target.frames_window(budget);
        let is_hard = target.is_hard_after(scan.left_at);
        if is_hard {
            window = (window.0.max(scan.n_frames_now), window.1.min(scan.n_frames_now));
        }
        let shifts = &self.shift[start..end];
        let low = (window.0 - scan.unshifted) as f32;
        let high = (window.1 - scan.unshifted) as f32;
        let first = start + shifts.partition_point(|&shift| shift < low);
        let last = start + shifts.partition_point(|&shift| shift <= high);
        let (n_readings, frames) = (target.readings.len(), target.frames_quadratic());
        let next_hard = target.hard.partition_point(|hard| hard.last < scan.left_at);
        let next_hard = target.hard.get(next_hard).map_or(u32::MAX, |hard| hard.first);
        // With nothing to read on the way the sums are the same for all.
        let alone = sums(n_readings, 0);
        let mut n_hits = 0;
        for at in first..last {
            if self.left_at[at] <= scan.entered {
                continue;
            }
            let n_frames = scan.unshifted as f32 + self.shift[at];
            let (long, late) = (n_frames - frames.length, n_frames - frames.last);
            let mut bound = scan.base
                + continuity * self.cost[at]
                + frames.length_factor * long * long
                + frames.last_factor * late * late;
            if bound >= scan.limit {
                continue;
            }
            let back_at = scan.left_at + self.left_at[at] - scan.entered;
            if is_hard && back_at > next_hard {
                continue;
            }
            let known = if n_readings == 0 {
                alone
            } else {
                let late = scan.unshifted + self.shift[at] as i64 - scan.n_frames_now;
                // Before the piece's own frames the sums know those of the piece before it.
                let known_from = (i64::from(scan.resumes_at) + late).max(i64::from(back_at));
                sums(target.first_reading_from(known_from as u32), late).or(alone)
            };
            if let Some(known) = known {
                let moved = scan.world_from_clip * self.moves[at];
                bound += known.place_cost(moved) + known.turn_cost_at_least(moved);
            }
            if bound < scan.limit {
                n_hits += 1;
                let (from, cost, id) = (self.left_at[at], self.cost[at], self.cuts[at]);
                let to = (i64::from(from) - self.shift[at] as i64) as u32;
                hit(Cut { from, to, cost, id });
            }
        }
        n - n_hits
    }
}

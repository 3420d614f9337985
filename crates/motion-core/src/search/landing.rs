//! The ways back from a stretch of another clip, laid out for a scan of many at once.
//!
//! A detour through clip `m` ends where `world_from_m · m_from_end` lies, and `m_from_end`
//! depends on the way back alone. So it is computed once for all ways out, and a scan needs one
//! planar product a candidate, eight side by side.

use super::library::{PairView, SearchLibrary};
use super::problem::Target;
use super::tables::Tables;
use crate::constraint::{TOLERANCE_M, TOLERANCE_RAD};
use crate::graph::EdgeId;
use crate::ids::ClipId;
use crate::planar::PlanarTransform;

/// Candidates that are computed side by side.
const LANES: usize = 8;

/// Ways back into every piece from every clip, in columns.
pub(crate) struct Landings {
    n_clips: usize,
    /// Where the ways from clip `m` into piece `r` stand: entry `r · n_clips + m`.
    ranges: Vec<Range>,
    cos: Vec<f32>,
    sin: Vec<f32>,
    x_m: Vec<f32>,
    z_m: Vec<f32>,
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
}

impl Landings {
    /// Lays out the chosen ways back of a route. `usable` says which cuts may be used.
    pub(crate) fn new(
        library: &SearchLibrary,
        tables: &Tables,
        n_clips: usize,
        usable: impl Fn(&PairView<'_>, EdgeId) -> bool,
    ) -> Self {
        let mut new = Self {
            n_clips,
            ranges: vec![Range::default(); tables.spans.len() * n_clips],
            cos: vec![],
            sin: vec![],
            x_m: vec![],
            z_m: vec![],
            cost: vec![],
            shift: vec![],
            cuts: vec![],
        };
        for (resume, tail) in tables.spans.iter().enumerate() {
            for (middle, pair) in library.pairs_into(tail.span.clip) {
                let torsos = library.torsos(middle);
                let start = new.cuts.len() as u32;
                for cut in pair.chosen {
                    if cut.to >= tail.span.to || !usable(&pair, cut.id) {
                        continue;
                    }
                    let clip_from_end =
                        torsos[cut.from as usize] * tail.end_from_torso[cut.to as usize];
                    new.cos.push(clip_from_end.cos());
                    new.sin.push(clip_from_end.sin());
                    new.x_m.push(clip_from_end.x_m);
                    new.z_m.push(clip_from_end.z_m);
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
    /// bound of the whole score without inner checkpoints; calls `hit` with each. Returns how
    /// many were left out.
    #[inline]
    pub(crate) fn scan(
        &self,
        target: &Target,
        (middle, resume): (ClipId, usize),
        scan: &Scan,
        mut hit: impl FnMut(EdgeId),
    ) -> u64 {
        let range = self.ranges[resume * self.n_clips + middle.idx()];
        let n = u64::from(range.end - range.start);
        let continuity = target.weights.continuity;
        if n == 0 || scan.base + continuity * range.cheapest >= scan.limit {
            return n;
        }
        let (start, end) = (range.start as usize, range.end as usize);
        let budget = scan.limit - scan.base - continuity * range.cheapest;
        let window = target.frames_window(budget);
        let shifts = &self.shift[start..end];
        let low = (window.0 - scan.unshifted) as f32;
        let high = (window.1 - scan.unshifted) as f32;
        let first = start + shifts.partition_point(|&shift| shift < low);
        let last = start + shifts.partition_point(|&shift| shift <= high);
        let mut n_hits = 0;
        let mut at = first;
        while at < last {
            let lanes = (last - at).min(LANES);
            let scores = self.bounds(target, scan, at);
            for (lane, &score) in scores.iter().enumerate().take(lanes) {
                if score < scan.limit {
                    n_hits += 1;
                    hit(self.cuts[at + lane]);
                }
            }
            at += LANES;
        }
        n - n_hits
    }

    /// Lower bounds of the scores of [`LANES`] ways from `at` on; those beyond the columns' end
    /// are infinite.
    #[inline]
    fn bounds(&self, target: &Target, scan: &Scan, at: usize) -> [f32; LANES] {
        let lanes = |column: &[f32]| -> [f32; LANES] {
            let mut values = [0.0; LANES];
            match column.get(at..at + LANES) {
                Some(whole) => values.copy_from_slice(whole),
                None => {
                    let rest = &column[at..];
                    values[..rest.len()].copy_from_slice(rest);
                }
            }
            values
        };
        let (cost, shift) = (lanes(&self.cost), lanes(&self.shift));
        let frames = target.frames_quadratic();
        let unshifted = scan.unshifted as f32;
        let mut scores = [0.0f32; LANES];
        for lane in 0..LANES {
            let n_frames = unshifted + shift[lane];
            let (long, late) = (n_frames - frames.length, n_frames - frames.last);
            scores[lane] = scan.base
                + target.weights.continuity * cost[lane]
                + frames.length_factor * long * long
                + frames.last_factor * late * late;
        }
        let Some(end) = &target.last else { return scores };
        let (cos, sin) = (lanes(&self.cos), lanes(&self.sin));
        let (x, z) = (lanes(&self.x_m), lanes(&self.z_m));
        let world = scan.world_from_clip;
        let there = end.world_from_torso;
        let factor = target.weights.body * end.weight;
        let place = factor / (TOLERANCE_M * TOLERANCE_M);
        let turn = factor / (TOLERANCE_RAD * TOLERANCE_RAD);
        for lane in 0..LANES {
            let dx = world.cos() * x[lane] + world.sin() * z[lane] + (world.x_m - there.x_m);
            let dz = world.cos() * z[lane] - world.sin() * x[lane] + (world.z_m - there.z_m);
            let cos_at = world.cos() * cos[lane] - world.sin() * sin[lane];
            let sin_at = world.sin() * cos[lane] + world.cos() * sin[lane];
            // A chord is never longer than its arc.
            let chord = 2.0 - 2.0 * (cos_at * there.cos() + sin_at * there.sin());
            scores[lane] += place * (dx * dx + dz * dz) + turn * chord.max(0.0);
        }
        scores
    }
}

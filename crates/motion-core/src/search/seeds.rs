//! Seed paths: random, but they know time and place.
//!
//! A seed is grown cut by cut. At each step some coarse cuts are drawn and each is followed a
//! little way; the one that comes nearest to where the body should be by then is taken. Where it
//! should be is drawn between the checkpoints in proportion to time, and matters the more the
//! nearer a checkpoint is. How many are drawn differs from seed to seed: with one the seed is a
//! random walk, with many it is greedy.

use glam::Vec2;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::library::{Cut, SearchLibrary};
use super::route::Route;
use super::target::Target;
use crate::ids::ClipId;
use crate::path::Path;
use crate::planar::{PlanarTransform, wrap_angle_rad};
use crate::units::FrameIdx;

/// Pieces of a seed show at least this many frames: shorter ones are left to the mutations.
const MIN_PIECE: u32 = 8;

/// How far beyond a cut a seed looks, in frames.
const LOOK_AHEAD: u32 = 30;

/// A seed has at most this many pieces.
const MAX_PIECES: usize = 400;

/// Lengths tried where nothing says how long the motion should be.
const FREE_FRAMES: std::ops::Range<u32> = 60..300;

/// Where a body should be, frame by frame.
struct Schedule {
    /// Frame, ground position, heading.
    points: Vec<(u32, Vec2, f32)>,
    fps: f32,
}

impl Schedule {
    fn new(target: &Target, n_frames: u32, fps: f32) -> Self {
        let point = |frame, t: PlanarTransform| (frame, t.ground_m(), t.heading_rad());
        let mut points = vec![point(target.anchor_frame, target.anchor)];
        points.extend(target.waypoints.iter().map(|&(frame, torso)| point(frame, torso)));
        // The last checkpoint is read at the last frame, whatever its own is.
        points.extend(target.last_torso.map(|torso| point(n_frames - 1, torso)));
        Self { points, fps }
    }

    /// The first checkpoint at or after `frame`.
    fn next_frame(&self, frame: u32) -> Option<u32> {
        self.points.iter().map(|p| p.0).find(|&f| f >= frame)
    }

    /// How far `at` is from where it should be at `frame`, in squared slacks.
    fn error(&self, frame: u32, at: PlanarTransform) -> f32 {
        let after = self.points.partition_point(|p| p.0 < frame);
        let Some(&(end, to, heading)) = self.points.get(after) else { return 0.0 };
        if after == 0 {
            return 0.0;
        }
        let (start, from, _) = self.points[after - 1];
        let t = (frame - start) as f32 / (end - start).max(1) as f32;
        let should = from.lerp(to, t);
        let secs_left = (end - frame) as f32 / self.fps;
        let secs_past = (frame - start) as f32 / self.fps;
        let slack_m = 0.3 + 0.6 * secs_left.min(secs_past);
        let place = (at.ground_m() - should).length_squared() / (slack_m * slack_m);
        // Which way it looks matters towards the end of a leg.
        let slack_rad = 0.17 + 1.2 * secs_left;
        let turn = wrap_angle_rad(at.heading_rad() - heading) / slack_rad;
        place + turn * turn
    }
}

/// Grows one seed; `None` when it ran into a dead end.
pub(crate) fn grow(
    library: &SearchLibrary,
    target: &Target,
    (allowed, bridges): (&[bool], bool),
    rng: &mut Pcg64Mcg,
) -> Option<Route> {
    let n_frames = target.frames.unwrap_or_else(|| rng.random_range(FREE_FRAMES));
    let needed = target.needed() + 1;
    let n_frames = n_frames.max(needed).max(1);
    let schedule = Schedule::new(target, n_frames, library.clips().fps().get() as f32);
    // 1, 2, 4 … 64 draws a step.
    let n_draws = 1usize << rng.random_range(1..7);
    let continuity = target.weights.continuity * rng.random_range(0.2f32..1.0);
    let (clip, start) = draw_start(library, target, &schedule, allowed, n_draws, n_frames, rng)?;
    let mut path =
        Path { first_clip: clip, start: FrameIdx(start), cuts: vec![], end: FrameIdx(start) };

    let (mut clip, mut entered, mut frame) = (clip, start, 0u32);
    let mut torso = target.anchor;
    for _ in 0..MAX_PIECES {
        let torsos = library.torsos(clip);
        let world_from_clip = torso * torsos[entered as usize].inverse();
        let end = entered + (n_frames - 1 - frame);
        let can_end = (end as usize) < torsos.len();
        // Going on to the end within this clip competes with the cuts.
        let mut best: Option<(f32, Option<(ClipId, Cut)>)> = can_end.then(|| {
            let error = schedule.error(n_frames - 1, world_from_clip * torsos[end as usize]);
            (error, None)
        });
        let out = library.coarse_out(clip);
        let first = out.partition_point(|(_, cut)| cut.from < entered + MIN_PIECE);
        let last = out.partition_point(|(_, cut)| cut.from <= end);
        if first < last {
            for _ in 0..n_draws {
                let (to, cut) = out[rng.random_range(first..last)];
                let usable =
                    allowed[to.idx()] && (bridges || !library.graph().forest.is_bridge(cut.id));
                if !usable {
                    continue;
                }
                let at_cut = frame + cut.from - entered;
                let to_torsos = library.torsos(to);
                let ahead = look_ahead(&schedule, at_cut, n_frames);
                let reach = (cut.to + ahead).min(to_torsos.len() as u32 - 1);
                // A clip that ends before the motion does must still have a way out.
                let ends_early = at_cut + (reach - cut.to) < n_frames - 1;
                let dead = library.graph().with_bridges.dead_from[to.idx()];
                if ends_early && cut.to + MIN_PIECE >= dead {
                    continue;
                }
                let there = world_from_clip
                    * torsos[cut.from as usize]
                    * to_torsos[cut.to as usize].inverse()
                    * to_torsos[reach as usize];
                let error = schedule.error(at_cut + reach - cut.to, there) + continuity * cut.cost;
                if best.as_ref().is_none_or(|(least, _)| error < *least) {
                    best = Some((error, Some((to, cut))));
                }
            }
        }
        match best? {
            (_, None) => {
                path.end = FrameIdx(end);
                return Route::new(library, target, path);
            }
            (_, Some((to, cut))) => {
                torso = world_from_clip * torsos[cut.from as usize];
                frame += cut.from - entered;
                clip = to;
                entered = cut.to;
                path.cuts.push(cut.id);
            }
        }
    }
    None
}

/// Frames to look ahead from `frame`: a second, but not past the next checkpoint or the end.
fn look_ahead(schedule: &Schedule, frame: u32, n_frames: u32) -> u32 {
    let end = schedule.next_frame(frame).unwrap_or(n_frames - 1).min(n_frames - 1);
    LOOK_AHEAD.min(end.saturating_sub(frame))
}

fn draw_start(
    library: &SearchLibrary,
    target: &Target,
    schedule: &Schedule,
    allowed: &[bool],
    n_draws: usize,
    n_frames: u32,
    rng: &mut Pcg64Mcg,
) -> Option<(ClipId, u32)> {
    let mut best: Option<(f32, ClipId, u32)> = None;
    let n_clips = library.graph().n_clips();
    let mut tries = 0;
    let mut drawn = 0;
    while drawn < n_draws && tries < 1000 {
        tries += 1;
        let clip = ClipId::from_idx(rng.random_range(0..n_clips));
        let torsos = library.torsos(clip);
        let start = rng.random_range(0..torsos.len() as u32);
        let dead = library.graph().with_bridges.dead_from[clip.idx()];
        let ends_here = (start + n_frames - 1) < torsos.len() as u32;
        if !allowed[clip.idx()] || (start + MIN_PIECE >= dead && !ends_here) {
            continue;
        }
        drawn += 1;
        let reach = start + look_ahead(schedule, 0, n_frames);
        let reach = reach.min(torsos.len() as u32 - 1);
        let there = target.anchor * torsos[start as usize].inverse() * torsos[reach as usize];
        let error = schedule.error(reach - start, there);
        if best.as_ref().is_none_or(|(least, _, _)| error < *least) {
            best = Some((error, clip, start));
        }
    }
    best.map(|(_, clip, start)| (clip, start))
}

/// A path with a random stretch replaced by random coarse edges, for a fresh start near a known
/// good motion; `None` when the draw does not fit.
pub(crate) fn perturb(
    library: &SearchLibrary,
    target: &Target,
    (allowed, bridges): (&[bool], bool),
    route: &Route,
    rng: &mut Pcg64Mcg,
) -> Option<Route> {
    let n_spans = route.spans.len();
    let keep = rng.random_range(0..n_spans);
    let resume = (keep + rng.random_range(0..3)).min(n_spans - 1);
    let out = library.coarse_out(route.spans[keep].clip);
    let first = out.partition_point(|(_, cut)| cut.from <= route.spans[keep].from);
    if first >= out.len() {
        return None;
    }
    for _ in 0..8 {
        let (middle, cut) = out[rng.random_range(first..out.len())];
        let usable =
            allowed[middle.idx()] && (bridges || !library.graph().forest.is_bridge(cut.id));
        if !usable {
            continue;
        }
        let Some(back) = library.pair(middle, route.spans[resume].clip) else { continue };
        let fits: Vec<Cut> = back
            .chosen
            .iter()
            .filter(|b| b.from > cut.to && b.to < route.spans[resume].to)
            .filter(|b| bridges || b.id.0 < back.first_bridge)
            .copied()
            .collect();
        if fits.is_empty() {
            continue;
        }
        let back = fits[rng.random_range(0..fits.len())];
        let mut cuts = route.path.cuts[..keep].to_vec();
        cuts.extend([cut.id, back.id]);
        cuts.extend_from_slice(&route.path.cuts[resume..]);
        return Route::new(library, target, Path { cuts, ..route.path.clone() });
    }
    None
}

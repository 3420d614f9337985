//! What is asked, in the shape that scoring wants.

use super::circles::{TimeCircles, Whereabouts};
use super::hard::{HardStretch, hard_stretches};
use super::library::SearchLibrary;
use super::reading::Reading;
use crate::constraint::clearance::CLEARANCE_M;
use crate::constraint::obstacle::Solid;
use crate::constraint::{BodyConstraint, LengthMode, OtherBody, PoseConstraint, TOLERANCE_FRAMES};
use crate::ids::ClipId;
use crate::planar::PlanarTransform;
use crate::score::{Weights, Wishes};

/// Motions that are acceptable in all else are not expected to cost more for their environment.
const ENVIRONMENT_SLACK: f32 = 100.0;

/// Frames that readings are looked up by; what comes later is searched.
const MAX_TABLED_FRAMES: usize = 1 << 16;

/// A [`super::Problem`]'s wishes, prepared.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    /// Where the torso stands that places the motion (the origin where nothing says) …
    pub(crate) anchor: PlanarTransform,
    /// … and at which frame. 0 almost always.
    pub(crate) anchor_frame: u32,
    /// Everything that is read at its own frame, in the order of frames.
    pub(crate) readings: Vec<Reading>,
    /// For each frame up to the last reading's (of the first [`MAX_TABLED_FRAMES`]), the first of them at or after it.
    first_reading: Vec<u32>,
    /// Checkpoints between the first and the last: where the body should be by when.
    pub(crate) waypoints: Vec<(u32, PlanarTransform)>,
    /// The last checkpoint's place, read at the motion's last frame.
    pub(crate) last: Option<Reading>,
    /// Where the last checkpoint's torso should be.
    pub(crate) last_torso: Option<PlanarTransform>,
    /// Factor of the squared lateness of the last checkpoint.
    late_factor: f32,
    /// A motion of no more frames than this is none.
    needed: u32,
    pub(crate) styles: Vec<StyleTarget>,
    pub(crate) hard: Vec<HardStretch>,
    pub(crate) solids: Vec<Solid>,
    pub(crate) others: Vec<OtherTarget>,
    /// The number of frames that the search aims at, where anything says so.
    pub(crate) frames: Option<u32>,
    exact: bool,
    length_factor: f32,
    length_frames: f32,
    pub(crate) weights: Weights,
    /// Whether feet planted on nothing cost.
    pub(crate) on_the_floor: bool,
    /// What all wishes together cost at most that are within tolerance, but for the environment.
    most_within: f32,
}

/// A style with what each clip lacks of it.
#[derive(Clone, Debug)]
pub(crate) struct StyleTarget {
    pub(crate) from: u32,
    pub(crate) to: u32,
    /// What a frame without the tag adds to the score.
    pub(crate) factor: f32,
    /// Per clip: entry `f` is how many of the frames `0..f` lack the tag.
    lacks: Vec<Vec<u32>>,
}

/// Another body, and where it is, roughly.
#[derive(Clone, Debug)]
pub(crate) struct OtherTarget {
    pub(crate) body: OtherBody,
    pub(crate) circles: TimeCircles,
}

impl OtherTarget {
    fn new(body: &OtherBody) -> Self {
        Self { body: body.clone(), circles: TimeCircles::new(&body.ground_m) }
    }
}

impl StyleTarget {
    /// How many of the frames `from..to` of a clip lack the tag.
    #[inline]
    pub(crate) fn lacking(&self, clip: ClipId, from: u32, to: u32) -> u32 {
        let sums = &self.lacks[clip.idx()];
        sums[to as usize] - sums[from as usize]
    }

    /// What frames `from..to` of a clip cost that are shown from frame `starts_at` of the motion on.
    #[inline]
    pub(crate) fn cost(&self, clip: ClipId, from: u32, to: u32, starts_at: u32) -> f32 {
        let first = self.from.max(starts_at);
        let end = (self.to + 1).min(starts_at + to - from);
        if first >= end {
            return 0.0;
        }
        let in_clip = |frame: u32| from + frame - starts_at;
        self.factor * self.lacking(clip, in_clip(first), in_clip(end)) as f32
    }
}

/// `length_factor · (N − length)² + last_factor · (N − last)²` for `N` frames.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FramesQuadratic {
    pub(crate) length_factor: f32,
    pub(crate) length: f32,
    pub(crate) last_factor: f32,
    pub(crate) last: f32,
}

impl Target {
    /// The wishes must have passed [`super::Problem::check`].
    pub(crate) fn new(library: &SearchLibrary, wishes: &Wishes) -> Self {
        let weights = wishes.weights;
        let (anchor_frame, anchor) = wishes.anchor().unwrap_or((0, PlanarTransform::IDENTITY));
        let body = &wishes.body;
        let (last, upto) = match body.len() {
            0 | 1 => (None, body.len()),
            n => (Some(body[n - 1]), n - 1),
        };
        // What places the motion is met exactly and read all the same: it costs nothing.
        let mut readings: Vec<Reading> =
            body[..upto].iter().map(|c| Reading::of_body(c, weights.body)).collect();
        let places: Vec<BodyConstraint> =
            wishes.poses.iter().filter_map(PoseConstraint::place).collect();
        readings.extend(places.iter().map(|place| Reading::of_body(place, weights.body)));
        for joint in &wishes.joints {
            readings.extend(Reading::of_joint(joint, weights.joint).into_iter().flatten());
        }
        let hard = hard_stretches(wishes).unwrap_or_default();
        let needed = readings.iter().map(|r| r.frame).chain(hard.iter().map(|h| h.last)).max();
        let waypoint = |c: &BodyConstraint| (c.frame, c.world_from_torso());
        let is_whole = |c: &&BodyConstraint| {
            c.tolerance.position_m.is_finite() && c.tolerance.heading_rad.is_finite()
        };
        let checkpoints = body[..upto].iter().chain(&places).filter(is_whole);
        let mut waypoints: Vec<_> =
            checkpoints.map(waypoint).filter(|(frame, _)| *frame != anchor_frame).collect();
        waypoints.sort_by_key(|(frame, _)| *frame);
        waypoints.dedup_by_key(|(frame, _)| *frame);
        for follow in &wishes.follows {
            let points = follow.waypoints();
            let share = weights.path * follow.weight / points.len() as f32;
            let place = share / (follow.tolerance_m * follow.tolerance_m);
            let turn = share / (follow.tolerance_rad * follow.tolerance_rad);
            let turn = if follow.looks_along { turn } else { 0.0 };
            readings.extend(points.iter().map(|p| {
                Reading::of_waypoint(p.frame, p.position_m, p.heading_rad, (place, turn))
            }));
        }
        readings.retain(|r| r.ground > 0.0 || r.height > 0.0 || r.turn > 0.0);
        readings.sort_by_key(|reading| reading.frame);
        let mut first_reading = Vec::new();
        for (nth, reading) in readings.iter().enumerate() {
            let n = (reading.frame as usize + 1).min(MAX_TABLED_FRAMES);
            first_reading.resize(n.max(first_reading.len()), nth as u32);
        }
        let clips = library.clips().clips();
        let styles = wishes.styles.iter().map(|style| StyleTarget {
            from: style.from,
            to: style.to,
            factor: weights.style * style.cost_of_a_frame(),
            lacks: clips
                .iter()
                .map(|clip| {
                    let mut sums = vec![0u32];
                    for (frame, has) in style.frames_with_tag(clip).into_iter().enumerate() {
                        sums.push(sums[frame] + u32::from(!has));
                    }
                    sums
                })
                .collect(),
        });
        let wish = wishes.length.filter(|l| l.mode != LengthMode::Free);
        // Place and height, heading and time of a checkpoint may each be off by one tolerance.
        let body_weight: f32 = body.iter().chain(&places).map(|c| 4.0 * c.weight).sum();
        let joint_weight: f32 = wishes.joints.iter().map(|c| 2.0 * c.weight).sum();
        let most_within = weights.body * body_weight
            + weights.joint * joint_weight
            + wishes.styles.iter().map(|c| 1.01 * weights.style * c.weight).sum::<f32>()
            + wishes.follows.iter().map(|c| 2.0 * weights.path * c.weight).sum::<f32>()
            + wish.map_or(0.0, |l| weights.length * l.weight);
        let level = |height_m: Option<f32>| height_m.unwrap_or(0.0) == 0.0;
        Self {
            anchor,
            anchor_frame,
            styles: styles.collect(),
            last: last.map(|c| Reading::of_body(&c, weights.body)),
            last_torso: last.map(|c| c.world_from_torso()),
            late_factor: last.map_or(0.0, |c| {
                weights.body * c.weight / (c.tolerance.frames * c.tolerance.frames)
            }),
            needed: needed.unwrap_or(0).max(anchor_frame),
            frames: wish.map(|l| l.frames).or(last.map(|c| c.frame + 1)),
            exact: wish.is_some_and(|l| l.mode == LengthMode::Exact),
            length_factor: wish
                .map_or(0.0, |l| weights.length * l.weight / (TOLERANCE_FRAMES * TOLERANCE_FRAMES)),
            length_frames: wish.map_or(0.0, |l| l.frames as f32),
            readings,
            first_reading,
            waypoints,
            hard,
            solids: wishes.obstacles.iter().map(Solid::new).collect(),
            others: wishes.others.iter().map(OtherTarget::new).collect(),
            weights,
            on_the_floor: body.iter().all(|c| level(c.height_m))
                && wishes.poses.iter().all(|p| level(p.height_m)),
            most_within: 1.001 * most_within,
        }
    }

    /// No motion with cuts of this cost (in τ) that is within every tolerance scores more.
    pub(crate) fn most_when_acceptable(&self, cuts_cost: f32) -> f32 {
        // How long a body may be within the margin of an obstacle is not limited.
        let environment = self.has_surroundings() || self.on_the_floor;
        let most = self.most_within + self.weights.continuity * cuts_cost;
        if environment { most + ENVIRONMENT_SLACK * self.weights.environment } else { most }
    }

    /// The last frame that a motion must reach to be one.
    pub(crate) fn needed(&self) -> u32 {
        self.needed
    }

    /// The first reading at or after `frame`, as an index.
    #[inline]
    pub(crate) fn first_reading_from(&self, frame: u32) -> usize {
        match self.first_reading.get(frame as usize) {
            Some(&nth) => nth as usize,
            None => self.readings.partition_point(|reading| reading.frame < frame),
        }
    }

    /// The readings at frames `first..end`.
    #[inline]
    pub(crate) fn readings_within(&self, first: u32, end: u32) -> &[Reading] {
        let from = self.first_reading_from(first);
        &self.readings[from..self.first_reading_from(end).max(from)]
    }

    /// Whether a motion may keep what is before frame `left_at` and show something else until `back_at`,
    /// where the rest follows `late` frames later than before.
    #[inline]
    pub(crate) fn keeps_hard(&self, left_at: u32, back_at: u32, late: i64) -> bool {
        if self.hard.is_empty() {
            return true;
        }
        let next = self.hard.partition_point(|hard| hard.last < left_at);
        self.hard.get(next).is_none_or(|hard| hard.first >= back_at && late == 0)
    }

    /// Whether anything hard is still to come after frame `frame`.
    #[inline]
    pub(crate) fn is_hard_after(&self, frame: u32) -> bool {
        self.hard.last().is_some_and(|hard| hard.last >= frame)
    }

    /// Whether anything costs that depends on all of a body along the way.
    #[inline]
    pub(crate) fn has_surroundings(&self) -> bool {
        !self.solids.is_empty() || !self.others.is_empty()
    }

    /// Whether a body that is there during `BLOCK << level` frames from `first` on may be in the way
    /// of something.
    #[inline(always)]
    pub(crate) fn may_meet(&self, place: &Whereabouts, first: i64, level: usize) -> bool {
        let mut solids = self.solids.iter();
        solids.any(|solid| solid.is_near(place.ground_m, place.joints_radius_m, place.top_m))
            || self.others.iter().any(|other| {
                let (there_m, radius_m) = other.circles.during(first, level);
                let far_m = place.torso_radius_m + radius_m + CLEARANCE_M;
                there_m.distance_squared(place.ground_m) < far_m * far_m
            })
    }

    /// The parts of [`Self::frames_cost`] as squares; exact lengths and checkpoints that are not
    /// reached are not in them, so they are a lower bound.
    pub(crate) fn frames_quadratic(&self) -> FramesQuadratic {
        FramesQuadratic {
            length_factor: self.length_factor,
            length: self.length_frames,
            last_factor: self.late_factor,
            last: self.last.map_or(0.0, |t| t.frame as f32 + 1.0),
        }
    }

    /// The numbers of frames, first and last, whose own cost may lie under `budget`; a bound, not
    /// exact to the frame.
    pub(crate) fn frames_window(&self, budget: f32) -> (i64, i64) {
        if self.exact {
            return (self.length_frames as i64, self.length_frames as i64);
        }
        // a (N − L)² + b (N − 1 − t)² ≤ budget is an interval around the weighted mean.
        let squares = self.frames_quadratic();
        let (a, b) = (f64::from(squares.length_factor), f64::from(squares.last_factor));
        let wished_last = f64::from(squares.last);
        if a + b <= 0.0 || !budget.is_finite() {
            return (0, i64::from(u32::MAX));
        }
        let length = f64::from(self.length_frames);
        let centre = (a * length + b * wished_last) / (a + b);
        let least = a * (centre - length).powi(2) + b * (centre - wished_last).powi(2);
        let reach = ((f64::from(budget) - least).max(0.0) / (a + b)).sqrt() + 1.0;
        if f64::from(budget) < least {
            return (1, 0);
        }
        let most = i64::from(u32::MAX);
        (((centre - reach).floor() as i64).max(0), ((centre + reach).ceil() as i64).min(most))
    }

    /// What a number of frames costs by itself: the length wish, and the last checkpoint being
    /// early or late. Infinite where something that must be read is not reached or an exact length
    /// missed.
    #[inline]
    pub(crate) fn frames_cost(&self, n_frames: u32) -> f32 {
        if n_frames <= self.needed {
            return f32::INFINITY;
        }
        let error = n_frames as f32 - self.length_frames;
        if self.exact && error != 0.0 {
            return f32::INFINITY;
        }
        let late = self.last.map_or(0.0, |last| n_frames as f32 - 1.0 - last.frame as f32);
        self.length_factor * error * error + self.late_factor * late * late
    }
}

//! Prefix and suffix sums of a route: they make scoring a change O(1) in the motion's length.

use std::cell::OnceCell;

use super::circles::{self, Whereabouts, level_of};
use super::library::SearchLibrary;
use super::moments::Moments;
use super::route::{Route, Span};
use super::stretch::{Look, Stretch, surroundings_at};
use super::target::Target;
use crate::constraint::environment::Sums;
use crate::constraint::obstacle::OBSTACLE_STRIDE;
use crate::planar::PlanarTransform;

/// Tails that come up to so many frames earlier or later than before have their sums kept.
const MAX_LATE: i64 = 256;

/// What one piece of a route offers to a splice.
#[derive(Clone, Debug)]
pub(crate) struct SpanTable {
    pub(crate) span: Span,
    /// Torso at every frame of the piece's clip, shown or not.
    pub(crate) torso: Vec<PlanarTransform>,
    /// Entry `i`: cost of everything shown before frame `i` if the piece is left there. Infinite
    /// where it cannot be left.
    pub(crate) head_cost: Vec<f32>,
    /// Cost of the cuts after the piece.
    pub(crate) cuts_after: f32,
    /// A route that enters the piece at frame `j` shows `frames_from_zero − j` frames from there.
    pub(crate) frames_from_zero: i64,
    /// Support sums of the pieces after this one.
    pub(crate) support_after: Sums,
}

/// Tables of every piece of a route.
#[derive(Debug)]
pub(crate) struct Tables {
    pub(crate) spans: Vec<SpanTable>,
    /// Whether the support term is in play at all.
    pub(crate) uses_support: bool,
    pub(crate) frame_secs: f32,
    /// For each lateness from `-MAX_LATE` on: entry `k` sums the readings from the k-th on and the
    /// last checkpoint, as the route's frames stand that are shown at their time then.
    by_late: Vec<OnceCell<Vec<Moments>>>,
    /// For each style, entry `f`: how many of the route's frames `0..f` lack the tag.
    lacks: Vec<Vec<u32>>,
    /// Where the body is in each piece and in all from it on; empty where that does not matter.
    around: Vec<[Around; 2]>,
}

/// Where the body is during some of the route's frames.
#[derive(Clone, Copy, Debug)]
struct Around {
    place: Whereabouts,
    starts_at: u32,
    /// `BLOCK << level` frames are no fewer than these.
    level: usize,
}

impl Tables {
    pub(crate) fn new(library: &SearchLibrary, target: &Target, route: &Route) -> Self {
        let frame_secs = library.clips().fps().frame_secs() as f32;
        let uses_support = target.on_the_floor && library.leaves_the_floor();
        let mut spans = Vec::with_capacity(route.spans.len());
        let mut before = Before::default();
        for span in &route.spans {
            let in_clip = library.torsos(span.clip);
            let torso = in_clip.iter().map(|&t| span.world_from_clip * t).collect();
            let head_cost = head_costs(library, target, span, &before, uses_support, frame_secs);
            let after_span =
                i64::from(route.n_frames) - i64::from(span.starts_at + span.n_frames());
            before.add(library, span, head_cost.last_shown);
            spans.push(SpanTable {
                span: *span,
                torso,
                head_cost: head_cost.costs,
                cuts_after: route.cuts_cost - span.cuts_before,
                frames_from_zero: after_span + i64::from(span.to),
                support_after: Sums::default(),
            });
        }
        let mut support_after = Sums::default();
        for (table, span) in spans.iter_mut().zip(&route.spans).rev() {
            table.support_after = support_after;
            support_after = support_after.plus(&span.stretch().support(library));
        }
        let lacks = target.styles.iter().map(|style| {
            let mut sums = vec![0u32];
            for span in &route.spans {
                let before = sums[sums.len() - 1];
                let shown = span.from + 1..=span.to;
                sums.extend(shown.map(|to| before + style.lacking(span.clip, span.from, to)));
            }
            sums
        });
        let lacks = lacks.collect();
        let by_late = vec![OnceCell::new(); 2 * MAX_LATE as usize + 1];
        let around = if target.has_surroundings() { around(library, route) } else { Vec::new() };
        Self { spans, uses_support, frame_secs, by_late, lacks, around }
    }

    /// The sums over the readings from the `first`-th on, and the last checkpoint, for a tail that
    /// comes `late` frames later. `None` for tails that come much later or earlier.
    #[inline]
    pub(crate) fn moments(
        &self,
        library: &SearchLibrary,
        target: &Target,
        route: &Route,
        (first, late): (usize, i64),
    ) -> Option<&Moments> {
        let cell = self.by_late.get(usize::try_from(late + MAX_LATE).ok()?)?;
        let sums = cell.get_or_init(|| suffix_sums(library, target, route, late));
        sums.get(first)
    }

    /// What frames without a wished tag cost from the entry into a piece on.
    #[inline]
    pub(crate) fn tail_styles_cost(
        &self,
        target: &Target,
        tail: &SpanTable,
        entered: u32,
        entered_at: u32,
    ) -> f32 {
        let span = &tail.span;
        let late = i64::from(entered_at) - i64::from(span.starts_at) + i64::from(span.from)
            - i64::from(entered);
        let mut cost = 0.0;
        for (style, lacks) in target.styles.iter().zip(&self.lacks) {
            cost += style.cost(span.clip, entered, span.to, entered_at);
            // The pieces behind, as frames of the route.
            let n_frames = lacks.len() as i64 - 1;
            let behind = i64::from(span.starts_at + span.n_frames());
            let first = (i64::from(style.from) - late).clamp(behind, n_frames);
            let end = (i64::from(style.to) + 1 - late).clamp(first, n_frames);
            cost += style.factor * (lacks[end as usize] - lacks[first as usize]) as f32;
        }
        cost
    }

    /// Obstacles and other bodies from the entry into a piece on, with everything moved by `moved`
    /// and `late` frames later; at least `enough` where it is that much.
    pub(crate) fn tail_surroundings_cost(
        &self,
        library: &SearchLibrary,
        target: &Target,
        (tail, entered, entered_at): (&SpanTable, u32, u32),
        (moved, late): (PlanarTransform, i64),
        enough: f32,
    ) -> f32 {
        let own = Stretch {
            clip: tail.span.clip,
            world_from_clip: moved * tail.span.world_from_clip,
            from: entered,
            to: tail.span.to,
            starts_at: entered_at,
        };
        let behind = self.spans.partition_point(|t| t.span.starts_at <= tail.span.starts_at);
        let may_meet = |around: &Around| {
            let place = around.place.placed(moved);
            target.may_meet(&place, i64::from(around.starts_at) + late, around.level)
        };
        // What is shown of the piece that is entered is all known, but where it is entered before the route does.
        let own_is_near = entered < tail.span.from || may_meet(&self.around[behind - 1][0]);
        let seen_by = |look: Look| {
            let mut cost = 0.0;
            if own_is_near {
                cost = own.seen_by(look, library, target, enough);
            }
            for (table, [piece, rest]) in self.spans.iter().zip(&self.around).skip(behind) {
                if cost >= enough || !may_meet(rest) {
                    break;
                }
                if !may_meet(piece) {
                    continue;
                }
                let old = table.span.stretch();
                let stretch = Stretch {
                    world_from_clip: moved * old.world_from_clip,
                    starts_at: (i64::from(old.starts_at) + late) as u32,
                    ..old
                };
                cost += stretch.seen_by(look, library, target, enough - cost);
            }
            cost
        };
        if enough.is_finite() {
            let at_least = seen_by(Look::Hips);
            if at_least >= enough {
                return at_least;
            }
        }
        seen_by(Look::Whole)
    }
}

/// Where the body is in each piece, and in it and all behind it.
fn around(library: &SearchLibrary, route: &Route) -> Vec<[Around; 2]> {
    let mut all = Vec::with_capacity(route.spans.len());
    let mut rest: Option<Whereabouts> = None;
    for span in route.spans.iter().rev() {
        let shown = span.from as usize..span.to as usize;
        let torsos = &library.torsos(span.clip)[shown.clone()];
        let place = circles::around(torsos, &library.extents(span.clip)[shown]);
        let place = place.placed(span.world_from_clip);
        let both = rest.map_or(place, |rest| rest.joined(&place));
        rest = Some(both);
        let starts_at = span.starts_at;
        let during = |place, n_frames| Around { place, starts_at, level: level_of(n_frames) };
        all.push([during(place, span.n_frames()), during(both, route.n_frames - starts_at)]);
    }
    all.reverse();
    all
}

fn suffix_sums(library: &SearchLibrary, target: &Target, route: &Route, late: i64) -> Vec<Moments> {
    let n = target.readings.len();
    let mut sums = vec![Moments::default(); n + 1];
    let last = route.spans[route.spans.len() - 1];
    if let Some(wish) = &target.last {
        let read = wish.read(library, last.world_from_clip, last.clip, last.to - 1);
        sums[n] = Moments::of(wish, read);
    }
    for k in (0..n).rev() {
        let reading = &target.readings[k];
        let old = i64::from(reading.frame) - late;
        // Readings behind the end are left out; before the beginning there is no tail.
        sums[k] = if (0..i64::from(route.n_frames)).contains(&old) {
            let span = route.span_at(old as u32);
            let clip_frame = span.from + old as u32 - span.starts_at;
            let read = reading.read(library, span.world_from_clip, span.clip, clip_frame);
            sums[k + 1].plus(&Moments::of(reading, read))
        } else {
            sums[k + 1]
        };
    }
    sums
}

/// What the pieces before one have cost: cuts are not in it.
#[derive(Clone, Copy, Debug, Default)]
struct Before {
    cost: f32,
    support: Sums,
}

impl Before {
    fn add(&mut self, library: &SearchLibrary, span: &Span, cost: f32) {
        self.cost = cost;
        self.support = self.support.plus(&span.stretch().support(library));
    }
}

struct HeadCosts {
    costs: Vec<f32>,
    /// What all frames up to the piece's end have cost, without cuts and support.
    last_shown: f32,
}

fn head_costs(
    library: &SearchLibrary,
    target: &Target,
    span: &Span,
    before: &Before,
    uses_support: bool,
    frame_secs: f32,
) -> HeadCosts {
    let n_frames = library.n_frames(span.clip) as usize;
    let mut costs = vec![f32::INFINITY; n_frames];
    let fixed = target.weights.continuity * span.cuts_before;
    let mut shown = before.cost;
    let mut last_shown = shown;
    let mut next_reading = target.first_reading_from(span.starts_at);
    let has_surroundings = target.has_surroundings();
    for left in span.from + 1..=n_frames as u32 {
        let clip_frame = left - 1;
        let frame = span.frame_of(clip_frame);
        while let Some(reading) = target.readings.get(next_reading)
            && reading.frame == frame
        {
            shown += reading.cost(library, span.world_from_clip, span.clip, clip_frame);
            next_reading += 1;
        }
        for style in &target.styles {
            shown += style.cost(span.clip, clip_frame, left, frame);
        }
        if has_surroundings && frame.is_multiple_of(OBSTACLE_STRIDE) {
            let at = (span.clip, clip_frame);
            shown += surroundings_at(Look::Whole, library, target, span.world_from_clip, at, frame);
        }
        if left == span.to {
            last_shown = shown;
        }
        if (left as usize) < n_frames {
            let mut cost = fixed + shown;
            if uses_support {
                let own = library.support(span.clip).between(span.from, left);
                let own = own.raised(span.world_from_clip.level_m);
                let sums = before.support.plus(&own);
                cost += target.weights.environment * sums.cost_at(0.0, frame_secs);
            }
            costs[left as usize] = cost;
        }
    }
    HeadCosts { costs, last_shown }
}

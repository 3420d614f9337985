//! Prefix and suffix sums of a route: they make scoring a change O(1) in the motion's length.

use super::library::SearchLibrary;
use super::problem::Target;
use super::route::{Route, Span};
use crate::constraint::environment::Sums;
use crate::planar::PlanarTransform;

/// What one piece of a route offers to a splice.
#[derive(Clone, Debug)]
pub(crate) struct SpanTable {
    pub(crate) span: Span,
    /// Torso at every frame of the piece's clip, shown or not.
    pub(crate) torso: Vec<PlanarTransform>,
    /// Entry `i`: cost of everything shown before frame `i` if the piece is left there. Infinite
    /// where it cannot be left.
    pub(crate) head_cost: Vec<f32>,
    /// Entry `j`: from the torso at frame `j` to the route's last torso.
    pub(crate) end_from_torso: Vec<PlanarTransform>,
    /// Cost of the cuts after the piece.
    pub(crate) cuts_after: f32,
    /// A route that enters the piece at frame `j` shows `frames_from_zero − j` frames from there.
    pub(crate) frames_from_zero: i64,
    /// Support sums of the pieces after this one.
    pub(crate) support_after: Sums,
}

/// Tables of every piece of a route.
#[derive(Clone, Debug)]
pub(crate) struct Tables {
    pub(crate) spans: Vec<SpanTable>,
    /// Whether the environment term is in play at all.
    pub(crate) uses_support: bool,
    pub(crate) frame_secs: f32,
}

impl Tables {
    pub(crate) fn new(library: &SearchLibrary, target: &Target, route: &Route) -> Self {
        let frame_secs = library.clips().fps().frame_secs() as f32;
        let uses_support = target.on_the_floor && library.leaves_the_floor();
        let weights = target.weights;
        let mut spans = Vec::with_capacity(route.spans.len());
        let mut support_before = Sums::default();
        for span in &route.spans {
            let in_clip = library.torsos(span.clip);
            let torso: Vec<PlanarTransform> =
                in_clip.iter().map(|&t| span.world_from_clip * t).collect();
            let mut head_cost = vec![f32::INFINITY; in_clip.len()];
            // Checkpoints met before this piece.
            let mut inner_cost: f32 = 0.0;
            let mut next_inner = 0;
            if target.anchor_frame == 0 {
                while let Some(inner) = target.inner.get(next_inner) {
                    if inner.frame >= span.starts_at {
                        break;
                    }
                    inner_cost += inner.cost(route.torso(library, inner.frame));
                    next_inner += 1;
                }
            }
            let fixed = weights.continuity * span.cuts_before;
            for frame in span.from as usize + 1..in_clip.len() {
                if target.anchor_frame == 0
                    && let Some(inner) = target.inner.get(next_inner)
                    && inner.frame == span.frame_of(frame as u32 - 1)
                {
                    inner_cost += inner.cost(torso[frame - 1]);
                    next_inner += 1;
                }
                let mut cost = fixed + weights.body * inner_cost;
                if uses_support {
                    let own = library.support(span.clip).between(span.from, frame as u32);
                    let own = own.raised(span.world_from_clip.level_m);
                    cost +=
                        weights.environment * support_before.plus(&own).cost_at(0.0, frame_secs);
                }
                head_cost[frame] = cost;
            }
            let end_from_torso = torso.iter().map(|t| t.inverse() * route.end).collect();
            let after_span =
                i64::from(route.n_frames) - i64::from(span.starts_at + span.n_frames());
            spans.push(SpanTable {
                span: *span,
                torso,
                head_cost,
                end_from_torso,
                cuts_after: route.cuts_cost - span.cuts_before,
                frames_from_zero: after_span + i64::from(span.to),
                support_after: Sums::default(),
            });
            support_before = support_before.plus(&route.support(library, span));
        }
        let mut support_after = Sums::default();
        for (table, span) in spans.iter_mut().zip(&route.spans).rev() {
            table.support_after = support_after;
            support_after = support_after.plus(&route.support(library, span));
        }
        Self { spans, uses_support, frame_secs }
    }
}

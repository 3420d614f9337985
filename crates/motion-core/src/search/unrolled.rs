//! What a stretch of a clip costs up to each of its ends: many candidates share where they enter a clip and
//! differ in where they leave it.

use super::library::SearchLibrary;
use super::stretch::{Look, Stretch};
use super::target::Target;

/// The costs of what is read and of what is in the way from one frame of a clip on, known as far as anybody asked.
pub(crate) struct Unrolled {
    clip_lies: Stretch,
    /// Entry `n`: the cost of the first `n + 1` frames. Nothing at first: most are never asked.
    costs: Vec<f32>,
}

impl Unrolled {
    /// From the first frame of `stretch` on; its end does not matter.
    pub(crate) fn new(stretch: Stretch) -> Self {
        Self { clip_lies: stretch, costs: Vec::new() }
    }

    /// The cost up to frame `to` of the clip, behind the first and not shown any more; cuts and support apart.
    /// At least `limit` where it is that much; later calls ask for no higher limit.
    #[inline]
    pub(crate) fn cost_to(
        &mut self,
        library: &SearchLibrary,
        target: &Target,
        to: u32,
        limit: f32,
    ) -> f32 {
        let stretch = Stretch { to, ..self.clip_lies };
        let n = (to - stretch.from) as usize;
        if n > self.costs.len() {
            self.unroll(library, target, &stretch, limit);
        }
        self.costs[n - 1] + stretch.styles_cost(target)
    }

    fn unroll(&mut self, library: &SearchLibrary, target: &Target, stretch: &Stretch, limit: f32) {
        let n_known = self.costs.len() as u32;
        let mut rest = Stretch {
            from: stretch.from + n_known,
            starts_at: stretch.starts_at + n_known,
            ..*stretch
        };
        let before = self.costs.last().copied().unwrap_or(0.0);
        self.costs.resize((stretch.to - stretch.from) as usize, 0.0);
        let own = &mut self.costs[n_known as usize..];
        for reading in target.readings_within(rest.starts_at, rest.ends_at()) {
            let nth = reading.frame - rest.starts_at;
            own[nth as usize] +=
                reading.cost(library, rest.world_from_clip, rest.clip, rest.from + nth);
        }
        if target.has_surroundings() {
            for look in [Look::Hips, Look::Whole] {
                if look == Look::Hips && limit == f32::INFINITY {
                    continue;
                }
                let mut sum = before;
                let mut last = rest.to;
                rest.look_around(look, library, target, |frame, cost| {
                    sum += cost;
                    if look == Look::Whole {
                        own[(frame - rest.starts_at) as usize] += cost;
                    }
                    last = rest.from + frame - rest.starts_at + 1;
                    sum < limit
                });
                // Behind what is too much nothing needs to be known.
                if sum >= limit {
                    rest.to = last;
                }
            }
        }
        let mut sum = before;
        for cost in own {
            sum += *cost;
            *cost = sum;
        }
    }
}

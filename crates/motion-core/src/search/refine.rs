//! AF02's refinement: cuts replaced by their children in the trees of edges.

use super::evaluate::Evaluator;
use super::mutation::Mutation;
use crate::graph::EdgeId;

impl Evaluator<'_> {
    /// Two cuts at once (and each alone) replaced by their children: AF02's refinement.
    ///
    /// These are few; what the cheap terms leave is scored by laying the path out.
    pub(crate) fn refine(&mut self) {
        let forest = &self.library.graph().forest;
        let cuts = &self.route.path.cuts;
        let options: Vec<Vec<EdgeId>> = cuts
            .iter()
            .map(|&cut| {
                let mut options = vec![cut];
                options.extend(forest.children(cut).into_iter().flatten());
                options
            })
            .collect();
        let per_tau = (1.0 / self.library.graph().tau) as f32;
        let cost_of = |id: EdgeId| forest.edge(id).cost * per_tau;
        let window = self.window.start..self.window.end.saturating_sub(1).min(cuts.len());
        for first in window.clone() {
            for second in first..window.end {
                for &first_cut in &options[first] {
                    for &second_cut in &options[second] {
                        let changed = [first_cut != cuts[first], second_cut != cuts[second]];
                        let counts = if first == second {
                            changed[0] && first_cut == second_cut
                        } else {
                            // Single replacements are seen with `first == second`.
                            changed[0] && changed[1]
                        };
                        if !counts {
                            continue;
                        }
                        let mut sum =
                            self.route.cuts_cost + cost_of(first_cut) - cost_of(cuts[first]);
                        if first != second {
                            sum += cost_of(second_cut) - cost_of(cuts[second]);
                        }
                        if self.target.weights.continuity * sum >= self.best.limit() {
                            self.counts.pruned += 1;
                            continue;
                        }
                        let mutation = Mutation::Refine { first, first_cut, second, second_cut };
                        self.consider_whole(mutation);
                    }
                }
            }
        }
    }
}

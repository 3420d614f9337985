//! Fresh starts near a known good motion: a stretch of it replaced by chance.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::library::{Cut, SearchLibrary};
use super::super::route::Route;
use super::super::target::Target;
use crate::path::Path;

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

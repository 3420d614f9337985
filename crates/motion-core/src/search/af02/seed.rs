//! AF02's seeds: random valid paths in G′, grown from one hard frame to the next.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use crate::ids::ClipId;
use crate::path::Path;
use crate::search::rivals::{Approach, Approaches, CoarseGraph, Ground};
use crate::search::route::Route;
use crate::units::FrameIdx;

/// A seed has at most this many pieces.
const MAX_PIECES: usize = 1000;

/// Lengths drawn where nothing says how long the motion should be.
const FREE_FRAMES: std::ops::Range<u32> = 60..300;

/// Grows a seed: cut by cut, each drawn evenly among those that may be taken next. `None` when it
/// ran into a dead end.
pub(super) fn grow(
    graph: &CoarseGraph,
    approaches: &Approaches,
    ground: Ground<'_>,
    rng: &mut Pcg64Mcg,
) -> Option<Route> {
    let Ground { library, target, .. } = ground;
    if graph.n_cuts() == 0 {
        return None;
    }
    let n_frames = target.frames.unwrap_or_else(|| rng.random_range(FREE_FRAMES));
    let n_frames = n_frames.max(target.needed() + 1).max(1);
    // A path begins where an edge of G′ enters its first clip.
    let mut n_shown = 0;
    let (mut clip, first) = first_cut(graph, approaches.next(0).ok()?, rng)?;
    let mut entered = first;
    let mut path =
        Path { first_clip: clip, start: FrameIdx(first), cuts: vec![], end: FrameIdx(first) };
    let mut frame = 0u32;
    // The first frame at which the clip may be left.
    let mut free_from = entered + 1;
    for _ in 0..MAX_PIECES {
        let next = approaches.next(n_shown).ok()?;
        let left = next.map_or(n_frames - 1, |hard| hard.first).checked_sub(frame)?;
        let out = graph.out(clip, free_from..entered + left + 1);
        let leads = |&nth: &usize| {
            let (to, cut) = graph.cut(nth);
            next.is_none_or(|hard| hard.leads((to, cut.to), left - (cut.from - entered)))
        };
        let options: Vec<usize> = out.filter(leads).collect();
        let may_stay = match next {
            Some(hard) => hard.stays(clip, entered, left),
            None => entered + left < library.n_frames(clip),
        };
        let drawn = rng.random_range(0..(options.len() + usize::from(may_stay)).max(1));
        if let Some(&nth) = options.get(drawn) {
            let (to, cut) = graph.cut(nth);
            frame += cut.from - entered;
            (clip, entered, free_from) = (to, cut.to, cut.to + 1);
            path.cuts.push(cut.id);
            continue;
        }
        match next {
            _ if !may_stay => return None,
            None => {
                path.end = FrameIdx(entered + left);
                return Route::new(library, target, path);
            }
            Some(Approach { inner, ends_with, last, .. }) => {
                path.cuts.extend(inner);
                clip = ends_with.clip;
                // Where the clip would have been entered to show the last hard frame when it does.
                (entered, frame) = (ends_with.to.0, *last);
                free_from = entered + 1;
                n_shown += 1;
            }
        }
    }
    None
}

/// A random first clip and frame from which what is hard first can be reached.
fn first_cut(
    graph: &CoarseGraph,
    next: Option<&Approach>,
    rng: &mut Pcg64Mcg,
) -> Option<(ClipId, u32)> {
    const N_DRAWS: usize = 200;
    let mut draw = || {
        let (clip, cut) = graph.cut(rng.random_range(0..graph.n_cuts()));
        (clip, cut.to)
    };
    let Some(hard) = next else { return Some(draw()) };
    let lucky = (0..N_DRAWS).map(|_| draw()).find(|&at| hard.leads(at, hard.first));
    lucky.or_else(|| {
        let all = (0..graph.n_cuts()).map(|nth| graph.cut(nth)).map(|(clip, cut)| (clip, cut.to));
        let all: Vec<_> = all.filter(|&at| hard.leads(at, hard.first)).collect();
        all.get(rng.random_range(0..all.len().max(1))).copied()
    })
}

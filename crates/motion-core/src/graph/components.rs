//! What can be reached from where: strongly connected components and dead ends.
//!
//! Reaching is asked of frames, not of clips: a clip that is entered after its last way out is
//! a dead end however many edges it has. The rule of a path (a piece shows at least one frame)
//! is kept by letting an edge lead to the frame after the one that it enters.

use rayon::prelude::*;

use super::forest::{ClipPair, EdgeId, Forest};

/// Which clips belong together, and where one cannot go on.
///
/// The **main component** is the largest set of frames in which every frame can reach every
/// other. A clip is in it when one of its frames is.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Connectivity {
    /// For each clip, the part it belongs to. Parts are numbered from 0, the main one first;
    /// a clip that is in no cycle is a part of its own.
    pub part_of_clip: Vec<u32>,
    /// How many parts there are.
    pub n_parts: u32,
    /// For each clip, the first frame (and all after it) from which the main component cannot
    /// be reached any more; the number of frames where there is none.
    pub dead_from: Vec<u32>,
    /// For each clip, the first frame that can be reached from the main component; the number
    /// of frames where there is none.
    pub reachable_from: Vec<u32>,
    /// For each clip, its frames within its part's cycle: first and last. `None` for a clip that
    /// is in no cycle.
    pub core: Vec<Option<(u32, u32)>>,
}

impl Connectivity {
    /// Frames that lead nowhere, of all clips together.
    pub fn n_dead_frames(&self, clip_frames: &[u32]) -> usize {
        let dead = clip_frames.iter().zip(&self.dead_from).map(|(&n, &from)| n - from);
        dead.map(|n| n as usize).sum()
    }

    /// Whether every clip is in the main component.
    pub fn is_whole(&self) -> bool {
        self.n_parts <= 1
    }
}

/// Finds [`Connectivity`] by the edges of `forest`, with its bridges or without.
pub fn connectivity(forest: &Forest, clip_frames: &[u32], with_bridges: bool) -> Connectivity {
    let mut starts = vec![0u32];
    for &n in clip_frames {
        starts.push(starts[starts.len() - 1] + n);
    }
    let n_rows = starts[starts.len() - 1] as usize;
    // Jumps by row in compressed form.
    let found = jumps(forest, clip_frames, &starts, with_bridges);
    let mut jump_starts = vec![0u32; n_rows + 1];
    for &(from, _) in found.iter().flatten() {
        jump_starts[from as usize + 1] += 1;
    }
    for row in 0..n_rows {
        jump_starts[row + 1] += jump_starts[row];
    }
    let mut jumps = vec![0u32; jump_starts[n_rows] as usize];
    let mut fill = jump_starts.clone();
    for &(from, to) in found.iter().flatten() {
        jumps[fill[from as usize] as usize] = to;
        fill[from as usize] += 1;
    }
    let mut goes_on = vec![true; n_rows];
    for &end in &starts[1..] {
        if end > 0 {
            goes_on[end as usize - 1] = false;
        }
    }
    let successor = |row: u32, nth: u32| -> Option<u32> {
        let jumps_of_row = jump_starts[row as usize + 1] - jump_starts[row as usize];
        if nth < jumps_of_row {
            return Some(jumps[(jump_starts[row as usize] + nth) as usize]);
        }
        (nth == jumps_of_row && goes_on[row as usize]).then_some(row + 1)
    };
    let component = strong_components(n_rows, &successor);
    summarise(&component, n_rows, &starts, clip_frames, &successor)
}

/// Rows that an edge leads from and to, for runs of pairs of clips.
///
/// Of the edges from one frame into one clip only that to the earliest frame is kept: from there
/// the body walks on to all the others, so nothing that can be reached is lost.
fn jumps(
    forest: &Forest,
    clip_frames: &[u32],
    starts: &[u32],
    with_bridges: bool,
) -> Vec<Vec<(u32, u32)>> {
    let of_pairs = |pairs: &[ClipPair]| {
        let (mut all, mut own) = (Vec::new(), Vec::new());
        for pair in pairs {
            let end = if with_bridges { pair.end_node } else { pair.first_bridge };
            let n_to = clip_frames[pair.to.idx()];
            let (from, to) = (starts[pair.from.idx()], starts[pair.to.idx()]);
            let leaves = (pair.first_node..end).map(EdgeId).filter(|&id| forest.is_leaf(id));
            let edges = leaves.map(|id| forest.edge(id));
            // One frame is shown before the clip can be left again.
            let led = edges.map(|edge| (edge.from_frame.0, edge.to_frame.0 + 1));
            own.clear();
            own.extend(led.filter(|&(_, shown)| shown < n_to));
            own.sort_unstable();
            own.dedup_by_key(|&mut (left, _)| left);
            all.extend(own.iter().map(|&(left, shown)| (from + left, to + shown)));
        }
        all
    };
    forest.pairs().par_chunks(PAIRS_AT_ONCE).map(of_pairs).collect()
}

/// Pairs of a run: in large libraries most have an edge or two.
const PAIRS_AT_ONCE: usize = 1024;

/// Tarjan's algorithm without recursion. Components are numbered so that every edge leads to
/// the same or a smaller number.
fn strong_components(n_rows: usize, successor: &impl Fn(u32, u32) -> Option<u32>) -> Vec<u32> {
    const UNSEEN: u32 = u32::MAX;
    let mut order = vec![UNSEEN; n_rows];
    let mut low = vec![0u32; n_rows];
    let mut component = vec![UNSEEN; n_rows];
    let mut stack = Vec::new();
    let mut calls: Vec<(u32, u32)> = Vec::new();
    let (mut n_seen, mut n_components) = (0u32, 0u32);
    for root in 0..n_rows as u32 {
        if order[root as usize] != UNSEEN {
            continue;
        }
        calls.push((root, 0));
        while let Some(call) = calls.last_mut() {
            let row = call.0;
            if call.1 == 0 {
                order[row as usize] = n_seen;
                low[row as usize] = n_seen;
                n_seen += 1;
                stack.push(row);
            }
            let nth = call.1;
            call.1 += 1;
            if let Some(next) = successor(row, nth) {
                if order[next as usize] == UNSEEN {
                    calls.push((next, 0));
                } else if component[next as usize] == UNSEEN {
                    low[row as usize] = low[row as usize].min(order[next as usize]);
                }
                continue;
            }
            calls.pop();
            if let Some(&(parent, _)) = calls.last() {
                low[parent as usize] = low[parent as usize].min(low[row as usize]);
            }
            if low[row as usize] == order[row as usize] {
                while let Some(member) = stack.pop() {
                    component[member as usize] = n_components;
                    if member == row {
                        break;
                    }
                }
                n_components += 1;
            }
        }
    }
    component
}

fn summarise(
    component: &[u32],
    n_rows: usize,
    starts: &[u32],
    clip_frames: &[u32],
    successor: &impl Fn(u32, u32) -> Option<u32>,
) -> Connectivity {
    let n_components = component.iter().map(|&c| c as usize + 1).max().unwrap_or(0);
    let mut sizes = vec![0u32; n_components];
    for &c in component {
        sizes[c as usize] += 1;
    }
    // The first of the largest, so that ties are settled by the clips' order.
    let main = component.iter().copied().max_by(|&a, &b| {
        let by_size = sizes[a as usize].cmp(&sizes[b as usize]);
        by_size.then(b.cmp(&a))
    });
    let main = main.unwrap_or(0);

    // Rows by component, smallest number first: successors are settled before.
    let mut by_component: Vec<u32> = (0..n_rows as u32).collect();
    by_component.sort_by_key(|&row| component[row as usize]);
    let mut leads_to_main = vec![false; n_components];
    let mut comes_from_main = vec![false; n_components];
    if n_components > 0 {
        leads_to_main[main as usize] = true;
        comes_from_main[main as usize] = true;
    }
    for &row in &by_component {
        let c = component[row as usize] as usize;
        let mut nth = 0;
        while let Some(next) = successor(row, nth) {
            if leads_to_main[component[next as usize] as usize] {
                leads_to_main[c] = true;
            }
            nth += 1;
        }
    }
    for &row in by_component.iter().rev() {
        if comes_from_main[component[row as usize] as usize] {
            let mut nth = 0;
            while let Some(next) = successor(row, nth) {
                comes_from_main[component[next as usize] as usize] = true;
                nth += 1;
            }
        }
    }

    let mut found = Connectivity::default();
    let mut part_of_component: Vec<Option<u32>> = vec![None; n_components];
    if n_components > 0 && sizes[main as usize] > 1 {
        part_of_component[main as usize] = Some(0);
        found.n_parts = 1;
    }
    for (clip, &n) in clip_frames.iter().enumerate() {
        let rows = starts[clip]..starts[clip] + n;
        let component_at = |row: u32| component[row as usize];
        let first = |holds: &dyn Fn(u32) -> bool| {
            rows.clone().position(|row| holds(component_at(row))).unwrap_or(n as usize) as u32
        };
        found.dead_from.push(first(&|c| !leads_to_main[c as usize]));
        found.reachable_from.push(first(&|c| comes_from_main[c as usize]));
        // The main component if the clip touches it, else the cycle that holds most of it.
        let in_cycles = rows.clone().map(component_at).filter(|&c| sizes[c as usize] > 1);
        let home = in_cycles.max_by_key(|&c| (c == main, sizes[c as usize], c));
        let part = match home {
            Some(c) => *part_of_component[c as usize].get_or_insert_with(|| {
                found.n_parts += 1;
                found.n_parts - 1
            }),
            None => {
                found.n_parts += 1;
                found.n_parts - 1
            }
        };
        found.part_of_clip.push(part);
        found.core.push(home.and_then(|c| {
            let mut inside = rows.clone().filter(|&row| component_at(row) == c);
            let first = inside.next()?;
            let last = inside.next_back().unwrap_or(first);
            Some((first - starts[clip], last - starts[clip]))
        }));
    }
    found
}

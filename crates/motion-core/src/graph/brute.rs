//! Slow twins of building a graph: double loops, walks over all frames.

use std::collections::BTreeMap;

use glam::Vec3;

use super::components::connectivity;
use super::forest::{ClipPair, Edge, EdgeId, Forest, ForestParts};
use super::{BuildError, BuildOptions, MotionGraph, TauRule, build, build_part, extend, merge};
use crate::cancel::CancelToken;
use crate::clip::{Clip, ClipSet};
use crate::ids::ClipId;
use crate::motion::Motion;
use crate::similarity::{FeatureSet, Shard, metric_columns};
use crate::testing::wander;
use crate::units::FrameIdx;

fn build_with(clips: &ClipSet, options: &BuildOptions) -> MotionGraph {
    build(clips, options, &CancelToken::new(), &|_| ()).expect("a graph")
}

/// Two families of clips that no τ of either joins: the second walks with its knees up high.
fn two_families() -> ClipSet {
    let clips = wander::clips(6, 80, false, 1);
    let skeleton = clips.skeleton().clone();
    let fps = clips.fps();
    let changed = clips.clips().iter().enumerate().map(|(number, clip)| {
        if number < 3 {
            return clip.clone();
        }
        let rotations = (0..clip.n_frames())
            .flat_map(|frame| {
                let mut pose = clip.motion.rotations(frame).to_vec();
                pose[1] = glam::Quat::from_rotation_x(-1.5) * pose[1];
                pose[3] = glam::Quat::from_rotation_x(-1.5) * pose[3];
                pose
            })
            .collect();
        let path = clip.motion.root_positions_m().iter().map(|p| *p - Vec3::Y * 0.3).collect();
        let motion = Motion::new(fps, 5, path, rotations).expect("a valid motion");
        Clip { motion, ..clip.clone() }
    });
    let changed = changed.collect();
    ClipSet::new(skeleton, fps, changed).expect("a valid set")
}

#[test]
fn leaf_edges_are_those_of_a_double_loop() {
    let clips = wander::clips(5, 70, true, 3);
    let graph = build_with(&clips, &BuildOptions { bridges: false, ..BuildOptions::default() });
    let features = FeatureSet::new(&clips, metric_columns(clips.skeleton()));
    let mut n_edges = 0;
    for from in 0..5 {
        for to in 0..5 {
            let mut expected = Vec::new();
            for i in 0..70u32 {
                for j in 0..70u32 {
                    let (a, b) =
                        (features.row(from * 70 + i as usize), features.row(to * 70 + j as usize));
                    let cost: f64 =
                        a.iter().zip(b).map(|(&x, &y)| (f64::from(x) - f64::from(y)).powi(2)).sum();
                    if cost < graph.tau && (from != to || i.abs_diff(j) >= graph.min_jump) {
                        expected.push((i, j, cost));
                    }
                }
            }
            let found = graph.leaf_edges(ClipId::from_idx(from), ClipId::from_idx(to));
            let labels = |e: &Edge| (e.from_frame.0, e.to_frame.0);
            assert_eq!(
                found.iter().map(labels).collect::<Vec<_>>(),
                expected.iter().map(|&(i, j, _)| (i, j)).collect::<Vec<_>>(),
                "{from} → {to}"
            );
            for (edge, (_, _, cost)) in found.iter().zip(&expected) {
                assert!(
                    (f64::from(edge.cost) - cost).abs() <= 1e-4 * cost,
                    "{edge:?} costs {cost}"
                );
            }
            n_edges += found.len();
        }
    }
    assert!(n_edges > 300, "the fixture has edges: {n_edges}");
    assert_eq!(
        graph.forest.edges_per_level().last(),
        Some(&n_edges),
        "the last level is all leaves"
    );
}

#[test]
fn tau_is_the_cost_under_which_three_frames_of_five_have_a_neighbour() {
    let clips = wander::clips(5, 70, false, 4);
    let graph = build_with(&clips, &BuildOptions::default());
    let features = FeatureSet::new(&clips, metric_columns(clips.skeleton()));
    let with_neighbour = (0..350)
        .filter(|&row| {
            (0..350).any(|other| other / 70 != row / 70 && features.cost(row, other) < graph.tau)
        })
        .count();
    assert_eq!(with_neighbour, 210, "60 % of 350 frames");
}

/// An inner node is the rounded mean of its leaves, and children hold what their parent holds.
#[test]
fn nodes_stand_for_their_leaves() {
    let clips = wander::clips(6, 90, false, 5);
    let forest = build_with(&clips, &BuildOptions::default()).forest;
    let mut n_inner = 0;
    for pair in forest.pairs() {
        let mut last_end = pair.first_node;
        for root in forest.roots(pair.first_node..pair.end_node) {
            assert_eq!(root.0, last_end, "trees follow each other");
            last_end = root.0 + 2 * forest.n_leaves(root) - 1;
            for node in (root.0..last_end).map(EdgeId) {
                let subtree = node.0..node.0 + 2 * forest.n_leaves(node) - 1;
                let leaves: Vec<Edge> = subtree
                    .map(EdgeId)
                    .filter(|&id| forest.is_leaf(id))
                    .map(|id| forest.edge(id))
                    .collect();
                let n = leaves.len() as f64;
                let mean = |value: fn(&Edge) -> f64| leaves.iter().map(value).sum::<f64>() / n;
                let edge = forest.edge(node);
                assert_eq!(leaves.len(), forest.n_leaves(node) as usize);
                assert!(
                    (mean(|e| f64::from(e.from_frame.0)) - f64::from(edge.from_frame.0)).abs()
                        <= 0.5
                );
                assert!(
                    (mean(|e| f64::from(e.to_frame.0)) - f64::from(edge.to_frame.0)).abs() <= 0.5
                );
                assert!((mean(|e| f64::from(e.cost)) - f64::from(edge.cost)).abs() < 1e-4);
                if let Some(children) = forest.children(node) {
                    n_inner += 1;
                    let held: u32 = children.iter().map(|&c| forest.n_leaves(c)).sum();
                    assert_eq!(held, forest.n_leaves(node));
                    assert!(children.iter().all(|&c| forest.level(c) == forest.level(node) + 1));
                }
                let cheapest = forest.cheapest_leaf(node).map(|id| forest.edge(id).cost);
                assert_eq!(cheapest, leaves.iter().map(|e| e.cost).min_by(f32::total_cmp));
            }
        }
        assert_eq!(last_end, pair.end_node, "and cover the pair");
    }
    assert!(n_inner > 100, "the fixture has trees: {n_inner}");
}

/// Who reaches whom by walking: frames as nodes, on to the next frame or by an edge.
fn reached(graph: &MotionGraph, from: (u32, u32)) -> Vec<Vec<bool>> {
    let mut seen: Vec<Vec<bool>> =
        graph.clip_frames.iter().map(|&n| vec![false; n as usize]).collect();
    let mut edges: BTreeMap<(u32, u32), Vec<(u32, u32)>> = BTreeMap::new();
    for pair in graph.forest.pairs() {
        for id in
            (pair.first_node..pair.end_node).map(EdgeId).filter(|&id| graph.forest.is_leaf(id))
        {
            let edge = graph.forest.edge(id);
            let entered = (pair.to.0, edge.to_frame.0 + 1);
            if entered.1 < graph.clip_frames[pair.to.idx()] {
                edges.entry((pair.from.0, edge.from_frame.0)).or_default().push(entered);
            }
        }
    }
    let mut todo = vec![from];
    while let Some((clip, frame)) = todo.pop() {
        if std::mem::replace(&mut seen[clip as usize][frame as usize], true) {
            continue;
        }
        if frame + 1 < graph.clip_frames[clip as usize] {
            todo.push((clip, frame + 1));
        }
        todo.extend(edges.get(&(clip, frame)).into_iter().flatten());
    }
    seen
}

#[test]
fn dead_ends_and_reach_are_those_of_a_walk() {
    for seed in [6, 7] {
        let clips = wander::clips(4, 40, false, seed);
        let graph = build_with(&clips, &BuildOptions { bridges: false, ..BuildOptions::default() });
        let found = &graph.by_tau;
        let main = (0..4).find(|&clip| found.part_of_clip[clip] == 0).expect("a main part");
        let (first, _) = found.core[main].expect("a cycle");
        let from_main = reached(&graph, (main as u32, first));
        for (clip, from_main) in from_main.iter().enumerate() {
            for (frame, &from_main) in (0u32..).zip(from_main) {
                let reaches_main = reached(&graph, (clip as u32, frame))[main][first as usize];
                let place = format!("clip {clip} frame {frame}");
                assert_eq!(reaches_main, frame < found.dead_from[clip], "{place}");
                assert_eq!(from_main, frame >= found.reachable_from[clip], "{place}");
            }
        }
    }
}

#[test]
fn bridges_join_what_tau_leaves_apart_at_their_true_cost() {
    let clips = two_families();
    // A τ of the families' own: the default would be met within each family alone too.
    let options = BuildOptions { bridges: false, ..BuildOptions::default() };
    let apart = build_with(&clips, &options);
    assert!(apart.by_tau.n_parts > 1, "two families: {:?}", apart.by_tau.part_of_clip);
    assert!(!apart.with_bridges.is_whole(), "no bridges were asked for");

    let whole = build_with(&clips, &BuildOptions { bridges: true, ..options });
    assert!(whole.with_bridges.is_whole(), "{:?}", whole.with_bridges.part_of_clip);
    assert_eq!(whole.by_tau, apart.by_tau, "what τ does is told apart");
    let features = FeatureSet::new(&clips, metric_columns(clips.skeleton()));
    let mut n_bridges = 0;
    for pair in whole.forest.pairs() {
        assert_eq!(whole.leaf_edges(pair.from, pair.to), apart.leaf_edges(pair.from, pair.to));
        for bridge in whole.bridges(pair.from, pair.to) {
            let row =
                |clip: ClipId, frame: FrameIdx| features.frame_starts[clip.idx()] + frame.idx();
            let cost =
                features.cost(row(pair.from, bridge.from_frame), row(pair.to, bridge.to_frame));
            assert!((f64::from(bridge.cost) - cost).abs() <= 1e-4 * cost, "{bridge:?}");
            assert!(cost >= whole.tau, "a bridge costs more than τ");
            n_bridges += 1;
        }
    }
    assert!(n_bridges >= 2, "there and back");
}

#[test]
fn a_graph_is_the_same_on_any_number_of_threads() {
    let clips = two_families();
    let run = |n_threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().expect("a pool");
        pool.install(|| build_with(&clips, &BuildOptions::default()))
    };
    let alone = run(1);
    assert_eq!(run(2), alone);
    assert_eq!(run(8), alone);
}

#[test]
fn what_cannot_be_built_is_said() {
    let clips = wander::clips(2, 30, false, 1);
    let none = ClipSet::new(wander::skeleton(), clips.fps(), vec![]).expect("an empty set");
    let go = CancelToken::new();
    let stop = CancelToken::new();
    stop.cancel();
    let options = BuildOptions::default();
    let bad_tau = BuildOptions { tau: TauRule::Fixed(-1.0), ..options };
    assert_eq!(build(&none, &options, &go, &|_| ()), Err(BuildError::NoClips));
    assert_eq!(build(&clips, &bad_tau, &go, &|_| ()), Err(BuildError::BadTau(-1.0)));
    let cancelled = build(&clips, &options, &stop, &|_| ());
    assert!(matches!(cancelled, Err(BuildError::Cancelled(_))), "{cancelled:?}");
}

#[test]
fn one_clip_and_one_frame_make_a_graph() {
    for (n_clips, n_frames) in [(1, 60), (3, 1), (1, 1), (2, 2)] {
        let clips = wander::clips(n_clips, n_frames, false, 2);
        let graph = build_with(&clips, &BuildOptions::default());
        assert_eq!(graph.n_clips(), n_clips);
        let again = connectivity(&graph.forest, &graph.clip_frames, true);
        assert_eq!(again, graph.with_bridges, "{n_clips} clips of {n_frames} frames");
    }
}

/// Files are checked by the same rules as what is built.
#[test]
fn broken_forests_are_refused() {
    let pair = |first_node, first_bridge, end_node| ClipPair {
        from: ClipId(0),
        to: ClipId(1),
        first_node,
        first_bridge,
        end_node,
    };
    let good = ForestParts {
        from_frames: vec![5, 4, 6, 9],
        to_frames: vec![5, 4, 6, 9],
        costs: vec![1.0; 4],
        n_leaves: vec![2, 1, 1, 1],
        pairs: vec![pair(0, 3, 4)],
    };
    let broken = |change: fn(&mut ForestParts)| {
        let mut parts = good.clone();
        change(&mut parts);
        Forest::from_parts(parts, &[10, 10]).err().map(|error| error.0)
    };
    assert_eq!(broken(|_| ()), None, "the good one is good");
    assert_eq!(broken(|p| p.costs.truncate(3)), Some(1));
    assert_eq!(broken(|p| p.pairs[0].end_node = 3), Some(1));
    assert_eq!(broken(|p| p.pairs.push(p.pairs[0].clone())), Some(1));
    assert_eq!(broken(|p| p.pairs[0].to = ClipId(7)), Some(1));
    assert_eq!(broken(|p| p.n_leaves[0] = 3), Some(2));
    assert_eq!(broken(|p| p.n_leaves[1] = 0), Some(2));
    assert_eq!(broken(|p| p.n_leaves[0] = u32::MAX), Some(2));
    assert_eq!(broken(|p| p.n_leaves[3] = 2), Some(2), "a bridge is a leaf");
    assert_eq!(broken(|p| p.from_frames[1] = 10), Some(3));
    assert_eq!(broken(|p| p.costs[1] = f32::NAN), Some(3));
}

/// Options under which frames keep their best edges only.
fn few_edges() -> BuildOptions {
    BuildOptions { all_edges_until_frames: 10, edges_per_frame: 4, ..BuildOptions::default() }
}

#[test]
fn a_budget_limits_the_edges_that_leave_a_frame() {
    let clips = wander::clips(5, 70, false, 4);
    let graph = build_with(&clips, &few_edges());
    let mut per_frame: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for pair in graph.forest.pairs() {
        for edge in graph.leaf_edges(pair.from, pair.to) {
            *per_frame.entry((pair.from.0, edge.from_frame.0)).or_default() += 1;
        }
    }
    assert_eq!(per_frame.values().max(), Some(&4), "as many as were allowed");
    assert!(graph.with_bridges.is_whole(), "{:?}", graph.with_bridges.part_of_clip);
    let all = build_with(&clips, &BuildOptions::default());
    assert_eq!(graph.tau, all.tau, "few frames are all asked for τ");
}

#[test]
fn parts_of_a_build_make_the_same_graph() {
    let clips = two_families();
    let go = CancelToken::new();
    let tight = BuildOptions { edge_budget_bytes: 200_000, ..BuildOptions::default() };
    for options in [BuildOptions::default(), few_edges(), tight] {
        let whole = build_with(&clips, &options);
        let part = |nth| {
            let shard = Shard::new(nth, 3).expect("a share");
            build_part(&clips, &options, shard, &go, &|_| ()).expect("a part")
        };
        let parts = vec![part(2), part(0), part(1)];
        let merged = merge(&clips, &options, parts.clone(), &go, &|_| ());
        assert_eq!(merged.as_ref(), Ok(&whole), "{options:?}");

        let twice = vec![part(0), part(1), part(0)];
        assert_eq!(merge(&clips, &options, twice, &go, &|_| ()), Err(BuildError::Part(2)));
        let missing = parts[..2].to_vec();
        assert_eq!(merge(&clips, &options, missing, &go, &|_| ()), Err(BuildError::Part(0)));
        let others = wander::clips(6, 80, false, 2);
        assert_eq!(merge(&others, &options, parts, &go, &|_| ()), Err(BuildError::Part(0)));
    }
}

#[test]
fn an_extended_graph_has_the_edges_of_a_whole_one() {
    let clips = wander::clips(6, 80, true, 8);
    let first = clips.clips()[..4].to_vec();
    let old = ClipSet::new(clips.skeleton().clone(), clips.fps(), first).expect("a valid set");
    for options in [BuildOptions::default(), few_edges()] {
        let old = build_with(&old, &options);
        let go = CancelToken::new();
        let graph = extend(&clips, &old, &options, &go, &|_| ()).expect("a graph");
        assert_eq!((graph.tau, &graph.metric), (old.tau, &old.metric), "both stay");
        assert!(graph.with_bridges.is_whole());
        let keeps_all = options.all_edges_until_frames > 480;
        let features = FeatureSet::by_metric(&clips, old.metric.clone(), 4);
        let mut n_edges = 0;
        for pair in graph.forest.pairs() {
            for edge in graph.leaf_edges(pair.from, pair.to) {
                let row = |clip: ClipId, frame: FrameIdx| 80 * clip.idx() + frame.idx();
                let cost =
                    features.cost(row(pair.from, edge.from_frame), row(pair.to, edge.to_frame));
                assert!((f64::from(edge.cost) - cost).abs() <= 1e-5 * cost, "{edge:?}: {cost}");
                n_edges += 1;
            }
            if keeps_all && pair.from.0.max(pair.to.0) < 4 {
                let known = old.leaf_edges(pair.from, pair.to);
                assert!(graph.leaf_edges(pair.from, pair.to) == known, "as they were");
            }
        }
        if keeps_all {
            let is_edge = |a: usize, b: usize| {
                (a / 80 != b / 80 || a.abs_diff(b) >= graph.min_jump as usize)
                    && features.cost(a, b) < graph.tau
            };
            let all = (0..480).map(|a| (0..480).filter(|&b| is_edge(a, b)).count());
            assert_eq!(n_edges, all.sum::<usize>());
        }
    }
}

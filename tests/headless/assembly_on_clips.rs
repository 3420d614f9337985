//! Assembly on real motion capture: random paths along the edges of a real graph.

use std::ops::ControlFlow;

use motion_core::assemble::{
    Assembled, Assembler, BodyTarget, FootPolicy, Piece, Plan, Policies, SeamPolicy,
};
use motion_core::cancel::CancelToken;
use motion_core::clip::ClipSet;
use motion_core::graph::{self, BuildOptions, Edge, MotionGraph};
use motion_core::ids::ClipId;
use motion_core::measure::seams::{natural_peak_m_s2, seam_peaks_m_s2};
use motion_core::measure::{Slide, Support, measure};
use motion_core::planar::PlanarTransform;
use motion_core::units::FrameIdx;
use motion_io::import::{ImportOptions, import_files};
use motion_tests::shared_dir;

const N_MOTIONS: usize = 60;
/// Paths end once they have this many frames.
const N_FRAMES: usize = 240;

#[test]
fn random_paths_have_natural_seams_and_standing_feet() {
    let Some(shared) = shared_dir() else { return };
    let imported = import_files(&[shared.join("mocap/cmu")], &ImportOptions::default(), &|_| {
        ControlFlow::Continue(())
    })
    .expect("the shared clips import");
    let (set, _) = imported.into_clip_set().expect("imported clips form a set");
    let graph = graph::build(&set, &BuildOptions::default(), &CancelToken::new(), &|_| {})
        .expect("a graph of the shared clips");
    let paths = random_paths(&set, &graph);
    let assembler = Assembler::new(&set);
    let limit_m_s2 = natural_peak_m_s2(&set, 0.995);

    let mut n_seams = 0;
    let mut n_natural = 0;
    let mut slides = [Vec::new(), Vec::new()];
    for pieces in &paths {
        let free = Policies {
            seam: SeamPolicy::VelocityMatched,
            feet: FootPolicy::Free,
            ..Policies::BEST
        };
        for (policies, slides) in [free, Policies::BEST].into_iter().zip(&mut slides) {
            let made = make(&assembler, pieces, policies);
            let support = Support::of_assembled(&made, assembler.soles());
            let quality = measure(set.skeleton(), &made.motion, Some(&support));
            slides.extend(quality.carried_slide);
            if policies == Policies::BEST {
                let peaks = seam_peaks_m_s2(set.skeleton(), &made.motion, &made.starts[1..]);
                n_seams += peaks.len();
                n_natural += peaks.iter().filter(|&&peak| peak <= limit_m_s2).count();
            }
        }
    }
    assert!(n_seams > 300, "only {n_seams} seams");
    assert!(n_natural * 100 >= n_seams * 95, "{n_natural} of {n_seams} seams are natural");

    let sources: Vec<Slide> = set
        .clips()
        .iter()
        .filter_map(|clip| {
            let support = Support::of_track(&clip.track, assembler.soles());
            measure(set.skeleton(), &clip.motion, Some(&support)).carried_slide
        })
        .collect();
    let [free, locked] = slides.map(|slides| mean_m_s(&slides));
    let source = mean_m_s(&sources);
    assert!(locked < 0.3 * source, "{locked} m/s, the sources {source}, unlocked {free}");
}

/// A motion with a target half way and one at its end, both a little off.
fn make(assembler: &Assembler<'_>, pieces: &[Piece], policies: Policies) -> Assembled {
    let start = PlanarTransform::IDENTITY;
    let plan = Plan { pieces, start, targets: &[], hard_frames: &[] };
    let untouched = assembler.assemble(&plan, policies).expect("a path of the graph");
    let n_frames = untouched.motion.n_frames();
    let yaw = motion_core::ground::yaw_series_rad(&untouched.motion);
    let targets = [n_frames / 2, n_frames - 1].map(|frame| {
        let at = untouched.motion.root_positions_m()[frame];
        let ground_m = glam::Vec2::new(at.x + 0.1, at.z - 0.15);
        let world_from_torso = PlanarTransform::new(yaw[frame] + 0.1, ground_m, 0.0);
        BodyTarget { frame: FrameIdx::from_idx(frame), world_from_torso, height: false }
    });
    let plan = Plan { targets: &targets, ..plan };
    let made = assembler.assemble(&plan, policies).expect("the same path");
    for error in &made.errors {
        assert!(error.position_m < 1e-3 && error.heading_rad.to_degrees() < 0.1, "{error:?}");
    }
    assert_eq!(made.motion.n_frames(), n_frames, "corrections add no frames");
    made
}

/// Paths along leaf edges and bridges, each piece at least 8 frames long.
fn random_paths(set: &ClipSet, graph: &MotionGraph) -> Vec<Vec<Piece>> {
    let mut random = Random(1);
    let mut paths = Vec::new();
    while paths.len() < N_MOTIONS {
        let mut pieces = Vec::new();
        let (mut clip, mut from) = (random.below(set.clips().len()), 0);
        let mut n_frames = 0;
        while n_frames < N_FRAMES {
            let ways = ways_out(set, graph, clip, from);
            if ways.is_empty() {
                break;
            }
            let (to_clip, edge) = ways[random.below(ways.len())];
            let cut = edge.from_frame.idx();
            pieces.push(piece(clip, from, cut - 1));
            n_frames += cut - from;
            (clip, from) = (to_clip, edge.to_frame.idx());
        }
        let last = set.clips()[clip].n_frames() - 1;
        pieces.push(piece(clip, from, last.min(from + 60)));
        if pieces.len() > 3 {
            paths.push(pieces);
        }
    }
    paths
}

fn ways_out(set: &ClipSet, graph: &MotionGraph, clip: usize, from: usize) -> Vec<(usize, Edge)> {
    let clip = ClipId::from_idx(clip);
    let mut ways = Vec::new();
    for pair in graph.pairs_from(clip) {
        let n_frames = set.clip(pair.to).n_frames();
        let edges = graph.leaf_edges(clip, pair.to).into_iter().chain(graph.bridges(clip, pair.to));
        ways.extend(
            edges
                .filter(|edge| (from + 8..from + 60).contains(&edge.from_frame.idx()))
                .filter(|edge| edge.to_frame.idx() + 8 < n_frames)
                .map(|edge| (pair.to.idx(), edge)),
        );
    }
    ways
}

fn piece(clip: usize, from: usize, to: usize) -> Piece {
    let (from, to) = (FrameIdx::from_idx(from), FrameIdx::from_idx(to));
    Piece { clip: ClipId::from_idx(clip), from, to }
}

fn mean_m_s(slides: &[Slide]) -> f32 {
    let n: usize = slides.iter().map(|slide| slide.n_steps).sum();
    slides.iter().map(|slide| slide.mean_m_s * slide.n_steps as f32).sum::<f32>() / n as f32
}

/// A small linear congruential generator: the paths are the same on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 33) % n as u64) as usize
    }
}

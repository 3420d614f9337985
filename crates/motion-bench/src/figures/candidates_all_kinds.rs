//! Candidates a second on one core where every kind of constraint is asked for.

use std::hint::black_box;
use std::sync::Arc;

use anyhow::Context as _;
use glam::{Vec2, Vec3};
use motion_bench::asked::Asked;
use motion_bench::stopwatch::{Spent, timed};
use motion_core::cancel::CancelToken;
use motion_core::constraint::{
    FollowConstraint, JointConstraint, LockConstraint, Obstacle, OtherBody, PoseConstraint,
    StyleConstraint,
};
use motion_core::ids::JointIdx;
use motion_core::path::Piece;
use motion_core::search::{Search, SearchLibrary};
use motion_core::units::FrameIdx;

use super::Bench;
use super::quantile::{median, quantile};
use super::runs::add;
use crate::table::Row;

/// Rounds that bring a search to a path such as it spends its time on.
const N_ROUNDS: usize = 12;

/// Times that the path's neighbourhood is scored; the median counts.
const N_PASSES: usize = 7;

/// Frames of the clip that the pose and the lock hold.
const HARD_FRAMES: u32 = 20;

/// Scores all reconnections and detours of a path.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let (library, asked) = (bench.library()?, bench.asked()?);
    let plain = asked.first().context("no problem was found")?;
    let problem = with_every_kind(&library, plain)?;
    let mut search = Search::new(Arc::clone(&library), problem, 1)?;
    for _ in 0..N_ROUNDS {
        search.step(&CancelToken::new());
    }
    let path = search.best().context("nothing meets every kind at once")?.path;
    let mut spent = Spent::default();
    let (mut n, mut rates) = (0, Vec::new());
    for _ in 0..N_PASSES {
        let (found, once) = timed(|| search.score_neighbourhood(black_box(&path)));
        n = found.map_or(0, |found| found.counts.scored);
        rates.push(n as f64 / once.cpu.as_secs_f64());
        add(&mut spent, once);
    }
    let rate = median(&rates);
    Ok(vec![Row {
        figure: "candidates scored, one core, every kind".to_owned(),
        target: "5 million/s",
        measured: format!("{:.1} million/s", rate / 1e6),
        is_met: rate >= 5e6,
        spent,
        notes: vec![format!(
            "{:.2} million candidates of a path of {} pieces, none bounded; slowest and fastest of \
             {N_PASSES} passes {:.1} and {:.1} million/s",
            n as f64 / 1e6,
            path.cuts.len() + 1,
            quantile(&rates, 0.0) / 1e6,
            quantile(&rates, 1.0) / 1e6
        )],
    }])
}

/// A problem with a wish of every other kind added.
///
/// What is hard is a stretch of the clip that a plain search uses most, so that it can be reached.
fn with_every_kind(
    library: &Arc<SearchLibrary>,
    plain: &Asked,
) -> anyhow::Result<motion_core::search::Problem> {
    let mut problem = plain.problem.clone();
    let mut search = Search::new(Arc::clone(library), problem.clone(), 1)?;
    for _ in 0..N_ROUNDS {
        search.step(&CancelToken::new());
    }
    let best = search.best().context("nothing was found")?;
    let pieces = best.path.pieces(library.graph());
    let longest = pieces.iter().max_by_key(|piece| piece.n_frames()).context("no piece")?;
    let Piece { clip, from, .. } = *longest;
    let starts: usize =
        pieces.iter().take_while(|piece| *piece != longest).map(|piece| piece.n_frames()).sum();
    let first = starts as u32;
    let to = FrameIdx(from.0 + HARD_FRAMES.min(longest.n_frames() as u32 - 1));
    let wishes = &mut problem.wishes;
    let n_frames = wishes.length.map_or(240, |length| length.frames);
    let third = n_frames / 3;
    let lock = LockConstraint {
        from: first,
        to: first + to.0 - from.0,
        pieces: vec![Piece { to, ..*longest }],
    };
    wishes.poses.push(PoseConstraint::new(lock.to, clip, to));
    wishes.locks.push(lock);
    wishes.joints.push(JointConstraint::new(third, JointIdx(5), Vec3::new(0.3, 1.0, 3.0)));
    let points_m = vec![Vec2::ZERO, Vec2::new(0.5, 3.0), Vec2::new(0.0, 6.0)];
    wishes.follows.push(FollowConstraint::new(0, 2 * third, points_m));
    let tag = "walk".to_owned();
    wishes.styles.push(StyleConstraint {
        from: third,
        to: 2 * third,
        tag,
        weight: 1.0,
        by_hand: Default::default(),
    });
    wishes.obstacles.push(Obstacle::Cylinder {
        center_m: Vec3::new(0.8, 1.0, 4.0),
        radius_m: 0.3,
        height_m: 2.0,
    });
    let ground_m = (0..n_frames).map(|f| Vec2::new(1.5, 9.0 - 0.03 * f as f32)).collect();
    wishes.others.push(OtherBody { ground_m, together: Vec::new() });
    Ok(problem)
}

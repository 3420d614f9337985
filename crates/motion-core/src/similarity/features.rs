//! Feature vectors and their normalisers (AF02 appendix A).

use glam::{DVec3, Quat, Vec3};
use rayon::prelude::*;

use super::columns::{Column, ColumnSource};
use super::families::Families;
use crate::clip::{Clip, ClipSet};
use crate::ids::ClipId;
use crate::rotation;
use crate::skeleton::Skeleton;

/// The share of neighbouring-frame changes that a normaliser covers: a maximum would be set by
/// a handful of rolling clips, up to 200 times too large.
pub const NORMALISER_QUANTILE: f64 = 0.999;

/// Normalisers are at least this (square metres and its like): a column that never moves must
/// not divide by zero.
pub const NORMALISER_FLOOR: f64 = 1e-6;

/// The columns in use and their normalisers: all that the cost depends on beside the clips.
#[derive(Clone, Debug, PartialEq)]
pub struct Metric {
    /// The columns with their weights `M` and `W`.
    pub columns: Vec<Column>,
    /// `O_k`: 99.9th percentile of `‖D_k‖²` between neighbouring frames.
    pub change: Vec<f64>,
    /// `L_k`: the same of `‖Ḋ_k‖²`.
    pub derivative_change: Vec<f64>,
}

/// A feature vector per frame of a set of clips.
///
/// Row `frame_starts[clip] + frame` is `[√(M/O)·columns | √(W/L)·derivatives]` less its mean
/// over all frames, so that f32 keeps its digits. `n_dims = 6 · columns`.
#[derive(Clone, Debug)]
pub struct FeatureSet {
    /// What the vectors are made of.
    pub metric: Metric,
    /// Length of a row.
    pub n_dims: usize,
    /// Row of each clip's frame 0; one more entry at the end: the number of rows.
    pub frame_starts: Vec<usize>,
    /// Rows, one after the other.
    pub rows: Vec<f32>,
    /// Which clips are copies of one take.
    pub families: Families,
}

impl FeatureSet {
    /// Features of every frame of `clips` by `columns`, with normalisers found from the clips.
    pub fn new(clips: &ClipSet, columns: Vec<Column>) -> Self {
        let raw = all_raw_columns(clips, &columns);
        let width = 2 * columns.len();
        let mut change: Vec<f64> =
            (0..width).into_par_iter().map(|column| normaliser(&raw, width, column)).collect();
        let derivative_change = change.split_off(columns.len());
        let metric = Metric { columns, change, derivative_change };
        Self::of_raw(clips, &raw, metric, clips.clips().len())
    }

    /// Features of every frame of `clips` by a metric that is known: that of a library of the
    /// first `n_old` of them, whose costs stay what they were.
    pub fn by_metric(clips: &ClipSet, metric: Metric, n_old: usize) -> Self {
        let raw = all_raw_columns(clips, &metric.columns);
        Self::of_raw(clips, &raw, metric, n_old)
    }

    /// Rows from columns, less their mean over the first `n_mean` clips.
    fn of_raw(clips: &ClipSet, raw: &[Vec<DVec3>], metric: Metric, n_mean: usize) -> Self {
        let Metric { columns, change, derivative_change } = &metric;
        let width = 2 * columns.len();
        let scales: Vec<f64> = columns
            .iter()
            .map(|c| c.weight)
            .chain(columns.iter().map(|c| c.derivative_weight))
            .zip(change.iter().chain(derivative_change))
            .map(|(weight, normaliser)| (weight / normaliser).sqrt())
            .collect();

        let mut frame_starts = vec![0];
        for clip in clips.clips() {
            frame_starts.push(frame_starts[frame_starts.len() - 1] + clip.n_frames());
        }
        let n_rows = frame_starts[n_mean];
        let mut mean = vec![DVec3::ZERO; width];
        for clip in &raw[..n_mean] {
            for row in clip.chunks_exact(width) {
                for (sum, &value) in mean.iter_mut().zip(row) {
                    *sum += value;
                }
            }
        }
        for sum in &mut mean {
            *sum /= n_rows.max(1) as f64;
        }
        let rows = raw
            .par_iter()
            .flat_map_iter(|clip| {
                let (mean, scales) = (&mean, &scales);
                clip.iter().enumerate().flat_map(move |(at, &value)| {
                    let column = at % width;
                    ((value - mean[column]) * scales[column]).as_vec3().to_array()
                })
            })
            .collect();
        let clip_frames: Vec<u32> =
            clips.clips().iter().map(|clip| clip.n_frames() as u32).collect();
        let ids = clips.clips().iter().map(|clip| clip.id.as_str());
        let families = Families::of_ids(ids, &clip_frames);
        Self { metric, n_dims: 3 * width, frame_starts, rows, families }
    }

    /// How many frames there are in all.
    pub fn n_rows(&self) -> usize {
        self.frame_starts[self.frame_starts.len() - 1]
    }

    /// The feature vector of row `row`.
    #[inline]
    pub fn row(&self, row: usize) -> &[f32] {
        &self.rows[row * self.n_dims..(row + 1) * self.n_dims]
    }

    /// The clip that row `row` belongs to, and the frame in it.
    pub fn clip_of_row(&self, row: usize) -> (ClipId, usize) {
        let clip = self.frame_starts.partition_point(|&start| start <= row) - 1;
        (ClipId::from_idx(clip), row - self.frame_starts[clip])
    }

    /// The cost between two rows: `Σ (x − y)²` in f64 in a fixed order, so that it is the same
    /// on any machine and whichever way the pair was found.
    #[inline]
    pub fn cost(&self, a: usize, b: usize) -> f64 {
        // Four running sums, for speed; the order is fixed by the code, not by the machine.
        let mut sums = [0.0f64; 4];
        let (a, b) = (self.row(a), self.row(b));
        let (chunks_a, chunks_b) = (a.chunks_exact(4), b.chunks_exact(4));
        let rest: f64 = chunks_a
            .remainder()
            .iter()
            .zip(chunks_b.remainder())
            .map(|(&x, &y)| (f64::from(x) - f64::from(y)).powi(2))
            .sum();
        for (x, y) in chunks_a.zip(chunks_b) {
            for lane in 0..4 {
                let difference = f64::from(x[lane]) - f64::from(y[lane]);
                sums[lane] += difference * difference;
            }
        }
        (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
    }
}

fn all_raw_columns(clips: &ClipSet, columns: &[Column]) -> Vec<Vec<DVec3>> {
    let raw = clips.clips().par_iter().map(|clip| raw_columns(clips.skeleton(), clip, columns));
    raw.collect()
}

/// Values of every column and derivative column of `clip`, frame by frame, unnormalised.
///
/// Derivatives are central differences, one-sided at the first and last frame; they are zero in
/// a clip of one frame.
fn raw_columns(skeleton: &Skeleton, clip: &Clip, columns: &[Column]) -> Vec<DVec3> {
    let motion = &clip.motion;
    let n_frames = motion.n_frames();
    let fps = motion.fps().get();
    let root: Vec<DVec3> = motion.root_positions_m().iter().map(|p| p.as_dvec3()).collect();
    let velocity = differentiated(&root, fps);
    let turn = turn_rate(motion.n_frames(), fps, |frame| motion.root_rotation(frame));
    let acceleration = differentiated(&velocity, fps);
    let turn_acceleration = differentiated(&turn, fps);
    let torso_from_world: Vec<_> =
        clip.track.world_from_torso.iter().map(|t| t.inverse()).collect();

    let positions = motion.joint_positions_m(skeleton);
    let n_joints = skeleton.n_joints();
    let n_columns = columns.len();
    let mut raw = vec![DVec3::ZERO; n_frames * 2 * n_columns];
    for (k, column) in columns.iter().enumerate() {
        let turned = |series: &[DVec3]| -> Vec<DVec3> {
            let turn =
                |(v, t): (&DVec3, &crate::planar::PlanarTransform)| t.turn(v.as_vec3()).as_dvec3();
            series.iter().zip(&torso_from_world).map(turn).collect()
        };
        let (values, derivatives) = match column.source {
            ColumnSource::TorsoVelocity => (turned(&velocity), turned(&acceleration)),
            ColumnSource::TorsoTurn => (turned(&turn), turned(&turn_acceleration)),
            ColumnSource::Joint(joint) => {
                let in_torso: Vec<DVec3> = (0..n_frames)
                    .map(|frame| {
                        let p: Vec3 = positions[frame * n_joints + joint.idx()];
                        torso_from_world[frame].apply(p).as_dvec3()
                    })
                    .collect();
                let velocity = differentiated(&in_torso, fps);
                (in_torso, velocity)
            }
        };
        for frame in 0..n_frames {
            let row = frame * 2 * n_columns;
            raw[row + k] = values[frame];
            raw[row + n_columns + k] = derivatives[frame];
        }
    }
    raw
}

/// The time derivative of a series: central differences, one-sided at the ends.
fn differentiated(series: &[DVec3], fps: f64) -> Vec<DVec3> {
    let last = series.len() - 1;
    (0..series.len())
        .map(|frame| {
            let (before, after) = (frame.saturating_sub(1), (frame + 1).min(last));
            if before == after {
                return DVec3::ZERO;
            }
            (series[after] - series[before]) * (fps / (after - before) as f64)
        })
        .collect()
}

/// World rotational velocity, radians per second, by the same differences.
fn turn_rate(n_frames: usize, fps: f64, rotation_at: impl Fn(usize) -> Quat) -> Vec<DVec3> {
    let last = n_frames - 1;
    (0..n_frames)
        .map(|frame| {
            let (before, after) = (frame.saturating_sub(1), (frame + 1).min(last));
            if before == after {
                return DVec3::ZERO;
            }
            let turn = rotation::log(rotation_at(after) * rotation_at(before).inverse());
            turn.as_dvec3() * (fps / (after - before) as f64)
        })
        .collect()
}

/// The [`NORMALISER_QUANTILE`] of the squared change of `column` between neighbouring frames of
/// one clip (nearest rank), at least [`NORMALISER_FLOOR`].
fn normaliser(raw: &[Vec<DVec3>], width: usize, column: usize) -> f64 {
    let mut changes: Vec<f64> = Vec::new();
    for clip in raw {
        let values = clip.iter().skip(column).step_by(width);
        changes.extend(values.clone().zip(values.skip(1)).map(|(a, b)| (*b - *a).length_squared()));
    }
    if changes.is_empty() {
        return NORMALISER_FLOOR;
    }
    let rank =
        ((NORMALISER_QUANTILE * changes.len() as f64).ceil() as usize).clamp(1, changes.len());
    let (_, &mut value, _) = changes.select_nth_unstable_by(rank - 1, f64::total_cmp);
    value.max(NORMALISER_FLOOR)
}

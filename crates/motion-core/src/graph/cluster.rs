//! Cutting islands into clusters, and clusters into binary trees.
//!
//! Everything here is deterministic: clusters are seeded along the island's major axis, ties go
//! to the first centre, and the loops are bounded.

use glam::DVec2;

use super::forest::Edge;
use crate::units::FrameIdx;

/// No island is cut into more clusters than this.
const MAX_CLUSTERS: usize = 64;

/// Rounds of k-means. Seeds lie along the island already; what a sixth round would still move is
/// an edge or two at a border.
const MAX_ROUNDS: usize = 5;

fn point(edge: &Edge) -> DVec2 {
    DVec2::new(f64::from(edge.from_frame.0), f64::from(edge.to_frame.0))
}

/// Sums over a group of edges from which its mean and its ellipse follow.
#[derive(Clone, Copy, Default)]
pub(super) struct Moments {
    n: f64,
    sum: DVec2,
    /// Sums of `from²`, `to²`; then of `from · to`. Exact: frames are far below 2²⁶.
    squares: DVec2,
    product: f64,
    cost: f64,
}

impl Moments {
    pub(super) fn of(edges: &[Edge]) -> Self {
        let mut moments = Self { n: edges.len() as f64, ..Self::default() };
        for edge in edges {
            let p = point(edge);
            moments.sum += p;
            moments.squares += p * p;
            moments.product += p.x * p.y;
            moments.cost += f64::from(edge.cost);
        }
        moments
    }

    /// The edge that stands for the group: rounded mean frames, mean cost.
    pub(super) fn mean_edge(&self) -> Edge {
        let rounded = |sum: f64| FrameIdx((sum / self.n).round() as u32);
        Edge {
            from_frame: rounded(self.sum.x),
            to_frame: rounded(self.sum.y),
            cost: (self.cost / self.n) as f32,
        }
    }
}

/// Mean, major axis (unit) and the two standard deviations of a group of edges.
///
/// Each edge is a unit cell of the frame plane, not a point, so a variance of 1/12 is added:
/// a straight line of n cells is n times longer than wide, not infinitely.
struct Ellipse {
    mean: DVec2,
    major_axis: DVec2,
    major: f64,
    minor: f64,
}

impl Ellipse {
    fn of(moments: &Moments) -> Self {
        let mean = moments.sum / moments.n;
        let variance = moments.squares / moments.n - mean * mean;
        let xy = moments.product / moments.n - mean.x * mean.y;
        let (xx, yy) = (variance.x + 1.0 / 12.0, variance.y + 1.0 / 12.0);
        let half_sum = 0.5 * (xx + yy);
        let half_gap = (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
        // Eigenvector of the larger eigenvalue.
        let axis = if xy.abs() < 1e-9 {
            if xx >= yy { DVec2::X } else { DVec2::Y }
        } else {
            DVec2::new(xy, half_sum + half_gap - xx)
        };
        Self {
            mean,
            major_axis: axis.normalize_or(DVec2::X),
            major: (half_sum + half_gap).sqrt(),
            minor: (half_sum - half_gap).max(1e-12).sqrt(),
        }
    }
}

/// Cuts an island by k-means into `k = round(major axis / minor axis)` clusters, at least 1.
pub(super) fn clusters(island: &[Edge]) -> Vec<Vec<Edge>> {
    let ellipse = Ellipse::of(&Moments::of(island));
    let k = (ellipse.major / ellipse.minor).round() as usize;
    let k = k.clamp(1, MAX_CLUSTERS.min(island.len()));
    if k == 1 {
        return vec![island.to_vec()];
    }
    // Seeds: the means of k equal shares of the edges in order along the major axis.
    let mut order: Vec<usize> = (0..island.len()).collect();
    let along = |at: usize| (point(&island[at]) - ellipse.mean).dot(ellipse.major_axis);
    order.sort_by(|&a, &b| along(a).total_cmp(&along(b)).then(a.cmp(&b)));
    let mut centres: Vec<DVec2> = (0..k)
        .map(|share| {
            let members = &order[share * order.len() / k..(share + 1) * order.len() / k];
            members.iter().map(|&at| point(&island[at])).sum::<DVec2>() / members.len() as f64
        })
        .collect();
    let mut labels = vec![0usize; island.len()];
    for round in 0..MAX_ROUNDS {
        let mut changed = round == 0;
        for (label, edge) in labels.iter_mut().zip(island) {
            let p = point(edge);
            let mut nearest = (f64::INFINITY, 0);
            for (at, centre) in centres.iter().enumerate() {
                let distance = centre.distance_squared(p);
                if distance < nearest.0 {
                    nearest = (distance, at);
                }
            }
            changed |= *label != nearest.1;
            *label = nearest.1;
        }
        if !changed {
            break;
        }
        let mut sums = vec![(DVec2::ZERO, 0.0f64); k];
        for (&label, edge) in labels.iter().zip(island) {
            sums[label].0 += point(edge);
            sums[label].1 += 1.0;
        }
        for (centre, (sum, n)) in centres.iter_mut().zip(sums) {
            if n > 0.0 {
                *centre = sum / n;
            }
        }
    }
    let mut clusters = vec![Vec::new(); k];
    for (&label, &edge) in labels.iter().zip(island) {
        clusters[label].push(edge);
    }
    clusters.retain(|cluster| !cluster.is_empty());
    clusters
}

/// The line of points that are as near to one centre as to the other.
struct Border {
    across: DVec2,
    at: f64,
}

impl Border {
    fn between([first, second]: [DVec2; 2]) -> Self {
        let across = second - first;
        Self { across, at: 0.5 * across.dot(first + second) }
    }

    #[inline]
    fn is_first(&self, p: DVec2) -> bool {
        p.dot(self.across) <= self.at
    }
}

/// Parts `edges` (at least two) in place into two groups by 2-means and returns where the
/// second begins: never 0, never the end. `moments` are those of `edges`.
pub(super) fn split_in_two(
    edges: &mut [Edge],
    moments: &Moments,
    scratch: &mut Vec<Edge>,
) -> usize {
    debug_assert!(edges.len() >= 2, "one edge cannot be split");
    if edges.len() == 2 {
        return 1;
    }
    let ellipse = Ellipse::of(moments);
    let reach = ellipse.major_axis * ellipse.major;
    let mut centres = [ellipse.mean - reach, ellipse.mean + reach];
    let total = moments.sum;
    let mut border = Border::between(centres);
    for _ in 0..MAX_ROUNDS {
        let (mut sum, mut n) = (DVec2::ZERO, 0usize);
        for edge in &*edges {
            let p = point(edge);
            // Branch-free: the two halves are as good as random to a branch predictor.
            let first = border.is_first(p);
            sum += p * f64::from(u8::from(first));
            n += usize::from(first);
        }
        if n == 0 || n == edges.len() {
            return edges.len() / 2;
        }
        let moved = [sum / n as f64, (total - sum) / (edges.len() - n) as f64];
        let settled = moved == centres;
        centres = moved;
        border = Border::between(centres);
        if settled {
            break;
        }
    }
    let is_first = |edge: &Edge| border.is_first(point(edge));
    let n_first = edges.iter().filter(|edge| is_first(edge)).count();
    if n_first == 0 || n_first == edges.len() {
        return edges.len() / 2;
    }
    // A stable partition, so that the order within each half does not depend on anything else.
    scratch.clear();
    scratch.extend(edges.iter().filter(|edge| !is_first(edge)));
    let mut next = 0;
    for at in 0..edges.len() {
        if is_first(&edges[at]) {
            edges[next] = edges[at];
            next += 1;
        }
    }
    edges[next..].copy_from_slice(scratch);
    next
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(edges: &mut [Edge]) -> usize {
        let moments = Moments::of(edges);
        split_in_two(edges, &moments, &mut Vec::new())
    }

    fn line(n: u32) -> Vec<Edge> {
        let edge = |at| Edge { from_frame: FrameIdx(at), to_frame: FrameIdx(at), cost: 1.0 };
        (0..n).map(edge).collect()
    }

    fn block(n: u32) -> Vec<Edge> {
        let cell =
            |at| Edge { from_frame: FrameIdx(at / n), to_frame: FrameIdx(at % n), cost: 1.0 };
        (0..n * n).map(cell).collect()
    }

    #[test]
    fn a_square_is_one_cluster_and_a_long_diagonal_many() {
        assert_eq!(clusters(&block(6)).len(), 1, "as long as wide");
        // n cells on a diagonal: √2·n/√12 against 1/√12 cells.
        let n = clusters(&line(10)).len();
        assert!((10..=15).contains(&n) || n == 10, "a line of ten cells: {n}");
        assert_eq!(clusters(&line(1)).len(), 1, "one edge");
    }

    #[test]
    fn clusters_keep_every_edge_once() {
        let mut edges = line(300);
        edges.extend(block(3).into_iter().map(|e| Edge {
            from_frame: FrameIdx(e.from_frame.0 + 100),
            to_frame: FrameIdx(e.to_frame.0 + 104),
            ..e
        }));
        edges.sort_by_key(|e| (e.from_frame, e.to_frame));
        let mut together: Vec<Edge> = clusters(&edges).concat();
        together.sort_by_key(|e| (e.from_frame, e.to_frame));
        assert_eq!(together, edges);
    }

    #[test]
    fn two_groups_are_told_apart() {
        let mut edges = line(4);
        edges.extend(
            line(7).into_iter().map(|e| Edge { from_frame: FrameIdx(e.from_frame.0 + 50), ..e }),
        );
        assert_eq!(split(&mut edges), 4);
        assert!(edges[..4].iter().all(|e| e.from_frame.0 < 10), "{edges:?}");
    }

    #[test]
    fn any_group_is_split_into_two_that_are_not_empty() {
        for n in 2..40 {
            let mut edges = line(n);
            let at = split(&mut edges);
            assert!(at > 0 && at < n as usize, "{n} edges split at {at}");
        }
    }
}

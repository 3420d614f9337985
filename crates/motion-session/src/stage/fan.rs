//! Which frames stand for a whole motion when they are shown side by side.

use glam::{Vec2, Vec3};

/// Which frames to show along the path of `root_path_m`: first and last, and between them evenly by
/// the way that is covered, at most `n_max` (at least 2), none nearer than `apart_m` over the ground
/// to another, so that bodies do not pile up where the path comes back or stands still.
///
/// In order, without repetition; a motion that stays in place gives its first frame alone.
pub fn fan(root_path_m: &[Vec3], n_max: usize, apart_m: f32) -> Vec<usize> {
    let ground: Vec<Vec2> = root_path_m.iter().map(|p| Vec2::new(p.x, p.z)).collect();
    let Some(last) = ground.len().checked_sub(1) else { return Vec::new() };
    let covered = covered_m(&ground);
    let n = ((covered[last] / apart_m.max(1e-3)) as usize + 1).clamp(2, n_max.max(2));
    let mut chosen = vec![0];
    let is_free = |chosen: &[usize], frame: usize| {
        chosen.iter().all(|&other| ground[other].distance(ground[frame]) >= apart_m)
    };
    if is_free(&chosen, last) {
        chosen.push(last);
    }
    for step in 1..n - 1 {
        let way_m = covered[last] * step as f32 / (n - 1) as f32;
        let frame = covered.partition_point(|&m| m < way_m).min(last);
        if is_free(&chosen, frame) {
            chosen.push(frame);
        }
    }
    chosen.sort_unstable();
    chosen
}

/// What a pose covers of a picture, pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Covered {
    /// Its upper left corner.
    pub min_px: Vec2,
    /// Its lower right corner.
    pub max_px: Vec2,
}

impl Covered {
    /// How far two poses are from covering each other: 0 at the same place, 1 where they touch.
    fn apart(&self, other: &Self) -> f32 {
        let center = |c: &Self| 0.5 * (c.min_px + c.max_px);
        let both = 0.5 * ((self.max_px - self.min_px) + (other.max_px - other.min_px));
        let off = (center(self) - center(other)).abs();
        (off / both.max(Vec2::splat(1e-3))).max_element()
    }
}

/// Of poses on a picture those that leave each other to be seen: the first, the last, and again and
/// again the one that is furthest from all that are chosen, as long as it is at least `apart` (1:
/// they just touch) from them. Indices in order; at most `n_max`, but first and last always.
pub fn clear_of_each_other(poses: &[Covered], n_max: usize, apart: f32) -> Vec<usize> {
    let Some(last) = poses.len().checked_sub(1) else { return Vec::new() };
    let mut chosen = vec![0];
    if last > 0 {
        chosen.push(last);
    }
    while chosen.len() < n_max {
        let clear = |nth: usize| {
            let each = chosen.iter().map(|&other| poses[nth].apart(&poses[other]));
            each.fold(f32::INFINITY, f32::min)
        };
        let best = (0..poses.len())
            .map(|nth| (clear(nth), nth))
            .reduce(|best, next| if next.0 > best.0 { next } else { best });
        match best {
            Some((clear, nth)) if clear >= apart => chosen.push(nth),
            _ => break,
        }
    }
    chosen.sort_unstable();
    chosen
}

/// `n` frames (at least 1) spread evenly over the time of a motion of `n_frames`, ends included;
/// one alone is the middle one.
pub fn spread(n_frames: usize, n: usize) -> Vec<usize> {
    let last = n_frames.saturating_sub(1);
    match n.min(n_frames) {
        0 => Vec::new(),
        1 => vec![last / 2],
        n => (0..n).map(|k| (k * last + (n - 1) / 2) / (n - 1)).collect(),
    }
}

/// How far the body has gone over the ground at every frame, metres.
fn covered_m(ground: &[Vec2]) -> Vec<f32> {
    let mut sum = 0.0;
    let mut covered = vec![0.0];
    for pair in ground.windows(2) {
        sum += pair[0].distance(pair[1]);
        covered.push(sum);
    }
    covered
}

/// The diameter of the smallest upright box around a path, over the ground, metres.
pub fn extent_m(root_path_m: &[Vec3]) -> f32 {
    let ground = root_path_m.iter().map(|p| Vec2::new(p.x, p.z));
    let min = ground.clone().reduce(Vec2::min).unwrap_or_default();
    let max = ground.reduce(Vec2::max).unwrap_or_default();
    min.distance(max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walk(n: usize, step_m: f32) -> Vec<Vec3> {
        (0..n).map(|f| Vec3::new(0.0, 0.9, step_m * f as f32)).collect()
    }

    #[test]
    fn a_walk_is_shown_evenly_with_both_ends() {
        let path = walk(241, 0.025);
        assert_eq!(fan(&path, 7, 0.7), [0, 40, 80, 120, 160, 200, 240]);
        assert_eq!(fan(&path, 4, 0.7), [0, 80, 160, 240]);
        assert_eq!(fan(&path, 100, 1.9), [0, 80, 160, 240], "none nearer than that");
    }

    #[test]
    fn nobody_stands_in_somebody_else() {
        // There and back again, with a rest.
        let mut path = walk(100, 0.03);
        path.extend(vec![path[99]; 50]);
        path.extend(walk(100, 0.03).into_iter().rev());
        let chosen = fan(&path, 9, 0.7);
        assert_eq!(chosen[0], 0);
        for (nth, &a) in chosen.iter().enumerate() {
            for &b in &chosen[nth + 1..] {
                assert!(path[a].distance(path[b]) >= 0.7, "{chosen:?}");
            }
        }
    }

    #[test]
    fn what_would_cover_others_is_left_out() {
        let at = |x: f32| Covered { min_px: Vec2::new(x, 0.0), max_px: Vec2::new(x + 10.0, 40.0) };
        let poses = [0.0, 2.0, 9.0, 20.0, 22.0, 31.0].map(at);
        assert_eq!(clear_of_each_other(&poses, 9, 0.8), [0, 2, 3, 5]);
        assert_eq!(clear_of_each_other(&poses, 3, 0.8), [0, 3, 5]);
        assert_eq!(clear_of_each_other(&poses[..2], 9, 0.8), [0, 1], "both ends stay");
        assert_eq!(clear_of_each_other(&poses[..1], 9, 0.8), [0]);
        assert_eq!(clear_of_each_other(&[], 9, 0.8), [0usize; 0]);
    }

    #[test]
    fn small_motions_have_small_fans() {
        assert_eq!(fan(&[], 5, 0.7), [0usize; 0]);
        assert_eq!(fan(&walk(1, 1.0), 5, 0.7), [0]);
        assert_eq!(fan(&walk(50, 0.001), 5, 0.7), [0]);
    }

    #[test]
    fn time_is_spread_with_both_ends() {
        assert_eq!(spread(241, 4), [0, 80, 160, 240]);
        assert_eq!(spread(10, 4), [0, 3, 6, 9]);
        assert_eq!(spread(3, 8), [0, 1, 2]);
        assert_eq!(spread(5, 1), [2]);
        assert_eq!(spread(0, 4), [0usize; 0]);
    }

    #[test]
    fn a_path_has_an_extent() {
        assert_eq!(extent_m(&walk(101, 0.05)), 5.0);
        assert_eq!(extent_m(&[]), 0.0);
    }
}

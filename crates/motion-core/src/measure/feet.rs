//! Feet that should stand and do not: slide, and the field's skate ratios.

use glam::Vec3;

use super::support::{Support, Toes};
use crate::contacts::{self, Side};
use crate::motion::Motion;
use crate::skeleton::Skeleton;
use crate::units::Fps;

/// The definition of `foot_slide_cm_per_s`.
pub const SLIDE_DEFINITION: &str =
    "mean speed along the ground of a toe joint from frame to frame while it is planted";

/// The definition of `foot_slide_max_cm`.
pub const SLIDE_MAX_DEFINITION: &str = "farthest along the ground that a toe joint gets from \
     where its plant began, over all plants";

/// The definition of `foot_slide_carried_cm_per_s`.
pub const CARRIED_SLIDE_DEFINITION: &str = "foot slide over the contacts carried from the source \
     clips, so that a foot that slides fast does not escape by no longer counting as planted";

/// The definition of `skate_ratio`.
pub const SKATE_DEFINITION: &str = "share of frames in which a toe joint is less than 5 cm above \
     the support in this frame and the next and goes faster than 0.5 m/s along the ground (GMD, \
     OmniControl)";

/// The definition of `skate_ratio_kimodo`.
pub const SKATE_KIMODO_DEFINITION: &str = "the same at 0.2 m/s (Kimodo)";

/// The definition of `toe_speed_below_5cm_m_s`.
pub const LOW_TOE_DEFINITION: &str = "mean speed along the ground of a toe joint while it is \
     less than 5 cm above the support in this frame and the next (Kimodo)";

/// A toe joint is low below this height above the support, metres; the field's bodies have their
/// toe joints at 1–2 cm, others (3–4 cm on the CMU bodies) are judged more mildly.
const LOW_M: f32 = 0.05;
/// Speed of a skating toe after GMD and `OmniControl`, m/s.
const SKATE_M_S: f32 = 0.5;
/// Speed of a skating toe after Kimodo, m/s.
const SKATE_KIMODO_M_S: f32 = 0.2;

/// How much planted feet move.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slide {
    /// Mean speed along the ground, m/s.
    pub mean_m_s: f32,
    /// Largest drift within one plant, metres.
    pub max_drift_m: f32,
    /// Pairs of planted frames that the mean is over.
    pub n_steps: usize,
}

/// The field's skate figures.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Skate {
    /// Share of frames with a low toe faster than 0.5 m/s.
    pub ratio: f32,
    /// Share of frames with a low toe faster than 0.2 m/s.
    pub ratio_kimodo: f32,
    /// Mean speed of low toes, m/s.
    pub low_toe_speed_m_s: f32,
}

/// The toe joints' paths; empty for a foot that the body does not have.
pub fn toe_paths_m(skeleton: &Skeleton, motion: &Motion) -> Toes {
    let paths_m = Side::BOTH.map(|side| match contacts::toe_joint(skeleton, side) {
        Some(toe) => motion.joint_path_m(skeleton, toe),
        None => Vec::new(),
    });
    Toes { paths_m, fps: motion.fps() }
}

/// Slide over plants by the plain rule ([`contacts::planted_on_lowest`]); `None` without plants.
pub fn slide(toes: &Toes, fps: Fps) -> Option<Slide> {
    let planted = Side::BOTH.map(|side| contacts::planted_on_lowest(toes.path_m(side), fps));
    slide_where(toes, fps, |side, frame| planted[side.idx()][frame])
}

/// Slide over carried contacts; `None` without any.
pub fn carried_slide(toes: &Toes, fps: Fps, support: &Support) -> Option<Slide> {
    slide_where(toes, fps, |side, frame| support.contacts[frame].side(side))
}

fn slide_where(toes: &Toes, fps: Fps, planted: impl Fn(Side, usize) -> bool) -> Option<Slide> {
    let mut slide = Slide::default();
    let mut way_m = 0.0f64;
    for side in Side::BOTH {
        let path = toes.path_m(side);
        for plant in contacts::runs(path.len(), |frame| planted(side, frame)) {
            let start = path[plant.start];
            for frame in plant.start + 1..plant.end {
                way_m += f64::from(ground_distance_m(path[frame - 1], path[frame]));
                let drift_m = ground_distance_m(start, path[frame]);
                slide.max_drift_m = slide.max_drift_m.max(drift_m);
            }
            slide.n_steps += plant.len() - 1;
        }
    }
    slide.mean_m_s = (way_m * fps.get() / slide.n_steps.max(1) as f64) as f32;
    (slide.n_steps > 0).then_some(slide)
}

/// The field's skate figures; `None` without feet or for a single frame.
pub fn skate(toes: &Toes, fps: Fps, support: &Support) -> Option<Skate> {
    let n_steps = toes.paths_m.iter().map(Vec::len).max()?.checked_sub(1).filter(|&n| n > 0)?;
    let (mut n_fast, mut n_kimodo) = (0usize, 0usize);
    let (mut sum_m_s, mut n_low) = (0.0f64, 0usize);
    for step in 0..n_steps {
        let mut fastest = 0.0f32;
        for side in Side::BOTH {
            let Some(pair) = toes.path_m(side).get(step..step + 2) else { continue };
            let low = |offset: usize| pair[offset].y < support.levels_m[step + offset] + LOW_M;
            if low(0) && low(1) {
                let speed = ground_distance_m(pair[0], pair[1]) * fps.get() as f32;
                fastest = fastest.max(speed);
                sum_m_s += f64::from(speed);
                n_low += 1;
            }
        }
        n_fast += usize::from(fastest > SKATE_M_S);
        n_kimodo += usize::from(fastest > SKATE_KIMODO_M_S);
    }
    Some(Skate {
        ratio: n_fast as f32 / n_steps as f32,
        ratio_kimodo: n_kimodo as f32 / n_steps as f32,
        low_toe_speed_m_s: (sum_m_s / n_low.max(1) as f64) as f32,
    })
}

fn ground_distance_m(a: Vec3, b: Vec3) -> f32 {
    (b.x - a.x).hypot(b.z - a.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::floor::Soles;
    use crate::ground::Contacts;

    /// A left toe that creeps along +Z at `speed_m_s` on the floor for `n` frames.
    fn creeping(speed_m_s: f32, n: usize) -> Toes {
        let path = (0..n).map(|f| Vec3::Z * speed_m_s * f as f32 / 30.0).collect();
        Toes { paths_m: [path, Vec::new()], fps: Fps::THIRTY }
    }

    /// A floor at 0 with both feet planted all along.
    fn floor(n: usize) -> Support {
        let contacts = vec![Contacts { left: true, right: true }; n];
        Support { levels_m: vec![0.0; n], contacts, soles: Soles::default() }
    }

    #[test]
    fn toes_above_the_support_do_not_skate() {
        let mut raised = creeping(0.7, 31);
        for toe in &mut raised.paths_m[0] {
            toe.y = 0.06;
        }
        let skate = |support: &Support| skate(&raised, Fps::THIRTY, support).map(|s| s.ratio);
        assert_eq!(skate(&floor(31)), Some(0.0));
        let mut step = floor(31);
        step.levels_m.fill(0.05);
        assert_eq!(skate(&step), Some(1.0));
    }

    #[test]
    fn a_creeping_foot_slides_at_its_speed() {
        let slide = slide(&creeping(0.1, 31), Fps::THIRTY).expect("planted all along");
        assert!((slide.mean_m_s - 0.1).abs() < 1e-4, "{slide:?}");
        assert!((slide.max_drift_m - 0.1).abs() < 1e-4, "{slide:?}");
        assert_eq!(slide.n_steps, 30);
    }

    #[test]
    fn a_foot_that_slides_fast_escapes_the_rule_but_not_carried_contacts() {
        let toes = creeping(0.4, 31);
        assert_eq!(slide(&toes, Fps::THIRTY), None);
        let slide = carried_slide(&toes, Fps::THIRTY, &floor(31)).expect("carried");
        assert!((slide.mean_m_s - 0.4).abs() < 1e-4, "{slide:?}");
    }

    #[test]
    fn skate_ratios_have_their_speeds() {
        let ratios = |speed| {
            let skate = skate(&creeping(speed, 31), Fps::THIRTY, &floor(31)).expect("feet");
            (skate.ratio, skate.ratio_kimodo, (skate.low_toe_speed_m_s * 100.0).round())
        };
        assert_eq!(ratios(0.1), (0.0, 0.0, 10.0));
        assert_eq!(ratios(0.3), (0.0, 1.0, 30.0));
        assert_eq!(ratios(0.7), (1.0, 1.0, 70.0));
    }

    #[test]
    fn no_feet_no_figures() {
        let none = Toes { paths_m: [Vec::new(), Vec::new()], fps: Fps::THIRTY };
        assert_eq!(slide(&none, Fps::THIRTY), None);
        assert_eq!(skate(&none, Fps::THIRTY, &floor(0)), None);
    }
}

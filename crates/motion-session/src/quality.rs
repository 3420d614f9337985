//! Quality figures in the units of files.

use std::collections::BTreeSet;

use motion_core::clip::ClipSet;
use motion_core::ids::ClipId;
use motion_core::measure::{Quality, feet, measure};
use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;
use motion_io::report_file::{MeasureReport, QualityReport};

/// Figures are shown to four significant digits and four decimals: more would be noise.
fn shown(value: f32) -> f64 {
    let value = f64::from(value);
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let digits = 3 - value.abs().log10().floor() as i32;
    let scale = 10f64.powi(digits.clamp(-12, 4));
    (value * scale).round() / scale
}

/// `quality` in centimetres and degrees.
pub fn quality_report(quality: &Quality) -> QualityReport {
    let cm = |metres: f32| shown(100.0 * metres);
    let skate = quality.skate.as_ref();
    QualityReport {
        foot_slide_cm_per_s: quality.slide.map(|slide| cm(slide.mean_m_s)),
        foot_slide_max_cm: quality.slide.map(|slide| cm(slide.max_drift_m)),
        foot_slide_carried_cm_per_s: quality.carried_slide.map(|slide| cm(slide.mean_m_s)),
        source_foot_slide_cm_per_s: None,
        ground_penetration_max_cm: quality.penetration_max_m.map(cm),
        float_max_cm: quality.float_max_m.map(cm),
        skate_ratio: skate.map(|skate| shown(skate.ratio)),
        skate_ratio_kimodo: skate.map(|skate| shown(skate.ratio_kimodo)),
        toe_speed_below_5cm_m_s: skate.map(|skate| shown(skate.low_toe_speed_m_s)),
        joint_speed_max_m_s: shown(quality.joint_speed_max_m_s),
        joint_acceleration_p99_m_s2: shown(quality.joint_acceleration_p99_m_s2),
        joint_jerk_p99_m_s3: shown(quality.joint_jerk_p99_m_s3),
        rotation_step_max_deg: shown(quality.rotation_step_max_rad.to_degrees()),
        travel_m: shown(quality.travel_m),
        turn_deg: shown(quality.turn_rad.to_degrees()),
    }
}

/// Foot slide of whole clips by the plain rule, a mean over all their planted frames: no capture
/// is free of it, and a motion made of captures cannot be judged without.
pub fn source_foot_slide_cm_per_s(
    clips: &ClipSet,
    sources: impl IntoIterator<Item = ClipId>,
) -> Option<f64> {
    let distinct: BTreeSet<ClipId> = sources.into_iter().collect();
    let (mut sum_m_s, mut n_steps) = (0.0, 0.0);
    for id in distinct {
        let motion = &clips.clip(id).motion;
        let toes = feet::toe_paths_m(clips.skeleton(), motion);
        if let Some(slide) = feet::slide(&toes, motion.fps()) {
            sum_m_s += slide.mean_m_s * slide.n_steps as f32;
            n_steps += slide.n_steps as f32;
        }
    }
    (n_steps > 0.0).then(|| shown(100.0 * sum_m_s / n_steps))
}

/// Measures a motion of any origin; its support is found from its own plants.
pub fn measure_report(skeleton: &Skeleton, motion: &Motion) -> MeasureReport {
    let root = skeleton.joints().first().map_or("", |joint| joint.name.as_str());
    MeasureReport {
        frames: motion.n_frames() as u64,
        fps: motion.fps().get(),
        skeleton: format!("{} joints, root {root}", skeleton.n_joints()),
        quality: quality_report(&measure(skeleton, motion, None)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_digits_are_shown() {
        for (value, expected) in [
            (0.0, 0.0),
            (123.456_7, 123.5),
            (0.001_234_56, 0.0012),
            (7e-7, 0.0),
            (-9.999_96, -10.0),
        ] {
            assert_eq!(shown(value), expected, "{value}");
        }
    }
}

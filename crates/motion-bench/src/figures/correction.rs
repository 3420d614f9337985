//! What is left of the body constraints' errors in finished motions.

use motion_bench::stopwatch::timed;
use motion_core::ground::yaw_series_rad;

use super::Bench;
use super::runs::{Made, add};
use crate::table::Row;

/// The worst of all constraints of all alternatives of all runs.
///
/// Read off the finished motions alone, as the report reads them: the root's place over the
/// ground, and the heading of the motion's own series. In a roll or a cartwheel that series is
/// interpolated, and where a motion ends in one it may differ from the clip's.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let runs = bench.runs()?;
    let motions = || runs.runs.iter().flat_map(|run| &run.motions);
    let (errors, reading) = timed(|| motions().flat_map(errors).collect::<Vec<_>>());
    let position_mm = errors.iter().map(|e| e.0 * 1e3).fold(0.0, f64::max);
    let heading_deg = errors.iter().map(|e| e.1.to_degrees()).fold(0.0, f64::max);
    let n_above = errors.iter().filter(|e| e.0 > 1e-3 || e.1.to_degrees() > 0.1).count();
    let own: Vec<_> = motions().flat_map(|made| &made.assembled.errors).collect();
    let own_mm = own.iter().map(|e| e.position_m * 1e3).fold(0.0, f32::max);
    let own_deg = own.iter().map(|e| e.heading_rad.to_degrees()).fold(0.0, f32::max);
    let mut spent = runs.finishing;
    add(&mut spent, reading);
    Ok(vec![Row {
        figure: "body constraints after correction, worst".to_owned(),
        target: "1 mm, 0.1°",
        measured: format!("{position_mm:.3} mm, {heading_deg:.4}°"),
        is_met: position_mm <= 1.0 && heading_deg <= 0.1,
        spent,
        notes: vec![format!(
            "{} constraints of {} motions, {n_above} above; assembly itself reports {own_mm:.3} mm, \
             {own_deg:.4}°",
            errors.len(),
            motions().count()
        )],
    }])
}

/// Position (metres) and heading (radians) errors of the order's targets.
fn errors(made: &Made) -> Vec<(f64, f64)> {
    let motion = &made.assembled.motion;
    let yaw_rad = yaw_series_rad(motion);
    let targets = made.order.targets.iter();
    targets
        .map(|target| {
            let wished = target.world_from_torso;
            let root = motion.root_positions_m()[target.frame.idx()].as_dvec3();
            let at = wished.ground_m().as_dvec2();
            let position_m = (root.x - at.x).hypot(root.z - at.y);
            let heading_rad = f64::from(yaw_rad[target.frame.idx()]);
            let error_rad = heading_rad - f64::from(wished.heading_rad());
            let whole_turns = (error_rad / std::f64::consts::TAU).round();
            (position_m, (error_rad - whole_turns * std::f64::consts::TAU).abs())
        })
        .collect()
}

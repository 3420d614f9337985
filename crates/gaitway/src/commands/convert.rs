//! `gaitway convert`.

use motion_io::atomic_write::atomic_write;
use motion_io::bvh::{self, BvhWriteOptions};
use motion_io::diagnostic::Warnings;
use motion_io::import::{Report, read_motion_file};
use serde::Serialize;

use crate::args::{Convert, Unit};
use crate::output::{Console, Failure};
use crate::plan;

/// What `convert --json` says.
#[derive(Serialize)]
struct Converted {
    output: String,
    frames: usize,
    fps: f64,
    joints: usize,
    remarks: Vec<String>,
}

/// Reads a motion and writes it at another rate, unit or format.
pub(crate) fn run(console: &Console, args: &Convert) -> Result<(), Failure> {
    // Looked at first, so that a wrong ending does not cost a long read.
    plan::check_motion_output(&args.output)?;
    let metres_per_unit = match args.unit {
        Unit::M => 1.0,
        Unit::Cm => 0.01,
    };
    let mut warnings = Warnings::new();
    let mut options = plan::read_options(&args.reading)?;
    options.keep_tpose = args.keep_tpose;
    let file = read_motion_file(&args.input, &options, &mut warnings)?;
    console.warnings(&warnings);
    let fps = args.fps.unwrap_or(file.motion.fps());
    let motion = file.motion.resampled(fps);
    let options = BvhWriteOptions { metres_per_unit, ..BvhWriteOptions::default() };
    let text = bvh::write(&file.skeleton, &motion, &options);
    atomic_write(&args.output, text.as_bytes())?;

    let mut report = Report::default();
    file.facts.report(&args.input, fps, &mut report);
    let remarks: Vec<String> = report.lines().iter().map(ToString::to_string).collect();
    for remark in &remarks {
        console.note(remark);
    }
    let converted = Converted {
        output: args.output.display().to_string(),
        frames: motion.n_frames(),
        fps: fps.get(),
        joints: file.skeleton.n_joints(),
        remarks,
    };
    console.answer(&converted, || {
        let Converted { output, frames, fps, joints, .. } = &converted;
        format!("{output}: {frames} frames at {fps} per second, {joints} joints\n")
    })
}

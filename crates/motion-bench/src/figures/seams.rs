//! Whether seams can be told from what the clips do anyway.

use motion_bench::stopwatch::timed;
use motion_core::measure::seams::{natural_peak_m_s2, seam_peaks_m_s2};

use super::Bench;
use super::quantile::quantile;
use super::runs::{Made, N_WRITTEN, add};
use crate::table::Row;

/// The quantile of uncut windows that a natural seam stays under.
const NATURAL: f64 = 0.995;

/// The share of seams of the motions that a solve writes whose largest joint acceleration is no
/// higher than that of nearly all uncut windows.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let library = bench.library()?;
    let runs = bench.runs()?;
    let skeleton = library.clips().skeleton();
    let peaks_of = |made: &Made| -> Vec<f64> {
        let seams = made.assembled.starts.get(1..).unwrap_or_default();
        let peaks = seam_peaks_m_s2(skeleton, &made.assembled.motion, seams);
        peaks.into_iter().map(f64::from).collect()
    };
    let ((limit, peaks, of_best), measuring) = timed(|| {
        let limit = f64::from(natural_peak_m_s2(library.clips(), NATURAL));
        let written = runs.runs.iter().flat_map(|run| run.motions.iter().take(N_WRITTEN));
        let best = runs.runs.iter().filter_map(|run| run.motions.first());
        let peaks: Vec<f64> = written.flat_map(peaks_of).collect();
        let of_best: Vec<f64> = best.flat_map(peaks_of).collect();
        (limit, peaks, of_best)
    });
    let natural = |peaks: &[f64]| {
        100.0 * peaks.iter().filter(|&&peak| peak <= limit).count() as f64 / peaks.len() as f64
    };
    let mut spent = runs.finishing;
    add(&mut spent, measuring);
    let share = natural(&peaks);
    Ok(vec![Row {
        figure: "seams no rougher than uncut motion".to_owned(),
        target: "95 %",
        measured: format!("{share:.1} %"),
        is_met: share >= 95.0,
        spent,
        notes: vec![format!(
            "{} seams of the {N_WRITTEN} best of each run, limit {limit:.0} m/s², 95th percentile \
             {:.0}, worst {:.0}; of the best alone {:.1} % of {}",
            peaks.len(),
            quantile(&peaks, 0.95),
            quantile(&peaks, 1.0),
            natural(&of_best),
            of_best.len()
        )],
    }])
}

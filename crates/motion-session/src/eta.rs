//! How much longer a job takes, from how fast it goes.

/// Seconds in which an estimate takes up most of what is newly measured.
const SMOOTHING_SECS: f64 = 3.0;
/// So long a stage must have been under way before its rate is believed, seconds.
const MIN_MEASURED_SECS: f64 = 0.5;
/// So much of the whole must have been done in a stage before its rate is believed.
const MIN_MEASURED_SHARE: f64 = 0.005;

/// Estimates the rest of a job from the rate of its present stage.
///
/// Between measurements the estimate falls as time passes; what is measured draws it near, within
/// some seconds rather than at once, so that a number on a screen does not jump. Until a rate is
/// known there is none.
#[derive(Clone, Debug, Default)]
pub struct EtaEstimator {
    stage: String,
    /// When the stage began, and the share that was done then.
    began: (f64, f64),
    /// When there last was an estimate, and which.
    last: Option<(f64, f64)>,
}

impl EtaEstimator {
    /// The seconds that are left, when `share` of the whole (0 to 1) is done `now_secs` after some
    /// beginning.
    pub fn update(&mut self, stage: &str, share: f64, now_secs: f64) -> Option<f64> {
        if self.stage != stage {
            stage.clone_into(&mut self.stage);
            self.began = (now_secs, share);
        }
        let (began_secs, began_share) = self.began;
        let (secs, done) = (now_secs - began_secs, share - began_share);
        let is_known = secs >= MIN_MEASURED_SECS && done >= MIN_MEASURED_SHARE;
        let measured = is_known.then(|| (1.0 - share).max(0.0) * secs / done);
        let foreseen = self.last.map(|(at, eta)| (now_secs - at, eta - (now_secs - at)));
        let eta = match (foreseen, measured) {
            (Some((since, foreseen)), Some(measured)) => {
                let weight = 1.0 - (-since.max(0.0) / SMOOTHING_SECS).exp();
                Some((foreseen + weight * (measured - foreseen)).max(0.0))
            }
            (None, measured) => measured,
            // What was foreseen is over and it still goes on: nothing is known.
            (Some((_, foreseen)), None) => (foreseen > 0.0).then_some(foreseen),
        };
        self.last = eta.map(|eta| (now_secs, eta));
        eta
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_steady_job_is_foreseen_to_the_second() {
        let mut eta = EtaEstimator::default();
        assert_eq!(eta.update("a", 0.0, 0.0), None);
        assert_eq!(eta.update("a", 0.01, 0.4), None, "too early");
        for tick in 5..=400 {
            let now = f64::from(tick) / 10.0;
            let left = eta.update("a", now / 40.0, now).unwrap();
            assert!((left - (40.0 - now)).abs() < 1e-6, "{left} after {now} s");
        }
    }

    #[test]
    fn it_does_not_jump_where_the_rate_does() {
        let mut eta = EtaEstimator::default();
        let (mut share, mut last): (f64, Option<f64>) = (0.0, None);
        for tick in 0..600 {
            let now = f64::from(tick) / 10.0;
            // Twice as fast, ten times slower, stalled, and another stage.
            let (stage, rate) = match tick {
                0..100 => ("a", 0.01),
                100..200 => ("a", 0.02),
                200..400 => ("b", 0.002),
                400..450 => ("c", 0.0),
                _ => ("c", 0.02),
            };
            share += rate / 10.0;
            let now_eta = eta.update(stage, share, now);
            if let (Some(last), Some(eta)) = (last, now_eta) {
                // A tenth of a second of smoothing, of estimates of at most some minutes.
                assert!((eta - last).abs() < 15.0, "from {last} to {eta} at {now} s");
            }
            last = now_eta;
        }
    }

    #[test]
    fn what_takes_longer_than_foreseen_is_not_known() {
        let mut eta = EtaEstimator::default();
        eta.update("a", 0.0, 0.0);
        let left = eta.update("a", 0.75, 9.0).unwrap();
        assert!((left - 3.0).abs() < 1e-9, "{left}");
        assert!(eta.update("b", 0.75, 11.5).is_some_and(|left| (left - 0.5).abs() < 1e-9));
        assert_eq!(eta.update("b", 0.75, 13.0), None);
    }
}

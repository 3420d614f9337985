//! What a library can do and what it cannot, as a program prints it and a window shows it.

use std::fmt::Write as _;

use motion_core::coverage::{Coverage, SpeedClass, TurnClass};
use serde::Serialize;

use crate::Library;

/// The answer of `library coverage`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CoverageReport {
    /// Version of this document.
    pub gaitway: u32,
    /// How many clips.
    pub clips: usize,
    /// How long they are together, seconds.
    pub seconds: f64,
    /// Half of the time bodies travel slower than this, metres per second.
    pub median_speed_m_s: f32,
    /// The fastest that is kept up for half a second, metres per second.
    pub fastest_m_s: f32,
    /// The fastest turn to the right, degrees per second.
    pub fastest_right_turn_deg_s: f32,
    /// The fastest turn to the left, degrees per second.
    pub fastest_left_turn_deg_s: f32,
    /// Every speed with every turn.
    pub speeds_and_turns: Vec<CellReport>,
    /// Tags found in the motions; none for a body whose legs are not known.
    pub tags: Vec<TagReport>,
    /// Heights; `None` for a body whose legs are not known.
    pub heights: Option<HeightReport>,
    /// Clips in each strongly connected part, by τ alone, the main part first.
    pub parts_by_tau: Vec<usize>,
    /// The same with bridges.
    pub parts: Vec<usize>,
    /// Frames from which the main part cannot be reached any more.
    pub dead_end_frames: u32,
    /// Where those begin, clip by clip.
    pub dead_ends: Vec<DeadEndReport>,
    /// Clips that only bridges join to the main part.
    pub on_bridges: Vec<String>,
    /// What is missing and what to record, the most useful first.
    pub capture_list: Vec<String>,
}

/// What there is of a speed with a turn.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CellReport {
    /// `standing`, `slow`, `walking`, `jogging` or `running`.
    pub speed: &'static str,
    /// From this speed on, metres per second.
    pub from_m_s: f32,
    /// `sharp right`, `right`, `straight`, `left` or `sharp left`.
    pub turn: &'static str,
    /// How long, seconds.
    pub seconds: f64,
    /// Whether that is as good as nothing.
    pub empty: bool,
}

/// What there is of a tag.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TagReport {
    /// The tag.
    pub tag: &'static str,
    /// How long, seconds.
    pub seconds: f64,
    /// In how many clips.
    pub clips: usize,
}

/// How high and how low bodies get, metres.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HeightReport {
    /// Half of the time the hips are higher than this.
    pub usual_hips_m: f32,
    /// The lowest hips (1st percentile).
    pub lowest_hips_m: f32,
    /// The highest thing that is stood on.
    pub highest_support_m: f32,
    /// Jumps, the highest first.
    pub jumps: Vec<JumpReport>,
}

/// A jump.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JumpReport {
    /// The clip.
    pub clip: String,
    /// The frame at which the hips are highest.
    pub frame: u32,
    /// How much higher they are than usual, metres.
    pub rise_m: f32,
}

/// A clip that leads nowhere from some frame on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DeadEndReport {
    /// The clip.
    pub clip: String,
    /// The first frame from which the main part cannot be reached.
    pub from: u32,
    /// How many frames that are.
    pub frames: u32,
    /// The same as `from` without bridges.
    pub from_by_tau: u32,
}

impl CoverageReport {
    /// The coverage of a library; some milliseconds per thousand frames.
    pub fn new(library: &Library) -> Self {
        let coverage = Coverage::new(&library.clips, &library.graph);
        let travel = &coverage.travel;
        let [right, left] = travel.fastest_turns_rad_s.map(f32::to_degrees);
        let cells = travel.cells.iter().map(|cell| CellReport {
            speed: cell.speed.name(),
            from_m_s: cell.speed.from_m_s(),
            turn: cell.turn.name(),
            seconds: cell.secs,
            empty: cell.is_empty(),
        });
        let tags = coverage.tags.iter().filter(|_| coverage.has_legs);
        let heights = coverage.has_legs.then(|| HeightReport {
            usual_hips_m: coverage.heights.usual_hips_m,
            lowest_hips_m: coverage.heights.lowest_hips_m,
            highest_support_m: coverage.heights.highest_support_m,
            jumps: coverage
                .heights
                .jumps
                .iter()
                .map(|jump| JumpReport {
                    clip: jump.clip.clone(),
                    frame: jump.apex.0,
                    rise_m: jump.rise_m,
                })
                .collect(),
        });
        let ways = &coverage.ways;
        let dead_ends = ways.clips.iter().filter(|ways| ways.n_dead() > 0);
        let on_bridges = ways.clips.iter().filter(|ways| ways.hangs_on_bridges());
        Self {
            gaitway: 1,
            clips: coverage.n_clips,
            seconds: coverage.secs,
            median_speed_m_s: travel.median_m_s,
            fastest_m_s: travel.fastest_m_s,
            fastest_right_turn_deg_s: right,
            fastest_left_turn_deg_s: left,
            speeds_and_turns: cells.collect(),
            tags: tags
                .map(|cover| TagReport {
                    tag: cover.tag,
                    seconds: cover.secs,
                    clips: cover.n_clips,
                })
                .collect(),
            heights,
            parts_by_tau: ways.by_tau.sizes.clone(),
            parts: ways.with_bridges.sizes.clone(),
            dead_end_frames: ways.n_dead(),
            dead_ends: dead_ends
                .map(|ways| DeadEndReport {
                    clip: ways.clip.clone(),
                    from: ways.dead_from,
                    frames: ways.n_dead(),
                    from_by_tau: ways.dead_from_by_tau,
                })
                .collect(),
            on_bridges: on_bridges.map(|ways| ways.clip.clone()).collect(),
            capture_list: coverage.missing.iter().map(ToString::to_string).collect(),
        }
    }

    /// How long of a speed with a turn, seconds.
    pub fn secs(&self, speed: SpeedClass, turn: TurnClass) -> f64 {
        let is = |cell: &&CellReport| cell.speed == speed.name() && cell.turn == turn.name();
        self.speeds_and_turns.iter().find(is).map_or(0.0, |cell| cell.seconds)
    }

    /// Heights in one sentence.
    pub fn heights_text(&self) -> String {
        let Some(heights) = &self.heights else {
            return "not known: the body has no legs that were recognised".to_owned();
        };
        let jumps = match heights.jumps.first() {
            Some(highest) => format!(
                "{} jumps, the highest by {:.2} m ({}, frame {})",
                heights.jumps.len(),
                highest.rise_m,
                highest.clip,
                highest.frame
            ),
            None => "no jump".to_owned(),
        };
        let support = match heights.highest_support_m {
            // Floors are within some centimetres of level 0.
            level if level < 0.05 => "all on the floor".to_owned(),
            level => format!("stands on things up to {level:.2} m high"),
        };
        format!(
            "hips usually at {:.2} m, lowest {:.2} m; {jumps}; {support}",
            heights.usual_hips_m, heights.lowest_hips_m
        )
    }

    /// What hangs together, in one sentence.
    pub fn parts_text(&self) -> String {
        let largest = self.parts_by_tau.first().copied().unwrap_or_default();
        format!(
            "{} by τ alone ({largest} clips in the main one), {} with bridges; {} frames lead nowhere",
            self.parts_by_tau.len(),
            self.parts.len(),
            self.dead_end_frames
        )
    }

    /// The whole for people.
    pub fn text(&self) -> String {
        let mut out = String::new();
        let mut line = |name: &str, value: String| {
            // Writing to a string cannot fail.
            let _ok = writeln!(out, "{name:<18} {value}");
        };
        line("clips", format!("{}, {:.1} minutes", self.clips, self.seconds / 60.0));
        line(
            "speed",
            format!(
                "half below {:.2} m/s, up to {:.2} m/s",
                self.median_speed_m_s, self.fastest_m_s
            ),
        );
        line(
            "turns",
            format!(
                "up to {:.0}°/s to the left, {:.0}°/s to the right",
                self.fastest_left_turn_deg_s, self.fastest_right_turn_deg_s
            ),
        );
        line("heights", self.heights_text());
        line("parts", self.parts_text());
        let _ok = writeln!(out, "\n{:<18}{}", "seconds", header());
        for speed in SpeedClass::ALL {
            let cells =
                TurnClass::ALL.map(|turn| format!("{:>13}", cell_text(self.secs(speed, turn))));
            let _ok = writeln!(out, "{:<18}{}", speed.name(), cells.concat());
        }
        if !self.tags.is_empty() {
            let _ok = writeln!(out, "\n{:<18}{:>13}{:>13}", "tag", "seconds", "clips");
            for tag in &self.tags {
                let _ok = writeln!(out, "{:<18}{:>13.1}{:>13}", tag.tag, tag.seconds, tag.clips);
            }
        }
        if !self.capture_list.is_empty() {
            let _ok = writeln!(out, "\nto record");
            for wish in &self.capture_list {
                let _ok = writeln!(out, "* {wish}");
            }
        }
        out
    }
}

fn header() -> String {
    TurnClass::ALL.map(|turn| format!("{:>13}", turn.name())).concat()
}

/// Seconds, or a dash where there is as good as nothing.
pub fn cell_text(secs: f64) -> String {
    if secs < motion_core::coverage::EMPTY_SECS { "–".to_owned() } else { format!("{secs:.1}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::library;

    #[test]
    fn the_text_says_what_the_document_says() {
        let report = CoverageReport::new(&library());
        let text = report.text();
        for wish in &report.capture_list {
            assert!(text.contains(wish.as_str()), "{wish}");
        }
        assert!(text.contains("no run: record"), "{text}");
        assert!(text.contains("walking") && text.contains("sharp left"), "{text}");
        assert_eq!(report.speeds_and_turns.len(), 25);
        assert_eq!(report.tags.len(), 10);
    }
}

//! `report.json` and `timing.json`: what `solve` tells about its motions.
//!
//! Wall-clock figures are left out of a report made with an iteration budget, so that it is the
//! same bytes every time; they go to [`Timing`] instead.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::atomic_write::atomic_write;
use crate::diagnostic::FileError;
use crate::json::to_pretty;

/// The version that is written.
pub const FORMAT_VERSION: u32 = 1;

/// What `solve` writes to `report.json`. Metres, degrees, frames, seconds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The format's version.
    pub gaitway: u32,
    /// The project's name.
    pub project: String,
    /// The seed of all chance.
    pub seed: u64,
    /// Iterations of the search, all characters together.
    pub iterations: u64,
    /// How long the search took.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
    /// What was searched.
    pub library: LibraryFigures,
    /// In the project's order.
    pub characters: Vec<CharacterReport>,
    /// Where there are several characters: the alternatives of each rank together, best first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub together: Vec<TogetherReport>,
}

/// The motions of one rank, which belong together.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TogetherReport {
    /// From 1, the best.
    pub rank: u32,
    /// The sum of the motions' scores.
    pub score: f64,
    /// Where they interact, in the project's order.
    pub interactions: Vec<InteractionReport>,
}

/// Where an interaction is: what its members' relative places are relative to.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct InteractionReport {
    /// The interaction's id.
    pub interaction: String,
    /// When.
    pub frame: u32,
    /// `[x, z]`, metres.
    #[serde(rename = "position")]
    pub position_m: [f64; 2],
    /// 0 is +Z, 90 is +X.
    #[serde(rename = "heading")]
    pub heading_deg: f64,
}

/// The size of a library.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LibraryFigures {
    /// Clips in use.
    pub clips: u64,
    /// Frames of them.
    pub frames: u64,
    /// Leaf edges between them.
    pub edges: u64,
    /// Edges of the coarsest level.
    pub coarse_edges: u64,
    /// Strongly connected components.
    pub components: u64,
}

/// What was found for a character.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CharacterReport {
    /// The character's name.
    pub name: String,
    /// The first path within every tolerance before correction, if there was one.
    #[serde(default)]
    pub first_acceptable: Option<FirstAcceptable>,
    /// Best first.
    pub alternatives: Vec<AlternativeReport>,
    /// How the best score fell.
    pub trace: Vec<TracePoint>,
    /// Sentences for a person: what could not be met, and why.
    pub unmet: Vec<String>,
    /// Where something was not met: the smallest changes that would meet it, each tried.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub suggestions: Vec<SuggestionReport>,
}

/// A change of what is asked, and what it would bring.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SuggestionReport {
    /// The kind of change: `length`, `place`, `time`, `tolerance`, `pose`, `style` or `palette`.
    pub change: String,
    /// What to do and what that brings, for a person.
    pub sentence: String,
    /// The best score as it is asked.
    pub score_before: f64,
    /// The best score of a short search for what would be asked.
    pub score_after: f64,
}

/// When the first acceptable path was found.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FirstAcceptable {
    /// Seconds since the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub s: Option<f64>,
    /// The iteration that found it.
    pub iteration: u64,
}

/// A motion that was found.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AlternativeReport {
    /// From 1, the best.
    pub rank: u32,
    /// The sum of the terms.
    pub score: f64,
    /// The score's parts, in units of one tolerance squared.
    pub terms: Terms,
    /// Frames of the motion.
    pub frames: u32,
    /// What is shown, in order.
    pub pieces: Vec<PieceReport>,
    /// Where one piece goes over into the next.
    pub seams: Vec<SeamReport>,
    /// How the constraints were met before correction.
    pub raw: Vec<ConstraintReport>,
    /// And after it.
    #[serde(rename = "final")]
    pub final_: Vec<ConstraintReport>,
    /// Figures as `measure` gives them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quality: Option<QualityReport>,
    /// Seconds from the start until it was found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub found_at_s: Option<f64>,
    /// The files of the motion, beside the report.
    pub files: Vec<String>,
}

/// The parts of a score.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Terms {
    /// Cost of the cuts.
    pub continuity: f64,
    /// Distance from the wanted length.
    pub length: f64,
    /// Body constraints.
    pub body: f64,
    /// Joint constraints.
    pub joint: f64,
    /// Style constraints.
    pub style: f64,
    /// Followed curves.
    pub path: f64,
    /// Obstacles, other bodies and level ground.
    pub environment: f64,
}

/// Frames of a clip, both ends shown.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PieceReport {
    /// The clip's id.
    pub clip: String,
    /// The first frame of the clip.
    pub from: u32,
    /// The last frame of the clip.
    pub to: u32,
}

/// A cut.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SeamReport {
    /// The first frame of the new piece, in the motion.
    pub frame: u32,
    /// The level of the hierarchy at which the edge was chosen.
    pub level: u32,
    /// Whether that is the finest.
    pub leaf: bool,
    /// The edge's cost.
    pub cost: f64,
    /// Whether the edge joins parts that the threshold alone leaves apart.
    pub bridge: bool,
}

/// How a constraint was met.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ConstraintReport {
    /// The constraint's id.
    pub constraint: String,
    /// Its kind: `body`, `joint`, `pose`, `lock`, `style`, `path`; or `obstacles`, all together.
    pub kind: String,
    /// Whether a pose or a locked stretch is shown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub met: Option<bool>,
    /// Mean distance of the joints from a pose where it is taken; of a finished motion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose_error_m: Option<f64>,
    /// Distance from the wanted place; of a followed curve the root of the mean square.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position_error_m: Option<f64>,
    /// Turn from the wanted heading, where one is wanted; of a followed curve the root of the mean
    /// square.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heading_error_deg: Option<f64>,
    /// Difference from the wanted velocity, of a joint that is to have one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity_error_m_s: Option<f64>,
    /// How many frames late (positive) or early it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame_error: Option<i64>,
    /// The share of a style's frames that do not have its tag, 0 to 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub share_without: Option<f64>,
    /// How deep any joint ever is within an obstacle or the 0.10 m around it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub deepest_m: Option<f64>,
}

/// Figures of a motion's quality, as `measure` prints them; `measure --explain` defines each.
/// `null` where a motion has no occasion for a figure (slide without plants).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct QualityReport {
    /// Mean horizontal speed of a foot joint while it is planted.
    pub foot_slide_cm_per_s: Option<f64>,
    /// Largest drift within one plant.
    pub foot_slide_max_cm: Option<f64>,
    /// Mean speed while the source clips say that the foot is planted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub foot_slide_carried_cm_per_s: Option<f64>,
    /// Foot slide of the source clips themselves, to judge the motion's by.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source_foot_slide_cm_per_s: Option<f64>,
    /// How deep a sole sinks below its support.
    pub ground_penetration_max_cm: Option<f64>,
    /// How far a planted sole floats above its support.
    pub float_max_cm: Option<f64>,
    /// Share of frames with a low toe faster than 0.5 m/s.
    pub skate_ratio: Option<f64>,
    /// The same at 0.2 m/s.
    pub skate_ratio_kimodo: Option<f64>,
    /// Mean speed of low toes.
    pub toe_speed_below_5cm_m_s: Option<f64>,
    /// Fastest joint.
    pub joint_speed_max_m_s: f64,
    /// 99th percentile of joint acceleration.
    pub joint_acceleration_p99_m_s2: f64,
    /// 99th percentile of joint jerk.
    pub joint_jerk_p99_m_s3: f64,
    /// Largest change of a joint's rotation between neighbouring frames.
    pub rotation_step_max_deg: f64,
    /// Length of the root's way over the ground.
    pub travel_m: f64,
    /// Turn of the heading from the first to the last frame, whole turns counted.
    pub turn_deg: f64,
}

/// What `measure` says of a motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeasureReport {
    /// Frames of the motion.
    pub frames: u64,
    /// Frames per second.
    pub fps: f64,
    /// The body: its number of joints and its root.
    pub skeleton: String,
    /// The figures.
    #[serde(flatten)]
    pub quality: QualityReport,
}

/// A point of the search's course.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TracePoint {
    /// Seconds since the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub s: Option<f64>,
    /// The iteration.
    pub iteration: u64,
    /// The best score so far.
    pub best: f64,
    /// Distinct alternatives so far.
    pub alternatives: u32,
}

/// What `solve --iterations` writes to `timing.json`: the wall-clock figures, and nothing else.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// The format's version.
    pub gaitway: u32,
    /// How long the search took.
    pub seconds: f64,
    /// In the project's order.
    pub characters: Vec<CharacterTiming>,
}

/// The wall-clock figures of a character, lists in the order of the report's.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CharacterTiming {
    /// The character's name.
    pub name: String,
    /// Until the first acceptable path.
    #[serde(default)]
    pub first_acceptable_s: Option<f64>,
    /// Until each alternative was found.
    pub found_at_s: Vec<Option<f64>>,
    /// At each point of the trace.
    pub trace_s: Vec<Option<f64>>,
}

impl Report {
    /// Takes the wall-clock figures out of the report, for the reproducible form.
    pub fn take_timing(&mut self) -> Timing {
        let characters = self.characters.iter_mut().map(|character| CharacterTiming {
            name: character.name.clone(),
            first_acceptable_s: character.first_acceptable.as_mut().and_then(|f| f.s.take()),
            found_at_s: character.alternatives.iter_mut().map(|a| a.found_at_s.take()).collect(),
            trace_s: character.trace.iter_mut().map(|t| t.s.take()).collect(),
        });
        let characters = characters.collect();
        Timing {
            gaitway: self.gaitway,
            seconds: self.seconds.take().unwrap_or_default(),
            characters,
        }
    }
}

/// The text of a report, a timing, or anything else that `--json` prints.
///
/// Numbers that are not finite become `null`, since JSON has none. Fails only for values that
/// JSON cannot hold, such as maps whose keys are no texts.
pub fn to_json(value: &impl Serialize) -> Result<String, serde_json::Error> {
    serde_json::to_value(value).map(|value| to_pretty(&value))
}

/// Writes a report or a timing to `path`, whole or not at all.
pub fn save(value: &impl Serialize, path: &Path) -> Result<(), FileError> {
    let text = to_json(value).map_err(|error| {
        FileError::new(path, format!("the report cannot be written ({error})"), "report this")
    })?;
    atomic_write(path, text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Report {
        Report {
            gaitway: FORMAT_VERSION,
            project: "p".to_owned(),
            seed: 1,
            iterations: 812,
            seconds: Some(5.0),
            library: LibraryFigures { clips: 80, frames: 19_874, ..LibraryFigures::default() },
            together: Vec::new(),
            characters: vec![CharacterReport {
                name: "A".to_owned(),
                first_acceptable: Some(FirstAcceptable { s: Some(0.004), iteration: 2 }),
                alternatives: vec![AlternativeReport {
                    rank: 1,
                    score: 0.83,
                    raw: vec![ConstraintReport {
                        constraint: "body-1".to_owned(),
                        kind: "body".to_owned(),
                        position_error_m: Some(0.11),
                        heading_error_deg: Some(3.2),
                        frame_error: Some(-1),
                        ..ConstraintReport::default()
                    }],
                    found_at_s: Some(0.21),
                    files: vec!["A-1.bvh".to_owned()],
                    ..AlternativeReport::default()
                }],
                trace: vec![TracePoint { s: Some(0.1), iteration: 1, best: 41.0, alternatives: 0 }],
                unmet: Vec::new(),
                suggestions: Vec::new(),
            }],
        }
    }

    #[test]
    fn the_names_are_those_of_the_contract() {
        let text = to_json(&sample()).unwrap();
        for name in [
            "\"gaitway\": 1",
            "\"first_acceptable\": {\"s\": 0.004, \"iteration\": 2}",
            "\"terms\": {",
            "\"raw\": [",
            "\"final\": []",
            "\"frame_error\": -1",
            "\"found_at_s\": 0.21",
            "\"trace\": [{\"s\": 0.1, \"iteration\": 1, \"best\": 41.0, \"alternatives\": 0}]",
            "\"unmet\": []",
        ] {
            assert!(text.contains(name), "{name} is not in {text}");
        }
        assert_eq!(serde_json::from_str::<Report>(&text).unwrap(), sample());
    }

    #[test]
    fn timing_leaves_the_report() {
        let mut report = sample();
        let timing = report.take_timing();
        let text = to_json(&report).unwrap();
        for name in ["\"s\"", "seconds", "found_at_s"] {
            assert!(!text.contains(name), "{name} is in {text}");
        }
        assert_eq!(timing.seconds, 5.0);
        assert_eq!(timing.characters[0].first_acceptable_s, Some(0.004));
        assert_eq!(timing.characters[0].found_at_s, [Some(0.21)]);
        assert_eq!(timing.characters[0].trace_s, [Some(0.1)]);
    }
}

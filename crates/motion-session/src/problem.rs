//! What a project means for a library: one search problem for each character, and sentences on
//! what this version leaves out.

use std::path::Path;

use glam::{DVec3, Vec2};
use motion_core::constraint::{
    BodyConstraint, JointConstraint, LengthMode, LengthWish, PoseConstraint, TOLERANCE_M, Tolerance,
};
use motion_core::score::{Weights, Wishes};
use motion_core::search::Problem;
use motion_core::tags::whole_tags;
use motion_core::units::FrameIdx;
use motion_io::diagnostic::FileError;
use motion_io::project_file::{self, Character, Constraint, ConstraintKind, Project};

use crate::Library;
use crate::palette::Matcher;

/// One character's problem, with what the report needs to speak of it.
#[derive(Clone, Debug, PartialEq)]
pub struct CharacterProblem {
    /// The character's name, fit for a file name.
    pub name: String,
    /// What is searched.
    pub problem: Problem,
    /// Ids of the body constraints, in the problem's order.
    pub body_ids: Vec<String>,
    /// Joints that are to be somewhere, by their constraints' ids. The search does not consider
    /// them; how far off they are is measured.
    pub joints: Vec<(String, JointConstraint)>,
    /// Poses that are to be taken, likewise.
    pub poses: Vec<(String, PlacedPose)>,
    /// Sentences on what the project asks and this version does not meet.
    pub left_out: Vec<String>,
}

/// A pose, and where it is to be taken if that is said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedPose {
    /// Which pose, and when.
    pub pose: PoseConstraint,
    /// Where the torso's frame is to be, metres along X and Z.
    pub ground_m: Option<Vec2>,
    /// Which way it is to face.
    pub heading_rad: Option<f32>,
}

/// The problem of `character`. Errors name `project_path`.
pub fn problem_of(
    project: &Project,
    character: &Character,
    library: &Library,
    bridges: bool,
    project_path: &Path,
) -> Result<CharacterProblem, FileError> {
    let mut left_out = Vec::new();
    let mut body: Vec<(String, BodyConstraint, bool)> = Vec::new();
    for constraint in &character.constraints {
        match body_constraint(constraint) {
            Some((wish, closed)) => body.push((constraint.id.clone(), wish, !closed)),
            None => left_out.push(format!(
                "{} constraint {:?} was not considered: this version meets body constraints and \
                 lengths only",
                constraint.kind.name(),
                constraint.id
            )),
        }
        if constraint.tolerance.is_some() {
            left_out.push(format!(
                "the tolerance of constraint {:?} was not considered: 10 frames, 0.30 m and 10° \
                 count alike",
                constraint.id
            ));
        }
    }
    body.sort_by_key(|(_, wish, _)| wish.frame);
    let open: Vec<bool> = body.iter().map(|(_, _, open)| *open).collect();
    let mut body: Vec<_> = body.into_iter().map(|(id, wish, _)| (id, wish)).collect();
    close_headings(&mut body, &open, &mut left_out);
    let (body_ids, body) = body.into_iter().unzip();
    let allowed_clips = allowed_clips(project, library, project_path)?;
    let wishes = Wishes {
        length: character.length.as_ref().and_then(length_wish),
        body,
        weights: weights(project, &mut left_out),
        ..Wishes::default()
    };
    let (joints, poses) = measured(character, library, &mut left_out);
    let problem = Problem { wishes, allowed_clips, bridges };
    problem.check().map_err(|error| {
        let text = error.to_string();
        let (what, what_to_do) = text.split_once("; ").unwrap_or((&text, "correct the project"));
        let what = format!("character {:?}: {what}", character.name);
        FileError::new(project_path, what, what_to_do)
    })?;
    let name = character.name.clone();
    Ok(CharacterProblem { name, problem, body_ids, joints, poses, left_out })
}

/// Joints and poses that are asked for, as far as body and library have them.
#[expect(clippy::type_complexity, reason = "two lists for two fields, used once")]
fn measured(
    character: &Character,
    library: &Library,
    left_out: &mut Vec<String>,
) -> (Vec<(String, JointConstraint)>, Vec<(String, PlacedPose)>) {
    let (mut joints, mut poses) = (Vec::new(), Vec::new());
    for Constraint { id, kind, weight, .. } in &character.constraints {
        match kind {
            ConstraintKind::Joint { frame, joint, position_m, velocity_m_s } => {
                let Some(joint) = library.clips.skeleton().find(joint) else {
                    left_out.push(format!(
                        "joint constraint {id:?} speaks of {joint:?}, which this body does not have"
                    ));
                    continue;
                };
                let vector = |metres: [f64; 3]| DVec3::from(metres).as_vec3();
                let wish = JointConstraint {
                    frame: *frame,
                    joint,
                    position_m: vector(*position_m),
                    velocity_m_s: velocity_m_s.map(vector),
                    weight: weight.unwrap_or(1.0) as f32,
                    tolerance_m: TOLERANCE_M,
                };
                joints.push((id.clone(), wish));
            }
            ConstraintKind::Pose { frame, clip, clip_frame, position_m, heading_deg, .. } => {
                let Some(clip) = library.clips.by_id(clip) else {
                    left_out.push(format!(
                        "pose constraint {id:?} is of clip {clip:?}, which is not in the library"
                    ));
                    continue;
                };
                let clip_frame = FrameIdx(*clip_frame);
                let pose = PoseConstraint::new(*frame, clip, clip_frame);
                let ground_m = position_m.map(|[x, z]| Vec2::new(x as f32, z as f32));
                let heading_rad = heading_deg.map(|deg| deg.to_radians() as f32);
                poses.push((id.clone(), PlacedPose { pose, ground_m, heading_rad }));
            }
            _ => {}
        }
    }
    (joints, poses)
}

/// Sentences on what the project as a whole asks and this version does not meet.
pub fn left_out_of_project(project: &Project) -> Vec<String> {
    let mut left_out = Vec::new();
    if !project.interactions.is_empty() {
        left_out.push(
            "interactions between characters were not considered: this version finds each \
             character's motion by itself"
                .to_owned(),
        );
    }
    if !project.obstacles.is_empty() {
        left_out.push("obstacles were not considered: this version walks through them".to_owned());
    }
    left_out
}

/// A body constraint as the search takes it, without a heading where the project leaves it open.
fn body_constraint(constraint: &Constraint) -> Option<(BodyConstraint, bool)> {
    let ConstraintKind::Body { frame, position_m: [x, z], heading_deg, height_m } = constraint.kind
    else {
        return None;
    };
    let wish = BodyConstraint {
        frame,
        position_m: Vec2::new(x as f32, z as f32),
        heading_rad: heading_deg.unwrap_or_default().to_radians() as f32,
        height_m: height_m.map(|height| height as f32),
        weight: constraint.weight.unwrap_or(1.0) as f32,
        tolerance: Tolerance::default(),
    };
    Some((wish, heading_deg.is_some()))
}

/// The heading of someone who walks from `a` to `b`; `None` where they are at one place.
fn heading_along_rad(a: &BodyConstraint, b: &BodyConstraint) -> Option<f32> {
    let way = b.position_m - a.position_m;
    (way.length() > 0.05).then(|| way.x.atan2(way.y))
}

/// Gives constraints whose heading is open that of the way to them (the first: of the way from
/// it), and says so.
fn close_headings(
    body: &mut [(String, BodyConstraint)],
    open: &[bool],
    left_out: &mut Vec<String>,
) {
    for nth in 0..body.len() {
        if !open[nth] {
            continue;
        }
        let (a, b) = if nth == 0 { (0, 1.min(body.len() - 1)) } else { (nth - 1, nth) };
        let heading_rad = heading_along_rad(&body[a].1, &body[b].1).unwrap_or_default();
        body[nth].1.heading_rad = heading_rad;
        left_out.push(format!(
            "body constraint {:?} leaves its heading open; the direction of the way was taken, {:.0}°",
            body[nth].0,
            heading_rad.to_degrees()
        ));
    }
}

fn length_wish(length: &project_file::Length) -> Option<LengthWish> {
    let mode = match length.mode {
        project_file::LengthMode::Free => LengthMode::Free,
        project_file::LengthMode::Preferred => LengthMode::Preferred,
        project_file::LengthMode::Exact => LengthMode::Exact,
    };
    let weight = length.weight.unwrap_or(1.0) as f32;
    length.frames.map(|frames| LengthWish { frames, mode, weight })
}

fn weights(project: &Project, left_out: &mut Vec<String>) -> Weights {
    let mut weights = Weights::default();
    for (name, value) in &project.search.weights {
        let value = *value as f32;
        match name.as_str() {
            "continuity" => weights.continuity = value,
            "length" => weights.length = value,
            "body" => weights.body = value,
            "environment" => weights.environment = value,
            _ => left_out.push(format!("the weight {name:?} was not considered")),
        }
    }
    weights
}

/// For each clip whether the palette has it.
fn allowed_clips(
    project: &Project,
    library: &Library,
    project_path: &Path,
) -> Result<Vec<bool>, FileError> {
    let clips = library.clips.clips();
    let by_hand = project.hand_tags();
    let Some(palette) = &project.palette else { return Ok(vec![true; clips.len()]) };
    let matcher = Matcher::new(Some(palette)).map_err(|error| {
        let what = format!("the palette has a pattern that is none ({error})");
        FileError::new(project_path, what, "use * for anything and ? for one character")
    })?;
    let allowed: Vec<bool> =
        clips.iter().map(|clip| matcher.has((&clip.id, &whole_tags(clip, &by_hand)))).collect();
    if !allowed.contains(&true) {
        return Err(FileError::new(
            project_path,
            format!("the palette leaves none of the library's {} clips", clips.len()),
            "include more or exclude less",
        ));
    }
    Ok(allowed)
}

#[cfg(test)]
mod tests {
    use motion_io::diagnostic::Warnings;

    use super::*;
    use crate::fixture::library;

    /// The problem of the first character of a project with these keys.
    fn problem(keys: &str, constraints: &str) -> Result<CharacterProblem, FileError> {
        let text = format!(
            "{{\"gaitway\": 1, \"name\": \"p\", \"fps\": 30, \"library\": \"builtin\", {keys}
              \"characters\": [{{\"name\": \"A\", \"constraints\": [{constraints}]}}]}}"
        );
        let path = Path::new("p.gaitway");
        let project = project_file::read(text.as_bytes(), path, &mut Warnings::new())?;
        problem_of(&project, &project.characters[0], &library(), true, path)
    }

    fn names_in_use(problem: &CharacterProblem) -> Vec<String> {
        let library = library();
        let clips = library.clips.clips().iter().zip(&problem.problem.allowed_clips);
        clips.filter(|(_, allowed)| **allowed).map(|(clip, _)| clip.id.clone()).collect()
    }

    #[test]
    fn a_palette_is_patterns_and_tags_and_has_mirror_images_along() {
        for (palette, expected) in [
            ("{\"include\": [\"walk*\"]}", "walk walk_late walk@mirror walk_late@mirror"),
            ("{\"include\": [\"WALK\"]}", "walk walk@mirror"),
            ("{\"include\": [\"????\"], \"exclude\": [\"*@mirror\"]}", "left slow walk"),
            ("{\"exclude\": [\"walk*\", \"left\"]}", "right slow right@mirror slow@mirror"),
            ("{\"tags\": [\"late\"]}", "walk_late walk_late@mirror"),
        ] {
            let found = problem(&format!("\"palette\": {palette},"), "").unwrap();
            assert_eq!(names_in_use(&found).join(" "), expected, "{palette}");
        }
    }

    #[test]
    fn constraints_come_in_the_order_of_their_frames_under_their_ids() {
        let found = problem(
            "",
            "{\"id\": \"b\", \"kind\": \"body\", \"frame\": 50, \"position\": [0, 4], \"heading\": 90},
             {\"id\": \"a\", \"kind\": \"body\", \"frame\": 10, \"position\": [0, 0], \"heading\": -90}",
        );
        let found = found.unwrap();
        assert_eq!(found.body_ids, ["a", "b"]);
        let headings: Vec<f32> =
            found.problem.wishes.body.iter().map(|wish| wish.heading_rad.to_degrees()).collect();
        assert_eq!(headings, [-90.0, 90.0], "degrees become radians");
        assert_eq!(found.left_out, [""; 0]);
    }

    #[test]
    fn an_open_heading_is_that_of_the_way() {
        let found = problem(
            "",
            "{\"id\": \"a\", \"kind\": \"body\", \"frame\": 0, \"position\": [0, 0]},
             {\"id\": \"b\", \"kind\": \"body\", \"frame\": 60, \"position\": [3, 0]}",
        );
        let found = found.unwrap();
        let body = &found.problem.wishes.body;
        assert!(body.iter().all(|wish| (wish.heading_rad.to_degrees() - 90.0).abs() < 1e-3));
        assert_eq!(
            found.left_out[1],
            "body constraint \"b\" leaves its heading open; the direction of the way was taken, 90°"
        );
    }

    #[test]
    fn weights_reach_the_search() {
        let found = problem("\"search\": {\"weights\": {\"body\": 2, \"joint\": 3}},", "").unwrap();
        assert_eq!(found.problem.wishes.weights.body, 2.0);
        assert_eq!(found.left_out, ["the weight \"joint\" was not considered"]);
    }
}

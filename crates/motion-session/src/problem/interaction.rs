//! Interactions: what several characters do together.

use std::path::Path;

use glam::Vec2;
use motion_core::cast::{CastError, Interaction, Member};
use motion_core::constraint::Tolerance;
use motion_core::planar::PlanarTransform;
use motion_core::search::Problem;
use motion_core::units::FrameIdx;
use motion_io::diagnostic::FileError;
use motion_io::project_file::{self, Project};

use super::CharacterProblem;
use crate::Library;

/// The project's interactions for these characters, which are the project's in its order, each with
/// its library. Errors name `project_path` and the interaction's id.
pub fn interactions_of(
    project: &Project,
    characters: &[(&CharacterProblem, &Library)],
    project_path: &Path,
) -> Result<Vec<Interaction>, FileError> {
    let wish = |asked| interaction(asked, characters, project_path);
    project.interactions.iter().map(wish).collect()
}

fn interaction(
    asked: &project_file::Interaction,
    characters: &[(&CharacterProblem, &Library)],
    project_path: &Path,
) -> Result<Interaction, FileError> {
    let refuse = |what: String, what_to_do: String| {
        FileError::new(project_path, format!("interaction {:?} {what}", asked.id), what_to_do)
    };
    if asked.members.len() != asked.relative.len() {
        let (members, places) = (asked.members.len(), asked.relative.len());
        let what = format!("has {places} relative places for {members} members");
        return Err(refuse(what, "give every member one place".to_owned()));
    }
    let mut members: Vec<Member> = Vec::with_capacity(asked.members.len());
    for (member, place) in asked.members.iter().zip(&asked.relative) {
        let name = &member.character;
        let known = characters.iter().position(|(character, _)| character.name == *name);
        let Some(character) = known else {
            let what = format!("is with {name:?}, whom the project does not have");
            return Err(refuse(what, "name one of its characters".to_owned()));
        };
        if members.iter().any(|m| m.character == character) {
            let what = format!("has {name:?} in it twice");
            return Err(refuse(what, "take one of the two out".to_owned()));
        }
        let (problem, library) = characters[character];
        let Some(clip) = library.clips.by_id(&member.clip) else {
            let what = format!("shows clip {:?}, which is not in the library", member.clip);
            let what_to_do = "import the clip, or choose one of the library's";
            return Err(refuse(what, what_to_do.to_owned()));
        };
        let last = library.clips.clip(clip).n_frames().saturating_sub(1);
        if member.clip_frame as usize > last {
            let (frame, clip) = (member.clip_frame, &member.clip);
            let what = format!("shows frame {frame} of clip {clip:?}, which ends at frame {last}");
            return Err(refuse(what, format!("choose a frame from 0 to {last}")));
        }
        if !problem.problem.allowed_clips[clip.idx()] {
            let what = format!("shows clip {:?}, which the palette leaves out", member.clip);
            return Err(refuse(what, "include the clip, or choose another".to_owned()));
        }
        let [x, z] = place.position_m.map(|metres| metres as f32);
        let heading_rad = place.heading_deg.to_radians() as f32;
        members.push(Member {
            character,
            clip,
            clip_frame: FrameIdx(member.clip_frame),
            interaction_from_torso: PlanarTransform::new(heading_rad, Vec2::new(x, z), 0.0),
        });
    }
    Ok(Interaction {
        frame: asked.frame,
        members,
        weight: asked.weight.unwrap_or(1.0) as f32,
        tolerance: Tolerance::default(),
    })
}

impl CharacterProblem {
    /// The character among others: `problem` is its own with the poses of its interactions after
    /// its own poses, in the project's order, and perhaps with the others on their ways.
    #[must_use]
    pub fn among_others(&self, problem: Problem, project: &Project) -> Self {
        let mut asked = Self { problem, ..self.clone() };
        let is_mine = |i: &&project_file::Interaction| {
            i.members.iter().any(|member| member.character == self.name)
        };
        let shared = project.interactions.iter().filter(is_mine);
        asked.ids.poses.extend(shared.map(|interaction| interaction.id.clone()));
        asked
    }
}

/// What the cast's refusal means for the project.
pub fn cast_refusal(
    error: &CastError,
    project: &Project,
    characters: &[&CharacterProblem],
    project_path: &Path,
) -> FileError {
    let of_interaction = |nth: usize, what: &str, what_to_do: &str| {
        let id = project.interactions.get(nth).map_or("", |interaction| &interaction.id);
        FileError::new(project_path, format!("interaction {id:?} {what}"), what_to_do)
    };
    match error {
        CastError::Character { character, error } => {
            let character = characters[*character];
            let asked = character.among_others(character.problem.clone(), project);
            asked.refusal(error).in_file(project_path)
        }
        CastError::NobodyThere { interaction } => of_interaction(
            *interaction,
            "is with somebody whom the project does not have",
            "name one of its characters",
        ),
        CastError::Twice { interaction } => {
            of_interaction(*interaction, "has a character in it twice", "take one of the two out")
        }
        CastError::NotFinite { interaction } => {
            of_interaction(*interaction, "has a place or weight that makes no sense", "correct it")
        }
        CastError::Libraries { .. } => {
            FileError::new(project_path, "has no characters".to_owned(), "add one")
        }
    }
}

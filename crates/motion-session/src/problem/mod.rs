//! What a project means for a library: one search problem for each character, and sentences on what
//! is odd in what is asked.
//!
//! Every kind of constraint has a file of its own here, which makes a wish of it. What cannot be asked
//! of this library is refused with the constraint's id and what to do.

mod allowed_clips;
mod asking;
mod body;
mod constraint_ids;
mod follow;
mod interaction;
mod joint;
mod length;
mod lock;
mod obstacle;
mod pose;
pub mod refusal;
mod style;
mod tolerance;
mod weights;

use std::path::Path;

use motion_core::score::Wishes;
use motion_core::search::Problem;
use motion_io::diagnostic::FileError;
use motion_io::project_file::{Character, ConstraintKind, Project};

use crate::Library;
use asking::Asking;
pub use constraint_ids::ConstraintIds;
pub use interaction::{cast_refusal, interactions_of};
pub use refusal::Refusal;
pub(crate) use style::has_tag;

/// One character's problem, with what the report needs to speak of it.
#[derive(Clone, Debug, PartialEq)]
pub struct CharacterProblem {
    /// The character's name, fit for a file name.
    pub name: String,
    /// What is searched.
    pub problem: Problem,
    /// What the project calls each wish.
    pub ids: ConstraintIds,
    /// Sentences on what is odd in what is asked, and what was made of it.
    pub remarks: Vec<String>,
}

/// The problem of `character`. Errors name `project_path`.
pub fn problem_of(
    project: &Project,
    character: &Character,
    library: &Library,
    bridges: bool,
    project_path: &Path,
) -> Result<CharacterProblem, FileError> {
    let allowed_clips = allowed_clips::allowed_clips(project, library, project_path)?;
    let by_hand = project.hand_tags();
    let mut asking = Asking::new(character, library, &allowed_clips, &by_hand, project_path);
    let (mut wishes, mut ids) = (Wishes::default(), ConstraintIds::default());
    for constraint in &character.constraints {
        let id = constraint.id.clone();
        match &constraint.kind {
            ConstraintKind::Body { .. } => {
                wishes.body.extend(body::wish(constraint));
                ids.body.push(id);
            }
            ConstraintKind::Joint { .. } => {
                wishes.joints.extend(joint::wish(constraint, &asking)?);
                ids.joints.push(id);
            }
            ConstraintKind::Pose { .. } => {
                wishes.poses.extend(pose::wish(constraint, &asking)?);
                ids.poses.push(id);
            }
            ConstraintKind::Style { .. } => {
                wishes.styles.extend(style::wish(constraint, &mut asking));
                ids.styles.push(id);
            }
            ConstraintKind::Path { .. } => {
                wishes.follows.extend(follow::wish(constraint, &asking)?);
                ids.follows.push(id);
            }
            ConstraintKind::Lock { .. } => {
                wishes.locks.extend(lock::wish(constraint, &asking)?);
                ids.locks.push(id);
            }
        }
    }
    body::sort(&mut wishes.body, &mut ids.body);
    body::close_first_heading(&mut wishes, &ids.body, &mut asking.remarks);
    wishes.length = character.length.as_ref().and_then(length::wish);
    wishes.obstacles = project.obstacles.iter().map(obstacle::wish).collect();
    wishes.weights = weights::weights(project, &mut asking.remarks);
    let remarks = asking.remarks;
    let name = character.name.clone();
    let problem = Problem { wishes, allowed_clips, bridges };
    let asked = CharacterProblem { name, problem, ids, remarks };
    asked.problem.check().map_err(|error| asked.refusal(&error).in_file(project_path))?;
    Ok(asked)
}

#[cfg(test)]
mod tests;

//! A solved project on the stage: each character in one of its motions.

use std::sync::Arc;

use motion_core::floor::{Soles, soles_of};
use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;
use motion_io::project_file::Project;
use motion_scene::body::Look;
use motion_scene::color::{ColorRole, Theme};
use motion_scene::mesh::MeshId;

use super::actor::Actor;
use super::figure::Figure;
use super::{Role, Stage};
use crate::project_job::Solved;

/// What a character of a project brings with it.
#[derive(Clone, Debug)]
pub struct Part {
    /// What the project calls it.
    pub name: String,
    /// The library's skeleton.
    pub skeleton: Arc<Skeleton>,
    /// The motion that was chosen.
    pub motion: Arc<Motion>,
    /// How high the library's bodies have their toe joints when they stand.
    pub soles: Soles,
}

/// Why there is nobody to be seen.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NobodyError {
    /// No motion was found at all.
    #[error("no motion was found for {0}")]
    NoMotion(String),
    /// Fewer motions than asked for.
    #[error("there are {found} motions for {name}; ask for one of them")]
    NoTake {
        /// Whose.
        name: String,
        /// How many there are.
        found: usize,
    },
}

/// The parts of a solved project's characters, each in its motion number `take` (from 0, the best).
pub fn parts(solved: &Solved, take: usize) -> Result<Vec<Part>, NobodyError> {
    let characters = solved.report.characters.iter().zip(&solved.characters);
    characters
        .map(|(report, character)| {
            let name = report.name.clone();
            let found = character.motions.len();
            let Some(motion) = character.motions.get(take) else {
                return Err(match found {
                    0 => NobodyError::NoMotion(name),
                    _ => NobodyError::NoTake { name, found },
                });
            };
            let set = &character.library.clips;
            let clips = set.clips().iter().map(|clip| (&clip.motion, &clip.track));
            Ok(Part {
                name,
                skeleton: Arc::new(set.skeleton().clone()),
                motion: Arc::new(motion.clone()),
                soles: soles_of(set.skeleton(), clips),
            })
        })
        .collect()
}

/// The stage of a project whose characters were made actors in their motions number `take`: with
/// obstacles, constraints, and what the motions make of them.
pub fn stage_of_project(
    project: &Project,
    solved: &Solved,
    take: usize,
    actors: Vec<Actor>,
    theme: Theme,
) -> Stage {
    let roles = project.characters.iter().zip(&solved.report.characters).zip(&solved.characters);
    let roles = roles.map(|((character, report), solved)| Role {
        constraints: character.constraints.clone(),
        misses: report.alternatives.get(take).map(|a| a.final_.clone()).unwrap_or_default(),
        root_path_m: solved
            .motions
            .get(take)
            .map(|motion| motion.root_positions_m().to_vec())
            .unwrap_or_default(),
        poses: Vec::new(),
    });
    Stage {
        theme,
        actors,
        roles: roles.collect(),
        obstacles: project.obstacles.clone(),
        meetings: Vec::new(),
    }
}

/// The actor number `nth` (from 0) as a mannequin.
pub fn as_mannequin(nth: usize, part: Part, theme: Theme) -> Actor {
    let Part { name, skeleton, motion, soles } = part;
    let figure = Figure::mannequin(MeshId(nth as u64), &skeleton, Some(&motion), soles);
    Actor { name, figure: Arc::new(figure), skeleton, motion, look: look_of(nth, theme) }
}

/// The paint of the actor number `nth`: neutral for the first, each other tinted with a colour of
/// its own.
pub fn look_of(nth: usize, theme: Theme) -> Look {
    const TINT: f32 = 0.45;
    let neutral = ColorRole::Body.color(theme);
    match nth.checked_sub(1) {
        None => Look::neutral(theme),
        Some(other) => Look::Solid(neutral.mixed(ColorRole::Take(other).color(theme), TINT)),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use motion_io::diagnostic::Warnings;
    use motion_io::project_file;
    use motion_io::report_file::{AlternativeReport, CharacterReport, ConstraintReport, Report};

    use super::*;
    use crate::fixture::library;
    use crate::project_job::SolvedCharacter;

    /// A character whose two motions are clips of the fixture, and one who has none.
    fn solved() -> Solved {
        let library = library();
        let motions: Vec<Motion> =
            library.clips.clips()[..2].iter().map(|clip| clip.motion.clone()).collect();
        let missed = ConstraintReport { constraint: "end".into(), ..ConstraintReport::default() };
        let second = AlternativeReport { final_: vec![missed], ..AlternativeReport::default() };
        let report = |name: &str, alternatives| CharacterReport {
            name: name.to_owned(),
            alternatives,
            ..CharacterReport::default()
        };
        Solved {
            report: Report {
                characters: vec![report("A", vec![AlternativeReport::default(), second])],
                ..Report::default()
            },
            characters: vec![SolvedCharacter { library, motions }],
        }
    }

    #[test]
    fn a_take_is_one_of_those_that_there_are() {
        let mut solved = solved();
        let found = parts(&solved, 1).unwrap();
        assert_eq!(*found[0].motion, solved.characters[0].motions[1]);
        assert!(found[0].soles.height_m.iter().all(|&sole| (0.0..0.1).contains(&sole)));
        let missing = parts(&solved, 2).unwrap_err();
        assert_eq!(missing.to_string(), "there are 2 motions for A; ask for one of them");
        solved.characters[0].motions.clear();
        assert_eq!(parts(&solved, 0).unwrap_err(), NobodyError::NoMotion("A".to_owned()));
    }

    #[test]
    fn roles_have_the_misses_and_the_way_of_their_take() {
        let solved = solved();
        let text = "{\"gaitway\": 1, \"name\": \"p\", \"fps\": 30, \"library\": \"builtin\",
             \"characters\": [{\"name\": \"A\", \"constraints\": [{\"id\": \"end\", \"kind\": \"body\",
              \"frame\": 5, \"position\": [1, 2]}]}]}";
        let path = Path::new("p.gaitway");
        let project = project_file::read(text.as_bytes(), path, &mut Warnings::new()).unwrap();
        let stage = stage_of_project(&project, &solved, 1, Vec::new(), Theme::Dark);
        let [role] = stage.roles.as_slice() else { panic!("one role") };
        assert_eq!(role.misses[0].constraint, "end");
        assert_eq!(role.root_path_m, solved.characters[0].motions[1].root_positions_m());
        assert_eq!(role.constraints, project.characters[0].constraints);
    }

    #[test]
    fn the_first_is_neutral_and_others_are_told_apart() {
        let looks = [0, 1, 2].map(|nth| look_of(nth, Theme::Dark));
        assert_eq!(looks[0], Look::neutral(Theme::Dark));
        assert!(looks[0] != looks[1] && looks[1] != looks[2]);
    }
}

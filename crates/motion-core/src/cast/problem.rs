//! What several characters are asked, each for itself and all together.

use std::sync::Arc;

use glam::Vec2;

use super::interaction::Interaction;
use super::laid::Laid;
use super::stage::Stage;
use super::start::hypotheses;
use crate::constraint::OtherBody;
use crate::path::Path;
use crate::planar::PlanarTransform;
use crate::search::{Problem, ProblemError, SearchLibrary};

/// Bodies may be near each other this long before and after they interact, seconds.
pub const TOGETHER_SECS: f32 = 1.0;

/// Everything that is asked of a cast.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CastProblem {
    /// What is asked of each character by itself.
    pub characters: Vec<Problem>,
    /// What they do together.
    pub interactions: Vec<Interaction>,
}

/// Why a cast cannot be searched.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CastError {
    /// There are not as many libraries as characters.
    #[error("{libraries} libraries for {characters} characters; give each character one")]
    Libraries {
        /// How many libraries there are.
        libraries: usize,
        /// How many characters there are.
        characters: usize,
    },
    /// A member that is no character.
    #[error(
        "interaction {interaction} is between characters of whom there is none; choose one that there is"
    )]
    NobodyThere {
        /// Index of the interaction.
        interaction: usize,
    },
    /// A character that is in an interaction twice.
    #[error("interaction {interaction} has a character in it twice; take one of the two out")]
    Twice {
        /// Index of the interaction.
        interaction: usize,
    },
    /// A number that is no number, a weight below 0, a tolerance of 0.
    #[error("interaction {interaction} has a place, weight or tolerance that makes no sense")]
    NotFinite {
        /// Index of the interaction.
        interaction: usize,
    },
    /// What is asked of one character, its poses in interactions included, cannot be searched.
    #[error("{error}")]
    Character {
        /// Index of the character.
        character: usize,
        /// Why.
        error: ProblemError,
    },
}

impl CastProblem {
    /// Checks what the interactions ask by themselves. Each character's problem is checked where
    /// its search begins.
    pub fn check(&self) -> Result<(), CastError> {
        for (interaction, asked) in self.interactions.iter().enumerate() {
            for (nth, member) in asked.members.iter().enumerate() {
                if member.character >= self.characters.len() {
                    return Err(CastError::NobodyThere { interaction });
                }
                if asked.members[..nth].iter().any(|m| m.character == member.character) {
                    return Err(CastError::Twice { interaction });
                }
                let place = member.interaction_from_torso;
                if !place.ground_m().is_finite() || !place.heading_rad().is_finite() {
                    return Err(CastError::NotFinite { interaction });
                }
            }
            if !asked.weight.is_finite() || asked.weight < 0.0 || !asked.tolerance.is_valid() {
                return Err(CastError::NotFinite { interaction });
            }
        }
        Ok(())
    }

    /// What `character` is asked when interactions are at `places` (`None`: anywhere), in addition
    /// keeping clear of `others`: the poses of its interactions come after its own, in the order of
    /// the interactions.
    pub fn of_character(
        &self,
        character: usize,
        places: Option<&[PlanarTransform]>,
        others: Vec<OtherBody>,
    ) -> Problem {
        let mut problem = self.characters[character].clone();
        for (nth, interaction) in self.interactions.iter().enumerate() {
            if let Some(member) = interaction.member(character) {
                let place = places.map(|places| places[nth]);
                problem.wishes.poses.push(interaction.pose(member, place));
            }
        }
        problem.wishes.others.extend(others);
        problem
    }

    /// Frames in which `a` and `b` are meant to be near each other.
    pub(super) fn together(&self, a: usize, b: usize, frame_secs: f32) -> Vec<(u32, u32)> {
        let margin = (TOGETHER_SECS / frame_secs).round() as u32;
        let both = |i: &&Interaction| i.member(a).is_some() && i.member(b).is_some();
        let shared = self.interactions.iter().filter(both);
        shared.map(|i| (i.frame.saturating_sub(margin), i.frame + margin)).collect()
    }

    /// Another body on this track, for `character` who shares interactions with `other`.
    pub fn other_body(
        &self,
        (character, other): (usize, usize),
        track_m: Vec<Vec2>,
        frame_secs: f32,
    ) -> OtherBody {
        OtherBody { ground_m: track_m, together: self.together(character, other, frame_secs) }
    }

    /// Where each interaction may be (`world_from_interaction`), by what its members are asked
    /// beside it. The least-squares place, looser the more time there is.
    pub fn likely_places(&self, frame_secs: f32) -> Vec<PlanarTransform> {
        hypotheses(self, frame_secs).swap_remove(0)
    }

    /// Where these motions, one of each character, have the interactions: the place of each that
    /// suits them best, `places` where nobody has a place of its own. `None` where somebody's
    /// motion does not reach what it is asked.
    pub fn places_of(
        &self,
        libraries: &[Arc<SearchLibrary>],
        paths: &[Path],
        places: &[PlanarTransform],
    ) -> Option<Vec<PlanarTransform>> {
        let laid = paths.iter().zip(libraries).enumerate().map(|(character, (path, library))| {
            let alone = self.of_character(character, None, Vec::new());
            Some(vec![Laid::new(library, &alone, path.clone(), 0)?])
        });
        let laid = laid.collect::<Option<Vec<_>>>()?;
        let frame_secs = libraries.first()?.clips().fps().frame_secs() as f32;
        let stage = Stage::new(self, laid, places, frame_secs);
        Some(stage.arrange(&vec![Some(0); paths.len()]).places)
    }

    /// Indices of the interactions in the order of their frames.
    pub(super) fn in_time(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.interactions.len()).collect();
        order.sort_by_key(|&nth| (self.interactions[nth].frame, nth));
        order
    }
}

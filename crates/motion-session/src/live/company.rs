//! What the characters of a document have to do with each other while each is searched by itself.
//!
//! It is light: characters hear of each other when the takes that are shown have settled, one
//! character at a time, and only who walks into somebody, or whose interaction has come to lie
//! elsewhere, is asked anew. So what is shown comes to rest.

use std::sync::Arc;

use glam::Vec2;
use motion_core::cast::{CastProblem, Interaction};
use motion_core::constraint::OtherBody;
use motion_core::motion::Motion;
use motion_core::path::Path;
use motion_core::planar::PlanarTransform;
use motion_core::search::SearchLibrary;
use motion_io::project_file::Project;

use crate::problem::CharacterProblem;

/// After an edit each character is asked anew so often at most: two who cannot avoid each other
/// would go on for ever.
const MAX_EXCHANGES: usize = 4;
/// An interaction that would move less stays, metres and radians.
const STAYS_M: f32 = 0.05;
const STAYS_RAD: f32 = 0.05;
/// Coming nearer than wished by less than this is left as it is, metres.
const LEFT_AS_IT_IS_M: f32 = 0.1;
/// Who was known to be further away from where it is now than this is elsewhere, metres.
const ELSEWHERE_M: f32 = 0.3;

/// A take that is looked at and not being changed.
#[derive(Clone, Debug)]
pub(super) struct SettledTake {
    pub(super) path: Path,
    pub(super) motion: Arc<Motion>,
}

/// All characters, what is asked of each by itself, and what they know of each other.
#[derive(Debug, Default)]
pub(super) struct Company {
    project: Option<Project>,
    alone: Vec<CharacterProblem>,
    cast: CastProblem,
    /// Where each interaction is.
    places: Vec<PlanarTransform>,
    /// Whom each character keeps clear of.
    others: Vec<Vec<OtherBody>>,
    n_exchanges: usize,
    /// Whose turn it is to hear of the others.
    turn: usize,
}

impl Company {
    /// Something else is asked. Interactions that are the same as before stay where they are.
    pub(super) fn take_up(
        &mut self,
        project: &Project,
        alone: Vec<CharacterProblem>,
        interactions: Vec<Interaction>,
        frame_secs: f32,
    ) {
        let characters = alone.iter().map(|character| character.problem.clone()).collect();
        let cast = CastProblem { characters, interactions };
        let n_before = self.others.len();
        let same_names = alone.iter().map(|c| &c.name).eq(self.alone.iter().map(|c| &c.name));
        if n_before != alone.len() || !same_names {
            self.others = vec![Vec::new(); alone.len()];
        }
        if cast != self.cast {
            let likely = cast.likely_places(frame_secs);
            let old = std::mem::take(&mut self.places);
            let before = self.cast.interactions.iter().zip(&old);
            let known = |interaction: &Interaction| {
                before.clone().find(|(known, _)| *known == interaction).map(|(_, place)| *place)
            };
            let places = cast.interactions.iter().zip(likely);
            self.places = places.map(|(i, likely)| known(i).unwrap_or(likely)).collect();
            self.n_exchanges = 0;
        }
        (self.project, self.alone, self.cast) = (Some(project.clone()), alone, cast);
    }

    /// Nobody has to do with anybody, as far as is known.
    pub(super) fn part(&mut self) {
        *self = Self::default();
    }

    /// What the character is asked among the others.
    pub(super) fn asked_of(&self, character: usize) -> Option<CharacterProblem> {
        let (alone, project) = (self.alone.get(character)?, self.project.as_ref()?);
        let others = self.others.get(character)?.clone();
        let problem = self.cast.of_character(character, Some(&self.places), others);
        Some(alone.among_others(problem, project))
    }

    /// Everybody's shown takes have settled: who is to be asked anew, if anybody.
    pub(super) fn exchange(
        &mut self,
        library: &Arc<SearchLibrary>,
        takes: &[SettledTake],
    ) -> Vec<usize> {
        let n = self.alone.len();
        if takes.len() != n || n < 2 || self.n_exchanges >= MAX_EXCHANGES * n {
            return Vec::new();
        }
        let moved = self.move_interactions(library, takes);
        if !moved.is_empty() {
            self.n_exchanges += 1;
            return moved;
        }
        for _ in 0..n {
            self.turn = (self.turn + 1) % n;
            let others = self.others_of(self.turn, takes);
            let known = &self.others[self.turn];
            let walks_into = walks_into_somebody(&takes[self.turn].motion, &others);
            // Nor does anybody keep clear of where nobody is any more.
            if (walks_into && others != *known) || are_elsewhere(known, &others) {
                let character = self.turn;
                self.others[character] = others;
                self.n_exchanges += 1;
                return vec![character];
            }
        }
        Vec::new()
    }

    /// Puts interactions where the takes come to; returns who is in those that have moved.
    fn move_interactions(
        &mut self,
        library: &Arc<SearchLibrary>,
        takes: &[SettledTake],
    ) -> Vec<usize> {
        if self.cast.interactions.is_empty() {
            return Vec::new();
        }
        let libraries = vec![Arc::clone(library); takes.len()];
        let paths: Vec<Path> = takes.iter().map(|take| take.path.clone()).collect();
        let Some(places) = self.cast.places_of(&libraries, &paths, &self.places) else {
            return Vec::new();
        };
        let mut moved = Vec::new();
        for ((interaction, old), new) in
            self.cast.interactions.iter().zip(&mut self.places).zip(places)
        {
            let turn_rad = (old.inverse() * new).heading_rad().abs();
            if old.ground_m().distance(new.ground_m()) >= STAYS_M || turn_rad >= STAYS_RAD {
                *old = new;
                moved.extend(interaction.members.iter().map(|member| member.character));
            }
        }
        moved.sort_unstable();
        moved.dedup();
        moved
    }

    fn others_of(&self, character: usize, takes: &[SettledTake]) -> Vec<OtherBody> {
        let others = takes.iter().enumerate().filter(|(other, _)| *other != character);
        others
            .map(|(other, take)| {
                let frame_secs = take.motion.fps().frame_secs() as f32;
                self.cast.other_body((character, other), track_m(&take.motion), frame_secs)
            })
            .collect()
    }
}

fn track_m(motion: &Motion) -> Vec<Vec2> {
    motion.root_positions_m().iter().map(|root| Vec2::new(root.x, root.z)).collect()
}

/// Whether any of those who were known goes another way now.
fn are_elsewhere(known: &[OtherBody], now: &[OtherBody]) -> bool {
    known.iter().zip(now).any(|(known, now)| {
        let n_frames = known.ground_m.len().max(now.ground_m.len());
        let at = |track: &[Vec2], frame: usize| track[frame.min(track.len() - 1)];
        let mut ways = (0..n_frames).map(|f| (at(&known.ground_m, f), at(&now.ground_m, f)));
        ways.any(|(known, now)| known.distance(now) > ELSEWHERE_M)
    })
}

fn walks_into_somebody(motion: &Motion, others: &[OtherBody]) -> bool {
    (0u32..).zip(track_m(motion)).any(|(frame, ground_m)| {
        others.iter().any(|other| other.too_near_m(frame, ground_m) > LEFT_AS_IT_IS_M)
    })
}

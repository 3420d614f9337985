//! What a live search says of itself: whole, immutable, made by the worker.

use std::sync::Arc;

use motion_core::motion::Motion;
use motion_core::score::ScoreTerms;
use motion_io::report_file::{AlternativeReport, ConstraintReport};

use crate::document::{ByHand, CharacterIdx, StoredTake, TakeId, TakePiece};
use crate::suggest::Suggestion;

/// A hash of what is asked of a character's motion: constraints, weights, clips in use. Results
/// carry the one that they are for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ConstraintHash(pub u64);

/// Where a search stands.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum SearchState {
    /// There is no library yet.
    #[default]
    NoGraph,
    /// A library is being made.
    Building {
        /// What is being done.
        what: String,
        /// The share of it that is done, 0 to 1.
        share: f64,
    },
    /// There is a library and nothing to search.
    Ready,
    /// It goes on.
    Searching,
    /// The user has stopped it for now.
    Paused,
    /// Nothing new has come for a long while; an edit or a shake sets it going again.
    Settled,
    /// What is asked cannot be; the nearest to it is shown.
    Infeasible(String),
    /// Something is wrong.
    Error(String),
}

/// Everything that is known at a moment.
#[derive(Clone, Debug, Default)]
pub struct SearchSnapshot {
    /// Number of the request that it answers; 0 before the first.
    pub request: u64,
    /// Where the search stands, all characters together.
    pub state: SearchState,
    /// One for each character of the document, in its order.
    pub characters: Vec<CharacterSnapshot>,
}

/// What is known of one character's motions.
#[derive(Clone, Debug, Default)]
pub struct CharacterSnapshot {
    /// The character's name.
    pub name: String,
    /// What the scores are for.
    pub version: ConstraintHash,
    /// Where its search stands.
    pub state: SearchState,
    /// Rounds done.
    pub iterations: u64,
    /// Takes, best first; pinned ones and the shown one are always among them.
    pub takes: Vec<Take>,
    /// The take that the animator looks at.
    pub shown: Option<TakeId>,
    /// The take that the animator picked, or was shown first; the shown one descends from it.
    pub picked: Option<TakeId>,
    /// A take that is better than the shown one.
    pub better: Option<Better>,
    /// The best score by round, for a sparkline: a point where it fell, since the last edit.
    pub trace: Vec<BestAt>,
    /// Sentences on what is odd in what is asked, or cannot be.
    pub remarks: Vec<String>,
    /// Where the search has settled and something is missed: the smallest changes that would help, as
    /// far as they were tried.
    pub suggestions: Vec<Suggestion>,
}

/// A take that is better than the shown one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Better {
    /// Which.
    pub take: TakeId,
    /// By how much its score is lower, percent of the shown one's.
    pub by_percent: f32,
}

/// A point of the sparkline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BestAt {
    /// The round.
    pub iteration: u64,
    /// The best score after it.
    pub best: f32,
}

/// A motion that was found.
#[derive(Clone, Debug)]
pub struct Take {
    /// Stable under edits, in every session.
    pub id: TakeId,
    /// The take that it was improved from.
    pub parent: Option<TakeId>,
    /// What it scores for the present constraints; infinite where it cannot be scored for them.
    pub score: f32,
    /// The terms of the score.
    pub terms: ScoreTerms,
    /// How far each constraint is missed before correction, in the constraints' order.
    pub misses: Arc<[ConstraintReport]>,
    /// How many frames it has.
    pub n_frames: u32,
    /// The round that found it.
    pub found_in: u64,
    /// Whether it is kept with the project.
    pub is_pinned: bool,
    /// What it is made of.
    pub pieces: Arc<[TakePiece]>,
    /// What is changed on it by hand, and on which kept take that was done; none where neither it
    /// nor a take that it was improved from has a layer. It may be empty.
    pub by_hand: Option<HandLayer>,
    /// Its motion, as soon as it is made.
    pub made: Option<Made>,
}

/// What is changed by hand on a take.
#[derive(Clone, Debug, PartialEq)]
pub struct HandLayer {
    /// The kept take that has it: the take itself, or the nearest one that it was improved from.
    pub from: TakeId,
    /// The changes.
    pub layer: Arc<ByHand>,
}

/// A take's motion and what the report says of it.
#[derive(Clone, Debug)]
pub struct Made {
    /// The motion, on the library's skeleton, with what is changed on it by hand.
    pub motion: Arc<Motion>,
    /// The motion without that, in its own time; `None` where it is the same.
    pub before_hand: Option<Arc<Motion>>,
    /// Which frame of `before_hand` each frame shows; `None` where it is not retimed.
    pub source_frames: Option<Arc<[f64]>>,
    /// What was changed by hand when it was made; not the take's where it is stale.
    pub by_hand: Option<HandLayer>,
    /// What the report says of it: pieces, cuts, misses before and after correction, quality.
    pub report: Arc<AlternativeReport>,
    /// The constraints that it was corrected for: not the present ones where it is stale.
    pub version: ConstraintHash,
}

impl Take {
    /// The take as it is kept with a project, with its layer, whichever take that is from.
    pub fn stored(&self, character: &str) -> StoredTake {
        StoredTake {
            character: character.to_owned(),
            name: None,
            pinned: false,
            pieces: self.pieces.to_vec(),
            by_hand: self.by_hand.as_ref().map(|by_hand| ByHand::clone(&by_hand.layer)),
            extra: Default::default(),
        }
    }
}

impl CharacterSnapshot {
    /// A take by its id.
    pub fn take(&self, id: TakeId) -> Option<&Take> {
        self.takes.iter().find(|take| take.id == id)
    }

    /// The take that the animator looks at.
    pub fn shown(&self) -> Option<&Take> {
        self.take(self.shown?)
    }

    /// Whether a take's motion is for other constraints than the present ones, or with other
    /// changes by hand, or not made yet.
    pub fn is_stale(&self, take: &Take) -> bool {
        let is_now = |made: &Made| made.version == self.version && made.by_hand == take.by_hand;
        !take.made.as_ref().is_some_and(is_now)
    }
}

impl SearchSnapshot {
    /// What is known of a character.
    pub fn character(&self, character: CharacterIdx) -> Option<&CharacterSnapshot> {
        self.characters.get(character.0)
    }
}

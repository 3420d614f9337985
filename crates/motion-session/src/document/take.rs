//! Takes that the user keeps, by what they are made of.

use std::fmt;

use motion_io::content_hash::ContentHash;
use motion_io::project_file::Extra;
use serde_json::Value;

use super::by_hand::ByHand;

/// Names a take: a hash of the pieces that it is cut together from. So it is the same in every
/// session, under every set of constraints, and on every machine with the same clips.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TakeId(pub u64);

impl TakeId {
    /// The id of the take that shows these pieces one after the other.
    pub fn of(pieces: &[TakePiece]) -> Self {
        let mut bytes = Vec::new();
        for TakePiece { clip, from, to } in pieces {
            bytes.extend_from_slice(&(clip.len() as u64).to_le_bytes());
            bytes.extend_from_slice(clip.as_bytes());
            bytes.extend_from_slice(&from.to_le_bytes());
            bytes.extend_from_slice(&to.to_le_bytes());
        }
        let hash = ContentHash::of(&bytes).0;
        Self(hash.iter().take(8).fold(0, |id, &byte| id << 8 | u64::from(byte)))
    }
}

impl fmt::Display for TakeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// Frames of a clip, both ends shown; the next piece follows at once.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TakePiece {
    /// The clip's id.
    pub clip: String,
    /// The first frame of the clip.
    pub from: u32,
    /// The last frame of the clip.
    pub to: u32,
}

/// A take that is kept with the project.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredTake {
    /// Name of the character that it is a motion of.
    pub character: String,
    /// What the user calls it.
    pub name: Option<String>,
    /// Whether it stays whatever is found.
    pub pinned: bool,
    /// What it is made of; at least one piece.
    pub pieces: Vec<TakePiece>,
    /// What is changed by hand on it. `None` takes over what is changed on the take that it was
    /// improved from; an empty layer does not.
    pub by_hand: Option<ByHand>,
    /// Keys that this version does not know.
    pub extra: Extra,
}

impl StoredTake {
    /// The take's id.
    pub fn id(&self) -> TakeId {
        TakeId::of(&self.pieces)
    }
}

/// The takes that are kept with a project, in the order in which they were first kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TakeBook {
    pub(super) entries: Vec<TakeEntry>,
}

/// An entry of the file's list.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum TakeEntry {
    /// A take.
    Take(StoredTake),
    /// Something that this version does not understand; kept as it is.
    Strange(Value),
}

impl TakeBook {
    /// The takes.
    pub fn iter(&self) -> impl Iterator<Item = &StoredTake> {
        self.entries.iter().filter_map(|entry| match entry {
            TakeEntry::Take(take) => Some(take),
            TakeEntry::Strange(_) => None,
        })
    }

    /// The take `id` of a character, if it is kept.
    pub fn get(&self, character: &str, id: TakeId) -> Option<&StoredTake> {
        self.iter().find(|take| take.character == character && take.id() == id)
    }

    /// Puts a take in, in the place of what is known of it.
    pub(crate) fn put(&mut self, take: StoredTake) {
        let id = take.id();
        let known = self.takes_mut().find(|t| t.character == take.character && t.id() == id);
        match known {
            Some(known) => *known = take,
            None => self.entries.push(TakeEntry::Take(take)),
        }
    }

    /// Takes a take out.
    pub(crate) fn remove(&mut self, character: &str, id: TakeId) {
        self.retain(|take| take.character != character || take.id() != id);
    }

    /// Keeps the takes that `keep` says yes to.
    pub(crate) fn retain(&mut self, keep: impl Fn(&StoredTake) -> bool) {
        self.entries.retain(|entry| match entry {
            TakeEntry::Take(take) => keep(take),
            TakeEntry::Strange(_) => true,
        });
    }

    /// The takes, to be changed.
    pub(crate) fn takes_mut(&mut self) -> impl Iterator<Item = &mut StoredTake> {
        self.entries.iter_mut().filter_map(|entry| match entry {
            TakeEntry::Take(take) => Some(take),
            TakeEntry::Strange(_) => None,
        })
    }
}

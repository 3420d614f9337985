//! How parts of a document are named by commands, selections and pictures.

/// A character, by its place in the project.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CharacterIdx(pub usize);

/// An obstacle, by its place in the project.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ObstacleIdx(pub usize);

/// A constraint, by whose it is and its id.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ConstraintRef {
    /// Whose it is.
    pub character: CharacterIdx,
    /// Unique among the character's.
    pub id: String,
}

impl ConstraintRef {
    /// The constraint `id` of `character`.
    pub fn new(character: CharacterIdx, id: impl Into<String>) -> Self {
        Self { character, id: id.into() }
    }
}

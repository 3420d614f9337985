//! Which search is used.

/// The search that looks for motions. All score alike.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SearchKind {
    /// Ours (`docs/search.md`).
    #[default]
    Gaitway,
    /// The paper's: Arikan & Forsyth 2002, section 4.2.
    Af02,
    /// Anytime weighted A* over the coarse graph, after Safonova & Hodgins 2007.
    AStar,
}

impl SearchKind {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Gaitway, Self::Af02, Self::AStar];

    /// What it is called on the command line and in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gaitway => "gaitway",
            Self::Af02 => "af02",
            Self::AStar => "astar",
        }
    }
}

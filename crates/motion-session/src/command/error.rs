//! Why a command is refused, as a sentence for the user.

/// Why a command is refused. Nothing has changed then.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CommandError {
    /// No such character.
    #[error("there is no such character any more")]
    NoCharacter,
    /// No such constraint.
    #[error("there is no {0:?} any more")]
    NoConstraint(String),
    /// No such obstacle.
    #[error("there is no such obstacle any more")]
    NoObstacle,
    /// No such interaction.
    #[error("there is no meeting {0:?} any more")]
    NoInteraction(String),
    /// Nobody meets himself.
    #[error("a meeting is of two or more characters, each of them once")]
    MeetsNobody,
    /// No such take.
    #[error("this take is not kept with the project; pin or name it first")]
    NoTake,
    /// No such change by hand.
    #[error("there is no change by hand {0:?} on this take any more")]
    NoHandEdit(String),
    /// No such tag.
    #[error("the clip {clip:?} was not given the tag {tag:?} by hand")]
    NoTag {
        /// The clip.
        clip: String,
        /// The tag.
        tag: String,
    },
    /// A motion needs a start and an end.
    #[error("a motion needs a start and an end; move this checkpoint instead of deleting it")]
    LastTwoCheckpoints,
    /// The start cannot go.
    #[error("the motion begins at this checkpoint; move it instead of deleting it")]
    StartStays,
    /// The start is at frame 0.
    #[error("the start stays at frame 0; move other checkpoints in time")]
    StartIsAtZero,
    /// Two checkpoints at one frame.
    #[error("there is a checkpoint at frame {0} already; choose another frame")]
    FrameTaken(u32),
    /// Behind the end of an exact length.
    #[error(
        "frame {frame} is behind the end of a motion of exactly {length} frames; make the motion longer first"
    )]
    BeyondLength {
        /// The frame asked for.
        frame: u32,
        /// The exact length.
        length: u32,
    },
    /// The kind of constraint does not have that.
    #[error("a {kind} constraint has no {what}")]
    NotOfThisKind {
        /// The kind.
        kind: &'static str,
        /// What it does not have.
        what: &'static str,
    },
    /// A number outside what a project can hold.
    #[error("{what} must be {allowed}")]
    OutOfRange {
        /// What was given.
        what: &'static str,
        /// What it may be.
        allowed: &'static str,
    },
    /// A span that ends before it begins.
    #[error("it would end at frame {to}, before it begins at frame {from}")]
    EndsBeforeItBegins {
        /// The first frame.
        from: u32,
        /// The last frame.
        to: u32,
    },
    /// Something without a name.
    #[error("{0} needs a name")]
    NoName(&'static str),
    /// A name that is no file name.
    #[error(
        "files are named after a character, and this name {0}; use letters, digits, blanks, - and _"
    )]
    BadCharacterName(&'static str),
    /// A name that another character has.
    #[error("another character is called {0:?}; choose another name")]
    NameTaken(String),
    /// Too many of something.
    #[error("a project has at most {max} {what}")]
    TooMany {
        /// Of what.
        what: &'static str,
        /// How many there may be.
        max: usize,
    },
    /// A project needs somebody.
    #[error("a project needs a character; rename this one instead of deleting it")]
    LastCharacter,
    /// Somebody else's business.
    #[error("{0:?} meets somebody in an interaction; delete that first")]
    InInteraction(String),
}

//! What a `.gaitway` file says. Plain data in the file's units: metres, degrees, frames.
//!
//! Every object has `extra`: the keys that this version does not know, kept for saving.

use motion_core::tags::{HandTag, HandTags};
use serde_json::{Map, Value};

/// The keys of an object that this version does not know, in the file's order.
pub type Extra = Map<String, Value>;

/// A project.
#[derive(Clone, Debug, PartialEq)]
pub struct Project {
    /// What the user calls it.
    pub name: String,
    /// A sentence on what it is for.
    pub about: Option<String>,
    /// Frames per second of everything in it; a valid [`Fps`](motion_core::units::Fps).
    pub fps: f64,
    /// A folder of clips or a `.gwlib`, relative to the project file; or `builtin`.
    pub library: String,
    /// Content hashes, to notice that a library has changed.
    pub hashes: Option<Hashes>,
    /// Which clips may be used; all where left out.
    pub palette: Option<Palette>,
    /// Tags that a person gave to clips.
    pub tags: Vec<TagEntry>,
    /// At least one.
    pub characters: Vec<Character>,
    /// Where characters meet.
    pub interactions: Vec<Interaction>,
    /// What stands in the way.
    pub obstacles: Vec<Obstacle>,
    /// How to search.
    pub search: Search,
    /// What the editor adds (camera, kept alternatives, panels); not looked into here.
    pub editor: Option<Value>,
    /// Unknown keys.
    pub extra: Extra,
}

/// Content hashes of what the project was made with, hexadecimal BLAKE3.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hashes {
    /// Of the library.
    pub library: Option<String>,
    /// Of each clip that the project names, by id.
    pub clips: Vec<(String, String)>,
    /// Unknown keys.
    pub extra: Extra,
}

/// Which clips may be used. Patterns are globs over clip ids.
#[derive(Clone, Debug, PartialEq)]
pub struct Palette {
    /// A clip must match one of these.
    pub include: Vec<String>,
    /// And none of these.
    pub exclude: Vec<String>,
    /// And have one of these tags, where there are any.
    pub tags: Vec<String>,
    /// Unknown keys.
    pub extra: Extra,
}

/// A tag that a person gave to a clip. In the file a text alone is about the whole clip, an object
/// has `tag`, `from` and `to`.
#[derive(Clone, Debug, PartialEq)]
pub struct TagEntry {
    /// The clip's id.
    pub clip: String,
    /// What it was given.
    pub tag: HandTag,
    /// Unknown keys.
    pub extra: Extra,
}

impl Project {
    /// The tags given by hand, as clips are asked for them.
    pub fn hand_tags(&self) -> HandTags {
        let mut tags = HandTags::default();
        self.tags.iter().for_each(|entry| tags.give(&entry.clip, entry.tag.clone()));
        tags
    }
}

/// A person to be animated.
#[derive(Clone, Debug, PartialEq)]
pub struct Character {
    /// Unique in the project and fit for a file name.
    pub name: String,
    /// How long the motion shall be; free where left out.
    pub length: Option<Length>,
    /// A mesh file of the character's own, relative to the project file.
    pub body: Option<String>,
    /// A library of the character's own, as [`Project::library`].
    pub library: Option<String>,
    /// What the motion must meet. Ids are unique.
    pub constraints: Vec<Constraint>,
    /// Unknown keys.
    pub extra: Extra,
}

/// How long a motion shall be.
#[derive(Clone, Debug, PartialEq)]
pub struct Length {
    /// Number of frames, at least 1; `None` only in [`LengthMode::Free`].
    pub frames: Option<u32>,
    /// How strictly.
    pub mode: LengthMode,
    /// Weight of the length term, 0 or more; 1 where left out.
    pub weight: Option<f64>,
    /// Unknown keys.
    pub extra: Extra,
}

/// How strictly a length is meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LengthMode {
    /// Any length will do.
    Free,
    /// About as long; how far off it is counts in the score.
    #[default]
    Preferred,
    /// Exactly as long.
    Exact,
}

impl LengthMode {
    /// Every mode with its name in files.
    pub const ALL: [(&str, Self); 3] =
        [("free", Self::Free), ("preferred", Self::Preferred), ("exact", Self::Exact)];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Preferred => "preferred",
            Self::Exact => "exact",
        }
    }
}

/// Something that a motion must meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint {
    /// Unique among the character's; given at load (`body-1`) where the file has none.
    pub id: String,
    /// What must be met.
    pub kind: ConstraintKind,
    /// 0 or more; 1 where left out.
    pub weight: Option<f64>,
    /// How far off is still well; the search's own where left out.
    pub tolerance: Option<Tolerance>,
    /// Unknown keys.
    pub extra: Extra,
}

/// How far off a constraint may be before it counts 1. In the file a number alone is the
/// position's, an object has `position`, `heading` and `frames`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tolerance {
    /// Metres.
    pub position_m: Option<f64>,
    /// Degrees.
    pub heading_deg: Option<f64>,
    /// Frames.
    pub frames: Option<f64>,
    /// Unknown keys.
    pub extra: Extra,
}

/// The kinds of constraints. Frames are the motion's own, from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum ConstraintKind {
    /// Where the body is and looks at a frame. No two of a character are at the same frame.
    Body {
        /// When.
        frame: u32,
        /// `[x, z]` on the ground, metres.
        position_m: [f64; 2],
        /// Where it looks: 0 is +Z, 90 is +X; anywhere where left out.
        heading_deg: Option<f64>,
        /// Height of what the body stands on, metres.
        height_m: Option<f64>,
    },
    /// Where a joint is at a frame.
    Joint {
        /// When.
        frame: u32,
        /// The joint's name, or a role.
        joint: String,
        /// `[x, y, z]`, metres.
        position_m: [f64; 3],
        /// `[x, y, z]`, metres per second.
        velocity_m_s: Option<[f64; 3]>,
    },
    /// A pose of a clip at a frame.
    Pose {
        /// When.
        frame: u32,
        /// The clip's id.
        clip: String,
        /// The frame of the clip, at the library's rate.
        clip_frame: u32,
        /// `[x, z]` on the ground, metres.
        position_m: Option<[f64; 2]>,
        /// Where it looks.
        heading_deg: Option<f64>,
        /// Height of what the body stands on, metres.
        height_m: Option<f64>,
    },
    /// What kind of motion it is, from a frame to a frame (both included).
    Style {
        /// The first frame.
        from: u32,
        /// The last frame.
        to: u32,
        /// A tag of clips.
        tag: String,
    },
    /// Where the body goes, from a frame to a frame (both included).
    Path {
        /// The first frame.
        from: u32,
        /// The last frame.
        to: u32,
        /// At least two points `[x, z]` on the ground, metres.
        points_m: Vec<[f64; 2]>,
        /// Where it looks meanwhile.
        heading: PathHeading,
    },
    /// A part of the motion that stays as it is, from a frame to a frame (both included).
    Lock {
        /// The first frame.
        from: u32,
        /// The last frame.
        to: u32,
        /// What is shown there.
        pieces: Vec<LockedPiece>,
    },
}

/// Where a body looks that follows a path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PathHeading {
    /// Anywhere.
    #[default]
    Free,
    /// Where the path goes.
    Along,
}

impl PathHeading {
    /// Every choice with its name in files.
    pub const ALL: [(&str, Self); 2] = [("free", Self::Free), ("along", Self::Along)];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Along => "along",
        }
    }
}

impl ConstraintKind {
    /// The kind's name in files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Body { .. } => "body",
            Self::Joint { .. } => "joint",
            Self::Pose { .. } => "pose",
            Self::Style { .. } => "style",
            Self::Path { .. } => "path",
            Self::Lock { .. } => "lock",
        }
    }

    /// The last frame that the constraint speaks of.
    pub fn last_frame(&self) -> u32 {
        match *self {
            Self::Body { frame, .. } | Self::Joint { frame, .. } | Self::Pose { frame, .. } => {
                frame
            }
            Self::Style { to, .. } | Self::Path { to, .. } | Self::Lock { to, .. } => to,
        }
    }
}

/// Frames of a clip that are shown one after the other, both ends included.
#[derive(Clone, Debug, PartialEq)]
pub struct LockedPiece {
    /// The clip's id.
    pub clip: String,
    /// The first frame of the clip.
    pub from: u32,
    /// The last frame of the clip.
    pub to: u32,
    /// Unknown keys.
    pub extra: Extra,
}

/// A moment at which characters stand to each other in a given way.
#[derive(Clone, Debug, PartialEq)]
pub struct Interaction {
    /// Unique among the interactions; given at load where the file has none.
    pub id: String,
    /// When.
    pub frame: u32,
    /// 0 or more; 1 where left out.
    pub weight: Option<f64>,
    /// Who takes part and with which pose; at least two.
    pub members: Vec<Member>,
    /// Where each member stands, in a common frame that may be anywhere.
    pub relative: Vec<Placement>,
    /// Unknown keys.
    pub extra: Extra,
}

/// A character's part in an interaction.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// The character's name.
    pub character: String,
    /// The clip's id.
    pub clip: String,
    /// The frame of the clip, at the library's rate.
    pub clip_frame: u32,
    /// Unknown keys.
    pub extra: Extra,
}

/// A place on the ground and a heading.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// `[x, z]`, metres.
    pub position_m: [f64; 2],
    /// 0 is +Z, 90 is +X.
    pub heading_deg: f64,
    /// Unknown keys.
    pub extra: Extra,
}

/// Something in the way.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// What and where.
    pub shape: Shape,
    /// Unknown keys.
    pub extra: Extra,
}

/// The shapes of obstacles; lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A box.
    Box {
        /// Its middle, `[x, y, z]`.
        center_m: [f64; 3],
        /// Its edges along its own x, y and z.
        size_m: [f64; 3],
        /// Its turn about +Y.
        heading_deg: f64,
    },
    /// An upright cylinder.
    Cylinder {
        /// Its middle.
        center_m: [f64; 3],
        /// Its radius.
        radius_m: f64,
        /// Its height.
        height_m: f64,
    },
    /// A level rectangle that nothing may rise above.
    Ceiling {
        /// Its middle.
        center_m: [f64; 3],
        /// Its edges; the height is of no account.
        size_m: [f64; 3],
        /// Its turn about +Y.
        heading_deg: f64,
    },
}

/// How to search.
#[derive(Clone, Debug, PartialEq)]
pub struct Search {
    /// Seed of all chance.
    pub seed: u64,
    /// How many alternatives are wanted, at least 1.
    pub alternatives: u32,
    /// The threshold of the graph; chosen from the library where left out.
    pub tau: Option<f64>,
    /// Whether mirrored clips are used too.
    pub mirror: Option<bool>,
    /// Whether bridges between parts of the graph are used.
    pub bridges: Option<bool>,
    /// Weights of the score's terms by name, 0 or more; 1 where left out.
    pub weights: Vec<(String, f64)>,
    /// Unknown keys.
    pub extra: Extra,
}

impl Default for Search {
    fn default() -> Self {
        Self {
            seed: 1,
            alternatives: 6,
            tau: None,
            mirror: None,
            bridges: None,
            weights: Vec::new(),
            extra: Extra::new(),
        }
    }
}

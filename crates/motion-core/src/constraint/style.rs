//! Tagged clips preferred over a stretch of time. Soft.

/// A wished style.
#[derive(Clone, Debug, PartialEq)]
pub struct StyleConstraint {
    /// First frame.
    pub from: u32,
    /// Last frame.
    pub to: u32,
    /// The tag of the clips that are preferred.
    pub tag: String,
    /// Factor of the share of frames without the tag.
    pub weight: f32,
}

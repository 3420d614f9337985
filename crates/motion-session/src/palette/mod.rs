//! Which clips a palette leaves to the search, and palettes that leave some more or fewer.
//!
//! A clip is in the palette when a pattern of `include` matches it (an empty list matches all), none
//! of `exclude` does, and it has one of the `tags` (an empty list asks for none): by its name, found
//! in a good part of its motion, or given by hand ([`whole_tags`]). Small and capital letters are
//! alike. A pattern for `walk` has its mirror image `walk@mirror` too.
//!
//! [`Matcher`] is the only place that knows this: the search asks it, and so do check boxes.

mod edit;

use globset::{GlobBuilder, GlobSet, GlobSetBuilder};
use motion_core::skeleton::mirror::MIRROR_SUFFIX;
use motion_core::tags::{HandTags, has_words, whole_tags};
use motion_io::project_file::Palette;

use crate::clip_rows::ClipRow;
use crate::document::TakePiece;
use crate::live::ReadyLibrary;
pub use edit::{palette_with, palette_with_clips, palette_with_tag};

/// A clip as a palette sees it: its id and its tags.
pub type TaggedClip<'a> = (&'a str, &'a [String]);

/// A palette, ready to be asked about many clips.
#[derive(Clone, Debug)]
pub struct Matcher<'a> {
    palette: Option<&'a Palette>,
    include: GlobSet,
    exclude: GlobSet,
}

impl<'a> Matcher<'a> {
    /// Fails on a pattern that is none. Without a palette every clip is in use.
    pub fn new(palette: Option<&'a Palette>) -> Result<Self, globset::Error> {
        let set = |list: fn(&Palette) -> &[String]| patterns(palette.map_or(&[], list));
        Ok(Self { palette, include: set(|p| &p.include)?, exclude: set(|p| &p.exclude)? })
    }

    /// Whether the palette has a clip.
    pub fn has(&self, (id, tags): TaggedClip<'_>) -> bool {
        let Some(palette) = self.palette else { return true };
        let matches = |set: &GlobSet| set.is_match(source_of(id)) || set.is_match(id);
        let given = || tags.iter().map(String::as_str);
        let is_tagged =
            palette.tags.is_empty() || palette.tags.iter().any(|tag| has_words(tag, given()));
        (palette.include.is_empty() || matches(&self.include))
            && !matches(&self.exclude)
            && is_tagged
    }
}

/// The clip that an id is the mirror image of, or the clip itself.
fn source_of(id: &str) -> &str {
    id.strip_suffix(MIRROR_SUFFIX).unwrap_or(id)
}

fn patterns(patterns: &[String]) -> Result<GlobSet, globset::Error> {
    let mut set = GlobSetBuilder::new();
    for pattern in patterns {
        set.add(GlobBuilder::new(pattern).case_insensitive(true).build()?);
    }
    set.build()
}

/// Listed clips as palettes see them, in the library's order.
pub fn tagged_clips(rows: &[ClipRow]) -> Vec<TaggedClip<'_>> {
    rows.iter().map(|row| (row.id.as_str(), row.tags.as_slice())).collect()
}

/// Whether the search may use a clip. A palette with a pattern that is none has no clip, as the
/// search refuses it; for many clips, ask a [`Matcher`].
pub fn is_in_palette(palette: Option<&Palette>, clip: TaggedClip<'_>) -> bool {
    Matcher::new(palette).is_ok_and(|matcher| matcher.has(clip))
}

/// The clips that a take is made of though the palette does not have them, each once.
///
/// A take goes when a clip of it is switched off, but not the one that is looked at, nor a pinned
/// one: those are to be marked with what this says.
pub fn clips_outside(
    palette: Option<&Palette>,
    by_hand: &HandTags,
    ready: &ReadyLibrary,
    pieces: &[TakePiece],
) -> Vec<String> {
    let Ok(matcher) = Matcher::new(palette) else { return Vec::new() };
    let set = &ready.library.clips;
    let is_outside = |id: &str| {
        let clip = set.by_id(id).map(|clip| set.clip(clip));
        clip.is_some_and(|clip| !matcher.has((&clip.id, &whole_tags(clip, by_hand))))
    };
    let mut outside: Vec<String> = Vec::new();
    for piece in pieces.iter().filter(|piece| is_outside(&piece.clip)) {
        if !outside.contains(&piece.clip) {
            outside.push(piece.clip.clone());
        }
    }
    outside
}

/// How much of a tag is in use, as its check box shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TagState {
    /// Every clip with the tag.
    All,
    /// Some of them.
    Some,
    /// None of them.
    None,
}

/// How much of a tag is in use.
pub fn tag_state(palette: Option<&Palette>, clips: &[TaggedClip<'_>], tag: &str) -> TagState {
    let Ok(matcher) = Matcher::new(palette) else { return TagState::None };
    let tagged = clips.iter().filter(|(_, tags)| tags.iter().any(|own| own == tag));
    let (mut n, mut n_in) = (0, 0);
    for clip in tagged {
        n += 1;
        n_in += usize::from(matcher.has(*clip));
    }
    match n_in {
        0 => TagState::None,
        n_in if n_in == n => TagState::All,
        _ => TagState::Some,
    }
}

#[cfg(test)]
mod tests;

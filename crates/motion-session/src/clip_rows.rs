//! The clips of a library as a panel lists them.

use std::collections::BTreeMap;

use motion_core::skeleton::mirror::MIRROR_SUFFIX;
use motion_core::tags::{HandTag, HandTags, TagSpan, whole_tags};
use motion_io::project_file::Palette;

use crate::live::ReadyLibrary;
use crate::palette::Matcher;

/// A clip in a list.
#[derive(Clone, Debug, PartialEq)]
pub struct ClipRow {
    /// Its id.
    pub id: String,
    /// How many frames it has.
    pub n_frames: usize,
    /// How long it is, seconds.
    pub secs: f64,
    /// Words for what happens in it: by its name, found in it, given by hand.
    pub tags: Vec<String>,
    /// Those that it was given by hand itself.
    pub by_hand: Vec<HandTag>,
    /// Where what was found in it happens.
    pub spans: Vec<TagSpan>,
    /// The performer, where the id says it as capture databases do: `16` of `16_40`. A library does
    /// not know the folders that its clips came from.
    pub subject: Option<String>,
    /// Whether it is the mirror image of another clip.
    pub is_mirror: bool,
    /// Whether the search may use it.
    pub is_in_palette: bool,
}

impl ClipRow {
    /// Whether every word of a search is somewhere in the id or the tags; all are found by nothing.
    /// A word with `*` or `?` is a pattern that the whole id matches, as in palettes.
    pub fn matches(&self, search: &str) -> bool {
        let id = self.id.to_lowercase();
        let tags: Vec<String> = self.tags.iter().map(|tag| tag.to_lowercase()).collect();
        let has = |word: &str| match word.contains(['*', '?']) {
            true => is_match(word, &id),
            false => id.contains(word) || tags.iter().any(|tag| tag.contains(word)),
        };
        search.to_lowercase().split_whitespace().all(has)
    }
}

/// A row for every clip, in the library's order. With a palette that has a pattern that is none, no
/// clip is in it, as the search refuses it.
pub fn clip_rows(
    ready: &ReadyLibrary,
    palette: Option<&Palette>,
    by_hand: &HandTags,
) -> Vec<ClipRow> {
    let matcher = Matcher::new(palette).ok();
    let fps = ready.library.clips.fps();
    let row = |clip: &motion_core::clip::Clip| {
        let tags = whole_tags(clip, by_hand);
        let has = |matcher: &Matcher<'_>| matcher.has((&clip.id, &tags));
        ClipRow {
            id: clip.id.clone(),
            n_frames: clip.n_frames(),
            secs: fps.duration_secs(clip.n_frames()),
            is_in_palette: matcher.as_ref().is_some_and(has),
            tags,
            by_hand: by_hand.of(&clip.id).to_vec(),
            spans: clip.tag_spans.clone(),
            subject: subject_of(&clip.id),
            is_mirror: clip.id.ends_with(MIRROR_SUFFIX),
        }
    };
    ready.library.clips.clips().iter().map(row).collect()
}

/// Every tag with the number of clips that have it, the most frequent first, then by name.
pub fn tag_counts(rows: &[ClipRow]) -> Vec<(String, usize)> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for tag in rows.iter().flat_map(|row| &row.tags) {
        *counts.entry(tag).or_default() += 1;
    }
    let mut counts: Vec<(String, usize)> =
        counts.into_iter().map(|(tag, n)| (tag.to_owned(), n)).collect();
    counts.sort_by_key(|(_, n)| std::cmp::Reverse(*n));
    counts
}

/// Whether a whole text matches a pattern: `*` is any letters, `?` is one.
fn is_match(pattern: &str, text: &str) -> bool {
    let (pattern, text): (Vec<char>, Vec<char>) =
        (pattern.chars().collect(), text.chars().collect());
    // Of the pattern so far: which beginnings of the text match it.
    let mut ends = vec![false; text.len() + 1];
    ends[0] = true;
    for letter in pattern {
        let mut next = vec![false; text.len() + 1];
        for at in 0..=text.len() {
            let before = at > 0 && ends[at - 1];
            next[at] = match letter {
                '*' => ends[at] || (at > 0 && next[at - 1]),
                '?' => before,
                letter => before && text[at - 1] == letter,
            };
        }
        ends = next;
    }
    ends[text.len()]
}

fn subject_of(id: &str) -> Option<String> {
    let id = id.strip_suffix(MIRROR_SUFFIX).unwrap_or(id);
    let (subject, trial) = id.split_once('_')?;
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    (is_number(subject) && is_number(trial)).then(|| subject.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::ready_library;
    use crate::palette::{palette_with, tagged_clips};

    #[test]
    fn rows_say_what_a_list_needs() {
        let ready = ready_library();
        let by_hand = HandTags::default();
        let all = clip_rows(&ready, None, &by_hand);
        let palette = palette_with(None, &tagged_clips(&all), "walk", false);
        let rows = clip_rows(&ready, palette.as_ref(), &by_hand);
        let out: Vec<&str> =
            rows.iter().filter(|row| !row.is_in_palette).map(|row| row.id.as_str()).collect();
        assert_eq!(out, ["walk", "walk@mirror"]);
        let walk = rows.iter().find(|row| row.id == "walk").unwrap();
        assert_eq!((walk.n_frames, walk.is_mirror), (90, false));
        assert!((walk.secs - 89.0 / 30.0).abs() < 1e-9);
        assert_eq!(walk.tags, ["walk"]);
        assert!(rows.iter().any(|row| row.is_mirror));
        assert_eq!(tag_counts(&rows)[0], ("walk".to_owned(), 10));
    }

    #[test]
    fn searching_is_by_words_in_any_order() {
        let rows = clip_rows(&ready_library(), None, &HandTags::default());
        let found = |text| {
            let found = rows.iter().filter(|row| row.matches(text));
            found.map(|row| row.id.as_str()).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(found("LATE walk"), "walk_late walk_late@mirror");
        assert_eq!(
            found("left @"),
            "left@mirror right@mirror",
            "the image of a right turn turns left"
        );
        assert_eq!(found("").split(' ').count(), rows.len());
        assert_eq!(found("jump"), "");
        assert_eq!(found("W?lk*"), "walk walk_late walk@mirror walk_late@mirror");
        assert_eq!(found("*ate"), "walk_late");
        assert_eq!(found("alk*"), "");
    }

    #[test]
    fn subjects_are_numbers_before_trials() {
        for (id, subject) in [("16_40", Some("16")), ("02_01@mirror", Some("02"))] {
            assert_eq!(subject_of(id).as_deref(), subject);
        }
        assert_eq!((subject_of("walk_2"), subject_of("16_"), subject_of("16")), (None, None, None));
    }
}

//! Palettes after a check box was clicked.
//!
//! What is wanted is a set of clips; the palette for it is the first of some ways to write it, the
//! gentlest first, that means exactly that set to the [`Matcher`]. So patterns written by hand stay
//! as long as they can, and no way of writing can be wrong unnoticed.

use std::collections::BTreeSet;

use motion_core::skeleton::mirror::MIRROR_SUFFIX;
use motion_io::project_file::Palette;

use super::{Matcher, TaggedClip, patterns, source_of};

/// The palette after a clip's check box was set to `on`; a clip's mirror image goes with it, and an
/// image's own check box is about the image alone. `None` where all clips are in use.
pub fn palette_with(
    palette: Option<&Palette>,
    clips: &[TaggedClip<'_>],
    clip_id: &str,
    on: bool,
) -> Option<Palette> {
    palette_with_clips(palette, clips, &[clip_id], on)
}

/// The palette after the check box of a tag was set to `on`: all clips that have it.
pub fn palette_with_tag(
    palette: Option<&Palette>,
    clips: &[TaggedClip<'_>],
    tag: &str,
    on: bool,
) -> Option<Palette> {
    let tagged = clips.iter().filter(|(_, tags)| tags.iter().any(|own| own == tag));
    let ids: Vec<&str> = tagged.map(|(id, _)| *id).collect();
    palette_with_clips(palette, clips, &ids, on)
}

/// The palette after many clips were set to `on` at once, each as by [`palette_with`].
pub fn palette_with_clips(
    palette: Option<&Palette>,
    clips: &[TaggedClip<'_>],
    clip_ids: &[&str],
    on: bool,
) -> Option<Palette> {
    let old = palette.map(without_bad_patterns).unwrap_or_else(everything);
    let asked: BTreeSet<&str> = clip_ids.iter().copied().collect();
    let is_asked = |id: &str| asked.contains(id) || asked.contains(source_of(id));
    let wanted: Vec<bool> = match Matcher::new(Some(&old)) {
        Ok(matcher) => {
            { clips.iter().map(|clip| if is_asked(clip.0) { on } else { matcher.has(*clip) }) }
                .collect()
        }
        // Only patterns that are some were left.
        Err(_) => return palette.cloned(),
    };
    if !wanted.contains(&false) && old.extra.is_empty() {
        return None;
    }
    let means_it = |palette: &Palette| {
        Matcher::new(Some(palette)).is_ok_and(|matcher| {
            clips.iter().zip(&wanted).all(|(clip, wanted)| matcher.has(*clip) == *wanted)
        })
    };
    let ways: [&dyn Fn() -> Palette; 5] = [
        &|| old.clone(),
        &|| if on { not_excluded(&old, &asked) } else { excluded(&old, &asked) },
        &|| included(&not_excluded(&old, &asked), clips, &wanted, &is_asked),
        &|| {
            let open = without_patterns_for(&old, clips, &wanted);
            included(&open, clips, &wanted, &is_asked)
        },
        &|| Palette { include: everything().include, ..listed_exclusions(&old, clips, &wanted) },
    ];
    let written = ways.into_iter().map(|way| way()).find(means_it);
    Some(written.unwrap_or_else(|| listed(&old, clips, &wanted)))
}

fn everything() -> Palette {
    let include = vec!["*".to_owned()];
    Palette { include, exclude: Vec::new(), tags: Vec::new(), extra: Default::default() }
}

/// What is left of a palette that the search would refuse.
fn without_bad_patterns(palette: &Palette) -> Palette {
    let mut palette = palette.clone();
    let is_good = |pattern: &String| patterns(std::slice::from_ref(pattern)).is_ok();
    palette.include.retain(is_good);
    palette.exclude.retain(is_good);
    palette
}

/// The pattern of one clip alone.
fn literal(id: &str) -> String {
    globset::escape(id)
}

/// The ids asked for, images left out whose clips are asked for too.
fn sources<'a>(asked: &BTreeSet<&'a str>) -> impl Iterator<Item = &'a str> {
    asked.iter().copied().filter(|id| source_of(id) == *id || !asked.contains(source_of(id)))
}

fn excluded(old: &Palette, asked: &BTreeSet<&str>) -> Palette {
    let mut palette = old.clone();
    for id in sources(asked).map(literal) {
        // Of a list of clips, a clip is taken rather than taken back.
        if palette.include.len() > 1 && palette.include.contains(&id) {
            palette.include.retain(|pattern| *pattern != id);
        } else if !palette.exclude.contains(&id) {
            palette.exclude.push(id);
        }
    }
    palette
}

fn not_excluded(old: &Palette, asked: &BTreeSet<&str>) -> Palette {
    let gone: BTreeSet<String> = asked.iter().map(|id| literal(id)).collect();
    let mut palette = old.clone();
    palette.exclude.retain(|pattern| !gone.contains(pattern));
    palette
}

/// With a pattern for each clip that is asked for and not matched by any yet.
fn included(
    old: &Palette,
    clips: &[TaggedClip<'_>],
    wanted: &[bool],
    is_asked: &dyn Fn(&str) -> bool,
) -> Palette {
    let mut palette = old.clone();
    let Ok(matcher) = Matcher::new(Some(old)) else { return palette };
    for (clip, _) in clips.iter().zip(wanted).filter(|(_, wanted)| **wanted) {
        let covered = || palette.include.contains(&literal(source_of(clip.0)));
        if is_asked(clip.0) && !matcher.has(*clip) && !covered() {
            palette.include.push(literal(clip.0));
        }
    }
    palette
}

/// Patterns of `exclude` that keep out what is wanted become those of the clips that they still are
/// to keep out.
fn without_patterns_for(old: &Palette, clips: &[TaggedClip<'_>], wanted: &[bool]) -> Palette {
    let mut palette = Palette { exclude: Vec::new(), ..old.clone() };
    for pattern in &old.exclude {
        let Ok(set) = patterns(std::slice::from_ref(pattern)) else { continue };
        let matched = |id: &str| set.is_match(id) || set.is_match(source_of(id));
        let hit = || clips.iter().zip(wanted).filter(|((id, _), _)| matched(id));
        if hit().all(|(_, wanted)| !wanted) {
            palette.exclude.push(pattern.clone());
            continue;
        }
        for ((id, _), _) in hit().filter(|(_, wanted)| !**wanted) {
            let covered = palette.exclude.contains(&literal(source_of(id)));
            if !covered {
                palette.exclude.push(literal(id));
            }
        }
    }
    palette
}

/// Without tags and with what is out listed where that is the shorter list.
fn listed_exclusions(old: &Palette, clips: &[TaggedClip<'_>], wanted: &[bool]) -> Palette {
    let n_out = wanted.iter().filter(|wanted| !**wanted).count();
    let mut palette = Palette { tags: Vec::new(), exclude: Vec::new(), ..old.clone() };
    if 2 * n_out <= clips.len() {
        let out = clips.iter().zip(wanted).filter(|(_, wanted)| !**wanted);
        let out: BTreeSet<&str> = out.map(|((id, _), _)| *id).collect();
        palette.exclude.extend(sources(&out).map(literal));
    }
    palette
}

/// What is wanted, clip by clip.
fn listed(old: &Palette, clips: &[TaggedClip<'_>], wanted: &[bool]) -> Palette {
    let mut palette = Palette { extra: old.extra.clone(), ..everything() };
    let chosen = |on: bool| {
        let chosen = clips.iter().zip(wanted).filter(move |(_, wanted)| **wanted == on);
        chosen.map(|((id, _), _)| *id).collect::<BTreeSet<&str>>()
    };
    let (on, off) = (chosen(true), chosen(false));
    if on.is_empty() {
        // An empty list of patterns would be everything.
        palette.exclude = everything().include;
        return palette;
    }
    palette.include = sources(&on).map(literal).collect();
    let images = off.into_iter().filter(|id| id.ends_with(MIRROR_SUFFIX));
    palette.exclude = images.filter(|id| on.contains(source_of(id))).map(literal).collect();
    palette
}

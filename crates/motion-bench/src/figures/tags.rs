//! How often tags found in the motion agree with what clips are called.

use motion_bench::stopwatch::timed;
use motion_core::clip::Clip;
use motion_core::tags::{FOUND_TAGS, find};

use super::Bench;
use crate::table::Row;

/// A tag is promised to be found in this share of the clips that are called so.
const PROMISED_SHARE: f64 = 0.8;

/// The words by which a clip's name says that a tag is in it; a name with one of the second list
/// says something else.
fn says(tag: &str) -> (&'static [&'static str], &'static [&'static str]) {
    match tag {
        "walk" => (&["walk"], &[]),
        "run" => (&["run", "jog"], &[]),
        "idle" => (&["stop", "stand", "balance"], &[]),
        "backward" => (&["backward"], &[]),
        "sideways" => (&["sideways"], &[]),
        "turn left" => (&["left"], &["side"]),
        "turn right" => (&["right"], &["side"]),
        "crouch" => (&["duck", "crouch", "sit", "bend", "stealthily"], &[]),
        "jump" => (&["jump", "leap", "hop"], &[]),
        "fall" => (&["fall", "dive"], &[]),
        _ => (&[], &[]),
    }
}

fn is_named(clip: &Clip, tag: &str) -> bool {
    let (words, others) = says(tag);
    let has = |words: &[&str]| clip.tags.iter().any(|own| words.contains(&own.as_str()));
    has(words) && !has(others)
}

/// A row a tag: of the clips called so, those in which it was found; then those found that are
/// called so, and which are not.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let set = bench.source.load()?.set;
    let (_, spent) = timed(|| {
        for clip in set.clips() {
            std::hint::black_box(find(set.skeleton(), &clip.motion, &clip.track));
        }
    });
    let ids = |which: &dyn Fn(&&Clip) -> bool| {
        set.clips().iter().filter(which).map(|clip| clip.id.as_str()).collect::<Vec<_>>()
    };
    let row = |&tag: &&str| {
        let is_found = |clip: &Clip| clip.tag_spans.iter().any(|span| span.tag == tag);
        let named = ids(&|clip| is_named(clip, tag));
        let found = ids(&|clip| is_found(clip));
        let both = ids(&|clip| is_named(clip, tag) && is_found(clip));
        let missed = ids(&|clip| is_named(clip, tag) && !is_found(clip));
        let unnamed = ids(&|clip| !is_named(clip, tag) && is_found(clip));
        let mut notes = vec![format!("{} of {} found are called so", both.len(), found.len())];
        let mut list = |what: &str, ids: &[&str]| {
            if !ids.is_empty() {
                notes.push(format!("{what}: {}", ids.join(" ")));
            }
        };
        list("called so, not found", &missed);
        list("found, not called so", &unnamed);
        Row {
            figure: format!("tag {tag}"),
            target: "80 % of those called so",
            measured: format!("{} of {}", both.len(), named.len()),
            is_met: both.len() as f64 >= PROMISED_SHARE * named.len() as f64,
            spent,
            notes,
        }
    };
    Ok(FOUND_TAGS.iter().map(row).collect())
}

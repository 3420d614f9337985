//! Tags given by hand: `"tags": {"16_15": ["tired", {"tag": "limp", "from": 10, "to": 40}]}`.

use motion_core::tags::HandTag;
use motion_core::units::FrameIdx;
use serde_json::{Map, Value};

use super::model::{Extra, TagEntry};
use crate::diagnostic::FileError;
use crate::json::Node;
use crate::limits::{MAX_LIST, MAX_PROJECT_FRAMES};

pub(super) fn decode_tags(node: Node<'_>) -> Result<Vec<TagEntry>, FileError> {
    let mut entries = Vec::new();
    for (clip, list) in node.object()?.members() {
        for node in list.array(MAX_LIST)? {
            entries.push(decode_tag(clip, node)?);
        }
    }
    Ok(entries)
}

fn decode_tag(clip: &str, node: Node<'_>) -> Result<TagEntry, FileError> {
    let clip = clip.to_owned();
    if node.value().is_string() {
        let tag = HandTag { tag: node.name()?, frames: None };
        return Ok(TagEntry { clip, tag, extra: Extra::new() });
    }
    let mut object = node.object()?;
    let tag = object.require("tag", "\"tired\"")?.name()?;
    let from = object.get("from").map(|n| n.whole_number(MAX_PROJECT_FRAMES)).transpose()?;
    let to_node = object.get("to");
    let to = to_node.as_ref().map(|n| n.whole_number(MAX_PROJECT_FRAMES)).transpose()?;
    let frames = match (from, to) {
        (Some(from), Some(to)) if from <= to => Some((FrameIdx(from), FrameIdx(to))),
        (None, None) => None,
        _ => {
            let place = to_node.as_ref().unwrap_or(&object.node);
            let what = "does not end a stretch that begins";
            return Err(place.error(what, "write \"from\" and a \"to\" not before it, or neither"));
        }
    };
    Ok(TagEntry { clip, tag: HandTag { tag, frames }, extra: object.rest() })
}

/// A list per clip, clips in the order in which they come first.
pub(super) fn encode_tags(entries: &[TagEntry]) -> Value {
    let mut clips: Map<String, Value> = Map::new();
    for entry in entries {
        let list = clips.entry(entry.clip.clone()).or_insert_with(|| Value::Array(Vec::new()));
        if let Value::Array(list) = list {
            list.push(encode_tag(entry));
        }
    }
    Value::Object(clips)
}

fn encode_tag(entry: &TagEntry) -> Value {
    let text = Value::from(entry.tag.tag.as_str());
    if entry.tag.frames.is_none() && entry.extra.is_empty() {
        return text;
    }
    let mut members = Map::new();
    members.insert("tag".to_owned(), text);
    if let Some((from, to)) = entry.tag.frames {
        members.insert("from".to_owned(), from.0.into());
        members.insert("to".to_owned(), to.0.into());
    }
    members.extend(entry.extra.clone());
    Value::Object(members)
}

//! Kept takes under `"editor"` of a project file.
//!
//! Whatever else the file has there stays as it is and where it is.

use motion_io::project_file::Extra;
use serde_json::{Map, Value, json};

use super::by_hand_file::{self, alike};
use super::take::{StoredTake, TakeBook, TakeEntry, TakePiece};

const TAKES: &str = "takes";

/// Takes the list of takes out of an editor part and leaves an empty one in its place.
pub(super) fn take_out(editor: Option<&mut Value>) -> TakeBook {
    let list = editor.and_then(|editor| editor.get_mut(TAKES)).and_then(Value::as_array_mut);
    let entry = |value: Value| match decode(&value) {
        // Only what is written back as it was (10 may become 10.0) is understood.
        Some(take) if alike(&encode(&take), &value) => TakeEntry::Take(take),
        _ => TakeEntry::Strange(value),
    };
    let list = list.map(std::mem::take).unwrap_or_default();
    TakeBook { entries: list.into_iter().map(entry).collect() }
}

/// Puts the list of takes where it was, or at the end of the editor part.
pub(super) fn put_back(editor: Option<Value>, takes: &TakeBook) -> Option<Value> {
    let list = || -> Value {
        let entries = takes.entries.iter().map(|entry| match entry {
            TakeEntry::Take(take) => encode(take),
            TakeEntry::Strange(value) => value.clone(),
        });
        entries.collect::<Vec<_>>().into()
    };
    match editor {
        Some(Value::Object(mut members)) => {
            match members.get_mut(TAKES) {
                Some(place) if place.is_array() => *place = list(),
                // A list that was no list gives way to one as soon as there is one.
                Some(place) if !takes.entries.is_empty() => *place = list(),
                None if !takes.entries.is_empty() => drop(members.insert(TAKES.to_owned(), list())),
                _ => {}
            }
            Some(Value::Object(members))
        }
        strange if takes.entries.is_empty() => strange,
        strange => {
            let mut members = Map::new();
            if let Some(strange) = strange {
                members.insert("before".to_owned(), strange);
            }
            members.insert(TAKES.to_owned(), list());
            Some(Value::Object(members))
        }
    }
}

fn decode(value: &Value) -> Option<StoredTake> {
    let mut members = value.as_object()?.clone();
    let character = members.shift_remove("character")?.as_str()?.to_owned();
    let name = match members.shift_remove("name") {
        Some(name) => Some(name.as_str()?.to_owned()),
        None => None,
    };
    let pinned = members.shift_remove("pinned").is_some_and(|pinned| pinned == Value::Bool(true));
    let pieces = members.shift_remove("pieces")?;
    let pieces: Vec<TakePiece> =
        pieces.as_array()?.iter().map(decode_piece).collect::<Option<_>>()?;
    let by_hand = match members.shift_remove("by_hand") {
        Some(layer) => Some(by_hand_file::decode(&layer)?),
        None => None,
    };
    let in_order = pieces.iter().all(|piece| piece.from <= piece.to);
    (in_order && !pieces.is_empty()).then_some(StoredTake {
        character,
        name,
        pinned,
        pieces,
        by_hand,
        extra: members,
    })
}

fn decode_piece(value: &Value) -> Option<TakePiece> {
    let frame = |key| u32::try_from(value.get(key)?.as_u64()?).ok();
    Some(TakePiece {
        clip: value.get("clip")?.as_str()?.to_owned(),
        from: frame("from")?,
        to: frame("to")?,
    })
}

fn encode(take: &StoredTake) -> Value {
    let StoredTake { character, name, pinned, pieces, by_hand, extra } = take;
    let mut members: Extra = Map::new();
    members.insert("character".to_owned(), json!(character));
    if let Some(name) = name {
        members.insert("name".to_owned(), json!(name));
    }
    if *pinned {
        members.insert("pinned".to_owned(), json!(true));
    }
    let piece = |p: &TakePiece| json!({"clip": p.clip, "from": p.from, "to": p.to});
    members.insert("pieces".to_owned(), pieces.iter().map(piece).collect::<Vec<_>>().into());
    if let Some(layer) = by_hand {
        members.insert("by_hand".to_owned(), by_hand_file::encode(layer));
    }
    for (key, value) in extra {
        members.entry(key.clone()).or_insert_with(|| value.clone());
    }
    Value::Object(members)
}

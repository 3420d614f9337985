//! A take's changes by hand in a project file (`docs/files.md`).

use motion_core::by_hand::{Knot, Limb, Space};
use motion_io::project_file::Extra;
use serde_json::{Map, Value, json};

use super::by_hand::{ByHand, EditEntry, HandChange, HandEdit};

/// The layer that a value means; `None` where it is none. Edits that are not understood are kept.
pub(super) fn decode(value: &Value) -> Option<ByHand> {
    let mut members = value.as_object()?.clone();
    let mut layer = ByHand::default();
    if let Some(edits) = members.shift_remove("edits") {
        for value in edits.as_array()? {
            let understood = decode_edit(value)
                .is_some_and(|(id, edit, extra)| layer.push(id, edit, extra).is_ok());
            if !understood {
                layer.edits.push(EditEntry::Strange(value.clone()));
            }
        }
    }
    if let Some(knots) = members.shift_remove("retime") {
        let knots: Vec<Knot> = knots.as_array()?.iter().map(decode_knot).collect::<Option<_>>()?;
        layer.set_retime(&knots).ok()?;
    }
    layer.extra = members;
    Some(layer)
}

/// The value that means a layer.
pub(super) fn encode(layer: &ByHand) -> Value {
    let mut members = Map::new();
    let entry = |entry: &EditEntry| match entry {
        EditEntry::Edit { id, edit, extra } => encode_edit(id, edit, extra),
        EditEntry::Strange(value) => value.clone(),
    };
    if !layer.edits.is_empty() {
        let edits: Vec<Value> = layer.edits.iter().map(entry).collect();
        members.insert("edits".to_owned(), edits.into());
    }
    let knot = |knot: &Knot| json!({"output": knot.output, "source": knot.source});
    if !layer.retime.is_identity() {
        let knots: Vec<Value> = layer.retime.knots().iter().map(knot).collect();
        members.insert("retime".to_owned(), knots.into());
    }
    with(members, &layer.extra)
}

/// Whether two values are the same but for how numbers are written, to a millionth.
pub(super) fn alike(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => match (a.as_f64(), b.as_f64()) {
            (Some(a), Some(b)) => (a - b).abs() <= 1e-6,
            _ => a == b,
        },
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            let in_b = |(key, a): (&String, &Value)| b.get(key).is_some_and(|b| alike(a, b));
            a.len() == b.len() && a.iter().all(in_b)
        }
        _ => a == b,
    }
}

fn with(mut members: Extra, extra: &Extra) -> Value {
    for (key, value) in extra {
        members.entry(key.clone()).or_insert_with(|| value.clone());
    }
    Value::Object(members)
}

fn decode_edit(value: &Value) -> Option<(String, HandEdit, Extra)> {
    let mut members = value.as_object()?.clone();
    let id = members.shift_remove("id")?.as_str()?.to_owned();
    let change = match members.shift_remove("kind")?.as_str()? {
        "joint" => HandChange::Joint {
            joint: members.shift_remove("joint")?.as_str()?.to_owned(),
            turn_deg: numbers(&members.shift_remove("turn")?)?,
        },
        "hand" => {
            let limb = members.shift_remove("limb")?;
            let limb = Limb::ALL.into_iter().find(|l| limb == l.end_role().name())?;
            let shift_m = numbers(&members.shift_remove("shift")?)?;
            let space = match members.shift_remove("space")?.as_str()? {
                "world" => Space::World,
                "torso" => Space::Torso,
                _ => return None,
            };
            HandChange::Hand { limb, shift_m, space }
        }
        _ => return None,
    };
    let mut frame = |key| u32::try_from(members.shift_remove(key)?.as_u64()?).ok();
    let (from, to) = (frame("from")?, frame("to")?);
    let (ease_in, ease_out) = (frame("ease_in")?, frame("ease_out")?);
    Some((id, HandEdit { change, from, to, ease_in, ease_out }, members))
}

fn encode_edit(id: &str, edit: &HandEdit, extra: &Extra) -> Value {
    let HandEdit { change, from, to, ease_in, ease_out } = edit;
    let mut members = Map::new();
    let mut put = |key: &str, value: Value| drop(members.insert(key.to_owned(), value));
    put("id", json!(id));
    put("kind", json!(change.kind()));
    match change {
        HandChange::Joint { joint, turn_deg } => {
            put("joint", json!(joint));
            put("turn", json!(turn_deg));
        }
        HandChange::Hand { limb, shift_m, space } => {
            put("limb", json!(limb.end_role().name()));
            put("shift", json!(shift_m));
            let space = match space {
                Space::World => "world",
                Space::Torso => "torso",
            };
            put("space", json!(space));
        }
    }
    for (key, frame) in [("from", from), ("to", to), ("ease_in", ease_in), ("ease_out", ease_out)] {
        put(key, json!(frame));
    }
    with(members, extra)
}

fn decode_knot(value: &Value) -> Option<Knot> {
    let output = u32::try_from(value.get("output")?.as_u64()?).ok()?;
    Some(Knot { output, source: value.get("source")?.as_f64()? })
}

fn numbers(value: &Value) -> Option<[f64; 3]> {
    let numbers: Vec<f64> = value.as_array()?.iter().map(Value::as_f64).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

//! JSON laid out for people: what fits on a line stays on it.

use serde_json::{Map, Value};

/// Lines are at most this long where they can be, characters.
const MAX_WIDTH: usize = 100;

/// The text of `value` with a final newline.
///
/// Objects and lists that fit on a line are on one; others have a member or element a line,
/// indented by two blanks. The same value gives the same bytes, and they parse to it again.
pub fn to_pretty(value: &Value) -> String {
    let mut out = String::new();
    push(&mut out, value, 0, 0);
    out.push('\n');
    out
}

fn push(out: &mut String, value: &Value, indent: usize, used: usize) {
    let room = MAX_WIDTH.saturating_sub(indent + used + 1);
    match value {
        Value::Object(members) if !members.is_empty() => {
            // The outermost object is always open, so that projects differ line by line.
            if indent > 0 && push_inline(out, value, room) {
                return;
            }
            push_members(out, members, indent);
        }
        Value::Array(elements) if !elements.is_empty() => {
            if push_inline(out, value, room) {
                return;
            }
            out.push('[');
            for (idx, element) in elements.iter().enumerate() {
                new_line(out, idx, indent + 2);
                push(out, element, indent + 2, 0);
            }
            out.push('\n');
            out.push_str(&" ".repeat(indent));
            out.push(']');
        }
        scalar_or_empty => out.push_str(&scalar_or_empty.to_string()),
    }
}

fn push_members(out: &mut String, members: &Map<String, Value>, indent: usize) {
    out.push('{');
    for (idx, (key, value)) in members.iter().enumerate() {
        new_line(out, idx, indent + 2);
        let key = Value::from(key.as_str()).to_string();
        out.push_str(&key);
        out.push_str(": ");
        push(out, value, indent + 2, key.chars().count() + 2);
    }
    out.push('\n');
    out.push_str(&" ".repeat(indent));
    out.push('}');
}

fn new_line(out: &mut String, idx: usize, indent: usize) {
    out.push_str(if idx > 0 { ",\n" } else { "\n" });
    out.push_str(&" ".repeat(indent));
}

/// Appends `value` on one line if it takes at most `room` bytes; otherwise leaves `out` alone.
fn push_inline(out: &mut String, value: &Value, room: usize) -> bool {
    let start = out.len();
    let fits = inline(out, value, start + room);
    if !fits {
        out.truncate(start);
    }
    fits
}

/// Gives up as soon as `out` is longer than `end`, so that a large value costs a line only.
fn inline(out: &mut String, value: &Value, end: usize) -> bool {
    match value {
        Value::Object(members) => {
            out.push('{');
            for (idx, (key, value)) in members.iter().enumerate() {
                if idx > 0 {
                    out.push_str(", ");
                }
                out.push_str(&Value::from(key.as_str()).to_string());
                out.push_str(": ");
                if !inline(out, value, end) {
                    return false;
                }
            }
            out.push('}');
        }
        Value::Array(elements) => {
            out.push('[');
            for (idx, element) in elements.iter().enumerate() {
                if idx > 0 {
                    out.push_str(", ");
                }
                if !inline(out, element, end) {
                    return false;
                }
            }
            out.push(']');
        }
        scalar => out.push_str(&scalar.to_string()),
    }
    out.len() <= end
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn short_things_share_a_line_and_long_ones_do_not() {
        let value = json!({
            "name": "a",
            "empty": {},
            "constraints": [
                {"kind": "body", "frame": 0, "position": [0.0, 1.5], "heading": 90.0},
                {"kind": "style", "from": 0, "to": 90, "tag": "run with a rather long name", "weight": 1.0,
                 "id": "c1"},
            ],
        });
        let expected = r#"{
  "name": "a",
  "empty": {},
  "constraints": [
    {"kind": "body", "frame": 0, "position": [0.0, 1.5], "heading": 90.0},
    {
      "kind": "style",
      "from": 0,
      "to": 90,
      "tag": "run with a rather long name",
      "weight": 1.0,
      "id": "c1"
    }
  ]
}
"#;
        assert_eq!(to_pretty(&value), expected);
    }

    #[test]
    fn what_is_written_parses_to_the_same() {
        let value =
            json!({"a": [[1, [2.5, null]], "\u{1}\"\\", true], "b": (0..90).collect::<Vec<_>>()});
        assert_eq!(serde_json::from_str::<Value>(&to_pretty(&value)).unwrap(), value);
    }
}

//! Joint names, read: which side a joint is on and which word is left for the part.

use crate::contacts::Side;

/// What a joint's name says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The side, where the name has a marker for one.
    pub side: Option<Side>,
    /// The rest of the name in lower case, without prefixes, separators and leading zeros of
    /// numbers: `upleg`, `spine1`.
    pub word: String,
}

/// Reads a joint's name.
///
/// | name | side | word |
/// | --- | --- | --- |
/// | `mixamorig:LeftUpLeg` | left | `upleg` |
/// | `J_Bip_R_LowerArm` | right | `lowerarm` |
/// | `Bip01 L Thigh` | left | `thigh` |
/// | `spine_01` | none | `spine1` |
/// | `DEF-upper_arm.R` | right | `upperarm` |
/// | `LHipJoint` | left | `hipjoint` |
/// | `lfemur` | left | `femur` |
///
/// A side is a token `left`, `l`, `lft` (or the right's) of its own, or the letter before one of
/// the few words that motion capture systems run together (`lfemur`).
pub fn read(name: &str) -> Part {
    let local = name.rsplit([':', '|']).next().unwrap_or(name);
    let mut tokens = tokens(local);
    drop_prefixes(&mut tokens);
    let side_at = tokens.iter().position(|token| side_of(token).is_some());
    let mut side = None;
    // A name that is nothing but a side letter says nothing.
    if let Some(at) = side_at.filter(|_| tokens.len() > 1) {
        side = side_of(&tokens.remove(at));
    }
    if tokens.len() > 1 && tokens.last().is_some_and(|last| last == "bend") {
        tokens.pop();
    }
    let mut word = tokens.concat();
    if side.is_none()
        && let Some(rest) = word.strip_prefix(['l', 'r'])
        && RUN_TOGETHER.contains(&rest)
    {
        side = Some(if word.starts_with('l') { Side::Left } else { Side::Right });
        word = rest.to_owned();
    }
    Part { side, word }
}

/// Words that ASF files write after a bare `l` or `r`.
const RUN_TOGETHER: &[&str] = &[
    "hipjoint", "femur", "tibia", "foot", "toes", "clavicle", "humerus", "radius", "wrist", "hand",
    "fingers", "thumb", "thigh", "shin", "calf", "upleg", "lowleg", "ankle", "toe", "shoulder",
    "upperarm", "forearm", "elbow", "knee", "hip", "collar", "shldr",
];

fn side_of(token: &str) -> Option<Side> {
    match token {
        "left" | "l" | "lft" | "lf" => Some(Side::Left),
        "right" | "r" | "rgt" | "rt" => Some(Side::Right),
        _ => None,
    }
}

/// Removes what rigs put before the name proper, as long as something is left.
fn drop_prefixes(tokens: &mut Vec<String>) {
    while tokens.len() > 1 {
        let first = tokens[0].trim_end_matches(|c: char| c.is_ascii_digit());
        let pair = (tokens[0].as_str(), tokens[1].as_str());
        let n_dropped = match (first, pair) {
            (_, ("cc", "base")) if tokens.len() > 2 => 2,
            ("mixamorig" | "bip" | "character" | "j" | "c" | "def" | "org" | "jnt" | "bn", _) => 1,
            ("valvebiped" | "armature" | "skeleton" | "bone" | "joint" | "avatar", _) => 1,
            _ => return,
        };
        tokens.drain(..n_dropped);
    }
}

/// The name cut at separators and where camel case turns, in lower case.
fn tokens(name: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    let mut current = String::new();
    let chars: Vec<char> = name.chars().collect();
    for (idx, &c) in chars.iter().enumerate() {
        if !c.is_alphanumeric() {
            flush(&mut current, &mut tokens);
            continue;
        }
        let before = idx.checked_sub(1).map(|before| chars[before]);
        let next_is_lower = chars.get(idx + 1).is_some_and(|next| next.is_lowercase());
        let turns = c.is_uppercase()
            && before.is_some_and(|b| !b.is_uppercase() || (b.is_uppercase() && next_is_lower));
        if turns {
            flush(&mut current, &mut tokens);
        }
        current.extend(c.to_lowercase());
    }
    flush(&mut current, &mut tokens);
    tokens
}

fn flush(current: &mut String, tokens: &mut Vec<String>) {
    if current.is_empty() {
        return;
    }
    let token = std::mem::take(current);
    let stem = token.trim_end_matches(|c: char| c.is_ascii_digit());
    let number = &token[stem.len()..];
    let significant = number.trim_start_matches('0');
    // `01` is 1, and 0 stays 0.
    let number = if significant.is_empty() && !number.is_empty() { "0" } else { significant };
    tokens.push(format!("{stem}{number}"));
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[track_caller]
    fn check(name: &str, side: Option<Side>, word: &str) {
        assert_eq!(read(name), Part { side, word: word.to_owned() }, "{name:?}");
    }

    #[test]
    fn names_of_many_tools() {
        let (left, right) = (Some(Side::Left), Some(Side::Right));
        check("mixamorig:LeftUpLeg", left, "upleg");
        check("J_Bip_R_LowerArm", right, "lowerarm");
        check("Bip01 L Thigh", left, "thigh");
        check("spine_01", None, "spine1");
        check("DEF-upper_arm.R", right, "upperarm");
        check("LHipJoint", left, "hipjoint");
        check("lfemur", left, "femur");
        check("CC_Base_L_Thigh", left, "thigh");
        check("lThighBend", left, "thigh");
        check("LeftHandIndex1", left, "handindex1");
        check("L5", None, "l5");
        check("leg", None, "leg");
        check("L", None, "l");
        check("ns|a:b:Head", None, "head");
        check("", None, "");
    }

    proptest! {
        #[test]
        fn any_name_is_read(name in ".{0,40}") {
            let part = read(&name);
            prop_assert!(part.word.chars().all(|c| !c.is_uppercase() || c.to_lowercase().eq([c])));
        }
    }
}

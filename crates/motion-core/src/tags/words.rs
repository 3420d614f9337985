//! When one tag means another.
//!
//! Tags are compared word by word, small and capital letters alike: what is asked for is there if
//! each of its words is. So `turn` is had by whatever turns left or right, and a clip whose name
//! says `left` and `turn` has `turn left`.

/// The words of a tag: `turn_left` and `Turn left` have the same.
pub fn words(tag: &str) -> impl Iterator<Item = &str> {
    tag.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty())
}

/// Whether what is tagged with `given` is what is asked for: each word of `asked` is among those
/// given. Nothing has a tag without words.
pub fn has_words<'a>(asked: &str, given: impl IntoIterator<Item = &'a str> + Clone) -> bool {
    let is_given = |word: &str| {
        let mut all = given.clone().into_iter().flat_map(words);
        // Asked of every frame of a library: nothing is allocated.
        let letters = |text: &'a str| text.chars().flat_map(char::to_lowercase);
        all.any(|own| letters(own).eq(word.chars().flat_map(char::to_lowercase)))
    };
    words(asked).next().is_some() && words(asked).all(is_given)
}

/// The tag as it is in the mirror: its words `left` and `right` exchanged.
pub fn mirrored(tag: &str) -> String {
    let mut image = String::with_capacity(tag.len());
    let mut word = String::new();
    for c in tag.chars() {
        if c.is_alphanumeric() {
            word.push(c);
        } else {
            image.push_str(image_of(&word));
            image.push(c);
            word.clear();
        }
    }
    image.push_str(image_of(&word));
    image
}

fn image_of(word: &str) -> &str {
    match word {
        "left" => "right",
        "right" => "left",
        "Left" => "Right",
        "Right" => "Left",
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_that_is_asked_for_must_be_there() {
        for (asked, given, has) in [
            ("run", &["run", "jog"][..], true),
            ("Run", &["run"], true),
            ("turn", &["turn left"], true),
            ("turn_left", &["walk", "left", "turn"], true),
            ("turn left", &["turn right"], false),
            ("runner", &["run"], false),
            ("", &["run"], false),
            ("run", &[], false),
        ] {
            assert_eq!(has_words(asked, given.iter().copied()), has, "{asked:?} of {given:?}");
        }
    }

    #[test]
    fn left_is_right_in_the_mirror() {
        for (tag, image) in [
            ("turn left", "turn right"),
            ("Right", "Left"),
            ("leftover", "leftover"),
            ("left-right", "right-left"),
            ("tired", "tired"),
        ] {
            assert_eq!(mirrored(tag), image);
            assert_eq!(mirrored(image), tag);
        }
    }
}

//! On which line of a JSON text a value stands.

/// One step from a value into a part of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// The member of an object.
    Key(String),
    /// The element of an array.
    Index(usize),
}

/// The line (from 1) on which the value at `steps` begins, or its key for a member of an object.
/// Where the text has no such value, the line of the innermost one on the way that it has.
///
/// `text` must be valid JSON; on anything else some line comes out.
pub(super) fn line_of(text: &[u8], steps: &[Step]) -> u32 {
    let mut scan = Scan { text, at: 0 };
    scan.skip_blanks();
    let mut found = scan.at;
    for step in steps {
        match scan.enter(step) {
            Some(at) => found = at,
            None => break,
        }
    }
    line_at(text, found)
}

/// The line (from 1) of byte `at`.
pub(super) fn line_at(text: &[u8], at: usize) -> u32 {
    let n_ends = text[..at.min(text.len())].iter().filter(|&&b| b == b'\n').count();
    u32::try_from(n_ends).unwrap_or(u32::MAX - 1) + 1
}

struct Scan<'a> {
    text: &'a [u8],
    at: usize,
}

impl Scan<'_> {
    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    fn skip_blanks(&mut self) {
        while self.peek().is_some_and(|b| b.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    /// Moves to the value behind `step`; where its key or it begins, if it is there.
    fn enter(&mut self, step: &Step) -> Option<usize> {
        let is_object = matches!(step, Step::Key(_));
        if self.peek()? != if is_object { b'{' } else { b'[' } {
            return None;
        }
        self.at += 1;
        let mut found = None;
        for idx in 0.. {
            self.skip_blanks();
            if matches!(self.peek()?, b'}' | b']') {
                break;
            }
            let start = self.at;
            let mut hit = *step == Step::Index(idx);
            if is_object {
                let key = self.string()?;
                hit = matches!(step, Step::Key(wanted) if serde_json::from_slice::<String>(key)
                    .is_ok_and(|key| key == *wanted));
                self.skip_blanks();
                self.at += 1;
                self.skip_blanks();
            }
            if hit {
                // Of members with the same key the last one counts, so the search goes on.
                found = Some((start, self.at));
                if !is_object {
                    break;
                }
            }
            self.skip_value()?;
            self.skip_blanks();
            if self.peek()? == b',' {
                self.at += 1;
            }
        }
        let (start, value) = found?;
        self.at = value;
        Some(start)
    }

    /// Steps over the string that begins here and returns it with its quotes.
    fn string(&mut self) -> Option<&[u8]> {
        let start = self.at;
        self.at += 1;
        loop {
            match self.peek()? {
                b'\\' => self.at += 2,
                b'"' => break,
                _ => self.at += 1,
            }
        }
        self.at += 1;
        self.text.get(start..self.at)
    }

    fn skip_value(&mut self) -> Option<()> {
        let mut depth = 0usize;
        loop {
            match self.peek()? {
                b'"' => {
                    self.string()?;
                }
                b'{' | b'[' => {
                    depth += 1;
                    self.at += 1;
                }
                b'}' | b']' => {
                    depth = depth.checked_sub(1)?;
                    self.at += 1;
                }
                b',' | b':' if depth > 0 => self.at += 1,
                b if b.is_ascii_whitespace() => self.at += 1,
                _ => {
                    let is_end = |b: u8| matches!(b, b',' | b'}' | b']') || b.is_ascii_whitespace();
                    while self.peek().is_some_and(|b| !is_end(b)) {
                        self.at += 1;
                    }
                }
            }
            if depth == 0 {
                return Some(());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"
{
  "a": [1, {"x": "}\"]"},
    -2.5e3,
    {
      "key \u0041": [
        true]
    }],
  "b": 1,
  "b":
    null
}"#;

    #[track_caller]
    fn check(steps: &[Step], line: u32) {
        assert_eq!(line_of(TEXT.as_bytes(), steps), line, "{steps:?}");
    }

    fn key(name: &str) -> Step {
        Step::Key(name.to_owned())
    }

    #[test]
    fn values_are_found_on_their_lines() {
        check(&[], 2);
        check(&[key("a")], 3);
        check(&[key("a"), Step::Index(1), key("x")], 3);
        check(&[key("a"), Step::Index(2)], 4);
        check(&[key("a"), Step::Index(3)], 5);
        check(&[key("a"), Step::Index(3), key("key A")], 6);
        check(&[key("a"), Step::Index(3), key("key A"), Step::Index(0)], 7);
    }

    #[test]
    fn of_double_keys_the_last_counts() {
        check(&[key("b")], 10);
    }

    #[test]
    fn what_is_missing_is_where_it_would_be() {
        check(&[key("c")], 2);
        check(&[key("a"), Step::Index(9)], 3);
        check(&[key("a"), Step::Index(3), key("none"), key("none")], 5);
    }

    #[test]
    fn broken_texts_give_some_line() {
        for cut in 0..TEXT.len() {
            line_of(&TEXT.as_bytes()[..cut], &[key("a"), Step::Index(3), key("key A")]);
        }
    }
}

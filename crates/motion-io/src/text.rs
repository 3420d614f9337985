//! A reader of words and lines that always knows its line number. Shared by the text formats.
//!
//! Lines end with LF, CR LF or a lone CR; the last one needs no end. Words are separated by
//! spaces and tabs. A UTF-8 byte order mark at the start is skipped. Nothing need be UTF-8: the
//! formats are ASCII but for names, which callers decode with replacement characters.

/// A place in a text.
#[derive(Clone, Debug)]
pub struct Text<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u32,
}

/// A line without its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line<'a> {
    /// Counted from 1.
    pub number: u32,
    /// What stands on it.
    pub bytes: &'a [u8],
}

impl<'a> Line<'a> {
    /// The words of the line.
    pub fn words(self) -> impl Iterator<Item = &'a [u8]> {
        self.bytes.split(|&b| is_blank(b)).filter(|word| !word.is_empty())
    }

    /// Whether there is no word on it.
    pub fn is_blank(self) -> bool {
        self.bytes.iter().all(|&b| is_blank(b))
    }
}

/// A word and the line it stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word<'a> {
    /// Counted from 1.
    pub line: u32,
    /// The word itself, not empty.
    pub bytes: &'a [u8],
}

impl Word<'_> {
    /// Whether the word is `keyword`, in capitals or not.
    pub fn is(&self, keyword: &str) -> bool {
        self.bytes.eq_ignore_ascii_case(keyword.as_bytes())
    }
}

impl<'a> Text<'a> {
    /// The start of `bytes`, behind a UTF-8 byte order mark.
    pub fn new(bytes: &'a [u8]) -> Self {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        Self { bytes, at: 0, line: 1 }
    }

    /// The line of the next byte, counted from 1; at the end, the last line.
    pub fn line(&self) -> u32 {
        self.line
    }

    /// How many bytes are left.
    pub fn remaining_bytes(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The next word; braces are words of their own wherever they stand. `None` at the end.
    pub fn next_word(&mut self) -> Option<Word<'a>> {
        self.skip_blanks(true);
        self.word_here()
    }

    /// The next word on this line; `None` when the line has no more.
    pub fn next_word_on_line(&mut self) -> Option<Word<'a>> {
        self.skip_blanks(false);
        match self.peek()? {
            b'\n' | b'\r' => None,
            _ => self.word_here(),
        }
    }

    /// The next word, without taking it.
    pub fn peek_word(&self) -> Option<Word<'a>> {
        self.clone().next_word()
    }

    /// What stands on this line before its end or a brace, without blanks around it.
    pub fn rest_of_line_to_brace(&mut self) -> Word<'a> {
        let rest = &self.bytes[self.at..];
        let len = rest
            .iter()
            .position(|b| matches!(b, b'\n' | b'\r' | b'{' | b'}'))
            .unwrap_or(rest.len());
        self.at += len;
        Word { line: self.line, bytes: rest[..len].trim_ascii() }
    }

    /// The rest of this line, whose end is taken too; `None` at the end of the text.
    pub fn next_line(&mut self) -> Option<Line<'a>> {
        let rest = &self.bytes[self.at..];
        if rest.is_empty() {
            return None;
        }
        let number = self.line;
        let len = rest.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(rest.len());
        self.at += len;
        self.take_line_end();
        Some(Line { number, bytes: &rest[..len] })
    }

    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn skip_blanks(&mut self, over_lines: bool) {
        while let Some(byte) = self.peek() {
            match byte {
                b'\n' | b'\r' if over_lines => self.take_line_end(),
                b'\n' | b'\r' => return,
                byte if is_blank(byte) => self.at += 1,
                _ => return,
            }
        }
    }

    /// Steps over CR LF, CR or LF, if one is here.
    fn take_line_end(&mut self) {
        let rest = &self.bytes[self.at..];
        let len = match rest {
            [b'\r', b'\n', ..] => 2,
            [b'\r' | b'\n', ..] => 1,
            _ => return,
        };
        self.at += len;
        // The last line's end begins no further line, so errors there name a line that exists.
        if self.at < self.bytes.len() {
            self.line = self.line.saturating_add(1);
        }
    }

    fn word_here(&mut self) -> Option<Word<'a>> {
        let rest = &self.bytes[self.at..];
        let len = match rest {
            [] => return None,
            [b'{' | b'}', ..] => 1,
            _ => rest
                .iter()
                .position(|&b| is_blank(b) || matches!(b, b'\n' | b'\r' | b'{' | b'}'))
                .unwrap_or(rest.len()),
        };
        self.at += len;
        Some(Word { line: self.line, bytes: &rest[..len] })
    }
}

/// Blanks within a line. A NUL is none: it betrays a binary file.
fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\x0b' | b'\x0c')
}

/// The number that a word is: decimal, scientific, or what C prints for no number at all (`nan`,
/// `inf`), which callers must refuse. `None` for anything else.
#[inline]
pub fn parse_number(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Whether `value` lies within ±`limit`; what is not a number does not.
#[inline]
pub fn within(value: f64, limit: f64) -> bool {
    (-limit..=limit).contains(&value)
}

/// How many decimal places a number is written with, for how far it may have been rounded:
/// 7 for `0.0083333` and for `8.3333e-3`, 0 for `1`. `None` for an exponent out of all bounds.
pub fn decimal_places(word: &[u8]) -> Option<i32> {
    let (mantissa, exponent) = match word.iter().position(|b| matches!(b, b'e' | b'E')) {
        Some(at) => (&word[..at], std::str::from_utf8(&word[at + 1..]).ok()?.parse::<i32>().ok()?),
        None => (word, 0),
    };
    let places = match mantissa.iter().position(|&b| b == b'.') {
        Some(dot) => i32::try_from(mantissa.len() - dot - 1).ok()?,
        None => 0,
    };
    places.checked_sub(exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<(u32, String)> {
        let mut text = Text::new(text.as_bytes());
        let mut all = Vec::new();
        while let Some(word) = text.next_word() {
            all.push((word.line, String::from_utf8_lossy(word.bytes).into_owned()));
        }
        all
    }

    #[track_caller]
    fn check_words(text: &str, expected: &[(u32, &str)]) {
        let expected: Vec<_> = expected.iter().map(|&(l, w)| (l, w.to_owned())).collect();
        assert_eq!(words(text), expected, "{text:?}");
    }

    #[test]
    fn every_kind_of_line_end_counts_once() {
        check_words("a\nb\r\nc\rd", &[(1, "a"), (2, "b"), (3, "c"), (4, "d")]);
        check_words("a\r\n\r\n\n\rb\n", &[(1, "a"), (5, "b")]);
    }

    #[test]
    fn braces_stand_alone() {
        check_words(
            "ROOT a{OFFSET\t1}",
            &[(1, "ROOT"), (1, "a"), (1, "{"), (1, "OFFSET"), (1, "1"), (1, "}")],
        );
    }

    #[test]
    fn a_byte_order_mark_is_no_word() {
        check_words("\u{feff}HIERARCHY", &[(1, "HIERARCHY")]);
    }

    #[test]
    fn names_run_to_the_line_end_or_a_brace() {
        let mut text = Text::new(b"JOINT  Left Arm \t{\r\nJOINT x\r\n");
        text.next_word();
        assert_eq!(text.rest_of_line_to_brace().bytes, b"Left Arm");
        assert_eq!(text.next_word().map(|w| w.bytes), Some(&b"{"[..]));
        text.next_word();
        assert_eq!(text.rest_of_line_to_brace(), Word { line: 2, bytes: b"x" });
    }

    #[test]
    fn lines_with_and_without_an_end() {
        for text in ["1 2\r3\t4", "1 2\r\n3\t4\r\n", "1 2\n3\t4\n"] {
            let mut text = Text::new(text.as_bytes());
            let first = text.next_line().unwrap();
            assert_eq!((first.number, first.words().count()), (1, 2));
            let second = text.next_line().unwrap();
            assert_eq!((second.number, second.words().count()), (2, 2));
            assert_eq!(text.next_line(), None);
            assert_eq!(text.line(), 2, "the last line is the last that exists");
        }
    }

    #[test]
    fn words_on_a_line_stop_at_its_end() {
        let mut text = Text::new(b"a\nb");
        assert!(text.next_word_on_line().is_some());
        assert_eq!(text.next_word_on_line(), None);
        assert_eq!(text.peek_word().map(|w| w.line), Some(2));
    }

    #[test]
    fn numbers_in_every_spelling() {
        for (word, value) in
            [("1", 1.0), ("-.5", -0.5), ("+2.5E-3", 0.0025), ("1e2", 100.0), ("3.", 3.0)]
        {
            assert_eq!(parse_number(word.as_bytes()), Some(value), "{word}");
        }
        for word in ["", "1,5", "0x10", "1.2.3", "--1", "\u{fffd}"] {
            assert_eq!(parse_number(word.as_bytes()), None, "{word}");
        }
    }

    #[test]
    fn decimal_places_tell_the_rounding() {
        for (word, places) in [("0.0083333", 7), ("8.3333e-3", 7), ("1", 0), (".5", 1), ("1e2", -2)]
        {
            assert_eq!(decimal_places(word.as_bytes()), Some(places), "{word}");
        }
        assert_eq!(decimal_places(b"1e-99999999999"), None);
    }
}

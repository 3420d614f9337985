//! A JSON value that knows where it stands, so that what is wrong with it can be said.

use std::cell::RefCell;
use std::path::Path;

use serde_json::{Map, Value};

use super::locate::{Step, line_of};
use crate::diagnostic::{FileError, Warnings};
use crate::text::within;

/// The text that values come from.
pub(crate) struct Document<'a> {
    /// Named in messages.
    pub(crate) path: &'a Path,
    /// For line numbers.
    pub(crate) text: &'a [u8],
    /// Unknown keys and the like.
    pub(crate) warnings: RefCell<&'a mut Warnings>,
}

/// A value and the way to it.
#[derive(Clone)]
pub(crate) struct Node<'a> {
    document: &'a Document<'a>,
    value: &'a Value,
    steps: Vec<Step>,
}

impl<'a> Node<'a> {
    /// The whole document.
    pub(crate) fn root(document: &'a Document<'a>, value: &'a Value) -> Self {
        Self { document, value, steps: Vec::new() }
    }

    fn child(&self, step: Step, value: &'a Value) -> Self {
        let mut steps = self.steps.clone();
        steps.push(step);
        Self { document: self.document, value, steps }
    }

    /// The value as it stands.
    pub(crate) fn value(&self) -> &'a Value {
        self.value
    }

    /// How messages call the value: `characters[0].length`.
    pub(crate) fn place(&self) -> String {
        let mut place = String::new();
        for step in &self.steps {
            match step {
                Step::Key(key) if place.is_empty() => place.push_str(key),
                Step::Key(key) => {
                    place.push('.');
                    place.push_str(key);
                }
                Step::Index(idx) => place.push_str(&format!("[{idx}]")),
            }
        }
        if place.is_empty() { "the file".to_owned() } else { place }
    }

    fn line(&self) -> u32 {
        line_of(self.document.text, &self.steps)
    }

    /// `PLACE what; what to do`, at the value's line.
    pub(crate) fn error(&self, what: impl AsRef<str>, what_to_do: impl Into<String>) -> FileError {
        let what = format!("{} {}", self.place(), what.as_ref());
        FileError::new(self.document.path, what, what_to_do).at_line(self.line())
    }

    /// `PLACE what`, at the value's line.
    pub(crate) fn warn(&self, what: impl AsRef<str>) {
        let what = format!("{} {}", self.place(), what.as_ref());
        self.document.warnings.borrow_mut().warn(self.document.path, Some(self.line()), what);
    }

    /// The value as an object.
    pub(crate) fn object(self) -> Result<Object<'a>, FileError> {
        match self.value {
            Value::Object(map) => Ok(Object { map, known: Vec::new(), node: self }),
            _ => Err(self.error("is not an object", "write {…}")),
        }
    }

    /// The elements of an array of at most `max_len`.
    pub(crate) fn array(&self, max_len: usize) -> Result<Vec<Self>, FileError> {
        let Value::Array(values) = self.value else {
            return Err(self.error("is not a list", "write […]"));
        };
        if values.len() > max_len {
            return Err(self.error(
                format!("has {} entries, more than {max_len}", values.len()),
                "split the project",
            ));
        }
        Ok(values.iter().enumerate().map(|(i, v)| self.child(Step::Index(i), v)).collect())
    }

    /// The value as text.
    pub(crate) fn string(&self) -> Result<String, FileError> {
        match self.value {
            Value::String(text) => Ok(text.clone()),
            _ => Err(self.error("is not a text", "write it in \"quotes\"")),
        }
    }

    /// The value as text that is not empty.
    pub(crate) fn name(&self) -> Result<String, FileError> {
        let name = self.string()?;
        if name.trim().is_empty() {
            return Err(self.error("is empty", "write a name"));
        }
        Ok(name)
    }

    /// The elements as texts.
    pub(crate) fn strings(&self, max_len: usize) -> Result<Vec<String>, FileError> {
        self.array(max_len)?.iter().map(Self::string).collect()
    }

    /// The value as `true` or `false`.
    pub(crate) fn boolean(&self) -> Result<bool, FileError> {
        match self.value {
            Value::Bool(value) => Ok(*value),
            _ => Err(self.error("is neither true nor false", "write true or false")),
        }
    }

    /// A number within ±`limit`.
    pub(crate) fn number(&self, limit: f64) -> Result<f64, FileError> {
        let Some(value) = self.value.as_f64() else {
            return Err(self.error("is not a number", "write a number like 1.5"));
        };
        if !within(value, limit) {
            return Err(self.error(
                format!("is {value}, which is not within ±{limit}"),
                "write a smaller number",
            ));
        }
        Ok(value)
    }

    /// A number from 0 to `limit`.
    pub(crate) fn number_from_zero(&self, limit: f64) -> Result<f64, FileError> {
        let value = self.number(limit)?;
        if value < 0.0 {
            return Err(self.error(format!("is {value}, below 0"), "write 0 or more"));
        }
        Ok(value)
    }

    /// `N` numbers within ±`limit`.
    pub(crate) fn numbers<const N: usize>(&self, limit: f64) -> Result<[f64; N], FileError> {
        let wrong = |n: usize| {
            self.error(
                format!("has {n} numbers instead of {N}"),
                if N == 2 { "write [x, z]" } else { "write [x, y, z]" },
            )
        };
        let elements = match self.value {
            Value::Array(values) if values.len() == N => self.array(N)?,
            Value::Array(values) => return Err(wrong(values.len())),
            _ => return Err(self.error("is not a list of numbers", "write [x, z] or [x, y, z]")),
        };
        let mut numbers = [0.0; N];
        for (number, element) in numbers.iter_mut().zip(&elements) {
            *number = element.number(limit)?;
        }
        Ok(numbers)
    }

    /// A whole number below `limit`.
    pub(crate) fn whole_number(&self, limit: u32) -> Result<u32, FileError> {
        // 12.0 is a whole number too: some programs know no other.
        let value = self.value.as_f64().filter(|v| v.fract() == 0.0);
        let Some(value) = value else {
            return Err(self.error("is not a whole number", "write a number like 12"));
        };
        if !(0.0..f64::from(limit)).contains(&value) {
            return Err(self.error(
                format!("is {value}, which is not from 0 to {}", limit - 1),
                "correct the number",
            ));
        }
        Ok(value as u32)
    }

    /// A whole number of 64 bits.
    pub(crate) fn seed(&self) -> Result<u64, FileError> {
        self.value.as_u64().ok_or_else(|| {
            self.error("is not a whole number from 0 to 2^64 - 1", "write a number like 1")
        })
    }
}

/// An object whose keys are ticked off.
pub(crate) struct Object<'a> {
    /// The object itself, for messages about it.
    pub(crate) node: Node<'a>,
    map: &'a Map<String, Value>,
    known: Vec<&'static str>,
}

impl<'a> Object<'a> {
    /// The member `key`; `null` counts as left out.
    pub(crate) fn get(&mut self, key: &'static str) -> Option<Node<'a>> {
        self.known.push(key);
        let value = self.map.get(key).filter(|value| !value.is_null())?;
        Some(self.node.child(Step::Key(key.to_owned()), value))
    }

    /// The member `key`, which must be there; `example` shows how it looks.
    pub(crate) fn require(
        &mut self,
        key: &'static str,
        example: &str,
    ) -> Result<Node<'a>, FileError> {
        self.get(key).ok_or_else(|| {
            self.node.error(format!("has no \"{key}\""), format!("add \"{key}\": {example}"))
        })
    }

    /// Every member, in the file's order.
    pub(crate) fn members(&mut self) -> Vec<(&'a str, Node<'a>)> {
        let node = &self.node;
        self.map
            .iter()
            .map(|(key, value)| (key.as_str(), node.child(Step::Key(key.clone()), value)))
            .collect()
    }

    /// The members that nobody asked for, each with a warning.
    pub(crate) fn rest(self) -> Map<String, Value> {
        let mut rest = Map::new();
        for (key, value) in self.map {
            if self.known.contains(&key.as_str()) {
                continue;
            }
            let member = self.node.child(Step::Key(key.clone()), value);
            member.warn("is an unknown key; it is kept");
            rest.insert(key.clone(), value.clone());
        }
        rest
    }
}

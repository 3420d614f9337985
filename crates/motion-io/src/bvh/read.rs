//! The hierarchy of a BVH file.

use std::collections::HashSet;
use std::path::Path;

use glam::DVec3;

use super::frames::read_frames;
use super::{Axis, Bvh, BvhJoint, Channel};
use crate::diagnostic::{FileError, Warnings, quoted};
use crate::limits;
use crate::text::{Text, Word, parse_number, within};

/// Reads the text of a BVH file.
///
/// `path` is named in messages only. Fails with the line on anything that is not a whole BVH
/// file within the [limits]; never panics, whatever the bytes.
pub fn read(bytes: &[u8], path: &Path, warnings: &mut Warnings) -> Result<Bvh, FileError> {
    let mut reader = Reader { text: Text::new(bytes), path, warnings };
    reader.expect_hierarchy(bytes)?;
    let joints = reader.joints()?;
    let n_channels = joints.iter().map(|j| j.channels.len()).sum();
    if n_channels == 0 {
        return Err(reader.error(
            reader.text.line(),
            "no joint has channels, so nothing can move",
            "export the file with joint rotations",
        ));
    }
    let (fps, values) = read_frames(&mut reader.text, n_channels, path)?;
    Ok(Bvh { joints, fps, n_channels, values })
}

struct Reader<'a, 'w> {
    text: Text<'a>,
    path: &'a Path,
    warnings: &'w mut Warnings,
}

/// A joint whose closing brace has not come yet.
struct OpenJoint {
    idx: usize,
    has_offset: bool,
    has_channels: bool,
}

impl<'a> Reader<'a, '_> {
    fn error(&self, line: u32, what: impl Into<String>, what_to_do: &str) -> FileError {
        FileError::new(self.path, what, what_to_do).at_line(line)
    }

    fn cut_off(&self, missing: &str) -> FileError {
        self.error(
            self.text.line(),
            format!("the file ends before {missing}"),
            "export it again, it is cut off",
        )
    }

    fn expect_hierarchy(&mut self, bytes: &[u8]) -> Result<(), FileError> {
        let Some(word) = self.text.next_word() else {
            let again = "export it again";
            return Err(FileError::new(self.path, "the file is empty", again));
        };
        if word.is("HIERARCHY") {
            return Ok(());
        }
        if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
            return Err(self.error(1, "the text is UTF-16", "save it as UTF-8 or plain ASCII"));
        }
        Err(self.error(
            word.line,
            format!("a BVH file begins with HIERARCHY, this one with {}", quoted(word.bytes)),
            "check that it is the right file",
        ))
    }

    /// Everything up to the word MOTION.
    fn joints(&mut self) -> Result<Vec<BvhJoint>, FileError> {
        let mut joints: Vec<BvhJoint> = Vec::new();
        let mut names = HashSet::new();
        let mut open: Vec<OpenJoint> = Vec::new();
        loop {
            let Some(word) = self.text.next_word() else {
                return Err(self.cut_off("MOTION"));
            };
            if word.is("ROOT") {
                if !joints.is_empty() {
                    return Err(self.error(
                        word.line,
                        "there is a second ROOT",
                        "keep one body in a file",
                    ));
                }
                self.open_joint(word, None, &mut joints, &mut names, &mut open)?;
            } else if word.is("JOINT") {
                let Some(parent) = open.last().map(|joint| joint.idx) else {
                    return Err(self.error(
                        word.line,
                        "a JOINT stands outside the ROOT",
                        "put it within the braces of its parent",
                    ));
                };
                self.open_joint(word, Some(parent), &mut joints, &mut names, &mut open)?;
            } else if word.is("MOTION") {
                if let Some(joint) = open.last() {
                    let name = &joints[joint.idx].name;
                    return Err(self.error(
                        word.line,
                        format!("joint {} has no closing brace", quoted(name.as_bytes())),
                        "add the missing }",
                    ));
                }
                if joints.is_empty() {
                    return Err(self.error(
                        word.line,
                        "there is no ROOT before MOTION",
                        "export it again with its skeleton",
                    ));
                }
                return Ok(joints);
            } else {
                self.in_joint(word, &mut joints, &mut open)?;
            }
        }
    }

    /// A word that is only allowed within a joint's braces.
    fn in_joint(
        &mut self,
        word: Word<'a>,
        joints: &mut [BvhJoint],
        open: &mut Vec<OpenJoint>,
    ) -> Result<(), FileError> {
        let Some(joint) = open.last_mut() else {
            return Err(self.error(
                word.line,
                format!("{} is not expected here", quoted(word.bytes)),
                "write ROOT or MOTION",
            ));
        };
        let idx = joint.idx;
        if word.is("OFFSET") {
            if joint.has_offset {
                let name = quoted(joints[idx].name.as_bytes());
                return Err(self.error(
                    word.line,
                    format!("joint {name} has a second OFFSET"),
                    "keep one of them",
                ));
            }
            joint.has_offset = true;
            joints[idx].offset = self.offset(word.line)?;
        } else if word.is("CHANNELS") {
            if joint.has_channels {
                let name = quoted(joints[idx].name.as_bytes());
                return Err(self.error(
                    word.line,
                    format!("joint {name} has a second CHANNELS"),
                    "keep one of them",
                ));
            }
            joint.has_channels = true;
            let channels = self.channels(word.line)?;
            // Joints behind this one begin behind its channels; this one is the newest, or the
            // file lists a child before its parent's own channels.
            if idx + 1 != joints.len() {
                return Err(self.error(
                    word.line,
                    "CHANNELS stand behind a child joint, so the order of the numbers is unclear",
                    "put them before the first JOINT",
                ));
            }
            joints[idx].channels = channels;
        } else if word.is("End") {
            let end_site = self.end_site()?;
            // The newest joint has no child yet; bones that go on have no end of their own.
            let is_leaf = idx + 1 == joints.len();
            let site = &mut joints[idx].end_site;
            if is_leaf && site.is_none() && end_site != DVec3::ZERO {
                *site = Some(end_site);
            }
        } else if word.is("}") {
            if !joint.has_offset {
                let (line, name) = (joints[idx].line, quoted(joints[idx].name.as_bytes()));
                return Err(self.error(
                    line,
                    format!("joint {name} has no OFFSET"),
                    "add a line OFFSET x y z",
                ));
            }
            open.pop();
        } else {
            return Err(self.error(
                word.line,
                format!("{} is not expected within a joint", quoted(word.bytes)),
                "write OFFSET, CHANNELS, JOINT, End Site or }",
            ));
        }
        Ok(())
    }

    fn open_joint(
        &mut self,
        keyword: Word<'a>,
        parent: Option<usize>,
        joints: &mut Vec<BvhJoint>,
        names: &mut HashSet<String>,
        open: &mut Vec<OpenJoint>,
    ) -> Result<(), FileError> {
        let name = self.text.rest_of_line_to_brace();
        if name.bytes.is_empty() {
            return Err(self.error(keyword.line, "a joint has no name", "write one behind JOINT"));
        }
        if name.bytes.len() > limits::MAX_NAME_BYTES {
            return Err(self.error(
                name.line,
                format!("a joint's name is longer than {} bytes", limits::MAX_NAME_BYTES),
                "shorten it",
            ));
        }
        if joints.len() == limits::MAX_JOINTS {
            return Err(self.error(
                keyword.line,
                format!("there are more than {} joints", limits::MAX_JOINTS),
                "export the body without helpers",
            ));
        }
        if open.len() == limits::MAX_JOINT_DEPTH {
            return Err(self.error(
                keyword.line,
                format!("joints are nested more than {} deep", limits::MAX_JOINT_DEPTH),
                "export the body without helpers",
            ));
        }
        self.open_brace(&format!("joint {}", quoted(name.bytes)))?;
        let idx = joints.len();
        let first_channel = joints.last().map_or(0, |j| j.first_channel + j.channels.len());
        if let Some(parent) = parent {
            joints[parent].end_site = None;
        }
        joints.push(BvhJoint {
            name: self.unique_name(name, names),
            parent,
            offset: DVec3::ZERO,
            end_site: None,
            channels: Vec::new(),
            first_channel,
            line: keyword.line,
        });
        open.push(OpenJoint { idx, has_offset: false, has_channels: false });
        Ok(())
    }

    /// The joint's name, with `_2`, `_3`, … behind it where it is taken.
    fn unique_name(&mut self, word: Word<'_>, names: &mut HashSet<String>) -> String {
        let name = String::from_utf8_lossy(word.bytes).into_owned();
        let mut unique = name.clone();
        let mut count = 1;
        while !names.insert(unique.clone()) {
            count += 1;
            unique = format!("{name}_{count}");
        }
        if unique != name {
            let (old, new) = (quoted(name.as_bytes()), quoted(unique.as_bytes()));
            let what = format!("a second joint is called {old}; it is taken as {new}");
            self.warnings.warn(self.path, Some(word.line), what);
        }
        unique
    }

    fn open_brace(&mut self, owner: &str) -> Result<(), FileError> {
        match self.text.next_word() {
            Some(word) if word.is("{") => Ok(()),
            Some(word) => Err(self.error(
                word.line,
                format!("{owner} is followed by {} instead of a brace", quoted(word.bytes)),
                "add the missing {",
            )),
            None => Err(self.cut_off(&format!("the opening brace of {owner}"))),
        }
    }

    fn end_site(&mut self) -> Result<DVec3, FileError> {
        // "Site", or "Site" and a name: neither tells anything.
        self.text.rest_of_line_to_brace();
        self.open_brace("End Site")?;
        let mut offset = DVec3::ZERO;
        loop {
            match self.text.next_word() {
                Some(word) if word.is("OFFSET") => offset = self.offset(word.line)?,
                Some(word) if word.is("}") => return Ok(offset),
                Some(word) => {
                    return Err(self.error(
                        word.line,
                        format!("{} is not expected within an End Site", quoted(word.bytes)),
                        "write OFFSET or }",
                    ));
                }
                None => return Err(self.cut_off("the closing brace of an End Site")),
            }
        }
    }

    fn offset(&mut self, line: u32) -> Result<DVec3, FileError> {
        let mut offset = DVec3::ZERO;
        for axis in 0..3 {
            let Some(word) = self.text.next_word_on_line() else {
                return Err(self.error(
                    line,
                    format!("OFFSET has {axis} numbers instead of 3"),
                    "write OFFSET x y z",
                ));
            };
            let Some(value) = parse_number(word.bytes) else {
                return Err(self.error(
                    word.line,
                    format!("the OFFSET {} is not a number", quoted(word.bytes)),
                    "write numbers like 1.5 or 1e-2",
                ));
            };
            if !within(value, limits::MAX_ABS_OFFSET) {
                return Err(self.error(
                    word.line,
                    format!(
                        "the OFFSET {} is not within ±{}",
                        quoted(word.bytes),
                        limits::MAX_ABS_OFFSET
                    ),
                    "export the body in metres or centimetres",
                ));
            }
            offset[axis] = value;
        }
        if let Some(word) = self.text.clone().next_word_on_line()
            && parse_number(word.bytes).is_some()
        {
            return Err(self.error(line, "OFFSET has more than 3 numbers", "write OFFSET x y z"));
        }
        Ok(offset)
    }

    fn channels(&mut self, line: u32) -> Result<Vec<Channel>, FileError> {
        let count = self.text.next_word_on_line();
        let n_channels = count.and_then(|w| std::str::from_utf8(w.bytes).ok()?.parse().ok());
        let Some(n_channels) = n_channels.filter(|&n: &usize| n <= limits::MAX_JOINT_CHANNELS)
        else {
            return Err(self.error(
                line,
                format!(
                    "CHANNELS is not followed by a number up to {}",
                    limits::MAX_JOINT_CHANNELS
                ),
                "write CHANNELS 3 Zrotation Xrotation Yrotation",
            ));
        };
        let mut channels = Vec::with_capacity(n_channels);
        for count in 0..n_channels {
            // Names may go on in the next line, but a keyword there means that some are missing.
            let word = self.text.peek_word();
            let Some((word, channel)) = word.and_then(|w| Some((w, channel_named(w)?))) else {
                return Err(match word {
                    Some(word) if !is_keyword(word) => self.error(
                        word.line,
                        format!("{} is not a channel", quoted(word.bytes)),
                        "use Xposition to Zposition and Xrotation to Zrotation",
                    ),
                    _ => self.error(
                        line,
                        format!("CHANNELS says {n_channels} and lists {count}"),
                        "correct the number",
                    ),
                });
            };
            self.text.next_word();
            if channels.contains(&channel) {
                return Err(self.error(
                    word.line,
                    format!("the channel {} is listed twice", quoted(word.bytes)),
                    "keep one of them",
                ));
            }
            channels.push(channel);
        }
        if self.text.peek_word().is_some_and(|word| channel_named(word).is_some()) {
            return Err(self.error(
                line,
                format!("CHANNELS says {n_channels} and lists more"),
                "correct the number",
            ));
        }
        Ok(channels)
    }
}

fn channel_named(word: Word<'_>) -> Option<Channel> {
    let (first, rest) = word.bytes.split_first()?;
    let axis = match first.to_ascii_uppercase() {
        b'X' => Axis::X,
        b'Y' => Axis::Y,
        b'Z' => Axis::Z,
        _ => return None,
    };
    if rest.eq_ignore_ascii_case(b"position") {
        Some(Channel::Position(axis))
    } else if rest.eq_ignore_ascii_case(b"rotation") {
        Some(Channel::Rotation(axis))
    } else {
        None
    }
}

fn is_keyword(word: Word<'_>) -> bool {
    ["JOINT", "End", "OFFSET", "CHANNELS", "MOTION", "ROOT", "{", "}"].iter().any(|k| word.is(k))
}

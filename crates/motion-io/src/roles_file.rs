//! Which joint plays which role, said by hand: a JSON object from role to joint name.

use std::cell::RefCell;
use std::path::Path;

use motion_core::skeleton::{JointRole, Skeleton};

use crate::diagnostic::{FileError, Warnings, quoted};
use crate::json::{self, Document, Node};
use crate::limits::MAX_INDEX_FILE_BYTES;
use crate::read_file::read_file;

/// Roles that override those recognised from names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RoleOverrides {
    joints: Vec<(JointRole, String)>,
}

impl RoleOverrides {
    /// Reads a roles file, such as `{"Hips": "pelvis", "Head": "skull"}`.
    ///
    /// Fails for an unknown role with the role's line.
    pub fn load(path: &Path) -> Result<Self, FileError> {
        Self::read(&read_file(path, MAX_INDEX_FILE_BYTES)?, path)
    }

    fn read(bytes: &[u8], path: &Path) -> Result<Self, FileError> {
        let value = json::parse(bytes, path)?;
        let mut warnings = Warnings::new();
        let text = json::without_mark(bytes);
        let document = Document { path, text, warnings: RefCell::new(&mut warnings) };
        let mut object = Node::root(&document, &value).object()?;
        let members = object.members().into_iter().map(|(name, node)| {
            let role = JointRole::from_name(name).ok_or_else(|| {
                let names: Vec<&str> = JointRole::ALL.iter().map(|role| role.name()).collect();
                node.error("is no role", format!("use {}", names.join(", ")))
            })?;
            Ok((role, node.name()?))
        });
        Ok(Self { joints: members.collect::<Result<_, FileError>>()? })
    }

    /// The skeleton with these roles instead of those that were recognised.
    ///
    /// Warns about joints that it does not have: one file may serve several bodies.
    #[must_use]
    pub fn apply(&self, skeleton: Skeleton, path: &Path, warnings: &mut Warnings) -> Skeleton {
        if self.joints.is_empty() {
            return skeleton;
        }
        let mut roles = skeleton.roles().clone();
        for (role, name) in &self.joints {
            match skeleton.by_name(name) {
                Some(joint) => roles.set(*role, joint),
                None => {
                    let (role, name) = (role.name(), quoted(name.as_bytes()));
                    let what = format!("there is no joint {name} to be the {role}");
                    warnings.warn(path, None, what);
                }
            }
        }
        skeleton.with_roles(roles)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::guess::test_body::body;

    fn read(text: &str) -> Result<RoleOverrides, FileError> {
        RoleOverrides::read(text.as_bytes(), Path::new("r.json"))
    }

    #[test]
    fn roles_are_overridden_and_missing_joints_said() {
        let overrides = read(r#"{"Head": "Neck", "Hips": "pelvis"}"#).unwrap();
        let mut warnings = Warnings::new();
        let skeleton = overrides.apply(body(1.0), Path::new("a.bvh"), &mut warnings);
        assert_eq!(skeleton.by_role(JointRole::Head), skeleton.by_name("Neck"));
        assert_eq!(skeleton.by_role(JointRole::Hips), skeleton.by_name("Hips"));
        assert_eq!(
            warnings.as_slice()[0].to_string(),
            "a.bvh: there is no joint \"pelvis\" to be the Hips"
        );
    }

    #[test]
    fn wrong_files_are_refused_with_their_line() {
        let error = read("{\n\"Hat\": \"a\"}").unwrap_err().to_string();
        assert!(error.starts_with("r.json:2: Hat is no role; use Hips, "), "{error}");
        let error = read("{\"Head\":\n 1}").unwrap_err().to_string();
        assert_eq!(error, "r.json:1: Head is not a text; write it in \"quotes\"");
    }
}

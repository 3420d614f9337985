//! Projects that the program has with it, on the built-in library.

use std::path::Path;

use motion_io::diagnostic::{FileError, Warnings};
use motion_io::project_file::{self, Project};

/// The first sample as a project file.
pub const TEXT: &str = include_str!("samples/corner.gaitway");

/// What the sample's file would be called.
pub const FILE_NAME: &str = "sample.gaitway";

/// A project to look at and to begin from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    /// What menus call it.
    pub title: &'static str,
    /// Its project file.
    pub text: &'static str,
}

/// All samples; the first is the one that the program opens with.
pub const SAMPLES: [Sample; 4] = [
    Sample { title: "Round the corner", text: TEXT },
    Sample { title: "Run and stop", text: include_str!("samples/run_and_stop.gaitway") },
    Sample { title: "There and back", text: include_str!("samples/there_and_back.gaitway") },
    Sample { title: "Two pass", text: include_str!("samples/two_pass.gaitway") },
];

impl Sample {
    /// The project.
    pub fn project(&self) -> Result<Project, FileError> {
        read(self.text)
    }
}

/// The sample that the program opens with.
pub fn sample() -> Result<Project, FileError> {
    read(TEXT)
}

/// A project to begin with: somebody who walks four metres.
pub fn new_project() -> Result<Project, FileError> {
    read(include_str!("samples/new.gaitway"))
}

fn read(text: &str) -> Result<Project, FileError> {
    project_file::read(text.as_bytes(), Path::new(FILE_NAME), &mut Warnings::new())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_projects_without_a_warning() {
        let new = include_str!("samples/new.gaitway");
        for text in SAMPLES.map(|sample| sample.text).into_iter().chain([new]) {
            let mut warnings = Warnings::new();
            let path = Path::new(FILE_NAME);
            let project = project_file::read(text.as_bytes(), path, &mut warnings).unwrap();
            assert_eq!(warnings, Warnings::new());
            assert_eq!(project.library, "builtin");
        }
    }
}

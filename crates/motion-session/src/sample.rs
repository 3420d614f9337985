//! The project that the program has with it, on the built-in library.

use std::path::Path;

use motion_io::diagnostic::{FileError, Warnings};
use motion_io::project_file::{self, Project};

/// The sample as a project file.
pub const TEXT: &str = include_str!("sample.gaitway");

/// What the sample's file would be called.
pub const FILE_NAME: &str = "sample.gaitway";

/// The sample.
pub fn sample() -> Result<Project, FileError> {
    project_file::read(TEXT.as_bytes(), Path::new(FILE_NAME), &mut Warnings::new())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sample_is_a_project_without_a_warning() {
        let mut warnings = Warnings::new();
        let path = Path::new(FILE_NAME);
        let project = project_file::read(TEXT.as_bytes(), path, &mut warnings).unwrap();
        assert_eq!(warnings, Warnings::new());
        assert_eq!(project.library, "builtin");
    }
}

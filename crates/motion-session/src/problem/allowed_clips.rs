//! Which clips the search may use.

use std::path::Path;

use motion_core::tags::whole_tags;
use motion_io::diagnostic::FileError;
use motion_io::project_file::Project;

use crate::Library;
use crate::palette::Matcher;

/// For each clip whether the palette has it. Fails where it leaves none.
pub(super) fn allowed_clips(
    project: &Project,
    library: &Library,
    project_path: &Path,
) -> Result<Vec<bool>, FileError> {
    let clips = library.clips.clips();
    let by_hand = project.hand_tags();
    let Some(palette) = &project.palette else { return Ok(vec![true; clips.len()]) };
    let matcher = Matcher::new(Some(palette)).map_err(|error| {
        let what = format!("the palette has a pattern that is none ({error})");
        FileError::new(project_path, what, "use * for anything and ? for one character")
    })?;
    let allowed: Vec<bool> =
        clips.iter().map(|clip| matcher.has((&clip.id, &whole_tags(clip, &by_hand)))).collect();
    if !allowed.contains(&true) {
        return Err(FileError::new(
            project_path,
            format!("the palette leaves none of the library's {} clips", clips.len()),
            "include more or exclude less",
        ));
    }
    Ok(allowed)
}

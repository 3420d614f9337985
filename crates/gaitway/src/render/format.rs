//! What is written, by the ending of its name.

use std::path::Path;

use motion_io::diagnostic::FileError;

use super::video::Video;

/// A format of pictures or films.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// One picture.
    Png,
    /// A film that needs no player.
    Gif,
    /// A film that `ffmpeg` writes.
    Video(Video),
}

impl Format {
    /// The format that the ending of `path` says.
    pub(crate) fn of(path: &Path) -> Result<Self, FileError> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let what = match ending.as_deref() {
            Some("png") => return Ok(Self::Png),
            Some("gif") => return Ok(Self::Gif),
            Some("mp4") => return Ok(Self::Video(Video::Mp4)),
            Some("webm") => return Ok(Self::Video(Video::Webm)),
            Some(other) => format!(".{other} is neither a picture nor a film that can be written"),
            None => "the name has no ending that says the format".to_owned(),
        };
        Err(FileError::new(path, what, "choose a name that ends in .png, .gif, .mp4 or .webm"))
    }

    /// Whether it has more than one picture.
    pub(crate) fn is_film(self) -> bool {
        self != Self::Png
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_says_the_format() {
        assert_eq!(Format::of(Path::new("a/b.PNG")), Ok(Format::Png));
        assert_eq!(Format::of(Path::new("b.webm")), Ok(Format::Video(Video::Webm)));
        let error = Format::of(Path::new("b.jpeg")).unwrap_err().to_string();
        assert_eq!(
            error,
            "b.jpeg: .jpeg is neither a picture nor a film that can be written; choose a name that \
             ends in .png, .gif, .mp4 or .webm"
        );
        assert!(Format::of(Path::new("png")).is_err());
    }
}

//! Films as `.mp4` and `.webm`, by the `ffmpeg` that the user has.

use std::io::{self, Read as _, Write as _};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::thread::{Builder, JoinHandle};

use anyhow::{Context as _, anyhow};
use motion_io::diagnostic::FileError;
use motion_render::picture::Picture;

/// A format that `ffmpeg` writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Video {
    /// H.264, which everything plays.
    Mp4,
    /// VP9, which browsers play.
    Webm,
}

/// A film that `ffmpeg` is writing.
pub(crate) struct VideoFilm {
    ffmpeg: Child,
    /// `None` once there are no more pictures.
    pictures: Option<ChildStdin>,
    complaints: Option<JoinHandle<String>>,
}

impl VideoFilm {
    /// Starts `ffmpeg`, which writes to `temporary`. `path` is what messages name.
    pub(crate) fn start(
        video: Video,
        temporary: &Path,
        path: &Path,
        [width, height]: [u32; 2],
        fps: f64,
    ) -> Result<Self, FileError> {
        let mut command = Command::new("ffmpeg");
        command
            .args(["-hide_banner", "-nostdin", "-loglevel", "error", "-y"])
            .args(["-f", "rawvideo", "-pixel_format", "rgba"])
            .args(["-video_size", &format!("{width}x{height}"), "-framerate", &fps.to_string()])
            .args(["-i", "pipe:0", "-an"])
            // Both formats mean these colours where nothing else is said.
            .args(["-vf", "scale=out_color_matrix=bt709:out_range=tv", "-pix_fmt", "yuv420p"])
            .args(["-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"])
            .args(["-map_metadata", "-1", "-fflags", "+bitexact"])
            .args(video.args())
            .arg(temporary)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        // Ctrl-C is ours to hear: ffmpeg would end its half of the film as if it were whole.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut ffmpeg = command.spawn().map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => FileError::new(
                path,
                "ffmpeg, which makes films of this kind, is not installed",
                "install it, or choose a name that ends in .gif",
            ),
            _ => FileError::new(
                path,
                format!("ffmpeg cannot be started ({error})"),
                "check it, or choose a name that ends in .gif",
            ),
        })?;
        let pictures = ffmpeg.stdin.take();
        let complaints = ffmpeg.stderr.take().and_then(|mut stderr| {
            let read = move || {
                let mut text = Vec::new();
                // What was read until an error counts.
                drop(stderr.read_to_end(&mut text));
                String::from_utf8_lossy(&text).into_owned()
            };
            Builder::new().name("ffmpeg-errors".to_owned()).spawn(read).ok()
        });
        Ok(Self { ffmpeg, pictures, complaints })
    }

    /// Adds a picture of the film's size.
    pub(crate) fn add(&mut self, picture: &Picture) -> anyhow::Result<()> {
        let written = match &mut self.pictures {
            Some(pipe) => pipe.write_all(&picture.rgba),
            None => return Err(anyhow!("ffmpeg takes no pictures")),
        };
        match written {
            Ok(()) => Ok(()),
            // It has said why on its own stderr.
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Err(self.failed()),
            Err(error) => Err(error).context("pictures cannot be passed to ffmpeg"),
        }
    }

    /// Ends the film and waits until it is written.
    pub(crate) fn finish(mut self) -> anyhow::Result<()> {
        drop(self.pictures.take());
        let status = self.ffmpeg.wait().context("ffmpeg")?;
        if status.success() { Ok(()) } else { Err(self.failed()) }
    }

    /// Why `ffmpeg` gave up: its last line.
    fn failed(&mut self) -> anyhow::Error {
        drop(self.pictures.take());
        drop(self.ffmpeg.wait());
        let text = self.complaints.take().and_then(|thread| thread.join().ok()).unwrap_or_default();
        let last = text.lines().map(str::trim).rfind(|line| !line.is_empty());
        anyhow!("ffmpeg failed: {}", last.unwrap_or("it did not say why"))
    }
}

impl Drop for VideoFilm {
    fn drop(&mut self) {
        // Ended already, or nobody wants the film any more.
        drop(self.ffmpeg.kill());
        drop(self.ffmpeg.wait());
    }
}

impl Video {
    fn args(self) -> &'static [&'static str] {
        match self {
            Self::Mp4 => &[
                "-c:v",
                "libx264",
                "-preset",
                "medium",
                "-crf",
                "18",
                "-movflags",
                "+faststart",
                "-f",
                "mp4",
            ],
            Self::Webm => &[
                "-c:v",
                "libvpx-vp9",
                "-crf",
                "28",
                "-b:v",
                "0",
                "-row-mt",
                "1",
                "-deadline",
                "good",
                "-cpu-used",
                "4",
                "-f",
                "webm",
            ],
        }
    }
}

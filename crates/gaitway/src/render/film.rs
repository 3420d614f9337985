//! Films: pictures drawn one after the other while another thread writes them.

use std::io::BufWriter;
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::Builder;

use anyhow::anyhow;
use motion_core::cancel::CancelToken;
use motion_io::diagnostic::FileError;
use motion_io::pending_file::PendingFile;
use motion_render::picture::Picture;
use motion_scene::camera::Viewport;
use motion_session::stage::framing::Margins;
use motion_session::stage::shot::{Shot, Take};
use motion_session::stage::{Show, Stage, fan};

use super::format::Format;
use super::gif_film::GifFilm;
use super::painter::{Painter, pixels_per_point};
use super::palette::Palette;
use super::video::VideoFilm;
use crate::args::render::Size;
use crate::output::{Bar, Failure};

/// A film to be made.
pub(crate) struct FilmPlan<'a> {
    pub(crate) stage: &'a Stage,
    /// The frame of every picture.
    pub(crate) frames: &'a [f64],
    /// Pictures per second.
    pub(crate) fps: f64,
    pub(crate) size: Size,
    pub(crate) shot: Shot,
    pub(crate) show: Show,
    pub(crate) format: Format,
    /// The file to write.
    pub(crate) path: &'a Path,
}

/// So many pictures wait at most for being written.
const N_WAITING: usize = 3;
/// So many pictures choose the colours of a GIF.
const N_SAMPLES: usize = 10;

/// What the writer is sent.
enum Reel {
    Picture(Picture),
    /// That was all; without it the film is thrown away.
    End,
}

impl FilmPlan<'_> {
    /// Draws and writes the film. Cancelled, it leaves nothing.
    pub(crate) fn make(
        &self,
        painter: &mut Painter,
        cancel: &CancelToken,
        bar: &Bar,
    ) -> Result<(), Failure> {
        let cameras = self.take().cameras(self.shot);
        let mut paint = |nth: usize| -> Result<Picture, Failure> {
            if cancel.is_cancelled() {
                return Err(stopped());
            }
            let scene = self.stage.scene_at(self.frames[nth], self.show).scene;
            painter.paint(&scene, cameras[nth], self.size, self.pixels_per_point())
        };
        // Begun before anything is drawn, so that a folder that is missing is said at once.
        let pending = PendingFile::create(self.path)?;
        let writer = match self.format {
            Format::Video(video) => {
                let (temporary, size) = (pending.temporary(), [self.size.width, self.size.height]);
                let film = VideoFilm::start(video, temporary, self.path, size, self.fps)?;
                Writer::Video { film, pending }
            }
            Format::Gif | Format::Png => {
                bar.set("choosing colours", 0.0);
                let samples: Result<Vec<Picture>, Failure> =
                    fan::spread(self.frames.len(), N_SAMPLES).into_iter().map(&mut paint).collect();
                let palette = Palette::of_pictures(&samples?);
                let out = BufWriter::new(pending);
                // Sides are at most 8192.
                let (width, height) = (self.size.width as u16, self.size.height as u16);
                Writer::Gif(
                    GifFilm::new(out, width, height, self.fps, palette)
                        .map_err(|error| gif_failure(self.path, error))?,
                )
            }
        };
        let (reel, pictures) = sync_channel(N_WAITING);
        let path = self.path.to_owned();
        let work = move || writer.write(&pictures, &path);
        let writing = Builder::new().name("film-writer".to_owned()).spawn(work)?;
        let drawn = self.draw_all(paint, &reel, bar);
        drop(reel);
        let written = writing
            .join()
            .unwrap_or_else(|_| Err(anyhow!("the film's writer stopped unexpectedly").into()));
        // What stopped the writer is why drawing stopped, unless drawing itself failed.
        match (drawn, written) {
            (Ok(()), written) => written,
            (Err(DrawEnd::WriterGone), Err(why)) => Err(why),
            (Err(DrawEnd::WriterGone), Ok(())) => Err(anyhow!("the film was not written").into()),
            (Err(DrawEnd::Failed(why)), _) => Err(why),
        }
    }

    fn draw_all(
        &self,
        mut paint: impl FnMut(usize) -> Result<Picture, Failure>,
        reel: &SyncSender<Reel>,
        bar: &Bar,
    ) -> Result<(), DrawEnd> {
        let n = self.frames.len();
        for nth in 0..n {
            bar.set("drawing", nth as f64 / n as f64);
            let picture = paint(nth).map_err(DrawEnd::Failed)?;
            reel.send(Reel::Picture(picture)).ok().ok_or(DrawEnd::WriterGone)?;
        }
        bar.set("writing", 1.0);
        reel.send(Reel::End).ok().ok_or(DrawEnd::WriterGone)
    }

    fn take(&self) -> Take<'_> {
        let viewport = Viewport::new(self.size.width as f32, self.size.height as f32);
        Take {
            stage: self.stage,
            frames: self.frames,
            fps: self.fps,
            wishes: self.show.wishes,
            viewport,
            margins: Margins::new(
                viewport,
                if self.show.wishes { self.pixels_per_point() } else { 0.0 },
            ),
        }
    }

    fn pixels_per_point(&self) -> f32 {
        pixels_per_point(self.size.height)
    }
}

/// Why not all pictures were drawn.
enum DrawEnd {
    Failed(Failure),
    WriterGone,
}

/// Where pictures go.
enum Writer {
    Gif(GifFilm<BufWriter<PendingFile>>),
    Video { film: VideoFilm, pending: PendingFile },
}

impl Writer {
    /// Writes what comes until the end; a film without an end is not kept.
    fn write(mut self, pictures: &Receiver<Reel>, path: &Path) -> Result<(), Failure> {
        loop {
            match pictures.recv() {
                Ok(Reel::Picture(picture)) => self.add(&picture, path)?,
                Ok(Reel::End) => return self.keep(path),
                Err(_) => return Ok(()),
            }
        }
    }

    fn add(&mut self, picture: &Picture, path: &Path) -> Result<(), Failure> {
        match self {
            Self::Gif(film) => film.add(picture).map_err(|error| gif_failure(path, error)),
            Self::Video { film, .. } => Ok(film.add(picture)?),
        }
    }

    fn keep(self, path: &Path) -> Result<(), Failure> {
        let pending = match self {
            Self::Gif(film) => {
                let out = film.finish().map_err(|error| gif_failure(path, error))?;
                out.into_inner().map_err(|error| FileError::writing(path, error.error()))?
            }
            Self::Video { film, pending } => {
                film.finish()?;
                pending
            }
        };
        Ok(pending.keep()?)
    }
}

fn gif_failure(path: &Path, error: gif::EncodingError) -> Failure {
    match error {
        gif::EncodingError::Io(error) => FileError::writing(path, &error).into(),
        other => Failure::Other(anyhow::Error::from(other).context(path.display().to_string())),
    }
}

/// Somebody pressed Ctrl-C.
pub(crate) fn stopped() -> Failure {
    Failure::Other(anyhow!("stopped; nothing was written"))
}

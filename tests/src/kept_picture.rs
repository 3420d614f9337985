//! Pictures of tests beside those that were looked at and kept in `tests/snapshots`.
//!
//! `UPDATE_SNAPSHOTS=1` keeps the new ones. A picture that differs is written beside the kept one
//! as `NAME.new.png`, with `NAME.diff.png` in which differences are bright.

use std::path::PathBuf;

use image::{Rgba, RgbaImage};

use crate::workspace_root;

/// The only thresholds there are. One binary on one machine draws the same bytes every time;
/// other processors have other vector units and round edges of triangles and the last bit of
/// sRGB differently.
mod threshold {
    /// Channels may differ by so much anywhere.
    pub(super) const CHANNEL: u8 = 3;
    /// And by more in this share of pixels: those on the edges of triangles.
    pub(super) const EDGE_SHARE: f64 = 0.001;
}

/// Fails unless `ours` is the kept picture of that name.
///
/// # Panics
///
/// Where it differs, or a picture cannot be read or written.
#[track_caller]
pub fn assert_is_kept(name: &str, ours: &RgbaImage) {
    let path = |ending: &str| -> PathBuf {
        workspace_root().join("tests/snapshots").join(format!("{name}{ending}.png"))
    };
    let save = |picture: &RgbaImage, ending: &str| {
        picture.save(path(ending)).unwrap_or_else(|error| panic!("{name}{ending}: {error}"));
    };
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        save(ours, "");
        return;
    }
    let kept = match image::open(path("")) {
        Ok(kept) => kept.into_rgba8(),
        Err(error) => {
            save(ours, ".new");
            panic!("{name}: no kept picture ({error}); look at {name}.new.png");
        }
    };
    if let Err(what) = compare(&kept, ours) {
        save(ours, ".new");
        save(&difference(&kept, ours), ".diff");
        panic!("{name}: {what}; see {name}.new.png and {name}.diff.png in tests/snapshots");
    }
}

fn compare(kept: &RgbaImage, ours: &RgbaImage) -> Result<(), String> {
    if kept.dimensions() != ours.dimensions() {
        return Err(format!("{:?} pixels instead of {:?}", ours.dimensions(), kept.dimensions()));
    }
    let n_far = kept.pixels().zip(ours.pixels()).filter(|(a, b)| gap(a, b) > threshold::CHANNEL);
    let n_far = n_far.count();
    let n_pixels = (kept.width() * kept.height()) as usize;
    if n_far as f64 > threshold::EDGE_SHARE * n_pixels as f64 {
        return Err(format!("{n_far} of {n_pixels} pixels differ by more than rounding"));
    }
    Ok(())
}

fn gap(a: &Rgba<u8>, b: &Rgba<u8>) -> u8 {
    a.0.iter().zip(&b.0).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
}

fn difference(kept: &RgbaImage, ours: &RgbaImage) -> RgbaImage {
    RgbaImage::from_fn(ours.width(), ours.height(), |x, y| {
        let gap = kept.get_pixel_checked(x, y).map_or(255, |a| gap(a, ours.get_pixel(x, y)));
        Rgba([gap.saturating_mul(8), gap, gap, 255])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_compared_strictly() {
        let grey = RgbaImage::from_pixel(40, 40, Rgba([100, 100, 100, 255]));
        let mut near = grey.clone();
        near.pixels_mut().for_each(|pixel| pixel.0[1] += threshold::CHANNEL);
        assert_eq!(compare(&grey, &near), Ok(()));
        let mut spot = grey.clone();
        spot.put_pixel(3, 3, Rgba([255, 0, 0, 255]));
        assert_eq!(compare(&grey, &spot), Ok(()), "one pixel of 1600 may be an edge");
        spot.put_pixel(4, 3, Rgba([255, 0, 0, 255]));
        assert!(compare(&grey, &spot).is_err(), "two are a difference");
        assert!(compare(&grey, &RgbaImage::new(40, 39)).is_err());
    }
}

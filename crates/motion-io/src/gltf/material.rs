//! Surfaces: colours and pictures.

use std::io::Cursor;

use ::gltf::json::Root;
use ::gltf::json::material::AlphaMode;
use ::gltf::json::validation::Checked;
use image::{ImageReader, Limits};

use super::document::Document;
use crate::diagnostic::{FileError, Warnings};
use crate::limits::{MAX_TEXTURE_BYTES, MAX_TEXTURE_SIDE};

/// How a surface lets light through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Alpha {
    /// Not at all.
    Opaque,
    /// Where its alpha is below this there is nothing.
    Mask(f32),
    /// By its alpha.
    Blend,
}

/// What a surface looks like.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name in the file; may be empty.
    pub name: String,
    /// Base colour, linear, with alpha; the texture is multiplied by it.
    pub base_colour_linear: [f32; 4],
    /// The picture of its base colour, an index into the character's textures.
    pub base_colour_texture: Option<usize>,
    /// Whether its back is seen too.
    pub double_sided: bool,
    /// How it lets light through.
    pub alpha: Alpha,
}

impl Default for Material {
    /// What the format says of a mesh without a material: white and opaque.
    fn default() -> Self {
        Self {
            name: String::new(),
            base_colour_linear: [1.0; 4],
            base_colour_texture: None,
            double_sided: false,
            alpha: Alpha::Opaque,
        }
    }
}

/// A decoded picture.
#[derive(Clone, PartialEq)]
pub struct Texture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows, the upper one first.
    pub height: u32,
    /// Red, green, blue (sRGB) and alpha of every pixel.
    pub rgba8_srgb: Vec<u8>,
}

impl std::fmt::Debug for Texture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Texture({} × {})", self.width, self.height)
    }
}

/// A file's materials and the textures that they use.
pub(super) struct Surfaces {
    /// The file's, and behind them one for meshes without any.
    pub(super) materials: Vec<Material>,
    pub(super) textures: Vec<Texture>,
    /// Which set of texture coordinates each material uses.
    pub(super) uv_sets: Vec<u32>,
}

impl Surfaces {
    /// Pictures that cannot be had are warned about and left out; a body can do without.
    pub(super) fn new(document: &Document, warnings: &mut Warnings) -> Self {
        let mut surfaces =
            Self { materials: Vec::new(), textures: Vec::new(), uv_sets: Vec::new() };
        let mut texture_of = vec![None; document.root.images.len()];
        for material in &document.root.materials {
            let pbr = &material.pbr_metallic_roughness;
            let info = pbr.base_color_texture.as_ref();
            let image = info.and_then(|info| image_of(&document.root, info.index.value()));
            let mut base_colour_texture = None;
            if let Some(image) = image {
                let known = &mut texture_of[image];
                if known.is_none() {
                    let used: usize =
                        surfaces.textures.iter().map(|texture| texture.rgba8_srgb.len()).sum();
                    let left = MAX_TEXTURE_BYTES.saturating_sub(used as u64);
                    *known = Some(match texture(document, image, left) {
                        Ok(texture) => {
                            surfaces.textures.push(texture);
                            Some(surfaces.textures.len() - 1)
                        }
                        Err(error) => {
                            let what = format!("{}; the picture is left out", error.what);
                            warnings.warn(&document.path, None, what);
                            None
                        }
                    });
                }
                base_colour_texture = known.flatten();
            } else if info.is_some() {
                let what = "a picture of a kind that is not read is left out (PNG and JPEG are)";
                warnings.warn(&document.path, None, what);
            }
            let colour = pbr.base_color_factor.0;
            let cutoff = material.alpha_cutoff.as_ref().map_or(0.5, |cutoff| cutoff.0);
            surfaces.uv_sets.push(info.map_or(0, |info| info.tex_coord));
            surfaces.materials.push(Material {
                name: material.name.clone().unwrap_or_default(),
                base_colour_linear: colour
                    .map(|c| if c.is_finite() { c.clamp(0.0, 1.0) } else { 1.0 }),
                base_colour_texture,
                double_sided: material.double_sided,
                alpha: match material.alpha_mode {
                    Checked::Valid(AlphaMode::Mask) => Alpha::Mask(cutoff.clamp(0.0, 1.0)),
                    Checked::Valid(AlphaMode::Blend) => Alpha::Blend,
                    _ => Alpha::Opaque,
                },
            });
        }
        surfaces.materials.push(Material::default());
        surfaces.uv_sets.push(0);
        surfaces
    }
}

fn image_of(root: &Root, texture: usize) -> Option<usize> {
    let image = root.textures.get(texture)?.source.value();
    (image < root.images.len()).then_some(image)
}

/// Decodes a picture within `max_bytes`.
fn texture(document: &Document, image: usize, max_bytes: u64) -> Result<Texture, FileError> {
    let json = &document.root.images[image];
    let from_uri;
    let bytes = match (&json.uri, json.buffer_view) {
        (Some(uri), _) => {
            from_uri = document.resource(uri)?;
            &from_uri
        }
        (None, Some(view)) => document.view(view.value())?,
        (None, None) => return Err(document.error(format!("picture {image} is nowhere"))),
    };
    let bad = |error: &dyn std::fmt::Display| {
        document.error(format!("picture {image} cannot be read ({error})"))
    };
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_TEXTURE_SIDE);
    limits.max_image_height = Some(MAX_TEXTURE_SIDE);
    limits.max_alloc = Some(max_bytes);
    let mut reader =
        ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|error| bad(&error))?;
    reader.limits(limits);
    let picture = reader.decode().map_err(|error| bad(&error))?.into_rgba8();
    let (width, height) = picture.dimensions();
    Ok(Texture { width, height, rgba8_srgb: picture.into_raw() })
}

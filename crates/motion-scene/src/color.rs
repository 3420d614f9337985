//! Colours by what they mean, for dark and light surroundings.
//!
//! Hues are those of Okabe and Ito (2008, *Color Universal Design*), which people of every kind
//! of colour vision tell apart; what matters is also told by shape or words.

/// Red, green, blue as light adds up, and coverage; 0 to 1, not multiplied by coverage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearRgba(pub [f32; 4]);

impl LinearRgba {
    /// Opaque white.
    pub const WHITE: Self = Self([1.0; 4]);

    /// From the usual notation, `0xRRGGBB` in sRGB, opaque.
    pub fn from_srgb_hex(hex: u32) -> Self {
        let channel = |shift: u32| linear_from_srgb(f32::from((hex >> shift) as u8) / 255.0);
        Self([channel(16), channel(8), channel(0), 1.0])
    }

    /// The same colour with another coverage.
    #[must_use]
    pub fn with_alpha(self, alpha: f32) -> Self {
        let [r, g, b, _] = self.0;
        Self([r, g, b, alpha])
    }

    /// The colour `share` of the way to `other`, in light.
    #[must_use]
    pub fn mixed(self, other: Self, share: f32) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + (other.0[i] - self.0[i]) * share))
    }

    /// As stored values, sRGB from 0 to 1, with straight alpha.
    pub fn to_srgb(self) -> [f32; 4] {
        let [r, g, b, a] = self.0;
        let stored = |light: f32| srgb_from_linear(light.clamp(0.0, 1.0));
        [stored(r), stored(g), stored(b), a]
    }

    /// As bytes of sRGB with straight alpha.
    pub fn to_srgb8(self) -> [u8; 4] {
        let [r, g, b, a] = self.0;
        let byte = |x: f32| (x.clamp(0.0, 1.0) * 255.0).round() as u8;
        [byte(srgb_from_linear(r)), byte(srgb_from_linear(g)), byte(srgb_from_linear(b)), byte(a)]
    }
}

/// IEC 61966-2-1, from the stored value to light.
pub fn linear_from_srgb(stored: f32) -> f32 {
    if stored <= 0.04045 { stored / 12.92 } else { ((stored + 0.055) / 1.055).powf(2.4) }
}

/// IEC 61966-2-1, from light to the stored value.
pub fn srgb_from_linear(light: f32) -> f32 {
    if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

/// What a colour says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColorRole {
    /// The shown character.
    Body,
    /// A take, by its number in the list; hues repeat after eight.
    Take(usize),
    /// What is selected.
    Selected,
    /// What the pointer is over.
    Hovered,
    /// Body checkpoints.
    Checkpoint,
    /// Joint targets.
    JointTarget,
    /// Pose constraints.
    Pose,
    /// Style constraints.
    Style,
    /// Obstacles.
    Obstacle,
    /// Misses and errors.
    Miss,
    /// A planted foot.
    Planted,
    /// Trails before the shown moment.
    Past,
    /// Trails after the shown moment.
    Future,
    /// Words.
    Text,
    /// Words of less weight.
    FaintText,
    /// Plates behind words.
    TextPlate,
}

/// Surroundings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Theme {
    /// Light things on dark ground.
    #[default]
    Dark,
    /// Dark things on light ground.
    Light,
}

/// Okabe–Ito without black, in an order in which neighbours differ most.
const TAKES: [u32; 8] =
    [0x4C9DFF, 0xE69F00, 0x009E73, 0xCC79A7, 0x56B4E9, 0xD55E00, 0xF0E442, 0x9BA3AE];

impl ColorRole {
    /// The colour for this meaning.
    pub fn color(self, theme: Theme) -> LinearRgba {
        let dark = theme == Theme::Dark;
        let pick = |on_dark: u32, on_light: u32| if dark { on_dark } else { on_light };
        LinearRgba::from_srgb_hex(match self {
            Self::Body => pick(0xC9C2B8, 0xB9B1A6),
            Self::Take(n) => TAKES[n % TAKES.len()],
            Self::Selected => 0x4C9DFF,
            Self::Hovered => pick(0xE6E8EB, 0x1B1D21),
            Self::Checkpoint | Self::Past => pick(0xE69F00, 0xC98500),
            Self::JointTarget | Self::Future => pick(0x56B4E9, 0x2A86C0),
            Self::Pose | Self::Planted => 0x009E73,
            Self::Style => 0xCC79A7,
            Self::Obstacle => 0x8A8F98,
            Self::Miss => pick(0xD55E00, 0xB03A00),
            Self::Text => pick(0xE6E8EB, 0x1B1D21),
            Self::FaintText => pick(0x9BA3AE, 0x5A616B),
            Self::TextPlate => pick(0x22252A, 0xF4F5F7),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn storing_and_lighting_are_inverse() {
        for byte in 0..=255_u32 {
            let color = LinearRgba::from_srgb_hex(byte << 16 | byte << 8 | (255 - byte));
            let expected = [byte as u8, byte as u8, 255 - byte as u8, 255];
            assert_eq!(color.to_srgb8(), expected);
        }
        assert_eq!(LinearRgba::WHITE.with_alpha(0.5).to_srgb8(), [255, 255, 255, 128]);
    }

    fn luminance(color: LinearRgba) -> f32 {
        let [r, g, b, _] = color.0;
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    /// WCAG 2: words on their plates.
    #[test]
    fn words_can_be_read_in_both_themes() {
        for theme in [Theme::Dark, Theme::Light] {
            let plate = luminance(ColorRole::TextPlate.color(theme));
            for role in [ColorRole::Text, ColorRole::FaintText] {
                let text = luminance(role.color(theme));
                let (light, dark) = (text.max(plate), text.min(plate));
                let contrast = (light + 0.05) / (dark + 0.05);
                assert!(contrast >= 4.5, "{role:?} on {theme:?}: {contrast}");
            }
        }
    }

    /// As people without one kind of cone see it (Viénot, Brettel and Mollon 1999), in light.
    fn seen_without(cone: &str, color: LinearRgba) -> [f32; 3] {
        let [r, g, b, _] = color.0;
        let matrix = match cone {
            "L" => [[0.112, 0.888, 0.0], [0.112, 0.888, 0.0], [0.004, -0.004, 1.0]],
            _ => [[0.293, 0.707, 0.0], [0.293, 0.707, 0.0], [-0.021, 0.021, 1.0]],
        };
        matrix.map(|row| row[0] * r + row[1] * g + row[2] * b).map(srgb_from_linear_clamped)
    }

    fn srgb_from_linear_clamped(light: f32) -> f32 {
        srgb_from_linear(light.clamp(0.0, 1.0))
    }

    /// What stands side by side in the view can be told apart without colour vision of one kind.
    #[test]
    fn meanings_differ_for_every_kind_of_colour_vision() {
        let roles = [
            ColorRole::Selected,
            ColorRole::Checkpoint,
            ColorRole::JointTarget,
            ColorRole::Pose,
            ColorRole::Miss,
        ];
        for theme in [Theme::Dark, Theme::Light] {
            for (i, a) in roles.iter().enumerate() {
                for b in &roles[i + 1..] {
                    for cone in ["L", "M"] {
                        let [x, y] = [a, b].map(|role| seen_without(cone, role.color(theme)));
                        let apart: f32 = (0..3).map(|k| (x[k] - y[k]).powi(2)).sum::<f32>().sqrt();
                        assert!(apart > 0.12, "{a:?} and {b:?} without {cone}: {apart}");
                    }
                }
            }
        }
    }

    #[test]
    fn takes_repeat_after_eight() {
        let hue = |n| ColorRole::Take(n).color(Theme::Dark);
        assert_eq!(hue(3), hue(11));
        for i in 0..8 {
            for j in 0..i {
                assert_ne!(hue(i), hue(j));
            }
        }
    }
}

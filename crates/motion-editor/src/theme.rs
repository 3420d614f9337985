//! All colours, sizes and letters of the window, dark and light.
//!
//! Three surfaces and hairlines between them; space separates, not frames. A colour that means
//! something comes from [`ColorRole`], so that a thing looks the same in the view and beside it.

use std::sync::Arc;

use egui::{Color32, CornerRadius, FontFamily, FontId, Margin, Stroke, TextStyle, Vec2};
use motion_scene::color::{ColorRole, LinearRgba, Theme};

/// Everything stands on multiples of this, points.
pub const GRID: f32 = 4.0;
/// A line of a list.
pub const ROW_HEIGHT: f32 = 24.0;
/// A row of the timeline.
pub const TRACK_HEIGHT: f32 = 26.0;
/// A square button with an icon.
pub const ICON_BUTTON: f32 = 24.0;
/// Height of an icon.
pub const ICON: f32 = 16.0;
/// The bar with the menus.
pub const TOP_BAR_HEIGHT: f32 = 32.0;
/// The bar at the bottom.
pub const STATUS_BAR_HEIGHT: f32 = 24.0;
/// Corners of what has any.
pub const RADIUS: u8 = 5;

const BODY_SIZE: f32 = 13.0;
const CAPTION_SIZE: f32 = 11.0;
const TITLE_SIZE: f32 = 15.0;

/// The colours of a theme that are not those of things.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Palette {
    /// For which surroundings.
    pub theme: Theme,
    /// Under everything: gaps, lanes of the timeline.
    pub base: Color32,
    /// Panels.
    pub panel: Color32,
    /// What lies on a panel: fields, cards, menus.
    pub raised: Color32,
    /// What lies on a panel under the pointer.
    pub hovered: Color32,
    /// Lines between surfaces.
    pub hairline: Color32,
    /// Words.
    pub text: Color32,
    /// Words of less weight.
    pub faint: Color32,
    /// What is selected or shown.
    pub accent: Color32,
    /// What is selected, as a surface.
    pub accent_surface: Color32,
}

/// The colours of a theme.
pub fn palette(theme: Theme) -> Palette {
    let rgb = |hex: u32| Color32::from_rgb((hex >> 16) as u8, (hex >> 8) as u8, hex as u8);
    let pick = |dark: u32, light: u32| rgb(if theme == Theme::Dark { dark } else { light });
    Palette {
        theme,
        base: pick(0x1B1D21, 0xE2E5E9),
        panel: pick(0x22252A, 0xF1F3F5),
        raised: pick(0x2B2F35, 0xFFFFFF),
        hovered: pick(0x343941, 0xE6E9ED),
        hairline: pick(0x363B42, 0xCDD2D8),
        text: role(ColorRole::Text, theme),
        faint: role(ColorRole::FaintText, theme),
        accent: pick(0x4C9DFF, 0x1F6FD6),
        accent_surface: pick(0x2C4361, 0xCFE2FB),
    }
}

/// The colours in use where `ui` is.
pub fn of(ui: &egui::Ui) -> Palette {
    palette(if ui.visuals().dark_mode { Theme::Dark } else { Theme::Light })
}

/// The colour of a meaning, as in the view.
pub fn role(role: ColorRole, theme: Theme) -> Color32 {
    color32(role.color(theme))
}

fn color32(color: LinearRgba) -> Color32 {
    let [r, g, b, a] = color.to_srgb8();
    Color32::from_rgba_unmultiplied(r, g, b, a)
}

/// A colour over another: how a see-through one would look on that ground.
pub fn over(ground: Color32, color: Color32, share: f32) -> Color32 {
    ground.lerp_to_gamma(color, share)
}

/// The colour of a clip on the source ribbon: always the same for the same name, and quiet.
pub fn clip_color(name: &str, palette: &Palette) -> Color32 {
    let sum = name.bytes().fold(0usize, |sum, byte| sum * 31 % 8191 + usize::from(byte));
    over(palette.panel, role(ColorRole::Take(sum % 8), palette.theme), 0.34)
}

/// The axes of the view gizmo: X, Y, Z.
pub fn axis_colors() -> [Color32; 3] {
    [
        Color32::from_rgb(0xD1, 0x5B, 0x61),
        Color32::from_rgb(0x7F, 0xB2, 0x5B),
        Color32::from_rgb(0x5B, 0x93, 0xD6),
    ]
}

/// Ordinary words.
pub fn body() -> FontId {
    FontId::new(BODY_SIZE, FontFamily::Proportional)
}

/// Small words.
pub fn caption() -> FontId {
    FontId::new(CAPTION_SIZE, FontFamily::Proportional)
}

/// Headings.
pub fn title() -> FontId {
    FontId::new(TITLE_SIZE, semibold())
}

/// Headings of panels: as small as captions, but heavier.
pub fn heading() -> FontId {
    FontId::new(BODY_SIZE, semibold())
}

fn semibold() -> FontFamily {
    FontFamily::Name("semibold".into())
}

/// Icons at their usual size.
pub fn icon() -> FontId {
    FontId::new(ICON, icons())
}

/// The family of icons, whose letters are those of [`crate::icons`].
pub fn icons() -> FontFamily {
    FontFamily::Name("icons".into())
}

/// Gives a window its letters and its look in both themes.
pub fn install(ctx: &egui::Context) {
    ctx.set_fonts(fonts());
    for theme in [Theme::Dark, Theme::Light] {
        let of = match theme {
            Theme::Dark => egui::Theme::Dark,
            Theme::Light => egui::Theme::Light,
        };
        ctx.style_mut_of(of, |style| apply(style, theme));
    }
}

/// Chooses one of the looks.
pub fn choose(ctx: &egui::Context, theme: Theme) {
    ctx.set_theme(match theme {
        Theme::Dark => egui::ThemePreference::Dark,
        Theme::Light => egui::ThemePreference::Light,
    });
}

fn fonts() -> egui::FontDefinitions {
    let mut fonts = egui::FontDefinitions::empty();
    let mut add = |name: &str, bytes: &'static [u8]| {
        fonts.font_data.insert(name.to_owned(), Arc::new(egui::FontData::from_static(bytes)));
    };
    add("regular", include_bytes!("../../../assets/fonts/Inter-Regular.ttf"));
    add("semibold", include_bytes!("../../../assets/fonts/Inter-SemiBold.ttf"));
    add("icons", include_bytes!("../../../assets/fonts/lucide.ttf"));
    let mut family = |family: FontFamily, names: &[&str]| {
        fonts.families.insert(family, names.iter().map(|&name| name.to_owned()).collect());
    };
    family(FontFamily::Proportional, &["regular", "icons"]);
    // There is no second face for numbers: `widgets::digits` keeps Inter's from dancing.
    family(FontFamily::Monospace, &["regular", "icons"]);
    family(semibold(), &["semibold", "icons"]);
    family(icons(), &["icons", "regular"]);
    fonts
}

fn apply(style: &mut egui::Style, theme: Theme) {
    let p = palette(theme);
    style.text_styles = [
        (TextStyle::Body, body()),
        (TextStyle::Button, body()),
        (TextStyle::Monospace, body()),
        (TextStyle::Small, caption()),
        (TextStyle::Heading, title()),
    ]
    .into();
    style.animation_time = 0.12;
    let spacing = &mut style.spacing;
    spacing.item_spacing = Vec2::new(2.0 * GRID, GRID);
    spacing.button_padding = Vec2::new(2.0 * GRID, 3.0);
    spacing.interact_size = Vec2::new(ICON_BUTTON, ICON_BUTTON);
    spacing.menu_margin = Margin::same(4);
    spacing.window_margin = Margin::same(16);
    spacing.tooltip_width = 320.0;
    spacing.scroll = egui::style::ScrollStyle::thin();

    let visuals = &mut style.visuals;
    visuals.dark_mode = theme == Theme::Dark;
    visuals.panel_fill = p.panel;
    visuals.window_fill = p.raised;
    visuals.extreme_bg_color = p.base;
    visuals.text_edit_bg_color = Some(p.base);
    visuals.faint_bg_color = p.raised;
    visuals.code_bg_color = p.base;
    visuals.window_stroke = Stroke::new(1.0, p.hairline);
    visuals.window_corner_radius = CornerRadius::same(8);
    visuals.menu_corner_radius = CornerRadius::same(RADIUS);
    visuals.selection.bg_fill = p.accent_surface;
    visuals.selection.stroke = Stroke::new(1.0, p.accent);
    visuals.hyperlink_color = p.accent;
    visuals.weak_text_color = Some(p.faint);
    visuals.warn_fg_color = role(ColorRole::Miss, theme);
    visuals.error_fg_color = role(ColorRole::Miss, theme);
    visuals.handle_shape = egui::style::HandleShape::Circle;
    visuals.slider_trailing_fill = true;
    let widgets = &mut visuals.widgets;
    let all = [
        (&mut widgets.noninteractive, p.panel, p.hairline, p.text),
        (&mut widgets.inactive, Color32::TRANSPARENT, Color32::TRANSPARENT, p.text),
        (&mut widgets.hovered, p.hovered, Color32::TRANSPARENT, p.text),
        (&mut widgets.active, p.accent_surface, Color32::TRANSPARENT, p.text),
        (&mut widgets.open, p.hovered, Color32::TRANSPARENT, p.text),
    ];
    for (widget, fill, stroke, text) in all {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.bg_stroke = Stroke::new(1.0, stroke);
        widget.fg_stroke = Stroke::new(1.0, text);
        widget.corner_radius = CornerRadius::same(RADIUS);
        widget.expansion = 0.0;
    }
    // The rail of a slider must be seen though buttons have no ground of their own.
    widgets.inactive.bg_fill = p.hairline;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance, WCAG 2.
    fn luminance(color: Color32) -> f32 {
        let [r, g, b] = [color.r(), color.g(), color.b()]
            .map(|c| motion_scene::color::linear_from_srgb(f32::from(c) / 255.0));
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    fn contrast(a: Color32, b: Color32) -> f32 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn words_can_be_read_on_every_surface() {
        for theme in [Theme::Dark, Theme::Light] {
            let p = palette(theme);
            for ground in [p.base, p.panel, p.raised, p.hovered, p.accent_surface] {
                assert!(contrast(p.text, ground) >= 4.5, "{theme:?} {ground:?}");
            }
            for ground in [p.base, p.panel, p.raised] {
                assert!(contrast(p.faint, ground) >= 4.5, "{theme:?} {ground:?}");
            }
        }
    }

    #[test]
    fn a_clip_keeps_its_colour() {
        let p = palette(Theme::Dark);
        assert_eq!(clip_color("walk", &p), clip_color("walk", &p));
    }
}

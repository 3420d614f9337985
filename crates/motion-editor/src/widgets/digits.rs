//! Numbers whose digits do not dance when they change.

use egui::epaint::text::FontsView;
use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, FontId, Ui};

/// `text` laid out so that every digit is as wide as the widest.
///
/// Inter's digits have widths of their own, and egui has no switch for its tabular ones; so what a
/// digit lacks to the width of the widest is put around it.
pub fn tabular(ui: &Ui, text: &str, font: &FontId, color: Color32) -> LayoutJob {
    let mut job = LayoutJob::default();
    ui.fonts_mut(|fonts| {
        let widest = ('0'..='9').map(|d| fonts.glyph_width(font, d)).fold(0.0, f32::max);
        let half_of_lack = |fonts: &mut FontsView<'_>, letter: char| {
            let lack = widest - fonts.glyph_width(font, letter);
            if letter.is_ascii_digit() { 0.5 * lack } else { 0.0 }
        };
        let letters: Vec<char> = text.chars().collect();
        for (nth, &letter) in letters.iter().enumerate() {
            // Room before a digit is room behind its neighbour.
            let before_next = letters.get(nth + 1).map_or(0.0, |next| half_of_lack(fonts, *next));
            let lacks = half_of_lack(fonts, letter) + before_next;
            let format = TextFormat {
                extra_letter_spacing: lacks,
                ..TextFormat::simple(font.clone(), color)
            };
            job.append(letter.encode_utf8(&mut [0; 4]), 0.0, format);
        }
    });
    job
}

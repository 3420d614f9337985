//! Every command by its name: a field and a list under it.

use egui::{Align2, Area, Frame, Key, Order, Pos2, RichText, Role, ScrollArea, Sense, Ui, Vec2};
use egui::{TextEdit, WidgetInfo};

use crate::icons;
use crate::state::EditorState;
use crate::theme;
use crate::ui_command::{UiCommand, key_text};

const WIDTH_PT: f32 = 460.0;
const LIST_PT: f32 = 320.0;
/// From the top of the window.
const TOP_PT: f32 = 96.0;

/// The palette's own state.
#[derive(Debug, Default)]
pub struct CommandPalette {
    is_open: bool,
    wanted: String,
    chosen: usize,
}

impl CommandPalette {
    /// Opens it anew, or closes it.
    pub fn toggle(&mut self) {
        *self = Self { is_open: !self.is_open, ..Self::default() };
    }

    /// Whether it is open.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// Draws it, if it is open. Gives the command that was chosen.
    pub fn ui(&mut self, ui: &Ui, state: &EditorState) -> Option<UiCommand> {
        if !self.is_open {
            return None;
        }
        let palette = theme::of(ui);
        let mut chosen = None;
        let area = Area::new(egui::Id::unique("command palette"))
            .order(Order::Foreground)
            .anchor(Align2::CENTER_TOP, Vec2::new(0.0, TOP_PT));
        let shown = area.show(ui.ctx(), |ui| {
            Frame::popup(ui.style()).inner_margin(8.0).fill(palette.raised).show(ui, |ui| {
                ui.set_width(WIDTH_PT);
                chosen = self.contents_ui(ui, state);
            });
        });
        let (escaped, clicked_beside) = ui.input(|input| {
            let beside = input.pointer.any_pressed()
                && input.pointer.interact_pos().is_some_and(|at| !shown.response.rect.contains(at));
            (input.key_pressed(Key::Escape), beside)
        });
        if escaped || clicked_beside || chosen.is_some() {
            self.is_open = false;
        }
        chosen
    }

    fn contents_ui(&mut self, ui: &mut Ui, state: &EditorState) -> Option<UiCommand> {
        let (down, up, enter) = ui.input_mut(|input| {
            let mut pressed = |key| input.consume_key(egui::Modifiers::NONE, key);
            (pressed(Key::ArrowDown), pressed(Key::ArrowUp), pressed(Key::Enter))
        });
        let field = TextEdit::singleline(&mut self.wanted)
            .hint_text("Find a command")
            .prefix(RichText::new(icons::SEARCH).font(theme::icon()).color(theme::of(ui).faint))
            .align(Align2::LEFT_CENTER)
            .desired_width(f32::INFINITY);
        let response = ui.add_sized([ui.available_width(), 28.0], field);
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, "Find a command"));
        response.request_focus();
        if response.changed() {
            self.chosen = 0;
        }
        let found = found(&self.wanted, state);
        let last = found.len().saturating_sub(1);
        self.chosen = match (down, up) {
            (true, _) => (self.chosen + 1).min(last),
            (_, true) => self.chosen.saturating_sub(1),
            _ => self.chosen.min(last),
        };
        ui.add_space(theme::GRID);
        if found.is_empty() {
            ui.label(RichText::new("No command is called that").color(theme::of(ui).faint));
        }
        let mut clicked = None;
        ui.spacing_mut().item_spacing.y = 0.0;
        ScrollArea::vertical().max_height(LIST_PT).show(ui, |ui| {
            for (nth, command) in found.iter().enumerate() {
                let is_chosen = nth == self.chosen;
                if line_ui(ui, *command, is_chosen, is_chosen && (down || up)) {
                    clicked = Some(*command);
                }
            }
        });
        clicked.or(if enter { found.get(self.chosen).copied() } else { None })
    }
}

fn line_ui(ui: &mut Ui, command: UiCommand, is_chosen: bool, reveal: bool) -> bool {
    let palette = theme::of(ui);
    let size = Vec2::new(ui.available_width(), theme::ROW_HEIGHT + theme::GRID);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let label = command.label();
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_chosen, &label));
    if reveal {
        response.scroll_to_me(None);
    }
    let painter = ui.painter();
    if is_chosen || response.hovered() {
        let ground = if is_chosen { palette.accent_surface } else { palette.hovered };
        painter.rect_filled(rect, f32::from(theme::RADIUS), ground);
    }
    let left = Pos2::new(rect.left() + 8.0, rect.center().y);
    painter.text(left, Align2::LEFT_CENTER, &label, theme::body(), palette.text);
    if let Some(key) = command.shortcut() {
        let right = Pos2::new(rect.right() - 8.0, rect.center().y);
        let keys = key_text(&key);
        painter.text(right, Align2::RIGHT_CENTER, keys, theme::caption(), palette.faint);
    }
    response.clicked()
}

/// Commands that can be done now and answer to `wanted`, the best first.
fn found(wanted: &str, state: &EditorState) -> Vec<UiCommand> {
    let all = UiCommand::all().into_iter().filter(|command| command.is_enabled(state));
    let mut scored: Vec<(u32, UiCommand)> =
        all.filter_map(|command| Some((score(&command.label(), wanted)?, command))).collect();
    // Stable: equals stay in the order of menus.
    scored.sort_by_key(|(score, _)| *score);
    scored.into_iter().map(|(_, command)| command).collect()
}

/// How badly `label` answers to `wanted`; `None` where its letters are not in it in that order. A
/// letter that begins a word or follows the one before costs nothing, a gap costs one, and late
/// beginnings cost a little.
fn score(label: &str, wanted: &str) -> Option<u32> {
    let label: Vec<char> = label.to_lowercase().chars().collect();
    let mut cost = 0;
    let mut next = 0;
    for letter in wanted.to_lowercase().chars().filter(|letter| !letter.is_whitespace()) {
        let starts_word = |at: usize| at == 0 || !label[at - 1].is_alphanumeric();
        let ahead = |at: &usize| label[*at] == letter;
        if next < label.len() && label[next] == letter {
            next += 1;
            continue;
        }
        let word = (next..label.len()).find(|at| ahead(at) && starts_word(*at));
        let any = (next..label.len()).find(ahead);
        let (at, gap) = match (word, any) {
            (Some(at), _) => (at, 1),
            (None, Some(at)) => (at, 4),
            (None, None) => return None,
        };
        cost += gap * 10 + at as u32;
        next = at + 1;
    }
    Some(cost)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_in_order_are_found() {
        for (label, wanted, expected) in [
            ("Play or pause", "", true),
            ("Play or pause", "pause", true),
            ("Play or pause", "pp", true),
            ("Play or pause", "esp", false),
            ("Play or pause", "PLAY OR", true),
            ("Frame all", "x", false),
        ] {
            assert_eq!(score(label, wanted).is_some(), expected, "{label} {wanted}");
        }
    }

    #[test]
    fn beginnings_of_words_win() {
        let cost = |label| score(label, "fa").unwrap();
        assert!(cost("Frame all") < cost("Half a leaf"), "initials");
        let cost = |label| score(label, "loop").unwrap();
        assert!(cost("Loop") < cost("Look over the horizon of paths"));
    }
}

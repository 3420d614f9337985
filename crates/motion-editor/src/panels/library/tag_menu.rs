//! Tagging a clip, or a stretch of it: the menu of its line.

use egui::{Button, DragValue, Key, Popup, PopupCloseBehavior, Response, RichText, TextEdit, Ui};
use motion_core::tags::HandTag;
use motion_core::units::FrameIdx;
use motion_session::clip_rows::ClipRow;
use motion_session::command::Command;

use crate::icons;
use crate::state::EditorState;
use crate::theme;

/// What is typed, while the menu is open.
#[derive(Clone, Debug, Default)]
struct Draft {
    tag: String,
    is_stretch: bool,
    from: u32,
    to: u32,
}

/// Opens by the right button on a clip's line. What is given there is a step of its own that can be
/// undone.
pub(super) fn tag_menu_ui(response: &Response, clip: &ClipRow, state: &mut EditorState) {
    Popup::context_menu(response)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .show(|ui| menu_ui(ui, clip, state));
}

fn menu_ui(ui: &mut Ui, clip: &ClipRow, state: &mut EditorState) {
    ui.set_min_width(220.0);
    ui.strong(format!("Tags of {}", clip.id));
    for own in &clip.by_hand {
        ui.horizontal(|ui| {
            let name = format!("Take away {}", words(own));
            let cross = ui
                .add(Button::new(RichText::new(icons::CLOSE).font(theme::icon())).frame(false))
                .on_hover_text(name.as_str());
            cross.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
            if cross.clicked() {
                state.apply(&Command::UntagClip { clip: clip.id.clone(), tag: own.clone() });
            }
            ui.label(words(own));
        });
    }
    let id = egui::Id::unique(("tag draft", &clip.id));
    let last = clip.n_frames.saturating_sub(1) as u32;
    let mut draft = ui.data(|data| data.get_temp::<Draft>(id)).unwrap_or_else(|| {
        let shown = state.preview.as_ref().filter(|preview| preview.clip == clip.id);
        let from = shown.map_or(0, |preview| preview.frame as u32);
        Draft { from, to: last, ..Draft::default() }
    });
    let hint = RichText::new("A tag, e.g. tired").color(theme::of(ui).faint);
    let field = ui.add(TextEdit::singleline(&mut draft.tag).hint_text(hint));
    field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "New tag"));
    ui.horizontal(|ui| {
        ui.checkbox(&mut draft.is_stretch, "Only frames");
        if draft.is_stretch {
            ui.add(DragValue::new(&mut draft.from).range(0..=last));
            ui.label("to");
            ui.add(DragValue::new(&mut draft.to).range(draft.from..=last));
        }
    });
    let by_key = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let is_named = motion_core::tags::words(&draft.tag).next().is_some();
    let button = ui.add_enabled(is_named, Button::new("Tag clip"));
    if is_named && (button.clicked() || by_key) {
        let frames = draft.is_stretch.then_some((FrameIdx(draft.from), FrameIdx(draft.to)));
        let tag = HandTag { tag: draft.tag.trim().to_owned(), frames };
        state.apply(&Command::TagClip { clip: clip.id.clone(), tag });
        draft.tag.clear();
    }
    ui.data_mut(|data| data.insert_temp(id, draft));
}

/// A tag given by hand as a person reads it.
pub(super) fn words(tag: &HandTag) -> String {
    match tag.frames {
        Some((from, to)) => format!("{}, frames {from}–{to}", tag.tag),
        None => tag.tag.clone(),
    }
}

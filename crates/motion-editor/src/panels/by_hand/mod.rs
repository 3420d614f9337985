//! stub
use egui::Ui;
use crate::state::EditorState;
/// stub
pub fn by_hand_ui(_ui: &mut Ui, _state: &mut EditorState) {}

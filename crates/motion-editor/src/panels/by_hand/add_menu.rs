//! What can be changed by hand, to be chosen by name.

use egui::{Button, Ui};
use motion_core::by_hand::{Limb, Space};
use motion_core::skeleton::JointRole;
use motion_session::document::HandChange;

use crate::hand_words::limb_name;
use crate::state::EditorState;
use crate::theme;
use crate::viewport::gesture::joint::spaced;

/// The button, and what it opens. What is chosen is changed at the playhead, by nothing yet.
pub(super) fn add_menu_ui(ui: &mut Ui, state: &mut EditorState) {
    let Some(actor) = state.stage.actors.get(state.session.active().0) else { return };
    let skeleton = std::sync::Arc::clone(&actor.skeleton);
    let button = Button::new("Add").fill(theme::of(ui).raised);
    egui::containers::menu::MenuButton::from_button(button).ui(ui, |ui| {
        ui.set_min_width(160.0);
        for limb in Limb::ALL.into_iter().filter(|limb| limb.is_on(&skeleton)) {
            if ui.button(limb_name(limb)).clicked() {
                let (shift_m, space) = ([0.0; 3], Space::World);
                state.add_hand_edit(HandChange::Hand { limb, shift_m, space });
                ui.close();
            }
        }
        ui.separator();
        ui.menu_button("Turn a joint", |ui| {
            for role in JointRole::ALL.iter().filter(|role| skeleton.by_role(**role).is_some()) {
                if ui.button(spaced(role.name())).clicked() {
                    let joint = role.name().to_owned();
                    state.add_hand_edit(HandChange::Joint { joint, turn_deg: [0.0; 3] });
                    ui.close();
                }
            }
        });
    });
}

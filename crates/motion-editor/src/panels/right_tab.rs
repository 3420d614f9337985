//! The lower part of the right panel: what is selected, what it costs, and why.

use egui::{RichText, Role, Ui, WidgetInfo};

use super::{by_hand, cost, inspector, why};
use crate::state::EditorState;
use crate::theme;

/// What it shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum RightTab {
    /// The fields of what is selected.
    #[default]
    Inspector,
    /// What takes cost, by term.
    Cost,
    /// What is missed, constraint by constraint and cut by cut.
    Why,
    /// What is changed by hand on the shown take.
    ByHand,
}

impl RightTab {
    /// From left to right.
    pub const ALL: [Self; 4] = [Self::Inspector, Self::Cost, Self::Why, Self::ByHand];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Inspector => "Inspector",
            Self::Cost => "Cost",
            Self::Why => "Why",
            Self::ByHand => "By hand",
        }
    }

    fn tooltip(self) -> &'static str {
        match self {
            Self::Inspector => "The fields of what is selected",
            Self::Cost => "What each take costs, and for what",
            Self::Why => "What each constraint and each cut of the shown take costs and misses",
            Self::ByHand => "What is changed by hand on the shown take, and when what is shown",
        }
    }
}

/// The tabs.
pub fn tab_bar_ui(ui: &mut Ui, state: &mut EditorState) {
    let palette = theme::of(ui);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0 * theme::GRID;
        for tab in RightTab::ALL {
            let is_on = state.right_tab == tab;
            let color = if is_on { palette.text } else { palette.faint };
            let text = RichText::new(tab.name()).font(theme::heading()).color(color);
            let label = egui::Label::new(text).selectable(false).sense(egui::Sense::click());
            let response = ui.add(label).on_hover_text(tab.tooltip());
            response.widget_info(|| WidgetInfo::selected(Role::Tab, true, is_on, tab.name()));
            if is_on {
                let y = response.rect.bottom() + 3.0;
                let line = egui::Stroke::new(2.0, palette.accent);
                ui.painter().hline(response.rect.x_range(), y, line);
            }
            if response.clicked() {
                state.right_tab = tab;
            }
        }
    });
    ui.add_space(theme::GRID);
}

/// What the chosen tab shows.
pub fn tab_ui(ui: &mut Ui, state: &mut EditorState) {
    match state.right_tab {
        RightTab::Inspector => inspector::inspector_ui(ui, state),
        RightTab::Cost => cost::cost_ui(ui, state),
        RightTab::Why => why::why_ui(ui, state),
        RightTab::ByHand => by_hand::by_hand_ui(ui, state),
    }
}

//! A part of the motion made slower or faster.

use egui::{Button, Ui};
use motion_core::by_hand::{Knot, Retime};
use motion_session::command::Command;

use crate::hand_time::source_of;
use crate::state::EditorState;
use crate::theme;

/// Without a chosen part it is what lies so many frames around the playhead.
const AROUND_FRAMES: f64 = 15.0;
/// Over so many frames on both sides the old speed becomes the new one.
const EASE_FRAMES: f64 = 6.0;

/// The buttons.
pub fn tempo_ui(ui: &mut Ui, state: &mut EditorState) {
    let (from, to) = range(state);
    ui.horizontal(|ui| {
        for (name, speed, words) in
            [("Slower here", 0.5, "half"), ("Faster here", 2.0, "twice")]
        {
            let tooltip = format!(
                "Shows f {from:.0}–{to:.0} at {words} the speed: the chosen range, or half a second \
                 around the playhead"
            );
            let button = Button::new(name).fill(theme::of(ui).raised);
            if ui.add(button).on_hover_text(tooltip).clicked() {
                change(state, name, speed);
            }
        }
        let is_bent = state.hand_layer().is_some_and(|layer| !layer.retime().is_identity());
        let button = Button::new("Own timing").fill(theme::of(ui).raised);
        let tooltip = "Shows the take in its own time again";
        if ui.add_enabled(is_bent, button).on_hover_text(tooltip).clicked()
            && let Some(take) = state.hand_take()
        {
            state.apply(&Command::RetimeByHand { take, knots: None });
        }
    });
}

/// The output frames that are meant.
fn range(state: &EditorState) -> (f64, f64) {
    let last = state.last_frame() as f64;
    let (from, to) = match state.chosen_range() {
        Some(range) => (f64::from(range.from), f64::from(range.to)),
        None => {
            let now = state.frame().round();
            (now - AROUND_FRAMES, now + AROUND_FRAMES)
        }
    };
    (from.max(0.0), to.min(last))
}

fn change(state: &mut EditorState, label: &str, speed: f64) {
    let (from, to) = range(state);
    let Some(take) = state.hand_take() else { return };
    let retime = state.hand_layer().map(|layer| layer.retime().clone()).unwrap_or_default();
    let knots = at_speed(&retime, state.n_source_frames(), (from as u32, to as u32), speed);
    state.apply_all(label, &[Command::RetimeByHand { take, knots: Some(knots) }]);
}

/// The curve's knots once `from` to `to` (output frames) goes `speed` times as fast as it did; what
/// comes later is shown that much earlier or later, at its own speed.
pub fn at_speed(retime: &Retime, n_source: usize, (from, to): (u32, u32), speed: f64) -> Vec<Knot> {
    if to <= from {
        return retime.knots().to_vec();
    }
    let frames = retime.source_frames(n_source);
    let length = f64::from(to - from);
    let new_length = (length / speed).round().max(1.0);
    let (start, end) = (f64::from(from), f64::from(to));
    let after = |output: f64| match output {
        output if output <= start => output,
        output if output >= end => output - length + new_length,
        output => start + (output - start) * new_length / length,
    };
    let last = (frames.len() - 1) as f64;
    let before = start - EASE_FRAMES;
    let behind = end + EASE_FRAMES;
    // Knots beside the part keep what is further away as it is, knots within it the new speed even.
    let is_long = length > 3.0 * EASE_FRAMES;
    let within = [start + EASE_FRAMES, end - EASE_FRAMES].into_iter().filter(|_| is_long);
    let own = [before, start, end, behind]
        .into_iter()
        .chain(within)
        .filter(|at| *at > 0.0 && *at <= last);
    let known = retime.knots().iter().map(|knot| f64::from(knot.output));
    let known = known.filter(|at| *at <= before || *at >= behind || (start..=end).contains(at));
    let mut outputs: Vec<f64> = own.chain(known).collect();
    outputs.sort_by(f64::total_cmp);
    outputs.dedup();
    let knot = |at: f64| Knot { output: after(at).round() as u32, source: source_of(&frames, at) };
    let mut knots: Vec<Knot> = outputs.into_iter().map(knot).collect();
    knots.dedup_by_key(|knot| knot.output);
    knots
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How long 100 frames become, and the steps around the middle of the part and far from it.
    #[track_caller]
    fn check(before: &Retime, range: (u32, u32), speed: f64, n_output: usize) -> Vec<f64> {
        let knots = at_speed(before, 100, range, speed);
        let retime = Retime::new(knots).expect("a curve");
        let frames = retime.source_frames(100);
        assert_eq!(frames.len(), n_output);
        frames
    }

    #[test]
    fn a_part_gets_slower_or_faster_and_the_rest_stays() {
        let own = Retime::default();
        let slow = check(&own, (40, 60), 0.5, 120);
        assert!((slow[60] - slow[59] - 0.5).abs() < 0.05);
        assert!((slow[20] - 20.0).abs() < 1e-6 && (slow[100] - 80.0).abs() < 1e-6);
        let fast = check(&own, (40, 60), 2.0, 90);
        assert!((fast[45] - fast[44] - 2.0).abs() < 0.3);
        assert!((fast[20] - 20.0).abs() < 1e-6 && (fast[80] - 90.0).abs() < 1e-6);
        check(&own, (0, 30), 0.5, 130);
        check(&own, (80, 99), 0.5, 119);
        // Twice as slow, then as it was.
        let knots = at_speed(&own, 100, (40, 60), 0.5);
        let slow = Retime::new(knots).unwrap();
        let again = check(&slow, (40, 80), 2.0, 100);
        assert!((again[50] - 50.0).abs() < 0.5, "{}", again[50]);
        assert_eq!(at_speed(&own, 100, (40, 40), 0.5), []);
    }
}

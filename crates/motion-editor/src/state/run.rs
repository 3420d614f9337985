//! What commands do.

use motion_scene::color::Theme;
use motion_session::document::CharacterIdx;

use super::{CompareMode, EditorState};
use crate::panels::right_tab::RightTab;
use crate::settings::{Navigation, Tool};
use crate::ui_command::UiCommand as C;

/// What a key turns by.
const TURN_DEG: f64 = 5.0;

impl EditorState {
    /// Does a command that needs nothing but the state; gives whether it was one. What cannot be
    /// done now is not.
    pub fn run(&mut self, command: C) -> bool {
        if !command.is_enabled(self) {
            return true;
        }
        self.run_playing(command)
            || self.run_takes(command)
            || self.run_editing(command)
            || self.run_view(command)
    }

    fn run_playing(&mut self, command: C) -> bool {
        let now = self.frame_number();
        let second = self.fps().round() as i32;
        match command {
            C::PlayPause => self.toggle_playing(),
            C::StepBack => self.step(-1),
            C::StepAhead => self.step(1),
            C::SecondBack => self.step(-second),
            C::SecondAhead => self.step(second),
            C::PreviousStop => {
                let stop = self.stops().into_iter().rev().find(|stop| *stop < now);
                self.jump(stop);
            }
            C::NextStop => {
                let stop = self.stops().into_iter().find(|stop| *stop > now);
                self.jump(stop);
            }
            C::ToStart => self.seek(f64::from(self.session.playback().range().from)),
            C::ToEnd => self.jump(Some(self.session.playback().range().to as usize)),
            C::PlayBackwards => self.play_back(),
            C::PlayAhead => self.play(),
            C::Stop => self.stop(),
            C::Loop => self.toggle_loop(),
            C::LoopIn => self.loop_from(now as u32),
            C::LoopOut => self.loop_to(now as u32),
            C::ClearLoop => self.set_range(None),
            C::Slower => self.change_speed(false),
            C::Faster => self.change_speed(true),
            C::NormalSpeed => self.set_speed(1.0),
            _ => return false,
        }
        true
    }

    fn run_takes(&mut self, command: C) -> bool {
        let search = self.session.search();
        match command {
            C::PauseSearch if search.is_paused() => search.resume(),
            C::PauseSearch => search.pause(),
            C::Shake => search.shake(),
            C::FollowBest => {
                self.settings.follow_best = !self.settings.follow_best;
                search.follow_best(self.settings.follow_best);
            }
            C::ShowTake(n) => self.show_card(usize::from(n).saturating_sub(1)),
            C::FlipTakes => {
                let before = self.shown_before;
                before.into_iter().for_each(|id| self.show_take(id));
            }
            C::PinTake(n) => {
                let id = self.cards.get(usize::from(n).wrapping_sub(1)).map(|card| card.id);
                id.into_iter().for_each(|id| self.toggle_pin(id));
            }
            C::ShowBetter => {
                let better = self.better();
                better.into_iter().for_each(|(id, _)| self.show_take(id));
            }
            C::Compare => match self.comparing.mode {
                CompareMode::Off => self.toggle_comparing(CompareMode::Overlay),
                on => self.toggle_comparing(on),
            },
            C::CompareSplit => self.toggle_comparing(CompareMode::Split),
            C::RenameTake => self.shown().into_iter().for_each(|id| self.begin_renaming(id)),
            C::MoreLikeThis => self.shown().into_iter().for_each(|id| self.more_like(id)),
            C::LockStretch => self.lock_stretch(),
            _ => return false,
        }
        true
    }

    fn run_editing(&mut self, command: C) -> bool {
        match command {
            C::Undo => {
                self.notices.clear_refusal();
                self.session.undo();
                self.hovered = None;
                self.refresh();
            }
            C::Redo => {
                self.notices.clear_refusal();
                self.session.redo();
                self.hovered = None;
                self.refresh();
            }
            C::Delete => self.delete_selected(),
            C::Duplicate => self.duplicate_selected(),
            C::SelectAll => self.select_all(),
            C::SelectNone => {
                self.session.selection_mut().clear();
                self.selected_hand_edit = None;
            }
            C::RetimeBack => self.retime_selected(-1),
            C::RetimeAhead => self.retime_selected(1),
            C::NextCharacter => {
                let n = self.session.document().characters().len();
                self.activate(CharacterIdx((self.session.active().0 + 1) % n.max(1)));
            }
            C::SelectTool => {
                let cancelled = self.cancel();
                if !cancelled && self.settings.tool == Tool::Select {
                    self.session.selection_mut().clear();
                }
                self.settings.tool = Tool::Select;
            }
            C::CheckpointTool => self.settings.tool = Tool::Checkpoint,
            C::JointTargetTool => self.settings.tool = Tool::JointTarget,
            C::PoseTool => self.settings.tool = Tool::Pose,
            C::PathTool => self.settings.tool = Tool::Path,
            // Once more is another form.
            C::ObstacleTool if self.settings.tool == Tool::Obstacle => {
                self.obstacle_form = self.obstacle_form.next();
            }
            C::ObstacleTool => self.settings.tool = Tool::Obstacle,
            C::ByHandTool => {
                self.settings.tool = Tool::ByHand;
                self.right_tab = RightTab::ByHand;
            }
            C::AddCheckpoint => self.add_checkpoint_ahead(),
            C::AddJointTarget => self.add_joint_target_here(),
            C::AddPose => self.add_pose_here(),
            C::AddStyle => self.add_style_here(),
            C::MeetHere => self.meet_here(),
            C::TurnLeft => self.turn_selected(TURN_DEG),
            C::TurnRight => self.turn_selected(-TURN_DEG),
            _ => return false,
        }
        true
    }

    fn run_view(&mut self, command: C) -> bool {
        let settings = &mut self.settings;
        let flip = |flag: &mut bool| *flag = !*flag;
        match command {
            C::Follow => flip(&mut settings.follow),
            C::Trail => flip(&mut settings.trail),
            C::JointTrails => flip(&mut settings.joint_trails),
            C::Ghosts => settings.ghosts = settings.ghosts.next(),
            C::GhostsAre(mode) => settings.ghosts = mode,
            C::ReducedMotion => flip(&mut settings.reduced_motion),
            C::LeftPanel => flip(&mut settings.left.open),
            C::RightPanel => flip(&mut settings.right.open),
            C::Timeline => flip(&mut settings.timeline.open),
            C::Curves => flip(&mut settings.curves_open),
            C::TimeUnit => settings.time_unit = settings.time_unit.next(),
            C::Theme => {
                settings.theme = match settings.theme {
                    Theme::Dark => Theme::Light,
                    Theme::Light => Theme::Dark,
                };
                crate::theme::choose(&self.wake, self.settings.theme);
                self.refresh();
            }
            C::Navigation => {
                settings.navigation = match settings.navigation {
                    Navigation::Blender => Navigation::Industry,
                    Navigation::Industry => Navigation::Blender,
                }
            }
            _ => return false,
        }
        true
    }

    fn jump(&mut self, to: Option<usize>) {
        to.into_iter().for_each(|frame| self.stop_at(frame));
    }
}

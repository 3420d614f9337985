//! What a command is called in the undo menu.

use super::Command;

impl Command {
    /// A verb and what it is about, as it stands behind "Undo".
    pub fn label(&self) -> &'static str {
        match self {
            Self::AddCheckpoint { .. } => "Add checkpoint",
            Self::AddJointTarget { .. } => "Add joint target",
            Self::AddPose { .. } => "Add pose",
            Self::AddStyle { .. } => "Add style",
            Self::AddPath { .. } => "Draw path",
            Self::AddLock { .. } => "Lock stretch",
            Self::Move { .. } => "Move",
            Self::SetPlace { .. } => "Change place",
            Self::Turn { .. } => "Turn",
            Self::Raise { .. } => "Change height",
            Self::MoveJointTarget { .. } => "Move joint target",
            Self::SetJoint { .. } => "Change joint",
            Self::SetPoseSource { .. } => "Change pose",
            Self::SetVelocity { .. } => "Change velocity",
            Self::SetTag { .. } => "Change style",
            Self::Reshape { .. } => "Reshape path",
            Self::SetPathHeading { .. } => "Change heading",
            Self::Retime { .. } | Self::RetimeSpan { .. } => "Retime",
            Self::Duplicate { .. } => "Duplicate",
            Self::Remove { .. } => "Delete",
            Self::SetWeight { .. } => "Change weight",
            Self::SetTolerance { .. } => "Change tolerance",
            Self::AddInteraction { .. } => "Meet",
            Self::ChangeInteraction { .. } => "Change meeting",
            Self::SetInteractionWeight { .. } => "Change weight",
            Self::RemoveInteraction { .. } => "Delete meeting",
            Self::AddObstacle { .. } => "Add obstacle",
            Self::ChangeObstacle { .. } => "Change obstacle",
            Self::RemoveObstacle { .. } => "Delete obstacle",
            Self::SetLength { .. } => "Change length",
            Self::SetLengthWeight { .. } | Self::SetTermWeight { .. } => "Change weights",
            Self::SetPalette { .. } => "Change palette",
            Self::SetSeed { .. } => "Change seed",
            Self::SetMirror { .. } => "Change mirroring",
            Self::SetBridges { .. } => "Change bridges",
            Self::SetLibrary { .. } => "Change library",
            Self::RenameProject { .. } => "Rename project",
            Self::AddCharacter { .. } => "Add character",
            Self::RenameCharacter { .. } => "Rename character",
            Self::RemoveCharacter { .. } => "Delete character",
            Self::SetBody { .. } => "Change body",
            Self::PinTake { .. } => "Pin take",
            Self::UnpinTake { .. } => "Unpin take",
            Self::NameTake { .. } => "Name take",
            Self::AddByHand { .. } | Self::ChangeByHand { .. } => "Change by hand",
            Self::RemoveByHand { .. } => "Delete change by hand",
            Self::RetimeByHand { .. } => "Retime take",
            Self::ClearByHand { .. } => "Clear changes by hand",
        }
    }
}

//! What a person is asked to choose.

/// A question that paths are the answer to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ask {
    /// Which project to open.
    OpenProject,
    /// Where to save the project.
    SaveProject {
        /// A file's name to begin with.
        suggested: String,
    },
    /// Which library to search in.
    OpenLibrary,
    /// Which clips to take in, as many as wanted.
    ImportClips,
    /// Which folder of clips to take in.
    ImportFolder,
    /// Which character to see the motion on.
    OpenCharacter,
    /// Where to write a motion.
    ExportMotion {
        /// A file's name to begin with.
        suggested: String,
    },
    /// Into which folder to write motions.
    ExportFolder,
    /// Where to write a picture or a film.
    ExportPicture {
        /// A file's name to begin with.
        suggested: String,
    },
}

/// What kind of answer is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// A file that is there.
    File,
    /// Files that are there, in one folder.
    Files,
    /// A folder that is there.
    Folder,
    /// A file to be written.
    NewFile,
}

impl Ask {
    /// What kind of answer is wanted.
    pub fn wanted(&self) -> Wanted {
        match self {
            Self::OpenProject | Self::OpenLibrary | Self::OpenCharacter => Wanted::File,
            Self::ImportClips => Wanted::Files,
            Self::ImportFolder | Self::ExportFolder => Wanted::Folder,
            Self::SaveProject { .. } | Self::ExportMotion { .. } | Self::ExportPicture { .. } => {
                Wanted::NewFile
            }
        }
    }

    /// What stands over the dialog.
    pub fn title(&self) -> &'static str {
        match self {
            Self::OpenProject => "Open project",
            Self::SaveProject { .. } => "Save project",
            Self::OpenLibrary => "Choose library",
            Self::ImportClips => "Import clips",
            Self::ImportFolder => "Import a folder of clips",
            Self::OpenCharacter => "Choose character",
            Self::ExportMotion { .. } => "Export motion",
            Self::ExportFolder => "Export motions to a folder",
            Self::ExportPicture { .. } => "Export picture or film",
        }
    }

    /// What the button says.
    pub fn verb(&self) -> &'static str {
        match self {
            Self::OpenProject | Self::OpenLibrary | Self::OpenCharacter => "Open",
            Self::ImportClips | Self::ImportFolder => "Import",
            Self::SaveProject { .. } => "Save",
            Self::ExportMotion { .. } | Self::ExportFolder | Self::ExportPicture { .. } => "Export",
        }
    }

    /// What files that fit are called together.
    pub fn kind_of_files(&self) -> &'static str {
        match self {
            Self::OpenProject | Self::SaveProject { .. } => "Gaitway projects",
            Self::OpenLibrary => "Gaitway libraries",
            Self::ImportClips
            | Self::ImportFolder
            | Self::ExportMotion { .. }
            | Self::ExportFolder => "Motions",
            Self::OpenCharacter => "Characters",
            Self::ExportPicture { .. } => "Pictures and films",
        }
    }

    /// How names of files that fit end; a new file without any of them gets the first.
    pub fn endings(&self) -> &'static [&'static str] {
        match self {
            Self::OpenProject | Self::SaveProject { .. } => &["gaitway"],
            Self::OpenLibrary => &["gwlib"],
            Self::ImportClips | Self::ImportFolder => &["bvh", "glb", "gltf"],
            Self::OpenCharacter => &["glb", "gltf"],
            Self::ExportMotion { .. } | Self::ExportFolder => &["bvh"],
            Self::ExportPicture { .. } => &["png", "gif", "mp4", "webm"],
        }
    }

    /// A new file's name to begin with.
    pub fn suggested(&self) -> &str {
        match self {
            Self::SaveProject { suggested }
            | Self::ExportMotion { suggested }
            | Self::ExportPicture { suggested } => suggested,
            _ => "",
        }
    }
}

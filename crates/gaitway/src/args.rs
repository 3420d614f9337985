//! What was typed. What it means, checked, is the command's business.

#[cfg(feature = "render")]
pub(crate) mod render;

use std::ffi::OsString;
use std::path::PathBuf;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory as _, Parser, Subcommand};
use motion_core::similarity::Shard;
use motion_core::units::Fps;

use crate::output::Failure;

/// Say where a person must be, how and when; get the motion, cut from motion capture.
#[derive(Debug, Parser)]
#[command(
    name = "gaitway",
    version,
    subcommand_value_name = "COMMAND",
    after_help = "Without a command, gaitway opens its editor on a built-in sample; without a display, or with\n\
        --json, it authors that sample and says where it is.\n\n\
        Exit status: 0 done; 2 the input or the arguments are wrong; 1 anything else that failed."
)]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) common: Common,
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

const HEADING: &str = "Options of every command";

/// Options of every command.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct Common {
    /// Print one JSON document on stdout, and nothing else there
    #[arg(long, global = true, help_heading = HEADING)]
    pub(crate) json: bool,
    /// Say nothing beside the answer but errors
    #[arg(short, long, global = true, help_heading = HEADING, conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// Say more
    #[arg(short, long, global = true, help_heading = HEADING)]
    pub(crate) verbose: bool,
    /// How many threads may work [default: one for each processor]
    #[arg(long, global = true, help_heading = HEADING, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Where random choices start; the same seed makes the same choices
    #[arg(long, global = true, help_heading = HEADING, value_name = "N")]
    pub(crate) seed: Option<u64>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Build a library from clips, or look into one
    #[command(subcommand, visible_alias = "lib")]
    Library(Library),
    /// Find motions for a project and write them with a report
    #[command(after_help = "Examples:\n  \
        gaitway solve corner.gaitway -o out\n  \
        gaitway solve corner.gaitway --library cmu.gwlib -o out --time 2\n  \
        gaitway solve corner.gaitway -o out --iterations 200 --seed 7    (the same bytes every time)\n  \
        gaitway solve corner.gaitway -o out-af02 --search af02 --seed 7    (what the paper's search finds)")]
    Solve(Solve),
    /// Bring a motion to another format, rate or unit
    #[command(after_help = "Example:\n  gaitway convert take.bvh take-30.bvh --fps 30 --unit m")]
    Convert(Convert),
    /// Judge a motion: foot slide, penetration, smoothness
    #[command(after_help = "Examples:\n  \
        gaitway measure out/A-1.bvh\n  \
        gaitway measure out/A-1.bvh --json\n  \
        gaitway measure --explain")]
    Measure(Measure),
    /// Show a motion as a picture, a contact sheet or a film
    #[cfg(feature = "render")]
    #[command(after_help = "Examples:\n  \
        gaitway render corner.gaitway -o corner.png              (a contact sheet of the best motion)\n  \
        gaitway render out/A-1.bvh -o walk.gif --camera follow\n  \
        gaitway render out/A-1.bvh -o pose.png --frame 80 --ghosts 5\n  \
        gaitway render corner.gaitway -o corner.mp4 --character hero.glb --size 1920x1080")]
    Render(render::Render),
    /// Open a window to author a project's motions
    #[cfg(feature = "editor")]
    #[command(after_help = "Examples:\n  \
        gaitway edit                     (the built-in sample)\n  \
        gaitway edit corner.gaitway")]
    Edit {
        /// The project [default: the built-in sample]
        project: Option<PathBuf>,
        /// Work on it that was saved when a window went down
        #[arg(long, hide = true, value_name = "FILE")]
        recovered: Option<PathBuf>,
    },
    /// Print a completion script for a shell
    #[command(after_help = "Example:\n  \
        gaitway completions bash > ~/.local/share/bash-completion/completions/gaitway")]
    Completions {
        /// Which shell
        shell: clap_complete::Shell,
    },
    /// Write the manual pages
    #[command(after_help = "Example:\n  gaitway man -o ~/.local/share/man/man1")]
    Man {
        /// The folder to write them to; made if it is missing
        #[arg(short, long, value_name = "DIR")]
        output: PathBuf,
    },
}

/// What can be done with libraries.
#[derive(Debug, Subcommand)]
pub(crate) enum Library {
    /// Import clips, find where they are alike, and save the library
    #[command(after_help = "Examples:\n  \
        gaitway library build clips/ -o clips.gwlib\n  \
        gaitway library build clips/ more/*.bvh -o clips.gwlib --mirror --fps 30\n  \
        gaitway library build new/ -o more.gwlib --extend clips.gwlib\n  \
        gaitway library build clips/ -o 2-of-8.gwpart --shard 2/8    (then: library merge)")]
    Build(LibraryBuild),
    /// Make a library of the parts that `library build --shard` wrote
    #[command(after_help = "Example:\n  gaitway library merge *-of-8.gwpart -o clips.gwlib")]
    Merge {
        /// Every part of the build, in any order
        #[arg(required = true, value_name = "PART")]
        parts: Vec<PathBuf>,
        /// The library to write
        #[arg(short, long, value_name = "FILE")]
        output: PathBuf,
    },
    /// Say what is in a library
    #[command(after_help = "Examples:\n  \
        gaitway library info clips.gwlib\n  \
        gaitway library info builtin --json")]
    Info {
        /// A .gwlib file, or `builtin`
        library: PathBuf,
    },
    /// Say what the clips can do and what they cannot, and what to record
    #[command(after_help = "Examples:\n  \
        gaitway library coverage clips.gwlib\n  \
        gaitway library coverage builtin --json")]
    Coverage {
        /// A .gwlib file, or `builtin`
        library: PathBuf,
    },
    /// List every cut from one clip to another: frame left, frame entered, cost
    #[command(after_help = "Example:\n  gaitway library edges clips.gwlib --from walk --to run")]
    Edges {
        /// A .gwlib file, or `builtin`
        library: PathBuf,
        /// The clip that is left
        #[arg(long, value_name = "CLIP")]
        from: String,
        /// The clip that is entered
        #[arg(long, value_name = "CLIP")]
        to: String,
    },
}

/// `gaitway library build`.
#[derive(Debug, clap::Args)]
pub(crate) struct LibraryBuild {
    /// Clips, and folders of clips (the files in them, not below)
    #[arg(required = true, value_name = "INPUT")]
    pub(crate) inputs: Vec<PathBuf>,
    /// The library to write
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// Look into folders below, too
    #[arg(long)]
    pub(crate) recursive: bool,
    /// How unlike two frames may be and still be cut between [default: found from the clips]
    #[arg(long, value_name = "COST", value_parser = positive, allow_negative_numbers = true)]
    pub(crate) tau: Option<f64>,
    /// Add every clip's mirror image
    #[arg(long)]
    pub(crate) mirror: bool,
    /// Leave clips apart that τ leaves apart
    #[arg(long)]
    pub(crate) no_bridges: bool,
    /// The library's rate, frames per second
    #[arg(long, value_name = "RATE", default_value = "30", value_parser = fps, allow_negative_numbers = true)]
    pub(crate) fps: Fps,
    /// The motion file whose body the library has [default: the body that most frames have]
    #[arg(long, value_name = "FILE")]
    pub(crate) skeleton: Option<PathBuf>,
    /// Add the clips to this library, whose clips are not compared with each other again; its
    /// skeleton, rate, metric and τ stay
    #[arg(long, value_name = "FILE", conflicts_with_all = ["tau", "fps", "skeleton", "shard"])]
    pub(crate) extend: Option<PathBuf>,
    /// Memory that the build may take, GiB: where it would take more, nothing is begun
    #[arg(long, value_name = "GIB", default_value = "4", value_parser = positive, allow_negative_numbers = true)]
    pub(crate) memory: f64,
    /// Do only the K-th of N shares and write a part (.gwpart) for `library merge`
    #[arg(long, value_name = "K/N", value_parser = shard)]
    pub(crate) shard: Option<Shard>,
    #[command(flatten)]
    pub(crate) reading: Reading,
}

/// `gaitway solve`.
#[derive(Debug, clap::Args)]
pub(crate) struct Solve {
    /// The project
    pub(crate) project: PathBuf,
    /// The folder for motions and report; made if it is missing
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// A .gwlib file, a folder of clips or `builtin`, instead of the project's choice
    #[arg(long, value_name = "LIBRARY")]
    pub(crate) library: Option<PathBuf>,
    /// Use every clip's mirror image, too
    #[arg(long)]
    pub(crate) mirror: bool,
    /// Do not cut where τ alone would not
    #[arg(long)]
    pub(crate) no_bridges: bool,
    /// Search for so many rounds: the reproducible budget
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..), conflicts_with = "time")]
    pub(crate) iterations: Option<u64>,
    /// Search for so many seconds [default: 5]
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_negative_numbers = true)]
    pub(crate) time: Option<f64>,
    /// The search that looks for motions; the others are there to be compared with
    #[arg(long, value_name = "SEARCH", value_enum, default_value = "gaitway")]
    pub(crate) search: SearchName,
    /// The format of the motions
    #[arg(long, value_name = "FORMAT", value_enum, default_value = "bvh")]
    pub(crate) format: Format,
    /// How many different motions to write [default: the project's number]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) alternatives: Option<u16>,
}

/// `gaitway convert`.
#[derive(Debug, clap::Args)]
pub(crate) struct Convert {
    /// The motion to read
    pub(crate) input: PathBuf,
    /// The motion to write; its ending says the format
    pub(crate) output: PathBuf,
    /// The rate to bring it to, frames per second [default: as it is]
    #[arg(long, value_name = "RATE", value_parser = fps, allow_negative_numbers = true)]
    pub(crate) fps: Option<Fps>,
    /// The unit to write
    #[arg(long, value_enum, default_value = "cm")]
    pub(crate) unit: Unit,
    /// Keep a T-pose before the motion
    #[arg(long)]
    pub(crate) keep_tpose: bool,
    #[command(flatten)]
    pub(crate) reading: Reading,
}

/// What overrides what is recognised in motion files.
#[derive(Debug, clap::Args)]
pub(crate) struct Reading {
    /// Metres to one unit of the files [default: recognised from the body's size]
    #[arg(long, value_name = "METRES", value_parser = positive, allow_negative_numbers = true)]
    pub(crate) scale: Option<f64>,
    /// The axis that points up in the files [default: recognised]
    #[arg(long, value_name = "AXIS", value_enum, ignore_case = true)]
    pub(crate) up: Option<UpAxis>,
    /// A JSON file with an object from roles to joint names
    #[arg(long, value_name = "FILE")]
    pub(crate) roles: Option<PathBuf>,
}

/// `gaitway measure`.
#[derive(Debug, clap::Args)]
pub(crate) struct Measure {
    /// The motion
    #[arg(required_unless_present = "explain")]
    pub(crate) motion: Option<PathBuf>,
    /// Print the definition of every figure
    #[arg(long)]
    pub(crate) explain: bool,
    #[command(flatten)]
    pub(crate) reading: Reading,
}

/// An axis that points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum UpAxis {
    /// As BVH files usually have it
    Y,
    /// As Blender and most robots have it
    Z,
}

/// A unit of length in a written file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Unit {
    /// Metres
    M,
    /// Centimetres, which most tools expect of BVH
    Cm,
}

/// A search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum SearchName {
    /// Gaitway's own
    Gaitway,
    /// That of Arikan & Forsyth 2002, as the paper has it
    Af02,
    /// Anytime weighted A* over the coarse graph (after Safonova & Hodgins 2007)
    Astar,
}

/// A format of motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Format {
    /// Biovision hierarchy
    Bvh,
}

/// A share of a build: counted from 1, as people and batch systems do.
fn shard(text: &str) -> Result<Shard, String> {
    let numbers = text.split_once('/').and_then(|(k, n)| {
        let (k, n): (u32, u32) = (k.parse().ok()?, n.parse().ok()?);
        Shard::new(k.checked_sub(1)?, n).filter(|_| n <= MAX_SHARDS)
    });
    numbers.ok_or_else(|| format!("use K/N with K from 1 to N, and N at most {MAX_SHARDS}"))
}

/// Most shares of a build: beyond them each is mostly the reading of clips.
const MAX_SHARDS: u32 = 1000;

/// A number above zero.
fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("use a number above 0".to_owned()),
    }
}

/// Frames per second.
fn fps(text: &str) -> Result<Fps, String> {
    let wrong = |_| "use a number from 1 to 1000".to_owned();
    Fps::new(text.parse().unwrap_or(f64::NAN)).map_err(wrong)
}

/// Reads the command line. Help and version are printed, which is no failure.
pub(crate) fn parse(words: impl Iterator<Item = OsString>) -> Result<Args, Failure> {
    let words: Vec<OsString> = words.collect();
    Args::try_parse_from(&words).map_err(|error| match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => Failure::Help(error),
        _ => Failure::wrong(in_one_line(&error, &words)),
    })
}

/// The whole program for help, completions and manual pages.
pub(crate) fn program() -> clap::Command {
    Args::command()
}

/// Clap's paragraph as `what is wrong; what to do`.
fn in_one_line(error: &clap::Error, words: &[OsString]) -> String {
    let text = error.render().to_string();
    let first = text.split("\n\n").next().unwrap_or_default();
    let what = first.lines().map(str::trim).collect::<Vec<_>>().join(" ");
    let what = what.trim_start_matches("error: ");
    let help = help_command(words);
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return format!("a command is missing; `{help}` lists them");
    }
    let suggested =
        [ContextKind::SuggestedArg, ContextKind::SuggestedSubcommand, ContextKind::SuggestedValue]
            .into_iter()
            .find_map(|kind| match error.get(kind)? {
                ContextValue::String(name) => Some(name.clone()),
                ContextValue::Strings(names) => names.first().cloned(),
                _ => None,
            });
    match suggested {
        Some(name) => format!("{what}; did you mean {name}?"),
        None => format!("{what}; `{help}` says what can be given"),
    }
}

/// How to ask for the help of the command that was typed.
fn help_command(words: &[OsString]) -> String {
    let program = program();
    let mut command = &program;
    let mut help = "gaitway".to_owned();
    for word in words.iter().skip(1).filter_map(|word| word.to_str()) {
        if let Some(found) = command.find_subcommand(word) {
            command = found;
            help = format!("{help} {}", found.get_name());
        }
    }
    format!("{help} --help")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definition_holds_together() {
        program().debug_assert();
    }

    #[test]
    fn every_command_has_an_example() {
        fn walk(command: &clap::Command) {
            for inner in command.get_subcommands() {
                walk(inner);
            }
            let after = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            let is_leaf = command.get_subcommands().next().is_none();
            assert!(!is_leaf || after.contains("Example"), "{}", command.get_name());
        }
        walk(&program());
    }

    #[track_caller]
    fn check(words: &str, expected: &str) {
        let words = words.split(' ').map(OsString::from);
        match parse(words) {
            Err(Failure::Wrong(line)) => assert_eq!(line, expected),
            other => panic!("expected a wrong command line, got {other:?}"),
        }
    }

    #[test]
    fn a_wrong_command_line_is_one_line() {
        check(
            "gaitway man",
            "the following required arguments were not provided: --output <DIR>; \
             `gaitway man --help` says what can be given",
        );
        check(
            "gaitway man --outptu x",
            "unexpected argument '--outptu' found; did you mean --output?",
        );
        check(
            "gaitway completion",
            "unrecognized subcommand 'completion'; did you mean completions?",
        );
        check(
            "gaitway --threads 0",
            "invalid value '0' for '--threads <N>': 0 is not in 1..=1024; \
             `gaitway --help` says what can be given",
        );
    }
}

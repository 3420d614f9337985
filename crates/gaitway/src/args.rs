//! What was typed. What it means, checked, is the command's business.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory as _, Parser, Subcommand};

use crate::output::Failure;

/// Say where a person must be, how and when; get the motion, cut from motion capture.
#[derive(Debug, Parser)]
#[command(
    name = "gaitway",
    version,
    subcommand_value_name = "COMMAND",
    after_help = "Without a command, gaitway authors its built-in sample and says where it is.\n\n\
        Exit status: 0 done; 2 the input or the arguments are wrong; 1 anything else that failed."
)]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) common: Common,
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

/// Options of every command.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct Common {
    /// Print one JSON document on stdout, and nothing else there
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Say nothing but errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// Say more (-vv: even more)
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub(crate) verbose: u8,
    /// How many threads may work [default: one for each processor]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Where random choices start; the same seed makes the same choices
    #[arg(long, global = true, value_name = "N")]
    pub(crate) seed: Option<u64>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Print a completion script for a shell
    #[command(
        after_help = "Example:\n  gaitway completions bash > ~/.local/share/bash-completion/completions/gaitway"
    )]
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

/// Reads the command line. Help and version are printed, which is no failure.
pub(crate) fn parse(words: impl Iterator<Item = OsString>) -> Result<Args, Failure> {
    Args::try_parse_from(words).map_err(|error| match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => Failure::Help(error),
        _ => Failure::wrong(in_one_line(&error)),
    })
}

/// The whole program for help, completions and manual pages.
pub(crate) fn program() -> clap::Command {
    Args::command()
}

/// Clap's paragraph as `what is wrong; what to do`.
fn in_one_line(error: &clap::Error) -> String {
    let text = error.render().to_string();
    let first = text.split("\n\n").next().unwrap_or_default();
    let what = first.lines().map(str::trim).collect::<Vec<_>>().join(" ");
    let what = what.trim_start_matches("error: ");
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
        None => format!("{what}; {} says what can be given", help_command(&text)),
    }
}

/// The help of the command that the usage line in clap's text is about.
fn help_command(text: &str) -> String {
    let usage = text.lines().find_map(|line| line.strip_prefix("Usage: ")).unwrap_or("gaitway");
    let words: Vec<&str> =
        usage.split(' ').take_while(|word| word.chars().all(|c| c.is_ascii_lowercase())).collect();
    format!("`{} --help`", words.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definition_holds_together() {
        program().debug_assert();
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

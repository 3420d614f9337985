//! `gaitway` alone: the editor on the built-in sample; where no window can be, the sample authored
//! without one.

use super::sample;
use crate::args::Common;
use crate::output::{Console, Failure};

/// Opens the editor, or says why not and authors the sample.
pub(crate) fn run(common: &Common) -> Result<(), Failure> {
    // Who asks for a document wants an answer and no window.
    if common.json {
        return sample::run(common);
    }
    let console = Console::new(common);
    let Some(why) = window(&console)? else { return Ok(()) };
    console.note(&format!(
        "{why}; authoring the built-in sample without one (`gaitway --help` lists the commands)"
    ));
    sample::run(common)
}

/// Opens the editor and waits until it is closed. Gives why it cannot be opened.
#[cfg(feature = "editor")]
fn window(console: &Console) -> Result<Option<String>, Failure> {
    match super::edit::open_sample(console) {
        Ok(closed) => closed.map(|()| None),
        Err(error) => Ok(Some(error.to_string())),
    }
}

#[cfg(not(feature = "editor"))]
fn window(_: &Console) -> Result<Option<String>, Failure> {
    Ok(Some("this program was built without a window".to_owned()))
}

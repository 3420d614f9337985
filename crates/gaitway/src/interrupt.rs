//! Ctrl-C: end the work early and keep what there is. Twice: stop at once.

use std::io::Write as _;

use motion_core::cancel::CancelToken;

/// A token that the first Ctrl-C cancels. The second ends the program.
pub(crate) fn cancel_on_interrupt() -> CancelToken {
    let token = CancelToken::new();
    let seen = token.clone();
    let on_interrupt = move || {
        if seen.is_cancelled() {
            #[expect(
                clippy::disallowed_methods,
                reason = "somebody insists; 130 is what shells say"
            )]
            std::process::exit(130);
        }
        seen.cancel();
        let line = "gaitway: ending early (Ctrl-C again: stop at once)";
        drop(writeln!(std::io::stderr(), "{line}"));
    };
    // Without a handler Ctrl-C ends the program, which is well too.
    drop(ctrlc::set_handler(on_interrupt));
    token
}

//! Graphics drivers that write to the terminal, kept quiet.

/// Starts the program over with Mesa's device-selection layer switched off, where it would complain.
///
/// The layer looks for a Wayland display whenever devices are listed, and without an
/// `XDG_RUNTIME_DIR` (in containers, over ssh) Wayland's library writes an error to the terminal
/// that a person must take for ours. Only the environment that a process starts with is safe to
/// change. Does nothing where there is nothing to complain about, or when it fails.
#[cfg(target_os = "linux")]
pub(crate) fn start_over_quietly() {
    use std::os::unix::process::CommandExt as _;

    let is_set = |name: &str| std::env::var_os(name).is_some();
    if is_set("XDG_RUNTIME_DIR") || is_set(SWITCH) {
        return;
    }
    let Ok(program) = std::env::current_exe() else { return };
    let mut again = std::process::Command::new(program);
    // Comes back only if the program cannot be started.
    let _failed = again.args(std::env::args_os().skip(1)).env(SWITCH, "1").exec();
}

/// The layer's own switch.
#[cfg(target_os = "linux")]
const SWITCH: &str = "NODEVICE_SELECT";

/// Nothing to keep quiet here.
#[cfg(not(target_os = "linux"))]
pub(crate) fn start_over_quietly() {}

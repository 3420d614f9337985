//! Where what is remembered lies, on each system.

use std::ffi::OsString;
use std::path::PathBuf;

/// The folder for what the program remembers beside projects: `gaitway` in `XDG_CONFIG_HOME`, else
/// where the system has such things.
pub fn config_folder() -> PathBuf {
    config_folder_from(|name| std::env::var_os(name))
}

/// The folder for autosaves, locks and recovered work.
pub fn state_folder() -> PathBuf {
    crate::recovery::recovery_folder()
}

/// As [`config_folder`], for any environment. A relative path in it counts for nothing: it would
/// mean another folder wherever the program is started.
fn config_folder_from(variable: impl Fn(&str) -> Option<OsString>) -> PathBuf {
    let named = |name| variable(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let at_home = if cfg!(target_os = "macos") { "Library/Application Support" } else { ".config" };
    let appdata = || if cfg!(windows) { named("APPDATA") } else { None };
    let config = named("XDG_CONFIG_HOME")
        .or_else(appdata)
        .or_else(|| named("HOME").map(|home| home.join(at_home)));
    config.unwrap_or_else(std::env::temp_dir).join("gaitway")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(variables: &[(&str, &str)], expected: PathBuf) {
        let find = |name: &str| variables.iter().find(|(known, _)| *known == name);
        let found = config_folder_from(|name| find(name).map(|(_, value)| value.into()));
        assert_eq!(found, expected, "{variables:?}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn the_environment_says_where() {
        let (home, config) = (("HOME", "/h"), ("XDG_CONFIG_HOME", "/c"));
        check(&[home, config], "/c/gaitway".into());
        check(&[home], "/h/.config/gaitway".into());
        check(&[home, ("XDG_CONFIG_HOME", "")], "/h/.config/gaitway".into());
        check(&[home, ("XDG_CONFIG_HOME", "c")], "/h/.config/gaitway".into());
        check(&[home, ("APPDATA", "/a")], "/h/.config/gaitway".into());
    }

    #[test]
    fn without_a_home_there_is_a_temporary_one() {
        check(&[], std::env::temp_dir().join("gaitway"));
    }
}

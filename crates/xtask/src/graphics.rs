//! Graphics for tests: Mesa's software Vulkan (lavapipe), which needs no graphics card and draws
//! the same everywhere.
//!
//! It is installed on Debian and Ubuntu. Where it cannot be had, the run goes on, and tests that
//! draw say for themselves that they are skipped.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::system::{apt_get, has};

/// What has the driver and the loader on Debian and Ubuntu.
const PACKAGES: &[&str] = &["mesa-vulkan-drivers", "libvulkan1"];

/// Where drivers say that they are there.
const DRIVER_FOLDERS: &[&str] = &["/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d"];

/// Software Vulkan that is ready for tests.
pub(crate) struct Graphics {
    /// The driver's manifest.
    driver: PathBuf,
    /// Drivers want a folder of their own that nobody else can read.
    runtime: PathBuf,
}

impl Graphics {
    /// Finds software Vulkan, installing it where that is possible. `Err` says why there is none.
    pub(crate) fn find_or_install() -> Result<Self, &'static str> {
        if !cfg!(target_os = "linux") {
            return Err("software Vulkan is set up on Linux only; tests draw with what there is");
        }
        if software_driver().is_none() || !has_loader() {
            install()?;
        }
        let driver = software_driver().ok_or("Mesa's lavapipe was not found")?;
        let runtime = std::env::temp_dir().join(format!("gaitway-xtask-{}", std::process::id()));
        private_folder(&runtime).ok().ok_or("no folder could be made for the driver")?;
        Ok(Self { driver, runtime })
    }

    /// Has `command` draw with it, and has tests fail rather than skip without it.
    pub(crate) fn apply<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        command
            .env("WGPU_BACKEND", "vulkan")
            .env("VK_DRIVER_FILES", &self.driver)
            .env("XDG_RUNTIME_DIR", &self.runtime)
            .env("GAITWAY_REQUIRE_GPU", "1")
    }
}

impl Drop for Graphics {
    fn drop(&mut self) {
        // Best effort: what stays is an empty folder among temporary files.
        drop(fs::remove_dir_all(&self.runtime));
    }
}

fn install() -> Result<(), &'static str> {
    if !has("apt-get") {
        return Err("Mesa's lavapipe is not installed (install your system's package of it)");
    }
    println!("== installing {}", PACKAGES.join(" "));
    let mut command = vec!["install", "-y", "-qq", "--no-install-recommends"];
    command.extend(PACKAGES);
    match apt_get(&["update", "-qq"]).and_then(|()| apt_get(&command)) {
        Ok(()) => Ok(()),
        Err(error) => {
            println!("{error:#}");
            Err("Mesa's lavapipe could not be installed (mesa-vulkan-drivers, libvulkan1)")
        }
    }
}

/// The manifest of lavapipe for this machine's architecture.
fn software_driver() -> Option<PathBuf> {
    DRIVER_FOLDERS.iter().find_map(|folder| {
        let entries = fs::read_dir(folder).ok()?;
        let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        let name = manifest_among(names, std::env::consts::ARCH)?;
        Some(Path::new(folder).join(name))
    })
}

/// Mesa calls it `lvp_icd.x86_64.json`, since version 25 `lvp_icd.json`.
fn manifest_among(names: impl Iterator<Item = String>, arch: &str) -> Option<String> {
    let with_arch = format!("lvp_icd.{arch}.json");
    let mut found: Vec<String> =
        names.filter(|name| *name == with_arch || name == "lvp_icd.json").collect();
    found.sort_by_key(|name| *name != with_arch);
    found.into_iter().next()
}

fn has_loader() -> bool {
    const NAME: &str = "libvulkan.so.1";
    let triple = format!("/usr/lib/{}-linux-gnu", std::env::consts::ARCH);
    ["/usr/lib", "/usr/lib64", "/usr/local/lib", &triple]
        .iter()
        .any(|folder| Path::new(folder).join(NAME).exists())
}

#[cfg(unix)]
fn private_folder(path: &Path) -> io::Result<()> {
    use std::os::unix::fs::DirBuilderExt as _;
    fs::DirBuilder::new().mode(0o700).create(path)
}

#[cfg(not(unix))]
fn private_folder(path: &Path) -> io::Result<()> {
    fs::create_dir(path)
}

#[cfg(test)]
mod tests {
    use super::manifest_among;

    #[test]
    fn the_driver_of_this_architecture_is_taken() {
        let among =
            |names: &[&str]| manifest_among(names.iter().map(|name| (*name).to_owned()), "x86_64");
        let named = Some("lvp_icd.x86_64.json".to_owned());
        assert_eq!(among(&["radeon_icd.x86_64.json", "lvp_icd.x86_64.json"]), named);
        assert_eq!(among(&["lvp_icd.i686.json", "lvp_icd.json", "lvp_icd.x86_64.json"]), named);
        assert_eq!(among(&["lvp_icd.json"]), Some("lvp_icd.json".to_owned()));
        assert_eq!(among(&["lvp_icd.i686.json", "intel_icd.x86_64.json"]), None);
    }
}

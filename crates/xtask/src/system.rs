//! What tests need of the machine: installed on Debian and Ubuntu, named elsewhere.

use std::process::{Command, Stdio};

use anyhow::{Context as _, ensure};

use crate::step::succeeds;

/// A program and the Debian package that has it.
struct Need {
    program: &'static str,
    package: &'static str,
    why: &'static str,
}

const NEEDS: &[Need] = &[
    Need { program: "cc", package: "build-essential", why: "blake3 has parts in C" },
    Need { program: "git", package: "git", why: "the sources are in it" },
];

/// Installs what is missing, or says what to install.
pub(crate) fn install_missing() -> anyhow::Result<()> {
    let missing: Vec<&Need> = NEEDS.iter().filter(|need| !has(need.program)).collect();
    if !missing.is_empty() {
        install(&missing)?;
    }
    for (component, probe) in [("rustfmt", "fmt"), ("clippy", "clippy")] {
        if !succeeds(&mut crate::step::cargo(&[probe, "--version"])) {
            println!("== installing the toolchain component {component}");
            ensure!(
                succeeds(Command::new("rustup").args(["component", "add", component])),
                "cargo {probe} is missing; install it with `rustup component add {component}`"
            );
        }
    }
    Ok(())
}

/// Whether `program` is installed.
pub(crate) fn has(program: &str) -> bool {
    succeeds(Command::new(program).arg("--version"))
}

fn install(missing: &[&Need]) -> anyhow::Result<()> {
    let named: Vec<String> =
        missing.iter().map(|need| format!("{} ({})", need.program, need.why)).collect();
    let packages: Vec<&str> = missing.iter().map(|need| need.package).collect();
    ensure!(
        has("apt-get"),
        "missing: {}; install them with your system's package manager",
        named.join(", ")
    );
    println!("== installing {}", packages.join(" "));
    apt_get(&["update", "-qq"])?;
    let mut install = vec!["install", "-y", "-qq", "--no-install-recommends"];
    install.extend(packages);
    apt_get(&install)
}

/// Runs `apt-get` as root, or says that it must be.
pub(crate) fn apt_get(args: &[&str]) -> anyhow::Result<()> {
    // Not root: sudo without a password or not at all, since nobody may be there to type one.
    let is_root = Command::new("id")
        .arg("-u")
        .output()
        .is_ok_and(|output| output.stdout.trim_ascii() == b"0");
    let mut command = if is_root {
        Command::new("apt-get")
    } else {
        let mut sudo = Command::new("sudo");
        sudo.args(["-n", "apt-get"]);
        sudo
    };
    let status = command
        .args(args)
        .env("DEBIAN_FRONTEND", "noninteractive")
        .stdin(Stdio::null())
        .status()
        .context("cannot run apt-get")?;
    ensure!(status.success(), "apt-get {} failed; run it by hand as root", args.join(" "));
    Ok(())
}

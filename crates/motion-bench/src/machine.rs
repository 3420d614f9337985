//! What the figures were measured on.

use std::fs;
use std::process::Command;
use std::thread::available_parallelism;

/// Cores, processor, compiler and what else the machine is doing, in a line.
pub(crate) fn describe() -> String {
    let n_cores = available_parallelism().map_or(1, usize::from);
    let cores = if n_cores == 1 { "core" } else { "cores" };
    format!("{n_cores} {cores}, {}; {}; {}", processor(), compiler(), load())
}

fn processor() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find(|line| line.starts_with("model name"));
    let name = line.and_then(|line| line.split_once(':')).map(|(_, name)| name.trim());
    name.map_or_else(|| std::env::consts::ARCH.to_owned(), str::to_owned)
}

fn compiler() -> String {
    let output = Command::new("rustc").arg("--version").output();
    let said = output.ok().and_then(|output| String::from_utf8(output.stdout).ok());
    said.map_or_else(|| "rustc unknown".to_owned(), |said| said.trim().to_owned())
}

fn load() -> String {
    let text = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    match text.split(' ').next().filter(|load| !load.is_empty()) {
        Some(load) => format!("load {load} before the first figure"),
        None => "load unknown".to_owned(),
    }
}

/// The most memory that this process has had at once, MiB, where the system says.
pub(crate) fn peak_memory_mib() -> Option<f64> {
    status_mib("VmHWM:")
}

/// The memory that this process has now, MiB, where the system says.
pub(crate) fn memory_mib() -> Option<f64> {
    status_mib("VmRSS:")
}

fn status_mib(name: &str) -> Option<f64> {
    let text = fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with(name))?;
    let kib: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib / 1024.0)
}

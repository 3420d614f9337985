//! A temporary folder, and the program run in it as a person would.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A folder of its own for one test; gone at the end.
pub struct Dir(tempfile::TempDir);

impl Dir {
    /// An empty folder.
    #[expect(clippy::new_without_default, reason = "making a folder is no default")]
    pub fn new() -> Self {
        Self(tempfile::tempdir().expect("the system has room for temporary files"))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.0.path()
    }

    /// The path of `name` in it.
    pub fn join(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file; folders on the way are made.
    pub fn file(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.join(name);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).expect("the folder is ours");
        }
        let mut file = fs::File::create(&path).expect("the folder is ours");
        std::io::Write::write_all(&mut file, bytes.as_ref()).expect("the folder is ours");
        path
    }

    /// Every file below, relative, in order, with its bytes.
    pub fn files(&self) -> Vec<(String, Vec<u8>)> {
        let mut found = Vec::new();
        walk(self.path(), self.path(), &mut found);
        found.sort();
        found
    }
}

fn walk(root: &Path, folder: &Path, found: &mut Vec<(String, Vec<u8>)>) {
    for entry in fs::read_dir(folder).expect("the folder is ours") {
        let path = entry.expect("the folder is ours").path();
        if path.is_dir() {
            walk(root, &path, found);
        } else {
            let name = path.strip_prefix(root).unwrap_or(&path).to_string_lossy().into_owned();
            found.push((name, fs::read(&path).expect("the file is ours")));
        }
    }
}

/// What a run of the program said.
pub struct Ran {
    /// Exit status; `None` when a signal ended it.
    pub code: Option<i32>,
    /// All of standard output.
    pub stdout: String,
    /// All of standard error.
    pub stderr: String,
}

impl Ran {
    /// Asserts success, showing what was said otherwise.
    #[track_caller]
    pub fn ok(self) -> Self {
        assert_eq!(self.code, Some(0), "stdout: {}\nstderr: {}", self.stdout, self.stderr);
        self
    }

    /// Asserts the status for wrong input, nothing on stdout, and exactly this line on stderr.
    #[track_caller]
    pub fn refused(self, line: &str) {
        assert_eq!(self.stderr, format!("{line}\n"), "the one line on stderr");
        assert_eq!((self.code, self.stdout.as_str()), (Some(2), ""), "status and stdout");
    }
}

/// Runs `program` in `dir` with `args`, without input and without a terminal.
pub fn run(program: &str, dir: &Path, args: &[impl AsRef<OsStr>]) -> Ran {
    let Output { status, stdout, stderr } =
        command(program, dir, args).output().expect("the program was built before its tests");
    Ran {
        code: status.code(),
        stdout: String::from_utf8(stdout).expect("what is printed is text"),
        stderr: String::from_utf8(stderr).expect("what is printed is text"),
    }
}

/// The same, not yet started.
pub fn command(program: &str, dir: &Path, args: &[impl AsRef<OsStr>]) -> Command {
    let mut command = Command::new(program);
    command.args(args).current_dir(dir).stdin(Stdio::null()).env_remove("RUST_BACKTRACE");
    command
}

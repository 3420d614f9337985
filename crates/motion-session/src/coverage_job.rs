//! What a library can do, found on a thread of its own.

use std::sync::Arc;
use std::thread;

use crate::coverage_report::CoverageReport;
use crate::live::mailbox::Mailbox;
use crate::live::{ReadyLibrary, Wake};

/// The report of one library at a time: there, or on its way.
#[derive(Debug, Default)]
pub struct CoverageJob {
    of: Option<ReadyLibrary>,
    coming: Option<Arc<Mailbox<CoverageReport>>>,
    report: Option<CoverageReport>,
}

impl CoverageJob {
    /// Sees to it that the report of `library` comes; `wake` is called when it is there. What is
    /// asked for already is not asked for again. Where the system has no thread to give, there is
    /// none.
    pub fn want(&mut self, library: &ReadyLibrary, wake: &Wake) {
        if self.of.as_ref().is_some_and(|known| known.is(library)) {
            return;
        }
        self.of = Some(library.clone());
        self.report = None;
        let mailbox = Arc::new(Mailbox::default());
        let (for_thread, wake, library) =
            (Arc::clone(&mailbox), wake.clone(), library.library.clone());
        let work = move || {
            for_thread.put(CoverageReport::new(&library));
            wake();
        };
        let started = thread::Builder::new().name("coverage".to_owned()).spawn(work);
        self.coming = started.is_ok().then_some(mailbox);
    }

    /// The report, once it is there; never waits.
    pub fn report(&mut self) -> Option<&CoverageReport> {
        if let Some(report) = self.coming.as_ref().and_then(|mailbox| mailbox.try_take()) {
            self.report = Some(report);
            self.coming = None;
        }
        self.report.as_ref()
    }
}

//! How long a search may take.

use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::thread;
use std::time::Duration;

use motion_core::cancel::CancelToken;

/// When a search ends by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Budget {
    /// After so many rounds: the same input and seed give the same result.
    Iterations(u64),
    /// After so much time: how many rounds that are depends on the machine.
    Time(Duration),
}

/// Runs `work` with a token that is cancelled when `user` is, and no later than `limit` from now
/// where there is one.
///
/// The core has no clock, so a watcher thread holds it. It wakes every few milliseconds for
/// `user`, since a token cannot be waited for.
pub(crate) fn with_deadline<T>(
    user: &CancelToken,
    limit: Option<Duration>,
    work: impl FnOnce(&CancelToken) -> T,
) -> T {
    const LOOK_EVERY: Duration = Duration::from_millis(20);
    let Some(limit) = limit else { return work(user) };
    let token = CancelToken::new();
    let (done, is_done) = sync_channel::<()>(1);
    thread::scope(|scope| {
        let watched = token.clone();
        let watch = move || {
            let mut left = limit;
            loop {
                let nap = left.min(LOOK_EVERY);
                match is_done.recv_timeout(nap) {
                    Err(RecvTimeoutError::Timeout) => left -= nap,
                    Ok(()) | Err(RecvTimeoutError::Disconnected) => return,
                }
                if left.is_zero() || user.is_cancelled() {
                    watched.cancel();
                    return;
                }
            }
        };
        let watcher = thread::Builder::new().name("deadline".to_owned()).spawn_scoped(scope, watch);
        if watcher.is_err() {
            // No thread to be had: the work still sees its user's wish to stop.
            return work(user);
        }
        let result = work(&token);
        drop(done);
        result
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_runs_out() {
        let user = CancelToken::new();
        let limit = Some(Duration::from_millis(5));
        with_deadline(&user, limit, |token| {
            while !token.is_cancelled() {
                thread::yield_now();
            }
        });
        assert!(!user.is_cancelled(), "the user's own token is left alone");
    }

    #[test]
    fn the_user_stops_it_before() {
        let user = CancelToken::new();
        user.cancel();
        with_deadline(&user, Some(Duration::from_secs(3600)), |token| {
            while !token.is_cancelled() {
                thread::yield_now();
            }
        });
    }
}

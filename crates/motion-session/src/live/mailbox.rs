//! A channel with room for one: what is put in takes the place of what nobody has taken yet.
//!
//! So a slow reader sees the latest and a fast writer never waits. The lock is held only while a
//! value is moved in or out.

use std::sync::{Condvar, Mutex, PoisonError, TryLockError};
use std::time::Duration;

/// Room for one value.
#[derive(Debug)]
pub(crate) struct Mailbox<T> {
    slot: Mutex<Option<T>>,
    has_come: Condvar,
}

impl<T> Default for Mailbox<T> {
    fn default() -> Self {
        Self { slot: Mutex::new(None), has_come: Condvar::new() }
    }
}

impl<T> Mailbox<T> {
    /// Puts a value in, in the place of one that is still there.
    pub(crate) fn put(&self, value: T) {
        // Whoever panicked while moving a value left a whole one or none.
        let mut slot = self.slot.lock().unwrap_or_else(PoisonError::into_inner);
        let old = slot.replace(value);
        drop(slot);
        self.has_come.notify_one();
        // Outside the lock: it may be large.
        drop(old);
    }

    /// Takes the value, if there is one and nobody is just putting one in. Never waits.
    pub(crate) fn try_take(&self) -> Option<T> {
        match self.slot.try_lock() {
            Ok(mut slot) => slot.take(),
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner().take(),
            Err(TryLockError::WouldBlock) => None,
        }
    }

    /// Takes the value, if there is one.
    pub(crate) fn take(&self) -> Option<T> {
        self.slot.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Takes the value, waiting for it so long at most.
    pub(crate) fn wait(&self, at_most: Duration) -> Option<T> {
        let slot = self.slot.lock().unwrap_or_else(PoisonError::into_inner);
        let waited = self.has_come.wait_timeout_while(slot, at_most, |slot| slot.is_none());
        let (mut slot, _) = waited.unwrap_or_else(PoisonError::into_inner);
        slot.take()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::thread;

    use super::*;

    #[test]
    fn the_latest_wins() {
        let mailbox = Mailbox::default();
        assert_eq!(mailbox.try_take(), None);
        mailbox.put(1);
        mailbox.put(2);
        assert_eq!((mailbox.try_take(), mailbox.take()), (Some(2), None));
    }

    #[test]
    fn a_reader_is_woken() {
        let mailbox = Arc::new(Mailbox::default());
        let reader = Arc::clone(&mailbox);
        let wait = move || reader.wait(Duration::from_secs(60));
        let thread = thread::Builder::new().name("reader".to_owned()).spawn(wait).unwrap();
        mailbox.put(7);
        assert_eq!(thread.join().unwrap(), Some(7));
    }
}

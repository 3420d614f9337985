//! What the editor's side wishes, as one value: the latest says everything.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use motion_core::cancel::CancelToken;

use super::mailbox::Mailbox;
use super::{Phase, ReadyLibrary, SearchSnapshot};
use crate::document::{CharacterIdx, Document, TakeId};

/// All wishes together. Events are counted, so that none is lost when a wish is overtaken by the
/// next.
#[derive(Clone, Debug, Default)]
pub(super) struct Wish {
    pub(super) request: Option<Arc<Request>>,
    pub(super) is_paused: bool,
    pub(super) n_shakes: u64,
    pub(super) picks: BTreeMap<CharacterIdx, Pick>,
    /// Takes that more like them are wished for.
    pub(super) likes: BTreeMap<CharacterIdx, Pick>,
    pub(super) follow_best: bool,
    pub(super) is_over: bool,
}

/// A take that was chosen; `nth` grows with every choice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pick {
    pub(super) nth: u64,
    pub(super) take: TakeId,
}

/// What motions are wished for.
#[derive(Debug)]
pub(super) struct Request {
    pub(super) number: u64,
    pub(super) document: Document,
    pub(super) library: ReadyLibrary,
    pub(super) path: PathBuf,
    pub(super) phase: Phase,
}

/// What both sides see.
#[derive(Debug, Default)]
pub(super) struct Shared {
    pub(super) wishes: Mailbox<Wish>,
    pub(super) snapshots: Mailbox<Arc<SearchSnapshot>>,
    /// The token of the round under way.
    round: Mutex<CancelToken>,
}

impl Shared {
    /// Ends the round under way, so that a wish is heard at once.
    pub(super) fn interrupt(&self) {
        self.round.lock().unwrap_or_else(PoisonError::into_inner).cancel();
    }

    /// The token for the next round. To be made before the last look for wishes, so that one that
    /// comes after that look cancels it.
    pub(super) fn next_round(&self) -> CancelToken {
        let token = CancelToken::new();
        *self.round.lock().unwrap_or_else(PoisonError::into_inner) = token.clone();
        token
    }
}

//! Shared computation of product states: a state that several threads need at the same time is computed once.

use crate::app::shell::error::AppError;
use crate::catalogue::StateKey;
use crate::compute::estimate::{Cancelled, Progress};
use crate::study::StudyError;
use std::collections::HashSet;
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::Duration;

/// Interval at which a waiting thread checks whether its job has been cancelled.
const LOOK: Duration = Duration::from_millis(50);

/// Set of the product states that are currently being computed.
#[derive(Default)]
pub struct StatesInProgress {
    states: Mutex<HashSet<StateKey>>,
    fewer: Condvar,
}

/// Guard that removes a state from [`StatesInProgress`] when it is dropped, however the computation ends.
struct Turn<'a> {
    in_progress: &'a StatesInProgress,
    state: &'a StateKey,
}

impl Drop for Turn<'_> {
    fn drop(&mut self) {
        self.in_progress.states.lock().unwrap_or_else(PoisonError::into_inner).remove(self.state);
        self.in_progress.fewer.notify_all();
    }
}

impl StatesInProgress {
    /// Executes `compute` for a state unless `is_there` says that its data exist. Waits if another thread is computing
    /// the state, and computes it if that thread fails or is cancelled.
    ///
    /// # Errors
    /// Returns the errors of `is_there` and `compute`, or an error if cancelled while waiting.
    pub fn once(
        &self,
        state: &StateKey,
        progress: &dyn Progress,
        is_there: impl Fn() -> Result<bool, AppError>,
        compute: impl FnOnce() -> Result<(), AppError>,
    ) -> Result<(), AppError> {
        loop {
            if is_there()? {
                return Ok(());
            }
            let mut states = self.states.lock().unwrap_or_else(PoisonError::into_inner);
            if states.insert(state.clone()) {
                break;
            }
            progress.advance("waiting for the product's data", 0, 1);
            while states.contains(state) {
                if progress.cancelled() {
                    return Err(StudyError::Cancelled(Cancelled).into());
                }
                states = self.fewer.wait_timeout(states, LOOK).unwrap_or_else(PoisonError::into_inner).0;
            }
        }
        let _turn = Turn { in_progress: self, state };
        // It may have come between the look and the turn.
        if is_there()? { Ok(()) } else { compute() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::estimate::Silent;
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

    fn state() -> StateKey {
        StateKey { product: "blind".into(), state: "45".into() }
    }

    #[test]
    fn many_who_ask_make_one_computation() {
        let (in_progress, there, count) = (StatesInProgress::default(), AtomicBool::new(false), AtomicUsize::new(0));
        std::thread::scope(|scope| {
            for _ in 0..6 {
                scope.spawn(|| {
                    let compute = || {
                        count.fetch_add(1, Ordering::SeqCst);
                        std::thread::sleep(Duration::from_millis(30));
                        there.store(true, Ordering::SeqCst);
                        Ok(())
                    };
                    in_progress.once(&state(), &Silent, || Ok(there.load(Ordering::SeqCst)), compute).unwrap();
                    assert!(there.load(Ordering::SeqCst));
                });
            }
        });
        assert_eq!(count.load(Ordering::SeqCst), 1);
    }

    #[test]
    fn who_waits_takes_over_from_who_gives_up() {
        let (in_progress, there) = (StatesInProgress::default(), AtomicBool::new(false));
        let (begun, begins) = std::sync::mpsc::channel();
        std::thread::scope(|scope| {
            scope.spawn(|| {
                let gives_up = || {
                    begun.send(()).unwrap();
                    std::thread::sleep(Duration::from_millis(60));
                    Err(StudyError::Cancelled(Cancelled).into())
                };
                assert!(in_progress.once(&state(), &Silent, || Ok(false), gives_up).is_err());
            });
            begins.recv().unwrap();
            let compute = || {
                there.store(true, Ordering::SeqCst);
                Ok(())
            };
            in_progress.once(&state(), &Silent, || Ok(there.load(Ordering::SeqCst)), compute).unwrap();
        });
        assert!(there.load(Ordering::SeqCst));
    }

    #[test]
    fn waiting_ends_when_nobody_wants_it_any_more() {
        struct Withdrawn;
        impl Progress for Withdrawn {
            fn cancelled(&self) -> bool {
                true
            }
        }
        let in_progress = StatesInProgress::default();
        let inside = || {
            let error = in_progress.once(&state(), &Withdrawn, || Ok(false), || Ok(())).unwrap_err();
            assert!(matches!(error, AppError::Study(StudyError::Cancelled(_))), "{error}");
            Ok(())
        };
        in_progress.once(&state(), &Silent, || Ok(false), inside).unwrap();
    }
}

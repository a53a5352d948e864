//! Queue of the threads that need data of product states that are not computed yet: one state is computed at a time,
//! which needs up to 100 MB and all cores.

use crate::app::shell::error::AppError;
use crate::compute::estimate::{Cancelled, Progress};
use crate::study::StudyError;
use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Interval at which a waiting thread checks whether its job has been cancelled.
const LOOK: Duration = Duration::from_millis(50);

/// Queue of threads, the first of which computes a product state.
#[derive(Default)]
pub struct StateQueue {
    places: Mutex<Places>,
    shorter: Condvar,
}

/// Numbers of the waiting threads in the order of their arrival, and the next number.
#[derive(Default)]
struct Places {
    waiting: VecDeque<u64>,
    next: u64,
}

/// Place of a thread in a queue, which it leaves when this is dropped, however its computation ends.
struct Place<'a> {
    queue: &'a StateQueue,
    number: u64,
}

impl Drop for Place<'_> {
    fn drop(&mut self) {
        self.queue.lock().waiting.retain(|number| *number != self.number);
        self.queue.shorter.notify_all();
    }
}

impl StateQueue {
    /// Executes `compute` for a state unless `is_there` says that its data exist, when the states of all threads that
    /// came before have been computed.
    ///
    /// # Errors
    /// Returns the errors of `is_there` and `compute`, or an error if cancelled while waiting.
    pub fn once(
        &self,
        progress: &dyn Progress,
        is_there: impl Fn() -> Result<bool, AppError>,
        compute: impl FnOnce() -> Result<(), AppError>,
    ) -> Result<(), AppError> {
        if is_there()? {
            return Ok(());
        }
        // A thread of the pool that waited here could wait for a computation that needs the pool.
        let _place = match rayon::current_thread_index() {
            None => Some(self.wait(progress)?),
            Some(_) => None,
        };
        // Another thread may have needed the same state.
        if is_there()? { Ok(()) } else { compute() }
    }

    /// Joins the queue and waits until all threads that came before have left it.
    fn wait(&self, progress: &dyn Progress) -> Result<Place<'_>, AppError> {
        let mut places = self.lock();
        let number = places.next;
        places.next += 1;
        places.waiting.push_back(number);
        drop(places);
        let place = Place { queue: self, number };
        loop {
            let places = self.lock();
            if places.waiting.front() == Some(&number) {
                return Ok(place);
            }
            drop(self.shorter.wait_timeout(places, LOOK));
            progress.advance("waiting for the product's data", 0, 1);
            if progress.cancelled() {
                return Err(StudyError::Cancelled(Cancelled).into());
            }
        }
    }

    /// Locks the places, which are valid even if a thread panicked while it held the lock.
    fn lock(&self) -> MutexGuard<'_, Places> {
        self.places.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::estimate::Silent;
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

    struct Withdrawn;
    impl Progress for Withdrawn {
        fn cancelled(&self) -> bool {
            true
        }
    }

    #[test]
    fn many_who_ask_make_one_computation() {
        let (queue, there, count) = (StateQueue::default(), AtomicBool::new(false), AtomicUsize::new(0));
        std::thread::scope(|scope| {
            for _ in 0..6 {
                scope.spawn(|| {
                    let compute = || {
                        count.fetch_add(1, Ordering::SeqCst);
                        std::thread::sleep(Duration::from_millis(30));
                        there.store(true, Ordering::SeqCst);
                        Ok(())
                    };
                    queue.once(&Silent, || Ok(there.load(Ordering::SeqCst)), compute).unwrap();
                    assert!(there.load(Ordering::SeqCst));
                });
            }
        });
        assert_eq!(count.load(Ordering::SeqCst), 1);
    }

    #[test]
    fn states_are_computed_one_at_a_time_in_the_order_of_their_requests() {
        let (queue, done) = (&StateQueue::default(), &Mutex::new(vec![]));
        std::thread::scope(|scope| {
            let first = || {
                for number in 1..4 {
                    let other = move || {
                        done.lock().unwrap().push(number);
                        Ok(())
                    };
                    scope.spawn(move || queue.once(&Silent, || Ok(false), other).unwrap());
                    while queue.lock().waiting.len() <= number {}
                }
                assert!(done.lock().unwrap().is_empty());
                Ok(())
            };
            queue.once(&Silent, || Ok(false), first).unwrap();
        });
        assert_eq!(*done.lock().unwrap(), [1, 2, 3]);
    }

    #[test]
    fn threads_of_the_pool_do_not_wait_for_a_computation_that_may_need_the_pool() {
        let queue = StateQueue::default();
        let inside = || rayon::scope(|_| queue.once(&Withdrawn, || Ok(false), || Ok(())));
        queue.once(&Silent, || Ok(false), inside).unwrap();
    }

    #[test]
    fn who_waits_takes_over_from_who_gives_up() {
        let (queue, there) = (StateQueue::default(), AtomicBool::new(false));
        let (begun, begins) = std::sync::mpsc::channel();
        std::thread::scope(|scope| {
            scope.spawn(|| {
                let gives_up = || {
                    begun.send(()).unwrap();
                    std::thread::sleep(Duration::from_millis(60));
                    Err(StudyError::Cancelled(Cancelled).into())
                };
                assert!(queue.once(&Silent, || Ok(false), gives_up).is_err());
            });
            begins.recv().unwrap();
            let compute = || {
                there.store(true, Ordering::SeqCst);
                Ok(())
            };
            queue.once(&Silent, || Ok(there.load(Ordering::SeqCst)), compute).unwrap();
        });
        assert!(there.load(Ordering::SeqCst));
    }

    #[test]
    fn waiting_ends_when_nobody_wants_it_any_more() {
        let queue = StateQueue::default();
        let inside = || {
            let error = queue.once(&Withdrawn, || Ok(false), || Ok(())).unwrap_err();
            assert!(matches!(error, AppError::Study(StudyError::Cancelled(_))), "{error}");
            Ok(())
        };
        queue.once(&Silent, || Ok(false), inside).unwrap();
    }
}

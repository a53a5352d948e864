//! Work that may take longer than a frame: lanes, generations, cancelling, progress.
//!
//! Each [`Lane`] runs one job at a time. A newer job of the same lane withdraws the older one: its progress then says
//! "cancelled", and what it still returns is thrown away. Results come back through a channel that the window polls.
//! A panic inside a job is caught and told as a failure; the window lives on.

use super::error::JobError;
use crate::compute::estimate::Progress;
use std::any::Any;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};

/// What a job works on. Later requests of a lane replace earlier ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Lane {
    /// Opening the catalogue and searching in it.
    Catalogue,
    /// Reading files that the user opened.
    Import,
    /// Writing into the catalogue.
    Store,
    /// From the scene as typed to sky, sun and systems.
    Scene,
    /// The luminous-intensity distribution.
    Lid,
    /// Illuminances in the room.
    Room,
    /// What control chooses over the year.
    Year,
    /// Error against run time.
    Accuracy,
    /// Computing built-in products.
    Builtin,
    /// Data computed from a description.
    Goniophotometer,
    /// Writing files.
    Export,
}

impl Lane {
    /// What the status line calls it.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Catalogue => "catalogue",
            Self::Import => "reading files",
            Self::Store => "storing",
            Self::Scene => "sky and system",
            Self::Lid => "LID",
            Self::Room => "room",
            Self::Year => "year of control",
            Self::Accuracy => "error against time",
            Self::Builtin => "built-in products",
            Self::Goniophotometer => "goniophotometer",
            Self::Export => "writing file",
        }
    }
}

/// The side of a job that both the worker and the window see.
#[derive(Default)]
pub struct JobState {
    cancelled: AtomicBool,
    done: AtomicUsize,
    total: AtomicUsize,
    stage: Mutex<&'static str>,
}

impl JobState {
    /// Share done of the present stage, 0 … 1; `None` before the first report.
    pub fn fraction(&self) -> Option<f32> {
        let total = self.total.load(Ordering::Relaxed);
        (total > 0).then(|| (self.done.load(Ordering::Relaxed) as f32 / total as f32).clamp(0.0, 1.0))
    }

    /// The present stage; empty before the first report.
    pub fn stage(&self) -> &'static str {
        self.stage.lock().map_or("", |stage| *stage)
    }
}

impl Progress for JobState {
    fn advance(&self, stage: &'static str, done: usize, total: usize) {
        self.done.store(done, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
        if let Ok(mut place) = self.stage.lock() {
            *place = stage;
        }
    }

    fn cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}

/// A job under way.
struct Running {
    generation: u64,
    state: Arc<JobState>,
}

/// What came back from a lane.
pub struct Finished<M> {
    /// Whose.
    pub lane: Lane,
    /// What the job returned, or why it did not.
    pub outcome: Result<M, JobError>,
}

/// The job under way in a lane, as the status line shows it.
pub struct JobView {
    /// Where.
    pub lane: Lane,
    /// Progress.
    pub state: Arc<JobState>,
}

/// All lanes. `M`: what jobs return.
pub struct Jobs<M> {
    running: BTreeMap<Lane, Running>,
    next: u64,
    sender: Sender<(Lane, u64, Result<M, JobError>)>,
    receiver: Receiver<(Lane, u64, Result<M, JobError>)>,
}

impl<M: Send + 'static> Default for Jobs<M> {
    fn default() -> Self {
        let (sender, receiver) = channel();
        Self { running: BTreeMap::new(), next: 0, sender, receiver }
    }
}

impl<M: Send + 'static> Jobs<M> {
    /// Starts a job; an older one in the same lane is withdrawn. `wake` is called from the worker when it ends.
    pub fn start(
        &mut self,
        lane: Lane,
        wake: impl FnOnce() + Send + 'static,
        work: impl FnOnce(&JobState) -> M + Send + 'static,
    ) {
        self.cancel(lane);
        self.next += 1;
        let generation = self.next;
        let state = Arc::new(JobState::default());
        self.running.insert(lane, Running { generation, state: state.clone() });
        let sender = self.sender.clone();
        let job = move || {
            let outcome = catch_unwind(AssertUnwindSafe(|| work(&state))).map_err(|panic| fault(&*panic));
            // The window may be gone by now; nobody is left to tell.
            if sender.send((lane, generation, outcome)).is_ok() {
                wake();
            }
        };
        if let Err(error) = std::thread::Builder::new().name(format!("cfs {}", lane.word())).spawn(job) {
            let error = JobError::NoThread(error.to_string());
            // Sent to ourselves: the receiver lives as long as we do.
            if self.sender.send((lane, generation, Err(error))).is_err() {
                self.running.remove(&lane);
            }
        }
    }

    /// Withdraws what a lane is doing; its result will not arrive. True if there was something.
    pub fn cancel(&mut self, lane: Lane) -> bool {
        let Some(job) = self.running.remove(&lane) else { return false };
        job.state.cancelled.store(true, Ordering::Relaxed);
        true
    }

    /// What has ended since the last call. Never waits.
    pub fn poll(&mut self) -> Vec<Finished<M>> {
        let mut list = Vec::new();
        while let Ok((lane, generation, outcome)) = self.receiver.try_recv() {
            if self.running.get(&lane).is_some_and(|job| job.generation == generation) {
                self.running.remove(&lane);
                list.push(Finished { lane, outcome });
            }
        }
        list
    }

    /// Is a lane busy?
    pub fn busy(&self, lane: Lane) -> bool {
        self.running.contains_key(&lane)
    }

    /// All jobs under way.
    pub fn views(&self) -> Vec<JobView> {
        self.running.iter().map(|(&lane, job)| JobView { lane, state: job.state.clone() }).collect()
    }
}

impl<M> Drop for Jobs<M> {
    fn drop(&mut self) {
        for job in self.running.values() {
            job.state.cancelled.store(true, Ordering::Relaxed);
        }
    }
}

fn fault(panic: &(dyn Any + Send)) -> JobError {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    JobError::Panic(text.unwrap_or_else(|| "no message".to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    fn wait<M: Send + 'static>(jobs: &mut Jobs<M>) -> Vec<Finished<M>> {
        let start = Instant::now();
        loop {
            let list = jobs.poll();
            if !list.is_empty() || start.elapsed() > Duration::from_secs(10) {
                return list;
            }
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    #[test]
    fn a_newer_job_withdraws_the_older_one() {
        let mut jobs = Jobs::default();
        let (told, stopped) = channel();
        jobs.start(
            Lane::Room,
            || {},
            move |state| {
                while !state.cancelled() {
                    std::thread::sleep(Duration::from_millis(1));
                }
                told.send(()).unwrap();
                1
            },
        );
        jobs.start(Lane::Room, || {}, |_| 2);
        stopped.recv_timeout(Duration::from_secs(10)).expect("the older job is told to stop");
        let list = wait(&mut jobs);
        assert_eq!(list.iter().map(|done| done.outcome.clone()).collect::<Vec<_>>(), [Ok(2)]);
        assert!(!jobs.busy(Lane::Room));
    }

    #[test]
    fn a_panic_is_told_and_the_lane_goes_on() {
        let mut jobs: Jobs<i32> = Jobs::default();
        jobs.start(Lane::Lid, || {}, |_| panic!("seven"));
        let list = wait(&mut jobs);
        assert_eq!(list[0].outcome, Err(JobError::Panic("seven".to_owned())));
        jobs.start(Lane::Lid, || {}, |_| 3);
        assert_eq!(wait(&mut jobs)[0].outcome, Ok(3));
    }

    #[test]
    fn lanes_do_not_disturb_each_other_and_progress_is_seen() {
        let mut jobs = Jobs::default();
        let (go, gate) = channel::<()>();
        jobs.start(
            Lane::Room,
            || {},
            move |state| {
                state.advance("direct", 3, 12);
                gate.recv().unwrap();
                "room"
            },
        );
        jobs.start(Lane::Lid, || {}, |_| "lid");
        assert_eq!(wait(&mut jobs)[0].outcome, Ok("lid"));
        assert!(jobs.busy(Lane::Room));
        let start = Instant::now();
        while jobs.views()[0].state.fraction().is_none() && start.elapsed() < Duration::from_secs(10) {
            std::thread::sleep(Duration::from_millis(1));
        }
        assert_eq!(jobs.views()[0].state.fraction(), Some(0.25));
        assert_eq!(jobs.views()[0].state.stage(), "direct");
        go.send(()).unwrap();
        assert_eq!(wait(&mut jobs)[0].outcome, Ok("room"));
    }
}

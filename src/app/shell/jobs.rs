//! Jobs that may take longer than a frame: lanes, generations, cancelling, progress.
//!
//! Each [`Lane`] runs one job at a time. A newer job of the same lane cancels the older one, whose result is then
//! dropped. Results come back through a channel that the window polls. A panic inside a job is caught and reported as a
//! failure; the window continues to run.
//!
//! Background jobs yield: whenever they report progress or check for cancellation, they pause until no job with a
//! visible result is running ([`Priority`]).

use crate::app::shell::error::JobError;
pub use crate::app::shell::lane::{Lane, Priority};
use crate::compute::estimate::Progress;
use crate::study::fault;
use crate::texts;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Count of the running jobs with visible results, for which background jobs pause.
#[derive(Default)]
struct Sight {
    awaited: Mutex<usize>,
    fewer: Condvar,
}

impl Sight {
    /// Locks the count, which is valid even if a thread panicked while it held the lock.
    fn lock(&self) -> MutexGuard<'_, usize> {
        self.awaited.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until no job with a visible result is running, or until the caller is cancelled.
    fn rest(&self, cancelled: &AtomicBool) {
        let in_the_way = |awaited: &mut usize| *awaited > 0 && !cancelled.load(Ordering::Relaxed);
        drop(self.fewer.wait_while(self.lock(), in_the_way));
    }

    /// Wakes the paused background jobs, so that they check the count again.
    fn wake(&self) {
        drop(self.lock());
        self.fewer.notify_all();
    }
}

/// Guard during whose lifetime background jobs pause.
struct Awaited(Arc<Sight>);

impl Awaited {
    fn new(sight: &Arc<Sight>) -> Self {
        *sight.lock() += 1;
        Self(sight.clone())
    }
}

impl Drop for Awaited {
    fn drop(&mut self) {
        *self.0.lock() -= 1;
        self.0.wake();
    }
}

/// State of a job, shared by its thread and the window: progress, stage, cancellation.
#[derive(Default)]
pub struct JobState {
    /// Count of jobs with visible results for which this job pauses; `None` if it does not pause.
    gives_way: Option<Arc<Sight>>,
    cancelled: AtomicBool,
    done: AtomicUsize,
    total: AtomicUsize,
    /// Current stage of the job, and the time at which it began.
    stage: Mutex<(&'static str, Option<Instant>)>,
}

/// Duration of a stage from which its remaining time is estimated.
const JUDGED: Duration = Duration::from_secs(1);

impl JobState {
    /// Returns the finished share of the job's current stage, 0 … 1; `None` before the first report of progress.
    pub fn fraction(&self) -> Option<f32> {
        let total = self.total();
        (total > 0).then(|| (self.done() as f32 / total as f32).clamp(0.0, 1.0))
    }

    /// Returns the key of the job's current stage; empty before the first report of progress.
    pub fn stage(&self) -> &'static str {
        self.stage.lock().unwrap_or_else(PoisonError::into_inner).0
    }

    /// Returns the estimated remaining time of the current stage, from its mean speed so far; `None` if it is not known
    /// yet.
    pub fn left(&self) -> Option<Duration> {
        let spent = self.stage.lock().unwrap_or_else(PoisonError::into_inner).1?.elapsed();
        let share = f64::from(self.fraction()?);
        (spent >= JUDGED && share > 0.0).then(|| spent.mul_f64((1.0 - share) / share))
    }

    fn done(&self) -> usize {
        self.done.load(Ordering::Relaxed)
    }

    fn total(&self) -> usize {
        self.total.load(Ordering::Relaxed)
    }

    fn report(&self, stage: &'static str, done: usize, total: usize) {
        self.done.store(done, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
        let mut present = self.stage.lock().unwrap_or_else(PoisonError::into_inner);
        if present.0 != stage || present.1.is_none() {
            *present = (stage, Some(Instant::now()));
        }
    }

    fn rest(&self) {
        if let Some(sight) = &self.gives_way {
            sight.rest(&self.cancelled);
        }
    }

    fn withdraw(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
        if let Some(sight) = &self.gives_way {
            sight.wake();
        }
    }
}

impl Progress for JobState {
    fn advance(&self, stage: &'static str, done: usize, total: usize) {
        self.report(stage, done, total);
        self.rest();
    }

    fn cancelled(&self) -> bool {
        self.rest();
        self.cancelled.load(Ordering::Relaxed)
    }
}

/// Running job of a lane.
struct Running {
    generation: u64,
    state: Arc<JobState>,
}

/// Result of a finished job, with its lane.
pub struct Finished<M> {
    /// Lane of the job.
    pub lane: Lane,
    /// Result of the job, or the reason why there is none.
    pub outcome: Result<M, JobError>,
    /// Stage of the job at its end.
    pub stage: &'static str,
    /// Guard that keeps background jobs paused until the result has been stored and follow-up jobs have started.
    _awaited: Option<Awaited>,
}

/// Running job of a lane, as the status line shows it.
pub struct JobView {
    /// Lane of the job.
    pub lane: Lane,
    /// State of the job.
    pub state: Arc<JobState>,
}

/// All lanes with their jobs. `M`: result type of the jobs.
pub struct Jobs<M> {
    running: BTreeMap<Lane, Running>,
    /// Progress of background work, reported by its last job: it consists of short jobs, with which the progress bar
    /// does not restart.
    background: Arc<JobState>,
    next: u64,
    /// Time at which a job other than background jobs was last found running.
    worked: Instant,
    sight: Arc<Sight>,
    sender: Sender<(u64, Finished<M>)>,
    receiver: Receiver<(u64, Finished<M>)>,
}

impl<M: Send + 'static> Default for Jobs<M> {
    fn default() -> Self {
        let (sender, receiver) = channel();
        Self {
            running: BTreeMap::new(),
            background: Arc::default(),
            next: 0,
            worked: Instant::now(),
            sight: Arc::default(),
            sender,
            receiver,
        }
    }
}

impl<M: Send + 'static> Jobs<M> {
    /// Starts a job and cancels an older one in the same lane. `wake` is called from the job's thread when it ends.
    pub fn start(
        &mut self,
        lane: Lane,
        wake: impl FnOnce() + Send + 'static,
        work: impl FnOnce(&JobState) -> M + Send + 'static,
    ) {
        self.cancel(lane);
        self.next += 1;
        let generation = self.next;
        let gives_way = (lane.priority() == Priority::Background).then(|| self.sight.clone());
        let awaited = (lane.priority() == Priority::Visible).then(|| Awaited::new(&self.sight));
        let state = JobState::default();
        if gives_way.is_some() {
            state.report(self.background.stage(), self.background.done(), self.background.total());
        }
        let state = Arc::new(JobState { gives_way, ..state });
        if state.gives_way.is_some() {
            self.background = state.clone();
        }
        self.running.insert(lane, Running { generation, state: state.clone() });
        let sender = self.sender.clone();
        // What is said there is read here.
        let language = texts::language();
        let job = move || {
            let _speaking = texts::speak(language);
            state.rest();
            let outcome = catch_unwind(AssertUnwindSafe(|| work(&state)))
                .map_err(|panic| JobError::Panic(Box::new(fault::caught(&*panic))));
            let stage = state.stage();
            // The window may be gone by now; nobody is left to tell.
            if sender.send((generation, Finished { lane, outcome, stage, _awaited: awaited })).is_ok() {
                wake();
            }
        };
        if let Err(error) = std::thread::Builder::new().name(format!("cfs {}", lane.word().english())).spawn(job) {
            let error = JobError::NoThread(error.to_string());
            // Sent to ourselves: the receiver lives as long as we do.
            let failed = Finished { lane, outcome: Err(error), stage: "", _awaited: None };
            if self.sender.send((generation, failed)).is_err() {
                self.running.remove(&lane);
            }
        }
    }

    /// Cancels the job of a lane, whose result is then dropped; returns whether there was one.
    pub fn cancel(&mut self, lane: Lane) -> bool {
        let Some(job) = self.running.remove(&lane) else { return false };
        job.state.withdraw();
        true
    }

    /// Returns the results of jobs that have finished since the last call, without waiting.
    pub fn poll(&mut self) -> Vec<Finished<M>> {
        if self.running.keys().any(|lane| lane.priority() != Priority::Background) {
            self.worked = Instant::now();
        }
        let mut list = Vec::new();
        while let Ok((generation, finished)) = self.receiver.try_recv() {
            if self.running.get(&finished.lane).is_some_and(|job| job.generation == generation) {
                self.running.remove(&finished.lane);
                list.push(finished);
            }
        }
        list
    }

    /// Returns the time since [`Self::poll`] last found a job other than background jobs.
    pub fn idle(&self) -> Duration {
        self.worked.elapsed()
    }

    /// Whether a lane has a running job.
    pub fn busy(&self, lane: Lane) -> bool {
        self.running.contains_key(&lane)
    }

    /// Returns the finished share of the current stage of a lane's job; `None` without a job, and before its first
    /// report.
    pub fn fraction(&self, lane: Lane) -> Option<f32> {
        self.state(lane)?.fraction()
    }

    /// Returns the progress of a lane's job; `None` without a job.
    pub fn state(&self, lane: Lane) -> Option<&JobState> {
        self.running.get(&lane).map(|job| &*job.state)
    }

    /// Returns the finished share of the current stage of a lane's job, 0 before its first report; `None` without a
    /// job.
    pub fn progress(&self, lane: Lane) -> Option<f32> {
        Some(self.state(lane)?.fraction().unwrap_or(0.0))
    }

    /// Returns all running jobs.
    pub fn views(&self) -> Vec<JobView> {
        self.running.iter().map(|(&lane, job)| JobView { lane, state: job.state.clone() }).collect()
    }
}

impl<M> Drop for Jobs<M> {
    fn drop(&mut self) {
        for job in self.running.values() {
            job.state.withdraw();
        }
    }
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
        let Err(JobError::Panic(fault)) = &list[0].outcome else { panic!("{:?}", list[0].outcome) };
        assert_eq!(fault.message, "seven");
        jobs.start(Lane::Lid, || {}, |_| 3);
        assert_eq!(wait(&mut jobs)[0].outcome, Ok(3));
    }

    #[test]
    fn the_background_goes_on_from_where_it_was_and_others_begin_anew() {
        let mut jobs = Jobs::default();
        for lane in [Lane::Builtin, Lane::Room] {
            jobs.start(lane, || {}, |state| state.advance("computing", 3, 12));
            wait(&mut jobs);
            let (go, gate) = channel::<()>();
            jobs.start(lane, || {}, move |_| gate.recv().unwrap());
            let fraction = jobs.views()[0].state.fraction();
            assert_eq!(fraction, (lane == Lane::Builtin).then_some(0.25), "{lane:?}");
            go.send(()).unwrap();
            wait(&mut jobs);
        }
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

    #[test]
    fn the_background_rests_while_anything_in_sight_is_under_way() {
        let mut jobs = Jobs::default();
        let (step, steps) = channel();
        let background = move |state: &JobState| {
            while !state.cancelled() {
                _ = step.send(());
                std::thread::sleep(Duration::from_millis(1));
            }
            "background"
        };
        let next = |patience| steps.recv_timeout(Duration::from_millis(patience)).is_ok();
        jobs.start(Lane::Builtin, || {}, background);
        assert!(next(10_000), "nothing is in its way yet");
        let (go, gate) = channel::<()>();
        let in_sight = move |_: &JobState| {
            gate.recv().unwrap();
            "in sight"
        };
        jobs.start(Lane::Room, || {}, in_sight);
        // The step that was under way may still end.
        while steps.try_recv().is_ok() {}
        next(100);
        assert!(!next(100), "it rests");
        go.send(()).unwrap();
        let list = wait(&mut jobs);
        assert_eq!(list[0].outcome, Ok("in sight"));
        assert!(!next(100), "what came is not taken in yet");
        drop(list);
        assert!(next(10_000), "it goes on");
    }

    #[test]
    fn work_in_the_background_is_rest() {
        let mut jobs = Jobs::default();
        let (go, gate) = channel::<()>();
        jobs.start(Lane::Builtin, || {}, |state| while !state.cancelled() {});
        std::thread::sleep(Duration::from_millis(200));
        jobs.poll();
        assert!(jobs.idle() >= Duration::from_millis(200));
        jobs.start(Lane::Room, || {}, move |_| gate.recv().unwrap());
        jobs.poll();
        assert!(jobs.idle() < Duration::from_millis(200));
        go.send(()).unwrap();
    }

    #[test]
    fn resting_work_is_withdrawn_at_once() {
        let mut jobs = Jobs::default();
        let (go, gate) = channel::<()>();
        jobs.start(Lane::Lid, || {}, move |_| gate.recv().unwrap());
        let (told, stopped) = channel();
        jobs.start(Lane::Builtin, || {}, move |state| told.send(state.cancelled()).unwrap());
        assert!(stopped.recv_timeout(Duration::from_millis(50)).is_err(), "it rests before it begins");
        jobs.cancel(Lane::Builtin);
        assert_eq!(stopped.recv_timeout(Duration::from_secs(10)), Ok(true));
        go.send(()).unwrap();
    }
}

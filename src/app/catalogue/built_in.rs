//! Data of built-in products, which are computed in advance while nothing else is.

use super::shelf::Shelf;
use crate::app::results::work::Outcome;
use crate::app::shell::Shell;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::{JobState, Lane};
use crate::compute::estimate::Progress as _;
use crate::texts::shell;
use std::time::{Duration, Instant};

/// Number of failed computations after which built-in products are no longer computed in advance.
const MOST_FAILURES: usize = 5;

/// Time for which data of built-in products are computed in a job before their order is determined again.
const FILLING: Duration = Duration::from_millis(500);

/// Lanes whose jobs may take minutes, or as much memory as a computation in advance: paused, that would hold its memory,
/// up to 100 MB, all that time.
const CANCELLING: [Lane; 6] =
    [Lane::Annual, Lane::Rank, Lane::Compare, Lane::Accuracy, Lane::Goniophotometer, Lane::Product];

/// Computation of data of built-in products in advance.
#[derive(Default)]
pub struct BuiltIn {
    /// Whether data are still to be computed.
    due: bool,
    /// Number of failures.
    failures: usize,
}

impl BuiltIn {
    /// Whether data are still to be computed.
    pub const fn is_due(&self) -> bool {
        self.due
    }

    /// Marks the computation as due.
    pub const fn owe(&mut self) {
        self.due = true;
    }

    /// Starts computing, while nothing else is computed: first the data of the selected product, then the
    /// representative states of the listed products, then the rest. After a stop it resumes when another product is
    /// selected. It is cancelled by jobs that take long or much memory, and due again afterwards.
    pub fn fill(&mut self, shell: &mut Shell) {
        if CANCELLING.iter().any(|lane| shell.jobs.busy(*lane)) && shell.jobs.cancel(Lane::Builtin) {
            self.due = true;
        }
        if !self.due || !shell.jobs.views().is_empty() {
            return;
        }
        let Some(shelf) = shell.state.shelf() else { return };
        self.due = false;
        if self.failures >= MOST_FAILURES {
            return;
        }
        let chosen = std::iter::once(shell.state.document.selection.product.clone());
        let order: Vec<String> =
            chosen.chain(shell.state.found.entries.iter().map(|entry| entry.key.clone())).collect();
        shell.start(Lane::Builtin, move |progress| Outcome::Builtin(fill_some(&*shelf, &order, progress)));
    }

    /// Takes over the end of a job: the number of states left, or why one could not be computed.
    pub fn take(&mut self, shell: &mut Shell, left: Result<usize, AppError>) {
        match left {
            Ok(0) => shell.search(),
            Ok(_) => {
                self.due = true;
                shell.show_new_pictures();
            }
            Err(error) => {
                shell.toasts.warning(shell::builtin_failed(error));
                // Failed states are skipped from now on; a catalogue that cannot be written to fails permanently.
                self.failures += 1;
                self.due = true;
            }
        }
    }
}

/// Computes and stores missing datasets of products in advance, in the `order` of product keys, for the time
/// [`FILLING`]. Returns the number of states left.
fn fill_some(shelf: &dyn Shelf, order: &[String], progress: &JobState) -> Result<usize, AppError> {
    // A separate thread pool, so that visible results never wait behind this; one core stays free for the window.
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads((cores - 1).max(1)).build()?;
    let start = Instant::now();
    loop {
        let [left, all] = pool.install(|| shelf.fill_one(order, progress))?;
        progress.advance("computing", all.saturating_sub(left), all);
        if left == 0 || start.elapsed() > FILLING {
            return Ok(left);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::App;
    use crate::app::results::backend::StudyEngine;
    use std::sync::Arc;
    use std::sync::mpsc::channel;

    #[test]
    fn it_pauses_for_a_short_job_and_is_cancelled_by_a_long_or_large_one() {
        let mut app = App::for_test(Arc::new(StudyEngine::default()));
        for (lane, pauses) in [(Lane::Room, true), (Lane::Rank, false), (Lane::Product, false)] {
            let shell = &mut app.shell;
            shell.start(Lane::Builtin, |job| {
                while !job.cancelled() {}
                Outcome::Builtin(Ok(1))
            });
            let (end, gate) = channel::<()>();
            shell.start(lane, move |_| {
                _ = gate.recv();
                Outcome::Builtin(Ok(0))
            });
            let mut built_in = BuiltIn::default();
            built_in.fill(shell);
            assert_eq!((shell.jobs.busy(Lane::Builtin), built_in.is_due()), (pauses, !pauses), "{lane:?}");
            drop(end);
            shell.jobs.cancel(lane);
        }
    }
}

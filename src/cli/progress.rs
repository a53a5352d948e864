//! Progress bar on the terminal for work that takes longer than a second; nothing is shown without a terminal.

use crate::compute::estimate::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::Duration;

/// Duration of a computation below which no progress is shown.
const DELAY: Duration = Duration::from_secs(1);

/// Progress bar on standard error, with the name of the current stage.
pub(super) struct TerminalProgress(ProgressBar);

impl TerminalProgress {
    /// Creates a progress bar that is hidden for the first second.
    pub(super) fn new() -> Self {
        let bar = ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} [{bar:30}] {pos}/{len}") {
            bar.set_style(style);
        }
        let shown = bar.clone();
        std::thread::spawn(move || {
            std::thread::sleep(DELAY);
            if !shown.is_finished() {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(Duration::from_millis(120));
            }
        });
        Self(bar)
    }
}

impl Progress for TerminalProgress {
    fn advance(&self, stage: &'static str, done: usize, total: usize) {
        self.0.set_length(total as u64);
        self.0.set_position(done as u64);
        self.0.set_message(stage);
    }
}

impl Drop for TerminalProgress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

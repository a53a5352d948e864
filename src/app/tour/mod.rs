//! Introductory tour of the window in five steps on the user's content: the user executes each step in the window,
//! which is not blocked.

pub mod step;

use super::shell::Shell;
use super::state::{Sheet, State};
use super::tiles::{LID, ROOM, SKY};
use crate::study::scene_file::{SceneFile, TimeKey};
use crate::texts::shell;
use step::{Stop, TourAct};

/// Values of the window by whose changes a finished step of the tour is recognised.
struct Seen {
    product: String,
    sun: (Option<TimeKey>, Option<f64>, Option<f64>),
    light: bool,
    candidates: usize,
    is_export_open: bool,
}

impl Seen {
    fn of(state: &State) -> Self {
        let SceneFile { sky, compare, .. } = &state.document.scene;
        Self {
            product: state.document.selection.product.clone(),
            sun: (sky.time.clone(), sky.sun.altitude, sky.sun.azimuth),
            light: state.maximised.is_some_and(|tile| tile == LID || tile == ROOM),
            candidates: compare.len(),
            is_export_open: state.sheet == Some(Sheet::Export),
        }
    }

    /// Whether the user has done a step, judged by the changes from these values to `now`.
    fn done(&self, now: &Self, stop: Stop) -> bool {
        match stop {
            Stop::Product => now.product != self.product,
            Stop::Sun => now.sun != self.sun,
            Stop::Light => now.light && !self.light,
            Stop::Compare => now.candidates > self.candidates,
            Stop::Export => now.is_export_open && !self.is_export_open,
        }
    }
}

/// State of the tour.
#[derive(Default)]
pub struct Tour {
    /// Current step, and the values of the window in the last frame; `None` if the tour is not running.
    running: Option<(Stop, Seen)>,
    /// Whether the tour is offered, because the user has never opened the window before.
    offered: bool,
}

impl Tour {
    /// Returns the current step; `None` if the tour is not running.
    pub fn stop(&self) -> Option<Stop> {
        self.running.as_ref().map(|(stop, _)| *stop)
    }

    /// Whether the tour or its offer is shown.
    pub const fn is_shown(&self) -> bool {
        self.running.is_some() || self.offered
    }

    /// Offers the tour.
    pub const fn offer(&mut self) {
        self.offered = true;
    }

    /// Executes a command about the tour.
    pub fn act(&mut self, shell: &mut Shell, act: TourAct) {
        self.offered = false;
        match act {
            TourAct::Start => {
                let done = shell.state.settings.tour;
                self.begin(shell, Stop::ALL[if done < Stop::ALL.len() { done } else { 0 }]);
            }
            TourAct::Leave => self.running = None,
            TourAct::Decline => {}
        }
    }

    /// Starts a step of the tour, and makes the part of the window visible in which it is done.
    fn begin(&mut self, shell: &mut Shell, stop: Stop) {
        let state = &mut shell.state;
        match stop {
            Stop::Product => state.settings.catalogue_open = true,
            Stop::Sun => {
                (state.sheet, state.compare.open) = (None, false);
                state.settings.scene_open = true;
                shell.bring_up(SKY);
            }
            Stop::Light => {
                (state.sheet, state.compare.open, state.maximised) = (None, false, None);
                shell.bring_up(LID);
            }
            Stop::Compare | Stop::Export => {}
        }
        self.running = Some((stop, Seen::of(&shell.state)));
    }

    /// Checks whether the current step has been done since the last frame, and starts the next one if so.
    pub fn follow(&mut self, shell: &mut Shell) {
        // At the start of the window something is chosen that nobody chose.
        let Some((stop, seen)) = self.running.as_mut().filter(|_| shell.state.shelf().is_some()) else { return };
        let before = std::mem::replace(seen, Seen::of(&shell.state));
        if before.product.is_empty() || !before.done(seen, *stop) {
            return;
        }
        let done = Stop::ALL.iter().position(|one| one == stop).map_or(0, |place| place + 1);
        shell.state.settings.tour = shell.state.settings.tour.max(done);
        match Stop::ALL.get(done) {
            Some(next) => self.begin(shell, *next),
            None => {
                self.running = None;
                shell.toasts.success(shell::TOUR_DONE);
            }
        }
    }
}

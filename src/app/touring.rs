//! Commands of the window on the tour, and its progress from step to step.

use super::state::{Sheet, State};
use super::tiles::{LID, ROOM, SKY};
use super::tour::{Seen, Stop, Tour, TourAct};
use super::window::App;
use crate::study::scene_file::SceneFile;
use crate::texts::shell;

fn seen(state: &State) -> Seen {
    let SceneFile { sky, compare, .. } = &state.document.scene;
    Seen {
        product: state.document.selection.product.clone(),
        sun: (sky.time.clone(), sky.sun.altitude, sky.sun.azimuth),
        light: state.maximised.is_some_and(|tile| tile == LID || tile == ROOM),
        candidates: compare.len(),
        is_export_open: state.sheet == Some(Sheet::Export),
    }
}

impl App {
    /// Executes a command about the tour.
    pub(super) fn tour(&mut self, act: TourAct) {
        self.state.tour_offered = false;
        match act {
            TourAct::Start => {
                let done = self.state.settings.tour;
                self.begin_stop(Stop::ALL[if done < Stop::ALL.len() { done } else { 0 }]);
            }
            TourAct::Leave => self.state.tour = None,
            TourAct::Decline => {}
        }
    }

    /// Starts a step of the tour, and makes the part of the window visible in which it is done.
    fn begin_stop(&mut self, stop: Stop) {
        let state = &mut self.state;
        match stop {
            Stop::Product => state.settings.catalogue_open = true,
            Stop::Sun => {
                (state.sheet, state.compare.open) = (None, false);
                state.settings.scene_open = true;
                self.bring_up(SKY);
            }
            Stop::Light => {
                (state.sheet, state.compare.open, state.maximised) = (None, false, None);
                self.bring_up(LID);
            }
            Stop::Compare | Stop::Export => {}
        }
        self.state.tour = Some(Tour { stop, seen: seen(&self.state) });
    }

    /// Checks whether the current step has been done since the last frame, and starts the next one if so.
    pub(super) fn follow_tour(&mut self) {
        let Some(tour) = &self.state.tour else { return };
        // At the start of the window something is chosen that nobody chose.
        if self.state.shelf().is_none() {
            return;
        }
        let (stop, now) = (tour.stop, seen(&self.state));
        let began_empty = tour.seen.product.is_empty();
        if began_empty || !tour.seen.done(&now, stop) {
            self.state.tour = Some(Tour { stop, seen: now });
            return;
        }
        let done = Stop::ALL.iter().position(|one| *one == stop).map_or(0, |place| place + 1);
        self.state.settings.tour = self.state.settings.tour.max(done);
        match Stop::ALL.get(done) {
            Some(next) => self.begin_stop(*next),
            None => {
                self.state.tour = None;
                self.toasts.success(shell::TOUR_DONE);
            }
        }
    }
}

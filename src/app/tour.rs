//! A tour in five steps on what is really there: each is done by doing it, none stops anything else.

use super::state::{Sheet, State};
use super::tiles::{LID, ROOM, SKY};
use super::window::App;
use crate::study::scene_file::{SceneFile, TimeKey};
use crate::texts::{Text, shell};

/// A step of the tour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// Choose a product.
    Product,
    /// Move the sun.
    Sun,
    /// Look at LID or room.
    Light,
    /// Compare.
    Compare,
    /// Hand on.
    HandOn,
}

impl Stop {
    /// All, in order.
    pub const ALL: [Self; 5] = [Self::Product, Self::Sun, Self::Light, Self::Compare, Self::HandOn];

    /// What is to be done.
    pub const fn words(self) -> Text {
        match self {
            Self::Product => shell::TOUR_PRODUCT,
            Self::Sun => shell::TOUR_SUN,
            Self::Light => shell::TOUR_LIGHT,
            Self::Compare => shell::TOUR_COMPARE,
            Self::HandOn => shell::TOUR_HAND_ON,
        }
    }
}

/// What can be asked of the tour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TourAct {
    /// Begin, or go on after the last step that was done.
    Start,
    /// Leave it.
    Leave,
    /// Not now: the offer goes.
    Decline,
}

/// What a step is told by.
#[derive(Debug, Clone, PartialEq)]
struct Seen {
    product: String,
    sun: (Option<TimeKey>, Option<f64>, Option<f64>),
    light: bool,
    candidates: usize,
    handing_on: bool,
}

impl Seen {
    fn of(state: &State) -> Self {
        let SceneFile { sky, compare, .. } = &state.document.scene;
        Self {
            product: state.document.selection.product.clone(),
            sun: (sky.time.clone(), sky.sun.altitude, sky.sun.azimuth),
            light: state.maximised.is_some_and(|tile| tile == LID || tile == ROOM),
            candidates: compare.len(),
            handing_on: state.sheet == Some(Sheet::HandOn),
        }
    }

    /// Was the step done between then and now?
    fn done(&self, now: &Self, stop: Stop) -> bool {
        match stop {
            Stop::Product => now.product != self.product,
            Stop::Sun => now.sun != self.sun,
            Stop::Light => now.light && !self.light,
            Stop::Compare => now.candidates > self.candidates,
            Stop::HandOn => now.handing_on && !self.handing_on,
        }
    }
}

/// The tour that is under way.
#[derive(Debug, Clone, PartialEq)]
pub struct Tour {
    /// Where it is.
    pub stop: Stop,
    /// How things were in the last frame.
    seen: Seen,
}

impl App {
    /// Does what is asked of the tour.
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

    /// Brings into sight where a step is done.
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
            Stop::Compare | Stop::HandOn => {}
        }
        self.state.tour = Some(Tour { stop, seen: Seen::of(&self.state) });
    }

    /// Notices what was done since the last frame.
    pub(super) fn follow_tour(&mut self) {
        let Some(tour) = &self.state.tour else { return };
        // At the start of the window something is chosen that nobody chose.
        if self.state.shelf().is_none() {
            return;
        }
        let (stop, now) = (tour.stop, Seen::of(&self.state));
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

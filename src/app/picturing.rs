//! Jobs that make the pictures of products for the gallery.

use super::gallery::{Made, picture};
use super::jobs::Lane;
use super::window::App;
use super::work::Outcome;

impl App {
    /// Starts a job that makes the missing pictures of the visible cards.
    pub(super) fn ask_pictures(&mut self) {
        // Cards ask in every frame: what is hidden meanwhile is not made, and what is under way not twice.
        let wanted = self.gallery.wanted();
        if wanted.is_empty() || self.jobs.busy(Lane::Gallery) {
            return;
        }
        let Some(shelf) = self.state.shelf() else { return };
        self.start(Lane::Gallery, move |_| {
            let made = wanted.into_iter().map(|one| {
                let picture = picture(&*shelf, &one);
                (one.dataset, picture)
            });
            Outcome::Pictures(made.collect())
        });
    }

    /// Takes over pictures that a job has made.
    pub(super) fn take_pictures(&mut self, made: Vec<Made>) {
        let ctx = self.ctx.clone();
        self.gallery.take(&ctx, made);
    }
}

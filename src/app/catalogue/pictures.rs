//! Jobs that make the pictures of products for the gallery.

use super::gallery::{Gallery, picture};
use crate::app::results::work::Outcome;
use crate::app::shell::Shell;
use crate::app::shell::jobs::Lane;

impl Gallery {
    /// Starts a job that makes the missing pictures of the visible cards.
    pub fn ask(&mut self, shell: &mut Shell) {
        // Cards ask in every frame: what is hidden meanwhile is not made, and what is under way not twice.
        let wanted = self.wanted();
        if wanted.is_empty() || shell.jobs.busy(Lane::Gallery) {
            return;
        }
        let Some(shelf) = shell.state.shelf() else { return };
        shell.start(Lane::Gallery, move |_| {
            let made = wanted.into_iter().map(|one| {
                let picture = picture(&*shelf, &one);
                (one.dataset, picture)
            });
            Outcome::Pictures(made.collect())
        });
    }
}

//! Pictures of products for the gallery: computed in a job for the visible cards, cached by the content of the data.

use crate::app::catalogue::shelf::{Entry, Shelf};
use crate::catalogue::TYPICAL_SUN;
use crate::compute::direction::{Dir, Incident};
use crate::drawing::thumbnail::{SIDE, indicatrix};
use egui::{Color32, ColorImage, TextureHandle, TextureOptions};
use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Maximum number of pictures computed in one job, so that the first are visible early.
const AT_ONCE: usize = 12;
/// Maximum number of pictures in the cache; dropped ones are computed again when they become visible.
const MOST: usize = 1500;

/// Finished picture with the hash of its data; `None` if the data cannot be drawn.
pub type Made = (Arc<str>, Option<Arc<ColorImage>>);

/// Requested picture: keys of product and state, hash of the data.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Wanted {
    product: String,
    state: String,
    pub(super) dataset: Arc<str>,
}

/// Cache of the product pictures in the gallery.
#[derive(Default)]
pub struct Gallery {
    pictures: HashMap<Arc<str>, Option<TextureHandle>>,
    wanted: Vec<Wanted>,
    /// Number of columns of cards in the gallery, as drawn last.
    pub columns: usize,
}

/// Draws the light distribution of a product's state for direct sun at the polar angle [`TYPICAL_SUN`].
pub(super) fn picture(shelf: &dyn Shelf, wanted: &Wanted) -> Option<Arc<ColorImage>> {
    let dataset = shelf.load(&wanted.product, Some(&wanted.state)).ok()?;
    let btdf = dataset.transmission()?;
    let sun = Incident(Dir::from_theta_phi(TYPICAL_SUN.to_radians(), FRAC_PI_2));
    let pixels = indicatrix(btdf, sun).into_iter();
    let pixels = pixels.map(|[r, g, b, a]| Color32::from_rgba_unmultiplied(r, g, b, a)).collect();
    Some(Arc::new(ColorImage::new([SIDE, SIDE], pixels)))
}

impl Gallery {
    /// Returns the picture of a product, or requests it if it is missing.
    pub fn of(&mut self, entry: &Entry) -> Option<&TextureHandle> {
        let dataset = entry.dataset.as_ref()?;
        if !self.pictures.contains_key(dataset) && self.wanted.iter().all(|one| one.dataset != *dataset) {
            self.wanted.push(Wanted {
                product: entry.key.clone(),
                state: entry.state().to_owned(),
                dataset: dataset.clone(),
            });
        }
        self.pictures.get(dataset)?.as_ref()
    }

    /// Returns the pictures that visible cards have requested since the last call and that are missing.
    pub(super) fn wanted(&mut self) -> Vec<Wanted> {
        let mut list = std::mem::take(&mut self.wanted);
        list.retain(|one| !self.pictures.contains_key(&one.dataset));
        list.truncate(AT_ONCE);
        list
    }

    /// Whether there is a picture of data with this hash.
    pub fn has(&self, dataset: &str) -> bool {
        self.pictures.get(dataset).is_some_and(Option::is_some)
    }

    pub(in crate::app) fn take(&mut self, ctx: &egui::Context, made: Vec<Made>) {
        if self.pictures.len() > MOST {
            self.pictures.clear();
        }
        for (dataset, image) in made {
            let texture = image.map(|image| ctx.load_texture(&*dataset, image, TextureOptions::LINEAR));
            self.pictures.insert(dataset, texture);
        }
    }
}

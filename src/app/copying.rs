//! Copying to the clipboard: tiles as pictures, and the value under the pointer. The numbers of tiles are copied by
//! [`super::export`].

use super::error::AppError;
use super::export_choices::{Choices, What};
use super::export_files::Order;
use super::jobs::Lane;
use super::paint::tile::pointed_foot;
use super::state::Tile;
use super::window::App;
use super::work::{Outcome, Pixels};
use crate::drawing::missing_characters;
use crate::report::{Size, TileKind};
use crate::texts::tiles as say;

/// Maximum length of the copied text that is repeated in a message. \[characters\]
const MAX_EXCERPT: usize = 80;

impl App {
    /// Draws a tile as an exported picture, for the clipboard.
    pub(super) fn copy_picture(&mut self, tile: Tile) {
        let Some(kind) = TileKind::titled(tile.title) else { return };
        let Some(order) = self.order() else { return self.report_error(&AppError::NoProduct) };
        let size = Size::default();
        let choices = Choices { what: What::Picture, tile: kind, size, caption: true, print: false, ..order.choices };
        let order = Order { choices, ..order };
        self.start(Lane::Copy, move |progress| {
            let drawn = order.picture(progress);
            let warning = drawn.as_ref().ok().and_then(|drawing| missing_characters(std::slice::from_ref(drawing)));
            let pixels = drawn.map(|drawing| drawing.to_pixels(size.pixels()[0] / drawing.width));
            Outcome::Copied(tile, pixels).with_warning(warning)
        });
    }

    /// Puts a picture into the clipboard.
    pub(super) fn take_copied(&mut self, tile: Tile, drawn: Result<Pixels, AppError>) {
        match drawn {
            Ok((width, height, pixels)) => {
                self.ctx.copy_image(egui::ColorImage::from_rgb([width, height], &pixels));
                self.toasts.success(say::picture_copied(tile.name));
            }
            Err(error) => self.report_error(&error),
        }
    }

    /// Copies the value line under the tile that was last under the pointer to the clipboard.
    pub(super) fn copy_value(&mut self) {
        let Some(text) = pointed_foot(&self.ctx).filter(|text| !text.is_empty()) else {
            return self.toasts.info(say::NO_VALUE);
        };
        let short: String = text.chars().take(MAX_EXCERPT).collect();
        let more = if short.len() < text.len() { "…" } else { "" };
        self.ctx.copy_text(text);
        self.toasts.success(say::copied(format!("{short}{more}")));
    }
}

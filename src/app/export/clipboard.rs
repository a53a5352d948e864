//! Copying to the clipboard: tiles as pictures, and the value under the pointer. The numbers of tiles are copied by
//! [`Export::copy_tile`].

use super::Export;
use super::choices::{Choices, What};
use super::files::Order;
use crate::app::paint::tile::pointed_foot;
use crate::app::results::work::{Outcome, Pixels};
use crate::app::shell::Shell;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::Lane;
use crate::app::state::Tile;
use crate::drawing::missing_characters;
use crate::report::{Size, TileKind};
use crate::texts::tiles as say;

/// Maximum length of the copied text that is repeated in a message. \[characters\]
const MAX_EXCERPT: usize = 80;

impl Export {
    /// Draws a tile as an exported picture, for the clipboard.
    pub fn copy_picture(&self, shell: &mut Shell, tile: Tile) {
        let Some(kind) = TileKind::titled(tile.title) else { return };
        let Some(order) = self.order(shell) else { return shell.report_error(&AppError::NoProduct) };
        let size = Size::default();
        let choices = Choices { what: What::Picture, tile: kind, size, caption: true, print: false, ..order.choices };
        let order = Order { choices, ..order };
        shell.start(Lane::Copy, move |progress| {
            let drawn = order.picture(progress);
            let warning = drawn.as_ref().ok().and_then(|drawing| missing_characters(std::slice::from_ref(drawing)));
            let pixels = drawn.map(|drawing| drawing.to_pixels(size.pixels()[0] / drawing.width));
            Outcome::Copied(tile, pixels).with_warning(warning)
        });
    }
}

/// Puts a picture into the clipboard.
pub fn take_copied(shell: &mut Shell, tile: Tile, drawn: Result<Pixels, AppError>) {
    match drawn {
        Ok((width, height, pixels)) => {
            shell.ctx.copy_image(egui::ColorImage::from_rgb([width, height], &pixels));
            shell.toasts.success(say::picture_copied(tile.name));
        }
        Err(error) => shell.report_error(&error),
    }
}

/// Copies the value line under the tile that was last under the pointer to the clipboard.
pub fn copy_value(shell: &mut Shell) {
    let Some(text) = pointed_foot(&shell.ctx).filter(|text| !text.is_empty()) else {
        return shell.toasts.info(say::NO_VALUE);
    };
    let short: String = text.chars().take(MAX_EXCERPT).collect();
    let more = if short.len() < text.len() { "…" } else { "" };
    shell.ctx.copy_text(text);
    shell.toasts.success(say::copied(format!("{short}{more}")));
}

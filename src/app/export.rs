//! Tiles as files: the numbers a tile shows (.csv), or its picture as it stands in the window (.png).
//!
//! Both need the tile to be drawn once more: its numbers are known to its drawing alone, its picture to the screen.

use super::error::AppError;
use super::state::Tile;
use egui::{ColorImage, Rect};
use image::ImageEncoder;
use image::codecs::png::PngEncoder;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// Where a tile's numbers go.
enum Target {
    Clipboard,
    File(PathBuf),
}

/// What is asked of tiles, and what they gave.
#[derive(Default)]
pub struct Exports {
    numbers: Option<(Tile, Target)>,
    picture: Option<(Tile, PathBuf)>,
    /// Filled by the screen, whenever it gets to it.
    taken: Arc<Mutex<Vec<(Tile, PathBuf, ColorImage)>>>,
    done: Vec<(Tile, PathBuf, String)>,
}

impl Exports {
    /// Asks a tile for its numbers, for the clipboard.
    pub fn ask_copy(&mut self, tile: Tile) {
        self.numbers = Some((tile, Target::Clipboard));
    }

    /// Asks a tile for its numbers (.csv) or its picture (.png).
    pub fn ask(&mut self, tile: Tile, path: PathBuf) -> Result<(), AppError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        match ending.as_str() {
            "csv" => self.numbers = Some((tile, Target::File(path))),
            "png" => self.picture = Some((tile, path)),
            _ => return Err(AppError::TileEnding(ending).about(path.display())),
        }
        Ok(())
    }

    /// True when this tile's numbers are asked for.
    pub fn wants_numbers(&self, tile: Tile) -> bool {
        self.numbers.as_ref().is_some_and(|(wanted, _)| *wanted == tile)
    }

    /// Takes the numbers of the tile that was asked.
    pub fn numbers(&mut self, ctx: &egui::Context, text: String) {
        match self.numbers.take() {
            Some((_, Target::Clipboard)) => ctx.copy_text(text),
            Some((tile, Target::File(path))) => {
                self.done.push((tile, path, text));
                ctx.request_repaint();
            }
            None => {}
        }
    }

    /// Numbers that are to be written.
    pub fn next_numbers(&mut self) -> Option<(Tile, PathBuf, String)> {
        self.done.pop()
    }

    /// A picture that is to be written.
    pub fn next_picture(&mut self) -> Option<(Tile, PathBuf, ColorImage)> {
        self.taken.lock().unwrap_or_else(PoisonError::into_inner).pop()
    }

    /// Asks the screen for a tile's picture if it is wanted; the tile stands at `rect`.
    pub fn picture(&mut self, ctx: &egui::Context, tile: Tile, rect: Rect) {
        let Some((_, path)) = self.picture.take_if(|(wanted, _)| *wanted == tile) else { return };
        let (taken, scale, waker) = (self.taken.clone(), ctx.pixels_per_point(), ctx.clone());
        ctx.request_screenshot(move |screen| {
            let picture = crop(&screen, rect, scale);
            taken.lock().unwrap_or_else(PoisonError::into_inner).push((tile, path, picture));
            waker.request_repaint();
        });
    }
}

/// The part of the screen under a rectangle \[points\], as far as it is on the screen.
fn crop(screen: &ColorImage, rect: Rect, scale: f32) -> ColorImage {
    let [width, height] = screen.size;
    let pixel = |points: f32, limit: usize| ((points * scale).round().max(0.0) as usize).min(limit);
    let (left, right) = (pixel(rect.left(), width), pixel(rect.right(), width));
    let (top, bottom) = (pixel(rect.top(), height), pixel(rect.bottom(), height));
    screen.region_by_pixels([left, top], [right - left, bottom - top])
}

/// A picture as PNG.
pub fn png(picture: &ColorImage) -> Result<Vec<u8>, AppError> {
    let pixels: Vec<u8> = picture.pixels.iter().flat_map(|pixel| pixel.to_array()).collect();
    let [Ok(width), Ok(height)] = picture.size.map(u32::try_from) else { return Err(AppError::PictureSize) };
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes).write_image(&pixels, width, height, image::ExtendedColorType::Rgba8)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Color32, pos2};

    #[test]
    fn the_picture_is_the_tiles_part_of_the_screen() {
        let mut screen = ColorImage::filled([40, 20], Color32::BLACK);
        for y in 4..8 {
            for x in 10..30 {
                screen.pixels[y * 40 + x] = Color32::RED;
            }
        }
        // At two pixels a point; half of the rectangle is below the screen.
        let picture = crop(&screen, Rect::from_min_max(pos2(5.0, 2.0), pos2(15.0, 20.0)), 2.0);
        assert_eq!(picture.size, [20, 16]);
        let read = image::load_from_memory(&png(&picture).unwrap()).unwrap().to_rgba8();
        assert_eq!(read.get_pixel(19, 3).0, [255, 0, 0, 255]);
        assert_eq!(read.get_pixel(0, 4).0, [0, 0, 0, 255]);
    }
}

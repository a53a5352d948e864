//! Parts shared by the kinds of comparison: the compared tile, the rectangles of the candidates' tiles, and the text in
//! place of a missing picture.

use crate::app::compare::columns::Column;
use crate::app::state::{State, Tile};
use crate::app::tiles::TILES;
use crate::report::TileKind;
use crate::texts::compare as texts;
use egui::{Rect, vec2};

/// Returns a name shortened to at most `most` letters: its beginning and its end with "…" between them, because names
/// of similar products often differ at the end.
pub(super) fn short(name: &str, most: usize) -> String {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() <= most {
        return name.to_owned();
    }
    let last = most.saturating_sub(1) / 2;
    let first: String = letters[..most.saturating_sub(1 + last)].iter().collect();
    let end: String = letters[letters.len() - last..].iter().collect();
    format!("{}…{}", first.trim_end(), end.trim_start())
}

/// Returns the title of a tile in the language of the window.
pub(super) fn tile_words(title: &str) -> String {
    TileKind::titled(title).map_or_else(|| title.to_owned(), |kind| kind.words().into())
}

/// Returns the kind of the compared tile; `None` if it is not of a kind that can be compared and exported.
pub(super) fn kind(state: &State) -> Option<TileKind> {
    TileKind::titled(state.compare.tile())
}

/// Returns the compared tile; `None` if there is no tile with its title.
pub(super) fn tile(state: &State) -> Option<Tile> {
    TILES.iter().map(|entry| entry.tile).find(|tile| tile.title == state.compare.tile())
}

/// Returns the rectangles for the tiles of `count` candidates: side by side if each is wide enough, otherwise in two
/// rows.
pub(super) fn places(whole: Rect, count: usize) -> Vec<Rect> {
    const GAP: f32 = 6.0;
    let rows = if count > 3 && whole.width() / (count as f32) < 300.0 { 2 } else { 1 };
    let columns = count.div_ceil(rows).max(1);
    let size = vec2(
        (whole.width() - GAP * (columns - 1) as f32) / columns as f32,
        (whole.height() - GAP * (rows - 1) as f32) / rows as f32,
    );
    let place = |k: usize| vec2((k % columns) as f32 * (size.x + GAP), (k / columns) as f32 * (size.y + GAP));
    (0..count).map(|k| Rect::from_min_size(whole.min + place(k), size)).collect()
}

/// Returns the text in place of a candidate's missing picture: its error, or that it is being computed.
pub(super) fn missing(column: &Column) -> String {
    column.error().map_or_else(|| texts::COMPUTING.into(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn tiles_of_candidates_fill_the_place_without_overlap() {
        for width in [520.0, 900.0, 1700.0] {
            let whole = Rect::from_min_size(pos2(10.0, 20.0), vec2(width, 500.0));
            for count in 1..=6 {
                let list = places(whole, count);
                assert_eq!(list.len(), count);
                for (k, one) in list.iter().enumerate() {
                    assert!(whole.expand(0.01).contains_rect(*one), "{count} {one:?}");
                    assert!(list[..k].iter().all(|other| !other.shrink(0.1).intersects(*one)));
                }
            }
        }
        assert_eq!(places(Rect::from_min_size(pos2(0.0, 0.0), vec2(900.0, 500.0)), 6)[3].left(), 0.0);
    }

    #[test]
    fn names_are_shortened_with_a_sign() {
        assert_eq!(short("Venetian", 8), "Venetian");
        assert_eq!(short("Venetian blind, curve", 12), "Veneti…curve");
        assert_eq!(short("Venetian", 1), "…");
    }
}

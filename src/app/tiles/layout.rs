//! Where tiles stand on the bench, as a value.

use crate::app::state::Tile;
use egui::{Rect, vec2};

/// Rows from top to bottom, each with tiles from left to right.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// The rows.
    pub rows: Vec<Row>,
}

/// Tiles side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Its height against that of the others.
    pub weight: f32,
    /// Tiles, each with its width against that of the others.
    pub tiles: Vec<(f32, Tile)>,
}

/// Starts and lengths of parts of a length, by their weights, with gaps between them.
fn parts(length: f32, gap: f32, weights: impl Iterator<Item = f32> + Clone) -> Vec<(f32, f32)> {
    let gaps = weights.clone().count().saturating_sub(1) as f32;
    let all: f32 = weights.clone().sum();
    let mut start = 0.0;
    let part = |weight| {
        let part = (start, (length - gaps * gap) * weight / all);
        start += part.1 + gap;
        part
    };
    weights.map(part).collect()
}

impl Layout {
    /// Two rows of equal tiles.
    pub fn even(tiles: Vec<Tile>) -> Self {
        let columns = tiles.len().div_ceil(2).max(1);
        let row = |tiles: &[Tile]| Row { weight: 1.0, tiles: tiles.iter().map(|tile| (1.0, *tile)).collect() };
        Self { rows: tiles.chunks(columns).map(row).collect() }
    }

    /// The tiles' rectangles, in order.
    pub fn places(&self, whole: Rect, gap: f32) -> Vec<(Tile, Rect)> {
        let mut places = Vec::new();
        let rows = parts(whole.height(), gap, self.rows.iter().map(|row| row.weight));
        for (row, (top, height)) in self.rows.iter().zip(rows) {
            let columns = parts(whole.width(), gap, row.tiles.iter().map(|(weight, _)| *weight));
            for ((_, tile), (left, width)) in row.tiles.iter().zip(columns) {
                places.push((*tile, Rect::from_min_size(whole.min + vec2(left, top), vec2(width, height))));
            }
        }
        places
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn weights_share_what_gaps_leave() {
        let [a, b, c] = ["a", "b", "c"].map(|title| Tile { title, help: "" });
        let whole = Rect::from_min_max(pos2(10.0, 20.0), pos2(116.0, 226.0));
        let rows =
            vec![Row { weight: 3.0, tiles: vec![(1.0, a), (4.0, b)] }, Row { weight: 1.0, tiles: vec![(2.0, c)] }];
        let rect = |x0, y0, x1, y1| Rect::from_min_max(pos2(x0, y0), pos2(x1, y1));
        let wanted = [
            (a, rect(10.0, 20.0, 30.0, 170.0)),
            (b, rect(36.0, 20.0, 116.0, 170.0)),
            (c, rect(10.0, 176.0, 116.0, 226.0)),
        ];
        assert_eq!(Layout { rows }.places(whole, 6.0), wanted);
        let even = Layout::even(vec![a, b, c]);
        assert_eq!(even.rows.iter().map(|row| row.tiles.len()).collect::<Vec<_>>(), [2, 1]);
    }
}

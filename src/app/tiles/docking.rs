//! Arrangement of the tiles by menus, command palette and keys.

use crate::app::shell::Shell;
use crate::app::state::Tile;
use crate::app::tiles::arrange::{Arrange, Way};
use crate::app::tiles::{all, preset};
use crate::texts::tiles as say;
use egui::{Pos2, Rect};

/// Returns the tile nearest to the tile `from` on the side `way`, preferably opposite its middle; `None` if there is
/// none.
fn beside(places: &[(Tile, Rect)], from: Tile, way: Way) -> Option<Tile> {
    let own = places.iter().find(|(tile, _)| *tile == from)?.1;
    let gap = |rect: &Rect| match way {
        Way::Left => own.left() - rect.right(),
        Way::Right => rect.left() - own.right(),
        Way::Up => own.top() - rect.bottom(),
        Way::Down => rect.top() - own.bottom(),
    };
    let aside = |rect: &Rect| {
        let nearest: Pos2 = rect.clamp(own.center());
        match way {
            Way::Left | Way::Right => (nearest.y - own.center().y).abs(),
            Way::Up | Way::Down => (nearest.x - own.center().x).abs(),
        }
    };
    // Borders touch or leave a gap; rounding may let them overlap a little.
    let there = places.iter().filter(|(tile, rect)| *tile != from && gap(rect) > -4.0);
    let nearest = there.min_by(|(_, a), (_, b)| (gap(a) + aside(a)).total_cmp(&(gap(b) + aside(b))));
    nearest.map(|(tile, _)| *tile)
}

/// Executes a command about the arrangement of the tiles.
pub fn arrange(shell: &mut Shell, what: Arrange) {
    let state = &mut shell.state;
    if let Arrange::Preset(ready) = what {
        state.maximised = None;
        state.settings.layout =
            (ready != crate::app::tiles::arrange::Preset::All).then(|| preset(ready, &all()).text());
        return;
    }
    let bench = &mut shell.bench;
    let mut layout = bench.layout();
    let visible = layout.visible_tiles();
    if !visible.contains(&bench.in_hand) {
        bench.in_hand = visible.first().copied().unwrap_or(bench.in_hand);
    }
    let own = bench.in_hand;
    let number = visible.iter().position(|tile| *tile == own).unwrap_or(0) as i32;
    let next = |step: i32| visible[(number + step).rem_euclid(visible.len() as i32) as usize];
    let mut nothing: Option<String> = None;
    let changed = match what {
        Arrange::Preset(_) => None,
        Arrange::Focus(step) => {
            // One that fills the bench gives way to the next.
            bench.in_hand = next(step);
            state.maximised = state.maximised.map(|_| bench.in_hand);
            None
        }
        Arrange::FocusOn(way) => {
            bench.in_hand = beside(&bench.places, own, way).unwrap_or(own);
            None
        }
        Arrange::Tab(step) => match layout.next_tab(own, step) {
            Some(tile) => {
                bench.in_hand = tile;
                Some(layout)
            }
            None => {
                nothing = Some(say::is_no_tab_join(own.name));
                None
            }
        },
        Arrange::Move(way) => {
            let other = beside(&bench.places, own, way);
            nothing = other.is_none().then(|| say::none_beside(own.name));
            other.map(|other| layout.swapped(own, other))
        }
        Arrange::Join => Some(layout.joined(own, next(1))),
        Arrange::Split => {
            let split = layout.clone().split(own);
            nothing = (split == layout).then(|| say::is_no_tab(own.name));
            Some(split)
        }
        Arrange::Width(more) | Arrange::Height(more) => {
            let wide = matches!(what, Arrange::Width(_));
            let done = layout.resize(own, wide, more);
            let message = || if wide { say::shares_no_width(own.name) } else { say::shares_no_height(own.name) };
            nothing = (!done).then(message);
            Some(layout)
        }
    };
    bench.to_focus = true;
    if let Some(words) = nothing {
        shell.toasts.info(words);
    } else if let Some(layout) = changed {
        shell.keep_layout(&layout);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{pos2, vec2};

    #[test]
    fn the_tile_beside_is_the_one_across() {
        let tile = |title| Tile { title, name: say::SKY, help: say::SKY_HELP };
        let [a, b, c] = ["a", "b", "c"].map(tile);
        let at = |x: f32, y: f32, w: f32, h: f32| Rect::from_min_size(pos2(x, y), vec2(w, h));
        // a over the whole height at the left, b over c at the right.
        let places = [(a, at(0.0, 0.0, 50.0, 100.0)), (b, at(56.0, 0.0, 50.0, 30.0)), (c, at(56.0, 36.0, 50.0, 64.0))];
        assert_eq!(beside(&places, a, Way::Right), Some(c));
        assert_eq!(beside(&places, b, Way::Left), Some(a));
        assert_eq!(beside(&places, b, Way::Down), Some(c));
        assert_eq!(beside(&places, c, Way::Up), Some(b));
        assert_eq!(beside(&places, a, Way::Left), None);
    }
}

//! Tests of layouts as values: read, joined, split, resized.

use super::*;
use crate::texts::Text;

fn tiles() -> [Tile; 4] {
    ["a", "b", "c", "d"].map(|title| Tile { title, name: Text::new(title, title), help: Text::new("", "") })
}

fn sample() -> Layout {
    let [a, b, c, d] = tiles();
    Layout::Row(vec![(2.0, Layout::Tile(a)), (1.0, Layout::Column(vec![(1.0, Layout::Tile(b)), (3.0, tabs(&[c, d]))]))])
}

fn tabs(list: &[Tile]) -> Layout {
    Layout::tabs(list)
}

#[test]
fn what_is_kept_comes_back_and_so_does_what_is_drawn() {
    let layout = sample();
    assert_eq!(Layout::read(&layout.text(), &tiles()), Ok(layout.clone()));
    assert_eq!(Layout::of(&layout.tree()), Some(layout));
}

#[test]
fn unknown_tiles_leave_missing_ones_come_as_tabs_and_broken_text_is_refused() {
    let [a, b, c, d] = tiles();
    let text = sample().text();
    let renamed = text.replace("\"b\"", "\"of a newer version\"");
    let read = Layout::read(&renamed, &tiles()).unwrap();
    // The column held two things; one is left, and the missing tile stands with the last one.
    let wanted = Layout::Tabs { front: 0, tabs: vec![Layout::Tile(c), tabs(&[d, b])] };
    assert_eq!(read, Layout::Row(vec![(2.0, Layout::Tile(a)), (1.0, wanted)]));
    let twice = text.replace("\"b\"", "\"a\"");
    assert_eq!(Layout::read(&twice, &tiles()).unwrap().tiles().iter().filter(|tile| **tile == a).count(), 1);
    assert!(Layout::read(&text[..text.len() - 4], &tiles()).is_err());
    assert!(Layout::read(&text.replace("\"version\":1", "\"version\":7"), &tiles()).unwrap_err().contains("format 7"));
    assert!(Layout::read(&text.replace("2.0", "-2.0"), &tiles()).unwrap_err().contains("share"));
    assert!(Layout::read(r#"{"version":1,"tree":{"tile":"x"}}"#, &tiles()).is_err());
}

#[test]
fn a_layout_of_the_version_before_is_read_whatever_tiles_are_called() {
    let old = ["BTDF", "Transmittance", "Sky", "LID", "Room", "Control", "Year", "Choose"];
    let kept: Vec<String> = old.iter().map(|title| format!(r#"{{"tile":"{title}"}}"#)).collect();
    let text = format!(r#"{{"version":1,"tree":{{"tabs":{{"front":7,"tabs":[{}]}}}}}}"#, kept.join(","));
    let known: Vec<Tile> = crate::app::tiles::TILES.iter().map(|entry| entry.tile).collect();
    let read = Layout::read(&text, &known).unwrap();
    assert_eq!(read.tiles().iter().map(|tile| tile.title).collect::<Vec<_>>(), old);
    assert_eq!(crate::report::TileKind::ALL.map(crate::report::TileKind::title), old);
    assert!(matches!(read, Layout::Tabs { front: 7, .. }));
}

#[test]
fn only_what_is_in_front_is_in_sight() {
    let [a, b, c, d] = tiles();
    let mut layout = sample();
    assert_eq!(layout.visible_tiles(), [a, b, c]);
    assert!(layout.reveal(d) && !layout.reveal(d) && !layout.reveal(a));
    assert_eq!(layout.visible_tiles(), [a, b, d]);
    assert_eq!(layout.next_tab(d, 1), Some(c));
    assert_eq!(layout.next_tab(c, -1), Some(d));
    assert_eq!(layout.next_tab(a, 1), None);
}

#[test]
fn tiles_swap_join_split_and_grow() {
    let [a, b, c, d] = tiles();
    let swapped = sample().swapped(a, d);
    assert_eq!(swapped.tiles(), [d, b, c, a]);
    let joined = sample().joined(a, d);
    assert_eq!(
        joined,
        Layout::Column(vec![
            (1.0, Layout::Tile(b)),
            (3.0, Layout::Tabs { front: 2, tabs: vec![Layout::Tile(c), Layout::Tile(d), Layout::Tile(a)] })
        ])
    );
    let alone = sample().joined(a, b);
    assert_eq!(alone.visible_tiles(), [a, c]);
    let split = sample().split(d);
    assert_eq!(split.visible_tiles(), [a, b, c, d]);
    assert_eq!(sample().split(a), sample());
    let mut grown = sample();
    assert!(grown.resize(a, true, true) && !grown.resize(a, false, true));
    let Layout::Row(list) = &grown else { panic!("{grown:?}") };
    assert!((list[0].0 - 2.4).abs() < 1e-6 && list[1].0 == 1.0);
    assert!(grown.resize(d, false, false));
}

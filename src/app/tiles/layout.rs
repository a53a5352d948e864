//! The arrangement of tiles as a value that is read, written and rearranged, and its conversion to and from the tree
//! that egui_tiles draws.

use crate::app::state::Tile;
use crate::texts::tiles as say;
use egui_tiles::{Container, Linear, LinearDir, Tabs, TileId, Tiles, Tree};
use serde::{Deserialize, Serialize};

/// Version of the file format of stored layouts. Other versions are not read.
const VERSION: u32 = 1;
/// Factor on a tile's share of a row or column when it becomes one step wider or higher.
const STEP: f32 = 1.2;

/// Node of a layout: a tile, or an arrangement of nodes. `T`: the tile, or its title in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Place<T> {
    /// One tile.
    Tile(T),
    /// Tabs: several nodes, of which one is in front of the others.
    Tabs {
        /// Index of the tab in front.
        front: usize,
        /// All tabs.
        tabs: Vec<Place<T>>,
    },
    /// Row of nodes from left to right, with their shares of the width.
    Row(Vec<(f32, Place<T>)>),
    /// Column of nodes from top to bottom, with their shares of the height.
    Column(Vec<(f32, Place<T>)>),
}

/// Nodes with their shares of a width or height.
type Shares<T> = Vec<(f32, Place<T>)>;

/// Arrangement of the tile area.
pub type Layout = Place<Tile>;

/// Layout as it is stored in a file.
#[derive(Serialize, Deserialize)]
struct Kept {
    version: u32,
    tree: Place<String>,
}

impl<T> Place<T> {
    /// Returns the node with each tile replaced by the result of `of`; tiles for which it is `None` are removed, and
    /// rows, columns and tabs that then hold fewer than two nodes are dissolved.
    fn filter_map<U>(self, of: &mut impl FnMut(T) -> Option<U>) -> Option<Place<U>> {
        let mut list = |children: Vec<(f32, Self)>| -> Vec<(f32, Place<U>)> {
            children.into_iter().filter_map(|(share, child)| Some((share, child.filter_map(of)?))).collect()
        };
        let only = |mut children: Shares<U>, make: fn(Shares<U>) -> Place<U>| match children.len() {
            0 => None,
            1 => children.pop().map(|(_, child)| child),
            _ => Some(make(children)),
        };
        match self {
            Self::Tile(tile) => of(tile).map(Place::Tile),
            Self::Row(children) => only(list(children), Place::Row),
            Self::Column(children) => only(list(children), Place::Column),
            Self::Tabs { front, tabs } => {
                let kept: Vec<(usize, Place<U>)> = tabs
                    .into_iter()
                    .enumerate()
                    .filter_map(|(number, tab)| Some((number, tab.filter_map(of)?)))
                    .collect();
                let front = kept.iter().position(|(number, _)| *number == front).unwrap_or(0);
                let mut tabs: Vec<Place<U>> = kept.into_iter().map(|(_, tab)| tab).collect();
                if tabs.len() > 1 { Some(Place::Tabs { front, tabs }) } else { tabs.pop() }
            }
        }
    }

    /// Whether all shares lie within 0.001 … 1000.
    fn sound(&self) -> bool {
        match self {
            Self::Tile(_) => true,
            Self::Tabs { tabs, .. } => tabs.iter().all(Self::sound),
            Self::Row(list) | Self::Column(list) => {
                list.iter().all(|(share, child)| (1e-3..=1e3).contains(share) && child.sound())
            }
        }
    }

    fn children_mut(&mut self) -> Vec<&mut Self> {
        match self {
            Self::Tile(_) => vec![],
            Self::Tabs { tabs, .. } => tabs.iter_mut().collect(),
            Self::Row(list) | Self::Column(list) => list.iter_mut().map(|(_, child)| child).collect(),
        }
    }
}

impl Layout {
    /// Returns a layout of two rows with tiles of equal size.
    pub fn even(tiles: &[Tile]) -> Self {
        let columns = tiles.len().div_ceil(2).max(1);
        let row = |tiles: &[Tile]| (1.0, Self::Row(tiles.iter().map(|tile| (1.0, Self::Tile(*tile))).collect()));
        Self::Column(tiles.chunks(columns).map(row).collect())
    }

    /// Returns a layout of tabs, with the first tile in front.
    pub fn tabs(tiles: &[Tile]) -> Self {
        Self::Tabs { front: 0, tabs: tiles.iter().copied().map(Self::Tile).collect() }
    }

    /// Returns the layout as text to be stored.
    pub fn text(&self) -> String {
        let title = |tile: Tile| Some(tile.title.to_owned());
        let tree = self.clone().filter_map(&mut { title });
        // Strings and finite numbers: what cannot be written does not arise.
        tree.and_then(|tree| serde_json::to_string(&Kept { version: VERSION, tree }).ok()).unwrap_or_default()
    }

    /// Reads a stored layout. Tiles that are not in `known`, or occur twice, are removed; known tiles that are missing
    /// become tabs of the last tile.
    ///
    /// # Errors
    /// Returns an error, in one clause, if the text is not a layout of this version, has an invalid share, or has no
    /// known tile.
    pub fn read(text: &str, known: &[Tile]) -> Result<Self, String> {
        let kept: Kept = serde_json::from_str(text).map_err(|error| error.to_string())?;
        if kept.version != VERSION {
            return Err(say::layout_form(kept.version, VERSION));
        }
        if !kept.tree.sound() {
            return Err(say::LAYOUT_SHARE.into());
        }
        let mut left = known.to_vec();
        let layout = kept.tree.filter_map(&mut |title: String| {
            let number = left.iter().position(|tile| tile.title == title)?;
            Some(left.remove(number))
        });
        let Some(layout) = layout else { return Err(say::LAYOUT_UNKNOWN.into()) };
        Ok(if left.is_empty() { layout } else { layout.with(&left) })
    }

    /// Returns the layout with `tiles`, which it must not contain yet, added as tabs behind the tile `front`.
    pub fn behind(self, front: Tile, tiles: &[Tile]) -> Self {
        self.replaced(front, &mut |own| Self::tabs(&[&[own], tiles].concat()))
    }

    /// Returns the layout with more tiles, added as tabs of its last tile.
    fn with(self, more: &[Tile]) -> Self {
        let last = self.tiles().last().copied();
        match last {
            Some(last) => self.replaced(last, &mut |own| {
                let tabs = std::iter::once(own).chain(more.iter().copied()).map(Self::Tile).collect();
                Self::Tabs { front: 0, tabs }
            }),
            None => self,
        }
    }

    /// Returns all tiles of the layout, in order.
    pub fn tiles(&self) -> Vec<Tile> {
        match self {
            Self::Tile(tile) => vec![*tile],
            Self::Tabs { tabs, .. } => tabs.iter().flat_map(Self::tiles).collect(),
            Self::Row(list) | Self::Column(list) => list.iter().flat_map(|(_, child)| child.tiles()).collect(),
        }
    }

    /// Returns the visible tiles of the layout, i.e. those not behind another tab, in order.
    pub fn visible_tiles(&self) -> Vec<Tile> {
        match self {
            Self::Tile(tile) => vec![*tile],
            Self::Tabs { front, tabs } => tabs.get(*front).or(tabs.first()).map_or_else(Vec::new, Self::visible_tiles),
            Self::Row(list) | Self::Column(list) => list.iter().flat_map(|(_, child)| child.visible_tiles()).collect(),
        }
    }

    /// Returns the layout with one tile replaced by the layout that `with` returns for it.
    fn replaced(self, wanted: Tile, with: &mut impl FnMut(Tile) -> Self) -> Self {
        let mut list = |children: Vec<(f32, Self)>| {
            children.into_iter().map(|(share, child)| (share, child.replaced(wanted, with))).collect()
        };
        match self {
            Self::Tile(tile) if tile == wanted => with(tile),
            Self::Tile(tile) => Self::Tile(tile),
            Self::Row(children) => Self::Row(list(children)),
            Self::Column(children) => Self::Column(list(children)),
            Self::Tabs { front, tabs } => {
                Self::Tabs { front, tabs: tabs.into_iter().map(|tab| tab.replaced(wanted, with)).collect() }
            }
        }
    }

    fn without(self, tile: Tile) -> Option<Self> {
        self.filter_map(&mut |own| (own != tile).then_some(own))
    }

    /// Returns the layout with two tiles exchanged.
    pub fn swapped(self, a: Tile, b: Tile) -> Self {
        let other = |own: Tile| {
            Some(if own == a {
                b
            } else if own == b {
                a
            } else {
                own
            })
        };
        self.clone().filter_map(&mut { other }).unwrap_or(self)
    }

    /// Returns the layout with a tile moved to the tabs of another tile `to`, in front of it.
    pub fn joined(self, tile: Tile, to: Tile) -> Self {
        if tile == to {
            return self;
        }
        let Some(mut rest) = self.clone().without(tile) else { return self };
        if !rest.join(tile, to) {
            rest = rest.replaced(to, &mut |own| Self::Tabs { front: 1, tabs: vec![Self::Tile(own), Self::Tile(tile)] });
        }
        rest
    }

    /// Inserts a tile into the tabs that contain the tile `to`. Returns whether there are such tabs.
    fn join(&mut self, tile: Tile, to: Tile) -> bool {
        if let Self::Tabs { front, tabs } = self
            && let Some(number) = tabs.iter().position(|tab| *tab == Self::Tile(to))
        {
            tabs.insert(number + 1, Self::Tile(tile));
            *front = number + 1;
            return true;
        }
        self.children_mut().into_iter().any(|child| child.join(tile, to))
    }

    /// Returns the layout with a tile moved out of its tabs to their right; unchanged if it is not a tab.
    pub fn split(mut self, tile: Tile) -> Self {
        self.split_off(tile);
        self
    }

    fn split_off(&mut self, tile: Tile) -> bool {
        if let Self::Tabs { tabs, .. } = self
            && tabs.contains(&Self::Tile(tile))
        {
            if let Some(rest) = self.clone().without(tile) {
                *self = Self::Row(vec![(1.0, rest), (1.0, Self::Tile(tile))]);
            }
            return true;
        }
        self.children_mut().into_iter().any(|child| child.split_off(tile))
    }

    /// Brings a tile to the front of its tabs. Returns `true` if it was hidden before.
    pub fn reveal(&mut self, tile: Tile) -> bool {
        if let Self::Tabs { front, tabs } = self
            && let Some(number) = tabs.iter().position(|tab| tab.tiles().contains(&tile))
        {
            let hidden = *front != number;
            *front = number;
            return tabs[number].reveal(tile) || hidden;
        }
        self.children_mut().into_iter().any(|child| child.reveal(tile))
    }

    /// Brings the next (`step` +1) or previous (−1) tab to the front, in the tabs that contain a tile. Returns the tile
    /// of that tab; `None` if there are no such tabs.
    pub fn next_tab(&mut self, tile: Tile, step: i32) -> Option<Tile> {
        if let Some(inner) = self.children_mut().into_iter().find_map(|child| child.next_tab(tile, step)) {
            return Some(inner);
        }
        match self {
            Self::Tabs { front, tabs } if tabs.iter().any(|tab| tab.tiles().contains(&tile)) => {
                *front = (*front as i32 + step).rem_euclid(tabs.len() as i32) as usize;
                tabs[*front].visible_tiles().first().copied()
            }
            _ => None,
        }
    }

    /// Makes a tile one step larger (`more`) or smaller within the innermost row (`wide`) or column that contains it.
    /// Returns whether there is one.
    pub fn resize(&mut self, tile: Tile, wide: bool, more: bool) -> bool {
        if self.children_mut().into_iter().any(|child| child.resize(tile, wide, more)) {
            return true;
        }
        let ((Self::Row(list), true) | (Self::Column(list), false)) = (self, wide) else { return false };
        let Some((share, _)) = list.iter_mut().find(|(_, child)| child.tiles().contains(&tile)) else { return false };
        *share = (*share * if more { STEP } else { 1.0 / STEP }).clamp(0.05, 20.0);
        true
    }

    /// Returns the layout as a tree that egui_tiles can draw.
    pub fn tree(&self) -> Tree<Tile> {
        let mut tiles = Tiles::default();
        let root = self.plant(&mut tiles);
        Tree::new(egui::Id::unique("bench"), root, tiles)
    }

    fn plant(&self, tiles: &mut Tiles<Tile>) -> TileId {
        match self {
            Self::Tile(tile) => tiles.insert_pane(*tile),
            Self::Tabs { front, tabs } => {
                let children: Vec<TileId> = tabs.iter().map(|tab| tab.plant(tiles)).collect();
                let active = children.get(*front).or(children.first()).copied();
                tiles.insert_container(Tabs { children, active })
            }
            Self::Row(list) => Self::plant_line(LinearDir::Horizontal, list, tiles),
            Self::Column(list) => Self::plant_line(LinearDir::Vertical, list, tiles),
        }
    }

    fn plant_line(dir: LinearDir, list: &[(f32, Self)], tiles: &mut Tiles<Tile>) -> TileId {
        let children: Vec<TileId> = list.iter().map(|(_, child)| child.plant(tiles)).collect();
        let mut line = Linear::new(dir, children.clone());
        for (child, (share, _)) in children.into_iter().zip(list) {
            line.shares.set_share(child, *share);
        }
        tiles.insert_container(line)
    }

    /// Creates the layout from a tree of egui_tiles; `None` if the tree is empty.
    pub fn of(tree: &Tree<Tile>) -> Option<Self> {
        Self::harvest(tree, tree.root()?)
    }

    /// Returns the layout of a node of a tree of egui_tiles and everything below it.
    fn harvest(tree: &Tree<Tile>, id: TileId) -> Option<Self> {
        let children = |ids: &[TileId]| -> Vec<(TileId, Self)> {
            ids.iter().filter_map(|id| Some((*id, Self::harvest(tree, *id)?))).collect()
        };
        Some(match tree.tiles.get(id)? {
            egui_tiles::Tile::Pane(tile) => Self::Tile(*tile),
            egui_tiles::Tile::Container(Container::Tabs(tabs)) => {
                let list = children(&tabs.children);
                let front = list.iter().position(|(id, _)| Some(*id) == tabs.active).unwrap_or(0);
                Self::Tabs { front, tabs: list.into_iter().map(|(_, tab)| tab).collect() }
            }
            egui_tiles::Tile::Container(Container::Linear(line)) => {
                let list = children(&line.children).into_iter();
                let list = list.map(|(id, child)| (line.shares[id].clamp(1e-3, 1e3), child)).collect();
                match line.dir {
                    LinearDir::Horizontal => Self::Row(list),
                    LinearDir::Vertical => Self::Column(list),
                }
            }
            // None is ever made here.
            egui_tiles::Tile::Container(Container::Grid(grid)) => {
                let ids: Vec<TileId> = grid.children().copied().collect();
                Self::Row(children(&ids).into_iter().map(|(_, child)| (1.0, child)).collect())
            }
        })
    }
}

#[cfg(test)]
mod tests;

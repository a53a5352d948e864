//! Input of the room tile, requests of its user, and the mapping between room and screen.

use crate::app::paint::tile::Status;
use crate::app::scene::room_look::{RoomLook, RoomView};
use crate::compute::direction::Surface;
use crate::compute::sky::GroundShade;
use crate::drawing::ticks::{number, si};
use crate::study::SurfaceLight;
use crate::study::scene_file::BoxKeys;
use crate::texts::Text;
use egui::{Pos2, Rect, pos2, vec2};

/// Result at one sensor point, in the unit of [`Input::quantity`]: illuminance \[lx\] or daylight factor \[%\].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CellValue {
    /// Sum of direct and interreflected component.
    pub total: f64,
    /// Estimated absolute error of `total`.
    pub error: f64,
    /// Direct component, i.e. light from the apertures without interreflection.
    pub direct: f64,
    /// Component interreflected in the room.
    pub inter: f64,
    /// Part of `direct` that is due to undeviated or specularly redirected beams of the sun.
    pub beam: f64,
    /// Part of `error` that is due to the uncertainty of the scattering data.
    pub data_error: f64,
}

/// Aperture as a rectangle in its surface of the room.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opening {
    /// Surface in which the aperture lies: façade or roof.
    pub surface: Surface,
    /// Lower-left corner: (x, z) on the façade, (x, y) on the roof. \[m\]
    pub origin: [f64; 2],
    /// Size along the same axes as `origin`. \[m\]
    pub size: [f64; 2],
}

/// Quantity shown at the sensor points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Quantity {
    /// Illuminance. \[lx\]
    #[default]
    Illuminance,
    /// Daylight factor: illuminance as a share of the horizontal illuminance outside under the unobstructed overcast
    /// sky. \[%\]
    DaylightFactor,
}

impl Quantity {
    /// Returns the unit of the quantity.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Illuminance => "lx",
            Self::DaylightFactor => "%",
        }
    }

    /// Returns the symbol of the quantity in plots.
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Illuminance => "E",
            Self::DaylightFactor => "D",
        }
    }

    /// Returns a value of the quantity with its unit as text.
    pub fn format(self, value: f64) -> String {
        match self {
            Self::Illuminance => si(value, "lx"),
            Self::DaylightFactor => format!("{} %", number(value, 3)),
        }
    }
}

/// Input of the room tile in one frame.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Size of the room: width (x), depth (y), height (z). \[m\]
    pub room: [f64; 3],
    /// Apertures of the room: windows in the façade, rooflights in the roof.
    pub apertures: &'a [Opening],
    /// Boxes of the obstructions outside, each with its name.
    pub outside: &'a [(BoxKeys, String)],
    /// Ground outside with the shadows on it; `None` if it is not drawn, e.g. for a room on the ground without
    /// obstructions.
    pub ground: Option<&'a GroundShade>,
    /// Number of sensor points of the sensor plane along x.
    pub nx: usize,
    /// Number of sensor points of the sensor plane along y.
    pub ny: usize,
    /// Results at the points of the sensor plane, i.e. at the centres of its nx × ny cells with x varying fastest, or
    /// at the listed points; empty before the first result.
    pub cells: &'a [CellValue],
    /// Listed sensor points in room coordinates; empty if there is a sensor plane. \[m\]
    pub points: &'a [[f64; 3]],
    /// Height of the sensor plane above the floor; `None` if there is none. \[m\]
    pub plane_z: Option<f64>,
    /// Quantity of `cells`.
    pub quantity: Quantity,
    /// Reason why no daylight factor is defined for the sky; `None` if it is.
    pub no_factor: Option<Text>,
    /// Display settings of the room tile.
    pub look: RoomLook,
    /// Illuminances on the surfaces of the room for the perspective, with their revision number; `None` before the
    /// first result.
    pub surfaces: Option<(&'a SurfaceLight, u64)>,
    /// Product, date and time as text.
    pub name: &'a str,
    /// Lowest and highest value of the scale, in the unit of `cells`, if the comparison sets it.
    pub range: Option<[f64; 2]>,
    /// Revision number of `cells`, which changes whenever the results do.
    pub revision: u64,
    /// Status of the results shown: preliminary, outdated or complete.
    pub status: Status<'a>,
}

impl Input<'_> {
    /// Creates the input for a room of size zero without results.
    pub const fn nothing() -> Self {
        Self {
            room: [0.0; 3],
            apertures: &[],
            outside: &[],
            ground: None,
            nx: 0,
            ny: 0,
            cells: &[],
            points: &[],
            plane_z: None,
            quantity: Quantity::Illuminance,
            no_factor: None,
            look: RoomLook { view: RoomView::Plan, daylight_factor: false, as_seen: false },
            surfaces: None,
            name: "",
            range: None,
            revision: 0,
            status: Status { coarse: false, stale: false, idle: false, hold_scale: false, doing: None, error: None },
        }
    }

    /// Whether there is a result for every point of the sensor plane.
    pub const fn complete(&self) -> bool {
        self.nx > 0 && self.ny > 0 && self.cells.len() == self.nx * self.ny
    }

    /// Returns the position of a sensor point, by its index, in room coordinates. \[m\]
    pub fn position(&self, sensor: usize) -> [f64; 3] {
        if let Some(point) = self.points.get(sensor) {
            return *point;
        }
        let (nx, ny) = (self.nx.max(1), self.ny.max(1));
        let at = |k: usize, n: usize, length: f64| (k as f64 + 0.5) / n as f64 * length;
        [at(sensor % nx, nx, self.room[0]), at(sensor / nx, ny, self.room[1]), self.plane_z.unwrap_or(0.0)]
    }
}

/// Request of the user of the room tile. Indices are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// New height of the sensor plane. \[m\]
    PlaneMoved(f64),
    /// New position and size of an aperture, by its index.
    OpeningMoved(usize, Opening),
    /// New position of a listed sensor point, by its index, in room coordinates \[m\].
    PointMoved(usize, [f64; 3]),
    /// New position and size of an obstruction's box, by its index.
    BoxMoved(usize, BoxKeys),
    /// Removal of an obstruction, by its index.
    BoxGone(usize),
    /// New display settings of the room tile.
    Look(RoomLook),
}

/// Extent of a picture in the room's axes: lowest and highest coordinate along the depth (y), and along the axis across
/// it (x in the plan, z in the section). \[m\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span(pub [[f64; 2]; 2]);

impl Span {
    /// Returns the extent of the room alone, given its size \[m\]. `side`: whether it is seen from the side.
    pub const fn of(room: [f64; 3], side: bool) -> Self {
        Self([[0.0, room[1]], [0.0, if side { room[2] } else { room[0] }]])
    }
}

/// Mapping between room and screen, with the façade at the left: from above with x downwards (plan), or from the side
/// with z upwards (section).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Rectangle of the room on the screen.
    pub area: Rect,
    /// Rectangle of the whole picture on the screen: the room and its surroundings.
    pub view: Rect,
    /// Scale of the picture. \[points/m\]
    pub scale: f32,
    /// Whether the room is seen from the side (section) instead of from above (plan).
    pub side: bool,
}

impl Frame {
    /// Creates the largest mapping by which the extent `span` fits into a rectangle, aligned to its left. `room`: size
    /// \[m\].
    pub fn around(rect: Rect, span: Span, room: [f64; 3], side: bool) -> Self {
        let lengths = |span: Span| span.0.map(|[low, high]| (high - low).max(1e-3) as f32);
        let [depth, across] = lengths(span);
        let scale = (rect.width() / depth).min(rect.height() / across).max(1e-3);
        let size = vec2(depth, across) * scale;
        let view = Rect::from_min_size(pos2(rect.left(), rect.center().y - 0.5 * size.y), size);
        let [[before, _], [low, high]] = span.0;
        let [own_depth, own_across] = lengths(Span::of(room, side));
        // From above, x runs down; from the side, z runs up.
        let over = if side { high - f64::from(own_across) } else { -low };
        let corner = view.min + vec2(-before as f32, over as f32) * scale;
        Self { area: Rect::from_min_size(corner, vec2(own_depth, own_across) * scale), view, scale, side }
    }

    /// Returns the screen position of a depth y and a coordinate across it: x in the plan, z in the section. \[m\]
    pub fn screen(&self, depth: f64, across: f64) -> Pos2 {
        let across = across as f32 * self.scale;
        let y = if self.side { self.area.bottom() - across } else { self.area.top() + across };
        pos2(self.area.left() + depth as f32 * self.scale, y)
    }

    /// Returns the depth y of a screen position and the coordinate across it: x in the plan, z in the section. \[m\]
    pub fn room(&self, at: Pos2) -> (f64, f64) {
        let depth = (at.x - self.area.left()) / self.scale;
        let across = if self.side { self.area.bottom() - at.y } else { at.y - self.area.top() };
        (f64::from(depth), f64::from(across / self.scale))
    }

    /// Returns the rectangle of an aperture on the screen, which has no width if the aperture is seen edge-on. `room`:
    /// size \[m\].
    pub fn opening(&self, opening: &Opening, room: [f64; 3]) -> Rect {
        let ([o, s], side) = ([opening.origin, opening.size], self.side);
        let [depth, across] = match (opening.surface, side) {
            (Surface::Facade, false) => [[0.0, 0.0], [o[0], o[0] + s[0]]],
            (Surface::Facade, true) => [[0.0, 0.0], [o[1], o[1] + s[1]]],
            (Surface::Roof, false) => [[o[1], o[1] + s[1]], [o[0], o[0] + s[0]]],
            (Surface::Roof, true) => [[o[1], o[1] + s[1]], [room[2], room[2]]],
        };
        Rect::from_two_pos(self.screen(depth[0], across[0]), self.screen(depth[1], across[1]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn screen_and_room_are_inverse() {
        let rect = Rect::from_min_size(pos2(50.0, 10.0), vec2(300.0, 150.0));
        for side in [false, true] {
            let frame = Frame::around(rect, Span::of([4.0, 6.0, 3.0], side), [4.0, 6.0, 3.0], side);
            let (depth, across) = frame.room(frame.screen(4.5, 1.25));
            assert!((across - 1.25).abs() < 1e-4 && (depth - 4.5).abs() < 1e-4);
            assert!(rect.expand(0.01).contains_rect(frame.area));
            // Seen from above with the depth to the right, x runs down; from the side, z runs up.
            assert_eq!(frame.screen(0.0, 1.0).y > frame.screen(0.0, 0.0).y, !side);
        }
    }

    #[test]
    fn openings_are_lines_where_they_are_seen_edge_on() {
        let room = [4.0, 6.0, 3.0];
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(600.0, 400.0));
        let [plan, side] = [false, true].map(|side| Frame::around(rect, Span::of(room, side), room, side));
        let window = Opening { surface: Surface::Facade, origin: [0.5, 0.9], size: [3.0, 1.8] };
        let place = side.opening(&window, room);
        assert!(place.width() == 0.0 && (place.height() - 1.8 * side.scale).abs() < 1e-3);
        assert!((side.area.bottom() - place.bottom() - 0.9 * side.scale).abs() < 1e-3);
        let light = Opening { surface: Surface::Roof, origin: [1.0, 2.0], size: [1.0, 2.5] };
        let place = plan.opening(&light, room);
        assert!((place.width() - 2.5 * plan.scale).abs() < 1e-3 && (place.height() - plan.scale).abs() < 1e-3);
        assert_eq!(side.opening(&light, room).height(), 0.0);
    }
}

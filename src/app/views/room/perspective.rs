//! The room in perspective, which can be rotated: its surfaces coloured by illuminance or luminance, apertures, sensor
//! points, obstructions, a person to scale.
//!
//! The room is a box seen into: walls whose outside faces the camera are left out. The remaining ones do not hide each
//! other, so the only order of drawing required is that of things after walls.

use super::ground;
use super::input::Input;
use super::lit::{self, Piece};
use super::outside;
use crate::app::paint::camera::{Camera, View, words};
use crate::app::paint::colour_scale::{ColourScale, ColourScaleExt as _, LEGEND_HEIGHT};
use crate::app::paint::palette::{ColourMap, Palette};
use crate::app::paint::tile::{self, Foot};
use crate::app::views::Cache;
use crate::compute::direction::Surface;
use crate::drawing::ticks::{number, si};
use crate::study::SurfaceLight;
use crate::texts::{Text, fixed, tiles as say};
use egui::{Color32, Mesh, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// First camera: from outside, above one side of the façade, into the room.
const FIRST: Camera = Camera::from(-0.75, 0.5);
/// Height of the person drawn for scale. \[m\]
const PERSON: f64 = 1.7;
/// Fraction of the largest displayable luminance to which the logarithmic mean of the luminances is mapped (key of
/// Reinhard et al. 2002).
const KEY: f64 = 0.28;
/// Names of the surfaces of the room, in the order of their indices.
const WALLS: [Text; 6] =
    [say::WALL_FLOOR, say::WALL_CEILING, say::WALL_NEAR_X, say::WALL_FAR_X, say::FACADE, say::WALL_REAR];

/// Colours of the four corners of a piece of a surface.
type Corners = [Color32; 4];

/// Camera and caches of the perspective between frames.
#[derive(Debug, Clone)]
pub struct State {
    camera: Camera,
    pieces: Cache<u64, Arc<Vec<Piece>>>,
    colours: Cache<(u64, Option<ColourScale>), Arc<Vec<Corners>>>,
    scale: Option<ColourScale>,
}

impl Default for State {
    fn default() -> Self {
        Self { camera: FIRST, pieces: Cache::default(), colours: Cache::default(), scale: None }
    }
}

/// Returns the colour scale of the illuminances on the room's surfaces \[lx\], up to the largest one without the sun's
/// beams; sun patches, about a hundred times brighter, lie beyond it.
fn scale_of(light: &SurfaceLight, log: bool) -> ColourScale {
    let bare = light.patches.iter().filter(|one| one.patch.aperture.is_none());
    let max = bare.map(|one| one.diffuse.value).fold(1.0, f64::max);
    ColourScale::up_to(max, log, 2, ColourMap::Sequential)
}

/// Returns the colours of the corners of all pieces: by illuminance on a scale or, for `None`, as grey tones of their
/// luminances, mapped to the display in the manner of a photograph.
fn colours(pieces: &[Piece], scale: Option<&ColourScale>) -> Vec<[Color32; 4]> {
    if let Some(scale) = scale {
        return pieces.iter().map(|piece| piece.illuminance.map(|e| scale.colour(e))).collect();
    }
    let luminance = |piece: &Piece| piece.illuminance.map(|e| piece.reflectance * e / PI);
    // Mean of the logarithm, by area: a small sun patch does not darken the room.
    let (mut sum, mut all) = (0.0, 0.0);
    for piece in pieces {
        let size = (piece.corners[1] - piece.corners[0]).cross(piece.corners[3] - piece.corners[0]).length();
        sum += size * (1e-3 + luminance(piece)[0]).ln();
        all += size;
    }
    let mean = if all > 0.0 { (sum / all).exp() } else { 1.0 };
    let seen = |l: f64| {
        let scaled = KEY * l / mean;
        let shown = (scaled * (1.0 + scaled / 16.0) / (1.0 + scaled)).clamp(0.0, 1.0);
        Color32::from_gray((255.0 * shown.powf(1.0 / 2.2)).round() as u8)
    };
    pieces.iter().map(|piece| luminance(piece).map(seen)).collect()
}

/// Draws a line between two points in room coordinates \[m\], if both lie in front of the camera.
fn line(painter: &Painter, view: &View, ends: [DVec3; 2], stroke: Stroke) {
    if let [Some((a, _)), Some((b, _))] = ends.map(|end| view.screen(end)) {
        painter.line_segment([a, b], stroke);
    }
}

/// Returns the six surfaces of a room of a size \[m\], each as a point and the normal into the room, in the order of
/// [`WALLS`].
fn sides(size: DVec3) -> [(DVec3, DVec3); 6] {
    [
        (DVec3::ZERO, DVec3::Z),
        (size, -DVec3::Z),
        (DVec3::ZERO, DVec3::X),
        (size, -DVec3::X),
        (DVec3::ZERO, DVec3::Y),
        (size, -DVec3::Y),
    ]
}

/// Returns the index of the visible surface of the room at a screen position, and the point on it in room coordinates
/// \[m\]; `None` beside the room.
fn hit(view: &View, size: DVec3, at: Pos2) -> Option<(usize, DVec3)> {
    let ray = view.ray(at);
    sides(size).into_iter().enumerate().find_map(|(wall, (point, normal))| {
        let towards = ray.dot(normal);
        if towards >= 0.0 || !view.faces(point, normal) {
            return None;
        }
        let place = view.eye + ray * ((point - view.eye).dot(normal) / towards);
        let inside = (0..3).all(|k| (-1e-6..=size[k] + 1e-6).contains(&place[k]));
        inside.then_some((wall, place))
    })
}

/// Returns a mesh of the pieces of the visible surfaces.
fn mesh(view: &View, size: DVec3, pieces: &[Piece], colours: &[[Color32; 4]]) -> Mesh {
    let seen = sides(size).map(|(point, normal)| view.faces(point, normal));
    let mut mesh = Mesh::default();
    for (piece, colours) in pieces.iter().zip(colours).filter(|(piece, _)| seen[piece.wall]) {
        let places = piece.corners.map(|corner| view.screen(corner));
        let [Some((a, _)), Some((b, _)), Some((c, _)), Some((d, _))] = places else { continue };
        let first = mesh.vertices.len() as u32;
        for (at, colour) in [a, b, c, d].into_iter().zip(colours) {
            mesh.colored_vertex(at, *colour);
        }
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first, first + 2, first + 3);
    }
    mesh
}

/// Draws the edges of the visible surfaces, with a mark every metre along the floor.
fn edges(painter: &Painter, view: &View, size: DVec3, palette: &Palette) {
    let seen = sides(size).map(|(point, normal)| view.faces(point, normal));
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for (high_u, high_v) in [(false, false), (true, false), (true, true), (false, true)] {
            // Walls by axis and side, as `WALLS` counts them.
            let wall = |k: usize, high: bool| [2, 4, 0][k] + usize::from(high);
            if !seen[wall(u, high_u)] && !seen[wall(v, high_v)] {
                continue;
            }
            let mut from = DVec3::ZERO;
            from[u] = if high_u { size[u] } else { 0.0 };
            from[v] = if high_v { size[v] } else { 0.0 };
            let mut to = from;
            to[axis] = size[axis];
            line(painter, view, [from, to], Stroke::new(1.0, palette.outline));
        }
    }
    for (axis, other) in [(0, 1), (1, 0)] {
        // Along the edge of the floor that is nearer to the viewpoint.
        let mut at = DVec3::ZERO;
        at[other] = if view.eye[other] > 0.5 * size[other] { size[other] } else { 0.0 };
        let outward = if at[other] > 0.0 { 0.12 } else { -0.12 };
        let last = size[axis].floor() as usize;
        for metre in 0..=last {
            at[axis] = metre as f64;
            let mut end = at;
            end[other] += outward;
            line(painter, view, [at, end], Stroke::new(1.5, palette.weak));
            let mut beyond = at;
            beyond[other] += 3.0 * outward;
            if metre == last
                && let Some((place, _)) = view.screen(beyond)
            {
                words(
                    painter,
                    painter.clip_rect(),
                    place + vec2(0.0, 8.0),
                    &format!("{metre} m"),
                    [palette.ink, Color32::TRANSPARENT],
                );
            }
        }
    }
}

/// Draws the apertures with frames, filled with a bright colour if their side to the room is visible.
fn openings(painter: &Painter, view: &View, input: &Input<'_>, palette: &Palette) {
    for opening in input.apertures {
        let ([a, b], [w, h]) = (opening.origin, opening.size);
        let point = |a: f64, b: f64| match opening.surface {
            Surface::Facade => DVec3::new(a, 0.0, b),
            Surface::Roof => DVec3::new(a, b, input.room[2]),
        };
        let corners = [point(a, b), point(a + w, b), point(a + w, b + h), point(a, b + h)];
        let normal = if opening.surface == Surface::Facade { DVec3::Y } else { -DVec3::Z };
        let places: Vec<Pos2> = corners.iter().filter_map(|corner| Some(view.screen(*corner)?.0)).collect();
        if places.len() < 4 {
            continue;
        }
        if view.faces(corners[0], normal) {
            painter.add(Shape::convex_polygon(
                places,
                palette.sun.gamma_multiply(0.55),
                Stroke::new(2.5, palette.first),
            ));
        } else {
            painter.add(Shape::closed_line(places, Stroke::new(1.5, palette.first)));
        }
    }
}

/// Draws the edges of the obstructions near the room.
fn around(painter: &Painter, view: &View, input: &Input<'_>, palette: &Palette) {
    for ends in outside::near(input).flat_map(|solid| solid.visible_edges(view.eye)) {
        line(painter, view, ends, Stroke::new(1.5, palette.weak));
    }
}

/// Draws the sensor plane as an outline, and listed sensor points as dots.
fn sensors(painter: &Painter, view: &View, input: &Input<'_>, palette: &Palette) {
    let [w, d, _] = input.room;
    if let Some(z) = input.plane_z {
        let corners = [[0.0, 0.0], [w, 0.0], [w, d], [0.0, d], [0.0, 0.0]].map(|[x, y]| DVec3::new(x, y, z));
        let places: Vec<Pos2> = corners.iter().filter_map(|corner| Some(view.screen(*corner)?.0)).collect();
        painter.extend(Shape::dashed_line(&places, Stroke::new(1.5, palette.second), 6.0, 4.0));
    }
    for point in input.points {
        if let Some((at, _)) = view.screen(DVec3::from_array(*point)) {
            painter.circle(at, 4.0, palette.second, Stroke::new(1.0, palette.face));
        }
    }
}

/// Draws a person to scale, facing the camera, at a position in the room where it hides little.
fn person(painter: &Painter, view: &View, room: [f64; 3], palette: &Palette) {
    if room[2] < PERSON + 0.05 || room[0] < 1.0 || room[1] < 1.0 {
        return;
    }
    let feet = DVec3::new(0.78 * room[0], 0.55 * room[1], 0.0);
    let side = DVec3::new(view.right.x, view.right.y, 0.0).normalize_or_zero();
    let at = |x: f64, z: f64| view.screen(feet + x * side + DVec3::new(0.0, 0.0, z)).map(|(place, _)| place);
    // Half widths by height: ankles, knees, hips, waist, shoulders, neck.
    let half = [(0.0, 0.09), (0.45, 0.12), (0.85, 0.17), (1.05, 0.14), (1.38, 0.22), (1.44, 0.07), (1.5, 0.06)];
    let (left, right): (Vec<_>, Vec<_>) = half.iter().map(|&(z, x)| (at(-x, z), at(x, z))).unzip();
    let (Some(left), Some(right)) =
        (left.into_iter().collect::<Option<Vec<_>>>(), right.into_iter().collect::<Option<Vec<_>>>())
    else {
        return;
    };
    // Orange is in neither the colours of the scale nor the greys.
    let colour = palette.second;
    let mut mesh = Mesh::default();
    for (l, r) in left.iter().zip(&right) {
        mesh.colored_vertex(*l, colour);
        mesh.colored_vertex(*r, colour);
    }
    for k in 0..half.len() as u32 - 1 {
        mesh.add_triangle(2 * k, 2 * k + 1, 2 * k + 2);
        mesh.add_triangle(2 * k + 1, 2 * k + 2, 2 * k + 3);
    }
    painter.add(Shape::mesh(mesh));
    if let (Some(head), Some(top)) = (at(0.0, PERSON - 0.12), at(0.0, PERSON)) {
        painter.circle_filled(head, head.distance(top), colour);
        words(
            painter,
            painter.clip_rect(),
            top - vec2(0.0, 2.0),
            &format!("{} m", fixed(PERSON, 2)),
            [Color32::WHITE, Color32::from_black_alpha(170)],
        );
    }
}

/// Returns the illuminance with its error, and the luminance, at a point of a surface (index `wall`; `place` in room
/// coordinates \[m\]) as text.
fn value(light: &SurfaceLight, wall: usize, place: DVec3) -> Foot {
    let Some((patch, diffuse, beam)) = lit::at(light, wall, place) else { return Foot::default() };
    if patch.patch.aperture.is_some() {
        return Foot::from(say::window_inner(si(diffuse, "lx")));
    }
    let total = diffuse + beam;
    let relative = if patch.diffuse.value > 0.0 { patch.diffuse.error / patch.diffuse.value } else { 0.0 };
    let error = if relative > 0.0 { format!(" ± {}", number(diffuse * relative, 2)) } else { String::new() };
    let sun = if beam > 0.0 { say::sun_beam(si(beam, "lx")) } else { String::new() };
    let name = WALLS[wall];
    let luminance = si(patch.patch.reflectance * total / PI, "cd/m²");
    let [x, y, z] = place.to_array().map(|way| fixed(way, 2));
    let where_ = format!("x {x}, y {y}, z {z} m");
    Foot::from([
        format!("{name}: {}{error} lx{sun} · {luminance} · {where_}", number(total, 4)),
        format!("{name}: {}{error} lx{sun} · {luminance}", number(total, 4)),
        format!("{name}: {}", si(total, "lx")),
    ])
}

/// Returns a line with the luminous flux into the room and the mean illuminances of floor, ceiling and rear wall.
fn summary(light: &SurfaceLight) -> Foot {
    let mean = |wall: usize| {
        let own = light.patches.iter().filter(|one| one.patch.wall == wall && one.patch.aperture.is_none());
        let (flux, area) = own
            .fold((0.0, 0.0), |(flux, area), one| (flux + one.patch.area * one.total().value, area + one.patch.area));
        if area > 0.0 { flux / area } else { 0.0 }
    };
    let [floor, ceiling, rear] = [0, 1, 5].map(|wall| si(mean(wall), "lx"));
    let flux = si(light.flux.value, "lm");
    Foot::from([
        say::surfaces_summary(&flux, &floor, &ceiling, rear),
        say::surfaces_summary_short(flux, &floor, ceiling),
        say::floor_mean(floor),
    ])
}

/// Draws the perspective. Returns the line with the value under the pointer, or a summary.
pub(super) fn show(ui: &mut Ui, rect: Rect, input: &Input<'_>, (log, hold): (bool, bool), state: &mut State) -> Foot {
    let palette = Palette::of(ui.visuals());
    let legend_height = if input.look.as_seen { 0.0 } else { LEGEND_HEIGHT };
    let area = rect.with_max_y((rect.bottom() - legend_height).max(rect.top() + 40.0));
    let response = ui.interact(area, ui.scope_id().with("perspective"), Sense::click_and_drag());
    if response.clicked() {
        response.request_focus();
    }
    if state.camera.obey(ui, &response, FIRST) {
        ui.ctx().request_repaint();
    }
    let size = DVec3::from_array(input.room);
    let view = state.camera.view(0.5 * size, 0.5 * size.length().max(1e-3), area);
    let painter = ui.painter_at(area);
    ground::perspective(&painter, &view, input, &palette);
    let mut foot = Foot::from(say::SURFACES_COMING);
    let mut pointed = None;
    if let Some((light, revision)) = input.surfaces {
        let held = state.scale.take().filter(|held| (input.status.hold_scale || hold) && held.log == log);
        let scale = held.unwrap_or_else(|| scale_of(light, log));
        state.scale = Some(scale.clone());
        let by = (!input.look.as_seen).then_some(scale.clone());
        let pieces = state.pieces.get(revision, || Arc::new(lit::pieces(light))).clone();
        let colours = state.colours.get((revision, by.clone()), || Arc::new(colours(&pieces, by.as_ref())));
        painter.add(Shape::mesh(mesh(&view, size, &pieces, colours)));
        foot = summary(light);
        if let Some(at) = response.hover_pos().filter(|_| !response.dragged())
            && let Some((wall, place)) = hit(&view, size, at)
        {
            pointed = lit::at(light, wall, place).map(|(_, diffuse, beam)| diffuse + beam);
            foot = value(light, wall, place);
        }
        if !input.look.as_seen {
            let legend = Rect::from_min_max(pos2(rect.left(), rect.bottom() - LEGEND_HEIGHT + 2.0), rect.max);
            scale.paint_legend(ui.painter(), legend, "lx", pointed, &palette);
        }
        let parts: Vec<String> =
            [summary(light).full().to_owned()].into_iter().chain(ground::words_of_middle(input)).collect();
        tile::name(ui, &response, say::ROOM_PERSPECTIVE, &parts.join(" · "));
    } else {
        tile::name(ui, &response, say::ROOM_PERSPECTIVE, say::BEING_COMPUTED.get());
    }
    openings(&painter, &view, input, &palette);
    edges(&painter, &view, size, &palette);
    around(&painter, &view, input, &palette);
    sensors(&painter, &view, input, &palette);
    person(&painter, &view, input.room, &palette);
    foot
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::vec2;

    #[test]
    fn the_first_view_shows_floor_and_far_walls_and_rays_find_them() {
        let size = DVec3::new(4.0, 6.0, 3.0);
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(500.0, 400.0));
        let view = FIRST.view(0.5 * size, 0.5 * size.length(), rect);
        let seen: Vec<&str> = sides(size)
            .into_iter()
            .zip(WALLS)
            .filter(|((point, normal), _)| view.faces(*point, *normal))
            .map(|(_, name)| name.english())
            .collect();
        assert_eq!(seen, ["floor", "wall at x = 0", "rear wall"]);
        let place = DVec3::new(1.0, 2.0, 0.0);
        let (wall, found) = hit(&view, size, view.screen(place).unwrap().0).unwrap();
        assert!(wall == 0 && found.distance(place) < 1e-3, "{wall} {found}");
        assert!(hit(&view, size, pos2(2.0, 2.0)).is_none());
    }

    #[test]
    fn as_seen_is_brighter_where_more_light_is_reflected() {
        let piece = |e: f64, reflectance| Piece {
            wall: 0,
            corners: [DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y],
            illuminance: [e; 4],
            reflectance,
        };
        let shown = colours(&[piece(100.0, 0.2), piece(100.0, 0.7), piece(300.0, 0.7), piece(30_000.0, 0.2)], None);
        let greys: Vec<u8> = shown.iter().map(|corners| corners[0].r()).collect();
        assert!(greys.is_sorted() && greys[0] < greys[1] && greys[3] > greys[2], "{greys:?}");
        let scale = ColourScale::up_to(300.0, false, 2, ColourMap::Sequential);
        let by = colours(&[piece(100.0, 0.2), piece(100.0, 0.7)], Some(&scale));
        assert_eq!(by[0], by[1], "illuminance knows no reflectance");
    }
}

//! The map of interpolation schemes on the incident side: the triangles between the incident directions of the data,
//! coloured by the treatment of lobes (peaks of scattered light) in the interpolation within each triangle, and the
//! reason for it.

use super::input::{Input, SchemesInput};
use crate::app::paint::hemisphere::{Disk, Projection, Side};
use crate::app::paint::palette::{ColourMap, ColourMapExt as _, Palette};
use crate::app::paint::tile::Foot;
use crate::app::results::data_looks::NoSchemes;
use crate::compute::direction::Dir;
use crate::compute::incidence::schemes::SunScheme;
use crate::compute::incidence::ways::{Triangle, Way};
use crate::drawing::ticks::{degrees, number};
use crate::texts::{Text, tiles as say};
use egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Stroke, StrokeKind, Ui, pos2, vec2};
use glam::DVec3;

/// Number of straight parts by which an edge of a triangle, an arc of a great circle, is drawn.
const PARTS: usize = 4;
/// Fraction of a triangle's area that is drawn, so that the background is visible as a line between triangles.
const DRAWN: f64 = 0.94;
/// Height of a line of the map's legend. \[points\]
const LINE: f32 = 16.0;

/// Returns the label of a treatment of the lobes within a triangle of incident directions: moved (all lobes occur at
/// all three corners, and move between them), faded (a lobe that is missing at a corner fades towards it), blended (no
/// corner has a lobe, so the smooth indicatrices are averaged), or dark (no light is transmitted at any corner).
const fn word(way: Way) -> Text {
    match way {
        Way::Moved => say::WAY_MOVED,
        Way::Faded => say::WAY_FADED,
        Way::Blended => say::WAY_BLENDED,
        Way::Dark => say::WAY_DARK,
    }
}

/// Returns the colour by which the map shows a treatment of the lobes within a triangle; see [`word`] for the
/// treatments.
fn colour(way: Way) -> Color32 {
    match way {
        Way::Moved => ColourMap::Sequential.at(0.35),
        Way::Faded => ColourMap::Sequential.at(0.92),
        Way::Blended => ColourMap::Sequential.at(0.68),
        Way::Dark => Color32::from_gray(70),
    }
}

impl<'a> SchemesInput<'a> {
    /// Returns the triangles of the map; `None` until they are computed, or if there are none.
    pub(super) fn triangles(&self) -> Option<&'a [Triangle]> {
        self.result?.made.as_deref().ok()
    }

    /// Returns the interpolation scheme for direct sun that the scene requests and the map was computed for.
    fn asked(&self) -> SunScheme {
        self.result.map_or(SunScheme::default(), |result| result.key.1)
    }

    /// Returns the reason why there is no map, as text.
    fn missing(&self) -> String {
        if let Some(error) = self.error {
            return error.to_owned();
        }
        match self.result.map(|result| &result.made) {
            Some(Err(NoSchemes::NoDirections)) => say::NO_SCHEMES_DIRECTIONS.into(),
            Some(Err(NoSchemes::ClosedForm)) => say::NO_SCHEMES_CLOSED.into(),
            Some(Err(NoSchemes::Patches)) => say::NO_SCHEMES_PATCHES.into(),
            Some(Err(NoSchemes::NoTriangles)) => say::NO_SCHEMES_TRIANGLES.into(),
            _ => say::SCHEMES_COMING.into(),
        }
    }

    /// Returns a sentence on the interpolation in the triangle under the pointer at the screen position `at`, or the
    /// reason why there is no map. `None` if the pointer is in no triangle of the map.
    pub(super) fn reason_at(&self, at: Option<Pos2>, disk: &Disk, projection: Projection) -> Option<Foot> {
        let Some(list) = self.triangles() else { return Some(Foot::from(self.missing())) };
        let d = Side::Incident.direction_at(projection, disk.disk(at?))?;
        Some(self.why(list.iter().find(|one| holds(one, d.vector()))?))
    }

    /// Returns a sentence on the treatment of lobes in a triangle, with the figures that decide it and the stated
    /// uncertainty of the interpolation schemes there, i.e. the share of the flux that each sends in wrong directions.
    fn why(&self, one: &Triangle) -> Foot {
        let percent = |share: f64| number(100.0 * share, 2);
        let own = self.asked();
        let way = match one.way {
            _ if own != SunScheme::Responses => say::why_asked(own.key()),
            Way::Moved => say::why_moved(percent(one.in_lobes), degrees(one.travel)),
            Way::Faded => say::why_faded(percent(1.0 - one.followed), percent(one.in_lobes)),
            Way::Blended => say::WHY_BLENDED.into(),
            Way::Dark => return Foot::from([say::WHY_DARK.into(), say::WAY_DARK.into()]),
        };
        let of = |scheme: &SunScheme| format!("{} {} %", scheme.key(), percent(one.stated[*scheme as usize]));
        let others: Vec<String> = SunScheme::ALL.iter().filter(|scheme| **scheme != own).map(of).collect();
        let share = percent(one.stated[own as usize]);
        let (stated, alone) = (say::stated(&share, others.join(", ")), say::stated_alone(share));
        Foot::from([format!("{way} · {stated}"), format!("{way} · {alone}"), way, word(one.way).into()])
    }
}

/// Whether a direction, a unit vector, lies in a triangle whose edges are arcs of great circles.
fn holds(one: &Triangle, d: DVec3) -> bool {
    let [a, b, c] = one.corners;
    let sides = [a.cross(b).dot(d), b.cross(c).dot(d), c.cross(a).dot(d)];
    (sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)) && (a + b + c).dot(d) > 0.0
}

/// Returns a mesh of all triangles of the map on the disk, coloured by the treatment of lobes, or in one colour if the
/// scene requests a scheme without such treatment.
pub(super) fn mesh(disk: &Disk, projection: Projection, list: &[Triangle], input: &SchemesInput<'_>) -> Mesh {
    let mut mesh = Mesh::default();
    for one in list {
        let asked = input.asked() != SunScheme::Responses;
        let fill = colour(if asked && one.way != Way::Dark { Way::Moved } else { one.way });
        let middle = one.corners.iter().sum::<DVec3>() / 3.0;
        let [a, b, c] = one.corners.map(|corner| middle + DRAWN.sqrt() * (corner - middle));
        let first = mesh.vertices.len() as u32;
        for i in 0..=PARTS {
            for j in 0..=PARTS - i {
                let (s, t) = (i as f64 / PARTS as f64, j as f64 / PARTS as f64);
                let d = Dir::from_unit((a + s * (b - a) + t * (c - a)).normalize_or(DVec3::Z));
                mesh.colored_vertex(disk.screen(Side::Incident.disk(projection, d)), fill);
            }
        }
        // Row i has PARTS − i + 1 points.
        let at = |i: usize, j: usize| first + (i * (PARTS + 1) - i * i.saturating_sub(1) / 2 + j) as u32;
        for i in 0..PARTS {
            for j in 0..PARTS - i {
                mesh.add_triangle(at(i, j), at(i + 1, j), at(i, j + 1));
                if j + 1 < PARTS - i {
                    mesh.add_triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                }
            }
        }
    }
    mesh
}

/// Draws the legend of the map: colour and label of each treatment that occurs, in as many lines as necessary.
pub(super) fn legend(ui: &Ui, rect: Rect, align: Align2, input: &Input<'_>, palette: &Palette) {
    let Some(schemes) = &input.schemes else { return };
    let Some(list) = schemes.triangles() else { return };
    let asked = schemes.asked();
    let entries: Vec<(Way, String)> = if asked == SunScheme::Responses {
        let there = Way::ALL.into_iter().filter(|way| list.iter().any(|one| one.way == *way));
        there.map(|way| (way, word(way).into())).collect()
    } else {
        vec![(Way::Moved, asked.key().to_owned())]
    };
    let font = FontId::proportional(13.0);
    let bottom = align == Align2::LEFT_BOTTOM || align == Align2::RIGHT_BOTTOM;
    let galleys: Vec<_> = entries
        .into_iter()
        .map(|(way, text)| (way, ui.painter().layout_no_wrap(text, font.clone(), palette.ink)))
        .collect();
    // Lines that hold as many names as fit.
    let mut lines: Vec<Vec<(Way, std::sync::Arc<egui::Galley>)>> = vec![vec![]];
    let mut used = 0.0;
    for (way, galley) in galleys {
        let need = galley.size().x + 26.0;
        if used + need > rect.width() + 10.0 && used > 0.0 {
            lines.push(vec![]);
            used = 0.0;
        }
        used += need;
        if let Some(line) = lines.last_mut() {
            line.push((way, galley));
        }
    }
    let mut y = if bottom { rect.bottom() - LINE * lines.len() as f32 } else { rect.top() };
    for line in lines {
        let width: f32 = line.iter().map(|(_, galley)| galley.size().x + 26.0).sum::<f32>() - 10.0;
        let mut x = if align == Align2::RIGHT_TOP { rect.right() - width } else { rect.left() };
        for (way, galley) in line {
            let swatch = Rect::from_min_size(pos2(x, y + 0.5 * LINE - 5.0), vec2(10.0, 10.0));
            ui.painter().rect(swatch, 1, colour(way), Stroke::new(1.0, palette.outline), StrokeKind::Middle);
            let step = galley.size().x + 26.0;
            ui.painter().galley(pos2(x + 14.0, y + 0.5 * (LINE - galley.size().y)), galley, palette.ink);
            x += step;
        }
        y += LINE;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::results::data_looks::SchemesResult;
    use crate::compute::incidence::left_out::Errors;

    fn triangle(way: Way) -> Triangle {
        let corner =
            |theta: f64, phi: f64| Dir::<crate::compute::direction::Facade>::from_theta_phi(theta, phi).vector();
        Triangle {
            corners: [corner(0.3, 0.0), corner(0.5, 0.6), corner(0.3, 1.1)],
            way,
            lobes: [2, 2, 1],
            in_lobes: 0.62,
            followed: 0.75,
            travel: 0.2,
            stated: [0.021, 0.12, 0.034, 0.05] as Errors,
        }
    }

    #[test]
    fn a_triangle_tells_the_figures_that_decide_and_what_other_schemes_misplace() {
        let list = SchemesResult { key: (1, SunScheme::Responses, Default::default()), made: Ok(vec![]) };
        let input = SchemesInput { result: Some(&list), error: None, revision: 1 };
        let full = input.why(&triangle(Way::Faded));
        assert!(full.full().contains("25 % of the flux in lobes is missing at a corner"), "{}", full.full());
        assert!(full.full().contains("about 2.1 % here") && full.full().contains("nearest 12 %"), "{}", full.full());
        let asked = SchemesResult { key: (1, SunScheme::Nearest, Default::default()), made: Ok(vec![]) };
        let input = SchemesInput { result: Some(&asked), ..input };
        assert!(
            input.why(&triangle(Way::Moved)).full().contains("“nearest”, as set in the scene · misplaces about 12 %")
        );
    }

    #[test]
    fn the_triangle_under_the_pointer_is_the_one_drawn_there() {
        let disk = Disk { centre: pos2(100.0, 100.0), radius: 90.0 };
        let one = triangle(Way::Blended);
        let middle = Dir::from_unit(one.corners.iter().sum::<DVec3>().normalize());
        let at = disk.screen(Side::Incident.disk(Projection::default(), middle));
        let list = SchemesResult { key: (1, SunScheme::Responses, Default::default()), made: Ok(vec![one.clone()]) };
        let input = SchemesInput { result: Some(&list), error: None, revision: 1 };
        assert!(input.reason_at(Some(at), &disk, Projection::default()).is_some());
        assert!(input.reason_at(Some(pos2(100.0, 185.0)), &disk, Projection::default()).is_none());
        let drawn = mesh(&disk, Projection::default(), &[one], &input);
        assert_eq!(drawn.indices.len(), 3 * PARTS * PARTS);
        let covered = drawn.indices.chunks_exact(3).any(|t| {
            let [a, b, c] = [t[0], t[1], t[2]].map(|k| drawn.vertices[k as usize].pos);
            let side = |p: Pos2, q: Pos2| (q - p).x * (at - p).y - (q - p).y * (at - p).x;
            let sides = [side(a, b), side(b, c), side(c, a)];
            sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
        });
        assert!(covered);
    }
}

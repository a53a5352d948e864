//! A hemisphere of directions as a disk in the window: meshes of its cells, its frame, and the choice of cells by the
//! arrow keys. The projection of directions to points of the disk is that of [`crate::drawing::hemisphere`].

use super::palette::Palette;
use crate::compute::basis::{Cell, RingBasis};
use crate::drawing::hemisphere::arc_steps;
pub use crate::drawing::hemisphere::{Projection, Side, cell_outline, emergent_disk, incident_disk};
use crate::texts::tiles as say;
use egui::epaint::TextShape;
use egui::{Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Stroke, pos2};
use std::f64::consts::{FRAC_PI_2, PI};

/// Width by which a drawn cell extends under its neighbours \[points\]: larger than the gaps that chords and rounding
/// leave, and too small to be seen.
const OVERLAP: f32 = 0.6;

/// Position of the disk of a hemisphere on the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disk {
    /// Screen position of the centre of the disk.
    pub centre: Pos2,
    /// Radius of the rim (θ = 90°). \[points\]
    pub radius: f32,
}

impl Disk {
    /// Creates the largest disk within a rectangle that leaves room for the labels at the rim.
    pub fn within(rect: Rect) -> Self {
        Self { centre: rect.center(), radius: (0.5 * rect.width().min(rect.height()) - 17.0).max(8.0) }
    }

    /// Returns the screen position of a point of the disk, given in disk coordinates (right, up) with the rim at radius
    /// 1.
    pub fn screen(&self, [right, up]: [f64; 2]) -> Pos2 {
        self.centre + egui::vec2(right as f32, -up as f32) * self.radius
    }

    /// Returns the disk coordinates (right, up) of a screen position, with the rim at radius 1.
    pub fn disk(&self, at: Pos2) -> [f64; 2] {
        let d = (at - self.centre) / self.radius;
        [f64::from(d.x), f64::from(-d.y)]
    }

    /// Returns a mesh of all cells of an angular basis, each in the colour that `colour` gives for its index, without
    /// gaps.
    ///
    /// Neighbouring rings have arcs of other chords, so that cells that end exactly at their borders leave slivers
    /// open. Each cell therefore extends a little under the next ring and the next cell, which are drawn after it.
    pub fn cells(
        &self,
        projection: Projection,
        side: Side,
        basis: &RingBasis,
        colour: impl Fn(usize) -> Color32,
    ) -> Mesh {
        let mut mesh = Mesh::default();
        let under = f64::from(OVERLAP / self.radius);
        let mut order: Vec<(usize, Cell)> = basis.cells().enumerate().collect();
        order.sort_by(|a, b| a.1.theta_min.total_cmp(&b.1.theta_min));
        for (index, cell) in order {
            let n = arc_steps(&cell);
            let outer = projection.radius(cell.theta_max);
            let radii = [projection.radius(cell.theta_min), (outer + under).min(1.0)];
            let width = if cell.width > 1.99 * PI { cell.width } else { cell.width + under / outer.max(1e-3) };
            let (first, fill) = (mesh.vertices.len() as u32, colour(index));
            for k in 0..=n {
                let phi = cell.phi - 0.5 * cell.width + width * k as f64 / n as f64;
                for radius in radii {
                    mesh.colored_vertex(self.screen(side.polar(radius, phi)), fill);
                }
            }
            for k in 0..n as u32 {
                let v = first + 2 * k;
                mesh.add_triangle(v, v + 1, v + 2);
                mesh.add_triangle(v + 1, v + 2, v + 3);
            }
        }
        mesh
    }

    /// Returns the border lines between the cells of an angular basis on the screen, each line once: drawn by the cells
    /// on both sides, with different chords, a line would show a moiré pattern.
    pub fn borders(&self, projection: Projection, side: Side, basis: &RingBasis) -> Vec<Vec<Pos2>> {
        let place = |radius: f64, phi: f64| self.screen(side.polar(radius, phi));
        let mut lines = Vec::new();
        for cell in basis.cells() {
            let (from, n) = (cell.phi - 0.5 * cell.width, arc_steps(&cell));
            let [inner, outer] = [cell.theta_min, cell.theta_max].map(|theta| projection.radius(theta));
            lines.push((0..=n).map(|k| place(outer, from + cell.width * k as f64 / n as f64)).collect());
            if cell.width < 1.99 * PI {
                lines.push(vec![place(inner, from), place(outer, from)]);
            }
        }
        lines
    }

    /// Returns a mesh of the disk with smoothly varying colours. `value`: colour at disk coordinates (right, up); it is
    /// evaluated on 31 radii by 72 azimuths.
    pub fn smooth(&self, value: impl Fn([f64; 2]) -> Color32) -> Mesh {
        const RINGS: u32 = 30;
        const SECTORS: u32 = 72;
        let mut mesh = Mesh::default();
        for ring in 0..=RINGS {
            for sector in 0..SECTORS {
                let (sin, cos) = (f64::from(sector) / f64::from(SECTORS) * 2.0 * PI).sin_cos();
                let radius = f64::from(ring) / f64::from(RINGS);
                let point = [radius * cos, radius * sin];
                mesh.colored_vertex(self.screen(point), value(point));
            }
        }
        for ring in 0..RINGS {
            for sector in 0..SECTORS {
                let (a, b) = (ring * SECTORS + sector, ring * SECTORS + (sector + 1) % SECTORS);
                mesh.add_triangle(a, b, a + SECTORS);
                mesh.add_triangle(b, a + SECTORS, b + SECTORS);
            }
        }
        mesh
    }

    /// Draws the rim, faint rings at θ = 30° and 60° with their labels, and the label "up" above the disk.
    pub fn rim(&self, painter: &Painter, projection: Projection, palette: &Palette) {
        let thin = Stroke::new(1.0, palette.outline.gamma_multiply(0.45));
        for deg in [30_f64, 60.0] {
            let r = projection.radius(deg.to_radians()) as f32 * self.radius;
            painter.circle_stroke(self.centre, r, thin);
            if self.radius > 70.0 {
                let at = self.centre + egui::Vec2::splat(r * std::f32::consts::FRAC_1_SQRT_2);
                on_halo(painter, at, &format!("{deg:.0}°"), palette);
            }
        }
        painter.circle_stroke(self.centre, self.radius, Stroke::new(1.5, palette.outline));
        let top = pos2(self.centre.x, self.centre.y - self.radius - 1.0);
        painter.text(top, Align2::CENTER_BOTTOM, say::UP, FontId::proportional(13.0), palette.weak);
    }

    /// Draws [`Self::rim`], the labels "left" and "right" at the sides, and the caption `corner` under the disk.
    pub fn frame(&self, painter: &Painter, projection: Projection, corner: &str, palette: &Palette) {
        self.rim(painter, projection, palette);
        let font = FontId::proportional(13.0);
        let (c, r) = (self.centre, self.radius);
        for (word, x, angle) in
            [(say::LEFT, c.x - r - 9.0, -FRAC_PI_2 as f32), (say::RIGHT, c.x + r + 9.0, FRAC_PI_2 as f32)]
        {
            let galley = painter.layout_no_wrap(word.into(), font.clone(), palette.weak);
            let at = pos2(x, c.y) - 0.5 * galley.size();
            painter.add(TextShape::new(at, galley, palette.weak).with_angle_and_anchor(angle, Align2::CENTER_CENTER));
        }
        painter.text(pos2(c.x, c.y + r + 1.0), Align2::CENTER_TOP, corner, font, palette.ink);
    }
}

/// Draws small text, centred at a screen position, over coloured data: a translucent background makes it readable on
/// every colour. Returns the rectangle of the text.
pub fn on_halo(painter: &Painter, at: Pos2, text: &str, palette: &Palette) -> Rect {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(13.0), palette.ink);
    let rect = Align2::CENTER_CENTER.anchor_size(at, galley.size());
    painter.rect_filled(rect.expand2(egui::vec2(2.0, 0.0)), 3, palette.halo);
    painter.galley(rect.min, galley, palette.ink);
    rect
}

/// Returns the index of the point that follows `from` in a screen direction (right, up), among points within 60° of
/// this direction: the nearest, with the sideways distance counted twice. `None` if there is none. Points in disk
/// coordinates. Arrow keys choose the cells of any angular basis in this manner.
pub fn neighbour(points: &[[f64; 2]], from: [f64; 2], [dx, dy]: [f64; 2]) -> Option<usize> {
    points
        .iter()
        .enumerate()
        .filter_map(|(index, p)| {
            let (x, y) = (p[0] - from[0], p[1] - from[1]);
            let (along, aside) = (x * dx + y * dy, (x * dy - y * dx).abs());
            (along > 1e-9 && aside <= 1.732 * along).then_some((index, along + 2.0 * aside))
        })
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(index, _)| index)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::AzimuthMap;

    /// Whether a point is inside some triangle, corners and edges included.
    fn covered(mesh: &Mesh, at: Pos2) -> bool {
        mesh.indices.chunks_exact(3).any(|t| {
            let [a, b, c] = [t[0], t[1], t[2]].map(|k| mesh.vertices[k as usize].pos);
            let side = |p: Pos2, q: Pos2| (q - p).x * (at - p).y - (q - p).y * (at - p).x;
            let sides = [side(a, b), side(b, c), side(c, a)];
            sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
        })
    }

    #[test]
    fn no_gap_is_left_between_rings_and_cells() {
        let disk = Disk { centre: pos2(200.0, 180.0), radius: 140.0 };
        for (projection, side) in
            [(Projection::ProjectedSolidAngle, Side::Emergent), (Projection::SolidAngle, Side::Incident)]
        {
            for basis in [RingBasis::klems_full(AzimuthMap::KLEMS_FRONT), RingBasis::tregenza()] {
                let mesh = disk.cells(projection, side, &basis, |_| Color32::WHITE);
                // Round every border of rings, where chords part, and over the disk.
                let borders = basis.rings().iter().map(|ring| projection.radius(ring.theta_max)).filter(|r| *r < 0.99);
                let radii: Vec<f64> = borders
                    .flat_map(|r| (-8..=8).map(move |k| r + f64::from(k) * 1e-4))
                    .chain((0..40).map(|k| f64::from(k) / 41.0))
                    .collect();
                for (k, radius) in radii.into_iter().enumerate() {
                    for j in 0..90 {
                        let phi = (f64::from(j) * 4.0 + k as f64 * 0.37).to_radians();
                        let at = disk.screen([radius * phi.cos(), radius * phi.sin()]);
                        assert!(covered(&mesh, at), "{} {projection:?} r {radius} φ {phi}", basis.name());
                    }
                }
            }
        }
    }

    #[test]
    fn every_border_is_drawn_once() {
        let disk = Disk { centre: pos2(0.0, 0.0), radius: 100.0 };
        let basis = RingBasis::tregenza();
        let lines = disk.borders(Projection::ProjectedSolidAngle, Side::Incident, &basis);
        let length: f32 = lines.iter().flat_map(|line| line.windows(2)).map(|pair| pair[0].distance(pair[1])).sum();
        let radius = |theta| 100.0 * Projection::ProjectedSolidAngle.radius(theta);
        let of_ring = |ring: &crate::compute::basis::Ring| {
            let round = 2.0 * PI * radius(ring.theta_max);
            let spokes = if ring.sectors > 1 {
                ring.sectors as f64 * (radius(ring.theta_max) - radius(ring.theta_min))
            } else {
                0.0
            };
            round + spokes
        };
        let wanted: f64 = basis.rings().iter().map(of_ring).sum();
        assert!((f64::from(length) / wanted - 1.0).abs() < 2e-3, "{length} {wanted}");
    }

    #[test]
    fn arrows_walk_over_a_basis_and_back() {
        let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let points: Vec<_> = basis.cells().map(|c| Side::Incident.disk(Projection::default(), c.centre())).collect();
        let up = neighbour(&points, points[0], [0.0, 1.0]).unwrap();
        assert!(points[up][1] > 0.1 && points[up][0].abs() < 1e-9);
        assert_eq!(neighbour(&points, points[up], [0.0, -1.0]), Some(0));
        assert_eq!(neighbour(&points, [0.0, 1.0], [0.0, 1.0]), None);
    }
}

//! A closed surface round a point in 3D with one radius for every direction, as of a photometric solid: painted back to
//! front, shaded by orientation.

use super::camera::View;
use egui::{Color32, Mesh, Painter, Pos2, Shape};
use glam::DVec3;

/// Closed surface in 3D round the origin, whose nodes are a grid of rows (from pole to pole) and columns (all round).
#[derive(Debug, Clone, Default)]
pub struct Body {
    columns: usize,
    points: Vec<DVec3>,
    colours: Vec<Color32>,
}

impl Body {
    /// Creates the surface from `node`, which gives point and colour of the node in a row, from 0 to `rows` inclusive,
    /// and a column, from 0 to `columns` exclusive; the last column is joined to the first.
    pub fn new(rows: usize, columns: usize, mut node: impl FnMut(usize, usize) -> (DVec3, Color32)) -> Self {
        let nodes = (0..=rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let (points, colours) = nodes.map(|(row, column)| node(row, column)).unzip();
        Self { columns, points, colours }
    }

    /// Returns the indices of the four nodes of every quadrilateral of the surface, in order round its edge.
    fn pieces(&self) -> impl Iterator<Item = [usize; 4]> + '_ {
        let n = self.columns.max(1);
        let rows = (self.points.len() / n).saturating_sub(1);
        (0..rows * n).map(move |k| {
            let (row, column) = (k / n, k % n);
            let next = (column + 1) % n;
            [row * n + column, row * n + next, (row + 1) * n + next, (row + 1) * n + column]
        })
    }

    /// Paints the surface scaled by `size` round `centre` \[m\], as `view` shows it.
    pub fn paint(&self, painter: &Painter, view: &View, centre: DVec3, size: f64) {
        painter.add(Shape::mesh(self.mesh(view, centre, size)));
    }

    /// Returns the point of a node by its index, row · columns + column, for the surface of size 1 round the origin;
    /// `None` if there is no such node.
    pub fn point(&self, node: usize) -> Option<DVec3> {
        self.points.get(node).copied()
    }

    /// Returns the index of the node nearest to the camera among those within `reach` \[points\] of the screen position
    /// `at`; `None` if there is none. `centre` and `size`: as in [`Self::paint`].
    pub fn nearest(&self, view: &View, centre: DVec3, size: f64, at: Pos2, reach: f32) -> Option<usize> {
        let near = |(node, point): (usize, &DVec3)| {
            let (place, depth) = view.screen(centre + size * *point)?;
            (place.distance(at) <= reach).then_some((node, depth))
        };
        let found = self.points.iter().enumerate().filter_map(near);
        found.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(node, _)| node)
    }

    /// Returns the triangles of the surface on the screen, from the farthest to the nearest; quadrilaterals with a node
    /// behind the camera are left out.
    fn mesh(&self, view: &View, centre: DVec3, size: f64) -> Mesh {
        let places: Vec<_> = self.points.iter().map(|point| view.screen(centre + size * *point)).collect();
        let mut order: Vec<(u64, [usize; 4], f64)> = Vec::with_capacity(self.points.len());
        for piece in self.pieces() {
            let mut depth = 0.0;
            let mut seen = true;
            for &node in &piece {
                match places[node] {
                    Some((_, own)) => depth += own,
                    None => seen = false,
                }
            }
            let [a, b, c, d] = piece.map(|node| self.points[node]);
            let normal = (c - a).cross(d - b);
            if seen && normal.length_squared() > 1e-18 {
                let towards = (view.eye - (centre + size * a)).normalize_or_zero();
                // Positive numbers are in the order of their bits; the farthest come first.
                order.push((!f64::to_bits(depth), piece, normal.normalize_or_zero().dot(towards).abs()));
            }
        }
        order.sort_unstable_by_key(|(depth, piece, _)| (*depth, piece[0]));
        let mut mesh = Mesh::default();
        for (_, piece, turned) in order {
            let first = mesh.vertices.len() as u32;
            for node in piece {
                if let Some((at, _)) = places[node] {
                    mesh.colored_vertex(at, shaded(self.colours[node], turned));
                }
            }
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first, first + 2, first + 3);
        }
        mesh
    }
}

/// Returns a colour shaded by the cosine of the angle between the normal of a quadrilateral and the viewing direction.
fn shaded(colour: Color32, cosine: f64) -> Color32 {
    let share = 0.6 + 0.4 * cosine;
    let [r, g, b, a] = colour.to_array();
    let [r, g, b] = [r, g, b].map(|part| (f64::from(part) * share).round() as u8);
    Color32::from_rgba_premultiplied(r, g, b, a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::paint::camera::Camera;
    use egui::{Rect, pos2, vec2};
    use std::f64::consts::{PI, TAU};

    #[test]
    fn a_ball_is_painted_far_side_first_and_closed() {
        let (rows, columns) = (12, 24);
        let ball = Body::new(rows, columns, |row, column| {
            let (theta, phi) = (PI * row as f64 / rows as f64, TAU * column as f64 / columns as f64);
            let point = DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
            (point, if point.x > 0.0 { Color32::RED } else { Color32::BLUE })
        });
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(200.0, 200.0));
        // From +x: the red half lies over the blue one.
        let view = Camera::from(0.0, 0.0).view(DVec3::ZERO, 1.0, rect);
        let mesh = ball.mesh(&view, DVec3::ZERO, 1.0);
        assert_eq!(mesh.indices.len(), 6 * rows * columns);
        let colours: Vec<Color32> = mesh.vertices.iter().map(|vertex| vertex.color).collect();
        assert!(colours[0].b() > 0 && colours[0].r() == 0);
        assert!(colours[colours.len() - 1].r() > 0 && colours[colours.len() - 1].b() == 0);
        // Its outline is as large as the sphere is seen.
        let widest = mesh.vertices.iter().map(|vertex| vertex.pos.x).fold(0.0, f32::max);
        assert!(widest > 190.0 && widest <= 200.0, "{widest}");
    }
}

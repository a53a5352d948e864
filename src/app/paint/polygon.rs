//! Filled polygons of any shape; egui fills only convex ones.

use egui::{Color32, Mesh, Pos2, pos2};

/// Maximum number of corners of a polygon that is filled: the computing time grows with the square of the number.
const MOST_CORNERS: usize = 400;

/// Returns a mesh that fills a polygon whose edges do not cross, as trapezoids between the heights of its corners on
/// the screen; empty for too many corners.
pub fn fill(corners: &[Pos2], colour: Color32) -> Mesh {
    let mut mesh = Mesh::default();
    if corners.len() < 3 || corners.len() > MOST_CORNERS {
        return mesh;
    }
    let mut levels: Vec<f32> = corners.iter().map(|corner| corner.y).collect();
    levels.sort_by(f32::total_cmp);
    levels.dedup_by(|a, b| (*a - *b).abs() < 1e-3);
    for pair in levels.windows(2) {
        let (top, bottom) = (pair[0], pair[1]);
        let middle = 0.5 * (top + bottom);
        let next = corners.iter().cycle().skip(1);
        let crossing = corners.iter().zip(next).filter(|(a, b)| (a.y > middle) != (b.y > middle));
        let mut sides: Vec<[f32; 3]> = crossing
            .map(|(a, b)| {
                let at = |y: f32| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
                [at(middle), at(top), at(bottom)]
            })
            .collect();
        sides.sort_by(|a, b| a[0].total_cmp(&b[0]));
        for both in sides.chunks_exact(2) {
            let first = mesh.vertices.len() as u32;
            for [x, y] in [[both[0][1], top], [both[1][1], top], [both[1][2], bottom], [both[0][2], bottom]] {
                mesh.colored_vertex(pos2(x, y), colour);
            }
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first, first + 2, first + 3);
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(mesh: &Mesh) -> f32 {
        let corner = |k: u32| mesh.vertices[k as usize].pos;
        mesh.indices
            .chunks_exact(3)
            .map(|t| {
                let (a, b, c) = (corner(t[0]), corner(t[1]), corner(t[2]));
                0.5 * ((b - a).x * (c - a).y - (b - a).y * (c - a).x).abs()
            })
            .sum()
    }

    #[test]
    fn a_hollow_shape_keeps_its_hollow() {
        // A "U": 30 × 30 without 10 × 20.
        let corners = [[0., 0.], [10., 0.], [10., 20.], [20., 20.], [20., 0.], [30., 0.], [30., 30.], [0., 30.]];
        let corners = corners.map(|[x, y]| pos2(x, y));
        assert!((area(&fill(&corners, Color32::WHITE)) - 700.0).abs() < 1e-3);
    }
}

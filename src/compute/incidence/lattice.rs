//! Triangulation of the incident directions of data, and the barycentric weights of any direction in it.
//!
//! Planar Delaunay triangulation of the stereographic projection, which is the spherical one: 258 triangles for the 145
//! directions of Tregenza's lattice. Four directions of two rows with equal counts lie on a circle; the tie is broken
//! by a tiny rotation of each row, antisymmetric about both axes, so that the triangles have the symmetry of the
//! lattice.

use crate::compute::direction::{Dir, Facade, Incident};
use glam::{DMat3, DVec2, DVec3};
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation as _};

/// Rotation of a row of directions that decides ties of the triangulation. \[rad\] Far above the rounding of f64, 2⁻⁵²
/// ≈ 2.2e-16 per operation, and far below any distance between directions: only triangles that are tied change.
const TIE: f64 = 1e-7;

/// Incident directions of data, as unit vectors in the façade frame, and the spherical triangles between them.
#[derive(Debug, Clone)]
pub struct Lattice {
    points: Vec<DVec3>,
    triangles: Vec<[usize; 3]>,
    /// Edges of the triangulation's border, by the indices of their two directions.
    border: Vec<[usize; 2]>,
    /// Neighbours of each vertex, in rising order.
    neighbours: Vec<Vec<usize>>,
    on_border: Vec<bool>,
    /// Index of the direction that is left out of the triangulation.
    left_out: Option<usize>,
}

/// Position of a direction between at most three incident directions of data: barycentric weights in a triangle, or on
/// the border if the direction lies outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Index of the triangle that holds the direction; `None` outside the border of the triangulation.
    pub triangle: Option<usize>,
    /// Indices of the incident directions at the triangle's vertices; on the border one may appear twice, the second
    /// time with weight 0.
    pub vertices: [usize; 3],
    /// Barycentric weights of the vertices, not negative, of sum 1.
    pub weights: [f64; 3],
    /// Position of the direction between the border of the triangulation and grazing incidence: 0 on the border or
    /// inside, 1 at θ = 90°, linear in θ.
    pub beyond: f64,
}

struct Node {
    position: Point2<f64>,
    index: usize,
}

impl HasPosition for Node {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        self.position
    }
}

impl Lattice {
    /// Creates the triangulation of incident directions. Fewer than three, or all on one circle through the pole, have
    /// no triangles.
    pub fn new(incident: &[Incident]) -> Self {
        Self::without(incident, None)
    }

    /// Creates the triangulation without the direction of index `left_out`; that direction keeps its index, but has no
    /// neighbours.
    pub fn without(incident: &[Incident], left_out: Option<usize>) -> Self {
        let points: Vec<DVec3> = incident.iter().map(|d| d.0.vector()).collect();
        let mut delaunay: DelaunayTriangulation<Node> = DelaunayTriangulation::new();
        for (index, d) in incident.iter().enumerate().filter(|(index, _)| Some(*index) != left_out) {
            let (theta, phi) = (d.0.theta(), d.0.phi());
            let phi = phi + TIE * theta * ((2.0 * phi).sin() + 0.1);
            let radius = (0.5 * theta).tan();
            let position = Point2::new(radius * phi.cos(), radius * phi.sin());
            // Only coordinates that are not finite are refused, and those no direction has.
            let _ = delaunay.insert(Node { position, index });
        }
        let triangles: Vec<[usize; 3]> = delaunay
            .inner_faces()
            .map(|face| face.vertices().map(|vertex| vertex.data().index))
            .filter(|&[a, b, c]| points[a].dot(points[b].cross(points[c])).abs() > 1e-9)
            .collect();
        let mut neighbours = vec![Vec::new(); points.len()];
        let mut edges = std::collections::BTreeMap::new();
        for &[a, b, c] in &triangles {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                *edges.entry((p.min(q), p.max(q))).or_insert(0) += 1;
            }
        }
        let mut on_border = vec![false; points.len()];
        let mut border = Vec::new();
        for (&(p, q), &count) in &edges {
            neighbours[p].push(q);
            neighbours[q].push(p);
            if count == 1 {
                border.push([p, q]);
                on_border[p] = true;
                on_border[q] = true;
            }
        }
        neighbours.iter_mut().for_each(|list| list.sort_unstable());
        Self { points, triangles, border, neighbours, on_border, left_out }
    }

    /// Returns the incident directions as unit vectors, façade frame (z outward normal).
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Returns the triangles, each by the indices of the three incident directions at its vertices.
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// Returns the indices of the incident directions that an edge joins to the direction `vertex`, in rising order.
    pub fn neighbours(&self, vertex: usize) -> &[usize] {
        &self.neighbours[vertex]
    }

    /// Whether the incident direction `vertex` lies on the border of the triangulation, with no data beyond it.
    pub fn is_on_border(&self, vertex: usize) -> bool {
        self.on_border[vertex]
    }

    /// Returns the position of a direction in the triangulation: spherical barycentric weights of up to three incident
    /// directions. Outside the border they are those of the nearest point on it, so that weights are continuous
    /// everywhere.
    pub fn locate(&self, direction: Dir<Facade>) -> Place {
        let d = direction.vector();
        for (number, &[a, b, c]) in self.triangles.iter().enumerate() {
            let weights = DMat3::from_cols(self.points[a], self.points[b], self.points[c]).inverse() * d;
            if weights.min_element() >= -1e-9 {
                let weights = weights.max(DVec3::ZERO);
                let weights = (weights / (weights.x + weights.y + weights.z)).to_array();
                return Place { triangle: Some(number), vertices: [a, b, c], weights, beyond: 0.0 };
            }
        }
        self.beyond(d)
    }

    /// Returns the position of the point on the border nearest to a direction outside it.
    fn beyond(&self, d: DVec3) -> Place {
        let nearest = |best: Option<(f64, Place)>, (cosine, place): (f64, Place)| match best {
            Some((other, _)) if other >= cosine => best,
            _ => Some((cosine, place)),
        };
        let single = |p: usize| Place { triangle: None, vertices: [p; 3], weights: [1.0, 0.0, 0.0], beyond: 0.0 };
        let vertices =
            (0..self.points.len()).filter(|p| Some(*p) != self.left_out).map(|p| (self.points[p].dot(d), single(p)));
        let on_edge = |&[p, q]: &[usize; 2]| {
            // Foot of the arc from d at right angles to the edge's great circle.
            let (a, b) = (self.points[p], self.points[q]);
            let normal = a.cross(b).try_normalize()?;
            let foot = (d - normal * normal.dot(d)).try_normalize()?;
            let angle = |u: DVec3, v: DVec3| u.cross(v).length().atan2(u.dot(v));
            let t = angle(a, foot) / angle(a, b);
            (angle(a, foot) + angle(foot, b) < angle(a, b) + 1e-9).then(|| {
                let place = Place { triangle: None, vertices: [p, q, q], weights: [1.0 - t, t, 0.0], beyond: 0.0 };
                (foot.dot(d), place)
            })
        };
        let found = vertices.chain(self.border.iter().filter_map(on_edge)).fold(None, nearest);
        let Some((_, mut place)) = found else {
            return single(0);
        };
        let foot: DVec3 = place.vertices.iter().zip(place.weights).map(|(&v, w)| self.points[v] * w).sum();
        let theta = |v: DVec3| v.truncate().length().atan2(v.z);
        let (from, to) = (theta(foot), theta(d));
        place.beyond =
            if to > from { ((to - from) / (0.5 * std::f64::consts::PI - from).max(1e-6)).min(1.0) } else { 0.0 };
        place
    }
}

/// Returns the step from one direction to another as a vector in the tangent plane of the unit sphere at `from`; its
/// length is the angle between them \[rad\], its axes are arbitrary but fixed by `from`.
pub fn tangent_step(from: DVec3, to: DVec3) -> DVec2 {
    let (x, y) = from.any_orthonormal_pair();
    let flat = DVec2::new(to.dot(x), to.dot(y));
    let sine = flat.length();
    if sine < 1e-12 { DVec2::ZERO } else { flat * (sine.atan2(from.dot(to)) / sine) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::RingBasis;

    fn tregenza() -> Lattice {
        let incident: Vec<Incident> = RingBasis::tregenza().cells().map(|cell| Incident(cell.centre())).collect();
        Lattice::new(&incident)
    }

    #[test]
    fn tregenzas_lattice_has_258_triangles() {
        let lattice = tregenza();
        assert_eq!(lattice.triangles().len(), 258);
        assert_eq!(lattice.border.len(), 30);
        let edges: usize = lattice.neighbours.iter().map(Vec::len).sum::<usize>() / 2;
        assert_eq!(edges, 402);
    }

    #[test]
    fn triangles_are_mirrored_but_for_the_two_on_the_axis() {
        let lattice = tregenza();
        let mirrored = |v: usize| {
            let p = lattice.points[v] * DVec3::new(-1.0, 1.0, 1.0);
            (0..145).find(|&k| (lattice.points[k] - p).length() < 1e-9).unwrap()
        };
        let key = |t: [usize; 3]| {
            let mut t = t;
            t.sort_unstable();
            t
        };
        let all: std::collections::BTreeSet<[usize; 3]> = lattice.triangles.iter().map(|&t| key(t)).collect();
        let missing = all.iter().filter(|t| !all.contains(&key(t.map(mirrored)))).count();
        assert!(missing <= 4, "{missing}");
    }

    #[test]
    fn weights_give_the_direction_back_and_are_continuous() {
        let lattice = tregenza();
        let mut last: Option<(DVec3, Vec<f64>)> = None;
        // A path over vertices, edges, the pole and beyond the border.
        for step in 0..4000 {
            let t = step as f64 / 4000.0;
            let d = Dir::from_theta_phi(
                (1.57 * (1.0 - 2.0 * t)).abs(),
                if t < 0.5 { 0.3 } else { 0.3 + std::f64::consts::PI },
            );
            let place = lattice.locate(d);
            let sum: DVec3 = place.vertices.iter().zip(place.weights).map(|(&v, w)| lattice.points[v] * w).sum();
            if place.triangle.is_some() {
                assert!((sum.normalize() - d.vector()).length() < 1e-9);
                assert_eq!(place.beyond, 0.0);
            }
            let mut dense = vec![0.0; 146];
            place.vertices.iter().zip(place.weights).for_each(|(&v, w)| dense[v] += w);
            dense[145] = place.beyond;
            if let Some((_, before)) = &last {
                let jump = before.iter().zip(&dense).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(jump < 0.02, "{t}: {jump}");
            }
            last = Some((d.vector(), dense));
        }
        let pole = lattice.locate(Dir::from_unit(DVec3::Z));
        assert!(pole.vertices.iter().zip(pole.weights).any(|(&v, w)| v == 144 && w > 1.0 - 1e-9));
    }

    #[test]
    fn one_or_two_directions_are_enough() {
        let one = Lattice::new(&[Incident(Dir::from_theta_phi(0.4, 1.0))]);
        assert_eq!(one.locate(Dir::from_theta_phi(1.2, 4.0)).vertices[0], 0);
        let two = Lattice::new(&[Incident(Dir::from_theta_phi(0.4, 1.0)), Incident(Dir::from_theta_phi(0.9, 1.0))]);
        assert_eq!(two.locate(Dir::from_theta_phi(1.0, 1.0)).vertices[0], 1);
    }
}

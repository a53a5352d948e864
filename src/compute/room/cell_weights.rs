//! Exact illuminance of a sensor near an aperture whose luminance is constant on the cells of a ring basis (eq 17 in
//! solid-angle form): for every cell, the integral of the sensor's cosine over the part of the cell that the aperture
//! covers.
//!
//! The aperture, clipped by the sensor's plane, is a convex polygon in the gnomonic plane of the directions from the
//! sensor. In polar coordinates about the aperture's normal every cell border is a circle or a ray, every polygon edge
//! a great circle, so that between the azimuths where borders cross all integrals have closed forms: no sampling, no
//! singularity at grazing sensors.

use super::aperture::View;
use crate::compute::angle::wrap_two_pi;
use crate::compute::basis::{Ring, RingBasis};
use crate::compute::direction::Dir;
use crate::compute::polygon::{clip, edge, is_tiny, projected_solid_angle};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Calls `visit(cell, weight)` for every cell of `basis` that a sensor sees through an aperture; the weight is the
/// cell's projected solid angle \[sr\], so that E = Σ L_cell · weight. A cell may be visited several times, in a fixed
/// order.
pub fn for_each_cell(view: &View, basis: &RingBasis, mut visit: impl FnMut(usize, f64)) {
    let mut corners = Vec::with_capacity(6);
    clip(&view.corners(), view.normal, &mut corners);
    if corners.len() < 3 {
        return;
    }
    if is_tiny(&corners) {
        // The aperture is so small that borders of cells within it do not matter.
        let centre = Dir::new(corners.iter().sum());
        if let Some(cell) = centre.and_then(|centre| basis.index(centre)) {
            visit(cell, projected_solid_angle(&corners, view.normal));
        }
        return;
    }
    let Some(polygon) = Polygon::new(&corners, view.distance) else {
        return;
    };
    let mut breaks = Vec::with_capacity(64);
    for (index, ring) in basis.rings().iter().enumerate() {
        polygon.ring(basis, index, ring, view, &mut breaks, &mut visit);
    }
}

/// Convex polygon in the plane z = distance, seen from the origin in polar coordinates about z.
struct Polygon {
    /// Inward half planes n·p ≥ c of the edges from vertex k to k + 1, n of unit length.
    edges: Vec<(DVec2, f64)>,
    distance: f64,
    /// Azimuth from which relative azimuths are counted, and the range of the polygon's relative azimuths. \[rad\]
    reference: f64,
    range: [f64; 2],
    /// Relative azimuths of the vertices. \[rad\]
    azimuths: Vec<f64>,
    /// Minimum and maximum distance of the polygon from the pole. \[m\]
    radii: [f64; 2],
}

impl Polygon {
    /// Creates the polygon from its counter-clockwise corners in the plane z = `distance`; `None` for a degenerate one.
    fn new(corners: &[DVec3], distance: f64) -> Option<Self> {
        let mut vertices: Vec<DVec2> = corners.iter().map(|c| c.truncate()).collect();
        vertices.dedup();
        let area: f64 = (0..vertices.len()).map(|i| vertices[i].perp_dot(vertices[(i + 1) % vertices.len()])).sum();
        if vertices.len() < 3 || area <= 0.0 {
            return None;
        }
        let edges: Vec<(DVec2, f64)> = (0..vertices.len())
            .filter_map(|i| {
                let (p, q) = (vertices[i], vertices[(i + 1) % vertices.len()]);
                let normal = (q - p).perp().try_normalize()?;
                Some((normal, normal.dot(p)))
            })
            .collect();
        if edges.len() != vertices.len() {
            return None;
        }
        let pole_inside = edges.iter().all(|&(_, c)| c < 0.0);
        let centre = vertices.iter().sum::<DVec2>() / vertices.len() as f64;
        let reference = if pole_inside { 0.0 } else { centre.y.atan2(centre.x) };
        let azimuths: Vec<f64> = vertices.iter().map(|v| relative(v.y.atan2(v.x), reference)).collect();
        let range = if pole_inside {
            [-PI, PI]
        } else {
            // A vertex at the pole itself has no azimuth: the two edges that meet there give the range.
            let mut range = [f64::INFINITY, f64::NEG_INFINITY];
            for (vertex, &azimuth) in vertices.iter().zip(&azimuths) {
                if *vertex != DVec2::ZERO {
                    range = [range[0].min(azimuth), range[1].max(azimuth)];
                }
            }
            range
        };
        let farthest = vertices.iter().map(|v| v.length()).fold(0.0, f64::max);
        let nearest = if pole_inside {
            0.0
        } else {
            let from_edge = |i: usize| {
                let (p, q) = (vertices[i], vertices[(i + 1) % vertices.len()]);
                (p + (q - p) * (-p.dot(q - p) / (q - p).length_squared()).clamp(0.0, 1.0)).length()
            };
            (0..vertices.len()).map(from_edge).fold(f64::INFINITY, f64::min)
        };
        // Widened against rounding: whether a ring that only touches the polygon is visited does not matter.
        let radii = [nearest * (1.0 - 1e-12), farthest * (1.0 + 1e-12)];
        Some(Self { edges, distance, reference, range, azimuths, radii })
    }

    /// Returns the interval of distances from the pole along a relative azimuth, with the indices of the edges that
    /// bound it.
    fn along(&self, azimuth: f64) -> Option<[(f64, Option<usize>); 2]> {
        let (sin, cos) = (azimuth + self.reference).sin_cos();
        let ray = DVec2::new(cos, sin);
        let (mut low, mut high) = ((0.0, None), (f64::INFINITY, None));
        for (k, &(normal, c)) in self.edges.iter().enumerate() {
            let s = normal.dot(ray);
            if s > 0.0 {
                if c / s > low.0 {
                    low = (c / s, Some(k));
                }
            } else if s < 0.0 {
                if c / s < high.0 {
                    high = (c / s, Some(k));
                }
            } else if c > 0.0 {
                return None;
            }
        }
        (high.0 > low.0).then_some([low, high])
    }

    /// Visits the cells of one ring that the polygon covers, with their weights.
    fn ring(
        &self,
        basis: &RingBasis,
        index: usize,
        ring: &Ring,
        view: &View,
        breaks: &mut Vec<f64>,
        visit: &mut impl FnMut(usize, f64),
    ) {
        // Borders of the ring are circles d tanθ in the gnomonic plane; at the horizon the circle is infinite, which a
        // rounded tangent of 90° is not.
        let inner = self.distance * ring.theta_min.tan();
        let outer =
            if ring.theta_max < 0.5 * PI - 1e-12 { self.distance * ring.theta_max.tan() } else { f64::INFINITY };
        if inner >= self.radii[1] || outer <= self.radii[0] {
            return;
        }
        let [first, last] = self.range;
        let width = 2.0 * PI / ring.sectors as f64;
        // Azimuths at which the cell changes, or the edge or circle that bounds it: in between all closed forms hold.
        breaks.clear();
        breaks.extend([first, last]);
        if ring.sectors > 1 {
            for sector in 0..ring.sectors {
                // The first sector is centred on `first_phi`: borders lie half a width further.
                let own = ring.first_phi + (sector as f64 + 0.5) * width;
                breaks.push(relative(basis.azimuth().facade_phi(own), self.reference));
            }
        }
        breaks.extend(&self.azimuths);
        for radius in [inner, outer] {
            if radius > 0.0 && radius.is_finite() {
                self.crossings(radius, breaks);
            }
        }
        breaks.retain(|&azimuth| azimuth >= first && azimuth <= last);
        breaks.sort_unstable_by(f64::total_cmp);
        let rims = [ring.theta_min, ring.theta_max].map(Rim::new);
        let mut from = first;
        // Two neighbouring intervals share a border: its sine and cosine are computed once.
        let mut end = (first + self.reference).sin_cos();
        for &to in breaks.iter() {
            // Breaks that coincide; `from` stays, so that nothing is lost between them.
            if to - from < 1e-15 {
                continue;
            }
            let (a, b) = (from, to);
            let ends = [end, (b + self.reference).sin_cos()];
            (from, end) = (to, ends[1]);
            // Bounds and sector of the interval are determined at its middle, where rounding cannot lead to a
            // neighbour.
            let middle = 0.5 * (a + b);
            let Some([low, high]) = self.along(middle) else {
                continue;
            };
            let lower = if low.0 >= inner { Bound::Edge(low.1) } else { Bound::Circle(rims[0]) };
            let upper = if high.0 <= outer { Bound::Edge(high.1) } else { Bound::Circle(rims[1]) };
            if high.0.min(outer) <= low.0.max(inner) {
                continue;
            }
            let fan = |bound: &Bound| self.fan(bound, ends, b - a);
            // w = n·∫ω dω over the fan between the two bounds. The fan lies in front of the sensor, so that negative
            // values are rounding.
            let weight = view.normal.dot(fan(&upper) - fan(&lower));
            let own = basis.azimuth().own_phi(middle + self.reference);
            let sector = (wrap_two_pi(own - ring.first_phi + 0.5 * width) / width) as usize;
            visit(basis.first_cell(index) + sector.min(ring.sectors - 1), weight.max(0.0));
        }
    }

    /// Adds the relative azimuths at which the polygon's edges cross a circle about the pole to `breaks`.
    fn crossings(&self, radius: f64, breaks: &mut Vec<f64>) {
        for &(normal, c) in &self.edges {
            if c.abs() < radius {
                let along = (radius * radius - c * c).sqrt();
                let foot = normal * c;
                for point in [foot + normal.perp() * along, foot - normal.perp() * along] {
                    breaks.push(relative(point.y.atan2(point.x), self.reference));
                }
            }
        }
    }

    /// Returns ∫ ω dω from the pole to a bound, between two azimuths given by (sin, cos), `turn` apart.
    fn fan(&self, bound: &Bound, ends: [(f64, f64); 2], turn: f64) -> DVec3 {
        let [(sin_a, cos_a), (sin_b, cos_b)] = ends;
        match *bound {
            Bound::Circle(Rim { radial, axial }) => {
                DVec3::new(radial * (sin_b - sin_a), radial * (cos_a - cos_b), axial * turn)
            }
            Bound::Edge(None) => DVec3::ZERO,
            Bound::Edge(Some(k)) => {
                let (normal, c) = self.edges[k];
                let radius = |(sin, cos): (f64, f64)| c / normal.dot(DVec2::new(cos, sin));
                let (rho_a, rho_b) = (radius((sin_a, cos_a)), radius((sin_b, cos_b)));
                let point = |rho: f64, (sin, cos): (f64, f64)| DVec3::new(rho * cos, rho * sin, self.distance);
                // The two radial arcs lie in planes through z: Γ n̂ = θ · (z × radial direction).
                let arc = |rho: f64, (sin, cos): (f64, f64)| rho.atan2(self.distance) * DVec3::new(-sin, cos, 0.0);
                let chord = edge(point(rho_a, ends[0]), point(rho_b, ends[1]));
                0.5 * (arc(rho_a, ends[0]) + chord - arc(rho_b, ends[1]))
            }
        }
    }
}

/// ∫ ω dω per azimuth from the pole to a circle about it: radial and axial component.
#[derive(Clone, Copy)]
struct Rim {
    radial: f64,
    axial: f64,
}

impl Rim {
    fn new(theta: f64) -> Self {
        let (sin, cos) = theta.sin_cos();
        Self { radial: 0.5 * (theta - sin * cos), axial: 0.5 * sin * sin }
    }
}

enum Bound {
    /// Border of a ring.
    Circle(Rim),
    /// An edge of the polygon; `None` is the pole itself.
    Edge(Option<usize>),
}

/// Returns an azimuth relative to a reference, −π … π. \[rad\]
fn relative(azimuth: f64, reference: f64) -> f64 {
    let turned = wrap_two_pi(azimuth - reference);
    if turned > PI { turned - 2.0 * PI } else { turned }
}

#[cfg(test)]
mod tests {
    use super::super::aperture::Aperture;
    use super::*;
    use crate::compute::basis::AzimuthMap;
    use crate::compute::direction::Surface;

    fn window() -> Aperture {
        Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 1.0), size: [3.0, 1.5] }
    }

    fn bases() -> Vec<RingBasis> {
        vec![
            RingBasis::hemisphere(),
            RingBasis::klems_full(AzimuthMap::KLEMS_FRONT),
            RingBasis::tregenza(),
            RingBasis::equal_area(9),
        ]
    }

    fn sensors() -> Vec<(DVec3, DVec3)> {
        let points = [
            DVec3::new(2.0, 2.0, 1.7),
            DVec3::new(2.0, 0.3, 0.85),
            DVec3::new(0.5, 1.0, 1.0),
            DVec3::new(2.0, 1e-3, 0.999),
            DVec3::new(3.9, 5.9, 0.1),
            DVec3::new(2.0, 500.0, 1.2),
        ];
        let normals =
            [DVec3::Z, DVec3::NEG_Y, DVec3::X, DVec3::NEG_Z, DVec3::new(0.3, -0.6, 0.5).normalize(), DVec3::Y];
        points.into_iter().flat_map(|p| normals.map(|n| (p, n))).collect()
    }

    #[test]
    fn weights_sum_to_lamberts_closed_form() {
        for (position, normal) in sensors() {
            let view = window().view(position, normal).unwrap();
            let exact = projected_solid_angle(&view.corners(), view.normal);
            for basis in bases() {
                let mut sum = 0.0;
                for_each_cell(&view, &basis, |_, weight| sum += weight);
                let scale = exact.max(1e-12);
                assert!(
                    (sum - exact).abs() < 1e-9 * scale + 1e-14,
                    "{} {position} {normal}: {sum} {exact}",
                    basis.name()
                );
            }
        }
    }

    #[test]
    fn each_weight_agrees_with_dense_sampling() {
        let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let view = window().view(DVec3::new(1.2, 0.9, 0.85), DVec3::new(0.2, -0.4, 0.7).normalize()).unwrap();
        let mut exact = vec![0.0; basis.len()];
        for_each_cell(&view, &basis, |cell, weight| exact[cell] += weight);
        let mut sampled = vec![0.0; basis.len()];
        let n = 1200;
        let step = [(view.x[1] - view.x[0]) / n as f64, (view.y[1] - view.y[0]) / n as f64];
        for i in 0..n {
            for j in 0..n {
                let p = DVec3::new(
                    view.x[0] + (i as f64 + 0.5) * step[0],
                    view.y[0] + (j as f64 + 0.5) * step[1],
                    view.distance,
                );
                let d = Dir::new(p).unwrap();
                let solid = step[0] * step[1] * view.distance / p.length().powi(3);
                sampled[basis.index(d).unwrap()] += solid * view.normal.dot(d.vector()).max(0.0);
            }
        }
        let total: f64 = exact.iter().sum();
        for (cell, (a, b)) in exact.iter().zip(&sampled).enumerate() {
            assert!((a - b).abs() < 2e-5 * total, "cell {cell}: {a} {b}");
        }
    }

    #[test]
    fn a_sensor_on_the_aperture_corner_axis_is_finite() {
        // The pole lies exactly on a vertex and on edges of the opening.
        for position in [DVec3::new(0.5, 1.0, 1.0), DVec3::new(2.0, 1.0, 1.0), DVec3::new(0.5, 0.2, 1.5)] {
            let view = window().view(position, DVec3::NEG_Y).unwrap();
            let exact = projected_solid_angle(&view.corners(), view.normal);
            let mut sum = 0.0;
            for_each_cell(&view, &RingBasis::tregenza(), |_, weight| sum += weight);
            assert!((sum - exact).abs() < 1e-12);
        }
    }
}

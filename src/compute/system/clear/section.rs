//! Vertical section through which light is traced: clear bodies of one period, stored as regions with borders, between
//! flat panes.

use super::outline::{Outline, OutlineError, area2, check, edges};
use crate::compute::system::panes::glazing::Pane;

/// Clear material of a body: refractive index and absorption coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Refractive index, 1 to 4.
    pub index: f64,
    /// Absorption coefficient. \[1/m\]
    pub absorption: f64,
}

/// Body of clear material within one period.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Outline of the body in section.
    pub outline: Outline,
    /// Material of the body.
    pub material: Material,
}

/// Vertical section of clear bodies in air, repeated upwards with a period, between optional panes.
#[derive(Debug, Clone)]
pub struct ClearSection {
    bodies: Vec<Body>,
    /// Vertical period of the section. \[m\]
    pub(super) period: f64,
    /// Outer and inner pane, if any; their distance from the bodies has no effect.
    pub(super) panes: [Option<Pane>; 2],
    /// Regions of the section: index 0 is the air, followed by one per body. Lengths are in periods.
    pub(super) regions: Vec<Region>,
    /// Minimum and maximum depth (outward coordinate) of the bodies. \[periods\]
    pub(super) depth: [f64; 2],
}

/// Part of the section with one refractive index.
#[derive(Debug, Clone)]
pub(super) struct Region {
    /// Square of the refractive index.
    pub n2: f64,
    /// Absorption coefficient times the period: optical depth over a length of one period.
    pub absorption: f64,
    /// Straight borders of the region, which lies on their left.
    pub edges: Vec<Edge>,
    /// Flat faces of sheets that border the region.
    pub planes: Vec<Plane>,
    /// Lower corner (outward, upward) of the box around the region's edges in one period; `high` is the upper corner.
    /// \[periods\]
    pub low: [f64; 2],
    /// Upper corner (outward, upward) of the box around the region's edges in one period. \[periods\]
    pub high: [f64; 2],
    /// Whether light inside the region can meet only the borders of the same periodic copy (a closed body).
    pub confined: bool,
}

/// Straight border of a region from a to b (outward, upward) \[periods\]; its region lies on the left.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// Start of the border (outward, upward). \[periods\]
    pub a: [f64; 2],
    /// End of the border (outward, upward). \[periods\]
    pub b: [f64; 2],
    /// Unit normal (outward, upward) that points into the region.
    pub normal: [f64; 2],
    /// Index of the region on the other side of the border.
    pub beyond: usize,
}

impl Edge {
    fn new(a: [f64; 2], b: [f64; 2], beyond: usize) -> Self {
        let run = [b[0] - a[0], b[1] - a[1]];
        let length = run[0].hypot(run[1]);
        Self { a, b, normal: [-run[1] / length, run[0] / length], beyond }
    }
}

/// Flat face of a sheet, parallel to the façade. Light of its region meets the face if its travel along z has the sign
/// `seen_along`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    /// Depth of the face (outward coordinate). \[periods\]
    pub z: f64,
    /// Sign, 1 or −1, of the travel along z of light that meets the face.
    pub seen_along: f64,
    /// Index of the region on the other side of the face.
    pub beyond: usize,
}

impl Region {
    fn new(material: Material, period: f64, confined: bool) -> Self {
        Self {
            n2: material.index * material.index,
            absorption: material.absorption * period,
            edges: vec![],
            planes: vec![],
            low: [f64::INFINITY; 2],
            high: [f64::NEG_INFINITY; 2],
            confined,
        }
    }

    fn add(&mut self, edge: Edge) {
        for point in [edge.a, edge.b] {
            for ((low, high), at) in self.low.iter_mut().zip(&mut self.high).zip(point) {
                (*low, *high) = (low.min(at), high.max(at));
            }
        }
        self.edges.push(edge);
    }
}

impl ClearSection {
    /// Creates a section of bodies repeated upwards every `period` \[m\], between an outer and an inner pane (`None`:
    /// no pane).
    ///
    /// # Errors
    /// Returns an error if outlines cross, are nested or enclose nothing, or if materials are out of range.
    pub fn new(period: f64, bodies: Vec<Body>, panes: [Option<Pane>; 2]) -> Result<Self, OutlineError> {
        check(&bodies.iter().map(|body| &body.outline).collect::<Vec<_>>(), period)?;
        let air = Material { index: 1.0, absorption: 0.0 };
        let mut regions = vec![Region::new(air, period, false)];
        let mut depth = [f64::INFINITY, f64::NEG_INFINITY];
        for (number, body) in bodies.iter().enumerate() {
            let Material { index, absorption } = body.material;
            if !(1.0..=4.0).contains(&index) {
                return Err(OutlineError::Index { body: number, index });
            }
            if !(absorption >= 0.0 && absorption.is_finite()) {
                return Err(OutlineError::Absorption { body: number, absorption });
            }
            let region = regions.len();
            regions.push(Region::new(body.material, period, matches!(body.outline, Outline::Closed(_))));
            for (edge, towards_outside) in borders(&body.outline) {
                let [a, b] = edge.map(|[z, y]| [z / period, y / period]);
                depth = [depth[0].min(a[0]).min(b[0]), depth[1].max(a[0]).max(b[0])];
                if let Some(outside) = towards_outside {
                    let sign = if outside { 1.0 } else { -1.0 };
                    regions[region].planes.push(Plane { z: a[0], seen_along: sign, beyond: 0 });
                    regions[0].planes.push(Plane { z: a[0], seen_along: -sign, beyond: region });
                } else {
                    regions[region].add(Edge::new(a, b, 0));
                    regions[0].add(Edge::new(b, a, region));
                }
            }
        }
        if bodies.is_empty() {
            depth = [0.0, 0.0];
        }
        Ok(Self { bodies, period, panes, regions, depth })
    }

    /// Returns the section of one period for drawings, as closed polygons of (outward, upward) points \[m\]: the
    /// bodies, of a sheet the piece of one period, and the panes at a small distance from them.
    pub fn outline(&self) -> Vec<Vec<[f64; 2]>> {
        let mut list: Vec<Vec<[f64; 2]>> = self.bodies.iter().map(|body| polygon(&body.outline)).collect();
        let floor = list.iter().flatten().map(|point| point[1]).fold(f64::INFINITY, f64::min);
        let floor = if floor.is_finite() { floor } else { 0.0 };
        let gap = 0.1 * self.period;
        for (pane, side) in self.panes.iter().zip([1.0, -1.0]) {
            let Some(pane) = pane else { continue };
            let border = if side > 0.0 { self.depth[1] } else { self.depth[0] } * self.period;
            let (near, far) = (border + side * gap, border + side * (gap + pane.thickness));
            let roof = floor + self.period;
            list.push(vec![[near, floor], [far, floor], [far, roof], [near, roof]]);
        }
        list
    }

    /// Returns the section with outside and inside exchanged, mirrored in the plane of the façade.
    #[must_use]
    pub fn flipped(&self) -> Self {
        let mirror = |points: &[[f64; 2]]| points.iter().map(|[z, y]| [-z, *y]).collect::<Vec<_>>();
        let bodies = self.bodies.iter().map(|body| Body {
            outline: match &body.outline {
                Outline::Closed(points) => Outline::Closed(mirror(points)),
                Outline::Sheet { outer, inner } => Outline::Sheet { outer: mirror(inner), inner: mirror(outer) },
            },
            material: body.material,
        });
        Self::new(self.period, bodies.collect(), [self.panes[1], self.panes[0]])
            .expect("a mirror image crosses itself no more than its original")
    }
}

fn polygon(outline: &Outline) -> Vec<[f64; 2]> {
    match outline {
        Outline::Closed(points) => points.clone(),
        Outline::Sheet { outer, inner } => outer.iter().chain(inner.iter().rev()).copied().collect(),
    }
}

/// Returns the edges of an outline, each by start and end with the body on its left. Flat faces of sheets are whole
/// planes, marked by `Some(whether the face looks outside)`.
fn borders(outline: &Outline) -> Vec<([[f64; 2]; 2], Option<bool>)> {
    let turned = |[a, b]: [[f64; 2]; 2]| [b, a];
    match outline {
        Outline::Closed(points) => {
            let left = area2(points) > 0.0;
            edges(outline).into_iter().map(|edge| (if left { edge } else { turned(edge) }, None)).collect()
        }
        Outline::Sheet { outer, inner } => {
            let face = |points: &[[f64; 2]], outside: bool| {
                if points.iter().all(|point| point[0] == points[0][0]) {
                    return vec![([points[0], points[points.len() - 1]], Some(outside))];
                }
                // Upwards with the body on the left means its outer face: what lies left of +y is −z.
                let pairs = points.windows(2).map(|pair| [pair[0], pair[1]]);
                pairs.map(|edge| (if outside { edge } else { turned(edge) }, None)).collect()
            };
            [face(outer, true), face(inner, false)].concat()
        }
    }
}

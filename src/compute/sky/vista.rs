//! View from a point of a face or of the ground past boxes with vertical sides.
//!
//! Along a bearing every box is a rectangle of distance and height, of which the front and the top or underside are
//! visible. The borders in view are the ends of these, the horizon and the skyline, in closed form; between two of them
//! a single surface is visible, the nearest. Its sunlit and shaded parts are intervals of the same line, in closed
//! form, too.

use super::outside::Outside;
use super::patches::ROW_HEIGHT;
use super::scan_region::sector_bearings;
use super::scenery::{Scenery, Surface, share_above};
use super::sun::Sun;
use crate::compute::surroundings::solid::Solid;
use crate::compute::sweep::rule;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI};

/// Share of the hemisphere below which all small bodies together are neglected. Chosen: close to the accuracy of views,
/// `REST` of `faces`; no test depends on its exact value.
const LEFT_OUT: f64 = 3e-4;
/// Angular radius below which a body is small. \[rad\] Chosen; no effect at present: one body of 0.017, the root of
/// [`LEFT_OUT`], already ends the search for small bodies.
const SMALL: f64 = 0.06;
/// Maximum number of bodies, the largest in view, whose corners are borders of pieces of the sweep. Chosen: cost; edges
/// of further bodies lie within pieces. No test has more bodies in view.
const WITH_KNOTS: usize = 12;
/// Maximum angular length of a piece of the sweep over bearings. \[rad\] Chosen: cost; held by the test
/// `ground_below_a_skyline_gets_what_cubature_finds`, to 2e-4.
const PIECE: f64 = 0.35;
/// Angular lengths of a piece of the sweep above which it has two and three Gauss points. \[rad\] Chosen: cost; held by
/// the test `ground_below_a_skyline_gets_what_cubature_finds`, to 2e-4.
const POINTS: [f64; 2] = [0.02, 0.12];
/// Angle along a bearing per additional Gauss point on surfaces. \[rad\] Chosen: cost; held by the test
/// `places_are_those_that_rays_meet`, to the 4e-3 of its rays.
const ON_SURFACE: f64 = 0.3;
/// Angle along a bearing per additional Gauss point in the sky. \[rad\] Chosen: cost; held by the test
/// `ground_below_a_skyline_gets_what_cubature_finds`, to 2e-4.
const IN_SKY: f64 = 0.2;
/// Distance at which the ground ends. \[m\] Chosen: ten times the largest coordinate of a box; there the ground is open
/// and uniform.
const FARTHEST: f64 = 1e7;

/// Returns the outside with the luminance of its unobstructed ground corrected for the skyline: the ground is lit by
/// the sky and sun above the skyline, and by the skyline itself. Without a skyline it is unchanged.
pub fn with_ground_behind_skyline(outside: Outside, sun: Option<&Sun>) -> Outside {
    let skyline = outside.surroundings().and_then(|around| around.skyline.as_ref());
    if skyline.is_none() && outside.skyline_altitude() <= 0.0 {
        return outside;
    }
    let surfaces = vec![Surface::ground(0.0, 0.0, [1.0, 0.0])];
    let scenery = Scenery { open: &outside, skyline, bodies: Vec::new(), from_ground: 0, surfaces };
    let diffuse = Vista::new(&scenery, 0, DVec3::ZERO).gather(|_, _, _| {});
    let direct = sun.map_or(0.0, |sun| share_above(&outside, skyline, sun) * sun.horizontal());
    outside.on_ground(diffuse + direct)
}

/// Body in front of the viewpoint.
struct Body<'a> {
    index: usize,
    solid: &'a Solid,
    /// Bearing of the body's middle; the body lies within `reach` on both sides of it. \[rad\]
    bearing: f64,
    reach: f64,
}

/// Interval of altitudes that a surface covers along a bearing, unless a nearer surface hides it.
#[derive(Clone, Copy)]
struct Stretch {
    /// Lower altitude; `high` is the upper one. \[rad\]
    low: f64,
    high: f64,
    surface: usize,
    place: Place,
}

#[derive(Clone, Copy)]
enum Place {
    /// Vertical surface at this horizontal distance from the viewpoint. \[m\]
    Front(f64),
    /// Horizontal surface at this height above the viewpoint. \[m\]
    Level(f64),
}

impl Place {
    /// Returns the horizontal distance of the surface at the altitude with the tangent `tangent`. \[m\]
    fn distance(self, tangent: f64) -> f64 {
        match self {
            Self::Front(distance) => distance,
            // Infinitely far towards the horizon, limited to a finite distance.
            Self::Level(above) => (above / tangent).abs().min(FARTHEST),
        }
    }
}

/// Receiver of everything that is visible from a point, piece by piece. `counts` is always the projected solid angle of
/// the piece at the point. \[sr\]
pub(super) trait Collector {
    /// Adds a piece of sky around a direction.
    fn sky(&mut self, towards: DVec3, counts: f64);
    /// Adds a piece of the skyline, uniform or by bearing.
    fn skyline(&mut self, counts: f64);
    /// Adds a piece of a surface of given luminance. \[cd/m²\]
    fn stated(&mut self, luminance: f64, counts: f64);
    /// Adds a piece of a reflecting surface, sunlit or shaded, around the point `at` in the coordinates of the surface.
    /// \[m\]
    fn place(&mut self, surface: usize, at: [f64; 2], counts: f64);
    /// Adds the sunlit piece of a reflecting surface, for its directly reflected sunlight.
    fn sunlit(&mut self, surface: usize, counts: f64);
    /// Returns the angle along a bearing per additional point on a surface. \[rad\]
    fn step(&self) -> f64 {
        ON_SURFACE
    }
}

/// Collector of the illuminance at a point by sky, skyline, surfaces of given luminance and directly reflected
/// sunlight; the smooth luminance of surfaces is left to `place`.
struct Falling<'a, F> {
    scenery: &'a Scenery<'a>,
    /// Sum of the illuminance. \[lx\]
    sum: f64,
    place: F,
}

impl<F: FnMut(usize, [f64; 2], f64)> Collector for Falling<'_, F> {
    fn sky(&mut self, towards: DVec3, counts: f64) {
        self.sum += counts * self.scenery.open.sky_luminance(towards);
    }

    fn skyline(&mut self, counts: f64) {
        let flat = self.scenery.open.skyline_luminance();
        self.sum += counts * self.scenery.skyline.map_or(flat, |skyline| skyline.luminance);
    }

    fn stated(&mut self, luminance: f64, counts: f64) {
        self.sum += counts * luminance;
    }

    fn place(&mut self, surface: usize, at: [f64; 2], counts: f64) {
        (self.place)(surface, at, counts);
    }

    fn sunlit(&mut self, surface: usize, counts: f64) {
        self.sum += counts * self.scenery.surfaces[surface].sun;
    }
}

/// View from a point of a surface: the bodies in front of it, and whether the ground is visible.
pub(super) struct Vista<'a> {
    scenery: &'a Scenery<'a>,
    eye: DVec3,
    normal: DVec3,
    bodies: Vec<Body<'a>>,
    sees_ground: bool,
}

/// Returns an angle shifted by full turns into −π … π.
fn turned(angle: f64) -> f64 {
    angle - 2.0 * PI * (angle / (2.0 * PI)).round()
}

fn bearing(v: DVec2) -> f64 {
    v.x.atan2(v.y)
}

impl<'a> Vista<'a> {
    /// Creates the view from the point `eye` (world's axes) of the surface with index `surface`.
    pub fn new(scenery: &'a Scenery<'a>, surface: usize, eye: DVec3) -> Self {
        let normal = scenery.surfaces[surface].face.normal;
        let mut known: Vec<(f64, Body<'a>)> = scenery
            .others(surface)
            .filter(|(_, solid)| solid.corners().iter().any(|corner| normal.dot(*corner - eye) > 1e-9))
            .map(|(index, solid)| {
                let to = solid.middle() - eye;
                let aside = to.truncate();
                // Along the outline of the box.
                let reach = solid.outline_radius() / aside.length();
                let reach = if reach < 1.0 { reach.asin() + 1e-9 } else { PI };
                (solid.radius() / to.length(), Body { index, solid, bearing: bearing(aside), reach })
            })
            .collect();
        known.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut left_out = 0.0;
        while let Some((sine, _)) = known.last()
            && *sine < SMALL
        {
            left_out += sine * sine;
            if left_out > LEFT_OUT {
                break;
            }
            known.pop();
        }
        let bodies = known.into_iter().map(|(_, body)| body).collect();
        let sees_ground = surface != scenery.ground() && normal.z < 1.0 - 1e-9;
        Self { scenery, eye, normal, bodies, sees_ground }
    }

    /// Computes the illuminance of the point that does not depend on the smooth luminance of surfaces: by sky, skyline,
    /// surfaces of given luminance and directly reflected sunlight. \[lx\] `place` is called for pieces of reflecting
    /// surfaces with the index of the surface, the coordinates on it \[m\] and the projected solid angle \[sr\].
    pub fn gather(&self, place: impl FnMut(usize, [f64; 2], f64)) -> f64 {
        let mut falling = Falling { scenery: self.scenery, sum: 0.0, place };
        self.collect(&mut falling);
        falling.sum
    }

    /// Calls `collector` with everything that is visible from the point.
    pub fn collect(&self, collector: &mut impl Collector) {
        // Faces are vertical or horizontal: a wall sees half of all bearings.
        let vertical = self.normal.z.abs() < 1e-9;
        let (middle, half) = if vertical { (bearing(self.normal.truncate()), FRAC_PI_2) } else { (0.0, PI) };
        let mut knots: Vec<f64> = (0..=4).map(|k| (0.5 * f64::from(k) - 1.0) * half).collect();
        let open = self.scenery.open;
        let sectors = if open.is_piecewise_constant() { sector_bearings() } else { Vec::new() };
        let skyline = self.scenery.skyline.iter().flat_map(|skyline| skyline.corners());
        let others = skyline.chain(self.peak()).map(|way| bearing(way.truncate())).chain(sectors);
        let corners = self.bodies.iter().take(WITH_KNOTS).flat_map(|body| body.solid.corners().into_iter().take(4));
        let corners = corners.map(|corner| bearing((corner - self.eye).truncate()));
        knots.extend(others.chain(corners).map(|at| turned(at - middle)).filter(|at| at.abs() < half));
        knots.sort_unstable_by(f64::total_cmp);
        knots.dedup_by(|a, b| *a - *b < 1e-7);
        let mut line = Line::default();
        for pair in knots.windows(2) {
            let count = ((pair[1] - pair[0]) / PIECE).ceil();
            let step = (pair[1] - pair[0]) / count;
            let points = 1 + POINTS.iter().filter(|length| step >= **length).count();
            for k in 0..count as usize {
                for &(x, share) in rule(points) {
                    let at = middle + pair[0] + (k as f64 + x) * step;
                    self.along(at, share * step, &mut line, collector);
                }
            }
        }
    }

    fn peak(&self) -> Option<DVec3> {
        self.scenery.open.sun_direction().map(crate::compute::direction::Dir::vector)
    }

    /// Returns the interval of altitudes in front of the surface's plane along a bearing; `None` if it is empty.
    fn free(&self, along: DVec2) -> Option<[f64; 2]> {
        let (level, up) = (self.normal.truncate().dot(along), self.normal.z);
        if up > 1e-9 {
            Some([(-level / up).atan(), FRAC_PI_2])
        } else if up < -1e-9 {
            Some([-FRAC_PI_2, (-level / up).atan()])
        } else {
            (level > 0.0).then_some([-FRAC_PI_2, FRAC_PI_2])
        }
    }

    /// Calls `collector` with everything along one bearing, which represents a range of bearings of `width`. \[rad\]
    fn along(&self, at: f64, width: f64, line: &mut Line, collector: &mut impl Collector) {
        let (sin, cos) = at.sin_cos();
        let along = DVec2::new(sin, cos);
        let Some([low, high]) = self.free(along) else { return };
        line.stretches.clear();
        for body in &self.bodies {
            if turned(at - body.bearing).abs() <= body.reach {
                self.add(body, along, &mut line.stretches);
            }
        }
        let ground = self.scenery.ground_height() - self.eye.z;
        if self.sees_ground {
            let surface = self.scenery.ground();
            let place = Place::Level(ground.min(-1e-9));
            line.stretches.push(Stretch { low: -FRAC_PI_2, high: 0.0, surface, place });
        }
        let top = self.scenery.skyline.map_or(0.0, |skyline| skyline.altitude(at));
        let top = top.max(self.scenery.open.skyline_altitude());
        line.breaks.clear();
        let ends = line.stretches.iter().flat_map(|stretch| [stretch.low, stretch.high]);
        line.breaks.extend(ends.chain([low, high, 0.0, top]).filter(|end| *end >= low && *end <= high));
        line.breaks.sort_unstable_by(f64::total_cmp);
        for pair in 1..line.breaks.len() {
            let (from, to) = (line.breaks[pair - 1], line.breaks[pair]);
            if to - from < 1e-12 {
                continue;
            }
            let middle = (0.5 * (from + to)).tan();
            let over = |stretch: &&Stretch| stretch.low < to - 1e-13 && stretch.high > from + 1e-13;
            let near = |stretch: &Stretch| stretch.place.distance(middle);
            let seen = line.stretches.iter().filter(over).min_by(|a, b| near(a).total_cmp(&near(b)));
            match seen {
                Some(seen) => {
                    let seen = *seen;
                    self.on_surface(&seen, along, [from, to], width, &mut line.shaded, collector);
                }
                None if to <= 0.0 => {}
                None if to <= top + 1e-13 => collector.skyline(width * self.between(along, from, to)),
                None => self.sky(along, [from, to], width, collector),
            }
        }
    }

    /// Adds the visible faces of a body along a bearing to `stretches`.
    fn add(&self, body: &Body<'_>, along: DVec2, stretches: &mut Vec<Stretch>) {
        let Some(([near, far], front)) = body.solid.passage(self.eye.truncate(), along) else { return };
        if far <= 0.0 {
            return;
        }
        let [foot, top] = body.solid.heights().map(|z| z - self.eye.z);
        let altitude = |above: f64, distance: f64| above.atan2(distance.max(0.0));
        let first = 6 * body.index;
        if near > 0.0 {
            let (low, high) = (altitude(foot, near), altitude(top, near));
            stretches.push(Stretch { low, high, surface: first + front, place: Place::Front(near) });
        }
        if top < 0.0 {
            let (low, high) = (altitude(top, near), altitude(top, far));
            stretches.push(Stretch { low, high, surface: first + 5, place: Place::Level(top) });
        }
        if foot > 0.0 {
            let (low, high) = (altitude(foot, far), altitude(foot, near));
            stretches.push(Stretch { low, high, surface: first + 4, place: Place::Level(foot) });
        }
    }

    /// Returns ∫ cos α (n·d) dα between two altitudes along a bearing: the projected solid angle per bearing.
    /// \[sr/rad\]
    fn between(&self, along: DVec2, from: f64, to: f64) -> f64 {
        let level = self.normal.truncate().dot(along);
        let of = |altitude: f64| {
            let (sin, cos) = altitude.sin_cos();
            0.5 * (level * (altitude + sin * cos) + self.normal.z * sin * sin)
        };
        (of(to) - of(from)).max(0.0)
    }

    /// Calls `collector` with the interval of one surface between two altitudes along a bearing.
    fn on_surface(
        &self,
        seen: &Stretch,
        along: DVec2,
        [from, to]: [f64; 2],
        width: f64,
        shaded: &mut Vec<[f64; 2]>,
        collector: &mut impl Collector,
    ) {
        let surface = &self.scenery.surfaces[seen.surface];
        if let Some(luminance) = surface.stated {
            collector.stated(luminance, width * self.between(along, from, to));
        }
        if surface.reflectance <= 0.0 {
            return;
        }
        let at = |altitude: f64| {
            let tangent = altitude.tan();
            let distance = seen.place.distance(tangent);
            let above = match seen.place {
                Place::Front(distance) => distance * tangent,
                Place::Level(above) => above,
            };
            surface.face.coordinates(self.eye + (distance * along).extend(above))
        };
        let level = self.normal.truncate().dot(along);
        for &(x, share) in rule(2 + ((to - from) / collector.step()) as usize) {
            let altitude = from + (to - from) * x;
            let (sin, cos) = altitude.sin_cos();
            let counts = share * (to - from) * cos * (level * cos + self.normal.z * sin);
            if counts > 0.0 {
                collector.place(seen.surface, at(altitude), width * counts);
            }
        }
        if surface.sun <= 0.0 {
            return;
        }
        // Coordinate along the line on the surface: the height on a vertical surface, the horizontal distance on a
        // horizontal one.
        let (origin, way, ends) = match seen.place {
            Place::Front(distance) => {
                let foot = surface.face.coordinates(self.eye + (distance * along).extend(0.0));
                (DVec2::from_array(foot), DVec2::Y, [from, to].map(|a| distance * a.tan()))
            }
            Place::Level(_) => {
                let start = surface.face.coordinates(self.eye);
                let next = surface.face.coordinates(self.eye + along.extend(0.0));
                let start = DVec2::from_array(start);
                let ends = [from, to].map(|a| seen.place.distance(a.tan()));
                (start, DVec2::from_array(next) - start, [ends[0].min(ends[1]), ends[0].max(ends[1])])
            }
        };
        shaded.clear();
        shaded.extend(surface.shadows.iter().filter_map(|shadow| through(shadow, origin, way, ends)));
        shaded.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        let altitude = |at: f64| match seen.place {
            Place::Front(distance) => at.atan2(distance),
            Place::Level(above) => above.atan2(at),
        };
        let (mut lit, mut done) = (0.0, ends[0]);
        let mut add = |from: f64, to: f64| {
            if to > from {
                let (a, b) = (altitude(from), altitude(to));
                lit += self.between(along, a.min(b), a.max(b));
            }
        };
        for &[dark, light] in &*shaded {
            add(done, dark);
            done = done.max(light);
        }
        add(done, ends[1]);
        collector.sunlit(seen.surface, width * lit);
    }

    /// Calls `collector` with the sky between two altitudes along a bearing.
    fn sky(&self, along: DVec2, [from, high]: [f64; 2], width: f64, collector: &mut impl Collector) {
        let steps = self.scenery.open.is_piecewise_constant();
        let peak = self.peak().map(|peak| peak.z.clamp(-1.0, 1.0).asin());
        let level = self.normal.truncate().dot(along);
        let mut low = from;
        while low < high {
            // Up to the next row of patches of a measured sky, or to the sun's altitude.
            let row = if steps { ((low / ROW_HEIGHT + 1e-9).floor() + 1.0) * ROW_HEIGHT } else { high };
            let next = peak.filter(|peak| *peak > low + 1e-9).map_or(row, |peak| row.min(peak)).min(high);
            if steps {
                let (sin, cos) = (0.5 * (low + next)).sin_cos();
                collector.sky((along * cos).extend(sin), width * self.between(along, low, next));
            } else {
                for &(x, share) in rule(3 + ((next - low) / IN_SKY) as usize) {
                    let (sin, cos) = (low + (next - low) * x).sin_cos();
                    let counts = share * (next - low) * cos * (level * cos + self.normal.z * sin).max(0.0);
                    collector.sky((along * cos).extend(sin), width * counts);
                }
            }
            low = next;
        }
    }
}

/// Buffers that are reused for all bearings.
#[derive(Default)]
struct Line {
    stretches: Vec<Stretch>,
    breaks: Vec<f64>,
    shaded: Vec<[f64; 2]>,
}

/// Returns the interval of a line, between two positions along it, that lies inside a convex, counter-clockwise
/// polygon; `None` if it is empty.
fn through(polygon: &[DVec2], origin: DVec2, way: DVec2, [mut from, mut to]: [f64; 2]) -> Option<[f64; 2]> {
    for (k, &corner) in polygon.iter().enumerate() {
        let side = polygon[(k + 1) % polygon.len()] - corner;
        // Inside: side × (origin + t way − corner) ≥ 0.
        let (at, slope) = (side.perp_dot(origin - corner), side.perp_dot(way));
        if slope.abs() < 1e-14 {
            if at < 0.0 {
                return None;
            }
        } else if slope > 0.0 {
            from = from.max(-at / slope);
        } else {
            to = to.min(-at / slope);
        }
        if from >= to {
            return None;
        }
    }
    Some([from, to])
}

#[cfg(test)]
mod tests;

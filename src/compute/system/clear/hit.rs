//! First border of a region that a beam meets, and the width over which the beam meets the same border. Coordinates of
//! a beam are c across it (to its left) and t along it, in periods of the section.
//!
//! A border is met from its region exactly when its start lies to the left of its end across the beam, so that the
//! border that a beam has just left needs no exception. Borders do not cross: which one is nearest changes only at
//! their ends.

use super::beam::{Axes, Front};
use super::section::{Edge, Plane, Region};
use glam::DVec2;

/// Distance below which two points of the section are the same. \[periods\] Above the rounding of f64 at the greatest
/// height, that of [`MOST_PERIODS`]: 20 000 · 2⁻⁵² ≈ 4e-12.
const SLACK: f64 = 1e-10;
/// Maximum number of periods along which grazing light is traced before it counts as lost. Chosen: in a section one
/// period deep this is light within 5e-5 rad of the plane, some 1e-9 of uniform light.
const MOST_PERIODS: i64 = 20_000;

/// Number of copies of an edge above which they are not tested one by one. Chosen: cost only, since both searches find
/// the same border.
const MANY_COPIES: i64 = 12;

/// Border of a region that a beam meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hit {
    /// Coordinate t of the border along the beam as a linear function of the coordinate c across it: value at c = 0
    /// \[periods\], and slope.
    line: [f64; 2],
    /// Coordinate c across the beam at which the border ends. \[periods\]
    end: f64,
    /// Unit normal of the border (outward, upward) that points against the beam.
    pub normal: DVec2,
    /// Index of the region behind the border.
    pub beyond: usize,
    /// Number of periods by which the copy of the border that was met lies above the original.
    pub copy: i64,
}

impl Hit {
    /// Creates the hit on copy `copy` of an edge that reaches from c = `ca` to c = `cb` across the beam, where its
    /// start lies at t = `ta` along the beam \[periods\] and t changes with c by `slope`.
    fn new(edge: &Edge, [ca, cb]: [f64; 2], ta: f64, slope: f64, copy: i64) -> Self {
        Self { line: [ta - ca * slope, slope], end: cb, normal: DVec2::from(edge.normal), beyond: edge.beyond, copy }
    }

    /// Returns the coordinate t along the beam at which the ray at c across the beam meets the border. \[periods\]
    pub fn at(&self, c: f64) -> f64 {
        self.line[0] + self.line[1] * c
    }
}

/// Returns the first and last copy (number of periods upward) of the region's edges that light can meet between the
/// heights `low` and `high`. \[periods\]
fn copies(region: &Region, low: f64, high: f64) -> (i64, i64) {
    let (first, last) = ((low - region.high[1]).ceil(), (high - region.low[1]).floor());
    let bound = MOST_PERIODS as f64;
    let centre = if low.is_finite() { low } else { high };
    let clip = |x: f64| x.clamp(centre - bound, centre + bound) as i64;
    (clip(first), clip(last))
}

/// Returns the interval of t along the beam in which the ray at c across the beam, followed from `t` on, lies within
/// the range of depths (outward coordinate) that the region's edges occupy; `None` if it never does. \[periods\]
fn inside(region: &Region, axes: &Axes, c: f64, t: f64) -> Option<[f64; 2]> {
    let z0 = c * axes.across.x;
    let dz = axes.along.x;
    let (mut from, mut to) = (t, f64::INFINITY);
    if dz.abs() < 1e-14 {
        let z = z0 + t * dz;
        return (z >= region.low[0] && z <= region.high[0]).then_some([from, to]);
    }
    let ends = [(region.low[0] - z0) / dz, (region.high[0] - z0) / dz];
    from = from.max(ends[0].min(ends[1]) - SLACK);
    to = to.min(ends[0].max(ends[1]) + SLACK);
    (from <= to).then_some([from, to])
}

/// Returns the first border of the region that the ray at c across the beam meets behind the front; `None` if it meets
/// none.
pub(super) fn nearest(region: &Region, axes: &Axes, front: &Front, c: f64) -> Option<Hit> {
    let start = front.at(c) - SLACK;
    let mut best: Option<(f64, Hit)> = None;
    for plane in &region.planes {
        if let Some(hit) = plane_hit(plane, axes) {
            let t = hit.at(c);
            if t > start && best.is_none_or(|(nearest, _)| t < nearest) {
                best = Some((t, hit));
            }
        }
    }
    if region.edges.is_empty() {
        return best.map(|(_, hit)| hit);
    }
    let Some([from, to]) = inside(region, axes, c, start) else { return best.map(|(_, hit)| hit) };
    let height = |t: f64| c * axes.across.y + t * axes.along.y;
    let rises = axes.along.y >= 0.0;
    let (first, last) = if region.confined {
        (0, 0)
    } else {
        let to = best.map_or(to, |(t, _)| to.min(t)).min(1e9);
        let (a, b) = (height(from), height(to));
        let range = copies(region, a.min(b), a.max(b));
        if rises {
            (range.0, range.1.min(range.0 + MOST_PERIODS))
        } else {
            (range.1, range.0.max(range.1 - MOST_PERIODS))
        }
    };
    if (last - first).abs() > MANY_COPIES {
        let range = [first.min(last), first.max(last)];
        for edge in &region.edges {
            if let Some((t, hit)) = first_copy(edge, axes, c, start, range)
                && best.is_none_or(|(nearest, _)| t < nearest)
            {
                best = Some((t, hit));
            }
        }
        return best.map(|(_, hit)| hit);
    }
    let mut copy = first;
    while if rises { copy <= last } else { copy >= last } {
        if let Some((t, _)) = best {
            // This copy begins behind what was found.
            let begins = copy as f64 + if rises { region.low[1] } else { region.high[1] };
            if !region.confined && (begins - height(t)) * if rises { 1.0 } else { -1.0 } > SLACK {
                break;
            }
        }
        let lift = copy as f64;
        let (dc, dt) = (lift * axes.across.y, lift * axes.along.y);
        for edge in &region.edges {
            let ca = edge.a[0] * axes.across.x + edge.a[1] * axes.across.y + dc;
            let cb = edge.b[0] * axes.across.x + edge.b[1] * axes.across.y + dc;
            if !(ca <= c && c < cb) {
                continue;
            }
            let ta = edge.a[0] * axes.along.x + edge.a[1] * axes.along.y + dt;
            let tb = edge.b[0] * axes.along.x + edge.b[1] * axes.along.y + dt;
            let slope = (tb - ta) / (cb - ca);
            let t = ta + (c - ca) * slope;
            if t > start && best.is_none_or(|(nearest, _)| t < nearest) {
                best = Some((t, Hit::new(edge, [ca, cb], ta, slope, copy)));
            }
        }
        copy += if rises { 1 } else { -1 };
    }
    best.map(|(_, hit)| hit)
}

/// Returns the first copy of an edge, among the copies `range`, that the ray at c across the beam meets beyond t =
/// `start`, with the t at which it does. The copies that the ray meets follow one another at equal distances, so that
/// they need not be tried one by one.
fn first_copy(edge: &Edge, axes: &Axes, c: f64, start: f64, range: [i64; 2]) -> Option<(f64, Hit)> {
    let across = |p: [f64; 2]| p[0] * axes.across.x + p[1] * axes.across.y;
    let along = |p: [f64; 2]| p[0] * axes.along.x + p[1] * axes.along.y;
    let (ca, cb) = (across(edge.a), across(edge.b));
    if cb <= ca {
        return None;
    }
    let (ta, tb) = (along(edge.a), along(edge.b));
    let slope = (tb - ta) / (cb - ca);
    // Distance of copy k: t + k·later.
    let (t, later) = (ta + (c - ca) * slope, axes.along.y - axes.across.y * slope);
    let [mut low, mut high] = sideways(range, axes, [c - cb, c - ca]);
    if later > 0.0 {
        low = low.max(((start - t) / later).floor());
    } else if later < 0.0 {
        high = high.min(((start - t) / later).ceil());
    }
    if low > high {
        return None;
    }
    let (low, high) = (low as i64, high as i64);
    // Rounding may take the first one or two out again.
    (0..(high - low + 1).min(4)).find_map(|k| {
        let copy = if later < 0.0 { high - k } else { low + k };
        let (dc, dt) = (copy as f64 * axes.across.y, copy as f64 * axes.along.y);
        let t = ta + dt + (c - ca - dc) * slope;
        let met = ca + dc <= c && c < cb + dc && t > start;
        met.then(|| (t, Hit::new(edge, [ca + dc, cb + dc], ta + dt, slope, copy)))
    })
}

/// Returns the first and last of the copies `range` whose displacement across the beam from copy 0 lies between the two
/// `distances` \[periods\], with one more at either end.
fn sideways(range: [i64; 2], axes: &Axes, distances: [f64; 2]) -> [f64; 2] {
    let [first, last] = range.map(|copy| copy as f64);
    let step = axes.across.y;
    if step.abs() < 1e-14 {
        return [first, last];
    }
    let [a, b] = distances.map(|distance| distance / step);
    [first.max(a.min(b).floor()), last.min(a.max(b).ceil())]
}

/// Returns the hit of a beam on a flat face; `None` if light with these axes does not meet that side of it.
fn plane_hit(plane: &Plane, axes: &Axes) -> Option<Hit> {
    let dz = axes.along.x;
    (dz * plane.seen_along > 1e-14).then(|| Hit {
        line: [plane.z / dz, -axes.across.x / dz],
        end: f64::INFINITY,
        normal: DVec2::new(-plane.seen_along, 0.0),
        beyond: plane.beyond,
        copy: 0,
    })
}

/// Returns the coordinate across the beam up to which, from `c` on, the beam meets the same border (`None`: no border),
/// at most the end of the front. \[periods\]
pub(super) fn extent(region: &Region, axes: &Axes, front: &Front, c: f64, hit: Option<&Hit>) -> f64 {
    let mut end = front.ends[1][0].min(hit.map_or(f64::INFINITY, |hit| hit.end));
    if region.edges.is_empty() || end <= c {
        return end;
    }
    let (first, last) = if region.confined {
        (0, 0)
    } else {
        // Heights of the corners of what the beam covers, as far as it has edges in it.
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for c in [c, end] {
            let begin = front.at(c);
            let [from, to] = match hit {
                Some(hit) => [begin, hit.at(c)],
                None => inside(region, axes, c, begin).unwrap_or([begin, begin]),
            };
            for t in [begin, from, to.min(1e9)] {
                let height = c * axes.across.y + t * axes.along.y;
                range = [range[0].min(height), range[1].max(height)];
            }
        }
        copies(region, range[0] - SLACK, range[1] + SLACK)
    };
    for edge in &region.edges {
        let ca0 = edge.a[0] * axes.across.x + edge.a[1] * axes.across.y;
        let cb0 = edge.b[0] * axes.across.x + edge.b[1] * axes.across.y;
        if cb0 <= ca0 {
            continue;
        }
        let [low, high] = if region.confined { [0.0; 2] } else { sideways([first, last], axes, [c - ca0, end - ca0]) };
        for copy in low as i64..=high as i64 {
            let lift = copy as f64;
            let (dc, dt) = (lift * axes.across.y, lift * axes.along.y);
            let (ca, cb) = (ca0 + dc, cb0 + dc);
            if !(ca > c + SLACK && ca < end) {
                continue;
            }
            let ta = edge.a[0] * axes.along.x + edge.a[1] * axes.along.y + dt;
            let tb = edge.b[0] * axes.along.x + edge.b[1] * axes.along.y + dt;
            // Compared a little inside: two borders often begin at the same corner.
            let near = (0.5 * (cb - ca)).min(1e-6);
            let (at, t) = (ca + near, ta + (tb - ta) * (near / (cb - ca)));
            if t > front.at(at) - SLACK && hit.is_none_or(|hit| t < hit.at(at)) {
                end = ca;
            }
        }
    }
    end
}

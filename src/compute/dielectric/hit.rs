//! What a beam meets first, and how far across it goes on meeting the same.
//!
//! A border is met from its region exactly when its start lies to the left of its end across the beam, so that
//! nothing needs to be said of the border that a beam has just left. Borders do not cross: which one is nearest
//! changes only at their ends.

use super::beam::{Axes, Front};
use super::section::{Plane, Region};
use glam::DVec2;

/// Places closer than this are the same. \[periods\]
const SLACK: f64 = 1e-10;
/// Periods that grazing light is followed along before it is given up.
const MOST_PERIODS: i64 = 20_000;

/// What was met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hit {
    /// Distance along the beam at both ends of `Self::range` is linear: value at c = 0, slope.
    line: [f64; 2],
    /// Where across the beam the border ends.
    end: f64,
    /// Unit normal against the beam (outward, upward).
    pub normal: DVec2,
    /// Region behind.
    pub beyond: usize,
    /// Period of the border that was met.
    pub copy: i64,
}

impl Hit {
    /// Distance along the beam at c.
    pub fn at(&self, c: f64) -> f64 {
        self.line[0] + self.line[1] * c
    }
}

/// Range of copies of the region's edges that light can meet between the given heights.
fn copies(region: &Region, low: f64, high: f64) -> (i64, i64) {
    let (first, last) = ((low - region.high[1]).ceil(), (high - region.low[1]).floor());
    let bound = MOST_PERIODS as f64;
    let centre = if low.is_finite() { low } else { high };
    let clip = |x: f64| x.clamp(centre - bound, centre + bound) as i64;
    (clip(first), clip(last))
}

/// Part of the ray at c, from t on, at the depths of the region's edges.
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

/// First border that the ray at c meets behind the front.
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
                best = Some((
                    t,
                    Hit {
                        line: [ta - ca * slope, slope],
                        end: cb,
                        normal: DVec2::from(edge.normal),
                        beyond: edge.beyond,
                        copy,
                    },
                ));
            }
        }
        copy += if rises { 1 } else { -1 };
    }
    best.map(|(_, hit)| hit)
}

/// The hit on a flat face, if light of this direction sees it.
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

/// How far from c on the beam meets what it meets there, up to the end of the front.
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
    for copy in first..=last {
        let lift = copy as f64;
        let (dc, dt) = (lift * axes.across.y, lift * axes.along.y);
        for edge in &region.edges {
            let ca = edge.a[0] * axes.across.x + edge.a[1] * axes.across.y + dc;
            if !(ca > c + SLACK && ca < end) {
                continue;
            }
            let cb = edge.b[0] * axes.across.x + edge.b[1] * axes.across.y + dc;
            if cb <= ca {
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

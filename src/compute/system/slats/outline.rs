//! Section of one slat as straight strips, each with the faces that light can meet. Lengths are in pitches of the
//! array.
//!
//! Coordinates are (outward, upward). A strip is oriented so that its first face looks to its left: the upper side of a
//! sheet, the outside of a solid slat. Every strip of the coarse division is halved; the coarse division is used to
//! estimate the error.

use super::arc::{Circle, Point};
use super::array::{SlatArray, Surface};
use super::profile::SlatProfile;

/// Straight piece of a slat's section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strip {
    /// Start of the strip.
    pub(super) a: Point,
    /// End of the strip.
    pub(super) b: Point,
    /// Unit normals, to the left, of the described (perhaps curved) section at both ends.
    pub(super) normals: [Point; 2],
    /// Indices of the faces to the left and to the right; `None` towards the inside of a solid slat.
    pub(super) faces: [Option<usize>; 2],
}

/// One side of a strip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Face {
    /// Finish of the face.
    pub(super) surface: Surface,
    /// Index of the face of the coarse division that it is part of.
    pub(super) coarse: usize,
}

/// Consecutive strips of one finish that form one straight line or one arc, treated as one for the tracing of rays.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Facet {
    /// Start of the facet.
    pub(super) a: Point,
    /// End of the facet.
    pub(super) b: Point,
    /// Unit normal to the left of the line from start to end.
    pub(super) left: Point,
    /// Index of the facet's first strip.
    pub(super) first: usize,
    /// Positions along the facet, as shares of its length, at which its strips end; rising to 1.
    pub(super) ends: Vec<f64>,
    /// Circle that the facet is part of, if it is an arc.
    pub(super) circle: Option<Circle>,
}

/// Consecutive facets within a bounding circle: rays that miss the circle miss them all.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Group {
    /// Range of indices of the group's facets.
    pub(super) facets: std::ops::Range<usize>,
    /// Centre of the bounding circle (outward, upward). \[pitches\]
    pub(super) centre: Point,
    /// Radius of the bounding circle. \[pitches\]
    pub(super) radius: f64,
}

/// Number of facets in a group. Chosen: cost only, no effect on results.
const GROUP: usize = 6;

impl Group {
    /// Creates the group of the facets `range` with its bounding circle.
    fn of(facets: &[Facet], range: std::ops::Range<usize>) -> Self {
        /// Number of chords of an arc whose ends are bounded; `bulge` covers the rest. Chosen: cost only, no effect on
        /// results.
        const ALONG: usize = 64;
        let on_arc = |circle: &Circle| (0..=ALONG).map(|k| circle.at(k as f64 / ALONG as f64)).collect();
        let of = |facet: &Facet| facet.circle.as_ref().map_or_else(|| vec![facet.a, facet.b], on_arc);
        let points: Vec<Point> = facets[range.clone()].iter().flat_map(of).collect();
        // Distance between an arc and its chords.
        let bulge = |circle: &Circle| circle.radius.abs() * (1.0 - (0.5 * circle.turn / ALONG as f64).cos());
        let bulge = facets[range.clone()].iter().filter_map(|f| f.circle.as_ref()).map(bulge).fold(0.0, f64::max);
        let middle = [0, 1].map(|axis: usize| {
            let at = || points.iter().map(|point| point[axis]);
            0.5 * (at().fold(f64::INFINITY, f64::min) + at().fold(f64::NEG_INFINITY, f64::max))
        });
        let radius = points.iter().map(|p| (p[0] - middle[0]).hypot(p[1] - middle[1])).fold(0.0, f64::max);
        // Beyond all rounding.
        Self { facets: range, centre: middle, radius: radius + bulge + 1e-6 }
    }
}

/// Section of a slat of an endless array: strips, faces and facets, with lengths in pitches.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SlatSection {
    /// Strips of the slat at the origin.
    pub(super) strips: Vec<Strip>,
    /// Faces of all strips, in the order of their indices.
    pub(super) faces: Vec<Face>,
    /// Facets: straight runs and arcs of strips.
    pub(super) facets: Vec<Facet>,
    /// Index of the facet of every strip.
    pub(super) facet_of: Vec<usize>,
    /// Groups of a few consecutive facets with their bounding circles.
    pub(super) groups: Vec<Group>,
    /// Number of faces of the coarse division.
    pub(super) coarse: usize,
    /// Whether the slats are solid; otherwise they are sheets.
    pub(super) solid: bool,
    /// Maximum distance of a slat that light from the slat at the origin may meet next, in whole pitches.
    pub(super) reach: i32,
}

/// Strip of the coarse division, before faces are numbered.
#[derive(Debug, Clone, Copy)]
struct CoarseStrip {
    a: Point,
    b: Point,
    normals: [Point; 2],
    left: Surface,
    right: Option<Surface>,
}

/// Returns the point at the share `share` of the way from one point to another.
pub(super) fn between(from: Point, to: Point, share: f64) -> Point {
    [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])]
}

/// Returns the unit vector to the left of the line from a to b; a zero vector where they coincide.
pub(super) fn left_of(a: Point, b: Point) -> Point {
    let (u, v) = (b[0] - a[0], b[1] - a[1]);
    let length = u.hypot(v);
    if length > 0.0 { [-v / length, u / length] } else { [0.0; 2] }
}

/// Returns the middle line of a slat's profile at tilt 0 from the inner to the outer edge, divided into at least
/// `parts` pieces: points \[m\], each with the unit normals before and after it.
fn middle(profile: &SlatProfile, parts: usize) -> Vec<(Point, [Point; 2])> {
    if let SlatProfile::Arc { width, rise } = profile {
        let half = 2.0 * (2.0 * rise.abs()).atan2(*width);
        return profile
            .polyline(parts)
            .into_iter()
            .enumerate()
            .map(|(k, point)| {
                let angle = half * (2.0 * k as f64 / parts as f64 - 1.0);
                // The normal of a hanging arc leans the other way.
                let normal = [angle.sin() * rise.signum(), angle.cos()];
                (point, [normal, normal])
            })
            .collect();
    }
    let mut corners = profile.polyline(parts);
    let (first, last) = (corners[0], corners[corners.len() - 1]);
    if last[0] < first[0] {
        corners.reverse();
    }
    let length = |pair: &[Point]| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
    let total: f64 = corners.windows(2).map(length).sum();
    let mut list: Vec<(Point, [Point; 2])> = vec![];
    for pair in corners.windows(2) {
        let normal = left_of(pair[0], pair[1]);
        let cuts = (parts as f64 * length(pair) / total - 1e-9).ceil().max(1.0) as usize;
        match list.last_mut() {
            Some(corner) => corner.1[1] = normal,
            None => list.push((pair[0], [normal, normal])),
        }
        list.extend((1..=cuts).map(|k| (between(pair[0], pair[1], k as f64 / cuts as f64), [normal, normal])));
    }
    list
}

/// Returns the line parallel to the middle line at the distance `offset` \[m\] to its left, mitred at corners.
fn beside(middle: &[(Point, [Point; 2])], offset: f64) -> Vec<Point> {
    let shift = |&(p, [m, n]): &(Point, [Point; 2])| {
        let scale = offset / (1.0 + m[0] * n[0] + m[1] * n[1]).max(0.1);
        [p[0] + scale * (m[0] + n[0]), p[1] + scale * (m[1] + n[1])]
    };
    middle.iter().map(shift).collect()
}

/// Rotates a vector from the axes of the slat at tilt 0 to the given tilt \[rad\]. Quarter turns are exact, so that
/// sheets which then lie in one plane coincide.
fn turned(tilt: f64, [u, v]: Point) -> Point {
    let (mut sin, mut cos) = tilt.sin_cos();
    if cos.abs() < 1e-12 {
        (sin, cos) = (sin.signum(), 0.0);
    }
    [u * cos + v * sin, v * cos - u * sin]
}

impl SlatArray {
    /// Returns the outline of one slat at its tilt, rotated about the origin, as (outward, upward) points \[m\]. A
    /// sheet is one open line, from the inner to the outer edge; a solid slat one closed polygon, its first point not
    /// repeated.
    pub fn outline(&self) -> Vec<Vec<[f64; 2]>> {
        vec![polygon(self, 32)]
    }
}

/// Returns the outline of a slat's section at its tilt, arcs divided into `parts` pieces: a sheet's line from the inner
/// to the outer edge, or the closed polygon of a solid slat with its first point not repeated. \[m\]
pub(super) fn polygon(array: &SlatArray, parts: usize) -> Vec<Point> {
    let line = middle(array.profile(), parts);
    let mut points = beside(&line, 0.5 * array.thickness());
    if array.thickness() > 0.0 {
        points.extend(beside(&line, -0.5 * array.thickness()).into_iter().rev());
    }
    points.into_iter().map(|p| turned(array.tilt(), p)).collect()
}

impl SlatSection {
    /// Creates the section of an array whose slats are divided into about `parts` coarse strips, each of them halved.
    pub(super) fn new(array: &SlatArray, parts: usize) -> Self {
        let mut list = coarse_parts(array, parts);
        for part in &mut list {
            for point in [&mut part.a, &mut part.b] {
                *point = turned(array.tilt(), *point).map(|x| x / array.spacing());
            }
            part.normals = part.normals.map(|n| turned(array.tilt(), n));
        }
        let solid = array.thickness() > 0.0;
        let upward = list.iter().flat_map(|part| [part.a[1], part.b[1]]);
        let (low, high) = upward.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        // Between slats whose heights do not overlap lies another one; where every slat is the graph of a function
        // of the depth, the next is always a neighbour.
        let graph = !solid && list.iter().all(|part| part.b[0] - part.a[0] > 1e-12);
        let reach = if graph { 1 } else { (2.0 * (high - low).ceil()).max(1.0) as i32 };
        let list = split_at_crossings(list, reach);

        let mut section = Self {
            strips: vec![],
            faces: vec![],
            facets: vec![],
            facet_of: vec![],
            groups: vec![],
            coarse: 0,
            solid,
            reach,
        };
        for part in list {
            let sides = [Some(part.left), part.right];
            let coarse = sides.map(|side| {
                side.map(|surface| {
                    section.coarse += 1;
                    (surface, section.coarse - 1)
                })
            });
            let middle = between(part.a, part.b, 0.5);
            let bent = between(part.normals[0], part.normals[1], 0.5);
            let size = bent[0].hypot(bent[1]).max(f64::MIN_POSITIVE);
            let bent = bent.map(|x| x / size);
            for (a, b, normals) in
                [(part.a, middle, [part.normals[0], bent]), (middle, part.b, [bent, part.normals[1]])]
            {
                let faces = coarse.map(|side| {
                    side.map(|(surface, coarse)| {
                        section.faces.push(Face { surface, coarse });
                        section.faces.len() - 1
                    })
                });
                section.strips.push(Strip { a, b, normals, faces });
            }
        }
        section.facets = section.runs();
        let strips_of = |(index, facet): (usize, &Facet)| std::iter::repeat_n(index, facet.ends.len());
        section.facet_of = section.facets.iter().enumerate().flat_map(strips_of).collect();
        let count = section.facets.len();
        let groups = (0..count).step_by(GROUP).map(|k| Group::of(&section.facets, k..(k + GROUP).min(count)));
        section.groups = groups.collect();
        section
    }

    /// Whether any of the mirrors is rough, i.e. spreads light.
    pub(super) fn rough(&self) -> bool {
        self.faces.iter().any(|face| face.surface.mirror > 0.0 && face.surface.spread > 0.0)
    }

    /// Joins strips that rays need not distinguish into facets, so that a ray is tested against a few facets instead of
    /// all strips.
    fn runs(&self) -> Vec<Facet> {
        let mut runs: Vec<std::ops::Range<usize>> = vec![];
        for (k, strip) in self.strips.iter().enumerate() {
            match runs.last_mut() {
                Some(run) if self.continues(&self.strips[k - 1], strip) => run.end = k + 1,
                _ => runs.push(k..k + 1),
            }
        }
        runs.into_iter().map(|run| self.facet(run)).collect()
    }

    /// Whether a strip continues the straight line or the arc of the strip before it.
    fn continues(&self, before: &Strip, strip: &Strip) -> bool {
        // Both halves of a strip, and strips cut at crossings, have faces of their own: what counts is their finish.
        let finish = |strip: &Strip| strip.faces.map(|face| face.map(|face| self.faces[face].surface));
        let bent = |strip: &Strip| strip.normals[0] != strip.normals[1];
        let (m, n) = (left_of(before.a, before.b), left_of(strip.a, strip.b));
        let joined = (before.b[0] - strip.a[0]).hypot(before.b[1] - strip.a[1]) < 1e-12;
        let straight = (m[0] - n[0]).hypot(m[1] - n[1]) < 1e-9 && !(bent(before) || bent(strip));
        // Chords of an arc turn from strip to strip, its normals do not jump.
        let [p, q] = [before.normals[1], strip.normals[0]];
        let round = bent(before) && bent(strip) && (p[0] - q[0]).hypot(p[1] - q[1]) < 1e-9;
        joined && (straight || round) && finish(before) == finish(strip)
    }

    /// Creates the facet of the consecutive strips `run`.
    fn facet(&self, run: std::ops::Range<usize>) -> Facet {
        let (first, last) = (&self.strips[run.start], &self.strips[run.end - 1]);
        let (a, b) = (first.a, last.b);
        let circle = Circle::of(a, b, [first.normals[0], last.normals[1]]);
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        // Measure along the facet by which rays locate a strip: the turn of the normal on an arc, else the length.
        let end = |strip: &Strip| {
            let along = || (strip.b[0] - a[0]).hypot(strip.b[1] - a[1]) / length;
            circle.map_or_else(along, |circle| circle.share(strip.normals[1]))
        };
        Facet { a, b, left: left_of(a, b), first: run.start, ends: self.strips[run].iter().map(end).collect(), circle }
    }
}

/// Returns the strips of the coarse division of a slat at tilt 0, lengths in metres.
fn coarse_parts(array: &SlatArray, parts: usize) -> Vec<CoarseStrip> {
    let line = middle(array.profile(), parts);
    let along = |points: &[Point], side: f64, left: Surface, right: Option<Surface>| {
        let normals = |k: usize| [line[k].1[1], line[k + 1].1[0]].map(|n| n.map(|x| side * x));
        (0..points.len() - 1)
            .map(|k| CoarseStrip { a: points[k], b: points[k + 1], normals: normals(k), left, right })
            .collect::<Vec<_>>()
    };
    let half = 0.5 * array.thickness();
    let above = beside(&line, half);
    if half == 0.0 {
        return along(&above, 1.0, array.upper(), Some(array.lower()));
    }
    let below = beside(&line, -half);
    let edge = array.edge();
    let end = |a: Point, b: Point| {
        let normal = left_of(a, b);
        CoarseStrip { a, b, normals: [normal, normal], left: edge, right: None }
    };
    let mut list = along(&above, 1.0, array.upper(), None);
    list.push(end(above[above.len() - 1], below[below.len() - 1]));
    let lower = along(&below, -1.0, array.lower(), None);
    list.extend(lower.into_iter().rev().map(|part| CoarseStrip {
        a: part.b,
        b: part.a,
        normals: [part.normals[1], part.normals[0]],
        ..part
    }));
    list.push(end(below[0], above[0]));
    list
}

/// Returns the positions, as shares of their lengths, at which the strips `p` and `q` (raised by `lift`) cross; `None`
/// if they do not.
fn crossing(p: &CoarseStrip, q: &CoarseStrip, lift: f64) -> Option<(f64, f64)> {
    let (e, f) = ([p.b[0] - p.a[0], p.b[1] - p.a[1]], [q.b[0] - q.a[0], q.b[1] - q.a[1]]);
    let across = e[0] * f[1] - e[1] * f[0];
    if across.abs() < 1e-14 {
        return None;
    }
    let w = [q.a[0] - p.a[0], q.a[1] + lift - p.a[1]];
    let (s, t) = ((w[0] * f[1] - w[1] * f[0]) / across, (w[0] * e[1] - w[1] * e[0]) / across);
    ((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t)).then_some((s, t))
}

/// Returns the position of a point along a strip, as a share of the strip's length; `None` if the point is not on its
/// line.
fn on_way(way: &CoarseStrip, point: Point) -> Option<f64> {
    let (e, w) = ([way.b[0] - way.a[0], way.b[1] - way.a[1]], [point[0] - way.a[0], point[1] - way.a[1]]);
    let square = e[0] * e[0] + e[1] * e[1];
    let off = (e[0] * w[1] - e[1] * w[0]).abs() / square.sqrt();
    (off < 1e-9).then_some((e[0] * w[0] + e[1] * w[1]) / square)
}

/// Splits strips where slats run through their neighbours (closed curved slats) and where they begin to lie upon them
/// (closed flat slats), so that the order of strips along a line of sight never changes within one.
fn split_at_crossings(list: Vec<CoarseStrip>, reach: i32) -> Vec<CoarseStrip> {
    let mut cuts: Vec<Vec<f64>> = vec![vec![]; list.len()];
    for (i, p) in list.iter().enumerate() {
        for (j, q) in list.iter().enumerate() {
            for copy in 1..=reach {
                let lift = f64::from(copy);
                if let Some((s, t)) = crossing(p, q, lift) {
                    cuts[i].push(s);
                    cuts[j].push(t);
                }
                for end in [0.0, 1.0] {
                    let (from, to) = (between(p.a, p.b, end), between(q.a, q.b, end));
                    cuts[j].extend(on_way(q, [from[0], from[1] - lift]));
                    cuts[i].extend(on_way(p, [to[0], to[1] + lift]));
                }
            }
        }
    }
    let mut out = Vec::with_capacity(list.len());
    for (part, mut cuts) in list.into_iter().zip(cuts) {
        cuts.retain(|&s| s > 1e-9 && s < 1.0 - 1e-9);
        cuts.push(0.0);
        cuts.push(1.0);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
        for pair in cuts.windows(2) {
            let at = |s: f64| between(part.a, part.b, s);
            let normal = |s: f64| between(part.normals[0], part.normals[1], s);
            out.push(CoarseStrip {
                a: at(pair[0]),
                b: at(pair[1]),
                normals: [normal(pair[0]), normal(pair[1])],
                ..part
            });
        }
    }
    out
}

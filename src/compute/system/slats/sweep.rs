//! Sweep over all parallel lines of one direction through the section of slats: which strips they meet, in which order.
//!
//! Seen along the direction (cosψ, sinψ), the ends of all strips divide the lines into bundles that meet the same
//! strips. A bundle of width dt that leaves one face and next meets another adds dt dψ / 2 to their exchange: equal
//! both ways, so that the exchange is symmetric whatever the division of ψ. Bundles that leave the last slat, or reach
//! the first, are those of parallel light from outside and inside.

use super::arc::Point;
use super::outline::SlatSection;

/// Face of a slat that a line meets: strip and face in the section, and which slat of the array.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Met {
    /// Index of the strip in the section.
    pub(super) strip: usize,
    /// Number of the slat in the array, counted upwards from 0 for the one at the origin.
    pub(super) copy: i32,
    /// Index of the face in the section.
    pub(super) face: usize,
}

/// Bundle of parallel lines that leave the face `from` (or come from the inside) in the direction (cosψ, sinψ) and next
/// meet the face `to` (or leave to the outside). At least one of the two is a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bundle {
    /// Width of the bundle perpendicular to its direction. \[pitches\]
    pub(super) width: f64,
    /// Distance of the bundle's middle line from the origin, positive to the left of its direction. \[pitches\]
    pub(super) across: f64,
    /// Face that the bundle leaves; `None` if it comes from the inside.
    pub(super) from: Option<Met>,
    /// Face that the bundle meets next; `None` if it leaves to the outside.
    pub(super) to: Option<Met>,
}

/// Strip of a slat as seen along the direction of a sweep.
#[derive(Debug, Clone, Copy)]
struct StripView {
    strip: usize,
    copy: i32,
    low: f64,
    high: f64,
    /// Depth of the strip along the direction at `low` \[pitches\]; `slope` is its change per width.
    depth: f64,
    slope: f64,
    /// Index of the face that looks against the direction; `along` is that of the face that looks along it.
    against: Option<usize>,
    along: Option<usize>,
}

/// Width below which a bundle is a rounding error. \[pitches\] Some 450 roundings of f64 (2⁻⁵² ≈ 2.2e-16) of one pitch.
const NARROW: f64 = 1e-13;
/// Distance along a line below which two sheets count as touching; the lower slat then is taken as the inner one.
/// \[pitches\] Above all rounding of f64, and 0.1 nm at a pitch of 0.1 m.
const TOUCHING: f64 = 1e-9;

/// Returns the coordinates of a point with respect to the direction (cos, sin): distance to its left, and along it.
pub(super) fn place([u, v]: Point, [cos, sin]: Point) -> (f64, f64) {
    (v * cos - u * sin, u * cos + v * sin)
}

/// Returns the strips of all slats that lines through one slat can meet, as seen along the direction, with the lower
/// and upper limit of one slat across it. \[pitches\]
fn seen_strips(section: &SlatSection, direction: Point) -> (Vec<StripView>, f64, f64) {
    let own: Vec<StripView> = section
        .strips
        .iter()
        .enumerate()
        .filter_map(|(strip, s)| {
            let ((ta, da), (tb, db)) = (place(s.a, direction), place(s.b, direction));
            let rising = tb > ta;
            let (low, high, depth, end) = if rising { (ta, tb, da, db) } else { (tb, ta, db, da) };
            // The left normal of a way that rises across the direction looks against it.
            let [left, right] = s.faces;
            let (against, along) = if rising { (left, right) } else { (right, left) };
            (high - low > NARROW).then(|| StripView {
                strip,
                copy: 0,
                low,
                high,
                depth,
                slope: (end - depth) / (high - low),
                against,
                along,
            })
        })
        .collect();
    let low = own.iter().map(|s| s.low).fold(f64::INFINITY, f64::min);
    let high = own.iter().map(|s| s.high).fold(f64::NEG_INFINITY, f64::max);
    let [cos, sin] = direction;
    let mut all = Vec::with_capacity(3 * own.len());
    for copy in -section.reach..=section.reach {
        let (shift, deeper) = (f64::from(copy) * cos, f64::from(copy) * sin);
        all.extend(own.iter().filter(|s| s.high + shift > low && s.low + shift < high).map(|s| StripView {
            copy,
            low: s.low + shift,
            high: s.high + shift,
            depth: s.depth + deeper,
            ..*s
        }));
    }
    (all, low, high)
}

/// Calls `visit` for every bundle of lines of the direction within one pitch that leaves or meets a slat, in a fixed
/// order.
pub(super) fn sweep(section: &SlatSection, direction: Point, mut visit: impl FnMut(Bundle)) {
    let (seen, low, high) = seen_strips(section, direction);
    let mut events: Vec<(f64, bool, usize)> = Vec::with_capacity(2 * seen.len());
    for (index, s) in seen.iter().enumerate() {
        events.push((s.low.max(low), true, index));
        events.push((s.high.min(high), false, index));
    }
    events.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut active: Vec<(f64, usize)> = vec![];
    for (position, &(from, starts, index)) in events.iter().enumerate() {
        if starts {
            active.push((0.0, index));
        } else {
            active.retain(|&(_, other)| other != index);
        }
        let Some(&(to, ..)) = events.get(position + 1) else { break };
        if to - from <= NARROW || active.is_empty() {
            continue;
        }
        let across = 0.5 * (from + to);
        for (depth, index) in &mut active {
            let s = &seen[*index];
            *depth = s.depth + s.slope * (across - s.low);
        }
        sort_by_depth(&mut active, &seen);
        along_line(section.solid, active.iter().map(|&(_, index)| &seen[index]), |from, to| {
            let own = |met: Option<Met>| met.is_some_and(|met| met.copy == 0);
            if own(from) || (from.is_none() && own(to)) {
                visit(Bundle { width: events[position + 1].0 - events[position].0, across, from, to });
            }
        });
    }
}

/// Sorts the strips that a line meets by depth: by insertion, since the order of one bundle is nearly that of the next.
fn sort_by_depth(active: &mut [(f64, usize)], seen: &[StripView]) {
    let before = |a: &(f64, usize), b: &(f64, usize)| {
        if (a.0 - b.0).abs() > TOUCHING { a.0 < b.0 } else { seen[a.1].copy < seen[b.1].copy }
    };
    for k in 1..active.len() {
        let mut at = k;
        while at > 0 && before(&active[at], &active[at - 1]) {
            active.swap(at, at - 1);
            at -= 1;
        }
    }
}

/// Calls `pair` for each piece of a line between two strips, with the face that the line leaves and the face that it
/// meets next (`None`: outside or inside).
fn along_line<'a>(
    solid: bool,
    order: impl Iterator<Item = &'a StripView>,
    mut pair: impl FnMut(Option<Met>, Option<Met>),
) {
    let met = |s: &StripView, face: Option<usize>| face.map(|face| Met { strip: s.strip, copy: s.copy, face });
    let mut open = None;
    let mut inside = 0;
    for s in order {
        if solid {
            // Slats that run into each other are one body.
            if s.against.is_some() {
                if inside == 0 {
                    pair(open, met(s, s.against));
                }
                inside += 1;
            } else {
                inside -= 1;
                if inside == 0 {
                    open = met(s, s.along);
                }
            }
        } else {
            pair(open, met(s, s.against));
            open = met(s, s.along);
        }
    }
    if open.is_some() {
        pair(open, None);
    }
}

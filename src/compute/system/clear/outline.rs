//! Outlines of clear bodies in section, and their checks: closed or periodic, not crossing themselves, each other or
//! their neighbours one period up.

/// Outline of a clear body in the vertical section, by points (outward, upward). \[m\]
#[derive(Debug, Clone, PartialEq)]
pub enum Outline {
    /// Closed polygon, in either sense of rotation; it may be higher than a period if its periodic copies do not touch.
    Closed(Vec<[f64; 2]>),
    /// Sheet that extends over all periods, between two faces that each rise by one period from their first to their
    /// last point.
    Sheet {
        /// Outer face: polyline of (outward, upward) points over one period. \[m\]
        outer: Vec<[f64; 2]>,
        /// Inner face, towards the room: polyline of (outward, upward) points over one period. \[m\]
        inner: Vec<[f64; 2]>,
    },
}

/// Error in the outlines or materials of clear bodies. Indices of bodies count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum OutlineError {
    /// Vertical period that is not a positive, finite length. \[m\]
    #[error("a period of {0} m: above 0 is needed")]
    Period(f64),
    /// Refractive index of a body out of range.
    #[error("body {body}: refractive index {index}: 1 to 4 is needed")]
    Index {
        /// Index of the body.
        body: usize,
        /// Refractive index of the body.
        index: f64,
    },
    /// Absorption coefficient of a body that is negative or not finite.
    #[error("body {body}: absorption of {absorption} 1/m: 0 or more is needed")]
    Absorption {
        /// Index of the body.
        body: usize,
        /// Absorption coefficient of the body. \[1/m\]
        absorption: f64,
    },
    /// Outline with too few or too many points, or with coordinates that are not finite.
    #[error(
        "body {body}: {points} points (3 to 2000 finite ones that enclose an area; 2 and more for the faces of a sheet)"
    )]
    Points {
        /// Index of the body.
        body: usize,
        /// Number of points of the body.
        points: usize,
    },
    /// Face of a sheet that does not end at the depth where it begins, one period higher.
    #[error("body {body}: a face of a sheet must end one period above its beginning, at the same depth")]
    Face {
        /// Index of the body.
        body: usize,
    },
    /// Outlines of two bodies (by their indices) whose edges cross or overlap.
    #[error("bodies {0} and {1}: edges cross or touch (a body and its neighbours one period away included)")]
    Crossing(usize, usize),
    /// Two bodies, by their indices, of which one lies inside the other; or a sheet, both indices equal, whose outer
    /// face lies on the room side of its inner face.
    #[error("bodies {0} and {1}: one lies inside the other, or the faces of a sheet are exchanged")]
    Nested(usize, usize),
    /// Flank angles of a prism that enclose no area. \[°\]
    #[error("flank angles of {0}° and {1}°: above 0, at most 90, not both 90")]
    Flanks(f64, f64),
}

/// Returns the edges of a body within one period, each by its start and end (outward, upward), in the unit of the
/// outline.
pub(super) fn edges(outline: &Outline) -> Vec<[[f64; 2]; 2]> {
    let open = |points: &[[f64; 2]]| points.windows(2).map(|pair| [pair[0], pair[1]]).collect::<Vec<_>>();
    match outline {
        Outline::Closed(points) => {
            let mut list = open(points);
            list.push([points[points.len() - 1], points[0]]);
            list
        }
        Outline::Sheet { outer, inner } => [open(outer), open(inner)].concat(),
    }
}

/// Returns twice the signed area of a closed outline, in the squared unit of its points; positive if the points
/// (outward, upward) run counter-clockwise.
pub(super) fn area2(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum()
}

fn side(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// Whether two edges cross or overlap, that is have more in common than a shared end (to within `slack`).
fn meet(a: [[f64; 2]; 2], b: [[f64; 2]; 2], slack: f64) -> bool {
    let are_disjoint = |axis: usize| {
        let range = |e: [[f64; 2]; 2]| (e[0][axis].min(e[1][axis]), e[0][axis].max(e[1][axis]));
        let ((a0, a1), (b0, b1)) = (range(a), range(b));
        a1 < b0 - slack || b1 < a0 - slack
    };
    if are_disjoint(0) || are_disjoint(1) {
        return false;
    }
    let length = |e: [[f64; 2]; 2]| (e[1][0] - e[0][0]).hypot(e[1][1] - e[0][1]);
    let (la, lb) = (length(a), length(b));
    // Distances of the ends of one from the line of the other.
    let (d0, d1) = (side(a[0], a[1], b[0]) / la, side(a[0], a[1], b[1]) / la);
    let (e0, e1) = (side(b[0], b[1], a[0]) / lb, side(b[0], b[1], a[1]) / lb);
    let opposite = |x: f64, y: f64| (x > slack && y < -slack) || (x < -slack && y > slack);
    if opposite(d0, d1) && opposite(e0, e1) {
        return true;
    }
    // An end of one inside the other.
    let inside = |p: [f64; 2], e: [[f64; 2]; 2], off: f64, l: f64| {
        let along = ((p[0] - e[0][0]) * (e[1][0] - e[0][0]) + (p[1] - e[0][1]) * (e[1][1] - e[0][1])) / l;
        off.abs() <= slack && along > slack && along < l - slack
    };
    inside(b[0], a, d0, la) || inside(b[1], a, d1, la) || inside(a[0], b, e0, lb) || inside(a[1], b, e1, lb)
}

/// Whether the point `p` (outward, upward) is inside a closed outline.
fn holds(points: &[[f64; 2]], p: [f64; 2]) -> bool {
    let next = points.iter().cycle().skip(1);
    let crossed = points
        .iter()
        .zip(next)
        .filter(|(a, b)| (a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]));
    crossed.count() % 2 == 1
}

/// Returns the depth (outward coordinate) of a periodic face at the height `y`; the outermost one where it has several.
fn depth(face: &[[f64; 2]], y: f64, period: f64) -> f64 {
    let y = face[0][1] + (y - face[0][1]).rem_euclid(period);
    let crossing = face.windows(2).filter(|e| (e[0][1].min(e[1][1])..=e[0][1].max(e[1][1])).contains(&y));
    crossing
        .map(|e| {
            let rise = e[1][1] - e[0][1];
            if rise == 0.0 { e[0][0].max(e[1][0]) } else { e[0][0] + (y - e[0][1]) * (e[1][0] - e[0][0]) / rise }
        })
        .fold(f64::NEG_INFINITY, f64::max)
}

/// Whether the point `p` (outward, upward) is inside a body or one of its copies one period up and down.
fn within(outline: &Outline, p: [f64; 2], period: f64) -> bool {
    match outline {
        Outline::Closed(points) => {
            let range = points.iter().fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p[1]), high.max(p[1])));
            let (first, last) = (((p[1] - range.1) / period).ceil() as i64, ((p[1] - range.0) / period).floor() as i64);
            (first..=last).any(|k| holds(points, [p[0], p[1] - k as f64 * period]))
        }
        Outline::Sheet { outer, inner } => p[0] < depth(outer, p[1], period) && p[0] > depth(inner, p[1], period),
    }
}

/// Checks the outlines of the bodies of one period: points, faces, crossings and nesting.
pub(super) fn check(outlines: &[&Outline], period: f64) -> Result<(), OutlineError> {
    if !(period > 0.0 && period.is_finite()) {
        return Err(OutlineError::Period(period));
    }
    let slack = 1e-9 * period;
    for (body, outline) in outlines.iter().enumerate() {
        let faces: Vec<&[[f64; 2]]> = match outline {
            Outline::Closed(points) => vec![points],
            Outline::Sheet { outer, inner } => vec![outer, inner],
        };
        for points in faces {
            let closed = matches!(outline, Outline::Closed(_));
            let enough = (if closed { 3..=2000 } else { 2..=2000 }).contains(&points.len());
            let sane = points.iter().flatten().all(|x| x.is_finite() && x.abs() < 1e4 * period);
            let distinct =
                points.windows(2).all(|e| e[0] != e[1]) && (!closed || points[0] != points[points.len() - 1]);
            if !(enough && sane && distinct && (!closed || area2(points).abs() > slack * slack)) {
                return Err(OutlineError::Points { body, points: points.len() });
            }
            let (first, last) = (points[0], points[points.len() - 1]);
            if !closed && ((last[1] - first[1] - period).abs() > slack || (last[0] - first[0]).abs() > slack) {
                return Err(OutlineError::Face { body });
            }
        }
    }
    crossings(outlines, period, slack)?;
    for (i, one) in outlines.iter().enumerate() {
        for (j, other) in outlines.iter().enumerate() {
            let stray = if i == j {
                // The faces of a sheet in their order.
                matches!(one, Outline::Sheet { outer, inner } if depth(inner, outer[0][1], period) >= outer[0][0])
            } else {
                // Not only the corners: those of touching bodies may lie on the other's border.
                edges(other).iter().any(|[a, b]| within(one, [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])], period))
            };
            if stray {
                return Err(OutlineError::Nested(i, j));
            }
        }
    }
    Ok(())
}

/// Checks that no edge crosses or overlaps another one, or a copy of any.
fn crossings(outlines: &[&Outline], period: f64, slack: f64) -> Result<(), OutlineError> {
    let all: Vec<(usize, [[f64; 2]; 2])> = outlines
        .iter()
        .enumerate()
        .flat_map(|(body, outline)| edges(outline).into_iter().map(move |e| (body, e)))
        .collect();
    let span = |e: &[[f64; 2]; 2]| (e[0][1].min(e[1][1]), e[0][1].max(e[1][1]));
    for (i, (one, a)) in all.iter().enumerate() {
        for (j, (other, b)) in all.iter().enumerate().skip(i) {
            let ((a0, a1), (b0, b1)) = (span(a), span(b));
            let (first, last) = (((a0 - b1) / period).floor() as i64, ((a1 - b0) / period).ceil() as i64);
            for k in first..=last {
                let lift = k as f64 * period;
                let copy = b.map(|[z, y]| [z, y + lift]);
                if !(i == j && k == 0) && meet(*a, copy, slack) {
                    return Err(OutlineError::Crossing(*one, *other));
                }
            }
        }
    }
    Ok(())
}

//! Beams of direct sun behind a described system, whose transmission is computed for single directions: means over the
//! sun's disc.

use super::{BeamLight, Facing};
use crate::compute::direction::{Dir, Facade};
use crate::compute::sky::SUN_HALF_ANGLE;
use crate::compute::sky::sun_disc::Edge;
use crate::compute::system::measure::{Beam, OpticalModel, Side, Structure};
use glam::DVec3;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::OnceLock;

/// Distance below which two directions are the same. \[rad\] Far above the rounding of unit vectors, some 1e-16, and
/// far below the sun's disc.
const SAME: f64 = 1e-9;
/// Maximum angular length of a piece of a fan that counts as one beam: a fraction of the sun's width. \[rad\] Chosen:
/// cost; the error of such pieces is the second of [`TURNED`].
const PIECE: f64 = 0.15 * PI / 180.0;
/// Angular distance within which pieces of fans are merged. \[rad\] Chosen: cost; less than a fifth of the sun's width
/// of 0.53°, its effect is part of [`TURNED`].
const TOGETHER: f64 = 0.1 * PI / 180.0;
/// Remaining relative errors of the flux of redirected beams: by flat faces, whose share has kinks within the disc, and
/// in pieces of fans. Found by comparison with closed forms for 12 rooms behind flat and curved mirror slats.
const TURNED: [f64; 2] = [6e-4, 1.5e-3];
/// Numbers of pairs of directions over the disc for the undeviated beam through systems without a structure along an
/// axis, tried in this order until the beam's share changes by no more than [`STANDS`]. Chosen: cost; the last change
/// is stated as error.
const SEEDS: [usize; 4] = [16, 64, 256, MOST_SEEDS];
/// Maximum number of pairs of directions over the disc. Chosen: cost; see [`SEEDS`].
const MOST_SEEDS: usize = 1024;
/// Change at which the undeviated share counts as converged, relative to the share plus the first of [`LITTLE`]. A
/// tenth of the median error that `tests/scenes/sharp_sun::real_geometry` allows.
const STANDS: f64 = 1e-4;
/// Number of pairs of directions that replace the disc's middle where that does not represent the disc. Chosen: cost;
/// results change within their stated error, the difference to every other pair.
const PARTS: usize = 64;
/// Number of pairs of directions that show whether anything is redirected, and that scattered light is averaged over at
/// grazing incidence. Chosen: cost; the error of that average is stated, see `sun_through`.
pub(super) const FEW: usize = 3;
/// Numbers of strips of the disc, and of pairs of directions in all of them together, for systems that depend on a
/// profile angle alone: tried in this order until the middles of strips represent the strips. Chosen: cost; results
/// change within their stated error, found from the bend over three strips.
const STRIPS: [[usize; 2]; 3] = [[5, 192], [11, 192], [24, 768]];
/// Maximum errors of the undeviated and of the redirected share, relative to the share plus [`LITTLE`]. Chosen: cost;
/// what is found below them is stated as error. Neither exceeds the median error that
/// `tests/scenes/sharp_sun::real_geometry` allows.
const LINEAR: [f64; 2] = [2e-4, 1e-3];
/// Shares of the light, undeviated and redirected, beside which errors do not matter. Chosen: cost; errors are stated
/// all the same.
const LITTLE: [f64; 2] = [0.005, 0.05];
/// Angle within which neighbouring directions may share one computation of redirected beams: a tenth of the disc.
/// \[rad\] Chosen: cost; its effect is part of [`TURNED`], which was found with it.
const ABOUT: f64 = 0.05 * PI / 180.0;

/// Returns directions distributed uniformly over the visible part of the sun's disc about `sun`: a sunflower pattern of
/// `seeds` points, each with its opposite.
pub(super) fn disc(facing: &Facing<'_>, sun: Dir<Facade>, seeds: usize) -> Vec<Dir<Facade>> {
    let (u, v) = sun.vector().any_orthonormal_pair();
    let edges = facing.sun_edges();
    let scale = SUN_HALF_ANGLE.tan() / (seeds as f64).sqrt();
    sunflower()[..seeds]
        .iter()
        .flat_map(|&[a, b]| {
            let aside = scale * (a * u + b * v);
            [aside, -aside]
        })
        .filter_map(|aside| Dir::new(sun.vector() + aside))
        .filter(|d| edges.iter().all(|edge| edge.normal.dot(d.vector()) > edge.offset))
        .collect()
}

/// Returns the points of a sunflower pattern whose first n fill a disc of radius √n.
fn sunflower() -> &'static [[f64; 2]] {
    static SEEDS_OF_ONE: OnceLock<Vec<[f64; 2]>> = OnceLock::new();
    SEEDS_OF_ONE.get_or_init(|| {
        let golden = PI * (3.0 - 5.0_f64.sqrt());
        let seed = |k: usize| {
            let (sin, cos) = (golden * k as f64).sin_cos();
            [cos, sin].map(|c| c * (k as f64 + 0.5).sqrt())
        };
        (0..MOST_SEEDS).map(seed).collect()
    })
}

/// Whether no part of the sun's disc is hidden by the horizon, the skyline or the aperture's plane.
fn is_whole(facing: &Facing<'_>, sun: Dir<Facade>) -> bool {
    // An edge that hides less than 10⁻⁵ of the disc is neglected.
    let free =
        |edge: &Edge| edge.normal.dot(sun.vector()) - edge.offset > 0.999 * SUN_HALF_ANGLE * edge.normal.length();
    facing.sun_edges().iter().all(free)
}

/// Returns two opposite directions on the rim of the sun's disc, displaced along ±`aside`.
fn rim(sun: Dir<Facade>, aside: DVec3) -> [Dir<Facade>; 2] {
    let aside = SUN_HALF_ANGLE.tan() * aside;
    [aside, -aside].map(|aside| Dir::new(sun.vector() + aside).unwrap_or(sun))
}

pub(super) fn cosine(direction: Dir<Facade>) -> f64 {
    direction.vector().z.max(0.0)
}

/// Part of the sun's disc: its direction, its share of the disc's solid angle, that share times its cosine of
/// incidence, and the beams that its light becomes.
struct Part {
    direction: Dir<Facade>,
    weight: f64,
    flux: f64,
    /// Share of the part's light that is transmitted undeviated.
    straight: f64,
    turned: Vec<Beam>,
}

impl Part {
    /// Computes the beams that light from the direction `direction` becomes, divided into undeviated and redirected
    /// ones.
    fn new(model: &dyn OpticalModel, direction: Dir<Facade>, weight: f64, flux: f64) -> Self {
        let mut part = Self { direction, weight, flux, straight: 0.0, turned: Vec::new() };
        for beam in model.beams_about(direction, Side::Front, ABOUT).into_iter().filter(|beam| beam.transmitted) {
            if beam.directions.iter().all(|other| other.vector().distance(direction.vector()) <= SAME) {
                part.straight += beam.share;
            } else {
                part.turned.push(beam);
            }
        }
        part
    }

    fn shares(&self) -> [f64; 2] {
        [self.straight, self.turned.iter().map(|beam| beam.share).sum()]
    }
}

/// Divides directions of the sun's disc into strips of about the same profile angle, each as (middle direction, number
/// of directions, sum of their cosines of incidence). `upright`: profile angle to the right instead of upwards.
fn strips(directions: &[Dir<Facade>], upright: bool, count: usize) -> Vec<(Dir<Facade>, f64, f64)> {
    let angle = |direction: &Dir<Facade>| {
        let v = direction.vector();
        (if upright { v.x } else { v.y }).atan2(v.z)
    };
    let angles: Vec<f64> = directions.iter().map(angle).collect();
    let (low, high) = angles
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), angle| (low.min(*angle), high.max(*angle)));
    let mut sums = vec![(DVec3::ZERO, 0.0, 0.0); count];
    for (direction, angle) in directions.iter().zip(angles) {
        let at = (count as f64 * (angle - low) / (high - low).max(f64::MIN_POSITIVE)) as usize;
        let sum = &mut sums[at.min(count - 1)];
        *sum = (sum.0 + direction.vector(), sum.1 + 1.0, sum.2 + cosine(*direction));
    }
    sums.into_iter().filter_map(|(sum, count, cosines)| Some((Dir::new(sum)?, count, cosines))).collect()
}

/// Computes the beams of direct sun behind a system, undeviated and redirected, as means over the disc.
pub(super) fn sun_beams(model: &dyn OpticalModel, facing: &Facing<'_>) -> Vec<BeamLight> {
    let Some(sun) = facing.sun_direction().filter(|_| facing.sun_illuminance() > 0.0) else { return Vec::new() };
    if let Structure::Along { upright } = model.structure() {
        return beams_by_strips(model, facing, sun, upright);
    }
    let asked = |direction: &Dir<Facade>| Part::new(model, *direction, 1.0, cosine(*direction));
    let few: Vec<Part> = if is_whole(facing, sun) {
        let (u, v) = sun.vector().any_orthonormal_pair();
        match by_middle(model, facing, sun, &[u, v]) {
            Ok(beams) => return beams,
            Err(parts) => parts,
        }
    } else {
        disc(facing, sun, FEW).iter().map(asked).collect()
    };
    let mut beams: Vec<BeamLight> = straight_by_seeds(model, facing, sun).into_iter().collect();
    if !few.is_empty() && few.iter().all(|part| part.turned.is_empty()) {
        return beams;
    }
    let parts: Vec<Part> = disc(facing, sun, PARTS).iter().map(asked).collect();
    // Error from the comparison of every other pair of directions with all pairs.
    let mean = |pairs: usize| {
        let some = parts.chunks(2).step_by(pairs).flatten();
        let count = some.clone().count().max(1);
        some.map(|part| part.shares()[1]).sum::<f64>() / count as f64
    };
    let error = (mean(1) - mean(2)).abs() / mean(1).max(f64::MIN_POSITIVE);
    beams.extend(turned(facing, &parts, error));
    beams
}

/// Computes the beams of the whole disc from its middle and from opposite points of its rim along `asides`, which are
/// perpendicular to each other. Where the transmitted shares are not nearly linear between these points, returns the
/// parts of the disc as the error. The weights are exact for polynomials of the third degree, and the rim shows light
/// that is transmitted only there.
fn by_middle(
    model: &dyn OpticalModel,
    facing: &Facing<'_>,
    sun: Dir<Facade>,
    asides: &[DVec3],
) -> Result<Vec<BeamLight>, Vec<Part>> {
    /// Weight of a point of the rim. Two opposite ones have the second moment of the disc of radius r, 2 · r²/8 = r²/4.
    const RIM: f64 = 0.125;
    let asked = |direction: Dir<Facade>, weight: f64| Part::new(model, direction, weight, weight * cosine(direction));
    let mut parts = vec![asked(sun, 1.0 - 2.0 * RIM * asides.len() as f64)];
    parts.extend(asides.iter().flat_map(|aside| rim(sun, *aside)).map(|direction| asked(direction, RIM)));
    let own = parts[0].shares();
    let bent = [0, 1].map(|k| {
        let pair = |pair: &[Part]| RIM * (pair[0].shares()[k] + pair[1].shares()[k] - 2.0 * own[k]).abs();
        parts[1..].chunks_exact(2).map(pair).sum::<f64>()
    });
    if !stands(bent, own) {
        return Err(parts);
    }
    // The shares are nearly linear: the redirected beams of the disc's middle represent the whole disc.
    let turned = turned(facing, &parts[..1], bent[1] / own[1].max(f64::MIN_POSITIVE));
    Ok(straight(facing, sun, &parts, true, bent[0]).into_iter().chain(turned).collect())
}

/// Whether the errors of the undeviated and redirected shares are within [`LINEAR`].
fn stands(errors: [f64; 2], shares: [f64; 2]) -> bool {
    (0..2).all(|k| errors[k] <= LINEAR[k] * (shares[k] + LITTLE[k]))
}

/// Computes the beams of direct sun behind a system that depends on a profile angle alone, from strips of the disc.
fn beams_by_strips(model: &dyn OpticalModel, facing: &Facing<'_>, sun: Dir<Facade>, upright: bool) -> Vec<BeamLight> {
    // Across the planes of equal profile angles.
    let across = (if upright { DVec3::Y } else { DVec3::X }).cross(sun.vector()).try_normalize();
    let mut begins = false;
    if let Some(across) = across.filter(|_| is_whole(facing, sun)) {
        match by_middle(model, facing, sun, &[across]) {
            Ok(beams) => return beams,
            Err(parts) => begins = parts.iter().any(|part| part.straight > 0.0),
        }
    }
    let mut beams = Vec::new();
    for (round, [count, pairs]) in STRIPS.into_iter().enumerate() {
        let directions = disc(facing, sun, pairs);
        let whole = directions.len() == 2 * pairs;
        let parts: Vec<Part> = strips(&directions, upright, count)
            .into_iter()
            .map(|(direction, weight, flux)| Part::new(model, direction, weight, flux))
            .collect();
        // Beams at the middle of a strip represent the whole strip.
        let flux: f64 = parts.iter().map(|part| part.flux).sum();
        let off = [0, 1].map(|k| {
            let bent = |three: &[Part]| {
                three[1].flux * (three[0].shares()[k] + three[2].shares()[k] - 2.0 * three[1].shares()[k]).abs()
            };
            parts.windows(3).map(bent).sum::<f64>() / (8.0 * flux.max(f64::MIN_POSITIVE))
        });
        let shares = [0, 1].map(|k| mean(&parts, |part| part.shares()[k]));
        // Light that is transmitted at the rim only may lie between the middles of wide strips.
        let missed = begins && shares[0] <= 0.0;
        if (stands(off, shares) && !missed) || round + 1 == STRIPS.len() {
            beams.extend(straight(facing, sun, &parts, whole, off[0]));
            beams.extend(turned(facing, &parts, off[1] / shares[1].max(f64::MIN_POSITIVE)));
            break;
        }
    }
    beams
}

fn mean(parts: &[Part], of: impl Fn(&Part) -> f64) -> f64 {
    let flux: f64 = parts.iter().map(|part| part.flux).sum();
    parts.iter().map(|part| part.flux * of(part)).sum::<f64>() / flux.max(f64::MIN_POSITIVE)
}

/// Returns the undeviated beam of the sun's disc from its parts; `whole`: whether no part of the disc is hidden; `off`:
/// absolute error of the undeviated share.
fn straight(facing: &Facing<'_>, sun: Dir<Facade>, parts: &[Part], whole: bool, off: f64) -> Option<BeamLight> {
    let normal = facing.sun?.direct_normal;
    let share = mean(parts, |part| part.straight);
    let weight: f64 = parts.iter().map(|part| part.weight).sum();
    let seen = parts.iter().map(|part| part.weight * part.straight).sum::<f64>() / weight;
    // If the system transmits parts of the disc unequally, the beam's middle differs from the disc's. A partly hidden
    // disc is cut by the obstruction later.
    let centre: DVec3 = parts.iter().map(|part| part.weight * part.straight * part.direction.vector()).sum();
    (share > 0.0).then(|| BeamLight {
        to: if whole { Dir::new(centre).unwrap_or(sun) } else { sun },
        exitance: share * facing.sun_illuminance(),
        normal: seen * normal,
        straight: true,
        error: off / share.max(off),
        uncertainty: 0.0,
    })
}

/// Computes the undeviated beam from rising numbers of directions until its share converges.
fn straight_by_seeds(model: &dyn OpticalModel, facing: &Facing<'_>, sun: Dir<Facade>) -> Option<BeamLight> {
    let mut found: Option<BeamLight> = None;
    for (round, seeds) in SEEDS.into_iter().enumerate() {
        let directions = disc(facing, sun, seeds);
        let part = |direction: &Dir<Facade>| Part {
            direction: *direction,
            weight: 1.0,
            flux: cosine(*direction),
            straight: model.straight(*direction, Side::Front),
            turned: Vec::new(),
        };
        let parts: Vec<Part> = directions.iter().map(part).collect();
        let exitance = |beam: Option<BeamLight>| beam.map_or(0.0, |beam| beam.exitance);
        let before = exitance(found);
        found = straight(facing, sun, &parts, directions.len() == 2 * seeds, 0.0);
        let now = exitance(found);
        let change = (now - before).abs();
        if let Some(beam) = &mut found {
            beam.error = if round == 0 { 1.0 } else { (change / now).min(1.0) };
        }
        if round > 0 && change <= STANDS * (now + LITTLE[0] * facing.sun_illuminance()) {
            break;
        }
    }
    found
}

/// Returns the redirected beams of the parts of the disc, merged; `error`: relative error of their share.
fn turned(facing: &Facing<'_>, parts: &[Part], error: f64) -> Vec<BeamLight> {
    let flux: f64 = parts.iter().map(|part| part.flux).sum();
    let mut pieces = Pieces::default();
    for part in parts {
        let incident = facing.sun_illuminance() * part.flux / flux.max(f64::MIN_POSITIVE);
        part.turned.iter().for_each(|beam| pieces.add(beam, incident));
    }
    pieces.beams(error)
}

/// Redirected beams, merged by direction: sum of directions times flux, flux, whether the beam is a piece of a fan.
#[derive(Default)]
struct Pieces(BTreeMap<[i64; 2], (DVec3, f64, bool)>);

impl Pieces {
    fn add(&mut self, beam: &Beam, incident: f64) {
        let [a, b] = beam.directions.map(Dir::vector);
        let count = (a.angle_between(b) / PIECE).ceil().max(1.0) as usize;
        for k in 0..count {
            let to = a.lerp(b, (k as f64 + 0.5) / count as f64).normalize_or_zero();
            let flux = beam.share * incident / count as f64;
            let place = [to.x, to.y].map(|c| (c / TOGETHER).round() as i64);
            let sum = self.0.entry(place).or_default();
            sum.0 += flux * to;
            sum.1 += flux;
            sum.2 |= a.distance(b) > SAME;
        }
    }

    fn beams(self, error: f64) -> Vec<BeamLight> {
        let beam = |(sum, exitance, fan): (DVec3, f64, bool)| {
            let to = Dir::<Facade>::new(sum)?;
            let cosine = to.vector().z;
            let normal = exitance / cosine;
            let error = error + TURNED[usize::from(fan)];
            let beam = BeamLight { to, exitance, normal, straight: false, error, uncertainty: 0.0 };
            (cosine > 1e-6 && exitance > 0.0).then_some(beam)
        };
        self.0.into_values().filter_map(beam).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::direction::{Orientation, Surface as Face};
    use crate::compute::sky::{Distribution, Outside, Sun};

    use crate::compute::system::slats::{SlatArray, SlatModel, SlatProfile, Surface};

    /// Level flat slats, as far apart as 0.9 of their width, let 1 − tanψ/0.9 pass. Of a disc whose middle lies beyond
    /// that by a part of its radius the rest is seen through them, down to a sliver at the rim.
    #[test]
    fn what_begins_to_pass_at_the_rim_counts() {
        let flat = SlatProfile::Flat { width: 0.08 };
        let specimen = SlatModel::new(SlatArray::new(flat, 0.0, 0.072, 0.0, [Surface::matt(0.5); 2]).unwrap());
        let psi = 0.9_f64.atan();
        let outside = Outside::new(Distribution::uniform(), 0.0).unwrap();
        for (beyond, bound) in [(0.0_f64, 0.02), (0.5, 0.03), (0.8, 0.1), (0.9, 0.3)] {
            let altitude = psi + beyond * SUN_HALF_ANGLE;
            let direction = Dir::from_altitude_bearing(altitude, Bearing::from_degrees(180.0));
            let sun = Sun { direction, direct_normal: 1e5 };
            let facing = Facing {
                outside: &outside,
                sun: Some(&sun),
                orientation: Orientation::new(Bearing::from_degrees(180.0)),
                surface: Face::Facade,
            };
            let beams = sun_beams(&specimen, &facing);
            let [beam] = &beams[..] else { panic!("{beams:?}") };
            // ∫ (t − a) √(1 − t²) dt from a to 1, where the share grows in a straight line.
            let rest = (1.0 - beyond * beyond).sqrt();
            let moment = rest.powi(3) / 3.0 - 0.5 * beyond * (beyond.acos() - beyond * rest);
            let share = SUN_HALF_ANGLE / (0.9 * psi.cos().powi(2)) * moment * 2.0 / PI;
            let found = beam.exitance / facing.sun_illuminance();
            let off = (found / share - 1.0).abs();
            assert!(off < bound && off < 3.0 * beam.error + 5e-3, "{beyond}: {found} {share} {}", beam.error);
            assert!(beam.to.vector().y.atan2(beam.to.vector().z) < psi, "the part that passes is the lower one");
        }
    }
}

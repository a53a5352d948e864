//! The very sun through a system that answers for single directions: its beams as means over the disc, and what it
//! scatters.

use super::{BandLight, BeamLight, BeamSource, CellLight, Emission, Facing};
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Facade};
use crate::compute::incidence::superpose::sub_patches;
use crate::compute::sky::SUN_HALF_ANGLE;
use crate::compute::sky::sun_disc::Edge;
use crate::compute::system::measure::{Beam, ProfileLight, ScatteredLight, Side, Specimen, Structure};
use glam::DVec3;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// Width of the cells that scattered sunlight is put on. \[rad\]
const CELL: f64 = 3.0 * PI / 180.0;
/// What their size costs, relative, on planes across the room. Seen on matt slats against strips in closed form: 0.1 %
/// there, up to 0.8 % where the opening is seen at grazing angles.
const CELL_ERROR: f64 = 3e-3;
/// Names closer than this are the same. \[rad\]
const SAME: f64 = 1e-9;
/// Longest piece of a fan that is one beam: a fraction of the sun's own width. \[rad\]
const PIECE: f64 = 0.15 * PI / 180.0;
/// Pieces of fans that fall together within this are one. \[rad\]
const TOGETHER: f64 = 0.1 * PI / 180.0;
/// Pairs of directions over the disc for the straight beam through what is no structure along an axis, one number after
/// the other until its share stands ...
const SEEDS: [usize; 4] = [16, 64, 256, MOST_SEEDS];
/// Most of them.
const MOST_SEEDS: usize = 1024;
/// ... to this, relative to it and what little matters.
const STANDS: f64 = 1e-4;
/// Pairs of directions that take the place of the disc's middle where that cannot stand for it.
const PARTS: usize = 64;
/// Pairs of directions that what is scattered is a mean over at grazing incidence.
const GRAZING_PARTS: usize = 3;
/// Where all hangs on a profile angle, strips of the disc and pairs of directions in all of them together: ever more until the
/// middles of strips stand for these.
const STRIPS: [[usize; 2]; 3] = [[5, 192], [11, 192], [24, 768]];
/// Shares that go straight on and that are turned stand if known so well, relative to themselves and ...
const LINEAR: [f64; 2] = [2e-4, 1e-3];
/// ... so much of the light.
const LITTLE: [f64; 2] = [0.005, 0.05];
/// Directions as near as this may share what mirrors make of them: a tenth of the disc. \[rad\]
const ABOUT: f64 = 0.05 * PI / 180.0;
/// Below this cosine of incidence the disc covers a range of profile angles that scatters unevenly.
const GRAZING: f64 = 0.3;

/// The cells that light of described systems is put on: the same for all systems, so that what sensors see of them is found once.
pub fn sun_cells() -> &'static Arc<RingBasis> {
    static CELLS: OnceLock<Arc<RingBasis>> = OnceLock::new();
    CELLS.get_or_init(|| Arc::new(sub_patches(CELL)))
}

/// Directions evenly over the disc that nothing hides: a sunflower of so many seeds, each with its opposite.
fn disc(facing: &Facing<'_>, sun: Dir<Facade>, seeds: usize) -> Vec<Dir<Facade>> {
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

/// Places of the seeds of a sunflower whose first n fill a disc of radius √n.
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

/// Is nothing of the disc hidden?
fn is_whole(facing: &Facing<'_>, sun: Dir<Facade>) -> bool {
    // An edge that touches it, or hides 10⁻⁵ of it, takes nothing.
    let free =
        |edge: &Edge| edge.normal.dot(sun.vector()) - edge.offset > 0.999 * SUN_HALF_ANGLE * edge.normal.length();
    facing.sun_edges().iter().all(free)
}

/// Opposite directions on the disc's rim.
fn rim(sun: Dir<Facade>, aside: DVec3) -> [Dir<Facade>; 2] {
    let aside = SUN_HALF_ANGLE.tan() * aside;
    [aside, -aside].map(|aside| Dir::from_unit((sun.vector() + aside).normalize()))
}

fn cosine(name: Dir<Facade>) -> f64 {
    name.vector().z.max(0.0)
}

/// A part of the disc: where, its share of the disc as seen, and its cosine times that.
struct Part {
    name: Dir<Facade>,
    weight: f64,
    flux: f64,
    /// What goes straight on of it.
    straight: f64,
    turned: Vec<Beam>,
}

impl Part {
    fn new(specimen: &dyn Specimen, name: Dir<Facade>, weight: f64, flux: f64) -> Self {
        let mut part = Self { name, weight, flux, straight: 0.0, turned: Vec::new() };
        for beam in specimen.beams_about(name, Side::Front, ABOUT).into_iter().filter(|beam| beam.transmitted) {
            if beam.names.iter().all(|other| other.vector().distance(name.vector()) <= SAME) {
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

/// The disc by strips of about the same profile angle, each by its middle: x and y exchanged where `upright`.
fn strips(names: &[Dir<Facade>], upright: bool, count: usize) -> Vec<(Dir<Facade>, f64, f64)> {
    let angle = |name: &Dir<Facade>| {
        let v = name.vector();
        (if upright { v.x } else { v.y }).atan2(v.z)
    };
    let angles: Vec<f64> = names.iter().map(angle).collect();
    let (low, high) = angles
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), angle| (low.min(*angle), high.max(*angle)));
    let mut sums = vec![(DVec3::ZERO, 0.0, 0.0); count];
    for (name, angle) in names.iter().zip(angles) {
        let at = (count as f64 * (angle - low) / (high - low).max(f64::MIN_POSITIVE)) as usize;
        let sum = &mut sums[at.min(count - 1)];
        *sum = (sum.0 + name.vector(), sum.1 + 1.0, sum.2 + cosine(*name));
    }
    sums.into_iter().filter_map(|(sum, count, cosines)| Some((Dir::new(sum)?, count, cosines))).collect()
}

/// The sun's beams behind a system, as means over the disc.
fn sun_beams(specimen: &dyn Specimen, facing: &Facing<'_>) -> Vec<BeamLight> {
    let Some(sun) = facing.sun_direction().filter(|_| facing.sun_illuminance() > 0.0) else { return Vec::new() };
    if let Structure::Along { upright } = specimen.structure() {
        return beams_by_strips(specimen, facing, sun, upright);
    }
    let asked = |name: Dir<Facade>, weight: f64| Part::new(specimen, name, weight, weight * cosine(name));
    // The disc's middle where shares are as good as linear over it: its mean by the middle and four points on the rim holds
    // for polynomials of the third degree, and the rim tells what begins to pass there.
    let mut turns = true;
    if is_whole(facing, sun) {
        let (u, v) = sun.vector().any_orthonormal_pair();
        let mut parts: Vec<Part> = [u, v].iter().flat_map(|aside| rim(sun, *aside)).map(|d| asked(d, 0.125)).collect();
        let middle = asked(sun, 0.5);
        let own = middle.shares();
        let bent = [0, 1].map(|k| {
            let pair = |pair: &[Part]| (0.5 * (pair[0].shares()[k] + pair[1].shares()[k]) - own[k]).abs();
            0.25 * parts.chunks_exact(2).map(pair).sum::<f64>()
        });
        let turned_by_middle = stands(bent, own)
            .then(|| turned(facing, std::slice::from_ref(&middle), bent[1] / own[1].max(f64::MIN_POSITIVE)));
        parts.push(middle);
        if let Some(turned) = turned_by_middle {
            return straight(facing, sun, &parts, true, bent[0]).into_iter().chain(turned).collect();
        }
        turns = parts.iter().any(|part| !part.turned.is_empty());
    }
    let mut beams: Vec<BeamLight> = straight_by_seeds(specimen, facing, sun).into_iter().collect();
    if !turns {
        return beams;
    }
    let parts: Vec<Part> = disc(facing, sun, PARTS).iter().map(|name| asked(*name, 1.0)).collect();
    // Every other pair of directions against all of them.
    let mean = |pairs: usize| {
        let some = parts.chunks(2).step_by(pairs).flatten();
        let count = some.clone().count().max(1);
        some.map(|part| part.shares()[1]).sum::<f64>() / count as f64
    };
    let error = (mean(1) - mean(2)).abs() / mean(1).max(f64::MIN_POSITIVE);
    beams.extend(turned(facing, &parts, error));
    beams
}

/// Are shares known to errors that do not matter?
fn stands(errors: [f64; 2], shares: [f64; 2]) -> bool {
    (0..2).all(|k| errors[k] <= LINEAR[k] * (shares[k] + LITTLE[k]))
}

/// Where all hangs on a profile angle.
fn beams_by_strips(specimen: &dyn Specimen, facing: &Facing<'_>, sun: Dir<Facade>, upright: bool) -> Vec<BeamLight> {
    // Across the planes of equal profile angles.
    let across = (if upright { DVec3::Y } else { DVec3::X }).cross(sun.vector()).try_normalize();
    if let Some(across) = across.filter(|_| is_whole(facing, sun)) {
        // As good as linear over the disc: its mean by the middle and both ends holds for polynomials of the third degree, and
        // the ends tell what begins to pass there.
        let [low, high] = rim(sun, across);
        let parts = [(low, 0.125), (sun, 0.75), (high, 0.125)]
            .map(|(name, weight)| Part::new(specimen, name, weight, weight * cosine(name)));
        let [a, own, b] = [0, 1, 2].map(|k| parts[k].shares());
        let bent = [0, 1].map(|k| 0.25 * (0.5 * (a[k] + b[k]) - own[k]).abs());
        if stands(bent, own) {
            let turned = turned(facing, &parts[1..2], bent[1] / own[1].max(f64::MIN_POSITIVE));
            return straight(facing, sun, &parts, true, bent[0]).into_iter().chain(turned).collect();
        }
    }
    let mut beams = Vec::new();
    for (round, [count, pairs]) in STRIPS.into_iter().enumerate() {
        let names = disc(facing, sun, pairs);
        let whole = names.len() == 2 * pairs;
        let parts: Vec<Part> = strips(&names, upright, count)
            .into_iter()
            .map(|(name, weight, flux)| Part::new(specimen, name, weight, flux))
            .collect();
        // Of the middle of a strip for all of it.
        let flux: f64 = parts.iter().map(|part| part.flux).sum();
        let off = [0, 1].map(|k| {
            let bent = |three: &[Part]| {
                three[1].flux * (three[0].shares()[k] + three[2].shares()[k] - 2.0 * three[1].shares()[k]).abs()
            };
            parts.windows(3).map(bent).sum::<f64>() / (8.0 * flux.max(f64::MIN_POSITIVE))
        });
        let shares = [0, 1].map(|k| mean(&parts, |part| part.shares()[k]));
        if stands(off, shares) || round + 1 == STRIPS.len() {
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

/// The straight beam of a disc by its parts; `whole`: nothing hides any; `off`: error of the share.
fn straight(facing: &Facing<'_>, sun: Dir<Facade>, parts: &[Part], whole: bool, off: f64) -> Option<BeamLight> {
    let normal = facing.sun?.direct_normal;
    let share = mean(parts, |part| part.straight);
    let weight: f64 = parts.iter().map(|part| part.weight).sum();
    let seen = parts.iter().map(|part| part.weight * part.straight).sum::<f64>() / weight;
    // Where the system lets the disc's parts pass unequally, the beam's middle is not the disc's. A disc that is hidden in
    // part is cut by what hides it, later.
    let centre: DVec3 = parts.iter().map(|part| part.weight * part.straight * part.name.vector()).sum();
    (share > 0.0).then(|| BeamLight {
        to: if whole { Dir::new(centre).unwrap_or(sun) } else { sun },
        exitance: share * facing.sun_illuminance(),
        normal: seen * normal,
        straight: true,
        error: off / share.max(off),
        doubt: 0.0,
    })
}

/// The same by more and more directions until its share stands.
fn straight_by_seeds(specimen: &dyn Specimen, facing: &Facing<'_>, sun: Dir<Facade>) -> Option<BeamLight> {
    let mut found: Option<BeamLight> = None;
    for (round, seeds) in SEEDS.into_iter().enumerate() {
        let names = disc(facing, sun, seeds);
        let part = |name: &Dir<Facade>| Part {
            name: *name,
            weight: 1.0,
            flux: cosine(*name),
            straight: specimen.straight(*name, Side::Front),
            turned: Vec::new(),
        };
        let parts: Vec<Part> = names.iter().map(part).collect();
        let exitance = |beam: Option<BeamLight>| beam.map_or(0.0, |beam| beam.exitance);
        let before = exitance(found);
        found = straight(facing, sun, &parts, names.len() == 2 * seeds, 0.0);
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

/// The beams that do not go straight on.
fn turned(facing: &Facing<'_>, parts: &[Part], error: f64) -> Vec<BeamLight> {
    let flux: f64 = parts.iter().map(|part| part.flux).sum();
    let mut pieces = Pieces::default();
    for part in parts {
        let incident = facing.sun_illuminance() * part.flux / flux.max(f64::MIN_POSITIVE);
        part.turned.iter().for_each(|beam| pieces.add(beam, incident));
    }
    pieces.beams(error)
}

/// Turned beams, those that fall together as one.
#[derive(Default)]
struct Pieces(BTreeMap<[i64; 2], (DVec3, f64)>);

impl Pieces {
    fn add(&mut self, beam: &Beam, incident: f64) {
        let [a, b] = beam.names.map(Dir::vector);
        let count = (a.angle_between(b) / PIECE).ceil().max(1.0) as usize;
        for k in 0..count {
            let to = a.lerp(b, (k as f64 + 0.5) / count as f64).normalize_or_zero();
            let flux = beam.share * incident / count as f64;
            let place = [to.x, to.y].map(|c| (c / TOGETHER).round() as i64);
            let sum = self.0.entry(place).or_default();
            sum.0 += flux * to;
            sum.1 += flux;
        }
    }

    fn beams(self, error: f64) -> Vec<BeamLight> {
        let beam = |(sum, exitance): (DVec3, f64)| {
            let to = Dir::<Facade>::new(sum)?;
            let cosine = to.vector().z;
            let normal = exitance / cosine;
            let beam = BeamLight { to, exitance, normal, straight: false, error, doubt: 0.0 };
            (cosine > 1e-6 && exitance > 0.0).then_some(beam)
        };
        self.0.into_values().filter_map(beam).collect()
    }
}

/// Directions of the disc that what is scattered is a mean over.
fn standing_for(facing: &Facing<'_>, sun: Dir<Facade>) -> Vec<Dir<Facade>> {
    if sun.vector().z < GRAZING { disc(facing, sun, GRAZING_PARTS) } else { vec![sun] }
}

/// What a system scatters of the sun where that depends on a profile angle alone.
fn by_profile(specimen: &dyn Specimen, facing: &Facing<'_>) -> Option<BandLight> {
    let illuminance = facing.sun_illuminance();
    let sun = facing.sun_direction().filter(|_| illuminance > 0.0)?;
    let names = standing_for(facing, sun);
    let cosines: f64 = names.iter().map(|name| name.vector().z.max(0.0)).sum();
    let mut mean: Option<ProfileLight> = None;
    for name in &names {
        let weight = name.vector().z.max(0.0) / cosines;
        let own = specimen.profile_light(*name, Side::Front)?;
        let sum = mean.get_or_insert_with(|| ProfileLight { q: vec![0.0; own.q.len()], error: 0.0, ..own });
        sum.q.iter_mut().zip(&own.q).for_each(|(sum, q)| *sum += weight * q);
        sum.error += weight * own.error;
    }
    let mut light = mean?;
    if names.len() > 1 {
        // A few directions stand for a disc that covers degrees of the profile angle.
        let middle = specimen.profile_light(sun, Side::Front)?;
        light.error += middle.apart(&light);
    }
    Some(BandLight { light, illuminance })
}

/// q on [`sun_cells`] of what a system scatters of light of a name, and its error, relative.
pub fn scattered_of(specimen: &dyn Specimen, name: Dir<Facade>) -> (Vec<f64>, f64) {
    let light = specimen.scattered_through(name, Side::Front, sun_cells());
    let share: f64 = light.transmitted.iter().zip(sun_cells().projected_solid_angles()).map(|(q, w)| q * w).sum();
    let relative = if share > 0.0 { light.error / share } else { 0.0 };
    (light.transmitted, relative + CELL_ERROR)
}

/// What a system scatters of the sun, on [`sun_cells`]; `None` where it scatters nothing.
fn scattered(specimen: &dyn Specimen, facing: &Facing<'_>) -> Option<CellLight> {
    let incident = facing.sun_illuminance();
    let sun = facing.sun_direction().filter(|_| incident > 0.0)?;
    let cells = sun_cells();
    let names = standing_for(facing, sun);
    let lights: Vec<(ScatteredLight, f64)> =
        names.iter().map(|name| (specimen.scattered_through(*name, Side::Front, cells), cosine(*name))).collect();
    let cosines: f64 = lights.iter().map(|(_, cosine)| cosine).sum();
    let mut luminance = vec![0.0; cells.len()];
    let mut error = 0.0;
    for (light, cosine) in &lights {
        let weight = incident * cosine / cosines;
        error += light.error * weight;
        luminance.iter_mut().zip(&light.transmitted).for_each(|(sum, q)| *sum += q * weight);
    }
    let total: f64 = luminance.iter().zip(cells.projected_solid_angles()).map(|(l, w)| l * w).sum();
    (total > 0.0).then(|| CellLight {
        basis: Arc::clone(cells),
        diffuse: vec![0.0; cells.len()],
        sun: luminance,
        doubts: Vec::new(),
        relative_error: error / total + CELL_ERROR,
    })
}

/// What a system makes of one very sun: worth keeping as long as the sun stays.
pub struct SunThrough {
    illuminance: f64,
    beams: Vec<BeamLight>,
    bands: Option<BandLight>,
    cells: Option<CellLight>,
}

impl SunThrough {
    /// Asks a system.
    pub fn new(specimen: &dyn Specimen, facing: &Facing<'_>) -> Self {
        let bands = by_profile(specimen, facing);
        let cells = if bands.is_none() { scattered(specimen, facing) } else { None };
        Self { illuminance: facing.sun_illuminance(), beams: sun_beams(specimen, facing), bands, cells }
    }

    /// What it makes of beams alone.
    pub fn beams_alone(specimen: &dyn Specimen, facing: &Facing<'_>) -> Self {
        let beams = sun_beams(specimen, facing);
        Self { illuminance: facing.sun_illuminance(), beams, bands: None, cells: None }
    }

    /// Directions of the disc that what is scattered is a mean over, with their shares of the illuminance.
    pub fn standing_for(facing: &Facing<'_>) -> Vec<(Dir<Facade>, f64)> {
        let Some(sun) = facing.sun_direction() else { return Vec::new() };
        let names = standing_for(facing, sun);
        let cosines: f64 = names.iter().map(|name| cosine(*name)).sum();
        names.into_iter().map(|name| (name, cosine(name) / cosines.max(f64::MIN_POSITIVE))).collect()
    }

    /// What goes on as beams.
    pub fn beams(&self) -> &[BeamLight] {
        &self.beams
    }

    /// What is scattered where that is a matter of a profile angle alone.
    pub fn bands(&self) -> Option<&BandLight> {
        self.bands.as_ref()
    }

    /// What is scattered otherwise, on [`sun_cells`].
    pub fn cells(&self) -> Option<&CellLight> {
        self.cells.as_ref()
    }
}

impl Emission {
    /// Adds what a system makes of the very sun. `self` is what it makes of the diffuse light alone.
    pub fn add_sun_through(&mut self, through: &SunThrough) {
        self.incident_sun = through.illuminance;
        self.beams.clone_from(&through.beams);
        self.bands.extend(through.bands.clone());
        self.cells.extend(through.cells.clone());
        if self.incident_sun > 0.0 {
            self.beam_source = BeamSource::Described;
            let of = |straight: bool| {
                let beams = self.beams.iter().filter(|beam| beam.straight == straight);
                // The sum of nothing is −0.
                100.0 * beams.map(|beam| beam.exitance).sum::<f64>() / self.incident_sun + 0.0
            };
            self.notes.push(format!(
                "sun: by the description for this very direction; {:.2} % goes straight on, {:.2} % as turned beams",
                of(true),
                of(false)
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::direction::{Orientation, Surface as Face};
    use crate::compute::sky::{Distribution, Outside, Sun};

    use crate::compute::system::slats::{SlatArray, SlatProfile, SlatSpecimen, Surface};

    /// Level flat slats, as far apart as 0.9 of their width, let 1 − tanψ/0.9 pass: half of a disc whose middle just does not
    /// is seen through them.
    #[test]
    fn strips_have_the_disc_s_mean_at_the_edge_of_a_shadow() {
        let flat = SlatProfile::Flat { width: 0.08 };
        let specimen = SlatSpecimen::new(SlatArray::new(flat, 0.0, 0.072, 0.0, [Surface::matt(0.5); 2]).unwrap());
        let psi = 0.9_f64.atan();
        let sun = Sun { direction: Dir::from_altitude_bearing(psi, Bearing::from_degrees(180.0)), direct_normal: 1e5 };
        let outside = Outside::new(Distribution::uniform(), 0.0).unwrap();
        let facing = Facing {
            outside: &outside,
            sun: Some(&sun),
            orientation: Orientation::new(Bearing::from_degrees(180.0)),
            surface: Face::Facade,
        };
        let beams = sun_beams(&specimen, &facing);
        let [beam] = &beams[..] else { panic!("{beams:?}") };
        // Over half a disc of radius r a slope k has the mean 2kr/(3π).
        let slope = 1.0 / (0.9 * psi.cos().powi(2));
        let share = slope * SUN_HALF_ANGLE * 2.0 / (3.0 * PI);
        let found = beam.exitance / facing.sun_illuminance();
        assert!((found / share - 1.0).abs() < 0.02, "{found} {share}");
        assert!((found / share - 1.0).abs() < 3.0 * beam.error + 5e-3, "{found} {share} {}", beam.error);
        assert!(beam.to.vector().y.atan2(beam.to.vector().z) < psi, "the part that passes is the lower one");
    }
}

//! The very sun through a system that answers for single directions: its beams as means over the disc, and what it
//! scatters.

use super::{BeamLight, BeamSource, CellLight, Emission, Facing};
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Facade};
use crate::compute::sky::SUN_HALF_ANGLE;
use crate::compute::system::measure::{Beam, ScatteredLight, Side, Specimen};
use glam::DVec3;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// Width of the cells that scattered sunlight is put on. \[rad\]
const CELL: f64 = 3.0 * PI / 180.0;
/// What their size costs, relative; seen on matt slats against exact integrals along the slats.
const CELL_ERROR: f64 = 3e-3;
/// Names closer than this are the same. \[rad\]
const SAME: f64 = 1e-9;
/// Longest piece of a fan that is one beam: a fraction of the sun's own width. \[rad\]
const PIECE: f64 = 0.15 * PI / 180.0;
/// Pieces of fans that fall together within this are one. \[rad\]
const TOGETHER: f64 = 0.1 * PI / 180.0;
/// Points of the disc that tell whether its middle can stand for it, and those that take its place where it cannot.
const POINTS: [usize; 2] = [7, 127];
/// Shares that are as near as this to linear over the disc are.
const LINEAR: f64 = 2e-5;
/// Below this cosine of incidence the disc covers a range of profile angles that scatters unevenly.
const GRAZING: f64 = 0.3;

/// The cells that scattered sunlight is put on: the same for all systems, so that what sensors see of them is found once.
pub fn sun_cells() -> &'static Arc<RingBasis> {
    static CELLS: OnceLock<Arc<RingBasis>> = OnceLock::new();
    CELLS.get_or_init(|| Arc::new(RingBasis::even(CELL)))
}

/// A point of the sun's disc that nothing hides, as the aperture faces it.
struct DiscPoint {
    name: Dir<Facade>,
    beams: Vec<Beam>,
}

/// Directions evenly over the disc that are not hidden: the middle, then rings of equal shares (a sunflower).
fn disc(facing: &Facing<'_>, sun: Dir<Facade>, points: usize) -> Vec<Dir<Facade>> {
    let (u, v) = sun.vector().any_orthonormal_pair();
    let edges = facing.sun_edges();
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    (0..points)
        .map(|k| {
            let (sin, cos) = (golden * k as f64).sin_cos();
            let at = SUN_HALF_ANGLE.tan() * ((k as f64 + 0.5) / points as f64).sqrt();
            (sun.vector() + at * (cos * u + sin * v)).normalize()
        })
        .filter(|d| edges.iter().all(|edge| edge.normal.dot(*d) > edge.offset))
        .map(Dir::from_unit)
        .collect()
}

impl DiscPoint {
    fn straight(&self) -> f64 {
        self.beams.iter().filter(|beam| self.is_straight(beam)).map(|beam| beam.share).sum()
    }

    fn is_straight(&self, beam: &Beam) -> bool {
        beam.names.iter().all(|name| name.vector().distance(self.name.vector()) < SAME)
    }

    fn turned(&self) -> impl Iterator<Item = &Beam> {
        self.beams.iter().filter(|beam| !self.is_straight(beam))
    }

    fn cosine(&self) -> f64 {
        self.name.vector().z.max(0.0)
    }
}

/// Points of the disc with what the system makes of each, as many as its shares ask for.
fn points(specimen: &dyn Specimen, facing: &Facing<'_>, sun: Dir<Facade>) -> Vec<DiscPoint> {
    let ask = |name: Dir<Facade>| {
        let beams = specimen.beams(name, Side::Front).into_iter().filter(|beam| beam.transmitted).collect();
        DiscPoint { name, beams }
    };
    let few: Vec<DiscPoint> = disc(facing, sun, POINTS[0]).into_iter().map(ask).collect();
    let middle = ask(sun);
    let shares = |point: &DiscPoint| [point.straight(), point.turned().map(|beam| beam.share).sum()];
    let own = shares(&middle);
    let linear = few.len() == POINTS[0]
        && [0, 1].into_iter().all(|k| {
            // Opposite points of a linear function have the middle as their mean.
            let mirror = |p: &DiscPoint| {
                let c = sun.vector();
                let across = p.name.vector() - c * p.name.vector().dot(c);
                Dir::new(c - across).map(|name| shares(&ask(name))[k])
            };
            few.iter().all(|p| mirror(p).is_some_and(|other| (0.5 * (shares(p)[k] + other) - own[k]).abs() < LINEAR))
        });
    if linear { vec![middle] } else { disc(facing, sun, POINTS[1]).into_iter().map(ask).collect() }
}

/// The sun's beams behind a system.
pub fn sun_beams(specimen: &dyn Specimen, facing: &Facing<'_>) -> Vec<BeamLight> {
    let incident = facing.sun_illuminance();
    let (Some(light), Some(sun)) = (facing.sun, facing.sun_direction()) else { return Vec::new() };
    if incident <= 0.0 {
        return Vec::new();
    }
    let points = points(specimen, facing, sun);
    let cosines: f64 = points.iter().map(DiscPoint::cosine).sum();
    if cosines <= 0.0 {
        return Vec::new();
    }
    let mut beams = Vec::new();
    let straight = points.iter().map(|p| p.straight() * p.cosine()).sum::<f64>() / cosines;
    if straight > 0.0 {
        let mean = points.iter().map(DiscPoint::straight).sum::<f64>() / points.len() as f64;
        let (exitance, normal) = (straight * incident, mean * light.direct_normal);
        beams.push(BeamLight { to: sun, exitance, normal, straight: true, doubt: 0.0 });
    }
    let mut turned = Pieces::default();
    for point in &points {
        let weight = incident * point.cosine() / cosines;
        point.turned().for_each(|beam| turned.add(beam, weight));
    }
    beams.extend(turned.beams());
    beams
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

    fn beams(self) -> impl Iterator<Item = BeamLight> {
        self.0.into_values().filter_map(|(sum, exitance)| {
            let to = Dir::<Facade>::new(sum)?;
            let cosine = to.vector().z;
            let normal = exitance / cosine;
            (cosine > 1e-6 && exitance > 0.0).then_some(BeamLight { to, exitance, normal, straight: false, doubt: 0.0 })
        })
    }
}

/// What a system scatters of the sun, on [`sun_cells`]; `None` where it scatters nothing.
fn scattered(specimen: &dyn Specimen, facing: &Facing<'_>) -> Option<CellLight> {
    let incident = facing.sun_illuminance();
    let sun = facing.sun_direction().filter(|_| incident > 0.0)?;
    let cells = sun_cells();
    let names = if sun.vector().z < GRAZING { disc(facing, sun, POINTS[0]) } else { vec![sun] };
    let lights: Vec<(ScatteredLight, f64)> =
        names.iter().map(|name| (specimen.scattered(*name, Side::Front, cells), name.vector().z.max(0.0))).collect();
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

impl Emission {
    /// Adds what a system makes of the very sun. `self` is what it makes of the diffuse light alone.
    pub fn add_sun_through(&mut self, specimen: &dyn Specimen, facing: &Facing<'_>) {
        self.incident_sun = facing.sun_illuminance();
        self.beams = sun_beams(specimen, facing);
        self.cells.extend(scattered(specimen, facing));
        let flux: f64 = self.beams.iter().map(|beam| beam.exitance).sum();
        let straight: f64 = self.beams.iter().filter(|beam| beam.straight).map(|beam| beam.exitance).sum();
        if self.incident_sun > 0.0 {
            self.beam_source = BeamSource::Described;
            let [flux, straight] = [flux, straight].map(|part| 100.0 * part / self.incident_sun);
            self.notes.push(format!(
                "sun: by the description for this very direction; {straight:.2} % goes straight on, {:.2} % as turned beams",
                flux - straight
            ));
        }
    }
}

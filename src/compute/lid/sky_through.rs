//! Diffuse light from sky and ground through a described system, whose transmission is computed for single directions.
//! The part that does not depend on the sky is computed once.
//!
//! | light | computation |
//! | --- | --- |
//! | undeviated | the flux of every patch leaves in the same cell, multiplied by the mean undeviated share of the patch
//! |
//! | redirected | backwards: the luminance of a cell is that of the outside where its light comes from, times its share
//! |
//! | scattered | by profile angle where it depends on that alone; otherwise on cells, one result per incident cell |
//!
//! Redirected light relies on reciprocity.

use super::structure::{angles, direction_of};
use super::sun_through::sun_cells;
use super::{BandLight, CellLight, Emission, Facing};
use crate::compute::basis::{RingBasis, sub_directions};
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::Estimate;
use crate::compute::sky::{Frame, incident_illuminances_within};
use crate::compute::system::measure::{Beam, OpticalModel, ProfileLight, Side, Structure, front_basis};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// Number of directions per side of a cell for its mean share: one per degree in cells of 3°, the spacing of [`BANDS`].
pub(super) const POINTS: usize = 3;
/// Number of bands of the profile angle of incidence, 1° each. Chosen: cost; the error is in [`CELL_ERROR`].
const BANDS: usize = 181;
/// Number of steps of the angle along a structure, to 90°. Chosen: cost; held by the test
/// `flux_is_that_of_the_measured_cells`: the flux of a laser-cut panel within 0.4 %.
const ALONG: usize = 16;
/// Width of the bins that gather redirected light by profile angle. \[rad\] Chosen: cost; as wide as bands, and its
/// error is [`BIN_ERROR`].
const BIN: f64 = PI / 180.0;
/// Angle within which neighbouring directions may share one computation of redirected beams: a twelfth of a cell.
/// \[rad\] Chosen: cost; behind flat mirrors directions are off by this at most, a quarter of [`BIN`].
const ABOUT: f64 = 0.25 * PI / 180.0;
/// Share below which a redirected beam is dropped. Chosen: cost; a hundred such beams are 0.1 % of the light.
const FAINT: f64 = 1e-5;
/// Distance below which two directions are the same. \[rad\] Far above the rounding of unit vectors, some 1e-16.
const SAME: f64 = 1e-9;
/// Relative accuracy of the illuminance through every patch. A twentieth of [`CELL_ERROR`].
const PATCH: f64 = 1e-4;
/// Relative error from the width of the cells and bands; seen against cells half as wide, in the tests below.
pub(super) const CELL_ERROR: f64 = 2e-3;
/// Additional relative error of redirected light, whose profile angles are gathered in bins; seen as [`CELL_ERROR`].
pub(super) const BIN_ERROR: f64 = 8e-3;

/// Response of a described system to diffuse light from outside, for any sky.
pub struct SkyThrough {
    pub(super) cells: Arc<RingBasis>,
    /// Mean undeviated share of the light from each cell.
    pub(super) straight: Vec<f64>,
    pub(super) turned: Turned,
    pub(super) scattered: Scattered,
}

/// Sources of the redirected light in emergent directions.
pub(super) enum Turned {
    None,
    /// Sources of the redirected light in every emergent cell.
    ByCell(Vec<Vec<Source>>),
    /// Sources by profile angle of the reversed emergent direction, one list for each of `BANDS` bands: profile angle
    /// \[rad\] and share of each source. A source has the direction cosine along the structure of the emergent light.
    ByProfile {
        upright: bool,
        sources: Vec<Vec<(f64, f64)>>,
    },
}

/// Direction outside that redirected light comes from, and the share of its luminance that is transmitted.
pub(super) struct Source {
    pub direction: Dir<Facade>,
    pub share: f64,
}

/// Luminance coefficients q of scattered light \[1/sr\], and the error of its share.
pub(super) enum Scattered {
    None,
    ByProfile { upright: bool, rows: Vec<ProfileLight> },
    ByCells { incident: RingBasis, rows: Vec<Vec<f64>>, error: f64 },
}

/// Returns the profile angle in the middle of a band. \[rad\]
fn middle(band: usize) -> f64 {
    // The outermost bands are centred at ±90°, where no light comes from.
    let psi = PI * (band as f64 / (BANDS - 1) as f64) - FRAC_PI_2;
    psi.clamp(0.25 * BIN - FRAC_PI_2, FRAC_PI_2 - 0.25 * BIN)
}

pub(super) fn band_of(psi: f64) -> usize {
    (((psi + FRAC_PI_2) / PI * (BANDS - 1) as f64).round().max(0.0) as usize).min(BANDS - 1)
}

/// Returns the beams of light from inside that are transmitted in another direction than undeviated.
fn turned_back(model: &dyn OpticalModel, direction: Dir<Facade>) -> impl Iterator<Item = Beam> {
    let beams = model.beams_about(direction, Side::Back, ABOUT).into_iter();
    beams.filter(move |beam| beam.transmitted && !is_straight(beam, direction) && beam.share > FAINT)
}

/// Returns the share of light from outside that is transmitted undeviated.
fn straight_about(model: &dyn OpticalModel, direction: Dir<Facade>) -> f64 {
    let beams = model.beams_about(direction, Side::Front, ABOUT).into_iter();
    beams.filter(|beam| beam.transmitted && is_straight(beam, direction)).map(|beam| beam.share).sum()
}

fn is_straight(beam: &Beam, direction: Dir<Facade>) -> bool {
    beam.directions.iter().all(|other| other.vector().distance(direction.vector()) < SAME)
}

fn centre(beam: &Beam) -> DVec3 {
    beam.directions[0].vector() + beam.directions[1].vector()
}

/// Interpolated undeviated share of systems whose structure is endless along an axis: sharp in the profile angle,
/// smooth in the angle along the structure. Layers must be the same on both sides.
struct StraightLattice {
    upright: bool,
    /// Undeviated shares by angle along the structure and band of the profile angle.
    rows: Vec<Vec<f64>>,
}

impl StraightLattice {
    /// Computes the shares at the nodes; `None` if the structure is not endless along an axis, or if scattering depends
    /// on the profile angle alone, which needs no interpolation.
    fn new(model: &dyn OpticalModel) -> Option<Self> {
        let Structure::Along { upright } = model.structure() else { return None };
        if model.by_profile_alone().is_some() {
            return None;
        }
        let rows = (0..=ALONG)
            .into_par_iter()
            .map(|row| {
                let along = (0.99 * FRAC_PI_2 * row as f64 / ALONG as f64).sin();
                let share = |band: usize| straight_about(model, direction_of(upright, along, middle(band)));
                (0..BANDS).map(share).collect()
            })
            .collect();
        Some(Self { upright, rows })
    }

    fn share(&self, direction: Dir<Facade>) -> f64 {
        let (along, psi) = angles(self.upright, direction);
        let at = |value: f64, last: usize| {
            let value = value.clamp(0.0, last as f64);
            let first = (value as usize).min(last - 1);
            (first, value - first as f64)
        };
        let (row, s) = at(along.abs().min(1.0).asin() / (0.99 * FRAC_PI_2) * ALONG as f64, ALONG);
        let (band, t) = at((psi + FRAC_PI_2) / PI * (BANDS - 1) as f64, BANDS - 1);
        let in_row = |row: &[f64]| (1.0 - t) * row[band] + t * row[band + 1];
        (1.0 - s) * in_row(&self.rows[row]) + s * in_row(&self.rows[row + 1])
    }
}

impl SkyThrough {
    /// Computes the response of a described system on the cells of [`sun_cells`], in parallel.
    pub fn new(model: &dyn OpticalModel) -> Self {
        Self::on(model, Arc::clone(sun_cells()))
    }

    /// Returns the memory that its responses take. \[bytes\]
    pub fn bytes(&self) -> usize {
        let turned: usize = match &self.turned {
            Turned::None => 0,
            Turned::ByCell(sources) => sources.iter().map(|sources| size_of_val(&sources[..])).sum(),
            Turned::ByProfile { sources, .. } => sources.iter().map(|sources| size_of_val(&sources[..])).sum(),
        };
        let scattered: usize = match &self.scattered {
            Scattered::None => 0,
            Scattered::ByProfile { rows, .. } => rows.iter().map(|row| size_of_val(&row.q[..])).sum(),
            Scattered::ByCells { rows, .. } => rows.iter().map(|row| size_of_val(&row[..])).sum(),
        };
        size_of_val(&self.straight[..]) + turned + scattered
    }

    /// Computes the response of a system on given cells.
    fn on(model: &dyn OpticalModel, cells: Arc<RingBasis>) -> Self {
        // Quantities that are computed once for all directions are computed first, so that parallel threads do not wait
        // for them.
        let ahead = direction_of(false, 0.0, 0.0);
        if model.profile_light(ahead, Side::Front).is_none() {
            model.scattered_through(ahead, Side::Front, &cells);
        }
        let list: Vec<_> = cells.cells().collect();
        let lattice = StraightLattice::new(model);
        let share = |direction: Dir<Facade>| {
            lattice.as_ref().map_or_else(|| model.straight(direction, Side::Front), |lattice| lattice.share(direction))
        };
        let straight = list
            .par_iter()
            .map(|cell| sub_directions(cell, POINTS).map(share).sum::<f64>() / (POINTS * POINTS) as f64)
            .collect();
        let (turned, scattered) = (Turned::new(model, &cells), Scattered::new(model, &cells));
        Self { cells, straight, turned, scattered }
    }

    /// Computes the light that an aperture with this system emits by diffuse light from sky, ground and skyline,
    /// without the sun.
    pub fn emission(&self, facing: &Facing<'_>) -> Emission {
        let cells = &self.cells;
        let frame = Frame::of_aperture(facing.orientation, facing.surface);
        let received = incident_illuminances_within(facing.outside, cells, &frame, PATCH);
        let mut emission = Emission::dark();
        emission.incident_diffuse = received.iter().copied().sum();
        let values: Vec<f64> = received.iter().map(|e| e.value).collect();
        let weights = cells.projected_solid_angles();
        let flux = |luminance: &[f64]| luminance.iter().zip(&weights).map(|(l, w)| l * w).sum::<f64>();
        let mut luminance = self.turned.luminance(cells, facing);
        let binned = if matches!(self.turned, Turned::ByProfile { .. }) { BIN_ERROR * flux(&luminance) } else { 0.0 };
        for (((sum, share), e), weight) in luminance.iter_mut().zip(&self.straight).zip(&values).zip(&weights) {
            *sum += share * e / weight;
        }
        let relative = |e: Estimate| if e.value > 0.0 { e.error / e.value } else { 0.0 };
        let mut relative_error = relative(emission.incident_diffuse) + CELL_ERROR;
        // Errors of the components, as flux per area.
        let mut parts = binned;
        match &self.scattered {
            Scattered::None => {}
            Scattered::ByProfile { upright, rows } => {
                emission.bands.extend(through_bands(*upright, rows, cells, &values));
            }
            Scattered::ByCells { incident, rows, error } => {
                let mut by_cell = vec![0.0; incident.len()];
                spread(cells, &values, |direction, e| {
                    if let Some(cell) = incident.index(direction) {
                        by_cell[cell] += e;
                    }
                });
                for (row, e) in rows.iter().zip(&by_cell) {
                    luminance.iter_mut().zip(row).for_each(|(sum, q)| *sum += q * e);
                }
                parts += error * emission.incident_diffuse.value;
            }
        }
        let total = flux(&luminance);
        if total > 0.0 {
            relative_error += parts / total;
            emission.cells.push(CellLight {
                basis: Arc::clone(cells),
                sun: vec![0.0; cells.len()],
                diffuse: luminance,
                uncertainties: Vec::new(),
                relative_error,
            });
        }
        emission.notes.push("diffuse light: by the description, patch by patch of 3°".to_owned());
        emission
    }
}

/// Distributes the illuminance of every patch uniformly over its directions.
fn spread(cells: &RingBasis, illuminance: &[f64], mut lay: impl FnMut(Dir<Facade>, f64)) {
    for (cell, e) in cells.cells().zip(illuminance).filter(|(_, e)| **e > 0.0) {
        let each = e / (POINTS * POINTS) as f64;
        sub_directions(&cell, POINTS).for_each(|direction| lay(direction, each));
    }
}

/// Computes bands of emergent light from illuminance by bands of incidence.
fn through_bands(upright: bool, rows: &[ProfileLight], cells: &RingBasis, illuminance: &[f64]) -> Option<BandLight> {
    let mut incident = vec![0.0; BANDS];
    spread(cells, illuminance, |direction, e| incident[band_of(angles(upright, direction).1)] += e);
    let mut sum = ProfileLight { upright, q: vec![0.0; rows.first()?.q.len()], error: 0.0 };
    for (row, e) in rows.iter().zip(&incident) {
        sum.q.iter_mut().zip(&row.q).for_each(|(sum, q)| *sum += q * e);
        sum.error += row.error * e;
    }
    sum.error += CELL_ERROR * sum.share();
    Some(BandLight { light: sum, illuminance: 1.0 })
}

impl Turned {
    fn new(model: &dyn OpticalModel, cells: &RingBasis) -> Self {
        if let Some(upright) = model.by_profile_alone() {
            let sources: Vec<Vec<(f64, f64)>> = (0..BANDS)
                .into_par_iter()
                .map(|band| {
                    // A fan consists of many pieces: pieces with about the same profile angle become one source.
                    let mut bins = std::collections::BTreeMap::<i64, (f64, f64)>::new();
                    for beam in turned_back(model, direction_of(upright, 0.0, middle(band))) {
                        let Some(direction) = Dir::new(centre(&beam)) else { continue };
                        let psi = angles(upright, direction).1;
                        let bin = bins.entry((psi / BIN).round() as i64).or_default();
                        *bin = (bin.0 + beam.share * psi, bin.1 + beam.share);
                    }
                    bins.into_values().map(|(sum, share)| (sum / share, share)).collect()
                })
                .collect();
            let any = sources.iter().any(|list| !list.is_empty());
            return if any { Self::ByProfile { upright, sources } } else { Self::None };
        }
        let list: Vec<_> = cells.cells().collect();
        let sources: Vec<Vec<Source>> = list
            .par_iter()
            .map(|cell| {
                let source = |beam: Beam| Some(Source { direction: Dir::new(centre(&beam))?, share: beam.share });
                turned_back(model, cell.centre()).filter_map(source).collect()
            })
            .collect();
        if sources.iter().any(|list| !list.is_empty()) { Self::ByCell(sources) } else { Self::None }
    }

    /// Computes the luminance of every cell by redirected light. \[cd/m²\]
    fn luminance(&self, cells: &RingBasis, facing: &Facing<'_>) -> Vec<f64> {
        let list: Vec<_> = cells.cells().collect();
        list.par_iter()
            .enumerate()
            .map(|(index, cell)| match self {
                Self::None => 0.0,
                Self::ByCell(sources) => {
                    sources[index].iter().map(|source| source.share * facing.luminance(source.direction)).sum()
                }
                Self::ByProfile { upright, sources } => {
                    let (along, psi) = angles(*upright, cell.centre());
                    let of = |(psi, share): &(f64, f64)| share * facing.luminance(direction_of(*upright, along, *psi));
                    sources[band_of(psi)].iter().map(of).sum()
                }
            })
            .collect()
    }
}

impl Scattered {
    fn new(model: &dyn OpticalModel, cells: &RingBasis) -> Self {
        let upright = model.profile_light(direction_of(false, 0.0, 0.0), Side::Front).map(|light| light.upright);
        if let Some(upright) = upright {
            let row = |band: usize| model.profile_light(direction_of(upright, 0.0, middle(band)), Side::Front);
            let rows: Option<Vec<ProfileLight>> = (0..BANDS).into_par_iter().map(row).collect();
            if let Some(rows) = rows {
                return Self::ByProfile { upright, rows };
            }
        }
        let incident = front_basis();
        let list: Vec<_> = incident.cells().collect();
        let made: Vec<(Vec<f64>, f64)> = list
            .par_iter()
            .map(|cell| {
                let light = model.scattered_through(cell.centre(), Side::Front, cells);
                (light.transmitted, light.error)
            })
            .collect();
        if made.iter().all(|(row, _)| row.is_empty()) {
            return Self::None;
        }
        let error = made.iter().map(|(_, error)| *error).fold(0.0, f64::max);
        Self::ByCells { incident, rows: made.into_iter().map(|(row, _)| row).collect(), error }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::direction::{Orientation, Surface};
    use crate::compute::incidence::superpose::sub_patches;
    use crate::compute::quadrature::Tolerance;
    use crate::compute::room::aperture::Aperture;
    use crate::compute::room::band_weights::BandWeights;
    use crate::compute::room::direct::{Reception, Sensor, illuminance};
    use crate::compute::sky::{Distribution, Outside};
    use crate::compute::system::laser_cut::{CutPanel, LaserCutPanel};
    use crate::compute::system::measure::beams::SharpBeams;
    use crate::compute::system::measure::upright::Upright;
    use crate::compute::system::panes::glazing::Pane;
    use crate::compute::system::slats::{SlatArray, SlatModel, SlatProfile, Surface as Face};

    fn slats(tilt: f64, faces: [Face; 2]) -> SlatModel {
        let flat = SlatProfile::Flat { width: 0.08 };
        SlatModel::new(SlatArray::new(flat, 0.0, 0.072, tilt, faces).unwrap())
    }

    fn panel() -> Box<dyn OpticalModel> {
        let sheet = Pane { index: 1.49, thickness: 0.006, absorption: 0.0 };
        Box::new(SharpBeams(CutPanel { panel: LaserCutPanel { sheet, spacing: 0.004 }, cut_loss: 0.0 }))
    }

    fn clear_sky() -> Outside {
        let sun = Dir::from_altitude_bearing(0.6, Bearing::from_degrees(195.0));
        let sky = Distribution::cie(12, sun).unwrap();
        Outside::new(sky, 12_000.0).unwrap().with_ground(0.2, 40_000.0).unwrap()
    }

    /// Returns the illuminances at points on the work plane, under the ceiling and beside the window.
    fn at_sensors(emission: &Emission, facing: &Facing<'_>) -> Vec<Estimate> {
        let window = Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 1.0), size: [3.0, 1.6] };
        let places = [
            ([2.0, 0.5, 0.85], DVec3::Z),
            ([2.0, 3.0, 0.85], DVec3::Z),
            ([1.0, 2.0, 2.95], DVec3::NEG_Z),
            ([0.0, 1.0, 1.5], DVec3::X),
        ];
        let tolerance = Tolerance::relative(1e-5);
        places
            .map(|(position, normal)| {
                let sensor = Sensor { position: DVec3::from_array(position), normal };
                let receptions: Vec<Reception> =
                    emission.cells.iter().map(|light| Reception::new(&sensor, &window, Some(&light.basis))).collect();
                let view = window.view(sensor.position, normal).unwrap();
                let bands = emission.bands.first();
                let bands = bands.map(|bands| BandWeights::new(&view, bands.light.upright, bands.light.q.len()));
                let receptions: Vec<&Reception> = receptions.iter().collect();
                illuminance(&sensor, &window, &receptions, bands.as_ref(), emission, facing, tolerance).all
            })
            .to_vec()
    }

    #[test]
    fn cells_half_as_wide_change_little() {
        let outside = clear_sky();
        let facing = Facing {
            outside: &outside,
            sun: None,
            orientation: Orientation::new(Bearing::from_degrees(180.0)),
            surface: Surface::Facade,
        };
        let (matt, mirror) = ([Face::matt(0.7); 2], [Face::mirror(0.8), Face::matt(0.5)]);
        let systems: [(&str, Box<dyn OpticalModel>); 5] = [
            ("matt, open", Box::new(slats(0.0, matt))),
            ("matt, tilted", Box::new(slats(0.6, matt))),
            ("mirror", Box::new(slats(0.2, mirror))),
            ("upright", Box::new(Upright(Box::new(slats(0.5, matt))))),
            ("panel", panel()),
        ];
        let fine = Arc::new(sub_patches(1.5_f64.to_radians()));
        let (mut held, mut all) = (0, 0);
        for (name, system) in &systems {
            let usual = at_sensors(&SkyThrough::new(system.as_ref()).emission(&facing), &facing);
            let closer = at_sensors(&SkyThrough::on(system.as_ref(), Arc::clone(&fine)).emission(&facing), &facing);
            for (a, b) in usual.iter().zip(&closer) {
                assert!((a.value - b.value).abs() < 0.012 * b.value, "{name}: {a:?} {b:?}");
                all += 1;
                held += usize::from((a.value - b.value).abs() <= a.error);
            }
        }
        assert!(10 * held >= 9 * all, "{held} of {all}");
    }

    #[test]
    fn flux_is_that_of_the_measured_cells() {
        // Under a uniform sky the flux is the hemispherical transmittance, whatever cells it is found on.
        let sky = Outside::new(Distribution::uniform(), 10_000.0).unwrap();
        let outside = sky.with_ground(1.0, 0.0).unwrap();
        let facing = Facing {
            outside: &outside,
            sun: None,
            orientation: Orientation::new(Bearing::from_degrees(180.0)),
            surface: Surface::Facade,
        };
        let cells = front_basis();
        let setting =
            crate::compute::system::measure::Setting { incident: &cells, emergent: &cells, error: 1e-3, seed: 1 };
        for specimen in [Box::new(slats(0.4, [Face::matt(0.7); 2])) as Box<dyn OpticalModel>, panel()] {
            let emission = SkyThrough::new(specimen.as_ref()).emission(&facing);
            let tau = emission.exitance(&facing).value / emission.incident_diffuse.value;
            let band = specimen.examine(&setting, &crate::compute::estimate::Silent).unwrap().0;
            let exact = band.transmission_front.unwrap().tau_hemispherical();
            assert!((tau / exact - 1.0).abs() < 4e-3, "{tau} {exact}");
        }
    }
}

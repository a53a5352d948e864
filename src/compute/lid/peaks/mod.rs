//! Extraction of sharp beams of direct sun from patch-averaged data. A Klems cell is 10–15° wide; of a beam, a file
//! contains the mean over an incident cell of its strength (share of the incident flux), blurred over the emergent cell
//! that it leads to. From all these means together the beam for the actual sun is computed, as narrow as the sun's
//! disc, with the uncertainty of its strength; the other light remains on cells.
//!
//! The method follows Radiance's `aBSDF`, which extracts the undeviated peak from the data, but takes into account that
//! its strength is a mean over a cell, and estimates it between the centres of cells.

mod mean_field;
mod separation;

use super::{BeamLight, BeamSource, Emission, Facing};
use crate::compute::basis::{Neighbours, RingBasis};
use crate::compute::btdf::CellMatrix;
use crate::compute::direction::{Dir, Facade};
use mean_field::{Covariance, MeanField, Observation, Point};
use separation::{Path, Reached, Separation};

/// Ratio of a cell's q to that of the surrounding cells above which the cell counts as a peak. Source: Radiance's
/// `aBSDF`.
const STANDS_OUT: f64 = 1.5;
/// Maximum flux of the cells around the peaks above their surroundings, as a share of the flux in the peaks; with more
/// the light is a wide lobe and not a beam. At this share the stated uncertainty, twice the share, is the whole beam.
const LOBE: f64 = 0.5;
/// Standard errors of a beam's flux in a cell: absolute, by the digits of the data; relative to the strongest flux, by
/// the few points in a cell; relative to the flux itself; relative to the subtracted background. Chosen with [`DARK`],
/// [`ROUGH`] and [`LEAST`]; held by
/// `tests/scenes/beams_in_cells::the_truth_of_strange_files_lies_within_what_is_stated`, which counts 95 % of the
/// sensors within the stated uncertainty, and that at most six times the error.
const NOISE: [f64; 4] = [2e-4, 2e-3, 0.01, 0.3];
/// Limits of a dark cell: beam flux up to which the cell counts as dark beside the subtracted background, maximum
/// background with which it may, and error of a point that is then known to be dark, as a share of the strongest flux.
/// Chosen; see [`NOISE`].
const DARK: [f64; 3] = [3e-4, 0.02, 1e-3];
/// Relative standard error of the transmittance without beams, per incident cell. Chosen; see [`NOISE`].
const ROUGH: f64 = 0.02;
/// Number of standard errors that is stated as the uncertainty of a strength or a transmittance; with the other
/// uncertainties more than 95 % of sensors are covered, as `tests/scenes/beams_in_cells` counts.
const ERRORS: f64 = 1.6;
/// Strength, relative to the strongest one, below which a beam may be an artefact of a smoothed cut-off. Found on flat
/// and curved slats.
const CUT_OFF: f64 = 0.03;
/// Uncertainty of each of two beams that lie in one emergent cell of the data, as a share of their sum: each strength
/// lies between 0 and the sum, half of it to either side of the middle.
const MIXED: f64 = 0.5;
/// Minimum relative uncertainty of a strength or luminance that is extracted from cells. Chosen; see [`NOISE`].
const LEAST: f64 = 0.01;
/// Maximum number of incident cells whose data are used for the extraction of beams, the nearest to the sun; with finer
/// cells, more distant ones are not needed. Chosen: cost, which grows with the cube; the 145 cells of Klems and of
/// Tregenza are all used.
pub const MOST_CELLS: usize = 200;
/// Strength given to a beam whose strength is 0 but uncertain, since the uncertainty is stored relative to the
/// strength.
const NOTHING: f64 = 1e-9;
/// Note on a beam that is not extracted.
const LEFT: &str = "sun: the beam is left on the data's cells";

/// Direct sun behind a system with patch-averaged data: extracted beams, the other light on emergent cells, and a note
/// on the method.
pub struct SunOnCells {
    /// Beams extracted from the cells.
    pub beams: Vec<BeamLight>,
    /// Luminance of the room side by sunlight that is not in beams, by emergent cell. \[cd/m²\]
    pub luminance: Vec<f64>,
    /// Uncertainties of `luminance`, independent of one another, each with a signed value per emergent cell. \[cd/m²\]
    pub uncertainties: Vec<Vec<f64>>,
    /// Note on the extraction, for the user.
    pub note: String,
}

/// Patch-averaged data divided into sharp beams and the other light, for any direction of the sun.
pub struct Peaks {
    matrix: CellMatrix,
    around: Neighbours,
    paths: Vec<Path>,
    beams: Option<MeanField>,
    /// Largest mean strength of a beam, a share of the incident flux; strengths in `beams` are relative to it.
    strongest: f64,
    /// Luminance coefficients of the light that is not in beams, by incident cell. \[1/sr\]
    rest: Vec<Rest>,
    /// Transmittance of the smooth part of `rest` as a function of the incident direction.
    even: Option<MeanField>,
    /// Indices of the incident cells that `beams` and `even` are fitted to.
    used: Vec<usize>,
    /// Flux of the lobes around the peaks as a share of the flux in the peaks.
    leak: f64,
    /// Ratio of the q of the peaks to that of the surrounding cells.
    contrast: f64,
}

/// Light of one incident cell that is not in beams: smooth part and peaks in single cells, by emergent cell. \[1/sr\]
struct Rest {
    even: Vec<f64>,
    uneven: Vec<f64>,
}

/// Returns observations of strength 0 for a path of beams at the ends of the rows of points of a dark incident cell.
fn dark_points(path: usize, points: &[Point], noise: f64) -> Vec<Observation> {
    let row_ends = |k: &usize| {
        let other_theta =
            |j: usize| points.get(j).is_none_or(|p| (p.direction.theta() - points[*k].direction.theta()).abs() > 1e-9);
        other_theta(k.wrapping_sub(1)) || other_theta(k + 1)
    };
    (0..points.len())
        .filter(row_ends)
        .map(|k| {
            let mut one = Observation { value: 0.0, noise, ..Observation::default() };
            one.points[path] = vec![points[k].whole()];
            one
        })
        .collect()
}

impl Peaks {
    /// Returns the memory that the light of the incident cells takes. \[bytes\]
    pub fn bytes(&self) -> usize {
        self.rest.iter().map(|rest| size_of_val(&rest.even[..]) + size_of_val(&rest.uneven[..])).sum()
    }

    /// Divides patch-averaged data into beams and the other light. `sun`: direction of the sun; with more than
    /// [`MOST_CELLS`] incident cells only the nearest to it are used.
    pub fn new(matrix: &CellMatrix, sun: Dir<Facade>) -> Self {
        let parts = Separation::new(matrix);
        let n = matrix.incident().len();
        let mut used: Vec<usize> = (0..n).collect();
        if n > MOST_CELLS {
            let near = |i: &usize| -matrix.incident().cell(*i).centre().vector().dot(sun.vector());
            used.sort_by(|a, b| near(a).total_cmp(&near(b)));
            used.truncate(MOST_CELLS);
            used.sort_unstable();
        }
        let straight: Vec<Reached> = (0..n).map(|i| parts.reached(Path::Straight, i)).collect();
        let mut own = Self {
            matrix: matrix.clone(),
            around: parts.around.clone(),
            paths: Vec::new(),
            beams: None,
            strongest: 1.0,
            rest: Vec::new(),
            even: None,
            used,
            leak: 0.0,
            contrast: 0.0,
        };
        let mut reached: Vec<Vec<Reached>> = Vec::new();
        if parts.aligned() {
            own.paths.push(Path::Straight);
            reached.push(straight.clone());
            if let Some(path) = parts.mirrors(&straight) {
                own.paths.push(path);
                reached.push((0..n).map(|i| parts.reached(path, i)).collect());
            }
            own.find_beams(&parts, &reached);
        }
        if own.beams.is_none() {
            own.paths.clear();
            reached.clear();
        }
        own.split_rest(&parts, &reached);
        own
    }

    /// Fits the strengths of the beams to the flux of their cells above the surroundings.
    fn find_beams(&mut self, parts: &Separation<'_>, reached: &[Vec<Reached>]) {
        let (mut observations, mut backgrounds): (Vec<Observation>, Vec<f64>) = (Vec::new(), Vec::new());
        let (mut above, mut below, mut leaked, mut held) = (0.0, 0.0, 0.0, 0.0);
        for &i in &self.used {
            let row = self.matrix.row(i);
            let straight = &reached[0][i].cells;
            let turned: &[usize] = reached.get(1).map_or(&[], |all| &all[i].cells);
            for (k, cells) in [straight.as_slice(), turned].into_iter().enumerate() {
                // Cells that both paths lead to count for the undeviated one; they hold the sum of both beams.
                let cells: Vec<usize> = cells.iter().copied().filter(|o| k == 0 || !straight.contains(o)).collect();
                if cells.is_empty() {
                    continue;
                }
                let level = parts.background(&row, &cells, if k == 0 { turned } else { straight });
                let weight: f64 = cells.iter().map(|&o| parts.weight[o]).sum();
                let all: f64 = cells.iter().map(|&o| parts.weight[o] * row[o]).sum();
                let background = (level * weight).min(all);
                let value = all - background;
                let share = parts.incident_weight[i];
                above += share * value;
                below += share * background;
                if k == 0 {
                    let near: Vec<usize> =
                        self.around.of(cells[0]).iter().copied().filter(|o| !turned.contains(o)).collect();
                    let but: Vec<usize> = cells.iter().chain(turned).copied().collect();
                    let outer = parts.background(&row, &near, &but);
                    let leak = |&o: &usize| (row[o] - outer).max(0.0) * parts.weight[o];
                    // A lobe wider than the cells leaks to all sides: twice the sum over the lesser half of the
                    // neighbours.
                    let mut leaks: Vec<f64> = near.iter().map(leak).collect();
                    leaks.sort_unstable_by(f64::total_cmp);
                    leaked += share * 2.0 * leaks[..leaks.len() / 2].iter().sum::<f64>();
                    held += share * value;
                }
                let mut one = Observation { value, ..Observation::default() };
                for (path, list) in reached.iter().enumerate() {
                    let inside = list[i].points.iter().filter(|(_, o)| cells.contains(o));
                    one.points[path] = inside.map(|(point, _)| *point).collect();
                }
                observations.push(one);
                backgrounds.push(background);
            }
        }
        self.contrast = (above + below) / below.max(1e-9 * above).max(1e-300);
        self.leak = leaked / held.max(1e-300);
        if above <= 1e-6 || self.contrast < STANDS_OUT || self.leak > LOBE {
            return;
        }
        let strongest = observations.iter().map(|one| one.value).fold(1e-6, f64::max);
        self.strongest = strongest;
        let (mut lit, mut dark) = (Vec::new(), Vec::new());
        for (k, (one, background)) in observations.iter_mut().zip(backgrounds).enumerate() {
            if one.value < DARK[0] + NOISE[3] * background && background < DARK[1] {
                let noise = DARK[2].hypot(NOISE[3] * background / strongest);
                dark.extend(one.points.iter().enumerate().flat_map(|(path, points)| dark_points(path, points, noise)));
            } else {
                lit.push(k);
            }
            let known = NOISE[0].hypot(NOISE[1] * strongest).hypot(NOISE[2] * one.value).hypot(NOISE[3] * background);
            (one.value, one.noise) = (one.value / strongest, known / strongest);
        }
        let alone = |of: usize| -> Vec<Observation> {
            let pure = |one: &&Observation| !one.points[of].is_empty() && one.points[1 - of].is_empty();
            observations.iter().filter(pure).cloned().collect()
        };
        let covariances = [0, 1].map(|of| Covariance::most_likely(&alone(of), of));
        // Flux is never negative: where a cell's mean is 0, the beam is 0 in the whole cell. This locates a cut-off far
        // better than the means do.
        let sharper: Vec<Observation> = lit.into_iter().map(|i| observations[i].clone()).chain(dark).collect();
        self.beams = MeanField::new(sharper, covariances);
    }

    /// Divides the light that is not in beams into a smooth part and peaks in single cells.
    fn split_rest(&mut self, parts: &Separation<'_>, reached: &[Vec<Reached>]) {
        let n = self.matrix.incident().len();
        self.rest = (0..n)
            .map(|i| {
                let mut row = self.matrix.row(i).into_owned();
                let sets: Vec<&[usize]> = reached.iter().map(|all| all[i].cells.as_slice()).collect();
                let taken: Vec<usize> = sets.concat();
                for cells in &sets {
                    let level = parts.background(&row, cells, &taken);
                    cells.iter().for_each(|&o| row[o] = row[o].min(level));
                }
                let even: Vec<f64> =
                    (0..row.len()).map(|o| row[o].min(STANDS_OUT * parts.background(&row, &[o], &[]))).collect();
                let uneven = row.iter().zip(&even).map(|(all, even)| all - even).collect();
                Rest { even, uneven }
            })
            .collect();
        let observations: Vec<Observation> = self
            .used
            .iter()
            .map(|&i| {
                let value: f64 = self.rest[i].even.iter().zip(&parts.weight).map(|(q, w)| q * w).sum();
                let points = mean_field::points(self.matrix.incident(), i);
                Observation { points: [points, Vec::new()], value, noise: 1e-4_f64.hypot(ROUGH * value) }
            })
            .collect();
        let covariance = Covariance::most_likely(&observations, 0);
        self.even = MeanField::new(observations, [covariance; 2]);
    }

    /// Returns the emergent cells of the data.
    pub fn basis(&self) -> &RingBasis {
        self.matrix.emergent()
    }

    /// Computes the sunlight behind the system for the sun in `facing`; `None` if the sun lies in none of the incident
    /// cells.
    pub fn sun(&self, facing: &Facing<'_>) -> Option<SunOnCells> {
        let incident = facing.sun_illuminance();
        let (light, sun) = (facing.sun?, facing.sun_entering().filter(|_| incident > 0.0)?);
        let cell = self.matrix.incident().index(sun)?;
        let weight = self.basis().projected_solid_angles();
        let mut beams = Vec::new();
        let mut words = Vec::new();
        let mut spread = vec![0.0; weight.len()];
        // Share of a beam that may be a narrow lobe instead.
        let lobe = (2.0 * self.leak).min(1.0);
        // If two paths end in one cell, their sum is more certain than either.
        let ends: Vec<Option<usize>> = self.paths.iter().map(|path| self.basis().index(path.of(sun)?)).collect();
        let mixed = ends.len() == 2 && ends[0] == ends[1];
        let both = self.beams.as_ref().map_or(0.0, |field| {
            (0..self.paths.len()).map(|of| (self.strongest * field.at(of, sun).value).max(0.0)).sum()
        });
        for (of, path) in self.paths.iter().enumerate() {
            let (Some(field), Some(to)) = (&self.beams, path.of(sun)) else { continue };
            let at = field.at(of, sun);
            let strength = (self.strongest * at.value).clamp(0.0, 1.0);
            let error = (ERRORS * self.strongest * at.error).hypot(LEAST * strength);
            // A value near 0 may be 0, because smooth functions round off a cut-off.
            let error = error.max(strength.min(CUT_OFF * self.strongest));
            let error = if mixed { error.hypot(MIXED * both) } else { error };
            // The strength is a share of the incident flux, 0 … 1.
            let error = error.min(strength.max(1.0 - strength));
            if strength + error < 1e-6 {
                continue;
            }
            let strength = strength.max(NOTHING);
            let straight = *path == Path::Straight;
            let exitance = strength * incident;
            let normal = if straight { strength * light.direct_normal } else { exitance / to.vector().z };
            // An obstruction that hides part of the disc hides it from the sensor, too.
            let to = if straight { facing.sun_direction()? } else { to };
            beams.push(BeamLight { to, exitance, normal, straight, error: 0.0, uncertainty: error / strength + lobe });
            if let Some(o) = self.basis().index(to) {
                spread[o] += lobe * exitance / weight[o];
            }
            let way = if straight { "undeviated" } else { "mirrored" };
            words.push(format!("{:.1} % ± {:.1} % {way}", 100.0 * strength, 100.0 * error));
        }
        let own = &self.rest[cell];
        let even = self.even.as_ref().map(|field| field.at(0, sun));
        let mut smooth = own.even.clone();
        let mut relative = 0.0;
        if let Some(at) = even.filter(|at| at.value > 0.0) {
            smooth.fill(0.0);
            for (&i, w) in self.used.iter().zip(&at.weights) {
                smooth.iter_mut().zip(&self.rest[i].even).for_each(|(sum, q)| *sum += w * q);
            }
            smooth.iter_mut().for_each(|q| *q = q.max(0.0));
            relative = (ERRORS * at.error / at.value).min(1.0);
        }
        let luminance: Vec<f64> = smooth.iter().zip(&own.uneven).map(|(a, b)| incident * (a + b)).collect();
        let surroundings = |o: usize| {
            let near = self.around.of(o);
            near.iter().map(|&n| smooth[n]).sum::<f64>() / near.len().max(1) as f64
        };
        let uncertainties = vec![
            smooth.iter().map(|q| incident * relative.max(LEAST) * q).collect(),
            smooth.iter().zip(&own.even).map(|(a, b)| incident * (a - b)).collect(),
            smooth.iter().enumerate().map(|(o, q)| incident * (q - surroundings(o))).collect(),
            // Peaks that belong to no path: a beam or a fan of beams that may lie anywhere in its cells.
            own.uneven.iter().map(|q| incident * q).collect(),
            spread,
        ];
        let width = (self.matrix.incident().cell(cell).solid_angle()).sqrt().to_degrees();
        let note = if beams.is_empty() {
            format!("sun: no beam stands out in these data; light stays on cells, incident ones of {width:.0}°")
        } else {
            let word = words.join(", ");
            format!(
                "sun: a beam of {word} extracted from cells of {width:.0}° where it stands out {:.0} ×",
                self.contrast.min(999.0)
            )
        };
        Some(SunOnCells { beams, luminance, uncertainties, note })
    }
}

impl SunOnCells {
    /// Returns the sunlight with its beams blurred over the cells of the data; the extracted beams then count as
    /// uncertainty. `row`: luminance by the data used as given, by emergent cell \[cd/m²\].
    fn on_cells(mut self, row: &[f64]) -> Self {
        for beam in &mut self.beams {
            let whole = 1.0 + beam.uncertainty;
            beam.exitance *= NOTHING;
            beam.normal *= NOTHING;
            beam.uncertainty = whole / NOTHING;
        }
        // A beam blurred over its cell has an error as large as itself, within its true direction and in the rest of
        // the cell.
        self.uncertainties.push(row.iter().zip(&self.luminance).map(|(stored, rest)| stored - rest).collect());
        self.luminance = row.to_vec();
        self
    }
}

impl Emission {
    /// Replaces the sunlight of patch-averaged data used as given by that computed from `peaks`. `sharp`: whether beams
    /// are extracted from the cells; otherwise they only count as uncertainty.
    pub fn take_peaks(&mut self, peaks: &Peaks, facing: &Facing<'_>, sharp: bool) {
        let (Some(sun), Some(light)) = (peaks.sun(facing), self.cells.first_mut()) else { return };
        let found = !sun.beams.is_empty();
        let sun = if sharp { sun } else { sun.on_cells(&light.sun) };
        light.sun = sun.luminance;
        light.uncertainties.extend(sun.uncertainties);
        self.beams.extend(sun.beams);
        if sharp && found {
            self.beam_source = BeamSource::Extracted;
        }
        self.notes.push(if sharp { sun.note } else { format!("{}, as asked for", LEFT) });
    }
}

//! Sharp beams of direct sun from patch-averaged data. A Klems cell is 10–15° wide, and what a file keeps of a beam is
//! the mean over an incident cell of its strength, lying in the emergent cell that it leads to. From all these means
//! together the beam for the actual sun is computed, as sharp as the disc, with the uncertainty of its strength; the
//! rest stays on cells.
//!
//! The method follows Radiance's `aBSDF`, which extracts the undeviated peak from the data; that it is a mean, and what
//! may be said of its strength between the cells, is not in there.

mod mean_field;
mod separation;

use super::{BeamLight, BeamSource, Emission, Facing};
use crate::compute::basis::{Neighbours, RingBasis};
use crate::compute::btdf::CellMatrix;
use crate::compute::direction::{Dir, Facade};
use mean_field::{Covariance, MeanField, Observation, Point};
use separation::{Path, Reached, Separation};

/// Ratio to its surroundings above which a cell stands out, as in Radiance.
const STANDS_OUT: f64 = 1.5;
/// Largest flux that the cells around the peaks hold above their own surroundings, as a share of the flux in the peaks;
/// with more the light is a wide lobe and not a beam. At this share the stated uncertainty, twice the share, is all of
/// the beam.
const LOBE: f64 = 0.5;
/// Errors of a beam's flux in a cell: digits of the data, a share of the strongest flux (for what few points in a cell
/// miss), a share of its own flux, and a share of the subtracted background. Chosen with [`DARK`], [`ROUGH`] and
/// [`LEAST`]; held by `tests/scenes/beams_in_cells::the_truth_of_strange_files_lies_within_what_is_stated`, which
/// counts 95 % of the sensors within the stated uncertainty, and that at most six times the error.
const NOISE: [f64; 4] = [2e-4, 2e-3, 0.01, 0.3];
/// Limits of a dark beam cell: flux up to which it counts as none beside the subtracted background, largest background
/// with which it may, and error of a point that is then known to be dark, as a share of the strongest flux. Chosen; see
/// [`NOISE`].
const DARK: [f64; 3] = [3e-4, 0.02, 1e-3];
/// Relative error of the light beside beams, per incident cell. Chosen; see [`NOISE`].
const ROUGH: f64 = 0.02;
/// Number of standard errors that are stated for a strength or a transmittance; with the other uncertainties more than
/// 95 % of sensors are covered, as `tests/scenes/beams_in_cells` counts.
const ERRORS: f64 = 1.6;
/// Share of the strongest strength below which a strength may be a rounded-off cut-off; seen on flat and curved slats.
const CUT_OFF: f64 = 0.03;
/// Share of the sum of two beams that either may be wrong by where the data hold them in one cell: each lies between 0
/// and the sum, half of it to either side of the middle.
const MIXED: f64 = 0.5;
/// Minimum relative uncertainty of anything that is extracted from cells. Chosen; see [`NOISE`].
const LEAST: f64 = 0.01;
/// Maximum number of incident cells in which beams are looked for, the nearest to the sun: finer cells need no farther
/// ones. Chosen: cost, which grows with the cube; the 145 cells of Klems and of Tregenza are all used.
pub const MOST_CELLS: usize = 200;
/// Strength of a beam that is nothing but uncertain, since an uncertainty is a share of the strength.
const NOTHING: f64 = 1e-9;
/// Note on a beam that is not extracted.
const LEFT: &str = "sun: the beam is left on the data's cells";

/// Direct sun through patch-averaged data: beams, the rest on cells, and a note on the method.
pub struct SunOnCells {
    /// Beams separated from the cells.
    pub beams: Vec<BeamLight>,
    /// Luminance of the rest by emergent cell. \[cd/m²\]
    pub luminance: Vec<f64>,
    /// Uncertainties of `luminance`, as in [`super::CellLight::uncertainties`].
    pub uncertainties: Vec<Vec<f64>>,
    /// Sentence on what was done.
    pub note: String,
}

/// Beams in a matrix, and the rest of its light.
pub struct Peaks {
    matrix: CellMatrix,
    around: Neighbours,
    paths: Vec<Path>,
    beams: Option<MeanField>,
    /// Strongest mean; strengths in `beams` are shares of it.
    strongest: f64,
    /// Light that is not in beams, row by row: smooth light, and what stands out of it in single cells. \[1/sr\]
    rest: Vec<Rest>,
    /// Transmittance of the smooth part.
    even: Option<MeanField>,
    /// Incident cells that the fields are fitted to.
    used: Vec<usize>,
    /// Share of the peaks' flux that leaks into the cells around them.
    leak: f64,
    /// Ratio of the peaks to their surroundings.
    contrast: f64,
}

/// Part of a row that is not in beams.
struct Rest {
    even: Vec<f64>,
    uneven: Vec<f64>,
}

/// Returns the observations that a path sends nothing from the ends of the rows of a cell's points.
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
    /// Looks for beams in a matrix. `sun`: its direction, should there be too many cells to look at all of them.
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

    /// Fits the beams to what their cells hold above the surroundings.
    fn find_beams(&mut self, parts: &Separation<'_>, reached: &[Vec<Reached>]) {
        let (mut observations, mut backgrounds): (Vec<Observation>, Vec<f64>) = (Vec::new(), Vec::new());
        let (mut above, mut below, mut leaked, mut held) = (0.0, 0.0, 0.0, 0.0);
        for &i in &self.used {
            let row = self.matrix.row(i);
            let straight = &reached[0][i].cells;
            let turned: &[usize] = reached.get(1).map_or(&[], |all| &all[i].cells);
            for (k, cells) in [straight.as_slice(), turned].into_iter().enumerate() {
                // Cells that both paths lead to count as the straight one's: there both are seen together.
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
                    // What leaks out of a lobe does so on all sides: twice the lesser half of it.
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
        // No light goes backwards: where a mean is nothing, the beam is nothing all over the cell. That tells where a
        // cut-off lies far better than the means do.
        let sharper: Vec<Observation> = lit.into_iter().map(|i| observations[i].clone()).chain(dark).collect();
        self.beams = MeanField::new(sharper, covariances);
    }

    /// Splits the light that is not in beams into smooth light and what stands out of it.
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

    /// Returns the emergent cells.
    pub fn basis(&self) -> &RingBasis {
        self.matrix.emergent()
    }

    /// Computes the sun's light behind the system; `None` where the sun lies in none of the incident cells.
    pub fn sun(&self, facing: &Facing<'_>) -> Option<SunOnCells> {
        let incident = facing.sun_illuminance();
        let (light, sun) = (facing.sun?, facing.sun_entering().filter(|_| incident > 0.0)?);
        let cell = self.matrix.incident().index(sun)?;
        let weight = self.basis().projected_solid_angles();
        let mut beams = Vec::new();
        let mut words = Vec::new();
        let mut spread = vec![0.0; weight.len()];
        // How much of a beam may be a lobe instead.
        let lobe = (2.0 * self.leak).min(1.0);
        // Two paths that end in one cell: their sum is known better than either.
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
            // What is near to nothing may be nothing: smooth functions round off a cut-off.
            let error = error.max(strength.min(CUT_OFF * self.strongest));
            let error = if mixed { error.hypot(MIXED * both) } else { error };
            // It is a share of the light.
            let error = error.min(strength.max(1.0 - strength));
            if strength + error < 1e-6 {
                continue;
            }
            let strength = strength.max(NOTHING);
            let straight = *path == Path::Straight;
            let exitance = strength * incident;
            let normal = if straight { strength * light.direct_normal } else { exitance / to.vector().z };
            // What hides a part of the disc hides it from the sensor, too.
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
            // Light that stands out and is followed nowhere: a beam or a fan of beams that may be anywhere in its
            // cells.
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
    /// Returns this light with its beams left on the cells; the beams then count as uncertainty.
    fn on_cells(mut self, row: &[f64]) -> Self {
        for beam in &mut self.beams {
            let whole = 1.0 + beam.uncertainty;
            beam.exitance *= NOTHING;
            beam.normal *= NOTHING;
            beam.uncertainty = whole / NOTHING;
        }
        // A beam spread in its cell is off by itself everywhere: in its patch, and where the cell shines beside it.
        self.uncertainties.push(row.iter().zip(&self.luminance).map(|(stored, rest)| stored - rest).collect());
        self.luminance = row.to_vec();
        self
    }
}

impl Emission {
    /// Replaces the stored row of the sun's cell by the sun's light that `peaks` gives. `sharp`: its beams are
    /// extracted from the cells; else they only count as uncertainty.
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

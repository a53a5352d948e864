//! Compact storage of datasets (wavelets), and its effect on illuminances in a standard room.
//!
//! The standard room is 4 × 6 × 3 m with a façade aperture of 4 × 2 m, its sill at 1 m, and 8 × 12 sensors at 0.85 m.
//! Illuminances are direct ones, with each incident direction representing its patch, so that original and compressed
//! data are compared, not two interpolations between incident directions.

use crate::compute::angle::Bearing;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{Band, Btdf, CellMatrix, Component, Dataset, Finding, Indicatrices, Scattered};
use crate::compute::direction::{Dir, Facade, Orientation, Surface};
use crate::compute::room::aperture::Aperture;
use crate::compute::room::direct::{Reception, Sensor};
use crate::compute::sky::{Distribution, Frame, Outside, incident_illuminances};
use crate::compute::wavelet::{CompactError, CompactReport, CompactRows, Criterion};
use crate::formats::{compact_rows, dataset_blob};
use glam::DVec3;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;

/// Method by which a dataset is stored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Storage {
    /// Storage of every value (rounded to f32 in the catalogue).
    Lossless,
    /// Compression by wavelets, with errors limited by this criterion.
    Compact(Criterion),
}

/// Size of the losslessly stored data below which datasets are stored without loss by default. \[bytes\]
pub const LOSSLESS_BELOW: usize = 1 << 20;

impl Storage {
    /// Returns the default method of storage for a dataset: without loss for small ones, else compressed.
    pub fn default_for(dataset: &Dataset) -> Self {
        if dataset_blob::encode(dataset).len() < LOSSLESS_BELOW {
            Self::Lossless
        } else {
            Self::Compact(Criterion::ARCHIVE)
        }
    }
}

/// Changes that compression causes in the standard room under one outside (sky or sun).
#[derive(Debug, Clone, PartialEq)]
pub struct RoomEffect {
    /// Name of the outside: "overcast" or the position of a sun.
    pub outside: String,
    /// Share of the flux through the aperture that leaves in wrong directions after compression: ½Σ|ΔΦ| / ΣΦ.
    pub lid_misplaced: f64,
    /// Mean relative change of the illuminances at the sensors: Σ|ΔE| / ΣE.
    pub illuminance: f64,
    /// Largest relative change of the illuminance at a sensor: |ΔE| / max(E, 1 % of the mean).
    pub illuminance_worst: f64,
    /// Mean illuminance of the sensors with the original data. \[lx\]
    pub mean_illuminance: f64,
}

/// Report on the compression of one function of a dataset, such as its front transmission.
#[derive(Debug, Clone, PartialEq)]
pub struct CompactedFunction {
    /// Name of the function: band and component, such as `visible transmission_front`.
    pub name: String,
    /// Numbers of values before and after compression, and the errors of the compressed values.
    pub report: CompactReport,
    /// Size when stored without loss: f32, byte planes, zstd. \[bytes\]
    pub bytes_lossless: usize,
    /// Size when stored compressed. \[bytes\]
    pub bytes: usize,
    /// Size of the compressed data in memory while they are in use. \[bytes\]
    pub bytes_in_use: usize,
    /// Changes of the light in the standard room, one entry for each sky and sun; only for the visible transmission
    /// from outside, else empty.
    pub effects: Vec<RoomEffect>,
}

impl CompactedFunction {
    /// Returns the ratio of the size as plain f32 values to the compressed size.
    pub fn byte_ratio(&self) -> f64 {
        (4 * self.report.rows * self.report.cells) as f64 / self.bytes.max(1) as f64
    }
}

/// Dataset after compression, with a report on each of its functions.
#[derive(Debug, Clone)]
pub struct Compacted {
    /// Compressed dataset; functions that cannot be compressed (closed forms, tensor trees) are unchanged.
    pub dataset: Dataset,
    /// Reports on the functions that were compressed.
    pub functions: Vec<CompactedFunction>,
}

/// Data of a function that can be compressed: luminance coefficients by incident and emergent patches, or by emergent
/// patches for single incident directions.
#[derive(Clone, Copy)]
enum Data<'a> {
    Cells(&'a CellMatrix),
    Directions(&'a Indicatrices),
}

impl<'a> Data<'a> {
    fn of(btdf: &'a Btdf) -> Option<Self> {
        match &btdf.scattered {
            Some(Scattered::Cells(matrix)) => Some(Self::Cells(matrix)),
            Some(Scattered::Directions(data)) => Some(Self::Directions(data)),
            _ => None,
        }
    }

    /// Compresses the data; returns them and their compressed rows.
    fn compacted(self, criterion: Criterion) -> Result<(Scattered, Arc<CompactRows>), CompactError> {
        let taken = |rows: Option<&Arc<CompactRows>>| Arc::clone(rows.expect("the compact form was just made"));
        Ok(match self {
            Self::Cells(matrix) => {
                let made = matrix.compacted(criterion)?;
                let rows = taken(made.compact_rows());
                (Scattered::Cells(Box::new(made)), rows)
            }
            Self::Directions(data) => {
                let made = data.compacted(criterion)?;
                let rows = taken(made.compact_rows());
                (Scattered::Directions(std::sync::Arc::new(made)), rows)
            }
        })
    }

    fn row(self, index: usize) -> Cow<'a, [f64]> {
        match self {
            Self::Cells(matrix) => matrix.row(index),
            Self::Directions(data) => data.row(index),
        }
    }

    fn emergent(self) -> &'a RingBasis {
        match self {
            Self::Cells(matrix) => matrix.emergent(),
            Self::Directions(data) => data.emergent(),
        }
    }

    /// Returns the basis of incident patches, with the index of the row of data that represents each patch.
    fn incident(self) -> (RingBasis, Vec<Option<usize>>) {
        match self {
            Self::Cells(matrix) => (matrix.incident().clone(), (0..matrix.incident().len()).map(Some).collect()),
            Self::Directions(data) => {
                let cells = data.lattice().cloned().unwrap_or_else(|| RingBasis::equal_area(40));
                let rows = cells.cells().map(|cell| data.standing_for(cell.centre())).collect();
                (cells, rows)
            }
        }
    }

    fn standing_for(self, d: Dir<Facade>) -> Option<usize> {
        match self {
            Self::Cells(matrix) => matrix.incident().index(d),
            Self::Directions(data) => data.standing_for(d),
        }
    }

    fn is_compact(self) -> bool {
        match self {
            Self::Cells(matrix) => matrix.compact_rows().is_some(),
            Self::Directions(data) => data.compact_rows().is_some(),
        }
    }
}

/// Compresses every function of a dataset whose values are given by incident patches or at single incident directions.
///
/// # Errors
/// Returns an error for values that have no compact form, or a threshold out of range.
pub fn compact(dataset: &Dataset, criterion: Criterion) -> Result<Compacted, CompactError> {
    let mut made = dataset.clone();
    let mut functions = Vec::new();
    compact_band("visible", &dataset.visible, &mut made.visible, criterion, &mut functions)?;
    if let (Some(given), Some(band)) = (&dataset.solar, &mut made.solar) {
        compact_band("solar", given, band, criterion, &mut functions)?;
    }
    if dataset.derived.contains(&Component::TransmissionBack) {
        // Functions that were derived by reciprocity are derived again, and so take no space.
        turn_back(&mut made.visible, &mut functions);
        made.solar.iter_mut().for_each(|band| turn_back(band, &mut Vec::new()));
    }
    Ok(Compacted { dataset: made, functions })
}

fn turn_back(band: &mut Band, functions: &mut Vec<CompactedFunction>) {
    if let Some(Btdf { regular, scattered: Some(Scattered::Cells(front)) }) = &band.transmission_front {
        let scattered = Some(Scattered::Cells(Box::new(front.reversed())));
        band.transmission_back = Some(Btdf { regular: regular.clone(), scattered });
        functions.retain(|function| !function.name.ends_with(Component::TransmissionBack.key()));
    }
}

/// Compresses the functions of one spectral band. `given`: original band; `made`: band that receives the compressed
/// functions; `functions`: list that receives the reports.
fn compact_band(
    name: &str,
    given: &Band,
    made: &mut Band,
    criterion: Criterion,
    functions: &mut Vec<CompactedFunction>,
) -> Result<(), CompactError> {
    for component in given.components() {
        let Some(btdf) = given.get(component) else { continue };
        let Some(data) = Data::of(btdf).filter(|data| !data.is_compact()) else { continue };
        let (scattered, rows) = data.compacted(criterion)?;
        let back = Btdf { regular: btdf.regular.clone(), scattered: Some(scattered) };
        let effects = match Data::of(&back) {
            Some(after) if name == "visible" && component == Component::TransmissionFront => room_effects(data, after),
            _ => Vec::new(),
        };
        functions.push(CompactedFunction {
            name: format!("{name} {}", component.key()),
            report: CompactReport::new(&rows, |index| data.row(index).into_owned()),
            bytes_lossless: dataset_blob::lossless_bytes(rows.len(), |index| data.row(index).into_owned()),
            bytes: compact_rows::write(&rows).len(),
            bytes_in_use: rows.bytes_in_use(),
            effects,
        });
        made.set(component, back);
    }
    Ok(())
}

/// Returns the dataset as it is stored by the given method, with findings on the compression.
///
/// # Errors
/// Returns the errors of [`compact`].
pub fn stored_as(dataset: &Dataset, storage: Storage) -> Result<Dataset, CompactError> {
    let Storage::Compact(criterion) = storage else { return Ok(dataset.clone()) };
    let Compacted { mut dataset, functions } = compact(dataset, criterion)?;
    dataset.findings.extend(functions.iter().map(|function| finding(function, criterion)));
    Ok(dataset)
}

/// Returns the dataset as it is stored by its default method. Data that cannot be compressed are stored without loss,
/// with a finding that says why.
pub fn stored_by_default(dataset: &Dataset) -> Dataset {
    stored_as(dataset, Storage::default_for(dataset)).unwrap_or_else(|error| {
        let mut kept = dataset.clone();
        kept.findings.push(Finding::info("lossless-storage", format!("Kept without loss: {error}.")));
        kept
    })
}

/// Returns the finding on the compression of one function, as a sentence for the user.
fn finding(function: &CompactedFunction, criterion: Criterion) -> Finding {
    let report = &function.report;
    let worst = function.effects.iter().map(|effect| effect.illuminance).fold(0.0, f64::max);
    let room = if function.effects.is_empty() {
        String::new()
    } else {
        format!("; illuminance in the standard room changes by {:.2} % or less on average", 100.0 * worst)
    };
    Finding::info(
        "compact-storage",
        format!(
            "{} is kept in compact form ({}): {:.1} times fewer numbers, {:.1} times fewer bytes than \
             f32; misplaced flux {:.2} % on \
             average and {:.2} % at worst, rms {:.2} %, τ kept exactly{room}.",
            function.name.replace('_', " "),
            criterion_words(criterion),
            report.ratio(),
            function.byte_ratio(),
            100.0 * report.misplaced,
            100.0 * report.misplaced_worst,
            100.0 * report.rms,
        ),
    )
}

/// Formats the criterion of a compression, such as "at most 1 % of the flux misplaced".
pub fn criterion_words(criterion: Criterion) -> String {
    let percent = 100.0 * criterion.threshold();
    match criterion {
        Criterion::Misplaced(_) => format!("at most {percent} % of the flux misplaced"),
        Criterion::Rms(_) => format!("at most {percent} % rms"),
        Criterion::Energy(e) => {
            format!("at most {percent} % of the energy Σc² dropped, that is {:.3} % rms", 100.0 * e.sqrt())
        }
    }
}

/// Aperture of the standard room.
const APERTURE: Aperture = Aperture { surface: Surface::Facade, corner: DVec3::new(0.0, 0.0, 1.0), size: [4.0, 2.0] };
/// Positions of the suns in the standard room: altitude, and bearing from the façade's normal. \[°\]
const SUNS: [(f64, f64); 3] = [(20.0, 0.0), (45.0, 30.0), (60.0, -40.0)];
/// Direct normal illuminance of each of these suns. \[lx\]
const DIRECT_NORMAL: f64 = 80_000.0;

fn sensors() -> Vec<Sensor> {
    let at = |k: usize, count: usize, size: f64| (k as f64 + 0.5) * size / count as f64;
    let place = |k: usize| DVec3::new(at(k % 8, 8, 4.0), at(k / 8, 12, 6.0), 0.85);
    (0..96).map(|k| Sensor { position: place(k), normal: DVec3::Z }).collect()
}

/// Standard room, which gives the direct illuminances at its sensors from the luminances that its aperture emits by
/// patch.
#[derive(Debug)]
pub struct StandardRoom {
    receptions: Vec<Reception>,
    weights: Vec<f64>,
}

impl StandardRoom {
    /// Creates the room for luminances on the patches of an emergent basis.
    pub fn new(basis: &RingBasis) -> Self {
        let receptions = sensors().par_iter().map(|sensor| Reception::new(sensor, &APERTURE, Some(basis))).collect();
        Self { receptions, weights: basis.projected_solid_angles() }
    }

    /// Returns the direct illuminances of the 8 × 12 sensors for emergent luminances by patch \[cd/m²\]. \[lx\]
    pub fn illuminances(&self, luminance: &[f64]) -> Vec<f64> {
        let at = |reception: &Reception| reception.cells.iter().zip(luminance).map(|(w, l)| w * l).sum();
        self.receptions.iter().map(at).collect()
    }

    /// Compares the light in the room for emergent luminances by patch before and after compression. \[cd/m²\]
    /// `outside`: name of the sky or sun.
    pub fn effect(&self, outside: String, before: &[f64], after: &[f64]) -> RoomEffect {
        let flux: f64 = self.weights.iter().zip(before).map(|(w, l)| w * l).sum();
        let moved: f64 = self.weights.iter().zip(before.iter().zip(after)).map(|(w, (b, a))| w * (b - a).abs()).sum();
        let (e, e_after) = (self.illuminances(before), self.illuminances(after));
        let total: f64 = e.iter().sum();
        let mean = total / e.len() as f64;
        let changes = || e.iter().zip(&e_after).map(|(b, a)| (a - b).abs());
        let share = |part: f64, all: f64| if all > 0.0 { part / all } else { 0.0 };
        RoomEffect {
            outside,
            lid_misplaced: share(0.5 * moved, flux),
            illuminance: share(changes().sum(), total),
            illuminance_worst: changes().zip(&e).map(|(c, e)| share(c, e.max(0.01 * mean))).fold(0.0, f64::max),
            mean_illuminance: mean,
        }
    }
}

/// Returns for each outside – the overcast sky (CIE type 16, 10 klx, ground reflectance 0.2) and three suns – the
/// indices of the rows of data that it illuminates, each with the illuminance of the aperture that the row represents.
/// \[lx\]
///
/// `incident`: basis of incident patches; `row_of_cell`: index of the row that represents each of them; `row_of`: index
/// of the row for a direction of the sun.
pub fn standard_outsides(
    incident: &RingBasis,
    row_of_cell: &[Option<usize>],
    row_of: impl Fn(Dir<Facade>) -> Option<usize>,
) -> Vec<(String, Vec<(usize, f64)>)> {
    let orientation = Orientation::new(Bearing::from_degrees(180.0));
    let overcast = Distribution::cie(16, Dir::from_unit(DVec3::Z)).expect("type 16 is the traditional overcast sky");
    let overcast = Outside::new(overcast, 10_000.0).and_then(|sky| sky.with_ground(0.2, 0.0));
    let overcast = overcast.expect("10 klx over ground of 0.2 is an outside");
    let frame = Frame::of_aperture(orientation, Surface::Facade);
    let illuminance = incident_illuminances(&overcast, incident, &frame);
    let rows = row_of_cell.iter().zip(illuminance).filter_map(|(row, e)| row.map(|row| (row, e.value)));
    let mut out = vec![("overcast".to_owned(), rows.collect())];
    for (altitude, aside) in SUNS {
        let world = Dir::from_altitude_bearing(f64::to_radians(altitude), Bearing::from_degrees(180.0 + aside));
        let direction = Surface::Facade.facade_dir(orientation.room_from_world(world));
        let rows = row_of(direction).map(|row| (row, DIRECT_NORMAL * direction.vector().z));
        out.push((format!("sun {altitude}° high, {aside}° aside"), rows.into_iter().collect()));
    }
    out
}

/// Computes the effects of compression in the standard room, under each of its outsides.
fn room_effects(before: Data<'_>, after: Data<'_>) -> Vec<RoomEffect> {
    let room = StandardRoom::new(before.emergent());
    let (cells, rows) = before.incident();
    let luminance = |data: Data<'_>, light: &[(usize, f64)]| {
        let mut sum = vec![0.0; data.emergent().len()];
        for &(row, e) in light {
            sum.iter_mut().zip(data.row(row).iter()).for_each(|(l, q)| *l += q * e);
        }
        sum
    };
    standard_outsides(&cells, &rows, |d| before.standing_for(d))
        .into_iter()
        .map(|(name, light)| room.effect(name, &luminance(before, &light), &luminance(after, &light)))
        .collect()
}

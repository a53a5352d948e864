//! Numbers of Figures 7–9, 11 and 12: averaging of the outside, and filtering, compression and interpolation of
//! indicatrices.

use crate::outlines::outside;
use crate::systems::{self, Law, OVERCAST, measured, redirecting};
use anyhow::{Context as _, Result};
use cfs::compute::basis::RingBasis;
use cfs::compute::btdf::Indicatrices;
use cfs::compute::direction::{Dir, Facade};
use cfs::compute::incidence::filter::{self, Filter, Kernel};
use cfs::compute::incidence::grid::Grid;
use cfs::compute::incidence::left_out::LeftOut;
use cfs::compute::incidence::model::Model;
use cfs::compute::incidence::schemes::SunScheme;
use cfs::compute::lid::Facing;
use cfs::compute::sky::{Frame, incident_illuminances};
use cfs::compute::wavelet::{CompactReport, Criterion};
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// Returns the direction in the vertical section through the sun at an angle from the normal towards the sun. \[°\]
pub fn in_section(degrees: f64, towards: f64) -> Dir<Facade> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Dir::from_unit(DVec3::new(0.0, towards * sin, cos))
}

/// Figure 7: section through the luminances outside, as seen from a roof, and amplitudes of its Fourier transform.
pub struct Section {
    pub name: &'static str,
    /// Angle from the zenith towards the sun \[°\], luminance, mean of its Tregenza patch, mean within 6° around it;
    /// luminances relative to the largest.
    pub points: Vec<[f64; 4]>,
    /// Frequency \[1/°\], amplitudes of the luminance and of the patch means, relative to the amplitude at frequency 0.
    pub spectrum: Vec<[f64; 3]>,
    /// Share of the variance of the luminance at frequencies above 1/(24°), which samples 12° apart cannot resolve.
    pub lost: f64,
}

/// Computes the sections: overcast, clear with the sun at 20°, and overcast above a dark obstruction up to 40°.
pub fn sections() -> Result<Vec<Section>> {
    let blocked = format!("{OVERCAST}\nobstruction = {{ altitude = 40.0, luminance = 200.0 }}");
    [("overcast", OVERCAST), ("clear, sun at 20°", systems::CLEAR), ("overcast, obstructed to 40°", &*blocked)]
        .into_iter()
        .map(|(name, sky)| {
            let scene = systems::top_lit(sky, vec![[2.0, 3.0, 0.0]]).scene(&Arc::new(systems::open()))?;
            Ok(section(name, &scene.facing(0)))
        })
        .collect()
}

fn section(name: &'static str, facing: &Facing<'_>) -> Section {
    let patches = RingBasis::tregenza();
    let frame = Frame::of_aperture(facing.orientation, facing.surface);
    let illuminance = incident_illuminances(facing.outside, &patches, &frame);
    let means: Vec<f64> = illuminance.iter().zip(patches.projected_solid_angles()).map(|(e, w)| e.value / w).collect();
    let angles: Vec<f64> = (0..360).map(|k| -90.0 + 0.5 * (f64::from(k) + 0.5)).collect();
    let rows: Vec<[f64; 4]> = angles
        .iter()
        .map(|&angle| {
            let d = in_section(angle, -1.0);
            let patch = patches.index(d).map_or(0.0, |k| means[k]);
            [angle, outside(facing, d), patch, within(facing, d, 6_f64.to_radians())]
        })
        .collect();
    let most = rows.iter().map(|row| row[1]).fold(0.0, f64::max);
    let amplitude = |column: usize, frequency: f64| {
        let (re, im) = rows.iter().fold((0.0, 0.0), |(re, im), row| {
            let (sin, cos) = (2.0 * PI * frequency * row[0]).sin_cos();
            (re + row[column] * cos, im + row[column] * sin)
        });
        re.hypot(im)
    };
    let spectrum: Vec<[f64; 3]> = (0..=36)
        .map(|k| f64::from(k) / 180.0)
        .map(|f| [f, amplitude(1, f) / amplitude(1, 0.0), amplitude(2, f) / amplitude(2, 0.0)])
        .collect();
    let energy = |above: f64| {
        (1..180).map(|k| f64::from(k) / 180.0).filter(|f| *f > above).map(|f| amplitude(1, f).powi(2)).sum::<f64>()
    };
    let lost = energy(1.0 / 24.0) / energy(0.0);
    let points = rows.iter().map(|row| [row[0], row[1] / most, row[2] / most, row[3] / most]).collect();
    Section { name, points, spectrum, lost }
}

/// Returns the mean luminance within `radius` around a direction, without directions below the plane.
fn within(facing: &Facing<'_>, d: Dir<Facade>, radius: f64) -> f64 {
    let (x, y) = d.vector().any_orthonormal_pair();
    let (mut sum, mut count) = (0.0, 0.0);
    for k in 0..200 {
        let r = radius * ((f64::from(k) + 0.5) / 200.0).sqrt();
        let (sin, cos) = (2.399_963 * f64::from(k)).sin_cos();
        let v = (d.vector() + r * (x * cos + y * sin)).normalize();
        if v.z > 0.0 {
            sum += outside(facing, Dir::from_unit(v));
            count += 1.0;
        }
    }
    sum / count
}

/// Kernels of Figure 8, and shift-and-weight, which has none.
pub const KERNELS: [(&str, Option<Filter>); 6] = [
    ("unfiltered", Some(Filter { kernel: Kernel::None, sharp_only: false })),
    ("narrow 6°", Some(Filter { kernel: Kernel::NARROW, sharp_only: false })),
    ("matched 12°", Some(Filter { kernel: Kernel::MATCHED, sharp_only: false })),
    ("wide 24°", Some(Filter { kernel: Kernel::WIDE, sharp_only: false })),
    ("shape of the patch", Some(Filter { kernel: Kernel::Patch, sharp_only: true })),
    ("shift-and-weight", None),
];

/// Diffuse light through indicatrices, by one of the methods of [`KERNELS`].
pub struct Superposed {
    pub name: &'static str,
    pub grid: Grid,
    /// Luminance per cell of `grid`. \[cd/m²\]
    pub luminance: Vec<f64>,
    /// Standard deviation over mean of the luminance, by projected solid angle, within 78° of the normal.
    pub unevenness: f64,
    /// Misplaced flux ½Σ|L − L_e| PΩ / Σ L_e PΩ, where L_e is computed from 2304 incident directions.
    pub misplaced: f64,
}

/// Computes the luminance of a rooflight with a law of scattering under a sky, by every method of [`KERNELS`].
pub fn superposed(law: Law, sky: &str) -> Result<Vec<Superposed>> {
    let scene = systems::top_lit(sky, vec![[2.0, 3.0, 0.0]]).scene(&Arc::new(systems::open()))?;
    let facing = scene.facing(0);
    let frame = Frame::of_aperture(facing.orientation, facing.surface);
    let patches = RingBasis::tregenza();
    let emergent = RingBasis::equal_area(32);
    let model = Model::new(Arc::new(measured(&patches, &emergent, law)));
    let through = |basis: &RingBasis| -> Vec<f64> {
        incident_illuminances(facing.outside, basis, &frame).iter().map(|e| e.value).collect()
    };
    let illuminance = through(&patches);
    let truth = dense(law, &emergent, &through);
    KERNELS
        .into_iter()
        .map(|(name, filter)| {
            let luminance = match filter {
                Some(filter) => filter::diffuse(&model, filter, model.grid(), &illuminance).context("patches")?,
                None => {
                    let sub = cfs::compute::incidence::superpose::sub_patches(2.5_f64.to_radians());
                    cfs::compute::incidence::superpose::diffuse(&model, &sub, &through(&sub)).luminance
                }
            };
            let grid = model.grid().clone();
            let inner: Vec<usize> =
                (0..emergent.len()).filter(|k| grid.centre[*k].z > 78_f64.to_radians().cos()).collect();
            let mean = inner.iter().map(|&k| luminance[k]).sum::<f64>() / inner.len() as f64;
            let square = inner.iter().map(|&k| (luminance[k] - mean).powi(2)).sum::<f64>() / inner.len() as f64;
            let off: f64 = luminance.iter().zip(&truth).map(|(l, t)| (l - t).abs()).sum();
            let misplaced = 0.5 * off / truth.iter().sum::<f64>();
            Ok(Superposed { name, grid, luminance, unevenness: square.sqrt() / mean, misplaced })
        })
        .collect()
}

/// Computes the luminance of the cells from 2304 incident directions, each with its exact indicatrix.
fn dense(law: Law, emergent: &RingBasis, through: &dyn Fn(&RingBasis) -> Vec<f64>) -> Vec<f64> {
    use rayon::prelude::*;
    let fine = RingBasis::equal_area(24);
    let list: Vec<(Dir<Facade>, f64)> = fine.cells().map(|cell| cell.centre()).zip(through(&fine)).collect();
    let parts: Vec<Vec<f64>> = list
        .par_chunks(192)
        .map(|chunk| {
            let mut sum = vec![0.0; emergent.len()];
            for (d, e) in chunk {
                systems::indicatrix(emergent, law, *d).iter().zip(&mut sum).for_each(|(q, sum)| *sum += q * e);
            }
            sum
        })
        .collect();
    (0..emergent.len()).map(|k| parts.iter().map(|part| part[k]).sum()).collect()
}

/// Figure 11: compression of one system at one threshold.
pub struct Compression {
    pub system: &'static str,
    pub criterion: &'static str,
    pub report: CompactReport,
}

/// Thresholds: energy as in the report, root mean square, misplaced flux.
pub const CRITERIA: [(&str, Criterion); 8] = [
    ("energy 1 %", Criterion::Energy(0.01)),
    ("energy 5 %", Criterion::Energy(0.05)),
    ("energy 10 %", Criterion::Energy(0.10)),
    ("rms 1 %", Criterion::Rms(0.01)),
    ("rms 5 %", Criterion::Rms(0.05)),
    ("rms 10 %", Criterion::Rms(0.10)),
    ("misplaced flux 0.5 %", Criterion::Misplaced(0.005)),
    ("misplaced flux 1.5 %", Criterion::Misplaced(0.015)),
];

/// Returns the data of Figure 11: 9 incident directions on 9216 cells, with measurement noise (2 % of every value).
pub fn compressed_systems() -> [(&'static str, Indicatrices); 2] {
    let (lattice, emergent) = (incidences(), RingBasis::equal_area(48));
    [("light-redirecting glass", redirecting as Law), ("diffuser", systems::opal as Law)].map(|(name, law)| {
        let mut count = 0_u64;
        let values = lattice.iter().flat_map(|d| systems::indicatrix(&emergent, law, *d)).map(|q| {
            count += 1;
            q * (1.0 + 0.02 * noise(count))
        });
        let values = values.collect();
        let incident = lattice.iter().map(|d| cfs::compute::direction::Incident(*d)).collect();
        (name, Indicatrices::new(incident, emergent.clone(), values).expect("nine different directions"))
    })
}

/// Returns nine incident directions, first that of Figure 3 of the report (altitude 48°, from above).
fn incidences() -> Vec<Dir<Facade>> {
    let at = |theta: f64, phi: f64| Dir::from_theta_phi(theta.to_radians(), phi.to_radians());
    let around = (0..8).map(|k| at(12.0 + 9.0 * f64::from(k), 30.0 + 40.0 * f64::from(k)));
    std::iter::once(at(42.0, 90.0)).chain(around).collect()
}

/// Returns a number uniformly distributed between −√3 and √3 (variance 1), equal in every run.
fn noise(seed: u64) -> f64 {
    let mut z = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 * 12_f64.sqrt() - 3_f64.sqrt()
}

/// Compresses one system with all thresholds; also returns the first indicatrix at the first threshold (1 % energy).
pub fn compressions(system: &'static str, data: &Indicatrices) -> Result<(Vec<Compression>, Vec<f64>)> {
    let mut first = Vec::new();
    let mut list = Vec::new();
    for (criterion, threshold) in CRITERIA {
        let compact = data.compacted(threshold)?;
        let rows = compact.compact_rows().context("compact rows")?;
        if first.is_empty() {
            first = rows.row(0);
        }
        let report = CompactReport::new(rows, |row| data.row(row).into_owned());
        list.push(Compression { system, criterion, report });
    }
    Ok((list, first))
}

/// Figure 12: interpolation for a sun within a triangle of incident directions.
pub struct Between {
    pub grid: Grid,
    /// Data of the three directions around the sun, with their weights.
    pub around: Vec<(f64, Vec<f64>)>,
    /// Exact indicatrix of the system.
    pub truth: Vec<f64>,
    /// Per scheme: its key, its indicatrix, its misplaced flux, and the misplaced flux that is predicted for it.
    pub schemes: Vec<(&'static str, Vec<f64>, f64, f64)>,
}

/// Computes the light-redirecting glass from data at 145 incident directions, with the sun at θ = 42°, φ = 75°.
pub fn between() -> Between {
    let emergent = RingBasis::equal_area(40);
    let data = measured(&RingBasis::tregenza(), &emergent, redirecting);
    let model = Model::new(Arc::new(data.clone()));
    let left_out = LeftOut::new(&model);
    let sun = Dir::from_theta_phi(42_f64.to_radians(), 75_f64.to_radians());
    let truth = systems::indicatrix(&emergent, redirecting, sun);
    let place = model.lattice().locate(sun);
    let around = (0..3).map(|k| (place.weights[k], data.row(place.vertices[k]).into_owned())).collect();
    let weights = emergent.projected_solid_angles();
    // The three schemes of the report first.
    let list = SunScheme::ALL.into_iter().cycle().skip(1).take(SunScheme::ALL.len()).map(|scheme| {
        let q = scheme.coefficient(&model, sun, model.grid(), 3);
        let error = Criterion::ARCHIVE.error(&weights, &truth, &q);
        (scheme.key(), q, error, left_out.stated(scheme, &place))
    });
    let list = list.collect();
    Between { grid: model.grid().clone(), around, truth, schemes: list }
}

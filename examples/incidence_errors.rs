//! Tests the stated uncertainty of light that comes from between the incident directions of a dataset.
//!
//! `cargo run --release --example incidence_errors` (reads no files)
//!
//! Seven analytic systems are sampled at 145 incident directions; at sensors, the stated uncertainty is compared with
//! the error, which is known exactly. The tables vary one constant of the uncertainty at a time;
//! `compute::incidence::superpose` takes its constants from them (`*` marks the value in use).
//!
//! Look at *kept*, the share of sensors whose error is not larger than the stated uncertainty, and at *padding*, the
//! sum of stated uncertainties divided by the sum of errors. A sensor receives all light within 20° of a direction,
//! as through an aperture some metres away. Sensors below 1 % of the mean do not count.

#[allow(dead_code, reason = "the test compares by another measure")]
#[path = "../tests/compute/incidence_schemes/schemes.rs"]
mod schemes;

use anyhow::Context as _;
use cfs::compute::basis::RingBasis;
use cfs::compute::btdf::Indicatrices;
use cfs::compute::direction::{Dir, Facade, Incident};
use cfs::compute::incidence::grid::Grid;
use cfs::compute::incidence::model::Model;
use cfs::compute::incidence::superpose::{self, BEYOND, PLACE, REST, SUN_REST, sub_patches};
use glam::DVec3;
use rayon::prelude::*;
use schemes::{Judge, NAMES};
use std::f64::consts::PI;
use std::sync::Arc;

/// Size of the emergent cells of the data. \[°\]
const CELLS: f64 = 2.5;
/// Number of parts per side into which a cell is divided for direct sun.
const PARTS: usize = 2;
/// Polar angle of the outermost row of incident directions. \[°\]
const LAST_ROW: f64 = 84.0;
/// Half the opening angle of a sensor. \[°\]
const SEEN: f64 = 20.0;
/// Sensors below this share of the mean do not count.
const DARK: f64 = 0.01;

/// Sensor with its interpolated and its exact light, and the parts of the stated uncertainty.
struct Sensor {
    given: f64,
    truth: f64,
    /// Difference to linear interpolation.
    linear: f64,
    /// Root sum of squares of the effects of both shifts of the lobes, at [`PLACE`].
    place: f64,
    /// Position of the sun beyond the outermost row, 0 to 1.
    beyond: f64,
}

/// Constants of the stated uncertainty.
#[derive(Clone, Copy)]
struct Constants {
    linear: f64,
    place: f64,
    sun_rest: f64,
    beyond: f64,
    rest: f64,
}

const IN_USE: Constants = Constants { linear: 1.0, place: PLACE, sun_rest: SUN_REST, beyond: BEYOND, rest: REST };

impl Sensor {
    /// Returns the stated uncertainty, combined as in `compute::room::direct`. Diffuse light has no shifts and no
    /// remaining uncertainty of the sun.
    fn stated(&self, c: &Constants, sun: bool) -> f64 {
        let rest = if sun { (c.sun_rest + c.beyond * self.beyond) * self.given } else { 0.0 };
        let uncertainties = [c.linear * self.linear, c.place / PLACE * self.place, rest];
        c.rest * self.given + uncertainties.iter().map(|uncertainty| uncertainty * uncertainty).sum::<f64>().sqrt()
    }
}

/// Returns for each sensor the cells that it sees.
fn views(grid: &Grid) -> Vec<Vec<usize>> {
    let towards = RingBasis::equal_area(5);
    let within = |d: DVec3| (0..grid.centre.len()).filter(move |&k| grid.centre[k].dot(d) > SEEN.to_radians().cos());
    towards.cells().map(|cell| within(cell.centre().vector()).collect()).collect()
}

fn seen(grid: &Grid, view: &[usize], luminance: &[f64]) -> f64 {
    view.iter().map(|&k| luminance[k] * grid.projected[k]).sum()
}

/// Returns the sensors that are not dark.
fn lit(list: Vec<Sensor>) -> Vec<Sensor> {
    let mean = list.iter().map(|s| s.truth).sum::<f64>() / list.len().max(1) as f64;
    list.into_iter().filter(|s| s.truth > DARK * mean).collect()
}

/// Computes the sensors for one position of the sun.
fn under_sun(
    (judge, fine, views): (&Judge, &Grid, &[Vec<usize>]),
    name: &str,
    model: &Model,
    d: Dir<Facade>,
) -> Vec<Sensor> {
    let light = superpose::sun(model, d, 1.0, fine, 2);
    let truth = judge.truth(name, d.vector());
    let beyond = model.lattice().locate(d).beyond;
    let sensor = |view: &Vec<usize>| Sensor {
        given: seen(fine, view, &light.luminance),
        truth: seen(fine, view, &truth),
        linear: seen(fine, view, &light.uncertainty),
        place: light.shifts[..2].iter().map(|shift| seen(fine, view, shift).powi(2)).sum::<f64>().sqrt(),
        beyond,
    };
    lit(views.iter().map(sensor).collect())
}

/// Computes the sensors for a sky with a luminance per direction.
fn under_sky(judge: &Judge, name: &str, model: &Model, sky: fn(DVec3) -> f64) -> Vec<Sensor> {
    let (grid, patches) = (model.grid(), sub_patches(CELLS.to_radians()));
    let of = |k: usize| patches.cell(k).centre().vector();
    let received: Vec<f64> = patches.projected_solid_angles().iter().enumerate().map(|(k, w)| w * sky(of(k))).collect();
    let light = superpose::diffuse(model, &patches, &received);
    let parts: Vec<Vec<f64>> = (0..patches.len())
        .collect::<Vec<_>>()
        .par_chunks(128)
        .map(|chunk| {
            let mut sum = vec![0.0; grid.centre.len()];
            for &k in chunk {
                judge.truth(name, of(k)).iter().zip(&mut sum).for_each(|(q, sum)| *sum += q * received[k]);
            }
            sum
        })
        .collect();
    let truth: Vec<f64> = (0..grid.centre.len()).map(|k| parts.iter().map(|part| part[k]).sum()).collect();
    let sensor = |view: &Vec<usize>| Sensor {
        given: seen(grid, view, &light.luminance),
        truth: seen(grid, view, &truth),
        linear: seen(grid, view, &light.uncertainty),
        place: 0.0,
        beyond: 0.0,
    };
    lit(views(grid).iter().map(sensor).collect())
}

/// Prints one line: kept and padding.
fn line(name: &str, value: f64, used: f64, sensors: &[Sensor], constants: &Constants, sun: bool) {
    let stated: Vec<(f64, f64)> =
        sensors.iter().map(|s| (s.stated(constants, sun), (s.given - s.truth).abs())).collect();
    let kept = stated.iter().filter(|(stated, error)| stated + 1e-12 >= *error).count();
    let (sum, errors) = stated.iter().fold((0.0, 0.0), |(a, b), (stated, error)| (a + stated, b + error));
    let mark = if value == used { "*" } else { " " };
    println!(
        "  {name:<10} {value:>7} {mark} kept {:>5.1} %, padding {:>5.2}",
        100.0 * kept as f64 / stated.len().max(1) as f64,
        sum / errors
    );
}

/// Name of a constant, its value in use, the values to try, and the constants with such a value.
type Range = (&'static str, f64, [f64; 5], fn(f64) -> Constants);

const RANGES: [Range; 5] = [
    ("linear", 1.0, [0.0, 0.5, 1.0, 2.0, 4.0], |linear| Constants { linear, ..IN_USE }),
    ("PLACE", PLACE, [0.0, 0.03, 0.06, 0.09, 0.12], |place| Constants { place, ..IN_USE }),
    ("SUN_REST", SUN_REST, [0.0, 0.006, 0.012, 0.018, 0.024], |sun_rest| Constants { sun_rest, ..IN_USE }),
    ("BEYOND", BEYOND, [0.0, 0.2, 0.4, 0.6, 0.8], |beyond| Constants { beyond, ..IN_USE }),
    ("REST", REST, [0.0, 0.0025, 0.005, 0.0075, 0.01], |rest| Constants { rest, ..IN_USE }),
];

fn main() -> anyhow::Result<()> {
    let cells = sub_patches(CELLS.to_radians());
    let fine = Grid::new(&cells.refined(PARTS));
    let (coarse_judge, fine_judge) = (Judge::new(&cells), Judge::new(fine.basis()));
    let views = views(&fine);
    let incident: Vec<Incident> = RingBasis::tregenza().cells().map(|cell| Incident(cell.centre())).collect();
    let turned = |k: usize| 2.399_963 * k as f64;
    let last = LAST_ROW.to_radians().cos();
    let inside: Vec<Dir<Facade>> = (0..48)
        .map(|k| Dir::from_theta_phi((last + (1.0 - last) * (k as f64 + 0.5) / 48.0).acos(), turned(k)))
        .collect();
    let rim = |k: usize| LAST_ROW + (88.0 - LAST_ROW) * (k as f64 + 0.5) / 24.0;
    let outside: Vec<Dir<Facade>> = (0..24).map(|k| Dir::from_theta_phi(rim(k).to_radians(), turned(k))).collect();
    let skies: [fn(DVec3) -> f64; 2] = [|_| 1.0 / PI, |d| (1.0 + 2.0 * d.y).max(0.0)];
    let [mut sun, mut low, mut sky] = [const { Vec::new() }; 3];
    for name in NAMES {
        let values = incident.iter().flat_map(|d| coarse_judge.truth(name, d.0.vector())).collect();
        let model = Model::new(Arc::new(
            Indicatrices::new(incident.clone(), cells.clone(), values).context("145 different directions")?,
        ));
        let of = |list: &[Dir<Facade>]| -> Vec<Sensor> {
            list.par_iter().flat_map(|&d| under_sun((&fine_judge, &fine, &views), name, &model, d)).collect()
        };
        for (title, list, into) in [("sun", &inside, &mut sun), ("beyond", &outside, &mut low)] {
            let own = of(list);
            line(&format!("{name}, {title}"), 1.0, 0.0, &own, &IN_USE, true);
            into.extend(own);
        }
        let own: Vec<Sensor> = skies.iter().flat_map(|f| under_sky(&coarse_judge, name, &model, *f)).collect();
        line(&format!("{name}, sky"), 1.0, 0.0, &own, &IN_USE, false);
        sky.extend(own);
    }
    for (title, sensors, is_sun) in
        [("sun within the rows", &sun, true), ("sun beyond the last row", &low, true), ("sky", &sky, false)]
    {
        println!("{title}: {} sensors", sensors.len());
        for (name, used, values, constants) in RANGES {
            values.iter().for_each(|&value| line(name, value, used, sensors, &constants(value), is_sun));
        }
    }
    Ok(())
}

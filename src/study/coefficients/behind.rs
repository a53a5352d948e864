//! Daylight coefficients (V·T·D) of an aperture behind boxes: illuminance at every sensor per luminance outside.
//!
//! The direct light of a sensor is traced back: to the point of the aperture in every direction, to the incident
//! patches from which the system sends light into that direction, to the outside luminances that the point sees through
//! these patches. Interreflected light depends less on the point at which light enters: nine nodes of the aperture are
//! enough.

use super::by_node::{ByNode, seen_by_nodes};
use super::columns::Columns;
use super::sent::{Luminances, Patch, Sent, lit as lit_cells};
use super::views::Opening;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::direction::{Dir, Surface};
use crate::compute::dot::wide;
use crate::compute::lid::Facing;
use crate::compute::polygon::projected_solid_angle;
use crate::compute::room::aperture::{Aperture, View};
use crate::compute::room::direct::{Reception, Sensor};
use crate::compute::room::grid::{CellWeights, Grid};
use crate::compute::room::nodes::Nodes;
use crate::compute::room::sunlit_part::SunlitPart;
use crate::compute::room::through;
use crate::compute::sky::{Counts, Frame, Outside, Prepared, SparseSum, Sun};
use crate::compute::surroundings::Surroundings;
use crate::compute::system::measure::ProfileLight;
use crate::study::cache::Cache;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use crate::study::session::Session;
use crate::study::session::seen::{bands_of, check, inside, keeps, within_budget};
use crate::study::session::sky_year::{SkyYear, of_moments};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use glam::DVec3;
use rayon::prelude::*;
use std::sync::{Arc, OnceLock};

/// Number of directions in which a sensor sees the outside by regular transmission, for the parts below and above the
/// horizon each.
const THROUGH: u32 = 4096;
/// Estimated memory per sensor for each emergent cell that it sees. \[bytes\]
const CELL_SEEN: usize = 128;
/// Number of nodes along each side of an aperture at which its interreflected light is computed.
const NODES: usize = 3;
/// Number of sensors whose weights are computed together.
const TOGETHER: usize = 16;

/// Obstructions in front of the apertures of a scene, prepared for many skies.
pub(super) struct Behind {
    pub prepared: Arc<Prepared>,
    /// Boxes without light on them.
    pub around: Surroundings,
}

/// Aperture behind obstructions, prepared for many skies.
pub(super) struct Past {
    aperture: Aperture,
    grid: Grid,
    nodes: Nodes,
    patches: RingBasis,
    sent: Option<Sent>,
    sensors: Vec<Sensor>,
    /// Emergent cells that every sensor sees through points of the aperture, and below the same for bands of the
    /// profile angle.
    cells: Arc<Vec<CellWeights>>,
    bands: Arc<Vec<CellWeights>>,
    /// Weights of luminances at the points of the aperture, by incident patch. \[sr\]
    by_point: Arc<Vec<Vec<Counts>>>,
    /// Scattered direct light at the sensors by incident patch, sensor and point of the aperture, per illuminance
    /// through the patch; empty where that would need too much memory.
    by_patch: Vec<OnceLock<Vec<f32>>>,
    /// Direct illuminances at the sensors per luminance outside: rows of sensors, columns of luminances. \[sr\]
    direct: Arc<Mat<f32>>,
    /// Interreflected light.
    pub reflected: ByNode,
}

/// Outside and sun at one point in time, which may be an hour of a year.
pub(super) struct Moment<'a> {
    pub outside: &'a Outside,
    pub sun: Option<&'a Sun>,
    pub hour: Option<usize>,
}

/// Returns the position of every cell in a list of weights; `None` for cells that are not in it.
fn places(named: &CellWeights, count: usize) -> Vec<Option<usize>> {
    let mut places = vec![None; count];
    named.iter().enumerate().for_each(|(place, (cell, _))| places[*cell] = Some(place));
    places
}

/// Adds the light of emergent cells that a sensor sees to the points of the aperture at which it leaves.
fn add(light: &Luminances, seen: &CellWeights, places: &[Option<usize>], points: &mut [f64]) {
    for (cell, q) in light {
        let Some(place) = places[*cell] else { continue };
        seen[place].1.iter().for_each(|(point, counts)| points[usize::from(*point)] += q * f64::from(*counts));
    }
}

impl Behind {
    /// Creates the obstructions from those that are prepared for many skies.
    pub fn new(prepared: Arc<Prepared>) -> Self {
        Self { around: Surroundings::dark(prepared.boxes().to_vec(), None), prepared }
    }

    /// Prepares an aperture. `columns`: interreflected light of every incident patch, node by node; `None` without
    /// interreflection; `sent`: scattered light of the system by incident patch; `regular`: its regular transmittance;
    /// `direct`: cache of direct light by aperture, shared by all meshes of the room.
    ///
    /// # Errors
    /// Returns an error if there are more sensors than fit, or if cancelled.
    pub fn past(
        &self,
        opening: &Opening<'_>,
        nodes: Nodes,
        (patches, columns): (&RingBasis, Option<&Columns<'_>>),
        sent: Option<Sent>,
        regular: Option<&AngularTransmittance>,
        direct: &Cache<Mat<f32>>,
    ) -> Result<Past, StudyError> {
        let scene = opening.scene;
        let aperture = scene.apertures[opening.index].aperture;
        let grid = Grid::of(&aperture);
        let by_point = seen_by_points(opening.session, scene, opening.index, &self.prepared, (grid.places(), patches));
        let cells = sent.as_ref().map_or(0, Sent::count);
        within_budget(scene, 3 * size_of::<f32>() * self.prepared.count() + CELL_SEEN * cells)?;
        let by_luminance = || seen_by_nodes(&self.prepared, (&grid, &nodes), patches.len(), &by_point);
        let by_luminance = columns.map(|_| {
            let eyes = eyes(scene, grid.places());
            opening.session.seen_patches((&self.prepared, nodes.count() as u64), &eyes, patches, by_luminance)
        });
        let reflected = ByNode::new(opening, &nodes, columns, by_luminance.unwrap_or_default());
        let inside: Vec<Sensor> = scene.sensors.iter().map(|sensor| inside(scene, sensor)).collect();
        let [cells, bands] = sent.as_ref().map(|sent| cells_seen(opening, &grid, sent, &inside)).unwrap_or_default();
        let kept = keeps(scene, patches.len() * grid.count() * size_of::<f32>() / size_of::<f64>());
        let mut past = Past {
            aperture,
            grid,
            nodes,
            patches: patches.clone(),
            sensors: inside,
            cells,
            bands,
            by_point,
            by_patch: (0..if kept { patches.len() } else { 0 }).map(|_| OnceLock::new()).collect(),
            direct: Arc::new(Mat::new()),
            reflected,
            sent,
        };
        past.direct = direct.get(vec![opening.index as u64], || self.direct(opening, &past, regular))?;
        Ok(past)
    }

    /// Returns the weights of luminances in direct light: rows of sensors, columns of luminances. \[sr\]
    fn direct(
        &self,
        opening: &Opening<'_>,
        past: &Past,
        regular: Option<&AngularTransmittance>,
    ) -> Result<Mat<f32>, StudyError> {
        let sensors = past.sensors.len();
        let mut tables = Mat::zeros(sensors, self.prepared.count());
        let scattered = |first: usize| {
            check(opening.progress)?;
            Ok((first, past.scattered(first, self.prepared.count())))
        };
        let blocks = (0..sensors).into_par_iter().step_by(TOGETHER).map(scattered);
        for (first, weights) in blocks.collect::<Result<Vec<_>, StudyError>>()? {
            for (place, weights) in weights.iter().enumerate() {
                let to: &mut [f32] = &mut tables.col_as_slice_mut(place)[first..];
                to.iter_mut().zip(weights).for_each(|(to, counts)| *to = *counts);
            }
        }
        if let Some(tau) = regular {
            let regular = |sensor| {
                check(opening.progress)?;
                Ok(self.regular(opening, sensor, tau))
            };
            let rows = past.sensors.par_iter().map(regular).collect::<Result<Vec<_>, StudyError>>()?;
            for (s, row) in rows.iter().enumerate() {
                row.iter().for_each(|(place, counts)| tables[(s, *place as usize)] += counts);
            }
        }
        Ok(tables)
    }

    /// Returns the weights of the outside luminances that a sensor sees through the aperture by regular transmission.
    /// \[sr\]
    fn regular(&self, opening: &Opening<'_>, sensor: &Sensor, tau: &AngularTransmittance) -> Counts {
        let mut row = SparseSum::new(self.prepared.count());
        let scene = opening.scene;
        let aperture = &scene.apertures[opening.index].aperture;
        let surface = aperture.surface;
        let Some(view) = aperture.view(sensor.position, sensor.normal) else { return Counts::new() };
        let eye = scene.orientation.to_world(sensor.position);
        let [low, high] = view.y;
        let level = if surface == Surface::Facade { 0.0_f64.clamp(low, high) } else { high };
        for y in [[low, level], [level, high]].into_iter().filter(|[low, high]| high > low) {
            through::spread(&View { y, ..view }, THROUGH, |towards, counts, _| {
                let counts = counts * tau.at(towards.z.clamp(-1.0, 1.0).acos());
                let towards = scene.orientation.to_world(surface.room_from_facade(towards));
                self.prepared.look(eye, towards, |place, share| row.add(place, counts * share));
            });
        }
        row.take()
    }
}

impl Past {
    /// Returns the basis of the incident hemisphere.
    pub const fn patches(&self) -> &RingBasis {
        &self.patches
    }

    /// Computes the diffuse illuminances at the sensors, a column for each list of luminances and rows as in
    /// [`super::part::Sums`]. \[lx\] `hours`: index of the year's hour of each, where it has one; `at_nodes`: store for
    /// the light that enters in the hours of the year.
    pub fn sums(&self, luminances: &Mat<f32>, hours: &[Option<usize>], at_nodes: Option<&SkyYear>) -> Mat<f32> {
        let sensors = self.sensors.len();
        let mut all = Mat::zeros(3 * sensors, luminances.ncols());
        let (mut total, mut reflected) = all.split_at_row_mut(sensors);
        matmul(total.as_mut(), Accum::Replace, &*self.direct, luminances, 1.0, Par::Seq);
        self.reflected.light(luminances.as_ref(), hours, at_nodes, reflected.as_mut());
        total += reflected.subrows(0, sensors);
        all
    }

    /// Returns the weights of outside luminances in the scattered direct light at sensors from the `first` on,
    /// luminance by luminance. `count`: number of luminances. \[sr\]
    fn scattered(&self, first: usize, count: usize) -> Vec<[f32; TOGETHER]> {
        let Some(sent) = &self.sent else { return Vec::new() };
        let count_of_points = self.grid.count();
        let mut light = vec![[0.0_f32; TOGETHER]; sent.patches.len() * count_of_points];
        let rows: Vec<usize> = (0..sent.rows.len()).collect();
        for (lane, sensor) in (first..self.sensors.len()).take(TOGETHER).enumerate() {
            let by_cell = places(&self.cells[sensor], sent.cells.len());
            let by_row = self.rows_seen(sent, sensor, &by_cell, &rows);
            let mut points = vec![0.0; count_of_points];
            for (patch, light) in sent.patches.iter().zip(light.chunks_exact_mut(count_of_points)) {
                points.fill(0.0);
                add(&patch.own, &self.cells[sensor], &by_cell, &mut points);
                for (from, share) in &patch.rows {
                    points.iter_mut().zip(&by_row[*from]).for_each(|(sum, e)| *sum += share * e);
                }
                light.iter_mut().zip(&points).for_each(|(to, e)| to[lane] = *e as f32);
            }
        }
        let mut sums = vec![[0.0; TOGETHER]; count];
        for (point, by_patch) in self.by_point.iter().enumerate() {
            for (seen, light) in by_patch.iter().zip(light.chunks_exact(count_of_points)) {
                // By value, so that the lanes are added at once.
                let light = light[point];
                let seen = if light.iter().any(|e| *e != 0.0) { seen.as_slice() } else { &[] };
                wide(|| {
                    for (place, counts) in seen {
                        sums[*place as usize].iter_mut().zip(light).for_each(|(sum, e)| *sum += counts * e);
                    }
                });
            }
        }
        sums
    }

    /// Returns the light of the listed rows of the system's data that a sensor sees, by point of the aperture, per
    /// illuminance. \[lx/lx\]
    fn rows_seen(&self, sent: &Sent, sensor: usize, by_cell: &[Option<usize>], rows: &[usize]) -> Vec<Vec<f64>> {
        let by_band = sent.bands.map(|(_, count)| places(&self.bands[sensor], count));
        let of = |row: &usize| {
            let mut points = vec![0.0; self.grid.count()];
            match &by_band {
                Some(by_band) => add(&sent.rows[*row], &self.bands[sensor], by_band, &mut points),
                None => add(&sent.rows[*row], &self.cells[sensor], by_cell, &mut points),
            }
            points
        };
        rows.iter().map(of).collect()
    }

    /// Returns the scattered light that every sensor sees, sensor by sensor and point of the aperture by point, for an
    /// emission that is the sum of light by cells (`own`) and shares of rows (`rows`).
    fn seen(&self, sent: &Sent, own: &Luminances, rows: &[(usize, f64)]) -> Vec<f32> {
        let numbers: Vec<usize> = rows.iter().map(|(row, _)| *row).collect();
        let of = |sensor: usize| {
            let by_cell = places(&self.cells[sensor], sent.cells.len());
            let mut points = vec![0.0; self.grid.count()];
            add(own, &self.cells[sensor], &by_cell, &mut points);
            for (light, (_, share)) in self.rows_seen(sent, sensor, &by_cell, &numbers).iter().zip(rows) {
                points.iter_mut().zip(light).for_each(|(sum, e)| *sum += share * e);
            }
            points.into_iter().map(|e| e as f32)
        };
        (0..self.sensors.len()).flat_map(of).collect()
    }

    /// Returns, for every sensor, the share of a sunlit part of the aperture in its scattered sunlight, direct and
    /// interreflected. `cells`: luminances of the data's emergent cells for the actual sun position \[cd/m²\]; if
    /// empty, light is distributed over directions as for the incident patch of the sun.
    pub fn shares(&self, facing: &Facing<'_>, part: &SunlitPart, cells: &[f64]) -> Vec<[f64; 2]> {
        let patch = facing.sun_entering().and_then(|sun| self.patches.index(sun));
        let Some((sent, p)) = self.sent.as_ref().zip(patch) else { return vec![[part.share; 2]; self.sensors.len()] };
        let [on_points, on_nodes] = part.on(&self.grid, &self.nodes);
        let even = |sensor: &Sensor| {
            let seen = |corners: &[DVec3]| {
                let corners: Vec<DVec3> = corners.iter().map(|corner| *corner - sensor.position).collect();
                projected_solid_angle(&corners, sensor.normal)
            };
            let lit: f64 = part.pieces.iter().map(|piece| seen(piece)).sum();
            let all = seen(&self.aperture.corners());
            if all == 0.0 { 0.0 } else { (lit / all).abs() }
        };
        let ratio = |light: &mut dyn Iterator<Item = f32>, on: &[f64]| {
            let sums = light.zip(on).fold([0.0; 2], |[lit, all], (e, on)| {
                let e = f64::from(e);
                [lit + e * on, all + e]
            });
            if sums[1] > 0.0 { (sums[0] / sums[1]).clamp(0.0, 1.0) } else { part.share }
        };
        let of_patch = || {
            let Patch { own, rows } = &sent.patches[p];
            if rows.is_empty() { self.seen(sent, own, rows) } else { self.seen(sent, &Vec::new(), rows) }
        };
        let own;
        let light: &[f32] = if sent.cells.len() == 1 {
            &[]
        } else if cells.is_empty() {
            match self.by_patch.get(p) {
                Some(kept) => kept.get_or_init(of_patch),
                None => {
                    own = of_patch();
                    &own
                }
            }
        } else {
            own = self.seen(sent, &lit_cells(cells), &[]);
            &own
        };
        let count = self.grid.count();
        let of = |s: usize| {
            let by_room = ratio(&mut self.reflected.of_patch(p, s), on_nodes);
            let direct = match light.get(s * count..(s + 1) * count) {
                Some(light) => ratio(&mut light.iter().copied(), on_points),
                None => even(&self.sensors[s]),
            };
            [direct, by_room]
        };
        (0..self.sensors.len()).map(of).collect()
    }
}

/// Returns the emergent cells and the bands of the profile angle that every sensor sees through points of the aperture,
/// with their weights \[sr\]; computed or stored.
fn cells_seen(opening: &Opening<'_>, grid: &Grid, sent: &Sent, sensors: &[Sensor]) -> [Arc<Vec<CellWeights>>; 2] {
    let (session, scene, index) = (opening.session, opening.scene, opening.index);
    let aperture = &scene.apertures[index].aperture;
    let each = |of: &(dyn Fn(&Sensor, &View) -> CellWeights + Sync)| {
        let view = |sensor: &Sensor| aperture.view(sensor.position, sensor.normal);
        sensors.par_iter().map(|sensor| view(sensor).map(|view| of(sensor, &view)).unwrap_or_default()).collect()
    };
    let basis = &*sent.cells;
    let by_cell = |sensor: &Sensor, view: &View| {
        let reception = Reception::new(sensor, aperture, Some(basis));
        let cell = |towards: DVec3| basis.index(Dir::from_unit(towards));
        let middle = |cell: usize| basis.cell(cell).centre().vector();
        grid.by_cell(view, reception.cells.into_iter().enumerate(), cell, middle)
    };
    let cells = session.cells_at_points(scene, index, Ok(basis), || each(&by_cell));
    let Some((upright, count)) = sent.bands else { return [cells, Arc::default()] };
    let borders: Vec<f64> = ProfileLight::borders(count).collect();
    let by_band = |sensor: &Sensor, view: &View| {
        let band = |towards: DVec3| {
            let angle = ProfileLight::angle_of(upright, Dir::from_unit(towards));
            Some(ProfileLight::band(angle, count).min(count - 1))
        };
        let middle = |band: usize| {
            let (sin, cos) = (0.5 * (borders[band] + borders[band + 1])).sin_cos();
            if upright { DVec3::new(sin, 0.0, cos) } else { DVec3::new(0.0, sin, cos) }
        };
        grid.by_cell(view, bands_of(sensor, aperture, upright, count).each(), band, middle)
    };
    [cells, session.cells_at_points(scene, index, Err((upright, count)), || each(&by_band))]
}

/// Returns the weights of outside luminances at points of an aperture (in the room frame), by point and incident patch
/// \[sr\]; computed or stored.
pub(crate) fn seen_by_points(
    session: &Session,
    scene: &Scene,
    index: usize,
    prepared: &Prepared,
    (points, patches): (Vec<DVec3>, &RingBasis),
) -> Arc<Vec<Vec<Counts>>> {
    let eyes = eyes(scene, points);
    let frame = Frame::of_aperture(scene.orientation, scene.apertures[index].aperture.surface);
    let find = || eyes.par_iter().map(|eye| prepared.patches(*eye, &frame, patches)).collect();
    session.seen_patches((prepared, 0), &eyes, patches, find)
}

/// Returns points of the room frame in the world's axes. \[m\]
fn eyes(scene: &Scene, points: Vec<DVec3>) -> Vec<DVec3> {
    points.into_iter().map(|point| scene.orientation.to_world(point)).collect()
}

/// Returns the outside luminances at several points in time \[cd/m²\], a column for each, computed together, or stored
/// for the hours of a year. `columns`: number of columns; those without a point in time are 0.
pub(super) fn luminances(
    prepared: &Prepared,
    year: Option<&SkyYear>,
    moments: &[Moment<'_>],
    columns: usize,
) -> Mat<f32> {
    let hours: Vec<Option<usize>> = moments.iter().map(|moment| moment.hour).collect();
    let find = |missing: &[usize]| {
        let asked: Vec<_> = missing.iter().map(|at| (moments[*at].outside, moments[*at].sun)).collect();
        prepared.luminances(&asked)
    };
    of_moments(year, &hours, [prepared.count(), columns], find)
}

/// Returns the nodes of an aperture at which its interreflected light is computed.
pub(super) fn nodes(aperture: &Aperture) -> Nodes {
    Nodes::new(aperture, NODES, NODES)
}

//! V·T·D of an aperture behind boxes: columns for the luminances outside.
//!
//! Direct light of a sensor is followed back: to the point of the aperture in every direction, to the patches from which the
//! system sends light there, to the luminances that the point sees through these. Interreflected light depends less on
//! where light enters: nine nodes of the aperture are enough.

use super::sent::{Luminances, Sent, lit as lit_cells};
use super::transport::Column;
use super::views::Opening;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::direction::{Dir, Surface};
use crate::compute::lid::Facing;
use crate::compute::polygon::projected_solid_angle;
use crate::compute::room::aperture::{Aperture, View};
use crate::compute::room::band_weights::BandWeights;
use crate::compute::room::beams_past::{lit, lit_by_rim};
use crate::compute::room::direct::{Reception, Sensor};
use crate::compute::room::grid::{Grid, Weights};
use crate::compute::room::nodes::Nodes;
use crate::compute::room::through;
use crate::compute::sky::{Counts, Frame, Outside, Prepared, SparseSum, Sun};
use crate::compute::surroundings::Surroundings;
use crate::compute::system::measure::ProfileLight;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use crate::study::session::Session;
use crate::study::session::seen::{bands_of, check, inside, within_budget};
use crate::study::session::sky_year::SkyYear;
use faer::Mat;
use glam::DVec3;
use rayon::prelude::*;
use std::sync::Arc;

/// Directions in which a sensor looks straight through an aperture, below the horizon and above.
const THROUGH: u32 = 4096;
/// Memory that a sensor takes for a cell that it sees. \[bytes\]
const CELL_SEEN: usize = 128;
/// Nodes along each side for the room.
const NODES: usize = 3;

/// What stands before all apertures of a scene.
pub(super) struct Behind {
    pub prepared: Arc<Prepared>,
    /// The boxes alone, dark.
    pub around: Surroundings,
}

/// One aperture behind it.
pub(super) struct Past {
    aperture: Aperture,
    grid: Grid,
    nodes: Nodes,
    patches: RingBasis,
    sent: Option<Sent>,
    /// The sensors, with what each sees.
    sensors: Vec<Sensor>,
    seen: Vec<CellsSeen>,
    /// Interreflected light per illuminance by patch, node and sensor.
    reflected: Vec<Vec<f32>>,
}

/// Projected solid angles of cells as a sensor sees them through single points of a grid. \[sr\]
#[derive(Default)]
struct CellsSeen {
    /// By emergent cell, and by band.
    cells: Vec<(usize, Weights)>,
    bands: Vec<(usize, Weights)>,
}

/// What is outside at a time, which may be an hour of a year.
pub(super) struct Moment<'a> {
    pub outside: &'a Outside,
    pub sun: Option<&'a Sun>,
    pub hour: Option<usize>,
}

/// What of an aperture the sun reaches.
pub(super) struct Sunlit {
    /// Convex pieces in the room frame. \[m\]
    pub pieces: Vec<Vec<DVec3>>,
    /// Pieces for points of the sun's rim.
    pub rim: Vec<Vec<Vec<DVec3>>>,
    /// Shares of these pieces in the scattered light of the whole aperture, direct and interreflected, for every sensor.
    pub shares: Vec<[f64; 2]>,
}

/// Returns for every cell its place in a list; `None` where the list lacks it.
fn places(named: &[(usize, Weights)], count: usize) -> Vec<Option<usize>> {
    let mut places = vec![None; count];
    named.iter().enumerate().for_each(|(place, (cell, _))| places[*cell] = Some(place));
    places
}

/// Adds what a sensor sees of cells to the points of a grid where it leaves the aperture.
fn add(light: &Luminances, seen: &[(usize, Weights)], places: &[Option<usize>], factor: f64, points: &mut [f64]) {
    for (cell, q) in light {
        let Some(place) = places[*cell] else { continue };
        seen[place].1.iter().for_each(|(point, counts)| points[usize::from(*point)] += factor * q * f64::from(*counts));
    }
}

impl Behind {
    pub fn new(prepared: Arc<Prepared>) -> Self {
        Self { around: Surroundings::dark(prepared.boxes().to_vec(), None), prepared }
    }

    /// Returns the sunlit part of an aperture past boxes as convex pieces, and its share.
    pub fn reached(&self, past: &Past, facing: &Facing<'_>) -> (Vec<Vec<DVec3>>, f64) {
        lit(&past.aperture, facing, &self.around)
    }

    /// Returns what the sun does with an aperture of which it reaches some pieces, a share of it. `cells`: luminances of the
    /// data's cells by its scattered light, where they are known. \[cd/m²\]
    pub fn sunlit(
        &self,
        past: &Past,
        facing: &Facing<'_>,
        (pieces, share): (Vec<Vec<DVec3>>, f64),
        cells: &[f64],
    ) -> Sunlit {
        let shares = past.shares(facing, &pieces, share, cells);
        Sunlit { rim: lit_by_rim(&past.aperture, facing, &self.around), pieces, shares }
    }

    /// Prepares an aperture and returns its columns by luminance, with rows of all sensors as in [`super::part::Sums`].
    /// `columns`: interreflected light of every patch, node by node.
    ///
    /// # Errors
    /// More sensors than this is made for; cancelled.
    pub fn past(
        &self,
        opening: &Opening<'_>,
        nodes: Nodes,
        (patches, columns): (&RingBasis, &[Column]),
        sent: Option<Sent>,
        regular: Option<&AngularTransmittance>,
    ) -> Result<(Past, Mat<f32>), StudyError> {
        let (scene, sensors) = (opening.scene, opening.scene.sensors.len());
        let aperture = scene.apertures[opening.index].aperture;
        let grid = Grid::of(&aperture);
        let by_point = seen_by_points(opening.session, scene, opening.index, &self.prepared, (grid.places(), patches));
        let cells = sent.as_ref().map_or(0, Sent::count);
        within_budget(scene, 3 * size_of::<f32>() * self.prepared.count() + CELL_SEEN * cells)?;
        let mut tables: Mat<f32> = Mat::zeros(3 * sensors, self.prepared.count());
        // By way of the room.
        let places = sensors * nodes.count();
        let on_nodes = nodes.of_grid(&grid);
        let mut seen = SparseSum::new(self.prepared.count());
        for (p, column) in columns.iter().enumerate() {
            for (node, on_node) in on_nodes.iter().enumerate() {
                for (by_patch, share) in by_point.iter().zip(on_node) {
                    by_patch[p].iter().for_each(|(k, counts)| seen.add(*k as usize, share * f64::from(*counts)));
                }
                let rows: Vec<&[f64]> =
                    column.light.chunks_exact(places).map(|row| &row[node * sensors..][..sensors]).collect();
                for (place, counts) in seen.take() {
                    let to = tables.col_as_slice_mut(place as usize);
                    for (to, e) in to.iter_mut().zip(rows.iter().copied().flatten()) {
                        *to += counts * *e as f32;
                    }
                }
            }
        }
        let reflected = |column: &Column| {
            column.light.get(places..2 * places).unwrap_or_default().iter().map(|e| *e as f32).collect()
        };
        let mut past = Past {
            aperture,
            grid,
            nodes,
            patches: patches.clone(),
            sensors: scene.sensors.iter().map(|sensor| inside(scene, sensor)).collect(),
            seen: Vec::new(),
            reflected: columns.iter().map(reflected).collect(),
            sent,
        };
        past.seen = past.sensors.par_iter().map(|sensor| past.cells_seen(sensor)).collect();
        // Straight.
        let straight = |(sensor, seen): (&Sensor, &CellsSeen)| {
            check(opening.progress)?;
            let mut row = vec![0.0; self.prepared.count()];
            past.add_scattered(seen, &by_point, &mut row);
            if let Some(tau) = regular {
                self.add_regular(opening, sensor, tau, &mut row);
            }
            Ok(row)
        };
        let rows = past.sensors.par_iter().zip(&past.seen).map(straight);
        let rows: Vec<Vec<f64>> = rows.collect::<Result<_, StudyError>>()?;
        for (s, row) in rows.iter().enumerate() {
            row.iter().enumerate().for_each(|(place, counts)| tables[(s, place)] += *counts as f32);
        }
        Ok((past, tables))
    }

    /// Adds the weights of luminances at a sensor that it sees through a regular transmittance. \[sr\]
    fn add_regular(&self, opening: &Opening<'_>, sensor: &Sensor, tau: &AngularTransmittance, row: &mut [f64]) {
        let scene = opening.scene;
        let aperture = &scene.apertures[opening.index].aperture;
        let surface = aperture.surface;
        let Some(view) = aperture.view(sensor.position, sensor.normal) else { return };
        let eye = scene.orientation.to_world(sensor.position);
        let [low, high] = view.y;
        let level = if surface == Surface::Facade { 0.0_f64.clamp(low, high) } else { high };
        for y in [[low, level], [level, high]].into_iter().filter(|[low, high]| high > low) {
            through::spread(&View { y, ..view }, THROUGH, |towards, counts, _| {
                let counts = counts * tau.at(towards.z.clamp(-1.0, 1.0).acos());
                let towards = scene.orientation.to_world(surface.room_from_facade(towards));
                self.prepared.look(eye, towards, |place, share| row[place] += counts * share);
            });
        }
    }
}

impl Past {
    /// Of a sensor.
    fn cells_seen(&self, sensor: &Sensor) -> CellsSeen {
        let Some((sent, view)) = self.sent.as_ref().zip(self.aperture.view(sensor.position, sensor.normal)) else {
            return CellsSeen::default();
        };
        let basis = &*sent.cells;
        let reception = Reception::new(sensor, &self.aperture, Some(basis));
        let cell = |towards: DVec3| basis.index(Dir::from_unit(towards));
        let middle = |cell: usize| basis.cell(cell).centre().vector();
        let cells = self.grid.by_cell(&view, reception.cells.into_iter().enumerate(), cell, middle);
        let by_band = |(upright, count): (bool, usize)| {
            let borders: Vec<f64> = ProfileLight::borders(count).collect();
            let band = |towards: DVec3| {
                let angle = ProfileLight::angle_of(upright, Dir::from_unit(towards));
                Some(ProfileLight::band(angle, count).min(count - 1))
            };
            let middle = |band: usize| {
                let (sin, cos) = (0.5 * (borders[band] + borders[band + 1])).sin_cos();
                if upright { DVec3::new(sin, 0.0, cos) } else { DVec3::new(0.0, sin, cos) }
            };
            let weights: BandWeights = bands_of(sensor, &self.aperture, upright, count);
            self.grid.by_cell(&view, weights.each(), band, middle)
        };
        CellsSeen { cells, bands: sent.bands.map(by_band).unwrap_or_default() }
    }

    /// Adds the weights of luminances at a sensor in scattered direct light. `by_point`: their weights at the grid's points by
    /// patch. \[sr\]
    fn add_scattered(&self, seen: &CellsSeen, by_point: &[Vec<Counts>], row: &mut [f64]) {
        let Some(sent) = &self.sent else { return };
        let by_cell = places(&seen.cells, sent.cells.len());
        let by_row = self.rows_seen(sent, seen, &by_cell, &(0..sent.rows.len()).collect::<Vec<_>>());
        let mut points = vec![0.0; self.grid.count()];
        for (p, patch) in sent.patches.iter().enumerate() {
            points.fill(0.0);
            add(&patch.own, &seen.cells, &by_cell, 1.0, &mut points);
            for (from, share) in &patch.rows {
                points.iter_mut().zip(&by_row[*from]).for_each(|(sum, e)| *sum += share * e);
            }
            for (point, light) in points.iter().enumerate().filter(|(_, light)| **light != 0.0) {
                for (place, counts) in &by_point[point][p] {
                    row[*place as usize] += light * f64::from(*counts);
                }
            }
        }
    }

    /// Returns what a sensor sees of rows through the points of the grid. \[sr\]
    fn rows_seen(&self, sent: &Sent, seen: &CellsSeen, by_cell: &[Option<usize>], rows: &[usize]) -> Vec<Vec<f64>> {
        let by_band = sent.bands.map(|(_, count)| places(&seen.bands, count));
        let of = |row: &usize| {
            let mut points = vec![0.0; self.grid.count()];
            match &by_band {
                Some(by_band) => add(&sent.rows[*row], &seen.bands, by_band, 1.0, &mut points),
                None => add(&sent.rows[*row], &seen.cells, by_cell, 1.0, &mut points),
            }
            points
        };
        rows.iter().map(of).collect()
    }

    /// Returns for every sensor the shares of some pieces in the aperture's scattered sunlight, direct and interreflected. The
    /// light's distribution over directions is that of `cells`, or else that of the incident patch without its own beams.
    fn shares(&self, facing: &Facing<'_>, pieces: &[Vec<DVec3>], share: f64, cells: &[f64]) -> Vec<[f64; 2]> {
        let patch = facing.sun_entering().and_then(|sun| self.patches.index(sun));
        let Some((sent, p)) = self.sent.as_ref().zip(patch) else { return vec![[share; 2]; self.sensors.len()] };
        let (on_points, on_nodes) = (self.grid.lit(pieces), self.nodes.lit(pieces));
        let patch = &sent.patches[p];
        let by_sun = lit_cells(cells);
        let rows: Vec<usize> = patch.rows.iter().map(|(row, _)| *row).collect();
        let even = |sensor: &Sensor| {
            let seen = |corners: &[DVec3]| {
                let corners: Vec<DVec3> = corners.iter().map(|corner| *corner - sensor.position).collect();
                projected_solid_angle(&corners, sensor.normal)
            };
            let (part, all) = (pieces.iter().map(|piece| seen(piece)).sum::<f64>(), seen(&self.aperture.corners()));
            if all == 0.0 { 0.0 } else { (part / all).abs() }
        };
        let ratio = |light: &mut dyn Iterator<Item = (f64, f64)>| {
            let (part, all) = light.fold((0.0, 0.0), |(part, all), (e, lit)| (part + e * lit, all + e));
            if all > 0.0 { (part / all).clamp(0.0, 1.0) } else { share }
        };
        let by_points = |seen: &CellsSeen| {
            let by_cell = places(&seen.cells, sent.cells.len());
            let mut points = vec![0.0; self.grid.count()];
            if !cells.is_empty() {
                add(&by_sun, &seen.cells, &by_cell, 1.0, &mut points);
            } else if rows.is_empty() {
                add(&patch.own, &seen.cells, &by_cell, 1.0, &mut points);
            }
            let by_row = if cells.is_empty() { self.rows_seen(sent, seen, &by_cell, &rows) } else { Vec::new() };
            for (light, (_, share)) in by_row.iter().zip(&patch.rows) {
                points.iter_mut().zip(light).for_each(|(sum, e)| *sum += share * e);
            }
            ratio(&mut points.into_iter().zip(on_points.iter().copied()))
        };
        let of = |s: usize| {
            let (sensor, seen) = (&self.sensors[s], &self.seen[s]);
            let reflected = self.reflected.get(p).into_iter().flatten().skip(s).step_by(self.sensors.len());
            let by_room = ratio(&mut reflected.map(|e| f64::from(*e)).zip(on_nodes.iter().copied()));
            [if sent.cells.len() == 1 { even(sensor) } else { by_points(seen) }, by_room]
        };
        (0..self.sensors.len()).map(of).collect()
    }
}

/// Returns weights of luminances by patch at points of an aperture in the room frame, computed or kept. \[sr\]
pub(in crate::study) fn seen_by_points(
    session: &Session,
    scene: &Scene,
    index: usize,
    prepared: &Prepared,
    (points, patches): (Vec<DVec3>, &RingBasis),
) -> Arc<Vec<Vec<Counts>>> {
    let eyes: Vec<DVec3> = points.into_iter().map(|point| scene.orientation.to_world(point)).collect();
    let frame = Frame::of_aperture(scene.orientation, scene.apertures[index].aperture.surface);
    session.seen_patches(prepared, &eyes, &frame, patches)
}

/// Returns luminances of moments, computed together, or kept for the hours of a year. \[cd/m²\]
pub(super) fn luminances(prepared: &Prepared, year: Option<&SkyYear>, moments: &[Moment<'_>]) -> Vec<Vec<f64>> {
    let kept: Vec<Option<(&SkyYear, usize)>> = moments.iter().map(|moment| Some((year?, moment.hour?))).collect();
    let missing: Vec<bool> = kept.iter().map(|kept| kept.is_none_or(|(year, hour)| !year.holds(hour))).collect();
    let asked = moments.iter().zip(&missing).filter(|(_, missing)| **missing);
    let asked: Vec<_> = asked.map(|(moment, _)| (moment.outside, moment.sun)).collect();
    let mut found = prepared.luminances(&asked).into_iter();
    let wide = |light: Vec<f32>| light.into_iter().map(f64::from).collect();
    let one = |(kept, missing): (Option<(&SkyYear, usize)>, bool)| {
        let own: Vec<f64> = if missing { found.next().map(wide).unwrap_or_default() } else { Vec::new() };
        match kept {
            Some((year, hour)) => year.hour(hour, || own).collect(),
            None => own,
        }
    };
    kept.into_iter().zip(missing).map(one).collect()
}

/// Nodes of an aperture for the room.
pub(super) fn nodes(aperture: &Aperture) -> Nodes {
    Nodes::new(aperture, NODES, NODES)
}

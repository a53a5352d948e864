//! Obstructions and ground prepared for many skies and positions of the sun: daylight coefficients of their surfaces.
//!
//! A *moment* (date and time with its sky and sun) is a list of luminances: of the sky in the directions of a grid, of
//! the part directly reflected from the sun in the cells of the surfaces, and of the other part at the nodes of the
//! surfaces' panels. The last follows from the others by a matrix, computed once from the interreflection between few
//! panels of all surfaces. The luminance seen from a point in a direction is then a sum over the list with weights that
//! do not depend on sky and sun. The panels are fitted to a uniform sky with a sun in front of the façade; their error
//! under other skies is part of the stated one.

use super::dome::Dome;
use super::equations::{Counts, Exchange, Panels, SparseSum, sparse};
use super::faces::{Fineness, assembled, beside, direct_sun, lights, wanted};
use super::open_ground::OpenGround;
use super::outside::Outside;
use super::region::Frame;
use super::scenery::{Scenery, Setting, scenery};
use super::sunlit::SunCells;
use super::vista::{Collector, Vista};
use super::{Distribution, Sun};
use crate::compute::basis::RingBasis;
use crate::compute::direction::Dir;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::sequence::net;
use crate::compute::surroundings::face_light::FaceLight;
use crate::compute::surroundings::first_hit;
use crate::compute::surroundings::skyline::Skyline;
use crate::compute::surroundings::solid::{Face, Solid};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::{Arc, Mutex, PoisonError};

/// Resolution of the sky and of sunlit cells as sources of illuminance on surfaces: spacing of the sky directions
/// \[rad\]; maximum side of the cells relative to their distance, and minimum side \[m\]. Chosen: cost; held by the
/// test `boxes_are_lit_as_at_single_moments`.
const LIGHTING: [f64; 3] = [0.1, 0.4, 0.4];
/// Resolution of the sky and of sunlit cells as seen from apertures: the three values of [`LIGHTING`]. Chosen: cost;
/// held by the test `boxes_are_lit_as_at_single_moments`.
const SEEN: [f64; 3] = [0.05, 0.15, 0.1];
/// Moment to which the panels are fitted: reflectance of the ground; upward and sideward components of the direction to
/// the sun per component along the façade's normal; direct normal illuminance per diffuse horizontal illuminance.
/// Chosen; the error under other skies and suns is [`OTHERS`], held by the test `boxes_are_lit_as_at_single_moments`.
const TRIAL: [f64; 4] = [0.2, 0.8, 0.3, 3.0];
/// Fineness of the prepared panels. Between nodes it is that of a moment at the default error target, 0.2 · 0.01; the
/// number of panels is chosen: cost; held by the test `boxes_are_lit_as_at_single_moments`.
const PANELS: Fineness = Fineness { between: 2e-3, most: 160 };
/// Angle along a bearing per additional point on a surface in the illuminance of a node; small because cells are small.
/// \[rad\] Chosen; held by the test `boxes_are_lit_as_at_single_moments`.
const STEP: f64 = 0.12;
/// Error by panels and cells under other skies and suns, relative to the luminance of a surface without the part
/// directly reflected from the sun: twice the mean error in the test of this file.
const OTHERS: f64 = 1e-2;
/// Numbers of directions at one point for all patches together, and minimum and maximum for a patch: first for patches
/// whose first directions meet one surface only, then for those with several. Directions differ from point to point, so
/// that errors of neighbouring points cancel. Chosen: cost; held by the test `boxes_are_lit_as_at_single_moments`, to
/// 1.6 % of the light in the sum over patches.
const DIRECTIONS: [(usize, [usize; 2]); 2] = [(8_000, [8, 64]), (40_000, [64, 256])];
/// Minimum number of columns of a matrix product; a single one would be summed in another order, and the luminances of a
/// moment would depend on how many others are computed with it.
const COLUMNS: usize = 2;
/// Maximum number of ground reflectances for which the interreflection is cached: a year has twelve. Chosen: cost only,
/// no effect on results.
const GROUNDS: usize = 13;
/// Index that stands for the sky among the surfaces, larger than that of any surface; the index before it stands for
/// the skyline.
const SKY: usize = usize::MAX;

/// Obstructions (boxes, building) and ground with daylight coefficients, for any sky and sun behind the same skyline
/// and any ground reflectance.
pub struct Prepared {
    /// Number of these prepared obstructions, which no others have.
    number: u64,
    setting: Setting,
    turn: [f64; 2],
    viewpoints: Vec<DVec3>,
    wanted: Vec<usize>,
    /// Boxes; `stated` holds the given luminance \[cd/m²\] of every surface that has one, `ground` the ground.
    boxes: Vec<Solid>,
    stated: Vec<Option<f64>>,
    ground: (Face, OpenGround),
    skyline: Option<Skyline>,
    /// Sine of the altitude of a flat skyline.
    flat: f64,
    lighting: Sources,
    seen: Sources,
    /// Interreflection between few panels of all surfaces.
    exchange: Exchange,
    lit: Lit,
    /// Panels of the surfaces in view; `source` holds for every node the one whose luminance it is given, `gathered`
    /// the illuminances of the nodes by source.
    panels: Panels,
    source: Vec<usize>,
    gathered: Lit,
    /// Weights of the nodes of `exchange` in the illuminance of the nodes of `panels`. \[sr\]
    from_exchange: Mat<f32>,
    /// Cached luminances of the nodes per luminance of each source, with the bits of the ground's reflectance as key.
    solved: Mutex<Vec<(u64, Arc<Mat<f32>>)>>,
}

/// Illuminances of nodes per luminance of the sources: a row for each node, a column for each source. \[sr\]
type Lit = Mat<f32>;

/// Numbering of the luminances (sources) in a list: directions of the sky, skyline, surfaces of given luminance (as 1),
/// unobstructed ground outside the panels, cells lit by the sun.
struct Sources {
    dome: Dome,
    cells: SunCells,
}

impl Sources {
    const fn skyline(&self) -> usize {
        self.dome.len()
    }

    const fn stated(&self) -> usize {
        self.dome.len() + 1
    }

    const fn beyond(&self) -> usize {
        self.dome.len() + 2
    }

    const fn first_cell(&self) -> usize {
        self.dome.len() + 3
    }

    const fn len(&self) -> usize {
        self.first_cell() + self.cells.len()
    }

    /// Returns the luminances of all sources under the sky of `outside` and the sun of `scenery`. \[cd/m²\]
    fn luminances(&self, outside: &Outside, scenery: &Scenery<'_>) -> Vec<f32> {
        let skyline = scenery.skyline.map_or(outside.skyline_luminance(), |skyline| skyline.luminance);
        let even = [skyline, 1.0, outside.ground_luminance()];
        let sky = self.dome.luminances(outside).into_iter().chain(even);
        sky.chain(self.cells.luminances(scenery)).map(|luminance| luminance as f32).collect()
    }
}

/// Collector of the weights of all luminances in the illuminance of one node. \[sr\]
struct Gathering<'a> {
    sources: &'a Sources,
    ground: (usize, &'a OpenGround),
    exchange: &'a Panels,
    /// Weights of the sources; `by_other` holds those of the other nodes.
    row: Vec<f64>,
    by_other: Vec<f64>,
}

impl Collector for Gathering<'_> {
    fn sky(&mut self, towards: DVec3, counts: f64) {
        self.sources.dome.spread(towards, |node, share| self.row[node] += counts * share);
    }

    fn skyline(&mut self, counts: f64) {
        self.row[self.sources.skyline()] += counts;
    }

    fn stated(&mut self, luminance: f64, counts: f64) {
        self.row[self.sources.stated()] += counts * luminance;
    }

    fn place(&mut self, surface: usize, at: [f64; 2], counts: f64) {
        if surface == self.ground.0 && !self.ground.1.holds(at) {
            self.row[self.sources.beyond()] += counts;
            return;
        }
        self.sources.cells.at(surface, at, |cell| self.row[self.sources.first_cell() + cell] += counts);
        self.exchange.weigh(surface, at, |node, share| self.by_other[node] += counts * share);
    }

    fn sunlit(&mut self, _: usize, _: f64) {}

    fn step(&self) -> f64 {
        STEP
    }
}

fn skyline(outside: &Outside) -> Option<&Skyline> {
    outside.surroundings()?.skyline.as_ref()
}

/// Returns sky and sun of the moment to which panels are fitted.
fn trial(outside: &Outside, [cos, sin]: [f64; 2]) -> (Outside, Sun) {
    let [reflectance, rise, aside, normal] = TRIAL;
    let [right, before] = [DVec3::new(cos, sin, 0.0), DVec3::new(sin, -cos, 0.0)];
    let direction = Dir::new(before + aside * right + rise * DVec3::Z).expect("parts along three axes");
    let sun = Sun { direction, direct_normal: normal };
    let sky = Outside::new(Distribution::uniform(), 1.0)
        .and_then(|sky| sky.with_ground(reflectance, sun.horizontal()))
        .and_then(|sky| sky.with_skyline(outside.skyline_altitude(), 0.0));
    (sky.expect("a uniform sky, and a skyline that is there already"), sun)
}

impl Prepared {
    /// Prepares obstructions and computes their daylight coefficients. `outside`: gives the shape of the skyline, and
    /// the ground reflectance for which the interreflection is computed in advance; `setting`: boxes, building and
    /// ground, in the world's axes; `turn`: cosine and sine of the angle from east to the room's x axis; `viewpoints`:
    /// corners of the apertures in the world's axes \[m\]; `number`: a number that no other obstructions have.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if `progress` is cancelled.
    pub fn new(
        outside: &Outside,
        setting: Setting,
        turn: [f64; 2],
        viewpoints: Vec<DVec3>,
        number: u64,
        progress: &dyn Progress,
    ) -> Result<Self, Cancelled> {
        let (sky, sun) = trial(outside, turn);
        let skyline = skyline(outside);
        let lit = direct_sun(&sky, skyline, Some(&sun));
        let tried = scenery(&sky, skyline, lit, &setting, turn);
        let ground = OpenGround::of(&tried, &viewpoints);
        let wanted = wanted(&tried, &viewpoints);
        let mut seen = lights(&tried, &ground, &wanted, &viewpoints, &PANELS, progress)?;
        let mut all = Panels::coarse(&tried, &ground).lights;
        beside(&tried, &viewpoints).into_iter().for_each(|index| all[index] = seen[index].clone());
        let unseen = |index: &usize| tried.surfaces[*index].reflects() && !wanted.contains(index);
        (0..seen.len()).filter(unseen).for_each(|index| seen[index] = FaceLight::even(0.0));
        // Without a sun, all parts of a surface are included, whether they will be sunlit or not.
        let scenery = scenery(&sky, skyline, None, &setting, turn);
        let (panels, all) = (Panels::new(seen), Panels::new(all));
        let sources = |[spacing, side, least]: [f64; 3], wanted: Option<&[usize]>| {
            let cells = SunCells::new(&scenery, &ground, wanted, &viewpoints, [side, least]);
            Sources { dome: Dome::new(spacing), cells }
        };
        let lighting = sources(LIGHTING, None);
        let gather = |panels: &Panels| {
            let row = |vista: Vista<'_>| {
                let mut row = Gathering {
                    sources: &lighting,
                    ground: (scenery.ground(), &ground),
                    exchange: &all,
                    row: vec![0.0; lighting.len()],
                    by_other: vec![0.0; all.places.len()],
                };
                vista.collect(&mut row);
                (row.row.iter().map(|counts| *counts as f32).collect::<Vec<f32>>(), sparse(&row.by_other))
            };
            let (rows, seen): (Vec<_>, Vec<_>) =
                panels.each(&scenery, progress, row)?.into_iter().map(Option::unzip).unzip();
            let lit: Lit = Mat::from_fn(rows.len(), lighting.len(), |node, source| {
                rows[node].as_ref().map_or(0.0, |row: &Vec<f32>| row[source])
            });
            Ok::<_, Cancelled>((lit, seen))
        };
        let (lit, exchanged) = gather(&all)?;
        let (gathered, from_all) = gather(&panels)?;
        let source = panels.free(from_all.iter().map(Option::is_some));
        let mut from_exchange = Mat::zeros(from_all.len(), all.places.len());
        for (node, counts) in from_all.iter().enumerate() {
            for (other, counts) in counts.iter().flatten() {
                from_exchange[(node, *other as usize)] = *counts;
            }
        }
        let exchange = Exchange::new(all, exchanged);
        let prepared = Self {
            number,
            boxes: scenery.bodies[..scenery.bodies.len() - 1].to_vec(),
            stated: scenery.surfaces.iter().map(|surface| surface.stated).collect(),
            skyline: skyline.cloned(),
            flat: outside.skyline_altitude().sin(),
            seen: sources(SEEN, Some(&wanted)),
            exchange,
            lit,
            panels,
            source,
            gathered,
            from_exchange,
            solved: Mutex::default(),
            ground: (scenery.surfaces[scenery.ground()].face, ground),
            setting,
            turn,
            viewpoints,
            wanted,
            lighting,
        };
        prepared.prepare_ground(outside);
        Ok(prepared)
    }

    /// Returns the number of these prepared obstructions, which no others have.
    pub const fn number(&self) -> u64 {
        self.number
    }

    /// Returns the memory that its matrices take, with the interreflection for one reflectance of the ground. \[bytes\]
    pub fn bytes(&self) -> usize {
        let (nodes, all) = (self.source.len(), self.exchange.panels().places.len());
        size_of::<f32>() * ((2 * nodes + all) * self.lighting.len() + nodes * all)
    }

    /// Returns the boxes of the obstructions, without building and ground.
    pub fn boxes(&self) -> &[Solid] {
        &self.boxes
    }

    /// Returns the number of luminances in the list of a moment ([`Self::luminances`]).
    pub const fn count(&self) -> usize {
        self.seen.len() + self.source.len()
    }

    /// Computes and caches the interreflection for the ground reflectance of `outside`, which many hours share.
    pub fn prepare_ground(&self, outside: &Outside) {
        self.solved(&self.scenery(outside, None));
    }

    /// Returns the luminances of the nodes in view per luminance of each source, for the ground reflectance of a
    /// scenery; computes them if they are not cached.
    fn solved(&self, scenery: &Scenery<'_>) -> Arc<Mat<f32>> {
        let key = scenery.surfaces[scenery.ground()].reflectance.to_bits();
        // The cache is valid even if another thread panicked while it held the lock.
        let kept = || self.solved.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, found)) = kept().iter().find(|(known, _)| *known == key) {
            return Arc::clone(found);
        }
        // Computed without holding the lock, because threads that compute parts of this must not wait for it.
        let albedo = |node: usize| (scenery.surfaces[self.panels.places[node].0].reflectance / PI) as f32;
        let gathered = |first: usize, all: Mat<f32>| {
            let mut light = self.gathered.subcols(first, all.ncols()).to_owned();
            matmul(light.as_mut(), Accum::Add, self.from_exchange.as_ref(), all.as_ref(), 1.0, Par::Seq);
            light
        };
        let light = self.exchange.solved_together(scenery, &self.lit, gathered);
        let mut seen = Mat::zeros(self.source.len(), self.lighting.len());
        let columns = light.iter().flat_map(|some| some.col_iter());
        for (mut to, from) in seen.col_iter_mut().zip(columns) {
            for (node, source) in self.source.iter().enumerate() {
                to[node] = albedo(node) * from[*source];
            }
        }
        let seen = Arc::new(seen);
        let mut kept = kept();
        if kept.len() >= GROUNDS {
            kept.remove(0);
        }
        kept.push((key, Arc::clone(&seen)));
        seen
    }

    /// Computes the luminances of the nodes in view, without the part directly reflected from the sun, for moments with
    /// the same ground reflectance. \[cd/m²\]
    fn exchanged(&self, moments: &[(&Outside, &Scenery<'_>)]) -> Vec<Vec<f32>> {
        let Some((_, scenery)) = moments.first() else { return Vec::new() };
        let mut sent: Vec<f32> =
            moments.iter().flat_map(|(outside, scenery)| self.lighting.luminances(outside, scenery)).collect();
        let columns = moments.len().max(COLUMNS);
        sent.resize(columns * self.lighting.len(), 0.0);
        let sent = MatRef::from_column_major_slice(&sent, self.lighting.len(), columns);
        let mut light = Mat::zeros(self.source.len(), columns);
        matmul(light.as_mut(), Accum::Replace, self.solved(scenery).as_ref(), sent, 1.0, Par::Seq);
        (0..moments.len()).map(|moment| light.col_as_slice(moment).to_vec()).collect()
    }

    fn scenery<'a>(&self, outside: &'a Outside, sun: Option<&Sun>) -> Scenery<'a> {
        let skyline = skyline(outside);
        scenery(outside, skyline, direct_sun(outside, skyline, sun), &self.setting, self.turn)
    }

    /// Returns the luminances of moments, each given by its sky and sun: for each a list of [`Self::count`] values, of
    /// the sky, of sunlit cells and of surfaces. \[cd/m²\]
    pub fn luminances(&self, moments: &[(&Outside, Option<&Sun>)]) -> Vec<Vec<f32>> {
        let sceneries: Vec<Scenery<'_>> = moments.iter().map(|(outside, sun)| self.scenery(outside, *sun)).collect();
        let moments: Vec<_> = moments.iter().map(|(outside, _)| *outside).zip(&sceneries).collect();
        let same = |a: &(&Outside, &Scenery<'_>), b: &(&Outside, &Scenery<'_>)| {
            a.0.ground_reflectance() == b.0.ground_reflectance()
        };
        let surfaces = moments.chunk_by(same).flat_map(|moments| self.exchanged(moments));
        let whole = |((outside, scenery), surfaces): (&(&Outside, &Scenery<'_>), Vec<f32>)| {
            [self.seen.luminances(outside, scenery), surfaces].concat()
        };
        moments.iter().zip(surfaces).map(whole).collect()
    }

    /// Calls `add` with the indices in the list of a moment and the weights of the luminances that make up the
    /// luminance seen from the point `eye` in the direction `towards` (world's axes, \[m\]). Returns an index of the
    /// surface seen, to compare it with that of other directions.
    pub fn look(&self, eye: DVec3, towards: DVec3, mut add: impl FnMut(usize, f64)) -> usize {
        let sources = &self.seen;
        let hit = first_hit(self.boxes.iter().enumerate(), eye, towards);
        let (face, ground) = &self.ground;
        let to_ground = if towards.z < 0.0 { ((face.origin.z - eye.z) / towards.z).max(0.0) } else { f64::INFINITY };
        let (surface, distance) = match hit.filter(|(_, distance, _)| *distance < to_ground) {
            Some((solid, distance, number)) => (6 * solid + number, distance),
            None if to_ground < f64::INFINITY => (self.stated.len() - 1, to_ground),
            None => {
                let hidden =
                    self.skyline.as_ref().is_some_and(|skyline| skyline.covers(towards)) || towards.z < self.flat;
                if hidden {
                    add(sources.skyline(), 1.0);
                    return SKY - 1;
                }
                sources.dome.spread(towards, add);
                return SKY;
            }
        };
        let point = eye + distance * towards;
        if let Some(luminance) = self.stated[surface] {
            add(sources.stated(), luminance);
            return surface;
        }
        let at = if surface == self.stated.len() - 1 {
            face.coordinates(point)
        } else {
            self.boxes[surface / 6].face(surface % 6).coordinates(point)
        };
        if surface == self.stated.len() - 1 && !ground.holds(at) {
            add(sources.beyond(), 1.0);
            return surface;
        }
        sources.cells.at(surface, at, |cell| add(sources.first_cell() + cell, 1.0));
        self.panels.weigh(surface, at, |node, share| add(sources.len() + node, share));
        surface
    }

    /// Returns the weights of a moment's luminances in the illuminance of the plane of `frame` at the point `eye`,
    /// separately for every patch of `basis`. \[sr\] `eye`: in the world's axes \[m\].
    pub fn patches(&self, eye: DVec3, frame: &Frame, basis: &RingBasis) -> Vec<Counts> {
        let [few, many] =
            DIRECTIONS.map(|(all, [least, most])| (all / basis.len()).next_power_of_two().clamp(least, most));
        let mut row = SparseSum::new(self.count());
        let own = eye.to_array().map(f64::to_bits).into_iter().fold(0, |own: u64, bits| own.rotate_left(21) ^ bits);
        let of = |index: usize| {
            let cell = basis.cell(index);
            let [inner, outer] = [cell.theta_min, cell.theta_max].map(|theta| theta.sin().powi(2));
            let mut look = |number: usize| {
                let [s, t] = net(number as u32, own.wrapping_add(index as u64));
                let theta = (inner + (outer - inner) * s).sqrt().asin();
                let towards = frame.direction(theta, cell.phi + (t - 0.5) * cell.width);
                self.look(eye, towards, |place, share| row.add(place, share))
            };
            let first = look(0);
            let alike = (1..few).filter(|number| look(*number) == first).count();
            let count = if alike == few - 1 { few } else { many };
            (few..count).for_each(|number| {
                look(number);
            });
            let counts = (cell.projected_solid_angle() / count as f64) as f32;
            let mut seen = row.take();
            seen.iter_mut().for_each(|(_, share)| *share *= counts);
            seen
        };
        (0..basis.len()).map(of).collect()
    }

    /// Returns `outside` with these obstructions and the ground in front of it, with their luminances under its sky and
    /// the sun. `outside` must have the skyline for which the obstructions were prepared.
    pub fn under(&self, outside: &Outside, sun: Option<&Sun>) -> Outside {
        let skyline = skyline(outside);
        let direct_sun = direct_sun(outside, skyline, sun);
        let scenery = scenery(outside, skyline, direct_sun, &self.setting, self.turn);
        let ground = OpenGround::of(&scenery, &self.viewpoints);
        let light: Vec<f64> = self.exchanged(&[(outside, &scenery)]).concat().into_iter().map(f64::from).collect();
        let mut lights = self.panels.with(&light);
        lights.iter_mut().for_each(|light| light.error += OTHERS);
        let around = assembled(&scenery, &ground, lights, &self.wanted, direct_sun.map(|(direction, _)| direction));
        outside.open().behind(Arc::new(around))
    }
}

#[cfg(test)]
mod tests;

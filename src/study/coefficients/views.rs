//! V: illuminance at every sensor per luminance of every emergent cell of an aperture, directly and by interreflection.

use crate::compute::basis::{Resampling, RingBasis};
use crate::compute::dot::add_scaled;
use crate::compute::estimate::Progress;
use crate::compute::room::band_weights::BandWeights;
use crate::compute::room::first_bounce::from_even;
use crate::compute::room::nodes::Nodes;
use crate::compute::room::patch_weights::{MOST_CELLS, merged_cells, merging};
use crate::compute::system::measure::ProfileLight;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use crate::study::session::Session;
use crate::study::session::responses::{Reflected, Responses};
use crate::study::session::seen_cells::SeenCells;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Illuminances at the sensors in three rows, one after the other, each with one number per sensor: all light, its
/// interreflected part, and the uncertainty of that part.
pub(super) type SensorRows = Vec<f64>;

/// Maximum number of divisions into bands for which the shares of bands in cells are stored; the oldest is dropped.
const MOST_BANDS: usize = 4;

/// Illuminances at the sensors per luminance of every emergent cell of a basis, or of every band of the profile angle.
/// \[lx per cd/m²\]
pub(super) struct Views {
    width: usize,
    sensors: usize,
    /// Direct illuminances, which are the same for all systems; `None` if not requested.
    straight: Option<Arc<SeenCells>>,
    /// Interreflected illuminances; `None` without interreflection.
    reflected: Option<Reflections>,
    /// Mean relative gap between the flux of a cell and the flux found on the surfaces of the room, before it was
    /// closed.
    pub gap: f64,
}

/// Interreflected illuminances at the sensors per luminance of emergent cells.
struct Reflections {
    /// Illuminances cell by cell: all sensors, followed by their uncertainties where these are requested.
    rows: Vec<f32>,
    width: usize,
    /// Merging by which luminances of the basis become luminances of these cells, where the basis has more cells than
    /// the room can distinguish.
    merging: Option<Merging>,
}

/// Merging of many emergent cells into those that the room can distinguish.
struct Merging {
    onto: Arc<Resampling>,
    cells: usize,
    /// Merged cells to which each cell contributes, with the factors of its luminance; computed when single cells are
    /// requested.
    by_cell: OnceLock<Vec<Vec<(usize, f64)>>>,
}

impl Merging {
    fn of(&self, cell: usize) -> &[(usize, f64)] {
        let by_cell = self.by_cell.get_or_init(|| {
            let mut lists = vec![Vec::new(); self.cells];
            for to in 0..merged_cells().len() {
                self.onto.shares(to).iter().for_each(|&(from, share)| lists[from].push((to, share)));
            }
            lists
        });
        &by_cell[cell]
    }
}

/// Requested rows of the illuminances.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Want {
    /// All three rows of [`SensorRows`].
    All,
    /// Only the first row of [`SensorRows`]: all light.
    Sum,
    /// All three rows of [`SensorRows`] by interreflected light alone, without direct light.
    Reflected,
}

/// Aperture of a scene whose effect on the sensors is computed, with the means of the computation.
#[derive(Clone, Copy)]
pub(super) struct Opening<'a> {
    pub session: &'a Session,
    pub scene: &'a Scene,
    /// Index of the aperture in the scene, from 0.
    pub index: usize,
    /// Responses of the room to light on its surfaces; `None` without interreflection.
    pub room: Option<&'a Responses>,
    /// Nodes of the aperture. If given, interreflected light is computed for each node, for light that is 1 at that
    /// node and falls to 0 at the others; direct light is left out.
    pub nodes: Option<&'a Nodes>,
    pub progress: &'a dyn Progress,
}

impl Opening<'_> {
    /// Returns the number of illuminances in a row: sensors, times nodes if there are any (node by node, sensor by
    /// sensor).
    pub fn places(&self) -> usize {
        self.scene.sensors.len() * self.nodes.map_or(1, Nodes::count)
    }
}

impl Views {
    /// Computes the illuminances at the sensors per luminance of each cell of an emergent basis. \[lx per cd/m²\]
    pub fn new(opening: &Opening<'_>, basis: Arc<RingBasis>, want: Want) -> Result<Self, StudyError> {
        let Opening { session, scene, index, room, nodes, progress } = *opening;
        let sensors = opening.places();
        let width = if want == Want::Sum { sensors } else { 3 * sensors };
        let straight = match want {
            Want::All | Want::Sum if nodes.is_none() => Some(session.seen_cells(scene, index, &basis, progress)?),
            _ => None,
        };
        let mut gap = 0.0;
        let reflected = room.map(|room| {
            let many = basis.len() > MOST_CELLS;
            let merged = if many { merged_cells() } else { &basis };
            gap = room.weights(session, index, merged).gap();
            let with_uncertainty = width > sensors;
            let width = if with_uncertainty { 2 * sensors } else { sensors };
            let mut rows = vec![0.0_f32; merged.len() * width];
            for (s, by_cell) in room.of_cells(session, index, merged, with_uncertainty, nodes).iter().enumerate() {
                for (row, light) in rows.chunks_exact_mut(width).zip(by_cell) {
                    row[s] = light.value as f32;
                    if with_uncertainty {
                        row[sensors + s] = light.uncertainty() as f32;
                    }
                }
            }
            let merging = many.then(|| Merging { onto: merging(&basis), cells: basis.len(), by_cell: OnceLock::new() });
            Reflections { rows, width, merging }
        });
        Ok(Self { width, sensors, straight, reflected, gap })
    }

    /// Computes the illuminances at the sensors per luminance of bands of the profile angle instead of cells.
    /// `upright`: whether the profile angle is in the horizontal plane (vertical structures); `bands`: their number.
    pub fn of_bands(opening: &Opening<'_>, (upright, bands): (bool, usize)) -> Result<Self, StudyError> {
        let Opening { session, scene, index, room, nodes, progress } = *opening;
        let sensors = opening.places();
        let straight = if nodes.is_none() {
            let seen = session.kept_bands(scene, index, (upright, bands), progress)?;
            Some(Arc::new(SeenCells::new(bands, seen.iter().map(BandWeights::each))))
        } else {
            None
        };
        let mut gap = 0.0;
        let reflected = room.map(|room| {
            let merged = merged_cells();
            gap = room.weights(session, index, merged).gap();
            let width = 2 * sensors;
            let mut rows = vec![0.0_f32; bands * width];
            let by_sensor = room.of_cells(session, index, merged, true, nodes);
            for (cell, shares) in band_shares(upright, bands).iter().enumerate() {
                for &(band, share) in shares {
                    let row = &mut rows[band * width..(band + 1) * width];
                    for (s, by_cell) in by_sensor.iter().enumerate() {
                        row[s] += (share * by_cell[cell].value) as f32;
                        row[sensors + s] += (share * by_cell[cell].uncertainty()) as f32;
                    }
                }
            }
            Reflections { rows, width, merging: None }
        });
        Ok(Self { width: 3 * sensors, sensors, straight, reflected, gap })
    }

    /// Returns the number of values in a [`SensorRows`] of the requested rows.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Adds the illuminances by one emergent cell of the given luminance \[cd/m²\] to `out`. \[lx\]
    pub fn add(&self, cell: usize, luminance: f64, out: &mut [f64]) {
        if let Some(straight) = &self.straight {
            straight.add(cell, luminance, out);
        }
        let Some(reflected) = &self.reflected else { return };
        match &reflected.merging {
            None => self.add_reflected(&reflected.rows[cell * reflected.width..][..reflected.width], luminance, out),
            Some(merging) => {
                for &(to, share) in merging.of(cell) {
                    let row = &reflected.rows[to * reflected.width..][..reflected.width];
                    self.add_reflected(row, share * luminance, out);
                }
            }
        }
    }

    /// Adds the illuminances by a whole indicatrix to `out` \[lx\]. `luminance`: luminances of all emergent cells
    /// \[cd/m²\]; empty for a dark one.
    pub fn add_all(&self, luminance: &[f64], out: &mut [f64]) {
        if let Some(straight) = &self.straight {
            for (cell, &l) in luminance.iter().enumerate().filter(|(_, l)| **l != 0.0) {
                straight.add(cell, l, out);
            }
        }
        let Some(reflected) = self.reflected.as_ref().filter(|_| !luminance.is_empty()) else { return };
        let merged = reflected.merging.as_ref().map(|merging| merging.onto.apply(luminance));
        let luminance = merged.as_deref().unwrap_or(luminance);
        let mut sum = vec![0.0; reflected.width];
        for (row, &l) in reflected.rows.chunks_exact(reflected.width).zip(luminance).filter(|(_, l)| **l != 0.0) {
            add_scaled(&mut sum, row, l);
        }
        self.add_reflected(&sum, 1.0, out);
    }

    /// Adds a row of interreflected illuminances, times `factor`, to all light and to the interreflected part.
    fn add_reflected<T: Copy + Into<f64>>(&self, row: &[T], factor: f64, out: &mut [f64]) {
        add_scaled(&mut out[..self.sensors], row, factor);
        if self.width > self.sensors {
            add_scaled(&mut out[self.sensors..], row, factor);
        }
    }
}

/// Bands of the profile angle that contribute to the mean luminance of every merged cell, with their shares.
type BandShares = Vec<Vec<(usize, f64)>>;

/// Returns the shares of bands of the profile angle in every merged cell, which are the same for all systems and
/// states; computed or stored.
fn band_shares(upright: bool, bands: usize) -> Arc<BandShares> {
    type Known = ((bool, usize), Arc<BandShares>);
    static KEPT: Mutex<Vec<Known>> = Mutex::new(Vec::new());
    // What is kept is whole even if another thread has failed while it held the lock.
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, found)) = kept.iter().find(|(known, _)| *known == (upright, bands)) {
        return Arc::clone(found);
    }
    let made = Arc::new(ProfileLight::shares_on(upright, bands, merged_cells()));
    if kept.len() == MOST_BANDS {
        kept.remove(0);
    }
    kept.push(((upright, bands), Arc::clone(&made)));
    made
}

/// Computes the illuminances at the sensors by an aperture of uniform luminance 1 cd/m². \[lx\]
pub(super) fn even(opening: &Opening<'_>) -> Result<SensorRows, StudyError> {
    let Opening { session, scene, index, room, nodes, progress } = *opening;
    let places = opening.places();
    let mut light = vec![0.0; 3 * places];
    if nodes.is_none() {
        let receptions = session.receptions(scene, index, None, progress)?;
        light.iter_mut().zip(receptions.iter()).for_each(|(to, reception)| *to = reception.uniform);
    }
    let Some(room) = room else { return Ok(light) };
    let found: Vec<Reflected> = if nodes.is_some() {
        let all = room.of_cells(session, index, &Arc::new(RingBasis::hemisphere()), true, nodes);
        all.into_iter().map(|by_cell| by_cell[0]).collect()
    } else {
        let mut first = from_even(&room.radiosity, index, &scene.apertures[index].aperture);
        first.iter_mut().for_each(|e| *e *= std::f64::consts::PI);
        room.of(&first)
    };
    for (place, reflected) in found.into_iter().enumerate() {
        light[place] += reflected.value;
        light[places + place] = reflected.value;
        light[2 * places + place] = reflected.uncertainty();
    }
    Ok(light)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::lid::sun_cells;

    #[test]
    fn single_cells_add_up_to_an_indicatrix() {
        let (basis, sensors) = (sun_cells(), 3);
        let (cells, width) = (basis.len(), 2 * sensors);
        let number = |k: usize| (0.618_034 * k as f64).fract();
        // The last sensor sees a few cells only.
        let weights = |s: usize| (0..cells).filter(move |c| s < 2 || *c < 7).map(move |c| (c, number(3 * c + s)));
        let straight = SeenCells::new(cells, (0..sensors).map(weights));
        let rows = (0..merged_cells().len() * width).map(|k| number(k + 5) as f32).collect();
        let merging = Some(Merging { onto: merging(basis), cells, by_cell: OnceLock::new() });
        let reflected = Some(Reflections { rows, width, merging });
        let views = Views { width: 3 * sensors, sensors, straight: Some(Arc::new(straight)), reflected, gap: 0.0 };
        let luminance: Vec<f64> = (0..cells).map(|c| if c % 5 == 0 { 0.0 } else { number(7 * c) }).collect();
        let [mut all, mut one_by_one] = [vec![0.0; 3 * sensors], vec![0.0; 3 * sensors]];
        views.add_all(&luminance, &mut all);
        luminance.iter().enumerate().for_each(|(cell, l)| views.add(cell, *l, &mut one_by_one));
        let apart = |(a, b): (&f64, &f64)| (a / b - 1.0).abs();
        assert!(all.iter().zip(&one_by_one).map(apart).fold(0.0, f64::max) < 1e-9, "{all:?} {one_by_one:?}");
        // The first row is what is seen straight and what the room makes of it.
        let seen: f64 = (0..7).map(|c| luminance[c] * f64::from(number(3 * c + 2) as f32)).sum();
        assert!((all[2] - all[5] - seen).abs() < 1e-9 * all[2]);
        views.add_all(&[], &mut all);
        assert!(all.iter().zip(&one_by_one).map(apart).fold(0.0, f64::max) < 1e-9);
    }
}

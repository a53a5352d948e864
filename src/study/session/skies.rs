//! Stored light of skies in front of apertures: the hours of a year, computed once for all systems that need the same
//! directions; and single skies for testing fixed directions.

use super::far;
use super::seen::keeps;
use super::sky_patches::SkyPatches;
use super::sky_year::{MOST_NUMBERS, SkyYear, SunlitYear};
use super::{Session, aperture_key, basis_key, reception_key};
use crate::compute::angle::Bearing;
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Orientation, World};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::room::grid::CellWeights;
use crate::compute::sky::{Counts, Outside, Prepared};
use crate::study::cache::{Key, bits};
use crate::study::outside::Before;
use crate::study::scene::Scene;
use glam::DVec3;
use std::f64::consts::TAU;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, OnceLock};

/// Estimated memory per sensor for an emergent cell that it sees through points of an aperture. \[numbers\]
const CELL_AT_POINTS: usize = 16;
impl Session {
    /// Returns the patches of the outside in front of an aperture, computed or stored. `patches`: basis of the incident
    /// hemisphere; `spacing`: maximum distance between the directions in which a sky is evaluated \[rad\].
    pub(crate) fn sky_patches(&self, scene: &Scene, index: usize, patches: RingBasis, spacing: f64) -> Arc<SkyPatches> {
        // A skyline that rises and falls has too much of a shape for a key.
        if far::shape(&scene.outside).is_some() {
            return Arc::new(SkyPatches::new(scene, index, patches, spacing));
        }
        let mut key = vec![scene.facing(index).surface as u64];
        key.extend(bits([scene.facade.radians(), scene.outside.skyline_altitude(), spacing]));
        key.extend(basis_key(Some(&patches)));
        self.sky_patches.find(key, || SkyPatches::new(scene, index, patches, spacing))
    }

    /// Returns the obstructions of a scene, prepared for many skies, computed or stored; `None` without any. `outside`:
    /// outside whose skyline lies behind them.
    ///
    /// # Errors
    /// Returns an error if cancelled.
    pub(crate) fn standing(
        &self,
        before: &Before,
        outside: &Outside,
        orientation: Orientation,
        progress: &dyn Progress,
    ) -> Result<Option<Arc<Prepared>>, Cancelled> {
        let Some((setting, viewpoints)) = before.turned(orientation) else { return Ok(None) };
        let mut hasher = DefaultHasher::new();
        let far = (outside.skyline_altitude(), outside.surroundings());
        format!("{setting:?} {viewpoints:?} {:?} {far:?}", orientation.turn()).hash(&mut hasher);
        let number = hasher.finish();
        let find = || Prepared::new(outside, setting, orientation.turn(), viewpoints, number, progress);
        self.standing.get(vec![number], find).map(Some)
    }

    /// Returns weights of outside luminances at points of an aperture, by point and incident patch, computed by `find`
    /// or stored. \[sr\] `kind`: number that distinguishes lists with the same points.
    pub(crate) fn seen_patches(
        &self,
        (prepared, kind): (&Prepared, u64),
        eyes: &[DVec3],
        patches: &RingBasis,
        find: impl FnOnce() -> Vec<Vec<Counts>>,
    ) -> Arc<Vec<Vec<Counts>>> {
        let mut key = vec![prepared.number(), kind];
        key.extend(eyes.iter().flat_map(|eye| bits(eye.to_array())));
        key.extend(basis_key(Some(patches)));
        self.seen_patches.find(key, find)
    }

    /// Returns the weights with which every sensor of a scene sees emergent cells through points of an aperture,
    /// computed by `find` or stored. \[sr\] `cells`: basis, or for bands of the profile angle whether the angle is in
    /// the horizontal plane, and their number.
    pub(crate) fn cells_at_points(
        &self,
        scene: &Scene,
        index: usize,
        cells: Result<&RingBasis, (bool, usize)>,
        find: impl FnOnce() -> Vec<CellWeights>,
    ) -> Arc<Vec<CellWeights>> {
        let count = cells.map_or_else(|(_, count)| count, RingBasis::len);
        if !keeps(scene, CELL_AT_POINTS * count) {
            return Arc::new(find());
        }
        let mut key = reception_key(scene, index, cells.ok());
        if let Err((horizontal, count)) = cells {
            key.extend([u64::from(horizontal), count as u64]);
        }
        self.cells_at_points.find(key, find)
    }

    /// Returns the store for the hours of a year, of `numbers` values each that depend on the sky and on something with
    /// this fingerprint; `None` if these are more than can be stored. `year`: number that identifies the year, and number
    /// of its hours.
    pub(crate) fn sky_year(&self, year: (u64, usize), fingerprint: u64, numbers: usize) -> Option<Arc<SkyYear>> {
        let find = || SkyYear::nothing(year.1, numbers);
        let fits = (1..=MOST_NUMBERS).contains(&(numbers * year.1));
        fits.then(|| self.sky_years.find(vec![year.0, year.1 as u64, fingerprint], find))
    }

    /// Returns the store for the light that enters at the nodes of an aperture through incident patches in the hours of
    /// a year, `numbers` values in each; `None` if these are more than can be stored. `prepared`: number of the prepared
    /// obstructions.
    pub(crate) fn entering_year(
        &self,
        year: (u64, usize),
        prepared: u64,
        (scene, index): (&Scene, usize),
        patches: &RingBasis,
        numbers: usize,
    ) -> Option<Arc<SkyYear>> {
        let mut hasher = DefaultHasher::new();
        (prepared, aperture_key(scene, index), basis_key(Some(patches))).hash(&mut hasher);
        self.sky_year(year, hasher.finish(), numbers)
    }

    /// Returns the store for the sunlit parts of an aperture in the hours of a year. `prepared`: number of the prepared
    /// obstructions.
    pub(crate) fn sunlit_year(
        &self,
        (number, hours): (u64, usize),
        prepared: u64,
        (scene, index): (&Scene, usize),
    ) -> Arc<SunlitYear> {
        let mut key = vec![number, prepared];
        key.extend(aperture_key(scene, index));
        self.sunlit_years.find(key, || (0..hours).map(|_| OnceLock::new()).collect())
    }

    /// Returns the skies under which the fixed directions of a façade's patches are tested, computed by `find` or
    /// stored.
    pub(crate) fn trial_skies(&self, facade: Bearing, find: impl FnOnce() -> Vec<Outside>) -> Arc<Vec<Outside>> {
        let key = vec![facade.radians().to_bits()];
        self.trial_skies.find(key, find)
    }

    /// Returns the illuminances of a sky through patches with this fingerprint \[lx\], computed by `find` or stored.
    pub(crate) fn exact_sky(
        &self,
        outside: &Outside,
        fingerprint: u64,
        find: impl FnOnce() -> Vec<f64>,
    ) -> Arc<Vec<f64>> {
        let mut key = sky_key(outside);
        key.push(fingerprint);
        self.exact_skies.find(key, find)
    }
}

/// Returns the key of a sky in the cache: luminances that differ between all skies that are tested.
fn sky_key(outside: &Outside) -> Key {
    let spiral = (0..24).map(|k| {
        let z = (f64::from(k) + 0.5) / 24.0;
        let (sin, cos) = (TAU * 0.381_966 * f64::from(k)).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Dir::<World>::from_unit(glam::DVec3::new(across * cos, across * sin, z))
    });
    let mut key: Key = spiral.map(|d| outside.luminance(d).to_bits()).collect();
    key.extend(
        [outside.ground_luminance(), outside.skyline_luminance(), outside.diffuse_horizontal()].map(f64::to_bits),
    );
    key
}

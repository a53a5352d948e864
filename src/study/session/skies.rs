//! Skies on the patches before an aperture: the hours of a year, found once for all systems that are known by the same
//! patches; and single skies that many systems are tried under.

use super::Session;
use super::sky_year::SkyYear;
use crate::compute::direction::{Dir, World};
use crate::compute::sky::Outside;
use crate::study::cache::Key;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Most patches that years are kept of: 8,760 hours of so many are 40 MB.
const MOST_PATCHES: usize = 600;

impl Session {
    /// The hours of a year that has a number of its own, for patches of some fingerprint; `None` for more patches than
    /// are worth keeping.
    pub(in crate::study) fn sky_year(
        &self,
        year: (u64, usize),
        fingerprint: u64,
        patches: usize,
    ) -> Option<Arc<SkyYear>> {
        let nothing = || Ok::<_, std::convert::Infallible>(SkyYear::nothing(year.1));
        (patches <= MOST_PATCHES).then(|| match self.sky_years.get(vec![year.0, year.1 as u64, fingerprint], nothing) {
            Ok(kept) => kept,
            Err(never) => match never {},
        })
    }

    /// What a sky gives on patches of some fingerprint, found anew or kept.
    pub(in crate::study) fn exact_sky(
        &self,
        outside: &Outside,
        fingerprint: u64,
        find: impl FnOnce() -> Vec<f64>,
    ) -> Arc<Vec<f64>> {
        let mut key = told_apart(outside);
        key.push(fingerprint);
        match self.exact_skies.get(key, || Ok::<_, std::convert::Infallible>(find())) {
            Ok(kept) => kept,
            Err(never) => match never {},
        }
    }
}

/// Luminances that no other sky of those that are tried has.
fn told_apart(outside: &Outside) -> Key {
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

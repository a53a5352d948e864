//! Views from points on surfaces, collected once, from which the illuminance is computed for changing luminances of the
//! surfaces in view.

use super::equations::{Counts, Panels, SparseSum};
use super::open_ground::OpenGround;
use super::scenery::Scenery;
use super::vista::Vista;
use crate::compute::surroundings::face_light::FaceLight;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Maximum number of cached parts of surfaces: 64 MB. Chosen: cost only, no effect on results.
const KEPT: usize = 4_000_000;

/// Part of a surface in a view: index of the surface, coordinates there \[m\], projected solid angle \[sr\].
type Part = (u32, [f32; 2], f32);

/// Illuminance of a point on a surface: a fixed part, and the parts of surfaces in view whose luminance may change.
pub(super) struct Received {
    /// Illuminance by sky, skyline, surfaces of given luminance, sunlight directly reflected by surfaces, and
    /// unobstructed ground. \[lx\]
    rest: f64,
    /// Parts of surfaces whose smooth luminance contributes in addition.
    parts: Vec<Part>,
}

impl Received {
    /// Returns the illuminance of the point for the smooth luminances `lights` of all surfaces. \[lx\]
    pub fn illuminance(&self, lights: &[FaceLight]) -> f64 {
        let part = |(surface, at, counts): &Part| {
            let [u, v] = at.map(f64::from);
            f64::from(*counts) * lights[*surface as usize].diffuse(u, v)
        };
        self.rest + self.parts.iter().map(part).sum::<f64>()
    }

    /// Returns the illuminance by everything except the nodes of panels \[lx\], and the weights of these nodes \[sr\].
    /// `others`: luminances of the surfaces without nodes; `sum`: empty buffer.
    pub fn by_node(&self, panels: &Panels, others: &[Option<&FaceLight>], sum: &mut SparseSum) -> (f64, Counts) {
        let mut rest = self.rest;
        for (surface, at, counts) in &self.parts {
            let ([u, v], counts) = (at.map(f64::from), f64::from(*counts));
            match others[*surface as usize] {
                Some(light) => rest += counts * light.diffuse(u, v),
                None => panels.weigh(*surface as usize, [u, v], |node, share| sum.add(node, counts * share)),
            }
        }
        (rest, sum.take())
    }
}

/// Surface and coordinates of a point, as bits.
type Key = (usize, [u64; 2]);

/// Views from points on surfaces, cached up to a limit.
pub(super) struct Views<'a> {
    scenery: &'a Scenery<'a>,
    ground: &'a OpenGround,
    kept: Mutex<(HashMap<Key, Arc<Received>>, usize)>,
}

impl<'a> Views<'a> {
    /// Creates an empty cache of views in a scenery.
    pub fn new(scenery: &'a Scenery<'a>, ground: &'a OpenGround) -> Self {
        Self { scenery, ground, kept: Mutex::default() }
    }

    /// Returns the view from a point of a surface, given by its coordinates there \[m\]; `None` if a body covers the
    /// point.
    pub fn of(&self, surface: usize, at: [f64; 2]) -> Option<Arc<Received>> {
        let key = (surface, at.map(f64::to_bits));
        // The cache is valid even if another thread panicked while it held the lock.
        let kept = || self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = kept().0.get(&key) {
            return Some(Arc::clone(known));
        }
        let point = self.scenery.surfaces[surface].face.point(at[0], at[1]);
        if self.scenery.is_covered(surface, point) {
            return None;
        }
        let (mut parts, mut open) = (Vec::new(), 0.0);
        let rest = Vista::new(self.scenery, surface, point).gather(|other, at, counts| {
            if other == self.scenery.ground() && !self.ground.holds(at) {
                open += counts;
            } else {
                parts.push((other as u32, at.map(|x| x as f32), counts as f32));
            }
        });
        let found = Arc::new(Received { rest: rest + open * self.ground.luminance, parts });
        let mut kept = kept();
        let (all, count) = &mut *kept;
        if *count + found.parts.len() <= KEPT {
            *count += found.parts.len();
            all.insert(key, Arc::clone(&found));
        }
        Some(found)
    }
}

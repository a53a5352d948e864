//! Glare sources: patches and discs above a threshold, grouped as `evalglare` groups the pixels of a picture.
//!
//! Parts nearer than [`REACH`] to each other are one source of their mean luminance, at the centroid of their light in
//! the picture; parts brighter than [`PEAK`] are separate sources.

use super::discs::Disc;
use super::field::Field;
use super::gaze::position_index;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Half of the search angle of `evalglare` (its `-r 0.2`): parts no further from each other are one source. \[rad\]
pub const REACH: f64 = 0.1;
/// Luminance above which light is a peak, a separate source (`evalglare -Y 50000`). \[cd/m²\]
pub const PEAK: f64 = 5e4;

/// Kind of a glare source: bright patches of apertures, patches of peak luminance, or the sun.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Aperture patches (with discs of the sun, if any) brighter than the threshold, but not above [`PEAK`].
    Bright,
    /// Aperture patches brighter than [`PEAK`].
    Peak,
    /// Direct or redirected sun brighter than [`PEAK`].
    Sun,
}

/// One glare source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    /// Kind of the source.
    pub kind: Kind,
    /// Unit vector from the eye to the centroid of the source's light, in the room's axes.
    pub to: DVec3,
    /// Mean luminance of the source towards the eye. \[cd/m²\]
    pub luminance: f64,
    /// Solid angle of the source. \[sr\]
    pub solid_angle: f64,
    /// Position index P of the source: after Guth, or below the line of sight after Iwata.
    pub position_index: f64,
}

/// All glare sources of an observer.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sources {
    /// Glare sources in the order of falling luminance.
    pub list: Vec<Source>,
    /// Sum of L² ω / P² over the sources (luminance L, solid angle ω, position index P), as in DGP. \[cd²/m⁴ sr\]
    pub sum: f64,
    /// Estimated absolute error of `sum` due to the width of the patches, from comparing halves of them.
    pub error: f64,
}

/// Sums of luminance, solid angle and position over a group of patches, or over a part of the group.
#[derive(Debug, Clone, Copy, Default)]
struct Light {
    solid_angle: f64,
    /// Sum of luminance times solid angle. \[cd sr/m²\]
    flux: f64,
    /// Sum of the positions in the eye's picture \[rad\], weighted by luminance times solid angle.
    place: DVec2,
}

impl Light {
    fn add(&mut self, luminance: f64, solid_angle: f64, place: DVec2) {
        let flux = luminance * solid_angle;
        self.solid_angle += solid_angle;
        self.flux += flux;
        self.place += flux * place;
    }

    fn plus(self, other: Self, factor: f64) -> Self {
        Self {
            solid_angle: self.solid_angle + factor * other.solid_angle,
            flux: self.flux + factor * other.flux,
            place: self.place + factor * other.place,
        }
    }

    fn luminance(&self) -> f64 {
        self.flux / self.solid_angle
    }

    fn middle(&self) -> DVec2 {
        self.place / self.flux
    }

    /// Returns L² ω / P² for the position index P of a position in the eye's picture \[rad\]. \[cd² sr/m⁴\]
    fn term(&self, place: DVec2) -> f64 {
        if self.solid_angle <= 0.0 || self.flux <= 0.0 {
            return 0.0;
        }
        self.flux * self.luminance() / position_index(place).powi(2)
    }
}

#[derive(Debug, Clone, Copy, Default)]
struct Group {
    quarters: [Light; 4],
    discs: Light,
}

impl Group {
    fn whole(&self) -> Light {
        self.quarters.iter().fold(self.discs, |sum, quarter| sum.plus(*quarter, 1.0))
    }

    /// Returns the error of the group's L² ω / P² due to the width of its patches: the largest difference of it between
    /// every other row and the others, between every other column and the others, and between the fields of a
    /// chessboard. Half of it would be the error of their mean, were they independent; along straight edges they are
    /// not. Rows and columns represent the solid angle of all, of which they need not have one half each; the place is
    /// that of all, for halves lie a little aside.
    fn error(&self, place: DVec2) -> f64 {
        let all: f64 = self.quarters.iter().map(|quarter| quarter.solid_angle).sum();
        let by = |halves: [[usize; 2]; 2], scaled: bool| {
            let terms = halves.map(|[a, b]| {
                let half = self.quarters[a].plus(self.quarters[b], 1.0);
                let factor = if scaled && half.solid_angle > 0.0 { all / half.solid_angle } else { 2.0 };
                self.discs.plus(half, factor).term(place)
            });
            (terms[0] - terms[1]).abs()
        };
        by([[0, 1], [2, 3]], true).max(by([[0, 2], [1, 3]], true)).max(by([[0, 3], [1, 2]], false))
    }
}

impl Sources {
    /// Finds the glare sources among patches of given luminances and discs. `luminance`: of every patch of `field`,
    /// towards the eye; `threshold`: above it a patch or disc is a glare source. \[cd/m²\]
    pub fn new(field: &Field, luminance: &[f64], discs: &[Disc], threshold: f64) -> Self {
        let count = field.patches.len();
        let bright = linked(field, luminance, discs, threshold);
        let peaks = linked(field, luminance, discs, threshold.max(PEAK));
        // Peaks are groups of their own.
        let mut groups: BTreeMap<(bool, usize), Group> = BTreeMap::new();
        let key = |at: usize| peaks[at].map(|root| (true, root)).or_else(|| bright[at].map(|root| (false, root)));
        for (at, patch) in field.patches.iter().enumerate() {
            if let Some(key) = key(at) {
                let quarter = &mut groups.entry(key).or_default().quarters[patch.quarter];
                quarter.add(luminance[at], patch.solid_angle, patch.place);
            }
        }
        for (at, disc) in discs.iter().enumerate() {
            if let Some(key) = key(count + at) {
                let place = field.gaze.place(disc.to);
                groups.entry(key).or_default().discs.add(disc.luminance, disc.solid_angle, place);
            }
        }
        let mut all = Self::default();
        for ((peak, _), group) in groups {
            let whole = group.whole();
            if whole.flux <= 0.0 || whole.solid_angle <= 0.0 {
                continue;
            }
            let place = whole.middle();
            all.sum += whole.term(place);
            all.error += group.error(place);
            all.list.push(Source {
                kind: match peak {
                    true if group.discs.flux > 0.0 => Kind::Sun,
                    true => Kind::Peak,
                    false => Kind::Bright,
                },
                to: field.gaze.direction(place),
                luminance: whole.luminance(),
                solid_angle: whole.solid_angle,
                position_index: position_index(place),
            });
        }
        all.list.sort_by(|a, b| b.luminance.total_cmp(&a.luminance));
        all
    }
}

/// Disjoint sets of indices that can be joined (union–find); each entry points towards the root of its set.
struct Links(Vec<usize>);

impl Links {
    fn root(&mut self, mut at: usize) -> usize {
        while self.0[at] != at {
            self.0[at] = self.0[self.0[at]];
            at = self.0[at];
        }
        at
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
}

/// Returns the angular radius of a small disc of the given solid angle \[sr\]. \[rad\]
fn radius(solid_angle: f64) -> f64 {
    (solid_angle / std::f64::consts::PI).sqrt()
}

/// Returns the number of the group that each patch belongs to, then the same for each disc; `None` for those whose
/// luminance is not above `least` \[cd/m²\]. Neighbours, and parts within [`REACH`] of each other, form one group.
fn linked(field: &Field, luminance: &[f64], discs: &[Disc], least: f64) -> Vec<Option<usize>> {
    let count = field.patches.len();
    let bright = |at: usize| luminance[at] > least;
    let mut links = Links((0..count + discs.len()).collect());
    // Neighbours touch; a patch with a dark or no neighbour may be near to others beyond.
    let mut rim = Vec::new();
    let mut widest: f64 = 0.0;
    for &at in field.rising().iter().filter(|&&at| bright(at)) {
        let beside = field.beside(at);
        for other in beside.into_iter().flatten().filter(|&other| bright(other)) {
            links.join(at, other);
        }
        if beside.iter().any(|other| !other.is_some_and(bright)) {
            rim.push(at);
            widest = widest.max(radius(field.patches[at].solid_angle));
        }
    }
    let near = |a: DVec3, b: DVec3, reach: f64| a.distance_squared(b) <= (2.0 * (0.5 * reach).sin()).powi(2);
    for (k, &at) in rim.iter().enumerate() {
        let own = &field.patches[at];
        let reach = REACH + radius(own.solid_angle);
        for &other in &rim[k + 1..] {
            let beyond = &field.patches[other];
            // Sorted by height: all that follow are too high as well.
            if beyond.to.z - own.to.z > reach + widest {
                break;
            }
            if near(own.to, beyond.to, reach + radius(beyond.solid_angle)) {
                links.join(at, other);
            }
        }
    }
    for (k, disc) in discs.iter().enumerate().filter(|(_, disc)| disc.luminance > least) {
        let reach = REACH + radius(disc.solid_angle);
        for (at, patch) in field.patches.iter().enumerate().filter(|(at, _)| bright(*at)) {
            if near(disc.to, patch.to, reach + radius(patch.solid_angle)) {
                links.join(count + k, at);
            }
        }
        for (other, beyond) in discs.iter().enumerate().take(k).filter(|(_, beyond)| beyond.luminance > least) {
            if near(disc.to, beyond.to, reach + radius(beyond.solid_angle)) {
                links.join(count + k, count + other);
            }
        }
    }
    let shines = |at: usize| if at < count { bright(at) } else { discs[at - count].luminance > least };
    (0..count + discs.len()).map(|at| shines(at).then(|| links.root(at))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Surface;
    use crate::compute::room::aperture::Aperture;
    use crate::compute::room::direct::Sensor;

    fn eye() -> Sensor {
        Sensor { position: DVec3::new(2.5, 2.0, 1.2), normal: DVec3::NEG_Y }
    }

    fn window(x: f64, width: f64) -> Aperture {
        Aperture { surface: Surface::Facade, corner: DVec3::new(x, 0.0, 0.9), size: [width, 1.0] }
    }

    #[test]
    fn windows_apart_are_two_sources_and_near_ones_are_one() {
        // 0.1 rad are 0.2 m at 2 m.
        for (gap, expected) in [(0.15, 1), (0.30, 2)] {
            let pair = [window(1.4 - 0.5 * gap, 1.1), window(2.5 + 0.5 * gap, 1.1)];
            let field = Field::new(&eye(), &pair);
            let all = Sources::new(&field, &vec![3000.0; field.patches.len()], &[], 2000.0);
            assert_eq!(all.list.len(), expected, "{gap}");
            let [seen, _] = field.solid_angles();
            let listed: f64 = all.list.iter().map(|one| one.solid_angle).sum();
            assert!((listed - seen).abs() < 1e-9);
            assert!(all.list.iter().all(|one| (one.luminance - 3000.0).abs() < 1e-6));
        }
        let field = Field::new(&eye(), &[window(1.4, 2.2)]);
        assert!(Sources::new(&field, &vec![2000.0; field.patches.len()], &[], 2000.0).list.is_empty());
    }

    #[test]
    fn the_sum_is_that_of_the_sources() {
        let field = Field::new(&eye(), &[window(1.4, 2.2)]);
        let all = Sources::new(&field, &vec![3000.0; field.patches.len()], &[], 2000.0);
        let [one] = all.list[..] else { panic!("{all:?}") };
        let expected = one.luminance.powi(2) * one.solid_angle / one.position_index.powi(2);
        assert!((all.sum / expected - 1.0).abs() < 1e-12 && all.error < 0.01 * all.sum);
        // Symmetric about the line of sight but for height.
        assert!(one.to.x.abs() < 1e-9 && one.to.z > 0.0);
    }

    #[test]
    fn suns_and_peaks_are_sources_of_their_own() {
        let field = Field::new(&eye(), &[window(1.4, 2.2)]);
        let sun = Disc { to: DVec3::new(0.0, -0.98, 0.199).normalize_or_zero(), luminance: 1e8, solid_angle: 6.8e-5 };
        let all = Sources::new(&field, &vec![3000.0; field.patches.len()], &[sun], 2000.0);
        assert_eq!(all.list.iter().map(|one| one.kind).collect::<Vec<_>>(), [Kind::Sun, Kind::Bright]);
        // A faint disc is not a peak: it joins the aperture around it.
        let faint = Disc { luminance: 4e4, ..sun };
        let all = Sources::new(&field, &vec![3000.0; field.patches.len()], &[faint], 2000.0);
        assert_eq!(all.list.len(), 1);
        // Before a dark window it is alone.
        let all = Sources::new(&field, &vec![100.0; field.patches.len()], &[faint], 2000.0);
        assert_eq!(all.list.len(), 1);
        assert!((all.sum / (1.6e9 * 6.8e-5 / all.list[0].position_index.powi(2)) - 1.0).abs() < 1e-9);
        // The upper half a peak.
        let halves: Vec<f64> = field.patches.iter().map(|p| if p.to.z > 0.0 { 6e4 } else { 3000.0 }).collect();
        let all = Sources::new(&field, &halves, &[], 2000.0);
        assert_eq!(all.list.iter().map(|one| one.kind).collect::<Vec<_>>(), [Kind::Peak, Kind::Bright]);
    }
}

//! Glare at an eye: what the apertures send there, and the daylight glare probability of it.

use super::Session;
use super::seen::inside;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::glare::{
    Disc, Field, Glare, Kind, Ray, Threshold, View, add_emitted, add_seen_through, dgps, discs, glare, is_proven,
};
use crate::compute::lid::{BeamLight, Emission, Facing};
use crate::compute::room::aperture::Aperture;
use crate::compute::room::beams_past::{beams_past, lit, lit_by_rim};
use crate::compute::room::direct::{Sensor, beams_through};
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use glam::DVec3;

/// What is to be said with every glare probability (report, section 5.1).
pub const CAVEAT: &str = "the contrast of single slats is finer than data of a whole system can show: bright edges of slats \
                          near the eye are in it as their mean alone";

/// Glare at an eye of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct EyeGlare {
    /// The eye.
    pub eye: Sensor,
    /// Illuminance at it, interreflection and all errors counted. \[lx\]
    pub vertical: Estimate,
    /// DGP, its error and its sources.
    pub glare: Glare,
    /// The simplified DGP; only while neither the sun, straight or turned, nor a lobe above
    /// [`PEAK`](crate::compute::glare::PEAK) meets the eye.
    pub dgps: Option<f64>,
    /// What the eye sees of the sun.
    pub discs: Vec<Disc>,
    /// Lies the value where the formula was tested with people?
    pub proven: bool,
}

/// Light of all apertures for eyes.
pub(crate) struct Shining {
    emissions: Vec<Emission>,
    /// Where boxes or a skyline stand before them: what of each the sun reaches, and by points of its rim.
    lit: Vec<Lit>,
}

/// Pieces of an aperture, and the same for points of the sun's rim.
type Lit = (Vec<Vec<DVec3>>, Vec<Vec<Vec<DVec3>>>);

impl Session {
    /// Glare at an eye, in the room's axes; its normal is the line of sight. What is seen of the room's surfaces counts by
    /// its illuminance at the eye alone: sun patches on them are no sources. Behind boxes what a system scatters is the mean
    /// over the aperture; what goes straight through is as the eye sees it.
    ///
    /// # Errors
    /// As [`Self::room`]; cancelled.
    pub fn glare(&self, scene: &Scene, eye: &Sensor, progress: &dyn Progress) -> Result<EyeGlare, StudyError> {
        let own = Scene { sensors: vec![*eye], grid: None, ..scene.clone() };
        let vertical = self.room(&own, progress)?.sensors[0].total();
        Ok(self.shining(scene, progress)?.glare(scene, &eye_field(scene, eye), eye, vertical, Threshold::default()))
    }

    /// What all apertures send to eyes.
    pub(crate) fn shining(&self, scene: &Scene, progress: &dyn Progress) -> Result<Shining, StudyError> {
        Ok(Shining::of(scene, self.lights(scene, progress)?.emissions))
    }

    /// The same of the sun alone, before an outside that is dark but for it; past boxes what is scattered is the mean over the
    /// aperture.
    pub(crate) fn sunshine(&self, scene: &Scene) -> Shining {
        let emission = |index: usize| {
            let facing = scene.facing(index);
            if facing.sun_illuminance() <= 0.0 {
                return Emission::dark();
            }
            let around = scene.outside.surroundings();
            let share = around.map_or(1.0, |around| lit(&scene.apertures[index].aperture, &facing, around).1);
            let emission = self.emission_under(scene, index, &facing);
            if share >= 1.0 {
                return emission;
            }
            let beams = emission.beams.clone();
            Emission { beams, ..emission.scaled(share) }
        };
        Shining::of(scene, (0..scene.apertures.len()).map(emission).collect())
    }
}

/// The apertures of a scene as an eye sees them.
pub(crate) fn eye_field(scene: &Scene, eye: &Sensor) -> Field {
    Field::new(&inside(scene, eye), scene.apertures.iter().map(|one| &one.aperture))
}

/// Beams through an aperture as an eye sees them: all in one, given what it sees of one alone \[lx\].
fn rays(eye: &Sensor, aperture: &Aperture, beams: &[BeamLight], seen: impl Fn(&BeamLight) -> f64) -> Vec<Ray> {
    let ray = |beam: &BeamLight| {
        let to = aperture.surface.room_from_facade(beam.to.vector());
        let across = beam.normal * to.dot(eye.normal);
        let share = if across > 0.0 { (seen(beam) / across).clamp(0.0, 1.0) } else { 0.0 };
        Ray { to, normal: beam.normal, share }
    };
    beams.iter().map(ray).filter(|ray| ray.share > 0.0).collect()
}

/// The same where nothing stands before the aperture.
fn open_rays(eye: &Sensor, aperture: &Aperture, beams: &[BeamLight], facing: &Facing<'_>) -> Vec<Ray> {
    rays(eye, aperture, beams, |beam| beams_through(eye, aperture, &[*beam], facing).beam)
}

impl Shining {
    fn of(scene: &Scene, emissions: Vec<Emission>) -> Self {
        let Some(around) = scene.outside.surroundings() else { return Self { emissions, lit: Vec::new() } };
        let reached = |(index, emission): (usize, &Emission)| {
            let (aperture, facing) = (&scene.apertures[index].aperture, scene.facing(index));
            if emission.beams.is_empty() {
                return Lit::default();
            }
            (lit(aperture, &facing, around).0, lit_by_rim(aperture, &facing, around))
        };
        let lit = emissions.iter().enumerate().map(reached).collect();
        Self { emissions, lit }
    }

    /// At one eye that sees the apertures as `field`.
    pub fn glare(
        &self,
        scene: &Scene,
        field: &Field,
        eye: &Sensor,
        vertical: Estimate,
        threshold: Threshold,
    ) -> EyeGlare {
        let (luminance, discs) = self.seen(scene, field, eye);
        evaluated(field, eye, &luminance, discs, vertical, threshold)
    }

    /// Luminances of the patches, and discs of the sun.
    pub fn seen(&self, scene: &Scene, field: &Field, eye: &Sensor) -> (Vec<f64>, Vec<Disc>) {
        let mut luminance = vec![0.0; field.patches.len()];
        let mut all = Vec::new();
        let outside = scene.outside.seen_from(scene.orientation.to_world(eye.position));
        for (index, emission) in self.emissions.iter().enumerate() {
            let (aperture, facing) = (&scene.apertures[index].aperture, scene.facing(index));
            add_emitted(field, index, emission, &facing, &mut luminance);
            if let Some(tau) = &emission.regular {
                add_seen_through(field, index, tau, &Facing { outside: &outside, ..facing }, &mut luminance);
            }
            let own = inside(scene, eye);
            match (scene.outside.surroundings(), self.lit.get(index)) {
                (Some(around), Some((lit, rim))) => {
                    let past = |beam: &BeamLight| beams_past(&own, aperture, lit, rim, &[*beam], &facing, around).beam;
                    all.extend(rays(&own, aperture, &emission.beams, past));
                }
                _ => all.extend(open_rays(&own, aperture, &emission.beams, &facing)),
            }
        }
        (luminance, discs(&all))
    }
}

/// DGP of what an eye sees.
pub(crate) fn evaluated(
    field: &Field,
    eye: &Sensor,
    luminance: &[f64],
    discs: Vec<Disc>,
    vertical: Estimate,
    threshold: Threshold,
) -> EyeGlare {
    // The light at the eye is that of the apertures: what is open of one is open of the other.
    let relative = if vertical.value > 0.0 { (vertical.error / vertical.value).min(1.0) } else { 0.0 };
    let glare = glare(&View { field, luminance, discs: &discs, vertical, relative }, threshold);
    let lobe = !discs.is_empty() || glare.sources.list.iter().any(|source| source.kind != Kind::Bright);
    EyeGlare {
        eye: *eye,
        vertical,
        dgps: (!lobe).then(|| dgps(vertical.value)),
        proven: is_proven(vertical.value, glare.dgp.value),
        glare,
        discs,
    }
}

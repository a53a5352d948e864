//! Glare at an observer: illuminance at the eye, luminances of the apertures, and the daylight glare probability (DGP).

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

/// Caveat to be stated with every glare probability (report, section 5.1).
pub const CAVEAT: &str = "the contrast of single slats is finer than data of a whole system can show: bright edges of slats \
                          near the eye are in it as their mean alone";

/// Glare at one observer of a scene at one moment.
#[derive(Debug, Clone, PartialEq)]
pub struct EyeGlare {
    /// Position and view direction of the observer.
    pub eye: Sensor,
    /// Vertical illuminance at the eye, direct and interreflected, with all its errors. \[lx\]
    pub vertical: Estimate,
    /// Daylight glare probability (DGP) with its error, and the glare sources.
    pub glare: Glare,
    /// Simplified DGP (DGPs) from the vertical illuminance alone; `None` if the eye sees the sun, directly or
    /// redirected, or a lobe above [`PEAK`](crate::compute::glare::PEAK).
    pub dgps: Option<f64>,
    /// Images of the solar disc that the eye sees, directly or redirected.
    pub discs: Vec<Disc>,
    /// Whether the DGP lies in the range for which the formula was validated with people.
    pub proven: bool,
}

/// Light that all apertures emit, for computing what observers see.
pub(crate) struct ApertureLight {
    emissions: Vec<Emission>,
    /// Sunlit pieces of each aperture, as a whole and for points on the rim of the solar disc; empty without boxes and
    /// skyline that varies with the bearing.
    lit: Vec<Lit>,
}

/// Sunlit pieces of an aperture, and below the sunlit pieces for each of several points on the rim of the solar disc;
/// in the room frame. \[m\]
type Lit = (Vec<Vec<DVec3>>, Vec<Vec<Vec<DVec3>>>);

impl Session {
    /// Computes the glare at an observer. `eye`: position of the eye in the room frame; its normal is the line of
    /// sight. Light from the room's surfaces contributes only to the illuminance at the eye: patches of sun on them do
    /// not count as glare sources. Behind boxes the luminance by scattered light is the mean over the aperture; regular
    /// transmission is evaluated as the eye sees it.
    ///
    /// # Errors
    /// Returns the errors of [`Self::room`], or an error if cancelled.
    pub fn glare(&self, scene: &Scene, eye: &Sensor, progress: &dyn Progress) -> Result<EyeGlare, StudyError> {
        let own = Scene { sensors: vec![*eye], grid: None, ..scene.clone() };
        let vertical = self.room(&own, progress)?.sensors[0].total();
        Ok(self.aperture_light(scene, progress)?.glare(
            scene,
            &eye_field(scene, eye),
            eye,
            vertical,
            Threshold::default(),
        ))
    }

    /// Computes the light that all apertures emit, for observers.
    pub(crate) fn aperture_light(&self, scene: &Scene, progress: &dyn Progress) -> Result<ApertureLight, StudyError> {
        Ok(ApertureLight::of(scene, self.lights(scene, progress)?.emissions))
    }

    /// Computes the light that all apertures emit under the sun alone, for observers; past boxes, scattered light is
    /// the mean over the aperture.
    pub(crate) fn sunshine(&self, scene: &Scene) -> ApertureLight {
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
        ApertureLight::of(scene, (0..scene.apertures.len()).map(emission).collect())
    }
}

/// Returns the apertures of a scene as an observer sees them, divided into patches of the field of view.
pub(crate) fn eye_field(scene: &Scene, eye: &Sensor) -> Field {
    Field::new(&inside(scene, eye), scene.apertures.iter().map(|one| &one.aperture))
}

/// Returns the beams through an aperture that an eye sees, each with the share of it that reaches the eye. `seen`:
/// illuminance at the eye by one beam. \[lx\]
fn rays(eye: &Sensor, aperture: &Aperture, beams: &[BeamLight], seen: impl Fn(&BeamLight) -> f64) -> Vec<Ray> {
    let ray = |beam: &BeamLight| {
        let to = aperture.surface.room_from_facade(beam.to.vector());
        let across = beam.normal * to.dot(eye.normal);
        let share = if across > 0.0 { (seen(beam) / across).clamp(0.0, 1.0) } else { 0.0 };
        Ray { to, normal: beam.normal, share }
    };
    beams.iter().map(ray).filter(|ray| ray.share > 0.0).collect()
}

/// Returns the beams that an eye sees through an aperture without obstructions in front of it.
fn open_rays(eye: &Sensor, aperture: &Aperture, beams: &[BeamLight], facing: &Facing<'_>) -> Vec<Ray> {
    rays(eye, aperture, beams, |beam| beams_through(eye, aperture, &[*beam], facing).beam)
}

impl ApertureLight {
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

    /// Computes the glare at one observer. `field`: apertures in the field of view; `vertical`: illuminance at the eye
    /// \[lx\]; `threshold`: luminance from which patches are glare sources.
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

    /// Returns the luminances of the patches in an observer's field of view \[cd/m²\], and the images of the solar
    /// disc.
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

/// Computes the DGP of an observer from the luminances of the patches in the field of view \[cd/m²\] and the images of
/// the solar disc.
pub(crate) fn evaluated(
    field: &Field,
    eye: &Sensor,
    luminance: &[f64],
    discs: Vec<Disc>,
    vertical: Estimate,
    threshold: Threshold,
) -> EyeGlare {
    // The light at the eye is that of the apertures: both have the same relative uncertainty.
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

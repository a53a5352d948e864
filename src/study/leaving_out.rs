//! Error of interpolation between the incident directions of a scene's datasets, by cross-validation: the data of every
//! direction are predicted from those of its neighbours and compared with the actual ones. Takes some seconds per
//! dataset, and no result depends on it, so that it is computed on request.

use super::error::StudyError;
use super::scene::Scene;
use super::scene_file::Interpolation;
use crate::compute::btdf::{Indicatrices, Scattered};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::incidence::left_out::LeftOut;
use crate::compute::incidence::model::Model;
use crate::compute::incidence::schemes::SunScheme;
use crate::texts::{fixed, words as texts};
use std::sync::Arc;

/// Result of the cross-validation of one dataset: errors of interpolation between its incident directions.
#[derive(Debug, Clone, PartialEq)]
pub struct LeavingOut {
    /// Label of the system to which the dataset belongs.
    pub label: String,
    /// Errors by direction: shares of the transmitted flux that a prediction from the neighbours sends in wrong
    /// directions.
    pub left_out: LeftOut,
    /// Share of the transmitted sunlight that interpolation to the sun's direction is stated to send in wrong
    /// directions, with the scheme of the scene and the actual spacing of the data's directions; the largest over the
    /// apertures. `None` if the sun does not shine on them.
    pub sun: Option<f64>,
}

/// Cross-validates every dataset of the scene that is given at single incident directions and interpolated between
/// them, each once.
pub fn leaving_out(scene: &Scene, progress: &dyn Progress) -> Result<Vec<LeavingOut>, StudyError> {
    let mut done: Vec<(&Arc<Indicatrices>, Model, LeavingOut)> = Vec::new();
    for (index, aperture) in scene.apertures.iter().enumerate() {
        let scattered = aperture.transmission().and_then(|btdf| btdf.scattered.as_ref());
        let Some(Scattered::Directions(data)) = scattered.filter(|_| scene.interpolation != Interpolation::Patch)
        else {
            continue;
        };
        let place = match done.iter().position(|(other, ..)| Arc::ptr_eq(other, data)) {
            Some(place) => place,
            None => {
                if progress.cancelled() {
                    return Err(Cancelled.into());
                }
                let model = Model::new(Arc::clone(data));
                let left_out = LeftOut::new(&model);
                done.push((data, model, LeavingOut { label: aperture.system.label.clone(), left_out, sun: None }));
                done.len() - 1
            }
        };
        let (_, model, own) = &mut done[place];
        let facing = scene.facing(index);
        if let Some(direction) = facing.sun_direction().filter(|_| facing.sun_illuminance() > 0.0) {
            let stated = own.left_out.stated(scene.sun_interpolation, &model.lattice().locate(direction));
            own.sun = Some(own.sun.map_or(stated, |other| other.max(stated)));
        }
    }
    Ok(done.into_iter().map(|(.., own)| own).collect())
}

impl LeavingOut {
    /// Returns sentences on the errors, which name other schemes where they would have predicted a direction better
    /// than the default one, responses.
    pub fn sentences(&self) -> String {
        let count = self.left_out.directions().count();
        let percent = |share: f64| format!("{} %", fixed(100.0 * share, 1));
        let means: Vec<String> = SunScheme::ALL
            .into_iter()
            .map(|scheme| format!("{} {}", scheme.key(), percent(self.left_out.mean(scheme))))
            .collect();
        let mut text = texts::left_out(&self.label, count, means.join(", "));
        for scheme in SunScheme::ALL {
            let better = self.left_out.directions().filter_map(|one| {
                let (best, gain) = one.better()?;
                (best == scheme).then_some((gain, one))
            });
            let list: Vec<_> = better.collect();
            if let Some((gain, one)) = list.iter().max_by(|a, b| a.0.total_cmp(&b.0)) {
                text.push_str(&texts::better_scheme(
                    scheme.key(),
                    list.len(),
                    percent(*gain),
                    fixed(one.direction.theta().to_degrees(), 0),
                    fixed(one.direction.phi().to_degrees(), 0),
                    percent(one.error(scheme)),
                    percent(one.error(SunScheme::Responses)),
                ));
            }
        }
        if let Some(stated) = self.sun {
            text.push_str(&texts::stated_for_sun(percent(stated)));
        }
        text
    }
}

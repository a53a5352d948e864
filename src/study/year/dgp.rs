//! Daylight glare probability (DGP) at every observer in every lit occupied step, from the illuminances of the year.
//!
//! Parts that do not change between steps are computed once for each set of states: the patches that an observer sees,
//! and the luminance of each emergent cell per light from outside. If data are interpolated by another scheme than the
//! default, the systems are evaluated again in every step.

use super::eye_light::{EyeLight, is_tabled};
use super::fixed::{put_ordinary, with_states};
use super::light::{Light, Question};
use crate::compute::estimate::{Cancelled, Estimate, Progress, Silent};
use crate::compute::glare::{Field, LEAST_ILLUMINANCE, Threshold};
use crate::compute::sky::{Outside, Prepared, Sun};
use crate::study::error::StudyError;
use crate::study::outside::Before;
use crate::study::scene::Scene;
use crate::study::session::far;
use crate::study::session::glare::{EyeGlare, evaluated, eye_field};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Daylight glare probability (DGP) in the chosen steps: rows of steps, columns of observers; `None` in unoccupied and
/// in dark steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Dgp {
    /// Number of observers.
    pub eyes: usize,
    /// DGP with its error, step by step, one value per observer.
    pub values: Vec<Option<Estimate>>,
    /// Number of values outside the range for which the formula was validated with people.
    pub unproven: usize,
}

impl Dgp {
    /// Returns the DGP of one step, one value per observer. `step`: index among the chosen steps.
    pub fn row(&self, step: usize) -> &[Option<Estimate>] {
        &self.values[step * self.eyes..][..self.eyes]
    }
}

/// Computes the DGP of the chosen steps. Returns `None` if there are no observers, or if it is not requested. `states`:
/// states of the moving apertures in all steps; `light`: illuminances in the chosen steps.
///
/// # Errors
/// Returns an error if the scene is wrong, or if cancelled.
pub(super) fn dgp(
    question: &Question<'_>,
    states: &[Vec<usize>],
    chosen: &[usize],
    light: &Light,
    notes: &mut Vec<String>,
    progress: &dyn Progress,
) -> Result<Option<Dgp>, StudyError> {
    let settings = question.settings;
    let eyes = settings.eyes.len();
    if eyes == 0 || !settings.keys.dgp {
        return Ok(None);
    }
    let mut groups: BTreeMap<&[usize], Vec<usize>> = BTreeMap::new();
    for (row, &k) in chosen.iter().enumerate() {
        let step = &question.steps.list[k];
        if step.occupied && step.hour.is_lit() {
            groups.entry(&states[k]).or_default().push(row);
        }
    }
    let total: usize = groups.values().map(Vec::len).sum();
    let mut found = Dgp { eyes, values: vec![None; eyes * chosen.len()], unproven: 0 };
    let done = AtomicUsize::new(0);
    for (set, rows) in groups {
        let engine = Engine::new(question, set, progress)?;
        let of = |&row: &usize| {
            if progress.cancelled() {
                return Err(StudyError::from(Cancelled));
            }
            let [values, errors] = [&light.values, &light.errors].map(|table| &table.row(row)[settings.sensors..]);
            let vertical: Vec<Estimate> =
                values.iter().zip(errors).map(|(e, error)| Estimate::new((*e).into(), (*error).into())).collect();
            let glare = engine.at(question, chosen[row], &vertical)?;
            progress.advance("glare", done.fetch_add(1, Ordering::Relaxed) + 1, total);
            Ok((row, glare))
        };
        let all: Vec<(usize, Vec<EyeGlare>)> = rows.par_iter().map(of).collect::<Result<_, StudyError>>()?;
        for (row, glare) in all {
            for (eye, one) in glare.into_iter().enumerate() {
                found.values[row * eyes + eye] = Some(one.glare.dgp);
                found.unproven += usize::from(!one.proven);
            }
        }
    }
    if found.unproven > 0 {
        notes.push(format!(
            "{} of {} glare probabilities lie outside of what the formula was tested for (0.2 to 0.8, {LEAST_ILLUMINANCE} lx \
             and more): they say no more than little, or much",
            found.unproven,
            found.values.iter().flatten().count()
        ));
    }
    Ok(Some(found))
}

/// Computation of glare under any sky and sun, with the moving apertures in one set of states.
struct Engine {
    scene: Scene,
    /// Obstructions outside, prepared for many skies; `None` if there are none.
    prepared: Option<Arc<Prepared>>,
    /// Fields of view, one per observer: the patches of all apertures that it sees.
    fields: Vec<Field>,
    /// Tables of the diffuse light, one per aperture; empty if the systems are evaluated step by step.
    tables: Vec<EyeLight>,
    /// Outside without light, but with its skyline and boxes, for sunlight alone.
    dark: Option<Outside>,
}

impl Engine {
    /// Prepares the scene with the states `set` of the moving apertures: obstructions, fields of view and tables.
    fn new(question: &Question<'_>, set: &[usize], progress: &dyn Progress) -> Result<Self, StudyError> {
        let mut file = with_states(question.file, question.moving, set);
        put_ordinary(&mut file);
        // Boxes are lit by the sky of each step.
        let scene = Scene::resolve(&file.without_outside(), question.base, question.library)?;
        let apertures: Vec<_> = scene.apertures.iter().map(|one| one.aperture).collect();
        let before = Before::of(question.file, &scene.room, &apertures)?;
        let prepared = question.session.standing(&before, &scene.outside, scene.orientation, progress)?;
        let fields: Vec<Field> = question.settings.eyes.iter().map(|eye| eye_field(&scene, eye)).collect();
        let dark = far::dark(&scene.outside).map(|dark| match before.dark(&dark, scene.orientation) {
            Some(boxes) => dark.open().behind(boxes),
            None => dark,
        });
        let tabled = dark.is_some() && (0..scene.apertures.len()).all(|index| is_tabled(&scene, index));
        let year = (question.steps.number(), question.steps.list.len());
        let table = |index: usize| {
            let btdf = scene.apertures[index].transmission()?;
            let eyes = (&question.settings.eyes[..], &fields[..]);
            Some(EyeLight::new(question.session, (&scene, index), btdf, eyes, prepared.as_ref(), year))
        };
        let tables = if tabled { (0..scene.apertures.len()).filter_map(table).collect() } else { Vec::new() };
        Ok(Self { scene, prepared, fields, tables, dark })
    }

    /// Computes the glare at every observer in one step of the year. `hour`: index of the step; `vertical`:
    /// illuminances at the eyes. \[lx\]
    fn at(&self, question: &Question<'_>, hour: usize, vertical: &[Estimate]) -> Result<Vec<EyeGlare>, StudyError> {
        let (outside, sun) = question.steps.outside(hour)?;
        if !self.tables.is_empty() {
            return Ok(self.by_tables(question, (hour, &outside), sun.as_ref(), vertical));
        }
        let eyes = &question.settings.eyes;
        let outside = match &self.prepared {
            Some(prepared) => prepared.under(&outside, sun.as_ref()),
            None => outside,
        };
        let scene = Scene { outside, sun, ..self.scene.clone() };
        let light = question.session.aperture_light(&scene, &Silent)?;
        let of = |((eye, field), vertical)| light.glare(&scene, field, eye, vertical, Threshold::default());
        Ok(eyes.iter().zip(&self.fields).zip(vertical.iter().copied()).map(of).collect())
    }

    /// Computes the glare with diffuse light from the tables, and direct sunlight evaluated for the step.
    fn by_tables(
        &self,
        question: &Question<'_>,
        (hour, outside): (usize, &Outside),
        sun: Option<&Sun>,
        vertical: &[Estimate],
    ) -> Vec<EyeGlare> {
        let light: Vec<Vec<f64>> = self.tables.iter().map(|table| table.light(hour, outside, sun)).collect();
        let cells: Vec<Vec<f64>> = self.tables.iter().zip(&light).map(|(table, light)| table.cells(light)).collect();
        let sunlit = self.dark.clone().zip(sun).map(|(outside, &sun)| {
            let scene = Scene { outside, sun: Some(sun), ..self.scene.clone() };
            (question.session.sunshine(&scene), scene)
        });
        let of = |number: usize| {
            let (eye, field) = (&question.settings.eyes[number], &self.fields[number]);
            let dark = || (vec![0.0; field.patches.len()], Vec::new());
            let (mut luminance, discs) =
                sunlit.as_ref().map_or_else(dark, |(sunshine, scene)| sunshine.seen(scene, field, eye));
            for (index, table) in self.tables.iter().enumerate() {
                table.add(number, &light[index], &cells[index], outside, &mut luminance[field.of[index].clone()]);
            }
            evaluated(field, eye, &luminance, discs, vertical[number], Threshold::default())
        };
        (0..self.fields.len()).map(of).collect()
    }
}

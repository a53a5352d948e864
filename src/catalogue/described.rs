//! Products made from system descriptions: provenance, names of the states, control curve.

use super::systems::{blind_of, builtin_system};
use super::{CurvePoint, NewProduct, Origin, Provenance, StateName};
use crate::compute::btdf::{Band, Dataset, DescribedState, Finding, Scattered};
use crate::compute::control::curve::{redirecting_tilt, retro_tilt};
use crate::compute::control::cut_off::SlatRow;
use crate::compute::direction::Dir;
use crate::compute::sky::SUN_HALF_ANGLE;
use crate::compute::system::measure::{OpticalModel, Quality, Side};
use crate::compute::system::slats::Venetian;
use crate::compute::system::stack::{LayerSource, Stack};
use crate::compute::system::{SystemDescription, SystemKind};
use crate::formats::system_toml::{self, EACH_STATE, MOST_NESTED, SystemFile};
use std::f64::consts::FRAC_PI_2;

/// Elevation to which redirecting slats send direct sunlight: flat enough to reach deep into a room, steep enough to
/// arrive at the ceiling. \[rad\]
const ELEVATION: f64 = 0.611;
/// Step in profile angle of the computed control curves. \[°\]
const STEP: u32 = 5;

/// Returns the product data (name, provenance, states, control curve) for datasets that were computed from a system
/// description. `text`: text of the description, whose hash represents the inputs; `method`: text on the method of
/// computation.
///
/// The product stores the description that the datasets carry, which contains the layers of a stack; if they carry
/// none, `text` unchanged.
pub fn product_of(file: &SystemFile, text: &str, method: String, datasets: &[Dataset]) -> NewProduct {
    let system = &file.system;
    NewProduct {
        key: (!file.key.is_empty()).then(|| file.key.clone()),
        name: system.name.clone(),
        kind: system.family().word().to_owned(),
        description: system.description.clone(),
        provenance: Provenance {
            origin: Origin::Computed,
            author: "cfs".to_owned(),
            method,
            source_hash: blake3::hash(text.as_bytes()).to_hex().to_string(),
            inside_face: system.family().inside_face().to_owned(),
            ..Provenance::default()
        },
        tags: file.tags.clone(),
        states: datasets.iter().map(state_name).collect(),
        control_curve: blind_of(text).map(|blind| control_curve(&file.control, &blind)).unwrap_or_default(),
        system: common_description(datasets).unwrap_or_else(|| text.to_owned()),
        ..NewProduct::default()
    }
}

/// Returns the description from which all datasets were computed, each as one of its states; `None` where a dataset has
/// another description or none.
pub(super) fn common_description(datasets: &[Dataset]) -> Option<String> {
    let mut all = datasets.iter().map(|dataset| {
        let own = dataset.described.as_ref()?;
        (own.state == dataset.state).then_some(&own.text)
    });
    let first = all.next()??;
    all.all(|other| other == Some(first)).then(|| first.clone())
}

/// Returns the description of one state of a product, with the text of all its layers; `None` without a readable one.
/// `system`: description that the product stores; stacks of older catalogues refer to built-in files in it.
pub(super) fn described_state(system: &str, state: &str) -> Option<DescribedState> {
    if system.is_empty() {
        return None;
    }
    system_toml::described(&with_builtins(system, 0)?, state)
}

/// Returns the normal–normal transmittance computed from the description, without BSDF data; `None` where the
/// description cannot be read, or refers to layers that are not contained in it.
pub(super) fn view(described: &DescribedState) -> Option<f64> {
    let model = optical_model(&described.text, &described.state, 0)?;
    Some(model.straight(Dir::from_unit(glam::DVec3::Z), Side::Front).clamp(0.0, 1.0))
}

fn optical_model(text: &str, state: &str, depth: usize) -> Option<Box<dyn OpticalModel>> {
    let system = system_toml::read(text.as_bytes()).ok()?.system;
    let SystemKind::Stack(layers) = &system.kind else { return system.optical_model(state).ok() };
    let within = |layer: &crate::compute::system::stack::Layer| {
        let LayerSource::Text(own) = &layer.source else { return None };
        let state = if layer.state == EACH_STATE { state } else { &layer.state };
        (depth < MOST_NESTED).then(|| optical_model(own, state, depth + 1))?
    };
    // Upright ones too: light along the normal does not notice a turn about it.
    let layers: Option<Vec<_>> = layers.iter().map(within).collect();
    Some(Box::new(Stack::new(layers?)))
}

/// Returns a description into which the texts of all layers are inserted that are built-in files; `None` if a layer
/// cannot be found. `depth`: level of nesting so far.
pub(super) fn with_builtins(text: &str, depth: usize) -> Option<String> {
    system_toml::self_contained(text, &mut |source| match source {
        LayerSource::File(name) if depth < MOST_NESTED => with_builtins(builtin_system(name)?.1, depth + 1),
        LayerSource::File(_) | LayerSource::Catalogue(_) | LayerSource::Text(_) => None,
    })
}

/// Version of the methods that compute data from descriptions. It is raised whenever computed values change, so that
/// data stored by an older program are not mistaken for current ones.
pub const METHODS: u32 = 3;

/// Returns a text on the method by which a described system was computed, for its provenance: program version, model,
/// error target (absolute in τ and ρ), numbers of incident and emergent cells.
pub fn method(system: &SystemDescription, error: f64, [incident, emergent]: [usize; 2]) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let words = system.family().method();
    format!("Numerical goniophotometer of cfs {version}: {words}; error target {error}, {incident} × {emergent} cells")
}

/// Creates the dataset of a computed state, with findings that state the reached quality. `visible`: computed BSDF
/// data; `error`: error target of the computation, absolute in τ and ρ.
pub fn described_dataset(file: &SystemFile, state: String, visible: Band, quality: &Quality, error: f64) -> Dataset {
    let system = &file.system;
    let reciprocity = match quality.reciprocity {
        Some(error) => format!("reciprocity within {:.2} % of the flux", 100.0 * error),
        None => "reciprocity not counted on unequal cells".to_owned(),
    };
    let balance = 100.0 * quality.balance;
    let text = format!(
        "Computed ({}): τ + ρ + α = 1 within {balance:.3} %, {reciprocity}, {ERROR_WORDS}{:.4}.",
        system.family().method(),
        quality.error
    );
    let mut findings = vec![Finding::info("computed", text)];
    if quality.error > error {
        let reached = quality.error;
        let text = format!("The error target {error} was not reached at every incidence; {reached:.4} at the worst.");
        findings.push(Finding::warning("error-target-missed", text));
    }
    Dataset {
        name: system.name.clone(),
        description: system.description.clone(),
        state,
        structure: system.family().structure(),
        visible,
        findings,
        ..Dataset::default()
    }
}

/// Beginning of the words in a finding of [`described_dataset`] that state the reached error.
const ERROR_WORDS: &str = "estimated error of τ and ρ at most ";

/// Returns the absolute uncertainty of a dataset's transmittances τ: 0 for ideal systems, the reached error for
/// computed data; `None` where the data do not state it, such as measured ones.
pub fn stated_error(dataset: &Dataset) -> Option<f64> {
    let transmission = dataset.transmission()?;
    if matches!(transmission.scattered, None | Some(Scattered::Lambert(_))) && dataset.described.is_none() {
        return Some(0.0);
    }
    let finding = dataset.findings.iter().find(|finding| finding.code == "computed")?;
    let (_, number) = finding.message.split_once(ERROR_WORDS)?;
    // Half a digit more: it was rounded.
    number.trim_end_matches('.').parse::<f64>().ok().map(|error| error + 0.5e-4)
}

fn state_name(dataset: &Dataset) -> StateName {
    match dataset.state.parse::<f64>().ok().filter(|value| value.is_finite()) {
        Some(degrees) => StateName { label: format!("slats {degrees}°"), value: Some(degrees) },
        None => StateName { label: dataset.state.clone(), value: None },
    }
}

/// Returns the control curve of a venetian blind, slat tilt over the profile angle of the sun, for the key of a rule:
/// `cut-off` just blocks direct sun, `retro` reflects it back towards the sun, `redirect` sends it to the ceiling;
/// empty for other keys. Tilts are limited to the range of the blind's states.
pub fn control_curve(rule: &str, blind: &Venetian) -> Vec<CurvePoint> {
    let range = blind.angles.iter().fold([FRAC_PI_2, -FRAC_PI_2], |[low, high], &a| [low.min(a), high.max(a)]);
    let Some(section) = SlatRow::of(blind) else { return Vec::new() };
    let tilt = |psi: f64| match rule {
        "cut-off" => {
            let most_open = [range[0].max(0.0), range[1]];
            // The whole disc has to stay out.
            Some(section.cut_off(most_open, 0.0, [psi - SUN_HALF_ANGLE, psi + SUN_HALF_ANGLE]).unwrap_or(range[1]))
        }
        "retro" => Some(retro_tilt(psi)),
        "redirect" => Some(redirecting_tilt(psi, ELEVATION)),
        _ => None,
    };
    (0..90_u32.div_ceil(STEP))
        .filter_map(|k| {
            let profile_angle = f64::from(k * STEP);
            let value = tilt(profile_angle.to_radians())?.clamp(range[0], range[1]).to_degrees();
            Some(CurvePoint { profile_angle, value: (value * 100.0).round() / 100.0 })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::system::slats::SlatProfile;
    use crate::compute::system::slats::Surface;

    fn blind() -> Venetian {
        Venetian {
            profile: SlatProfile::Flat { width: 0.08 },
            spacing: 0.072,
            thickness: 0.0,
            angles: (-5..=15).map(|k| f64::from(5 * k).to_radians()).collect(),
            upper: Surface::mirror(0.85),
            lower: Surface::matt(0.5),
        }
    }

    #[test]
    fn curves_follow_their_closed_forms() {
        let at = |rule: &str, psi: f64| {
            let curve = control_curve(rule, &blind());
            curve.iter().find(|point| point.profile_angle == psi).unwrap().value
        };
        // asin(0.9 cosψ) − ψ, the sun's lower edge deciding.
        assert!((at("cut-off", 20.0) - 37.8).abs() < 1.0 && at("cut-off", 60.0) == 0.0);
        assert!((at("retro", 30.0) - 60.0).abs() < 1e-9 && at("retro", 5.0) == 75.0);
        assert!((at("redirect", 45.0) + 5.0).abs() < 0.1 && at("redirect", 85.0) == -25.0);
        assert!(control_curve("", &blind()).is_empty());
    }
}

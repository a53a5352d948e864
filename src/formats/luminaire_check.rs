//! Checks of a luminaire that was read from a file, the same for all formats. Impossible values give an error;
//! contradictions and omissions give findings.

use super::luminaire::{Luminaire, Photometry};
use super::luminaire_opening::Opening;
use super::luminaire_planes::{CLOSEST, same_angle};
use super::luminaire_text::number;
use super::{FormatError, Location};
use crate::compute::btdf::Finding;
use crate::compute::limits;

/// Magnitude up to which a negative intensity is accepted as measurement noise, relative to the largest intensity.
const BELOW_ZERO: f64 = 0.01;
/// Maximum electrical power of a luminaire. \[W\]
const MAX_POWER: f64 = 1e7;
/// Maximum length of a luminaire's opening. \[m\]
const MAX_SIZE: f64 = 1000.0;
/// Relative difference below which luminous fluxes, or ratios of them, differ only by angular steps and rounding.
/// Chosen: the zonal sum of narrow beams in steps of 5° is some percent off.
const SAME_FLUX: f64 = 0.1;
/// Difference of light output ratios that the rounding of small values explains.
const SMALL_RATIO: f64 = 0.01;
/// Maximum difference between two measurements of the same plane, relative to the largest intensity.
const SAME_PLANE: f64 = 0.02;
/// Difference of shares of the flux that rounding to whole percents and angular steps explain.
const SAME_SHARE: f64 = 0.05;
/// Minimum share of the lamps' flux that leaves a luminaire. Chosen: projectors with gobos give a tenth.
const MIN_OUTPUT: f64 = 0.1;
/// Maximum luminous flux per area of a luminaire's opening. Chosen: bare LED arrays give up to 1e8. \[lm/m²\]
const MAX_EXITANCE: f64 = 1e8;
/// Minimum luminous flux per area of an opening longer than [`LARGE`]. Chosen: daylight apertures with less are not
/// that large. \[lm/m²\]
const MIN_EXITANCE: f64 = 1.0;
/// Length from which an opening counts as unusually large for a luminaire. Chosen: no continuous row is one luminaire
/// of this length. \[m\]
const LARGE: f64 = 50.0;
/// Maximum step between two planes if others are closer together; the standards use 15° to 22.5°. \[°\]
const WIDE_STEP: f64 = 45.0;
/// Ratio of a step between planes to the other steps above which it is reported as a gap.
const WIDER: f64 = 1.5;

/// Photometric data that a file states beside the intensity table, with their lines.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Stated {
    /// Luminous flux of the lamps in operation in the luminaire; `None` if it is not stated. \[lm\]
    pub lamps: Option<f64>,
    /// Line number of the lamps' flux, from 1.
    pub lamps_line: usize,
    /// Light output ratio, flux of the luminaire over that of its lamps; `None` if it is not stated.
    pub output_ratio: Option<f64>,
    /// Downward share of the flux, 0 … 1, and its line number; `None` if it is not stated.
    pub downward: Option<(f64, usize)>,
    /// Line number of the sizes of the luminous opening, from 1.
    pub opening_line: usize,
    /// Whether the table is in candela per 1000 lm of the lamps.
    pub is_per_klm: bool,
}

/// Checks all numbers of a luminaire and adds findings about them. Slightly negative intensities, measurement noise,
/// are set to 0.
///
/// # Errors
/// Returns an error if an intensity, a flux, a size or an angle is impossible for a luminaire.
pub(super) fn checked(mut luminaire: Luminaire, stated: &Stated) -> Result<Luminaire, FormatError> {
    refuse_impossible(&luminaire)?;
    let below = luminaire.intensity.iter().filter(|cd| **cd < 0.0).count();
    if below > 0 {
        luminaire.intensity.iter_mut().for_each(|cd| *cd = cd.max(0.0));
        luminaire.findings.push(Finding::warning(
            "negative-intensities",
            format!("{below} intensities are a little below 0 cd, which no light is; they count as 0"),
        ));
    }
    let found = [
        gap_of_planes(&luminaire),
        gap_of_angles(&luminaire),
        flux_of_lamps(&luminaire, stated),
        downward_share(&luminaire, stated),
        size_for_flux(&luminaire, stated.opening_line),
    ];
    luminaire.findings.extend(found.into_iter().flatten());
    Ok(luminaire)
}

fn refuse_impossible(luminaire: &Luminaire) -> Result<(), FormatError> {
    let wrong = |what: &str, value: f64, unit: &str, (least, most): (f64, f64)| {
        let at = Location::file().in_element(what);
        Err(FormatError::new(at, format!("{value:e} {unit}"), format!("{least} to {most:e} {unit}")))
    };
    let peak = luminaire.peak();
    for (index, cd) in luminaire.intensity.iter().enumerate() {
        // Written so that what is no number fails too.
        if !(*cd >= -BELOW_ZERO * peak && *cd <= limits::INTENSITY) {
            let angles = luminaire.gamma_deg.len();
            let [c, gamma] = [luminaire.c_deg[index / angles], luminaire.gamma_deg[index % angles]];
            return wrong(&format!("intensity at C {c}°, gamma {gamma}°"), *cd, "cd", (0.0, limits::INTENSITY));
        }
    }
    let flux = luminaire.lamp_flux.unwrap_or(0.0);
    if !(0.0..=limits::LAMP_FLUX).contains(&flux) {
        return wrong("flux of the lamps", flux, "lm", (0.0, limits::LAMP_FLUX));
    }
    // Below 0 where it is not known.
    if luminaire.power.is_nan() || luminaire.power.abs() > MAX_POWER {
        return wrong("power", luminaire.power, "W", (0.0, MAX_POWER));
    }
    let Opening { along_c0, along_c90, height, .. } = luminaire.opening;
    for size in [along_c0, along_c90, height] {
        if !(0.0..=MAX_SIZE).contains(&size) {
            return wrong("size of the luminous opening", size, "m", (0.0, MAX_SIZE));
        }
    }
    for angle in luminaire.c_deg.iter().chain(&luminaire.gamma_deg) {
        if angle.is_nan() || angle.abs() > 360.0 {
            return wrong("angle", *angle, "°", (-360.0, 360.0));
        }
    }
    if luminaire.photometry == Photometry::C {
        // Beyond, zones and planes would count backwards; a plane at 360° is the first one again.
        let turn = 360.0 - CLOSEST;
        if let Some(c) = luminaire.c_deg.iter().find(|c| !(0.0..=turn).contains(*c)) {
            return wrong("plane C", *c, "°", (0.0, 360.0));
        }
        if let Some(gamma) = luminaire.gamma_deg.iter().find(|gamma| !(0.0..=180.0).contains(*gamma)) {
            return wrong("gamma angle", *gamma, "°", (0.0, 180.0));
        }
    }
    Ok(())
}

/// Returns a finding on a step between planes that is much wider than the others, so that the intensities within it are
/// uncertain.
fn gap_of_planes(luminaire: &Luminaire) -> Option<Finding> {
    let c = &luminaire.c_deg;
    if luminaire.photometry != Photometry::C || c.len() < 3 {
        return None;
    }
    let last = c.len() - 1;
    let next = |k: usize| if k < last { c[k + 1] } else { c[0] + 360.0 };
    let step = |k: usize| next(k) - c[k];
    let widest_below = |most: f64| (0..c.len()).map(step).filter(|one| *one < most - CLOSEST).fold(0.0, f64::max);
    let listed = (0..last).map(step).fold(0.0, f64::max);
    // Less is a gap where the list breaks off before the turn is full than within it, where mirror images repeat it.
    let (gap, others, is_gap) = if step(last) > WIDER * listed {
        (last, listed, true)
    } else {
        let widest = (0..c.len()).max_by(|&a, &b| step(a).total_cmp(&step(b)))?;
        let others = widest_below(step(widest));
        (widest, others, others > 0.0 && step(widest) > WIDE_STEP.max(WIDER * others))
    };
    is_gap.then(|| {
        Finding::warning(
            "planes-leave-gap",
            format!(
                "no plane between C {}° and C {}°: a gap of {}°, where other planes are at most {}° apart; intensities \
                 in it are interpolated over the gap",
                number(c[gap], 4),
                number(next(gap), 4),
                number(step(gap), 4),
                number(others, 4)
            ),
        )
    })
}

/// Returns a finding if the angles in the planes end where the formats do not allow it: light beyond may be missing in
/// the file.
fn gap_of_angles(luminaire: &Luminaire) -> Option<Finding> {
    let is_one_of = |angle: f64, allowed: &[f64]| allowed.iter().any(|one| same_angle(*one, angle));
    let ends = |angles: &[f64]| [angles[0], angles[angles.len() - 1]];
    let [first, last] = ends(&luminaire.gamma_deg);
    let angles = luminaire.gamma_deg.len();
    let edge = |k: usize| (0..luminaire.c_deg.len()).map(|plane| luminaire.plane(plane)[k]).fold(0.0, f64::max);
    let (name, [first, last], expected, light) = if luminaire.photometry == Photometry::C {
        if is_one_of(first, &[0.0, 90.0]) && is_one_of(last, &[90.0, 180.0]) {
            return None;
        }
        let dark_end = [is_one_of(first, &[0.0, 90.0]), is_one_of(last, &[90.0, 180.0])];
        let light = [(0, dark_end[0]), (angles - 1, dark_end[1])].map(|(k, ends)| if ends { 0.0 } else { edge(k) });
        ("gamma angles", [first, last], "0° or 90° to 90° or 180°", light[0].max(light[1]))
    } else {
        let whole =
            |[first, last]: [f64; 2]| is_one_of(first, &[-90.0, 0.0, -180.0]) && is_one_of(last, &[90.0, 180.0]);
        let across = ends(&luminaire.c_deg);
        let planes = luminaire.c_deg.len();
        let side = |k: usize| luminaire.plane(k).iter().copied().fold(0.0, f64::max);
        match (whole([first, last]), whole(across)) {
            (true, true) => return None,
            (false, _) => ("vertical angles", [first, last], "-90° or 0° to 90°", edge(0).max(edge(angles - 1))),
            (true, false) => ("horizontal angles", across, "-90° or 0° to 90°", side(0).max(side(planes - 1))),
        }
    };
    let message = format!(
        "{name} from {}° to {}° instead of {expected}; no light is counted beyond, where the table ends with up to {} cd",
        number(first, 4),
        number(last, 4),
        number(light, 2)
    );
    let code = "angles-leave-gap";
    Some(if light > 0.0 { Finding::warning(code, message) } else { Finding::info(code, message) })
}

/// Returns a finding if the flux of the table contradicts that of the lamps and the light output ratio.
fn flux_of_lamps(luminaire: &Luminaire, stated: &Stated) -> Option<Finding> {
    let lamps = stated.lamps.filter(|lamps| *lamps > 0.0)?;
    let flux = luminaire.flux();
    let ratio = flux / lamps;
    // Programs that do not know it write 0.
    let known = stated.output_ratio.filter(|ratio| *ratio > 0.0);
    let (fits, expected) = match known {
        Some(known) => {
            let difference = (ratio - known).abs();
            (difference <= SAME_FLUX * known || difference <= SMALL_RATIO, format!("where the file states {known:.2}"))
        }
        None if ratio > 1.0 => (ratio <= 1.0 + SAME_FLUX, "though lamps give no more than their flux".to_owned()),
        // A ratio of 0 that is stated may be one that was rounded.
        None => (ratio >= MIN_OUTPUT || stated.output_ratio.is_some(), "which is little".to_owned()),
    };
    // Candela in place of candela per 1000 lm make the flux wrong by the thousands of lumens.
    let scale = lamps / 1000.0;
    let meant = ratio / known.unwrap_or(1.0);
    let is_absolute = stated.is_per_klm && (meant / scale - 1.0).abs() <= SAME_FLUX;
    let why = if is_absolute { "; the table seems to hold candela, not candela per 1000 lm" } else { "" };
    (!fits).then(|| {
        let message = format!(
            "line {}: the table gives {} lm and the lamps {} lm: a light output ratio of {ratio:.2}, {expected}{why}",
            stated.lamps_line,
            number(flux, 1),
            number(lamps, 1)
        );
        Finding::warning("flux-contradicts-lamps", message)
    })
}

/// Returns a finding if the downward share of the table's flux contradicts the stated one.
fn downward_share(luminaire: &Luminaire, stated: &Stated) -> Option<Finding> {
    let (known, line) = stated.downward?;
    let flux = luminaire.flux();
    if luminaire.photometry != Photometry::C || flux <= 0.0 {
        return None;
    }
    let share = luminaire.flux_within(90.0) / flux;
    ((share - known).abs() > SAME_SHARE).then(|| {
        let message = format!(
            "line {line}: {} % of the flux of the table goes down, but the file states {} %",
            number(100.0 * share, 1),
            number(100.0 * known, 1)
        );
        Finding::warning("downward-share-contradicts", message)
    })
}

/// Returns a finding if the opening is far too small or too large for the flux, mostly because its sizes are in another
/// unit. `line`: line number of the sizes.
fn size_for_flux(luminaire: &Luminaire, line: usize) -> Option<Finding> {
    let (opening, flux) = (luminaire.opening, luminaire.flux());
    let area = opening.largest_face();
    // Without an area the luminaire is a point or a line, of which nothing follows.
    if area <= 0.0 || flux <= 0.0 {
        return None;
    }
    let exitance = flux / area;
    let Opening { along_c0, along_c90, height, .. } = opening;
    let too_large = exitance < MIN_EXITANCE && along_c0.max(along_c90).max(height) > LARGE;
    let why = if exitance > MAX_EXITANCE {
        "far too small"
    } else if too_large {
        "far too large"
    } else {
        return None;
    };
    let mm = |metres: f64| number(1000.0 * metres, 3);
    let message = format!(
        "line {line}: a luminous opening of {} mm x {} mm x {} mm (along C0, along C90, height) is {why} for {} lm: {exitance:.1e} \
         lm/m²; is the unit another one?",
        mm(along_c0),
        mm(along_c90),
        mm(height),
        number(flux, 1)
    );
    Some(Finding::warning("opening-contradicts-flux", message))
}

/// Returns a finding if the plane at 360° differs from that at 0°. `c_deg`: angles of the planes \[°\], `table`:
/// intensities, plane by plane.
pub(super) fn closing_plane(c_deg: &[f64], table: &[f64]) -> Option<Finding> {
    let (planes, angles) = (c_deg.len(), table.len() / c_deg.len());
    if planes < 2 || !same_angle(c_deg[planes - 1], c_deg[0] + 360.0) {
        return None;
    }
    let (first, last) = (&table[..angles], &table[table.len() - angles..]);
    let peak = table.iter().copied().fold(0.0, f64::max);
    let difference = first.iter().zip(last).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    (difference > SAME_PLANE * peak).then(|| {
        let message = format!(
            "the plane at C {}° is the one at C {}° again, but differs from it by up to {} % of the largest intensity; \
             the first one is used",
            number(c_deg[planes - 1], 4),
            number(c_deg[0], 4),
            number(100.0 * difference / peak, 1)
        );
        Finding::warning("turn-not-closed", message)
    })
}

/// Returns a finding on superfluous numbers at the end of a file. `found`: number of values found, `due`: number
/// required by the counts, `line`: line number of the first superfluous one, `words`: text that states the counts.
pub(super) fn surplus(found: usize, due: usize, line: usize, words: &str) -> Finding {
    let message = format!(
        "line {line}: {found} intensities where {due} are due ({words}); the {} after them are not used",
        found - due
    );
    Finding::warning("surplus-values", message)
}

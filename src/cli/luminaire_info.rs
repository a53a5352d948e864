//! `cfs info` for luminaire files (maker, flux, size, planes) and for an index of luminaire files (positions, aperture
//! that they form).

use super::output::Content;
use crate::compute::direction::Surface;
use crate::formats::luminaire::{Luminaire, Photometry};
use crate::study::files;
use crate::study::luminaires::{self, INDEX, LuminaireAperture};
use crate::texts::one_line;
use serde_json::json;
use std::fmt::Write as _;
use std::path::Path;

/// Maximum difference between intensities of mirror-image directions that counts as symmetric, relative to the largest
/// intensity.
const SAME: f64 = 1e-4;

/// Describes a luminaire file or an index of luminaire files; `None` for files of other extensions.
///
/// # Errors
/// Returns an error if the file cannot be read: one line with the file's name and the position in it.
pub(super) fn describe(path: &Path, as_json: bool) -> anyhow::Result<Option<Content>> {
    if files::name_with_extension(path)?.to_ascii_lowercase().ends_with(INDEX) {
        return index(path, as_json).map(Some);
    }
    let Some(luminaire) = luminaires::read_file(path)? else { return Ok(None) };
    Ok(Some(Content::of(as_json, || to_json(&luminaire), || to_text(&luminaire))))
}

/// Describes the apertures of an index: one, or one per member of a series.
fn index(path: &Path, as_json: bool) -> anyhow::Result<Content> {
    let rows = luminaires::read_rows(path)?;
    let names = luminaires::sets(&rows);
    let mut sets = Vec::with_capacity(names.len());
    for name in names {
        let own = rows.iter().filter(|row| row.set == name).cloned().collect();
        sets.push((luminaires::of_rows(path, own)?, name));
    }
    let to_json = || {
        let list: Vec<_> = sets.iter().map(|(one, name)| aperture_json(one, name)).collect();
        json!({"format": "index of luminaire files", "files": rows.len(), "apertures": list})
    };
    let to_text = || {
        let mut text = format!("{:<22}index of {} luminaire files\n", "Format", rows.len());
        sets.iter().for_each(|(one, name)| aperture_text(&mut text, one, name));
        text
    };
    Ok(Content::of(as_json, to_json, to_text))
}

/// Returns the luminous flux of the sunbeams that the files contain, and that of the undeviated direct sun left out of
/// them. \[lm\]
fn beams(one: &LuminaireAperture) -> [f64; 2] {
    // An empty sum is −0.
    let beam = one.rows.iter().map(|row| row.beam).sum::<f64>() + 0.0;
    [beam, one.rows.iter().filter_map(|row| row.separate_beam).map(|separate| separate.flux).sum::<f64>() + 0.0]
}

fn peak(one: &LuminaireAperture) -> f64 {
    one.files.iter().map(Luminaire::peak).fold(0.0, f64::max)
}

fn aperture_json(one: &LuminaireAperture, name: &str) -> serde_json::Value {
    let [beam, separate] = beams(one);
    let direction = one.rows.iter().find_map(|row| row.separate_beam);
    let files = one.rows.iter().zip(&one.files).map(|(row, file)| {
        json!({
            "file": row.file,
            "centre_m": row.centre.to_array(),
            "size_m": row.size,
            "flux_lm": file.flux(),
            "peak_cd": file.peak(),
            "format": file.format,
        })
    });
    json!({
        "set": name,
        "name": one.files.first().map(|file| file.text.name.clone()),
        "number": one.files.first().map(|file| file.text.number.clone()),
        "surface": match one.aperture.surface { Surface::Facade => "facade", Surface::Roof => "roof" },
        "corner_m": one.aperture.corner.to_array(),
        "size_m": one.aperture.size,
        "flux_lm": one.lamps.flux(),
        "beam_lm": beam,
        "beam_apart": direction.map(|row| json!({
            "flux_lm": separate,
            "direction": row.direction.to_array(),
            "normal_lx": row.normal,
        })),
        "files": files.collect::<Vec<_>>(),
    })
}

fn aperture_text(text: &mut String, one: &LuminaireAperture, name: &str) {
    text.push('\n');
    let mut line = |label: &str, value: &str| {
        if !value.is_empty() {
            let _ = writeln!(text, "{label:<22}{}", one_line(value));
        }
    };
    line("Set", name);
    line("Name", one.files.first().map_or("", |file| &file.text.name));
    line("Number", one.files.first().map_or("", |file| &file.text.number));
    line("Aperture", &luminaires::words(&one.aperture));
    let [width, height] = one.rows[0].size;
    line("Tiles", &format!("{}, the first of {width:.3} m x {height:.3} m", one.rows.len()));
    line("Flux", &format!("{:.1} lm", one.lamps.flux()));
    line("Largest intensity", &format!("{:.2} cd of one tile", peak(one)));
    let [beam, separate] = beams(one);
    line("Sunbeams in the files", &if beam > 0.0 { format!("{beam:.1} lm, widened") } else { "none".to_owned() });
    if let Some(row) = one.rows.iter().find_map(|row| row.separate_beam) {
        let d = row.direction;
        let way = format!("({:.4}, {:.4}, {:.4})", d.x, d.y, d.z);
        line(
            "Left to the host",
            &format!("direct sunlight of {separate:.1} lm along {way}, {:.1} lx perpendicular to it", row.normal),
        );
    }
}

const fn photometry(luminaire: &Luminaire) -> &'static str {
    match luminaire.photometry {
        Photometry::C => "C",
        Photometry::B => "B",
        Photometry::A => "A",
    }
}

/// Returns the luminous flux of the intensity table; `None` for a single plane of type A or B, which does not determine
/// it. \[lm\]
fn flux(luminaire: &Luminaire) -> Option<f64> {
    let is_known = luminaire.photometry == Photometry::C || luminaire.c_deg.len() > 1;
    is_known.then(|| luminaire.flux())
}

/// Returns the luminous opening as text: the diameter of a circle, else the shape and its sizes.
fn opening(luminaire: &Luminaire) -> String {
    let opening = luminaire.opening;
    if opening.is_circle() {
        return format!("round, diameter {:.3} m, {:.3} m high", opening.along_c0, opening.height);
    }
    format!(
        "{}, {:.3} m along C0, {:.3} m along C90, {:.3} m high",
        opening.shape.key(),
        opening.along_c0,
        opening.along_c90,
        opening.height
    )
}

/// Returns the symmetry of the intensity distribution as text, determined from the intensities, not from the file's
/// statement.
fn symmetry(luminaire: &Luminaire) -> &'static str {
    if luminaire.photometry != Photometry::C {
        return "not examined";
    }
    let tolerance = SAME * luminaire.peak();
    let same =
        |a: usize, b: usize| luminaire.plane(a).iter().zip(luminaire.plane(b)).all(|(x, y)| (x - y).abs() <= tolerance);
    let c = &luminaire.c_deg;
    if (1..c.len()).all(|k| same(0, k)) {
        return "rotational";
    }
    let mirrored = |axis: f64| {
        (0..c.len()).all(|k| {
            let image = (2.0 * axis - c[k]).rem_euclid(360.0);
            let twin = c.iter().position(|other| {
                let difference = (other - image).rem_euclid(360.0);
                difference.min(360.0 - difference) < 1e-3
            });
            twin.is_some_and(|twin| same(k, twin))
        })
    };
    match (mirrored(0.0), mirrored(90.0)) {
        (true, true) => "about C0-C180 and C90-C270",
        (true, false) => "about C0-C180",
        (false, true) => "about C90-C270",
        (false, false) => "none",
    }
}

fn to_json(luminaire: &Luminaire) -> serde_json::Value {
    let findings = luminaire
        .findings
        .iter()
        .map(|finding| json!({"severity": finding.severity.word(), "code": finding.code, "message": finding.message}));
    json!({
        "format": luminaire.format,
        "name": luminaire.text.name,
        "manufacturer": luminaire.text.manufacturer,
        "number": luminaire.text.number,
        "lamp": luminaire.text.lamp,
        "date": luminaire.text.date,
        "photometry": photometry(luminaire),
        "flux_lm": flux(luminaire),
        "lamp_flux_lm": luminaire.lamp_flux,
        "power_W": luminaire.power,
        "peak_cd": luminaire.peak(),
        "size_m": {
            "along_c0": luminaire.opening.along_c0,
            "along_c90": luminaire.opening.along_c90,
            "height": luminaire.opening.height,
        },
        "opening_shape": luminaire.opening.shape.key(),
        "symmetry": symmetry(luminaire),
        "planes": luminaire.c_deg.len(),
        "angles": luminaire.gamma_deg.len(),
        "c_deg": luminaire.c_deg,
        "gamma_deg": luminaire.gamma_deg,
        "findings": findings.collect::<Vec<_>>(),
    })
}

fn to_text(luminaire: &Luminaire) -> String {
    let mut text = String::new();
    let mut line = |label: &str, value: &str| {
        if !value.is_empty() {
            let _ = writeln!(text, "{label:<22}{}", one_line(value));
        }
    };
    let range = |angles: &[f64]| match angles {
        [] => String::new(),
        [one] => format!("{one}°"),
        [first, .., last] => format!("{first}…{last}°"),
    };
    line("Name", &luminaire.text.name);
    line("Manufacturer", &luminaire.text.manufacturer);
    line("Number", &luminaire.text.number);
    line("Lamp", &luminaire.text.lamp);
    line("Date", &luminaire.text.date);
    line("Format", &luminaire.format);
    line("Photometry", photometry(luminaire));
    line("Flux", &flux(luminaire).map(|flux| format!("{flux:.1} lm")).unwrap_or_default());
    let rated = luminaire.lamp_flux.map_or_else(|| "absolute photometry".to_owned(), |flux| format!("{flux:.1} lm"));
    line("Flux of the lamps", &rated);
    line("Largest intensity", &format!("{:.2} cd", luminaire.peak()));
    line("Luminous opening", &opening(luminaire));
    line("Symmetry", symmetry(luminaire));
    line("Planes", &format!("{} ({})", luminaire.c_deg.len(), range(&luminaire.c_deg)));
    line("Angles in a plane", &format!("{} ({})", luminaire.gamma_deg.len(), range(&luminaire.gamma_deg)));
    let _ = writeln!(text, "\nFindings");
    if luminaire.findings.is_empty() {
        let _ = writeln!(text, "  none");
    }
    for finding in &luminaire.findings {
        let _ = writeln!(text, "  {:<8} {:<22} {}", finding.severity.word(), finding.code, one_line(&finding.message));
    }
    text
}

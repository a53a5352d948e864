//! Summary of the luminaires that `cfs lid` has written, as JSON and as sentences.

use crate::compute::lid::c_gamma::Aim;
use crate::study::luminaire_series::Member;
use crate::study::luminaire_set::LuminaireSet;
use std::path::Path;

/// Returns the figures of the luminaires of an aperture as JSON. Apertures are numbered from 1; `out` is the path of
/// `--out`.
pub(super) fn summary(out: &Path, aperture: u32, set: &LuminaireSet, member: &Member) -> serde_json::Value {
    serde_json::json!({
        "out": out.to_string_lossy(),
        "set": member.name,
        "aperture": aperture,
        "flux_lm": set.flux.value,
        "flux_error_lm": set.flux.error,
        "peak_cd": set.peak,
        "scaled_by": set.scaled_by,
        "step_deg": set.step.degrees(),
        "aim": match set.aim { Aim::Mounted => "mounted", Aim::Down => "down" },
        // An empty sum is −0.
        "beam_lm": set.files.iter().map(|file| file.row.beam).sum::<f64>() + 0.0,
        "beam_apart": set.separate_beam.map(|beam| serde_json::json!({
            "flux_lm": beam.flux,
            "direction": beam.direction.to_array(),
            "normal_lx": beam.normal,
        })),
        "tiles": set.tiling.map(|tiling| serde_json::json!({ "columns": tiling.columns, "rows": tiling.rows })),
        "files": set.files.iter().map(|file| &file.row.file).collect::<Vec<_>>(),
        "index": set.tiling.map(|_| out.with_extension("index.csv").to_string_lossy().into_owned()),
        "reached": set.reached.map(|reached| serde_json::json!({
            "sum": reached.sum,
            "rms": reached.rms,
            "worst": reached.worst,
            "fields": reached.fields,
        })),
    })
}

/// Prints the figures of the luminaires as sentences; `without_beam`: whether the undeviated direct sun was to be left
/// out of the files.
pub(super) fn report(without_beam: bool, set: &LuminaireSet, member: &Member) {
    let of = if member.name.is_empty() { String::new() } else { format!("{}: ", member.name) };
    report!(
        "{of}{:.1} lm, peak {:.1} cd, step {}°, table scaled by {:+.3} %",
        set.flux.value,
        set.peak,
        set.step.degrees(),
        100.0 * (set.scaled_by - 1.0)
    );
    if let Some(tiling) = set.tiling {
        report!("{} × {} luminaires, one file each", tiling.columns, tiling.rows);
    }
    if let Some(beam) = set.separate_beam {
        report!(
            "left to the other program: direct sunlight, {:.1} lm, {:.1} lx on a plane perpendicular to it",
            beam.flux,
            beam.normal
        );
    } else if without_beam {
        report!("--without-beam: there is no direct sunlight to leave out");
    }
    if let Some(reached) = set.reached {
        let missed = if reached.holds() { "" } else { " More than 1 %: this light is too sharp for point luminaires." };
        report!("{}{missed}", reached.sentence());
    }
}

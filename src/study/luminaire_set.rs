//! Luminaire files of an aperture, which light a room in other programs as the aperture lights it: the aperture is
//! divided into tiles with a file each, the undeviated beam is left out if the host program computes direct sun itself,
//! and an index lists all positions.

use super::error::StudyError;
use super::luminaire_choice::{self, Probe, Reached};
use super::luminaire_file::{LidFormat, LuminaireFileError, bytes_of};
use super::luminaire_tiles::{Place, tables};
use super::scene::Scene;
use super::session::Session;
use crate::compute::direction::Surface;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::lid::SunBeam;
use crate::compute::lid::c_gamma::{Aim, Averaged, CGammaTable, Step};
use crate::compute::lid::tiling::{Tile, Tiling};
use crate::formats::luminaire::{Description, Luminaire};
use crate::formats::luminaire_index::{self, Row, SeparateBeam};
use glam::DVec3;
use rayon::prelude::*;
use std::path::Path;
use std::sync::Arc;

/// Division of an aperture into luminaires, one for each tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tiles {
    /// No division: one file for the aperture; beams are put on the four nodes of the table around their direction.
    None,
    /// Smallest number of tiles for which the error of a room lit by them is within [`luminaire_choice::TARGET`].
    Auto,
    /// Given number of columns and rows.
    Fixed(Tiling),
}

/// Maximum number of tiles along a side of the aperture.
const MOST: usize = 40;

impl std::str::FromStr for Tiles {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let count = |word: &str| word.parse::<usize>().ok().filter(|count| (1..=MOST).contains(count));
        match text {
            "none" => Ok(Self::None),
            "auto" => Ok(Self::Auto),
            _ => text
                .split_once(['x', '×'])
                .and_then(|(columns, rows)| Some(Tiling { columns: count(columns)?, rows: count(rows)? }))
                .map(Self::Fixed)
                .ok_or_else(|| {
                    format!("\"{text}\" is not a tiling (auto, none, or columns x rows from 1x1 to {MOST}x{MOST})")
                }),
        }
    }
}

impl std::fmt::Display for Tiles {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::None => f.write_str("none"),
            Self::Auto => f.write_str("auto"),
            Self::Fixed(Tiling { columns, rows }) => write!(f, "{columns}x{rows}"),
        }
    }
}

/// Options for making luminaire files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LuminaireOptions {
    /// Format of the files.
    pub format: LidFormat,
    /// Orientation of the luminaires (directions of C = 0 and γ = 0); `None`: that of the aperture.
    pub aim: Option<Aim>,
    /// Step of the tables in C and γ; `None`: chosen by the program.
    pub step: Option<Step>,
    /// Division of the aperture into tiles.
    pub tiles: Tiles,
    /// Whether the undeviated beam is left out, because the host program computes it.
    pub without_beam: bool,
}

/// Luminaire file of one tile, with its row in the index.
#[derive(Debug, Clone, PartialEq)]
pub struct TileFile {
    /// Content of the file.
    pub bytes: Vec<u8>,
    /// Row of the index for this file: position, size, orientation and flux.
    pub row: Row,
}

/// Luminaire files of an aperture, with their properties.
#[derive(Debug, Clone, PartialEq)]
pub struct LuminaireSet {
    /// Files, one per tile, row by row from the lower left as seen from outside.
    pub files: Vec<TileFile>,
    /// Division of the aperture into tiles; `None` if the aperture is one file.
    pub tiling: Option<Tiling>,
    /// Luminous flux of all files. \[lm\]
    pub flux: Estimate,
    /// Largest luminous intensity in any of the files. \[cd\]
    pub peak: f64,
    /// Factor by which the intensities of the first table were multiplied so that its zonal sum is the correct flux.
    pub scaled_by: f64,
    /// Orientation of the luminaires: directions of C = 0 and γ = 0 in the room.
    pub aim: Aim,
    /// Step of the tables in C and γ.
    pub step: Step,
    /// Undeviated beam of the whole aperture, if the files do not contain it; else `None`.
    pub separate_beam: Option<SeparateBeam>,
    /// Accuracy of a room that is lit by the files; `None` if it was not examined.
    pub reached: Option<Reached>,
}

impl LuminaireSet {
    /// Returns the content of the index of the files.
    pub fn index(&self) -> Vec<u8> {
        luminaire_index::write(&self.files.iter().map(|file| file.row.clone()).collect::<Vec<_>>())
    }
}

/// Makes the luminaire files of an aperture, counted from 0. `text`: header of the files; `name`: returns the file name
/// of a tile (`None`: of the whole aperture).
///
/// # Errors
/// Returns an error if cancelled, or if a table cannot be encoded.
pub fn make(
    session: &Session,
    scene: &Scene,
    aperture: usize,
    text: &Description,
    options: &LuminaireOptions,
    name: impl Fn(Option<usize>) -> String + Sync,
    progress: &dyn Progress,
) -> Result<LuminaireSet, SetError> {
    let mut lid = session.lid(scene, aperture, progress)?.lid;
    let corner = scene.apertures[aperture].aperture.corner;
    let place = Place { surface: lid.surface, corner, size: lid.size, room: scene.room.size };
    let straight: Vec<SunBeam> =
        lid.beams.iter().copied().filter(|beam| beam.straight && options.without_beam).collect();
    let area = lid.area();
    let separate_beam = separate_beam(&straight, place.surface, area);
    if options.without_beam {
        lid.beams.retain(|beam| !beam.straight);
    }
    let aim = options.aim.unwrap_or_else(|| Aim::of(lid.surface));
    let (tiling, step, reached, tables) = match options.tiles {
        Tiles::None => {
            let step = options.step.unwrap_or_else(|| Step::for_lid(&lid));
            let tile = Tiling::WHOLE.tiles(place.surface, place.corner, lid.size)[0];
            let averaged = Averaged::new(&lid, aim, step, progress).map_err(StudyError::from)?;
            (None, step, None, vec![(tile, Arc::new(averaged.table()))])
        }
        Tiles::Auto => {
            let probe = Probe::new(session, scene, aperture, options.without_beam, progress)?;
            let choice =
                luminaire_choice::choose(&lid, aim, options.step, place, &probe, progress).map_err(StudyError::from)?;
            (Some(choice.tiling), choice.step, Some(choice.reached), choice.tables)
        }
        Tiles::Fixed(tiling) => {
            let step = options.step.unwrap_or(Step::FINE);
            let averaged = Averaged::new(&lid, aim, step, progress).map_err(StudyError::from)?;
            let tables = tables(&averaged, tiling, place, true);
            let probe = Probe::new(session, scene, aperture, options.without_beam, progress)?;
            (Some(tiling), step, Some(probe.reached(place.surface, &tables)), tables)
        }
    };
    let count = tables.len();
    let scaled_by = tables.first().map_or(1.0, |(_, table)| table.scaled_by);
    let remarks = remarks(tiling, separate_beam.as_ref(), reached.as_ref());
    let one = |(k, (tile, table)): (usize, &(Tile, Arc<CGammaTable>))| -> Result<(TileFile, f64), LuminaireFileError> {
        let mut text = text.clone();
        if tiling.is_some() {
            text.report = format!("{}, tile {} of {count}", text.report, k + 1);
            let [x, y, z] = tile.centre.to_array();
            text.remarks
                .push(format!("Tile {} of {count}: centre x {x:.4} m, y {y:.4} m, z {z:.4} m in the room.", k + 1));
        }
        text.remarks.extend(remarks.iter().cloned());
        in_lines(&mut text, separate_beam.as_ref(), reached.as_ref());
        let luminaire = Luminaire::from_table(table, tile.size, text);
        let share = 1.0 / count as f64;
        let row = Row {
            file: name(tiling.map(|_| k)),
            centre: tile.centre,
            size: tile.size,
            flux: table.flux.value,
            beam: table.beam_flux,
            surface: Some(place.surface),
            aim: Some(aim),
            separate_beam: separate_beam.map(|beam| SeparateBeam { flux: share * beam.flux, ..beam }),
            set: String::new(),
        };
        Ok((TileFile { bytes: bytes_of(&luminaire, options.format)?, row }, luminaire.peak()))
    };
    let made = tables.par_iter().enumerate().map(|(k, table)| one((k, table))).collect::<Result<Vec<_>, _>>()?;
    let peak = made.iter().map(|(_, peak)| *peak).fold(0.0, f64::max);
    let files = made.into_iter().map(|(file, _)| file).collect();
    let flux = tables.iter().map(|(_, table)| table.flux).sum();
    Ok(LuminaireSet { files, tiling, flux, peak, scaled_by, aim, step, separate_beam, reached })
}

/// Returns the file name of a tile, derived from the path `out`; for the aperture as a whole that of `out`.
pub fn tile_name(out: &Path, tile: Option<usize>) -> String {
    let part = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let number = tile.map(|tile| format!("_{}", tile + 1)).unwrap_or_default();
    format!("{}{number}.{}", part(out.file_stem()), part(out.extension()))
}

/// Error when luminaire files are made.
#[derive(Debug, thiserror::Error)]
pub enum SetError {
    /// Scene whose light cannot be computed.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// File that cannot be encoded.
    #[error(transparent)]
    File(#[from] LuminaireFileError),
}

/// Returns the undeviated beams of an aperture as one beam; `None` if there are none. `area`: area of the aperture.
/// \[m²\]
fn separate_beam(beams: &[SunBeam], surface: Surface, area: f64) -> Option<SeparateBeam> {
    let flux: f64 = beams.iter().map(|beam| beam.flux).sum();
    let sum: DVec3 = beams.iter().map(|beam| beam.flux * beam.direction.0.vector()).sum();
    let own = sum.try_normalize().filter(|_| flux > 0.0)?;
    Some(SeparateBeam { flux, direction: surface.room_from_facade(own), normal: flux / (area * -own.z) })
}

/// Returns the remarks that the user of the host program needs, for the headers of the files.
fn remarks(tiling: Option<Tiling>, separate_beam: Option<&SeparateBeam>, reached: Option<&Reached>) -> Vec<String> {
    let mut list = Vec::new();
    if let Some(Tiling { columns, rows }) = tiling {
        list.push(format!(
            "One of {columns} x {rows} tiles of the aperture: place all of them at the centres that the index lists."
        ));
    }
    if let Some(SeparateBeam { flux, direction: d, normal }) = separate_beam {
        list.push(format!(
            "Without direct sunlight of {flux:.4} lm (whole aperture), which the other program computes. It \
             goes along ({:.6}, {:.6}, {:.6}) in room axes (x right seen from outside, y into the room, z up) and gives \
             {normal:.1} lx on a plane perpendicular to it.",
            d.x, d.y, d.z
        ));
    }
    list.extend(reached.map(Reached::sentence));
    list
}

/// Adds the remarks in short form to the header, as lines of 78 characters, because EULUMDAT has no field for remarks.
fn in_lines(text: &mut Description, separate_beam: Option<&SeparateBeam>, reached: Option<&Reached>) {
    if let Some(SeparateBeam { flux, direction: d, .. }) = separate_beam {
        let way = format!("{:.4} {:.4} {:.4}", d.x, d.y, d.z);
        text.manufacturer.push_str(&format!("; direct sun left out: {flux:.1} lm along {way}"));
    }
    if let Some(Reached { sum, rms, .. }) = reached {
        text.laboratory.push_str(&format!("; room: sum {:+.2} %, rms {:.2} %", 100.0 * sum, 100.0 * rms));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::{Dir, Emergent};

    #[test]
    fn tilings_are_words_or_two_numbers() {
        assert_eq!("auto".parse(), Ok(Tiles::Auto));
        assert_eq!("none".parse(), Ok(Tiles::None));
        assert_eq!("8x5".parse(), Ok(Tiles::Fixed(Tiling { columns: 8, rows: 5 })));
        for wrong in ["", "8", "0x3", "41x2", "8x-1", "axb", "1x2x3"] {
            assert!(wrong.parse::<Tiles>().is_err(), "{wrong}");
        }
        assert_eq!(Tiles::Fixed(Tiling { columns: 8, rows: 5 }).to_string(), "8x5");
    }

    #[test]
    fn the_beam_apart_is_told_with_flux_and_direction() {
        // Into the room, down and to the right: façade z is outward, y up.
        let direction = Emergent(Dir::new(DVec3::new(0.48, -0.6, -0.64)).unwrap());
        let beams = [SunBeam { direction, flux: 640.0, straight: true }];
        let told = separate_beam(&beams, Surface::Facade, 2.0).unwrap();
        assert!((told.direction - DVec3::new(0.48, 0.64, -0.6)).length() < 1e-12);
        assert!((told.normal - 640.0 / (2.0 * 0.64)).abs() < 1e-9);
        let text = remarks(None, Some(&told), None).join(" ");
        assert!(text.contains("640.0000 lm") && text.contains("(0.480000, 0.640000, -0.600000)"), "{text}");
        assert_eq!(separate_beam(&[], Surface::Facade, 2.0), None);
        let mut text = Description { manufacturer: "cfs 0.1.0".into(), ..Description::default() };
        let reached = Reached { sum: 0.001, rms: 0.0123, worst: -0.05, fields: 60 };
        in_lines(&mut text, Some(&told), Some(&reached));
        let line = &text.manufacturer;
        assert!(line.ends_with("left out: 640.0 lm along 0.4800 0.6400 -0.6000") && line.len() <= 78, "{line}");
        assert_eq!(text.laboratory, "; room: sum +0.10 %, rms 1.23 %");
    }
}

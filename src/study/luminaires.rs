//! Import of luminaire files that replace an aperture: an index and the files of its tiles, treated in the manner of a
//! host program.

use super::error::StudyError;
use super::files;
use super::system::System;
use crate::compute::btdf::Dataset;
use crate::compute::direction::Surface;
use crate::compute::lid::c_gamma::Aim;
use crate::compute::lid::tiling::Tile;
use crate::compute::lid::{Intensities, Lamp, Lamps};
use crate::compute::room::aperture::Aperture;
use crate::formats::LuminaireFormat;
use crate::formats::luminaire::{Luminaire, Photometry};
use crate::formats::luminaire_index::{self, Row};
use glam::DVec3;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;
use std::sync::Arc;

/// Tolerance of lengths, since EULUMDAT rounds to millimetres. \[m\]
const SAME_LENGTH: f64 = 2e-3;
/// Relative tolerance of the flux of a file, between its zonal sum and the index, which are rounded.
const SAME_FLUX: f64 = 0.01;
/// Maximum area that tiles may leave uncovered or cover twice, as a share of the aperture's area.
const SAME_AREA: f64 = 5e-3;

/// End of the file name of an index of luminaire files.
pub const INDEX: &str = ".index.csv";

/// Set of luminaires that together represent an aperture.
#[derive(Debug, Clone)]
pub struct LuminaireAperture {
    /// Rectangle that all tiles together fill: position and size of the aperture.
    pub aperture: Aperture,
    /// Rows of the index for the tiles, in its order.
    pub rows: Vec<Row>,
    /// Contents of the luminaire files, in the same order.
    pub files: Vec<Luminaire>,
    /// Luminaires with which a host program computes illuminances.
    pub lamps: Arc<Lamps>,
}

/// Reads a luminaire file in the format of its extension; `None` for files with other extensions.
///
/// # Errors
/// Returns an error if the file cannot be read.
pub fn read_file(path: &Path) -> Result<Option<Luminaire>, StudyError> {
    let Some(format) = LuminaireFormat::from_name(&files::name_with_extension(path)?) else { return Ok(None) };
    format.read(&files::read(path)?).map(Some).map_err(|error| wrong(path, error.to_string()))
}

/// Reads the rows of an index of luminaire files.
///
/// # Errors
/// Returns an error if the file cannot be read.
pub fn read_rows(path: &Path) -> Result<Vec<Row>, StudyError> {
    luminaire_index::read(&files::read(path)?).map_err(|error| wrong(path, error.to_string()))
}

/// Returns the names of the sets in an index in their order: one for each member of a series, a single empty name if
/// there is no series.
pub fn sets(rows: &[Row]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for row in rows {
        if !names.contains(&row.set) {
            names.push(row.set.clone());
        }
    }
    names
}

/// Reads an index and the luminaire files that it names. `set`: name of the member, if the index lists a series.
///
/// # Errors
/// Returns an error if a file cannot be read, contradicts the index or cannot be placed by a host program; if tiles
/// leave gaps, overlap or lie in several surfaces; if the member does not exist, or none is named of a series.
pub fn read(path: &Path, set: Option<&str>) -> Result<LuminaireAperture, StudyError> {
    let rows = read_rows(path)?;
    let names = sets(&rows);
    let list = || names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
    let chosen = match (set, names.as_slice()) {
        (None, [only]) => only.clone(),
        (None, _) => {
            return Err(wrong(
                path,
                format!("a series of {} sets; select one as set = \"…\"; it has {}", names.len(), list()),
            ));
        }
        (Some(set), names) if names.iter().any(|name| name == set) => set.to_owned(),
        (Some(set), _) => return Err(wrong(path, format!("no set \"{set}\"; it has {}", list()))),
    };
    of_rows(path, rows.into_iter().filter(|row| row.set == chosen).collect())
}

/// Reads the luminaire files of one set. `path`: path of the index; `rows`: its rows for the set.
///
/// # Errors
/// Returns the errors of [`read`].
pub fn of_rows(path: &Path, rows: Vec<Row>) -> Result<LuminaireAperture, StudyError> {
    let surface = rows[0].surface.unwrap_or_else(|| surface_of(&rows));
    if let Some(row) = rows.iter().find(|row| row.surface.is_some_and(|other| other != surface)) {
        return Err(wrong(
            path,
            format!("{} lies in another surface than {}: one aperture lies in one", row.file, rows[0].file),
        ));
    }
    let mut known: HashMap<String, (Luminaire, Arc<Intensities>)> = HashMap::new();
    let (mut list, mut files) = (Vec::with_capacity(rows.len()), Vec::with_capacity(rows.len()));
    for row in &rows {
        let file = path.with_file_name(&row.file);
        let (luminaire, table) = match known.entry(row.file.clone()) {
            Entry::Occupied(entry) => entry.into_mut(),
            Entry::Vacant(entry) => {
                let read = read_file(&file)?;
                let read = read.ok_or_else(|| wrong(&file, "no luminaire file: expected .ies or .ldt".to_owned()))?;
                let table = Arc::new(read.intensities());
                entry.insert((read, table))
            }
        };
        let aim = row.aim.unwrap_or_else(|| Aim::of(surface));
        check(&file, luminaire, row, aim)?;
        let tile = Tile { centre: row.centre, size: row.size };
        list.push(Lamp { tile, surface, aim, flux: luminaire.flux(), table: Arc::clone(table) });
        files.push(luminaire.clone());
    }
    let aperture = covered(&rows, surface).map_err(|message| wrong(path, message))?;
    let lamps = Arc::new(Lamps { list, area: aperture.area() });
    Ok(LuminaireAperture { aperture, rows, files, lamps })
}

/// Reads luminaires that replace an aperture of a scene. `path`: path of the index; `set`: name of the member of a
/// series.
///
/// # Errors
/// Returns the errors of [`read`], and an error if position or size differ from the aperture's.
pub fn in_place_of(aperture: &Aperture, path: &Path, set: Option<&str>) -> Result<Arc<Lamps>, StudyError> {
    let found = read(path, set).map_err(|error| StudyError::key("system.luminaires", error.to_string()))?;
    let own = found.aperture;
    let distance = (own.corner - aperture.corner).abs().max_element();
    let other_size = (0..2).any(|k| (own.size[k] - aperture.size[k]).abs() > SAME_LENGTH);
    if own.surface != aperture.surface || distance > SAME_LENGTH || other_size {
        return Err(StudyError::key(
            "system.luminaires",
            format!("{}: its tiles fill {}, not the aperture, {}", path.display(), words(&own), words(aperture)),
        ));
    }
    Ok(found.lamps)
}

/// Returns the system that stands in a scene for luminaire files. It has no BSDF data.
pub fn as_system(name: &Path) -> Arc<System> {
    let label = format!("luminaire files of {}", name.file_name().unwrap_or_default().to_string_lossy());
    let dataset = Dataset { name: label.clone(), ..Dataset::default() };
    Arc::new(System { label, state: String::new(), dataset: Arc::new(dataset), model: None })
}

fn wrong(path: &Path, message: String) -> StudyError {
    StudyError::File { path: path.to_owned(), message }
}

/// Formats position and size of an aperture, for messages.
pub fn words(aperture: &Aperture) -> String {
    let [x, y, z] = aperture.corner.to_array();
    let (surface, up) = match aperture.surface {
        Surface::Facade => ("the façade", ("z", z)),
        Surface::Roof => ("the roof", ("y", y)),
    };
    let [width, height] = aperture.size;
    format!(
        "x {x:.3} to {:.3} m, {} {:.3} to {:.3} m of {surface} at {}",
        x + width,
        up.0,
        up.1,
        up.1 + height,
        match aperture.surface {
            Surface::Facade => format!("y {y:.3} m"),
            Surface::Roof => format!("z {z:.3} m"),
        }
    )
}

/// Returns the surface (façade or roof) from the positions in the rows if the index does not name it: on a façade all
/// rows have y = 0.
fn surface_of(rows: &[Row]) -> Surface {
    if rows.iter().all(|row| row.centre.y.abs() < SAME_LENGTH) { Surface::Facade } else { Surface::Roof }
}

/// Checks that a luminaire file agrees with its row of the index.
fn check(path: &Path, luminaire: &Luminaire, row: &Row, aim: Aim) -> Result<(), StudyError> {
    if luminaire.photometry != Photometry::C {
        return Err(wrong(
            path,
            "photometric planes of type A or B, whose axis in the aperture is not defined; expected planes of type C"
                .to_owned(),
        ));
    }
    let flux = luminaire.flux();
    if (flux - row.flux).abs() > SAME_FLUX * flux.abs().max(row.flux.abs()) {
        return Err(wrong(path, format!("{flux:.4} lm, but the index says {:.4} lm", row.flux)));
    }
    let opening = luminaire.opening;
    // A side of zero length may be written as a small one.
    let size = match aim {
        Aim::Mounted => [opening.along_c90, opening.height],
        Aim::Down => [opening.along_c0, opening.along_c90],
    };
    if (0..2).any(|k| (size[k] - row.size[k]).abs() > SAME_LENGTH) {
        let [[a, b], [width, height]] = [size, row.size];
        return Err(wrong(
            path,
            format!("an opening of {a:.3} m x {b:.3} m, but the index says {width:.3} m x {height:.3} m"),
        ));
    }
    Ok(())
}

/// Returns the rectangle that the tiles of a set fill; an error message if they leave gaps or overlap.
fn covered(rows: &[Row], surface: Surface) -> Result<Aperture, String> {
    let (mut low, mut high, mut area) = (DVec3::INFINITY, DVec3::NEG_INFINITY, 0.0);
    for row in rows {
        let half = 0.5 * surface.room_from_facade(DVec3::new(row.size[0], row.size[1], 0.0)).abs();
        low = low.min(row.centre - half);
        high = high.max(row.centre + half);
        area += row.size[0] * row.size[1];
    }
    let extent = surface.facade_from_room(high - low);
    if extent.z.abs() > SAME_LENGTH {
        return Err(format!("tiles up to {:.3} m apart in depth: one aperture lies in one plane", extent.z.abs()));
    }
    let aperture = Aperture { surface, corner: low, size: [extent.x, extent.y] };
    let share = area / aperture.area();
    if (share - 1.0).abs() > SAME_AREA {
        return Err(format!(
            "its tiles have {:.1} % of the area of the rectangle around them ({}): they leave gaps or overlap",
            100.0 * share,
            words(&aperture)
        ));
    }
    Ok(aperture)
}

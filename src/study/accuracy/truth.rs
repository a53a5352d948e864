//! External reference: illuminances at the sensors of a scene from a file, measured or computed by another program.

use crate::compute::estimate::Estimate;
use crate::formats::decimal_comma::with_decimal_points;
use crate::formats::encoding::decode;
use crate::study::error::StudyError;
use crate::study::files;
use crate::study::scene::Scene;
use csv::{ReaderBuilder, StringRecord, Trim};
use std::path::Path;

/// Tolerance of a sensor's position \[m\] and of the components of its unit normal, since tables are rounded.
const SAME: f64 = 1e-4;

/// External reference: illuminances at a scene's sensors, in the order of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Truth {
    name: String,
    /// Total illuminances: direct and interreflected. \[lx\]
    total: Vec<Estimate>,
    /// Direct components, from the apertures without reflection in the room, if the file has them. \[lx\]
    direct: Option<Vec<f64>>,
}

/// Indices of the columns of the table.
struct Columns {
    position: [usize; 3],
    normal: Option<[usize; 3]>,
    total: usize,
    direct: Option<usize>,
    error: Option<usize>,
}

impl Truth {
    /// Reads a table with the columns of `cfs room`: x, y, z and E_lx; the columns nx, ny, nz, E_direct_lx and
    /// E_error_lx are optional. Lines that begin with # are skipped, and decimal commas are accepted.
    ///
    /// # Errors
    /// Returns an error that names the file, the line and the cause: a missing column, another number of sensors than
    /// the scene's, or another sensor.
    pub fn read(path: &Path, scene: &Scene) -> Result<Self, StudyError> {
        let wrong = |message: String| StudyError::File { path: path.to_owned(), message };
        let bytes = files::read(path)?;
        let text = decode(&bytes).map_err(|error| wrong(error.to_string()))?;
        let name = path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned());
        Self::parse(name, &with_decimal_points(&text), scene).map_err(wrong)
    }

    /// Reads the table from its text. `name`: name of the file for messages.
    fn parse(name: String, text: &str, scene: &Scene) -> Result<Self, String> {
        let mut reader = ReaderBuilder::new().comment(Some(b'#')).trim(Trim::All).from_reader(text.as_bytes());
        let header = reader.headers().map_err(|error| message(&error))?;
        let line = header.position().map_or(1, csv::Position::line);
        let columns = Columns::of(header).map_err(|message| format!("line {line}: {message}"))?;
        let count = scene.sensors.len();
        let (mut total, mut direct) = (Vec::with_capacity(count), columns.direct.map(|_| Vec::with_capacity(count)));
        for record in reader.records() {
            let record = record.map_err(|error| message(&error))?;
            let line = record.position().map_or(0, csv::Position::line);
            let at = |message: String| format!("line {line}: {message}");
            let Some(sensor) = scene.sensors.get(total.len()) else {
                return Err(at(format!("one sensor too many; expected the scene's {count}, in its order")));
            };
            let own = number_of(&record, columns.position).map_err(at)?;
            let places = [("position", Some((own, sensor.position.to_array())))];
            let normal = columns.normal.map(|normal| number_of(&record, normal)).transpose().map_err(at)?;
            let normals = [("normal", normal.map(|normal| (normal, sensor.normal.to_array())))];
            for (what, pair) in places.into_iter().chain(normals) {
                let Some((got, want)) = pair else { continue };
                if got.iter().zip(want).any(|(a, b)| (a - b).abs() > SAME) {
                    let index = total.len() + 1;
                    return Err(at(format!("{what} {got:?}; expected {want:?}, that of the scene's sensor {index}")));
                }
            }
            let light = |column: usize| light(&record, column).map_err(at);
            let error = columns.error.map_or(Ok(0.0), light)?;
            total.push(Estimate::new(light(columns.total)?, error));
            if let (Some(column), Some(direct)) = (columns.direct, &mut direct) {
                direct.push(light(column)?);
            }
        }
        if total.len() < count {
            let line = reader.position().line();
            return Err(format!(
                "line {line}: the table ends after {} sensors; expected {count}, the scene's",
                total.len()
            ));
        }
        if !total.iter().any(|e| e.value > 0.0) {
            return Err("no sensor has light; expected E_lx above 0 at some of them".to_owned());
        }
        Ok(Self { name, total, direct })
    }

    /// Returns the name of the file from which the reference was read.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the total illuminances at the sensors, with their uncertainty. \[lx\]
    pub(super) fn total(&self) -> Vec<Estimate> {
        self.total.clone()
    }

    /// Returns the direct components, if the file has them; their uncertainty is that of the total illuminances. \[lx\]
    pub(super) fn direct(&self) -> Option<Vec<Estimate>> {
        let direct = self.direct.as_ref()?;
        Some(direct.iter().zip(&self.total).map(|(&value, total)| Estimate::new(value, total.error)).collect())
    }

    /// Returns the reference of the chosen sensors only, given by their indices.
    pub(super) fn only(&self, chosen: &[usize]) -> Self {
        Self {
            name: self.name.clone(),
            total: chosen.iter().map(|&k| self.total[k]).collect(),
            direct: self.direct.as_ref().map(|direct| chosen.iter().map(|&k| direct[k]).collect()),
        }
    }
}

impl Columns {
    /// Finds the columns by their names in the header; returns a message about a missing one.
    fn of(header: &StringRecord) -> Result<Self, String> {
        let find = |name: &str| header.iter().position(|cell| cell == name);
        let need = |name: &str| {
            find(name).ok_or_else(|| format!("no column {name}; expected x,y,z,E_lx as `cfs room` writes them"))
        };
        let normal = match ["nx", "ny", "nz"].map(find) {
            [Some(x), Some(y), Some(z)] => Some([x, y, z]),
            _ => None,
        };
        Ok(Self {
            position: [need("x")?, need("y")?, need("z")?],
            normal,
            total: need("E_lx")?,
            direct: find("E_direct_lx"),
            error: find("E_error_lx"),
        })
    }
}

/// Returns the message of the table reader in one line.
fn message(error: &csv::Error) -> String {
    let line = error.position().map_or(1, csv::Position::line);
    match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("line {line}: {len} cells; expected {expected_len}, as many as in the header")
        }
        csv::ErrorKind::Utf8 { .. } => format!("line {line}: no text; expected UTF-8"),
        _ => format!("line {line}: not readable as a table; expected cells between commas"),
    }
}

fn number(record: &StringRecord, column: usize) -> Result<f64, String> {
    let cell = record.get(column).unwrap_or_default();
    let value: Option<f64> = cell.parse().ok();
    value.filter(|v| v.is_finite()).ok_or_else(|| format!("'{cell}' in column {}; expected a number", column + 1))
}

fn number_of(record: &StringRecord, columns: [usize; 3]) -> Result<[f64; 3], String> {
    let [x, y, z] = columns.map(|column| number(record, column));
    Ok([x?, y?, z?])
}

fn light(record: &StringRecord, column: usize) -> Result<f64, String> {
    let value = number(record, column)?;
    if value < 0.0 { Err(format!("{value} lx in column {}; expected 0 or more", column + 1)) } else { Ok(value) }
}

//! Reading of the compact binary format of datasets: every count is checked against the available bytes before memory
//! is allocated.

use super::{BlobError, FIRST, MAGIC, VERSION, join_planes};
use crate::compute::basis::{AzimuthMap, Ring, RingBasis};
use crate::compute::btdf::{
    AngularTransmittance, Band, Btdf, CellMatrix, Component, Dataset, Finding, Indicatrices, Scattered, TensorTree,
    Thermal, ThermalKey, TreeAxes, TreeNode, TreeRank,
};
use crate::compute::direction::{Dir, Incident};
use crate::compute::limits;
use crate::compute::wavelet::CompactRows;
use crate::formats::compact_rows::RowFile;
use glam::DVec3;
use std::collections::HashSet;
use std::io::Read;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Maximum number of values of one matrix, 16 million: four times the data of a goniophotometer with 1° resolution at
/// 145 incident directions.
const MOST_VALUES: usize = limits::VALUES;
/// Maximum number of incident directions of one function; they are compared pair by pair.
const MOST_DIRECTIONS: usize = limits::INCIDENCES;
/// Maximum number of cells of one basis.
const MOST_CELLS: usize = limits::CELLS;

/// Reads a dataset in the binary format. Malicious bytes give an error, never a panic or more memory than the limits of
/// this module.
pub fn decode(bytes: &[u8]) -> Result<Dataset, BlobError> {
    decode_within(bytes, &mut { limits::DECODED_BYTES })
}

/// Reads one of several datasets that share a memory budget: `left` is the remaining memory \[bytes\], checked before
/// it is allocated and reduced by what the dataset needs.
pub fn decode_within(bytes: &[u8], left: &mut u64) -> Result<Dataset, BlobError> {
    if !bytes.starts_with(MAGIC) {
        return Err(BlobError::Magic);
    }
    let mut input = Reader { bytes, at: MAGIC.len(), left };
    let version = input.byte()?;
    if !(FIRST..=VERSION).contains(&version) {
        return Err(BlobError::Version(version));
    }
    let mut dataset = Dataset {
        name: input.text()?,
        manufacturer: input.text()?,
        description: input.text()?,
        state: input.text()?,
        format: input.text()?,
        incident_basis: input.text()?,
        emergent_basis: input.text()?,
        ..Dataset::default()
    };
    if input.flag()? {
        dataset.thickness = Some(input.number()?);
    }
    dataset.visible = input.band()?;
    if input.flag()? {
        dataset.solar = Some(input.band()?);
    }
    dataset.derived = input.components()?;
    dataset.findings = input.findings()?;
    if version > FIRST {
        dataset.thermal = input.thermal()?;
    }
    if bytes.len() - input.at == size_of::<f64>() {
        let period = input.number()?;
        if period <= 0.0 {
            return input.invalid(format!("a structure of period {period} m"));
        }
        dataset.structure = Some(period);
    }
    match bytes.len() - input.at {
        0 => Ok(dataset),
        rest => Err(BlobError::Trailing(rest)),
    }
}

struct Reader<'a, 'b> {
    bytes: &'a [u8],
    at: usize,
    /// Remaining memory for values. \[bytes\]
    left: &'b mut u64,
}

impl<'a> Reader<'a, '_> {
    /// Subtracts the memory of `values` numbers from the remaining budget, or returns an error if it is exceeded.
    fn spend(&mut self, values: usize) -> Result<(), BlobError> {
        match self.left.checked_sub((values * size_of::<f64>()) as u64) {
            Some(left) => {
                *self.left = left;
                Ok(())
            }
            None => {
                let most = limits::DECODED_BYTES >> 20;
                self.invalid(format!("the values of all datasets of a file come to more than {most} MB"))
            }
        }
    }

    fn invalid<T>(&self, what: impl Into<String>) -> Result<T, BlobError> {
        Err(BlobError::Invalid { at: self.at, what: what.into() })
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], BlobError> {
        let end = self.at.checked_add(count).filter(|&end| end <= self.bytes.len());
        let end = end.ok_or(BlobError::Truncated(self.bytes.len()))?;
        let taken = &self.bytes[self.at..end];
        self.at = end;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], BlobError> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    fn byte(&mut self) -> Result<u8, BlobError> {
        Ok(self.array::<1>()?[0])
    }

    fn flag(&mut self) -> Result<bool, BlobError> {
        match self.byte()? {
            0 => Ok(false),
            1 => Ok(true),
            other => self.invalid(format!("{other} where 0 or 1 is expected")),
        }
    }

    /// Reads the number of items that follow, each at least `least` bytes long; an error if there are not enough bytes.
    fn count(&mut self, least: usize) -> Result<usize, BlobError> {
        let count = u32::from_le_bytes(self.array()?) as usize;
        if count.saturating_mul(least) > self.bytes.len() - self.at {
            return Err(BlobError::Truncated(self.bytes.len()));
        }
        Ok(count)
    }

    fn number(&mut self) -> Result<f64, BlobError> {
        let number = f64::from_le_bytes(self.array()?);
        if number.is_finite() { Ok(number) } else { self.invalid("a number that is not finite") }
    }

    fn text(&mut self) -> Result<String, BlobError> {
        let count = self.count(1)?;
        match std::str::from_utf8(self.take(count)?) {
            Ok(text) => Ok(text.to_owned()),
            Err(_) => self.invalid("text that is not UTF-8"),
        }
    }

    fn thermal(&mut self) -> Result<Thermal, BlobError> {
        let mut thermal = Thermal::default();
        thermal.device = self.text()?;
        for _ in 0..self.count(1 + size_of::<f64>())? {
            let (place, value) = (self.byte()?, self.number()?);
            let key = ThermalKey::ALL.get(usize::from(place)).copied();
            if !key.is_some_and(|key| thermal.set(key, value)) {
                return self.invalid(format!("thermal value {value} of kind {place}"));
            }
        }
        Ok(thermal)
    }

    fn components(&mut self) -> Result<Vec<Component>, BlobError> {
        let mask = self.byte()?;
        if mask > 0b1111 {
            return self.invalid("a function that is none of the four");
        }
        Ok(Component::ALL.into_iter().enumerate().filter(|(k, _)| mask >> k & 1 == 1).map(|(_, c)| c).collect())
    }

    fn band(&mut self) -> Result<Band, BlobError> {
        let mut band = Band::default();
        for component in self.components()? {
            let btdf = if self.flag()? {
                match &band.transmission_front {
                    Some(Btdf { regular, scattered: Some(Scattered::Cells(front)) }) => {
                        self.spend(front.incident().len() * front.emergent().len())?;
                        let scattered = Some(Scattered::Cells(Box::new(front.reversed())));
                        Btdf { regular: regular.clone(), scattered }
                    }
                    _ => return self.invalid("a function said to be the reciprocal of one that is not there"),
                }
            } else {
                self.btdf()?
            };
            band.set(component, btdf);
        }
        Ok(band)
    }

    fn btdf(&mut self) -> Result<Btdf, BlobError> {
        let regular = if self.flag()? { Some(self.angular()?) } else { None };
        let scattered = match self.byte()? {
            0 => None,
            1 => Some(Scattered::Lambert(self.angular()?)),
            2 => Some(Scattered::Cells(Box::new(self.cells()?))),
            3 => Some(Scattered::Tree(Box::new(self.tree()?))),
            4 => Some(Scattered::Directions(Arc::new(self.directions(false)?))),
            5 => Some(Scattered::Cells(Box::new(self.compact_cells()?))),
            6 => Some(Scattered::Directions(Arc::new(self.directions(true)?))),
            other => return self.invalid(format!("kind {other} of scattering, which this version does not know")),
        };
        Ok(Btdf { regular, scattered })
    }

    fn angular(&mut self) -> Result<AngularTransmittance, BlobError> {
        if !self.flag()? {
            let constant = self.number()?;
            return self.possible(vec![constant]).map(|_| AngularTransmittance::Constant(constant));
        }
        let count = self.count(8)?;
        if count < 2 {
            return self.invalid("a table over the angle of incidence with fewer than two values");
        }
        let table = (0..count).map(|_| self.number()).collect::<Result<_, _>>()?;
        self.possible(table).map(AngularTransmittance::Table)
    }

    fn basis(&mut self) -> Result<RingBasis, BlobError> {
        let name = self.text()?;
        let azimuth = AzimuthMap { sign: self.number()?, offset: self.number()? };
        if azimuth.sign.abs() != 1.0 {
            return self.invalid("a sense of azimuth that is neither 1 nor −1");
        }
        let count = self.count(28)?;
        let mut rings = Vec::with_capacity(count);
        let mut cells = 0_usize;
        for _ in 0..count {
            let (theta_min, theta_max) = (self.number()?, self.number()?);
            let sectors = self.count(0)?;
            cells = cells.saturating_add(sectors);
            rings.push(Ring { theta_min, theta_max, sectors, first_phi: self.number()? });
        }
        if cells > MOST_CELLS {
            return self.invalid(format!("a basis of {cells} cells (at most {MOST_CELLS})"));
        }
        RingBasis::new(name, rings, azimuth).or_else(|error| self.invalid(error.to_string()))
    }

    fn cells(&mut self) -> Result<CellMatrix, BlobError> {
        let (incident, emergent) = (self.basis()?, self.basis()?);
        let values = self.values(incident.len(), emergent.len())?;
        CellMatrix::of_single(incident, emergent, values)
            .map_or_else(|| self.invalid("values do not fit the cells"), Ok)
    }

    fn compact_cells(&mut self) -> Result<CellMatrix, BlobError> {
        let (incident, emergent) = (self.basis()?, self.basis()?);
        let rows = self.compact(incident.len(), emergent)?;
        CellMatrix::from_compact(incident, rows).map_or_else(|| self.invalid("rows do not fit the cells"), Ok)
    }

    /// Reads `count` indicatrices that are compressed by wavelets.
    fn compact(&mut self, count: usize, emergent: RingBasis) -> Result<Arc<CompactRows>, BlobError> {
        if count.saturating_mul(emergent.len()) > MOST_VALUES {
            return self.invalid(format!("{count} compact rows of {} cells (at most {MOST_VALUES})", emergent.len()));
        }
        let length = self.count(1)?;
        let bytes = self.take(length)?;
        let rows = RowFile::open(emergent, count, bytes).and_then(RowFile::into_rows);
        let rows = rows.or_else(|what| self.invalid(what))?;
        // Few bytes of an arithmetic coder may stand for many numbers.
        self.spend(rows.bytes_in_use().div_ceil(size_of::<f64>()))?;
        Ok(Arc::new(rows))
    }

    fn directions(&mut self, compact: bool) -> Result<Indicatrices, BlobError> {
        let count = self.count(24)?;
        if count > MOST_DIRECTIONS {
            return self.invalid(format!("{count} incident directions (at most {MOST_DIRECTIONS})"));
        }
        let incident = (0..count)
            .map(|_| {
                let v = DVec3::new(self.number()?, self.number()?, self.number()?);
                if (v.length() - 1.0).abs() > 1e-9 || v.z < -1e-9 {
                    return self.invalid("an incident direction that is not a unit vector of the outer hemisphere");
                }
                Ok(Incident(Dir::from_unit(v)))
            })
            .collect::<Result<Vec<_>, _>>()?;
        let emergent = self.basis()?;
        let data = if compact {
            let rows = self.compact(incident.len(), emergent)?;
            Indicatrices::from_compact(incident, rows)
        } else {
            let values = self.values(incident.len(), emergent.len())?;
            Indicatrices::of_single(incident, emergent, values)
        };
        data.map_or_else(|| self.invalid("values do not fit the directions, or two directions coincide"), Ok)
    }

    /// Reads `rows` × `columns` compressed values.
    fn values(&mut self, rows: usize, columns: usize) -> Result<Vec<f32>, BlobError> {
        let count = self.count(0)?;
        if count > MOST_VALUES || count != rows.saturating_mul(columns) {
            return self.invalid(format!("{count} values for {rows} × {columns} cells (at most {MOST_VALUES})"));
        }
        self.spend(count)?;
        let packed = self.count(1)?;
        let packed = self.take(packed)?;
        let values: Vec<f32> = join_planes(&self.unpack(packed, count * 4)?).collect();
        self.possible(values)
    }

    /// Returns the values, or an error if one is not a number or is too large for any function.
    fn possible<T: Copy + Into<f64>>(&self, values: Vec<T>) -> Result<Vec<T>, BlobError> {
        let mut all = values.iter().map(|value| (*value).into());
        match all.find(|value: &f64| value.is_nan() || value.abs() > limits::COEFFICIENT) {
            Some(value) => self.invalid(format!("a value of {value:e} (at most {:e})", limits::COEFFICIENT)),
            None => Ok(values),
        }
    }

    fn tree(&mut self) -> Result<TensorTree, BlobError> {
        let rank = match self.byte()? {
            3 => TreeRank::Three,
            4 => TreeRank::Four,
            other => return self.invalid(format!("a tree of rank {other}")),
        };
        let axes = if self.flag()? { TreeAxes::Back } else { TreeAxes::Front };
        let (count, branches) = (self.count(0)?, self.count(0)?);
        if count > MOST_VALUES || branches > count {
            return self
                .invalid(format!("a tree of {count} nodes, {branches} of them branches (at most {MOST_VALUES})"));
        }
        self.spend(2 * count)?;
        let packed = self.count(1)?;
        let packed = self.take(packed)?;
        let plain = self.unpack(packed, 5 * count)?;
        let (kinds, rest) = plain.split_at(count);
        let (firsts, leaves) = rest.split_at(4 * branches);
        if kinds.iter().filter(|kind| **kind != 0).count() != branches {
            return self.invalid("a tree that has not as many branches as it says");
        }
        let mut firsts = firsts.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        let mut leaves = self.possible(join_planes(leaves).map(f64::from).collect())?.into_iter();
        let nodes = kinds.iter().map_while(|kind| {
            if *kind == 0 { leaves.next().map(TreeNode::Leaf) } else { firsts.next().map(TreeNode::Branch) }
        });
        let nodes = nodes.collect();
        TensorTree::new(rank, axes, nodes).or_else(|error| self.invalid(error.to_string()))
    }

    /// Decompresses exactly `size` bytes; memory is allocated only for bytes that exist.
    fn unpack(&self, packed: &[u8], size: usize) -> Result<Vec<u8>, BlobError> {
        let mut plain = Vec::new();
        let read = zstd::stream::read::Decoder::new(packed)
            .and_then(|decoder| decoder.take(size as u64 + 1).read_to_end(&mut plain));
        match read {
            Ok(_) if plain.len() == size => Ok(plain),
            Ok(_) => self.invalid(format!("compressed values do not have {size} bytes")),
            Err(error) => self.invalid(format!("compressed values cannot be read: {error}")),
        }
    }

    fn findings(&mut self) -> Result<Vec<Finding>, BlobError> {
        let count = self.count(9)?;
        (0..count)
            .map(|_| {
                let severity = self.byte()?;
                let code = code(&self.text()?);
                let message = self.text()?;
                match severity {
                    0 => Ok(Finding::info(code, message)),
                    1 => Ok(Finding::warning(code, message)),
                    2 => Ok(Finding::error(code, message)),
                    other => self.invalid(format!("severity {other} of a finding")),
                }
            })
            .collect()
    }
}

/// Returns the code of a finding as a static string. Unknown codes are stored once each, up to a limited number.
fn code(text: &str) -> &'static str {
    const OTHER: &str = "other";
    static CODES: OnceLock<Mutex<HashSet<&'static str>>> = OnceLock::new();
    let kebab = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if text.is_empty() || text.len() > 64 || !text.chars().all(kebab) {
        return OTHER;
    }
    let mut codes = CODES.get_or_init(Mutex::default).lock().unwrap_or_else(PoisonError::into_inner);
    match codes.get(text) {
        Some(known) => known,
        None if codes.len() < 512 => {
            let kept: &'static str = Box::leak(text.to_owned().into_boxed_str());
            codes.insert(kept);
            kept
        }
        None => OTHER,
    }
}

//! LBNL BSDF XML (`WindowElement`), as WINDOW, genBSDF, Fener and makers write it.
//!
//! Read: matrices on Klems full, half (73 or 77 directions), quarter and any other list of rings; tensor trees of rank
//! 3 and 4; incident directions in columns or rows; the Visible and the Solar band; all four functions. "Front" is the
//! outside. Azimuths and squares are interpreted by [`crate::compute::basis::AzimuthMap::KLEMS_FRONT`] and
//! `KLEMS_BACK`, so that no values are reordered.
//!
//! Data that were computed from a description (`.system.toml`) are written with it, in a processing instruction that
//! other readers ignore (`beams`): the file conforms to the standard, with beams averaged over cells, and when this
//! program reads it again, the dataset has its [`described`](Dataset::described) and the key of its state. If the data
//! were changed since, or a newer version wrote the instruction, the description is ignored and the finding
//! `beams-not-restored` reports it.
//!
//! Not read: geometry (MGF), other bands and CIE X/Z or u′/v′ colour data, data of single layers and what they absorb
//! (findings report it), more than one `Layer` element, document type declarations. Nothing is repaired silently: see
//! the findings.

mod assess;
mod basis;
mod beams;
mod document;
mod layers;
mod material;
mod numbers;
mod write;
mod write_tree;

pub use write::write as write_matrices;
pub use write_tree::{TreeForm, rank_of, write_tree};

use crate::compute::basis::{AzimuthMap, RingBasis};
use crate::compute::btdf::{
    Band, BandName, Btdf, CellMatrix, Component, Dataset, Finding, Scattered, TensorTree, TreeAxes, TreeRank,
};
use crate::compute::limits;
use crate::formats::Written;
use crate::formats::location::{FormatError, Location, excerpt};
use basis::Bases;
use document::{Source, child, child_text, children, text};
use roxmltree::Node;

/// Returns a BSDF XML file of a dataset: with tensor trees if all its functions are trees of one rank
/// ([`write_tree()`]), otherwise with matrices ([`write_matrices`]).
///
/// # Errors
/// Returns an error if the dataset has no visible function.
pub fn write(dataset: &Dataset) -> Result<Written, FormatError> {
    match rank_of(dataset) {
        Some(rank) => write_tree(dataset, TreeForm::of_rank(rank)),
        None => write_matrices(dataset),
    }
}

/// Arrangement of the values in the data: matrices with incident directions in columns or rows, or tensor trees.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Structure {
    Columns,
    Rows,
    Tree(TreeRank),
}

/// Reads a BSDF XML file, which contains one dataset.
///
/// # Errors
/// Returns an error if the meaning of the numbers is ambiguous: broken or hostile XML, an unknown structure, direction
/// or basis, counts that do not fit, values that are not finite numbers, a block given twice, no Visible band, a
/// transmission far above 1.
pub fn read(bytes: &[u8]) -> Result<Dataset, FormatError> {
    let mut findings = Vec::new();
    let source = Source::new(bytes, &mut findings)?;
    let document = source.parse()?;
    let root = document.root_element();
    if !root.tag_name().name().eq_ignore_ascii_case("WindowElement") {
        return Err(FormatError::new(
            source.place(root),
            format!("root element <{}>", excerpt(root.tag_name().name())),
            "<WindowElement>, the root of a BSDF XML file",
        ));
    }
    let layer = layers::layer(&source, root, &mut findings)?;
    let of_system = layers::of_system(&source, layer, &mut findings)?;
    let definition = child(layer, "DataDefinition").or_else(|| child(root, "DataDefinition"));
    let structure = structure(&source, layer, definition)?;
    let bases = Bases::read(&source, definition, &mut findings)?;

    let mut dataset = Dataset { findings, ..Dataset::default() };
    material::describe(&mut dataset, root, layer);
    let without_side = layers::without_side(layer);
    let mut reader =
        Reader { source: &source, bases: &bases, structure, without_side, dataset: &mut dataset, found_visible: false };
    for data in of_system {
        reader.wavelength(data)?;
    }
    if !reader.found_visible {
        let held = if dataset.solar.is_some() { "only a Solar band" } else { "no Visible band" };
        return Err(FormatError::new(
            source.place(layer),
            held,
            "a WavelengthData element with <Wavelength>Visible</Wavelength>",
        ));
    }
    match beams::described(root) {
        Some(Ok(described)) => {
            dataset.state.clone_from(&described.state);
            dataset.described = Some(described);
        }
        Some(Err(finding)) => dataset.findings.push(finding),
        None => {}
    }
    dataset.report_partly_visible();
    assess::assess(&mut dataset)?;
    Ok(dataset)
}

fn structure(source: &Source, layer: Node<'_, '_>, definition: Option<Node<'_, '_>>) -> Result<Structure, FormatError> {
    let node = definition.and_then(|d| child(d, "IncidentDataStructure"));
    let word = node.map(text).unwrap_or_default();
    match word.to_ascii_lowercase().as_str() {
        "columns" => Ok(Structure::Columns),
        "rows" => Ok(Structure::Rows),
        "tensortree3" => Ok(Structure::Tree(TreeRank::Three)),
        "tensortree4" => Ok(Structure::Tree(TreeRank::Four)),
        _ => Err(FormatError::new(
            source.place(node.or(definition).unwrap_or(layer)),
            format!("IncidentDataStructure '{}'", excerpt(&word)),
            "Columns, Rows, TensorTree3 or TensorTree4",
        )),
    }
}

struct Reader<'r> {
    source: &'r Source,
    bases: &'r Bases,
    structure: Structure,
    without_side: Component,
    dataset: &'r mut Dataset,
    found_visible: bool,
}

impl Reader<'_> {
    fn wavelength(&mut self, data: Node<'_, '_>) -> Result<(), FormatError> {
        let word = child_text(data, "Wavelength");
        let band = match word.to_ascii_lowercase().as_str() {
            "visible" => BandName::Visible,
            "solar" => BandName::Solar,
            _ => {
                self.dataset.findings.push(Finding::info(
                    "band-not-read",
                    format!("Band '{}' is neither Visible nor Solar and was not read.", excerpt(&word)),
                ));
                return Ok(());
            }
        };
        self.found_visible |= band == BandName::Visible;
        for block in children(data, "WavelengthDataBlock").filter(|block| !layers::is_absorbed(*block)) {
            self.block(band, block)?;
        }
        Ok(())
    }

    fn block(&mut self, band: BandName, block: Node<'_, '_>) -> Result<(), FormatError> {
        let word = child_text(block, "WavelengthDataDirection");
        let words = layers::direction(block);
        let component = match words.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
            ["transmission"] => {
                self.report_without_side();
                self.without_side
            }
            ["transmission", "front"] => Component::TransmissionFront,
            ["transmission", "back"] => Component::TransmissionBack,
            ["reflection", "front"] => Component::ReflectionFront,
            ["reflection", "back"] => Component::ReflectionBack,
            _ => {
                return Err(FormatError::new(
                    self.source.place(child(block, "WavelengthDataDirection").unwrap_or(block)),
                    format!("unknown WavelengthDataDirection '{}'", excerpt(&word)),
                    "Transmission Front, Transmission Back, Reflection Front or Reflection Back",
                ));
            }
        };
        let title = format!("{} ({})", excerpt(&word), band.word());
        let place = match band {
            BandName::Visible => &self.dataset.visible,
            BandName::Solar => self.dataset.solar.get_or_insert_with(Band::default),
        };
        if place.get(component).is_some() {
            return Err(FormatError::new(
                self.source.place(block),
                format!("duplicate block {title}"),
                "every direction once in a band",
            ));
        }
        let data = child(block, "ScatteringData").ok_or_else(|| {
            FormatError::new(self.source.place(block), format!("{title} without ScatteringData"), "numbers")
        })?;
        let at = self.source.place(data);
        let at = Location { element: Some(format!("<ScatteringData> of {title}")), ..at };
        let outside = component.is_front();
        let btdf = match self.structure {
            Structure::Tree(rank) => self.tree(rank, outside, block, &text(data), &title, &at)?,
            Structure::Columns | Structure::Rows => self.matrix(outside, block, &text(data), &title, &at)?,
        };
        match band {
            BandName::Visible => self.dataset.visible.set(component, btdf),
            BandName::Solar => self.dataset.solar.get_or_insert_with(Band::default).set(component, btdf),
        }
        Ok(())
    }

    fn tree(
        &mut self,
        rank: TreeRank,
        outside: bool,
        block: Node<'_, '_>,
        text: &str,
        title: &str,
        at: &Location,
    ) -> Result<Btdf, FormatError> {
        let name = child_text(block, "AngleBasis");
        if !name.is_empty() && !name.eq_ignore_ascii_case("LBNL/Shirley-Chiu") {
            return Err(FormatError::new(
                at.clone(),
                format!("angle basis '{}' for a tensor tree", excerpt(&name)),
                "LBNL/Shirley-Chiu",
            ));
        }
        let parsed = numbers::parse_tree(text, rank, at)?;
        self.report_negative(parsed.negative, title);
        let axes = if outside { TreeAxes::Front } else { TreeAxes::Back };
        let tree = TensorTree::new(rank, axes, parsed.nodes)
            .map_err(|error| FormatError::new(at.clone(), error.to_string(), "a tensor tree"))?;
        self.dataset.format = format!("bsdf-xml tensor-tree rank {}", rank.dimensions());
        self.dataset.incident_basis = "LBNL/Shirley-Chiu".into();
        self.dataset.emergent_basis = "LBNL/Shirley-Chiu".into();
        Ok(Btdf { regular: None, scattered: Some(Scattered::Tree(Box::new(tree))) })
    }

    fn matrix(
        &mut self,
        outside: bool,
        block: Node<'_, '_>,
        text: &str,
        title: &str,
        at: &Location,
    ) -> Result<Btdf, FormatError> {
        let columns = self.bases.get(&child_text(block, "ColumnAngleBasis"), self.source.place(block))?;
        let rows = self.bases.get(&child_text(block, "RowAngleBasis"), self.source.place(block))?;
        let (n_rows, n_columns) = (rows.len(), columns.len());
        // A sample of a few numbers is filled up to them all.
        if n_rows * n_columns > limits::VALUES {
            return Err(FormatError::new(
                at.clone(),
                format!("a matrix of {n_rows} rows × {n_columns} columns"),
                format!("at most {} values", limits::VALUES),
            ));
        }
        let mut values = numbers::parse_list(text, n_rows * n_columns, at)?;
        if values.len() != n_rows * n_columns {
            values = self.fit(&values, &rows, &columns, text, title, at)?;
        }
        let incident_in_rows = self.structure == Structure::Rows;
        let (incident, emergent) = if incident_in_rows { (rows, columns) } else { (columns, rows) };
        if !incident_in_rows {
            // From one emergent direction after the other to one incident direction after the other.
            let transposed = (0..values.len()).map(|k| values[(k % n_rows) * n_columns + k / n_rows]);
            values = transposed.collect();
        }
        let weight = emergent.projected_solid_angles();
        let mut negative = (0, 0.0_f64);
        for indicatrix in values.chunks_exact_mut(weight.len()) {
            let lost: f64 = indicatrix.iter().zip(&weight).map(|(q, w)| q.min(0.0) * w).sum();
            if lost < -0.01 {
                return Err(FormatError::new(
                    at.clone(),
                    format!("negative values that take {:.1} % of one incident direction's light", -100.0 * lost),
                    "values of 0 or more (small negative ones are set to 0)",
                ));
            }
            for q in indicatrix.iter_mut().filter(|q| **q < 0.0) {
                negative = (negative.0 + 1, negative.1.min(*q));
                *q = 0.0;
            }
        }
        self.report_negative(negative, title);
        let map = if outside { AzimuthMap::KLEMS_FRONT } else { AzimuthMap::KLEMS_BACK };
        self.dataset.format = "bsdf-xml klems".into();
        self.dataset.incident_basis = incident.name().to_owned();
        self.dataset.emergent_basis = emergent.name().to_owned();
        let matrix = CellMatrix::new(incident.with_azimuth(map), emergent.with_azimuth(map), values)
            .expect("the count was compared with the bases");
        Ok(Btdf::from_cells(matrix))
    }

    /// Returns values for a block whose count differs from that of its bases, if the file is a sample with the first
    /// directions only; otherwise an error.
    fn fit(
        &mut self,
        values: &[f64],
        rows: &RingBasis,
        columns: &RingBasis,
        text: &str,
        title: &str,
        at: &Location,
    ) -> Result<Vec<f64>, FormatError> {
        let expected = rows.len() * columns.len();
        let side = values.len().isqrt();
        // Parser samples hold the corner of a matrix. Nothing between that and the full matrix is plausible.
        if side >= 1 && side * side == values.len() && side <= 16 && 2 * side < rows.len().min(columns.len()) {
            self.dataset.findings.push(Finding::error(
                "incomplete-matrix",
                format!(
                    "{title} holds {side} × {side} of {} × {} values; all other directions are taken as 0.",
                    rows.len(),
                    columns.len()
                ),
            ));
            let mut full = vec![0.0; expected];
            for row in 0..side {
                full[row * columns.len()..][..side].copy_from_slice(&values[row * side..][..side]);
            }
            return Ok(full);
        }
        let commas = text.bytes().filter(|byte| *byte == b',').count();
        let hint = if 2 * values.len() > 3 * expected && commas * 2 + 8 >= values.len() {
            " (decimal commas suspected: a comma separates numbers)"
        } else {
            ""
        };
        Err(FormatError::new(
            at.clone(),
            format!("{} numbers{hint}", values.len()),
            format!("{expected} numbers, {} rows × {} columns", rows.len(), columns.len()),
        ))
    }

    fn report_without_side(&mut self) {
        self.dataset.findings.push(Finding::info(
            "side-not-told",
            format!(
                "Transmission without a side, as genBSDF wrote until 2012, is that of both sides: it is read as {}.",
                self.without_side.words()
            ),
        ));
    }

    fn report_negative(&mut self, (count, least): (usize, f64), title: &str) {
        if count > 0 {
            self.dataset.findings.push(Finding::warning(
                "negative-values",
                format!("{count} negative values in {title} (down to {least:.3e} 1/sr) were set to 0."),
            ));
        }
    }
}

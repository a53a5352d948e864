//! Writing of BSDF XML as matrices: on the rings of the dataset where the format allows, otherwise on the Klems full
//! basis.
//!
//! A file has one angle basis for all its blocks, azimuths counted as in Klems files on the block's side, the first
//! sector of every ring centred on 0. Functions on other cells are averaged over those cells (flux is conserved);
//! tensor trees are sampled cell by cell from their finest grid; regular transmission becomes the diagonal of its
//! matrix, τ/PΩ in every cell. The Geometry element is empty.
//!
//! Elements, their order and their words are those of LBNL's schema (BSDF-v1.7.5.xsd), so that WINDOW imports the file:
//! both bands where there are two, each with its spectra; reflection under the data type "BTDF", the only one that the
//! schema has; thermal data as the source gave them, else as defaults that are named as such ([`super::material`]).

use super::beams;
use super::document::escaped;
use super::material;
use crate::compute::basis::{AzimuthMap, RingBasis};
use crate::compute::btdf::{Band, Dataset, Finding, Scattered, matrix_on};
use crate::formats::Written;
use crate::formats::location::{FormatError, Location};
use std::fmt::Write as _;

/// Returns a BSDF XML file of a dataset, with matrices. Functions that were derived by reciprocity when the dataset was
/// read are written like the others.
///
/// # Errors
/// Returns an error if the dataset has no visible function.
pub fn write(dataset: &Dataset) -> Result<Written, FormatError> {
    if dataset.visible.components().is_empty() {
        return Err(FormatError::new(Location::file(), "a dataset without visible functions", "at least one to write"));
    }
    let basis = common_basis(dataset);
    let mut xml = String::new();
    let defaults = head(&mut xml, dataset, &basis);
    band(&mut xml, &dataset.visible, "Visible", &basis);
    if let Some(solar) = &dataset.solar {
        band(&mut xml, solar, "Solar", &basis);
    }
    xml.push_str("\t\t</Layer>\n\t</Optical>\n</WindowElement>\n");
    Ok(Written { bytes: beams::added(xml, dataset).into_bytes(), findings: changes(dataset, &basis, defaults) })
}

/// Returns findings on differences between the written file and the dataset, after the `findings` of the file's head.
fn changes(dataset: &Dataset, basis: &RingBasis, mut findings: Vec<Finding>) -> Vec<Finding> {
    let mut report = |code, text: String| findings.push(Finding::info(code, text));
    for component in dataset.visible.components() {
        let Some(btdf) = dataset.visible.get(component) else { continue };
        let name = component.key().replace('_', " ");
        let from = match &btdf.scattered {
            Some(Scattered::Tree(_)) => Some("tensor tree"),
            Some(Scattered::Lambert(_)) => Some("diffuse function"),
            Some(Scattered::Directions(_)) => Some("list of single incident directions"),
            Some(Scattered::Cells(matrix)) if matrix.incident().rings() != basis.rings() => {
                Some("matrix on other cells")
            }
            Some(Scattered::Cells(matrix)) if matrix.emergent().rings() != basis.rings() => {
                Some("matrix on other cells")
            }
            Some(Scattered::Cells(_)) | None => None,
        };
        if let Some(from) = from {
            report("resampled", format!("{name}: a {from}, averaged over the cells of {}.", basis.name()));
        }
        if btdf.regular.is_some() {
            report("regular-in-cells", format!("{name}: regular transmission now fills its own cell."));
        }
        if dataset.derived.contains(&component) {
            report("derived-written", format!("{name}: derived, written like a block of the source."));
        }
    }
    if dataset.solar.is_none() {
        report(
            "window-solar",
            "There is no solar band; WINDOW needs one for heat gains, and none is invented.".to_owned(),
        );
    }
    if !dataset.state.is_empty() && !beams::describes_state(dataset) {
        report("state-not-written", format!("The state key '{}' has no place in the format.", dataset.state));
    }
    findings
}

/// Returns the basis for all blocks: the rings of the dataset where the format can express them, else Klems full.
fn common_basis(dataset: &Dataset) -> RingBasis {
    let own = dataset.visible.components().into_iter().find_map(|component| {
        let Some(Scattered::Cells(matrix)) = &dataset.visible.get(component)?.scattered else { return None };
        let (a, b) = (matrix.incident(), matrix.emergent());
        let rings = a.rings();
        let complete = rings.windows(2).all(|w| (w[0].theta_max - w[1].theta_min).abs() < 1e-9)
            && rings.first().is_some_and(|ring| ring.theta_min == 0.0)
            && rings.last().is_some_and(|ring| (ring.theta_max - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
        let klems_like = matches!(a.azimuth(), AzimuthMap::KLEMS_FRONT | AzimuthMap::KLEMS_BACK);
        let writable =
            klems_like && complete && rings.iter().all(|ring| ring.first_phi == 0.0) && a.rings() == b.rings();
        writable.then(|| a.clone())
    });
    own.unwrap_or_else(|| RingBasis::klems_full(AzimuthMap::KLEMS_FRONT))
}

/// Writes the first lines, which all files have in common.
pub(super) fn opening(xml: &mut String, dataset: &Dataset) {
    xml.push_str("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    xml.push_str(
        "<WindowElement xmlns=\"http://windows.lbl.gov\" xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" ",
    );
    xml.push_str("xsi:schemaLocation=\"http://windows.lbl.gov/BSDF-v1.4.xsd\">\n");
    if !dataset.description.is_empty() {
        let _ = writeln!(xml, "<!-- {} -->", dataset.description.replace("--", "- -").trim_end_matches('-'));
    }
    xml.push_str(
        "\t<WindowElementType>System</WindowElementType>\n\t<FileType>BSDF</FileType>\n\t<Optical>\n\t\t<Layer>\n",
    );
}

/// Writes everything before the data of the bands. Returns findings on the defaults used.
fn head(xml: &mut String, dataset: &Dataset, basis: &RingBasis) -> Vec<Finding> {
    opening(xml, dataset);
    let findings = material::write(xml, dataset, true);
    xml.push_str("\t\t\t<Geometry></Geometry>\n");
    xml.push_str("\t\t\t<DataDefinition>\n\t\t\t\t<IncidentDataStructure>Columns</IncidentDataStructure>\n");
    let _ = writeln!(xml, "\t\t\t\t<AngleBasis>\n\t\t\t\t\t<AngleBasisName>{}</AngleBasisName>", escaped(basis.name()));
    for ring in basis.rings() {
        let (low, high) = (degrees(ring.theta_min), degrees(ring.theta_max));
        let middle = if ring.theta_min == 0.0 { 0.0 } else { 0.5 * (low + high) };
        let _ = writeln!(
            xml,
            "\t\t\t\t\t<AngleBasisBlock>\n\t\t\t\t\t\t<Theta>{middle}</Theta>\n\t\t\t\t\t\t<nPhis>{}</nPhis>\n\
             \t\t\t\t\t\t<ThetaBounds>\n\t\t\t\t\t\t\t<LowerTheta>{low}</LowerTheta>\n\
             \t\t\t\t\t\t\t<UpperTheta>{high}</UpperTheta>\n\t\t\t\t\t\t</ThetaBounds>\n\t\t\t\t\t</AngleBasisBlock>",
            ring.sectors
        );
    }
    xml.push_str("\t\t\t\t</AngleBasis>\n\t\t\t</DataDefinition>\n");
    findings
}

/// Returns an angle given in radians in degrees, rounded so that no conversion error shows.
fn degrees(radians: f64) -> f64 {
    (radians.to_degrees() * 1e9).round() / 1e9
}

fn band(xml: &mut String, band: &Band, name: &str, basis: &RingBasis) {
    // What WINDOW takes for the band when nothing else is said.
    let spectra = if name == "Visible" {
        "\t\t\t\t<SourceSpectrum>CIE Illuminant D65 1nm.ssp</SourceSpectrum>\n\t\t\t\t<DetectorSpectrum>ASTM E308 1931 \
         Y.dsp</DetectorSpectrum>\n"
    } else {
        "\t\t\t\t<SourceSpectrum>ASTM E891 Table 1 Direct AM1_5.ssp</SourceSpectrum>\n\t\t\t\t<DetectorSpectrum>None\
         </DetectorSpectrum>\n"
    };
    for component in band.components() {
        let Some(btdf) = band.get(component) else { continue };
        let map = if component.is_front() { AzimuthMap::KLEMS_FRONT } else { AzimuthMap::KLEMS_BACK };
        let basis_of_side = basis.clone().with_azimuth(map);
        let matrix = matrix_on(btdf, &basis_of_side, &basis_of_side);
        let basis_name = escaped(basis.name());
        let _ = write!(
            xml,
            "\t\t\t<WavelengthData>\n\t\t\t\t<LayerNumber>System</LayerNumber>\n\
             \t\t\t\t<Wavelength unit=\"Integral\">{name}</Wavelength>\n{spectra}\t\t\t\t<WavelengthDataBlock>\n\
             \t\t\t\t\t<WavelengthDataDirection>{}</WavelengthDataDirection>\n\
             \t\t\t\t\t<ColumnAngleBasis>{basis_name}</ColumnAngleBasis>\n\
             \t\t\t\t\t<RowAngleBasis>{basis_name}</RowAngleBasis>\n\
             \t\t\t\t\t<ScatteringDataType>BTDF</ScatteringDataType>\n\t\t\t\t\t<ScatteringData>\n",
            component.words()
        );
        let n = basis.len();
        let values = matrix.values();
        for o in 0..n {
            for i in 0..n {
                let q = values[i * n + o];
                let _ = if q == 0.0 { write!(xml, "0,\t") } else { write!(xml, "{q:.9e},\t") };
            }
            xml.push('\n');
        }
        xml.push_str("\t\t\t\t\t</ScatteringData>\n\t\t\t\t</WavelengthDataBlock>\n\t\t\t</WavelengthData>\n");
    }
}

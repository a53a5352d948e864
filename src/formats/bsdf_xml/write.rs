//! Writing BSDF XML: matrices on rings as they are, everything else on Klems' full basis.
//!
//! A file has one angle basis for all its blocks, azimuths counted Klems' way on the block's side, the first sector of
//! every ring centred on 0. Functions on other cells are averaged over those cells (flux kept); tensor trees are
//! sampled cell by cell from their finest grid; light that goes straight on becomes the diagonal of its matrix,
//! τ/PΩ in every cell. The Geometry element is empty.

use crate::compute::basis::{AzimuthMap, Resampling, RingBasis, SquareGrid, resample_matrix};
use crate::compute::btdf::{Band, Btdf, CellMatrix, Component, Dataset, Finding, Scattered, TensorTree};
use crate::formats::Written;
use crate::formats::location::{FormatError, Location};
use std::fmt::Write as _;

/// One dataset as a file. Blocks that were derived when it was read are written like the others.
///
/// # Errors
/// A dataset without any visible function.
pub fn write(dataset: &Dataset) -> Result<Written, FormatError> {
    if dataset.visible.components().is_empty() {
        return Err(FormatError::new(Location::file(), "a dataset without visible functions", "at least one to write"));
    }
    let basis = common_basis(dataset);
    let mut xml = String::new();
    head(&mut xml, dataset, &basis);
    band(&mut xml, &dataset.visible, "Visible", &basis);
    if let Some(solar) = &dataset.solar {
        band(&mut xml, solar, "Solar", &basis);
    }
    xml.push_str("\t\t</Layer>\n\t</Optical>\n</WindowElement>\n");
    Ok(Written { bytes: xml.into_bytes(), findings: changes(dataset, &basis) })
}

fn changes(dataset: &Dataset, basis: &RingBasis) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut tell = |code, text: String| findings.push(Finding::info(code, text));
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
            tell("resampled", format!("{name}: a {from}, averaged over the cells of {}.", basis.name()));
        }
        if btdf.regular.is_some() {
            tell("regular-in-cells", format!("{name}: light that goes straight on now fills its own cell."));
        }
        if dataset.derived.contains(&component) {
            tell("derived-written", format!("{name}: derived, written like a block of the source."));
        }
    }
    if !dataset.state.is_empty() {
        tell("state-not-written", format!("The state key '{}' has no place in the format.", dataset.state));
    }
    findings
}

/// The dataset's own rings where the format can say them, else Klems full.
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

fn head(xml: &mut String, dataset: &Dataset, basis: &RingBasis) {
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
    let _ = writeln!(xml, "\t\t\t<Material>\n\t\t\t\t<Name>{}</Name>", escape(&dataset.name));
    let _ = writeln!(xml, "\t\t\t\t<Manufacturer>{}</Manufacturer>", escape(&dataset.manufacturer));
    if let Some(thickness) = dataset.thickness {
        let _ = writeln!(xml, "\t\t\t\t<Thickness unit=\"Meter\">{thickness}</Thickness>");
    }
    xml.push_str("\t\t\t\t<DeviceType>Other</DeviceType>\n\t\t\t</Material>\n\t\t\t<Geometry></Geometry>\n");
    xml.push_str("\t\t\t<DataDefinition>\n\t\t\t\t<IncidentDataStructure>Columns</IncidentDataStructure>\n");
    let _ = writeln!(xml, "\t\t\t\t<AngleBasis>\n\t\t\t\t\t<AngleBasisName>{}</AngleBasisName>", escape(basis.name()));
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
}

/// Degrees without the noise of the way through radians.
fn degrees(radians: f64) -> f64 {
    (radians.to_degrees() * 1e9).round() / 1e9
}

fn escape(text: &str) -> String {
    let clean: String = text.chars().filter(|c| !c.is_control()).collect();
    clean.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn band(xml: &mut String, band: &Band, name: &str, basis: &RingBasis) {
    for component in band.components() {
        let Some(btdf) = band.get(component) else { continue };
        let (title, kind, map) = match component {
            Component::TransmissionFront => ("Transmission Front", "BTDF", AzimuthMap::KLEMS_FRONT),
            Component::TransmissionBack => ("Transmission Back", "BTDF", AzimuthMap::KLEMS_BACK),
            Component::ReflectionFront => ("Reflection Front", "BRDF", AzimuthMap::KLEMS_FRONT),
            Component::ReflectionBack => ("Reflection Back", "BRDF", AzimuthMap::KLEMS_BACK),
        };
        let matrix = matrix_on(btdf, &basis.clone().with_azimuth(map));
        let basis_name = escape(basis.name());
        let _ = write!(
            xml,
            "\t\t\t<WavelengthData>\n\t\t\t\t<LayerNumber>System</LayerNumber>\n\
             \t\t\t\t<Wavelength unit=\"Integral\">{name}</Wavelength>\n\t\t\t\t<WavelengthDataBlock>\n\
             \t\t\t\t\t<WavelengthDataDirection>{title}</WavelengthDataDirection>\n\
             \t\t\t\t\t<ColumnAngleBasis>{basis_name}</ColumnAngleBasis>\n\
             \t\t\t\t\t<RowAngleBasis>{basis_name}</RowAngleBasis>\n\
             \t\t\t\t\t<ScatteringDataType>{kind}</ScatteringDataType>\n\t\t\t\t\t<ScatteringData>\n"
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

/// Any function on the cells of a basis, incident and emergent.
fn matrix_on(btdf: &Btdf, basis: &RingBasis) -> CellMatrix {
    let n = basis.len();
    let weights = basis.projected_solid_angles();
    let mut values = match &btdf.scattered {
        None => vec![0.0; n * n],
        Some(Scattered::Cells(matrix)) => resample_matrix(matrix, basis, basis).values().to_vec(),
        Some(Scattered::Directions(data)) => resample_matrix(&data.to_cells(), basis, basis).values().to_vec(),
        Some(Scattered::Lambert(tau)) => basis
            .cells()
            .flat_map(|cell| {
                let mean = ring_mean((cell.theta_min, cell.theta_max), |theta| tau.at(theta));
                std::iter::repeat_n(mean / std::f64::consts::PI, n)
            })
            .collect(),
        Some(Scattered::Tree(tree)) => tree_on(tree, basis),
    };
    if let Some(tau) = &btdf.regular {
        for (k, cell) in basis.cells().enumerate() {
            values[k * n + k] += ring_mean((cell.theta_min, cell.theta_max), |theta| tau.at(theta)) / weights[k];
        }
    }
    CellMatrix::new(basis.clone(), basis.clone(), values).expect("n² values were made")
}

/// Mean over a ring by projected solid angle: midpoints in sin²θ.
fn ring_mean((from, to): (f64, f64), f: impl Fn(f64) -> f64) -> f64 {
    const STEPS: usize = 32;
    let (a, b) = (from.sin().powi(2), to.sin().powi(2));
    let theta = |k: usize| (a + (b - a) * (k as f64 + 0.5) / STEPS as f64).sqrt().asin();
    (0..STEPS).map(|k| f(theta(k))).sum::<f64>() / STEPS as f64
}

/// Mean emergent distribution of every cell under uniform luminance of that cell. The shares of tree cells in ring
/// cells are counted on a million directions of equal weight; every distribution is then scaled to its exact flux.
fn tree_on(tree: &TensorTree, basis: &RingBasis) -> Vec<f64> {
    let grid = tree.incident_grid();
    let shares = grid_shares(grid, basis);
    let weights = basis.projected_solid_angles();
    let from_rings = Resampling::new(&grid.rings(), basis);
    let tau = tree.tau_by_cell();
    let mut values = Vec::with_capacity(basis.len() * basis.len());
    for incident in &shares {
        let mut illuminance = vec![0.0; grid.len()];
        for &(cell, share) in incident {
            illuminance[cell] = share;
        }
        let mut row: Vec<f64> = match tree.luminance_on_grid(&illuminance) {
            Some(luminance) => {
                shares.iter().map(|cell| cell.iter().map(|&(k, share)| share * luminance[k]).sum()).collect()
            }
            None => from_rings.apply(&tree.luminance(&illuminance).1),
        };
        let flux: f64 = incident.iter().map(|&(cell, share)| share * tau[cell]).sum();
        let got: f64 = row.iter().zip(&weights).map(|(q, w)| q * w).sum();
        if got > 0.0 {
            row.iter_mut().for_each(|q| *q *= flux / got);
        }
        values.extend(row);
    }
    values
}

/// For every cell of the basis the grid cells that fill it, with their shares (sum 1).
fn grid_shares(grid: SquareGrid, basis: &RingBasis) -> Vec<Vec<(usize, f64)>> {
    const SIDE: usize = 1024;
    let per_side = SIDE / grid.resolution();
    let mut counts: Vec<Vec<(usize, f64)>> = vec![Vec::new(); basis.len()];
    for (k, cell) in grid.cells().enumerate() {
        for direction in cell.samples(per_side) {
            let Some(place) = basis.index(direction) else { continue };
            match counts[place].last_mut() {
                Some(last) if last.0 == k => last.1 += 1.0,
                _ => counts[place].push((k, 1.0)),
            }
        }
    }
    for (place, list) in counts.iter_mut().enumerate() {
        if list.is_empty() {
            // A cell finer than the samples: its centre stands for it.
            list.extend(grid.index(basis.cell(place).centre()).map(|k| (k, 1.0)));
        }
        let total: f64 = list.iter().map(|entry| entry.1).sum();
        list.iter_mut().for_each(|entry| entry.1 /= total);
    }
    counts
}

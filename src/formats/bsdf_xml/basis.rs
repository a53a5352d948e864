//! Angle bases (divisions of the hemisphere) of a BSDF XML file: the directions that the file lists apply, not the name
//! of the basis.

use super::document::{Source, child, child_text, children, text};
use crate::compute::basis::{AzimuthMap, Ring, RingBasis};
use crate::compute::btdf::Finding;
use crate::compute::limits;
use crate::formats::location::{FormatError, Location, excerpt};
use roxmltree::Node;

/// Angle bases that a file defines or names.
pub(super) struct Bases {
    list: Vec<RingBasis>,
}

impl Bases {
    /// Reads every `AngleBasis` of `DataDefinition`.
    pub(super) fn read(
        source: &Source,
        definition: Option<Node<'_, '_>>,
        findings: &mut Vec<Finding>,
    ) -> Result<Self, FormatError> {
        let mut list = Vec::new();
        for node in definition.into_iter().flat_map(|d| children(d, "AngleBasis")) {
            let basis = read_basis(source, node)?;
            check_name(source, node, &basis, findings)?;
            list.push(basis);
        }
        Ok(Self { list })
    }

    /// Returns the basis with the given name: from the file's definition, or else the standard one of that name.
    pub(super) fn get(&self, name: &str, at: Location) -> Result<RingBasis, FormatError> {
        if let Some(basis) = self.list.iter().find(|basis| basis.name().eq_ignore_ascii_case(name)) {
            return Ok(basis.clone());
        }
        if let ([only], true) = (self.list.as_slice(), name.is_empty()) {
            return Ok(only.clone());
        }
        standard(name).map(|basis| basis.with_azimuth(AzimuthMap::KLEMS_FRONT)).ok_or_else(|| {
            FormatError::new(
                at,
                format!("unknown angle basis '{}'", excerpt(name)),
                "LBNL/Klems Full, Half or Quarter, or an AngleBasis of that name in DataDefinition",
            )
        })
    }
}

fn standard(name: &str) -> Option<RingBasis> {
    let map = AzimuthMap::KLEMS_FRONT;
    [RingBasis::klems_full(map), RingBasis::klems_half(map), RingBasis::klems_quarter(map)]
        .into_iter()
        .find(|basis| basis.name().eq_ignore_ascii_case(name))
}

fn read_basis(source: &Source, node: Node<'_, '_>) -> Result<RingBasis, FormatError> {
    let name = child_text(node, "AngleBasisName");
    let mut rings: Vec<Ring> = Vec::new();
    let mut cells = 0;
    for block in children(node, "AngleBasisBlock") {
        let bounds = child(block, "ThetaBounds").unwrap_or(block);
        let number = |parent: Node<'_, '_>, key: &str| -> Result<f64, FormatError> {
            let value = child_text(parent, key);
            value.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| {
                FormatError::new(
                    source.place(block),
                    format!("<{key}> is '{}'", excerpt(&value)),
                    "a number for every AngleBasisBlock",
                )
            })
        };
        let theta_max = number(bounds, "UpperTheta")?;
        let theta_min = match rings.last() {
            Some(last) => last.theta_max,
            None => 0.0,
        };
        if child(bounds, "LowerTheta").is_some() {
            let lower = number(bounds, "LowerTheta")?.to_radians();
            if (lower - theta_min).abs() > 1e-4 {
                return Err(FormatError::new(
                    source.place(block),
                    format!("the ring begins at {}°", lower.to_degrees()),
                    format!("{}°, where the ring before ends", theta_min.to_degrees()),
                ));
            }
        }
        let sectors = number(block, "nPhis")?;
        if sectors.fract() != 0.0 || !(1.0..=7200.0).contains(&sectors) {
            return Err(FormatError::new(
                source.place(block),
                format!("<nPhis> is {sectors}"),
                "a whole number of azimuth sectors, 1 to 7200",
            ));
        }
        cells += sectors as usize;
        if cells > limits::CELLS {
            return Err(FormatError::new(
                source.place(block),
                format!("an angle basis of more than {} directions", limits::CELLS),
                "fewer rings or sectors",
            ));
        }
        rings.push(Ring { theta_min, theta_max: theta_max.to_radians(), sectors: sectors as usize, first_phi: 0.0 });
    }
    if rings.is_empty() {
        return standard(&name).ok_or_else(|| {
            FormatError::new(
                source.place(node),
                format!("angle basis '{}' without AngleBasisBlock list", excerpt(&name)),
                "a standard basis, or a list of AngleBasisBlock elements",
            )
        });
    }
    RingBasis::new(name, rings, AzimuthMap::KLEMS_FRONT)
        .map_err(|error| FormatError::new(source.place(node), error.to_string(), "rings that divide 0…90°"))
}

/// Checks the name of a basis. A standard name with other directions is an error (it is not clear which of the two is
/// meant), except Half, which has meant both 73 and 77 directions; an unknown name with valid directions gives a
/// finding.
fn check_name(
    source: &Source,
    node: Node<'_, '_>,
    basis: &RingBasis,
    findings: &mut Vec<Finding>,
) -> Result<(), FormatError> {
    let Some(known) = standard(basis.name()) else {
        findings.push(Finding::warning(
            "unknown-basis-name",
            format!(
                "Angle basis '{}' is not a standard name; its own list of {} directions is used.",
                excerpt(basis.name()),
                basis.len()
            ),
        ));
        return Ok(());
    };
    let half = known.name().eq_ignore_ascii_case("LBNL/Klems Half");
    if known.len() != basis.len() && !(half && basis.len() == 77) {
        return Err(FormatError::new(
            source.place(node),
            format!("basis '{}' with a list of {} directions", text_of_name(node), basis.len()),
            format!("the {} directions of that name, or another name", known.len()),
        ));
    }
    let same_limits = known.len() == basis.len()
        && known.rings().iter().zip(basis.rings()).all(|(a, b)| (a.theta_max - b.theta_max).abs() < 1e-4);
    if !same_limits {
        findings.push(Finding::info(
            "basis-list-differs",
            format!(
                "The file's list for '{}' ({} directions) differs from the standard one; the list is used.",
                known.name(),
                basis.len()
            ),
        ));
    }
    Ok(())
}

fn text_of_name(node: Node<'_, '_>) -> String {
    child(node, "AngleBasisName").map(text).map(|t| excerpt(&t)).unwrap_or_default()
}

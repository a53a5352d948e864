//! `Material` element: names, extents and thermal data, read and written.
//!
//! Thermal data have no effect on the light, and are stored so that a file that is written again still contains what
//! was measured. WINDOW does not import a matrix file without them: unknown values are written there as the defaults of
//! Radiance's template for WINDOW, and the element's own comment names each of them. Values that this comment names and
//! that equal the default are left out again on reading, so that no default ever becomes a measured value.
//!
//! Elements, order and words are those of LBNL's schema (BSDF-v1.7.5.xsd). Width, height and permeability factor, which
//! the schema does not list but Radiance and LBNL's own fabric files hold, are written where they are known.

use super::document::{child, child_text, escaped, text};
use crate::compute::btdf::{Dataset, Finding, Thermal, ThermalKey};
use crate::formats::location::excerpt;
use roxmltree::Node;
use std::fmt::Write as _;

/// Thickness that is written if the dataset has none. \[m\]
const THICKNESS: f64 = 0.003;
/// Beginning of the comment that lists the defaults.
const INVENTED: &str = "Defaults, not measured: ";
/// Default values of thermal data, in the order of the file.
const DEFAULTS: [(ThermalKey, f64); 5] = [
    (ThermalKey::Conductivity, 1.0),
    (ThermalKey::EmissivityFront, 0.9),
    (ThermalKey::EmissivityBack, 0.9),
    (ThermalKey::InfraredTransmittance, 0.1),
    (ThermalKey::EffectiveOpenness, 0.05),
];
/// Device types of the schema; the last means "no information".
const DEVICES: [&str; 10] = [
    "Venetian blind horizontal",
    "Venetian blind vertical",
    "Woven shade",
    "Diffusing glass",
    "Specular glass",
    "Fritted Glass",
    "Cellular Shade",
    "Pleated Shade",
    "Solid Layer",
    "Other",
];

const fn element(key: ThermalKey) -> &'static str {
    match key {
        ThermalKey::Conductivity => "ThermalConductivity",
        ThermalKey::AirPermeability => "AirPermeability",
        ThermalKey::EmissivityFront => "EmissivityFront",
        ThermalKey::EmissivityBack => "EmissivityBack",
        ThermalKey::InfraredTransmittance => "TIR",
        ThermalKey::EffectiveOpenness => "EffectiveOpennessFraction",
        ThermalKey::Permeability => "PermeabilityFactor",
        ThermalKey::Width => "Width",
        ThermalKey::Height => "Height",
    }
}

const fn is_length(key: ThermalKey) -> bool {
    matches!(key, ThermalKey::Width | ThermalKey::Height)
}

/// Reads name, maker, thickness, thermal data and description from the `Material` element into the dataset.
pub(super) fn describe(dataset: &mut Dataset, root: Node<'_, '_>, layer: Node<'_, '_>) {
    let comments = root.document().root().descendants().filter(|node| node.is_comment()).filter_map(|node| node.text());
    dataset.description =
        comments.map(str::trim).filter(|text| !text.is_empty()).take(4).collect::<Vec<_>>().join("\n");
    let Some(material) = child(layer, "Material") else { return };
    for (element, place) in [("Name", &mut dataset.name), ("Manufacturer", &mut dataset.manufacturer)] {
        let word = child_text(material, element);
        if word.eq_ignore_ascii_case(element) {
            dataset.findings.push(Finding::warning(
                "template-word",
                format!(
                    "The file still has the template's placeholder '{word}' as its {element}; enter the product's."
                ),
            ));
        } else if word != "Unknown" {
            // What the writer puts where nothing is known.
            *place = word;
        }
    }
    let comment = child_text(material, "Comments");
    let invented = comment.strip_prefix(INVENTED).unwrap_or_default();
    if let Some(value) = length(material, "Thickness", "thickness-unreadable", &mut dataset.findings)
        && !(invented.contains("thickness") && value == THICKNESS)
    {
        dataset.thickness = Some(value);
    }
    dataset.thermal = thermal(material, invented, &mut dataset.findings);
}

/// Returns a length stated in the `Material` element \[m\]; a text that is not understood gives a finding and `None`.
fn length(material: Node<'_, '_>, name: &str, code: &'static str, findings: &mut Vec<Finding>) -> Option<f64> {
    let node = child(material, name)?;
    let value = text(node);
    if value.is_empty() {
        return None;
    }
    let unit = node.attributes().find(|attribute| attribute.name().eq_ignore_ascii_case("unit"));
    let unit = unit.map(|attribute| attribute.value().trim().to_ascii_lowercase()).unwrap_or_default();
    // Divisions, since 0.381 mm are 0.000381 m to the last digit that way.
    let metres = |value: f64| match unit.as_str() {
        "meter" | "metre" | "m" => Some(value),
        "centimeter" | "centimetre" | "cm" => Some(value / 100.0),
        "millimeter" | "millimetre" | "mm" => Some(value / 1000.0),
        "inch" => Some(value * 0.0254),
        "foot" => Some(value * 0.3048),
        _ => None,
    };
    match value.parse::<f64>().ok().and_then(metres) {
        Some(value) if value.is_finite() && value >= 0.0 => Some(value),
        _ => {
            findings.push(Finding::info(
                code,
                format!("{name} '{}' in '{}' is not understood and left out.", excerpt(&value), excerpt(&unit)),
            ));
            None
        }
    }
}

fn thermal(material: Node<'_, '_>, invented: &str, findings: &mut Vec<Finding>) -> Thermal {
    let mut thermal = Thermal::default();
    let device = child_text(material, "DeviceType");
    match DEVICES.iter().find(|known| known.eq_ignore_ascii_case(&device)) {
        Some(&"Other") => {}
        Some(known) => thermal.device = (*known).to_owned(),
        None if device.is_empty() => {}
        None => findings.push(Finding::info(
            "device-type-unknown",
            format!("The device type '{}' is none of the schema's and left out.", excerpt(&device)),
        )),
    }
    for key in ThermalKey::ALL {
        let name = element(key);
        if is_length(key) {
            if let Some(value) = length(material, name, "thermal-unreadable", findings) {
                thermal.set(key, value);
            }
            continue;
        }
        let word = child_text(material, name);
        let value = word.parse::<f64>();
        // Files of earlier versions named both emissivities at once.
        let named =
            invented.contains(key.word()) || (name.starts_with("Emissivity") && invented.contains("emissivities"));
        let is_default = DEFAULTS.iter().any(|(one, default)| *one == key && value == Ok(*default));
        if word.is_empty() || (named && is_default) {
            continue;
        }
        if !value.is_ok_and(|value| thermal.set(key, value)) {
            let right = if key.most() == 1.0 { "a number from 0 to 1" } else { "a number of 0 or more" };
            findings.push(Finding::info(
                "thermal-unreadable",
                format!("{name} '{}' is not {right} and left out.", excerpt(&word)),
            ));
        }
    }
    thermal
}

/// Writes the `Material` element. `defaults`: whether values that WINDOW needs and the dataset lacks are written as
/// defaults, which are named in the element's comment and in the returned findings.
pub(super) fn write(xml: &mut String, dataset: &Dataset, defaults: bool) -> Vec<Finding> {
    let thermal = &dataset.thermal;
    // Some readers do not stand empty elements.
    let or_unknown = |text: &str| if text.trim().is_empty() { "Unknown".to_owned() } else { escaped(text) };
    let mut named = Vec::new();
    let _ = writeln!(xml, "\t\t\t<Material>\n\t\t\t\t<Name>{}</Name>", or_unknown(&dataset.name));
    let _ = writeln!(xml, "\t\t\t\t<Manufacturer>{}</Manufacturer>", or_unknown(&dataset.manufacturer));
    if dataset.thickness.is_none() && defaults {
        named.push(format!("thickness {THICKNESS} m"));
    }
    if let Some(thickness) = dataset.thickness.or(defaults.then_some(THICKNESS)) {
        let _ = writeln!(xml, "\t\t\t\t<Thickness unit=\"Meter\">{thickness}</Thickness>");
    }
    let device = if thermal.device.is_empty() { "Other" } else { thermal.device.as_str() };
    let _ = writeln!(xml, "\t\t\t\t<DeviceType>{}</DeviceType>", escaped(device));
    if thermal.device.is_empty() && defaults {
        named.push(format!("device type {device}"));
    }
    for key in ThermalKey::ALL {
        // The measured permeability says what the effective openness would.
        let wanted =
            defaults && !(key == ThermalKey::EffectiveOpenness && thermal.get(ThermalKey::Permeability).is_some());
        let default = DEFAULTS.iter().find(|(one, _)| *one == key && wanted).map(|(_, value)| *value);
        let Some(value) = thermal.get(key).or(default) else { continue };
        if thermal.get(key).is_none() {
            let unit = if key == ThermalKey::Conductivity { " W/mK" } else { "" };
            named.push(format!("{} {value}{unit}", key.word()));
        }
        let (name, unit) = (element(key), if is_length(key) { " unit=\"Meter\"" } else { "" });
        let _ = writeln!(xml, "\t\t\t\t<{name}{unit}>{value}</{name}>");
    }
    let mut findings = Vec::new();
    if !named.is_empty() {
        let list = named.join(", ");
        let _ = writeln!(xml, "\t\t\t\t<Comments>{INVENTED}{list}.</Comments>");
        findings
            .push(Finding::info("window-defaults", format!("Not known and written as defaults for WINDOW: {list}.")));
    }
    xml.push_str("\t\t\t</Material>\n");
    findings
}

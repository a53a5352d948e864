//! What makers' files say besides light: kept from XML through the catalogue's own form back to XML; defaults never pass
//! for measured values.
//!
//! Makers' files are found by the environment variable `CFS_TEST_DATA` (a directory that holds `data`).

use crate::common::data;
use cfs::compute::btdf::{AngularTransmittance, Band, Btdf, Dataset, Scattered, ThermalKey, TreeRank};
use cfs::compute::doctor::repaired;
use cfs::formats::bsdf_xml::{TreeForm, read, write, write_matrices, write_tree};
use cfs::formats::dataset_blob::{decode, encode};
use std::path::{Path, PathBuf};

/// A diffuse file whose Material element holds the given elements.
fn file(material: &str) -> String {
    let opal = Btdf { regular: None, scattered: Some(Scattered::Lambert(AngularTransmittance::Constant(0.5))) };
    let visible = Band { transmission_front: Some(opal), ..Band::default() };
    let written = write_matrices(&Dataset { visible, ..Dataset::default() }).unwrap().bytes;
    let text = String::from_utf8(written).unwrap();
    let (before, rest) = text.split_once("<Material>").unwrap();
    let (_, after) = rest.split_once("</Material>").unwrap();
    format!("{before}<Material>{material}</Material>{after}")
}

/// Through the catalogue's form and through XML.
fn there_and_back(dataset: &Dataset) -> (Dataset, String) {
    let kept = decode(&encode(dataset)).unwrap();
    assert_eq!(kept.thermal, dataset.thermal);
    assert_eq!(kept.thickness, dataset.thickness);
    let text = String::from_utf8(write_matrices(&kept).unwrap().bytes).unwrap();
    (read(text.as_bytes()).unwrap(), text)
}

#[test]
fn what_was_measured_stays() {
    let text = file(
        "<Name>Screen</Name><Manufacturer>Weaver</Manufacturer><Thickness unit=\"Millimeter\">0.381</Thickness>\
         <DeviceType>Woven shade</DeviceType><ThermalConductivity>0.12</ThermalConductivity>\
         <AirPermeability>0.7</AirPermeability><EmissivityFront> 0.813 </EmissivityFront>\
         <EmissivityBack>0.821</EmissivityBack><TIR>8e-2</TIR>\
         <EffectiveOpennessFraction>0.03</EffectiveOpennessFraction><PermeabilityFactor>0.0036984</PermeabilityFactor>\
         <Width Unit=\"Centimeter\">45</Width><Height unit=\"meter\">1.5367</Height>",
    );
    let dataset = read(text.as_bytes()).unwrap();
    let values = [0.12, 0.7, 0.813, 0.821, 0.08, 0.03, 0.003_698_4, 0.45, 1.5367];
    let known: Vec<f64> = dataset.thermal.known().map(|(_, value)| value).collect();
    assert_eq!(known, values);
    assert_eq!(dataset.thickness, Some(0.000_381));
    let (again, written) = there_and_back(&dataset);
    assert_eq!((&again.thermal, again.thickness), (&dataset.thermal, dataset.thickness));
    assert_eq!((again.name.as_str(), again.manufacturer.as_str()), ("Screen", "Weaver"));
    // Nothing was invented, and nothing is called so.
    assert!(!written.contains("Defaults") && written.contains("<DeviceType>Woven shade</DeviceType>"));
    assert!(written.contains("<TIR>0.08</TIR>") && written.contains("<Thickness unit=\"Meter\">0.000381</Thickness>"));
}

#[test]
fn defaults_are_named_and_never_come_back_as_measured() {
    let nothing = read(file("<Name>Screen</Name>").as_bytes()).unwrap();
    assert!(nothing.thermal.is_empty() && nothing.thickness.is_none());
    let written = write_matrices(&nothing).unwrap();
    let said = &written.findings.iter().find(|one| one.code == "window-defaults").unwrap().message;
    for word in ["thickness 0.003 m", "conductivity 1 W/mK", "front emissivity 0.9", "effective openness 0.05"] {
        assert!(said.contains(word), "{said}");
    }
    let again = read(&written.bytes).unwrap();
    assert!(again.thermal.is_empty() && again.thickness.is_none(), "{:?}", again.thermal);

    // A measured value that equals the default is measured all the same; the others are still defaults.
    let one = read(file("<EmissivityBack>0.9</EmissivityBack><PermeabilityFactor>0.1</PermeabilityFactor>").as_bytes());
    let one = one.unwrap();
    let (again, text) = there_and_back(&one);
    assert_eq!(again.thermal, one.thermal);
    assert_eq!(again.thermal.get(ThermalKey::EmissivityBack), Some(0.9));
    let comment = text.split_once("<Comments>").unwrap().1.split_once("</Comments>").unwrap().0.to_owned();
    assert!(comment.contains("front emissivity") && !comment.contains("back emissivity"), "{comment}");
    // The permeability is what WINDOW asks for first: no openness is invented beside it.
    assert!(!text.contains("EffectiveOpennessFraction"));

    // Files of earlier versions named both emissivities together.
    let old = file(
        "<Thickness unit=\"Meter\">0.003</Thickness><ThermalConductivity>1</ThermalConductivity>\
         <EmissivityFront>0.9</EmissivityFront><EmissivityBack>0.9</EmissivityBack><TIR>0.1</TIR>\
         <EffectiveOpennessFraction>0.05</EffectiveOpennessFraction><Comments>Defaults, not measured: thickness, device \
         type Other, conductivity 1 W/mK, emissivities 0.9, infrared transmittance 0.1, effective openness \
         0.05.</Comments>",
    );
    let old = read(old.as_bytes()).unwrap();
    assert!(old.thermal.is_empty() && old.thickness.is_none(), "{:?}", old.thermal);
}

#[test]
fn what_cannot_be_is_told_and_left_out() {
    let dataset = read(
        file("<EmissivityFront>1.7</EmissivityFront><TIR>dark</TIR><Width unit=\"ell\">2</Width><DeviceType>Curtain</DeviceType>")
            .as_bytes(),
    );
    let dataset = dataset.unwrap();
    assert!(dataset.thermal.is_empty());
    let said: Vec<&str> = dataset.findings.iter().map(|one| one.message.as_str()).collect();
    for word in ["EmissivityFront '1.7'", "TIR 'dark'", "Width '2' in 'ell'", "'Curtain'"] {
        assert!(said.iter().any(|message| message.contains(word)), "{word}: {said:?}");
    }
}

#[test]
fn the_binary_form_of_light_alone_is_what_it_was() {
    let plain = read(file("<Name>Screen</Name>").as_bytes()).unwrap();
    let bytes = encode(&plain);
    assert_eq!(bytes[4], 1, "datasets without thermal data keep their bytes and hashes");
    let mut told = plain.clone();
    assert!(told.thermal.set(ThermalKey::Conductivity, 0.25));
    told.structure = Some(0.08);
    let longer = encode(&told);
    assert_eq!(longer[4], 2);
    assert_eq!(decode(&longer).unwrap(), decode(&encode(&decode(&longer).unwrap())).unwrap());
    assert_eq!(decode(&longer).unwrap().structure, Some(0.08));
    // A number of no known kind, and one that cannot be.
    let place = longer.len() - 8 - 9;
    for (byte, at) in [(200, place), (0xff, place + 8)] {
        let mut broken = longer.clone();
        broken[at] = byte;
        assert!(decode(&broken).is_err(), "{at}");
    }
    // The structure stands last and alone may be missing.
    assert!((5..longer.len()).all(|end| end == longer.len() - 8 || decode(&longer[..end]).is_err()));
}

#[test]
fn trees_keep_it_and_a_turned_product_turns_its_coatings() {
    let dataset = read(file("<EmissivityFront>0.1</EmissivityFront><EmissivityBack>0.8</EmissivityBack>").as_bytes());
    let dataset = dataset.unwrap();
    let tree = write_tree(&dataset, TreeForm { level: Some(2), ..TreeForm::of_rank(TreeRank::Three) }).unwrap().bytes;
    assert!(!String::from_utf8_lossy(&tree).contains("TIR"), "nothing is invented");
    assert_eq!(read(&tree).unwrap().thermal, dataset.thermal);
    let turned = repaired(&dataset, "swap-sides".parse().unwrap()).unwrap();
    assert_eq!(turned.thermal.get(ThermalKey::EmissivityFront), Some(0.8));
    let back = repaired(&turned, "swap-sides".parse().unwrap()).unwrap();
    assert_eq!(back.thermal, dataset.thermal);
}

fn walk(folder: &Path, list: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            walk(&path, list);
        } else if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("xml")) {
            list.push(path);
        }
    }
}

/// Number and unit of the first element of a name in the text, found without an XML parser.
fn plain(text: &str, element: &str) -> Option<(f64, String)> {
    let material = text.split_once("<Material")?.1.split_once("</Material>")?.0;
    let rest = material.split_once(&format!("<{element}"))?.1;
    let (attributes, rest) = rest.split_once('>')?;
    let unit = attributes.split('"').nth(1).unwrap_or_default().to_ascii_lowercase();
    Some((rest.split_once("</")?.0.trim().parse().ok()?, unit))
}

#[test]
fn makers_files_keep_what_they_say() {
    let Some(folder) = data("data/bsdf") else { return };
    let mut files = Vec::new();
    walk(&folder, &mut files);
    let mut compared = 0;
    for path in files {
        let bytes = std::fs::read(&path).unwrap();
        let (Ok(dataset), text) = (read(&bytes), String::from_utf8_lossy(&bytes)) else { continue };
        let kept = decode(&encode(&dataset)).unwrap();
        let again = read(&write(&kept).unwrap().bytes).unwrap();
        assert_eq!((&again.thermal, again.thickness), (&dataset.thermal, dataset.thickness), "{}", path.display());
        for (element, key) in [
            ("ThermalConductivity", ThermalKey::Conductivity),
            ("EmissivityFront", ThermalKey::EmissivityFront),
            ("EmissivityBack", ThermalKey::EmissivityBack),
            ("TIR", ThermalKey::InfraredTransmittance),
            ("EffectiveOpennessFraction", ThermalKey::EffectiveOpenness),
            ("PermeabilityFactor", ThermalKey::Permeability),
            ("Width", ThermalKey::Width),
            ("Height", ThermalKey::Height),
        ] {
            let Some((value, unit)) = plain(&text, element) else { continue };
            let metres = match unit.as_str() {
                "millimeter" => 1e-3,
                "centimeter" => 1e-2,
                _ => 1.0,
            };
            let kept = again.thermal.get(key).unwrap_or_else(|| panic!("{}: {element}", path.display()));
            assert!((kept - value * metres).abs() <= 1e-12 * value, "{} {element}: {kept}", path.display());
            compared += 1;
        }
    }
    assert!(compared >= 60, "{compared}");
}

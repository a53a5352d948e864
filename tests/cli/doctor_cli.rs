//! Makers' pipelines: `cfs catalogue validate` judges by exit code and JSON, `cfs repair` mends, records and undoes.

use crate::program::cfs;
use cfs::compute::btdf::{AngularTransmittance, Band, Btdf, Dataset, Scattered};
use cfs::formats::bsdf_xml;
use serde_json::Value;
use std::path::Path;

/// An opal pane whose values are percent: 50 of 100 pass.
fn percent() -> Vec<u8> {
    let opal = Btdf { regular: None, scattered: Some(Scattered::Lambert(AngularTransmittance::Constant(50.0))) };
    let visible = Band { transmission_front: Some(opal), ..Band::default() };
    bsdf_xml::write(&Dataset { name: "Opal".into(), visible, ..Dataset::default() }).unwrap().bytes
}

fn tau(folder: &Path, file: &str) -> f64 {
    let info: Value = serde_json::from_slice(&cfs(folder, &["info", file, "--json"]).stdout).unwrap();
    info["tau_normal_hemispherical"].as_f64().unwrap()
}

#[test]
fn a_pipeline_judges_mends_and_undoes() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("p.xml"), percent()).unwrap();
    let judged = cfs(folder, &["catalogue", "validate", "p.xml", "--json"]);
    assert_eq!(judged.status.code(), Some(1));
    let list: Value = serde_json::from_slice(&judged.stdout).unwrap();
    assert_eq!(list[0]["valid"], false);
    let findings = list[0]["findings"].as_array().unwrap();
    let found = findings.iter().find(|one| one["code"] == "percent").unwrap();
    assert_eq!(found["severity"], "error");
    assert!(found["meaning"].as_str().unwrap().contains("100 times"));
    let repair = found["repair"].as_str().unwrap();

    assert!(cfs(folder, &["repair", "p.xml", "--repair", repair, "--out", "m.xml"]).status.success());
    assert!((tau(folder, "m.xml") - 0.5).abs() < 1e-6);
    assert_eq!(cfs(folder, &["catalogue", "validate", "m.xml"]).status.code(), Some(0));
    assert!(String::from_utf8_lossy(&cfs(folder, &["info", "m.xml"]).stdout).contains(&format!("repaired: {repair}")));

    assert!(cfs(folder, &["repair", "m.xml", "--undo", "--out", "u.xml"]).status.success());
    assert!((tau(folder, "u.xml") - 50.0).abs() < 1e-4);
    assert!(!String::from_utf8_lossy(&cfs(folder, &["info", "u.xml"]).stdout).contains("repaired:"));
}

#[test]
fn what_cannot_be_done_is_status_2_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("p.xml"), percent()).unwrap();
    std::fs::write(folder.join("no.xml"), "<WindowElement>").unwrap();
    for arguments in [
        ["repair", "p.xml", "--repair", "polish", "--out", "m.xml"],
        ["repair", "p.xml", "--repair", "transpose:reflection_back", "--out", "m.xml"],
        ["repair", "no.xml", "--repair", "transpose", "--out", "m.xml"],
        ["repair", "p.xml", "--repair", "transpose", "--out", "m.unknown"],
    ] {
        let output = cfs(folder, &arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(!folder.join("m.xml").exists() && !folder.join("m.unknown").exists());
    }
    assert_eq!(cfs(folder, &["catalogue", "validate", "no.xml"]).status.code(), Some(2));
}

//! The numerical goniophotometer on files: stacks in stacks, states that are kept, wrong input.

use crate::program::cfs;
use cfs::catalogue::Catalogue;
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::estimate::Silent;
use cfs::formats::dataset_blob::encode;
use cfs::study::Library;
use cfs::study::goniophotometer::{Described, Request};
use serde_json::Value;
use std::path::Path;

const PANE: &str = "name = \"pane\"\nkind = \"pane\"\n[pane]\nindex = 1.52\nthickness = 0.004\nabsorption = 10\n";
const OPAL: &str = "name = \"opal\"\nkind = \"diffuser\"\n[diffuser]\ntransmittance = 0.5\nreflectance = 0.4\nmodel = \"lambertian\"\n";
const BLIND: &str = "name = \"blind\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 0.072\n\
                     angles = [0, 45]\nupper = { reflectance = 0.5 }\nlower = { reflectance = 0.3 }\n";

fn stack(layers: &[&str]) -> String {
    let list: Vec<String> = layers.iter().map(|name| format!("{{ file = \"{name}.system.toml\" }}")).collect();
    format!("name = \"stack\"\nkind = \"stack\"\n[stack]\nlayers = [{}]\n", list.join(", "))
}

fn put(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(format!("{name}.system.toml")), text).unwrap();
}

fn request() -> Request {
    let cells = RingBasis::klems_quarter(AzimuthMap::KLEMS_FRONT);
    Request { incident: cells.clone(), emergent: cells, error: 0.02, seed: 1 }
}

#[test]
fn a_stack_in_a_stack_is_the_stack_of_all_layers() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("pane", PANE), ("opal", OPAL)] {
        put(folder.path(), name, text);
    }
    put(folder.path(), "double", &stack(&["pane", "opal"]));
    put(folder.path(), "nested", &stack(&["pane", "double"]));
    put(folder.path(), "flat", &stack(&["pane", "pane", "opal"]));
    put(folder.path(), "itself", &stack(&["pane", "itself"]));
    put(folder.path(), "panes", &stack(&["pane", "pane"]));
    put(folder.path(), "two", &PANE.replace("absorption", "panes = 2\nabsorption"));
    let library = Library::default();
    let measured = |name: &str| {
        let described = Described::read(&folder.path().join(format!("{name}.system.toml"))).unwrap();
        described.measure("", &request(), &library, None, &Silent)
    };
    assert_eq!(measured("nested").unwrap().dataset.visible, measured("flat").unwrap().dataset.visible);
    // Light keeps its polarisation between panes: two of them are not two matrices.
    assert_eq!(measured("panes").unwrap().dataset.visible, measured("two").unwrap().dataset.visible);
    let endless = measured("itself").unwrap_err().to_string();
    assert!(endless.contains("stacks within stacks"), "{endless}");
}

#[test]
fn kept_states_are_taken_while_everything_they_hang_on_is_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let keep = folder.path().join("kept");
    std::fs::create_dir(&keep).unwrap();
    put(folder.path(), "pane", PANE);
    put(folder.path(), "double", &stack(&["pane", "pane"]));
    put(folder.path(), "triple", &stack(&["double", "pane"]));
    let described = Described::read(&folder.path().join("triple.system.toml")).unwrap();
    let library = Library::default();
    let measured = || described.measure("", &request(), &library, Some(&keep), &Silent).unwrap();
    let (first, again) = (measured(), measured());
    assert!(first.quality.is_some() && again.quality.is_none());
    // The form in which it is kept is the catalogue's: what is added later has the same hash.
    assert_eq!(encode(&first.dataset), encode(&again.dataset));
    // A layer of a layer changes.
    put(folder.path(), "pane", &PANE.replace("1.52", "1.7"));
    let other = measured();
    assert!(other.quality.is_some() && other.dataset.visible != first.dataset.visible);
}

#[test]
fn a_run_tells_its_quality_and_its_package_holds_what_it_was_made_of() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    put(folder, "blind", BLIND);
    let run = cfs(folder, &["goniophotometer", "blind.system.toml", "--out", "blind.cfsp", "--json"]);
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    let told: Value = serde_json::from_slice(&run.stdout).unwrap();
    let states = told["states"].as_array().unwrap();
    assert_eq!(states.iter().map(|one| one["state"].as_str().unwrap()).collect::<Vec<_>>(), ["0", "45"]);
    for state in states {
        let quality = |key: &str| state["quality"][key].as_f64().unwrap();
        assert!(quality("energy_balance_error") < 1e-3 && quality("reciprocity_error") < 1e-2);
        assert!(quality("estimated_error") <= 0.01);
    }
    assert!(!folder.join("blind.cfsp.part").exists());
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    let imported = catalogue.import_package(&std::fs::read(folder.join("blind.cfsp")).unwrap()).unwrap();
    let product = catalogue.product(&imported[0].key).unwrap();
    assert_eq!(product.system, BLIND);
    assert!(product.provenance.method.contains("cfs"), "{}", product.provenance.method);
    // The package is read wherever a dataset is.
    let info = cfs(folder, &["info", "blind.cfsp", "--json"]);
    assert_eq!(info.status.code(), Some(0), "{}", String::from_utf8_lossy(&info.stderr));
    let shown: Value = serde_json::from_slice(&info.stdout).unwrap();
    assert!(shown.as_array().unwrap().iter().all(|state| state["described"] == true));
    let xml = cfs(folder, &["goniophotometer", "blind.system.toml", "--state", "45", "--out", "blind.xml"]);
    assert_eq!(xml.status.code(), Some(0), "{}", String::from_utf8_lossy(&xml.stderr));
    let shown = String::from_utf8(cfs(folder, &["info", "blind.xml"]).stdout).unwrap();
    assert!(shown.contains("by direction, computed again from the description"), "{shown}");
    let judged = cfs(folder, &["catalogue", "validate", "blind.cfsp"]);
    assert_eq!(judged.status.code(), Some(0), "{}", String::from_utf8_lossy(&judged.stderr));
}

#[test]
fn text_files_hold_the_cells_that_were_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    put(folder, "pane", PANE);
    let to = ["--incidence", "tregenza-145", "--emergent", "10", "--out", "pane.btdf.txt"];
    let run = cfs(folder, &[&["goniophotometer", "pane.system.toml"][..], &to].concat());
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    for name in ["pane.btdf.txt", "pane_reflection-front.btdf.txt"] {
        let text = std::fs::read_to_string(folder.join(name)).unwrap();
        assert!(text.contains("tregenza-145"), "{name}");
        let read = cfs::formats::read_dataset(name, text.as_bytes()).unwrap().remove(0);
        let component = read.visible.components()[0];
        let tau = read.visible.get(component).unwrap().tau_hemispherical();
        assert!(tau > 0.1 && tau < 0.9, "{name} {tau}");
    }
}

#[test]
fn wrong_input_is_one_message_and_exit_two() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    put(folder, "blind", BLIND);
    put(folder, "typo", &BLIND.replace("spacing", "spacingg"));
    put(folder, "absent", &stack(&["nowhere"]));
    for (arguments, part) in [
        (&["typo.system.toml"][..], "spacingg"),
        (&["absent.system.toml"], "nowhere.system.toml"),
        (&["none.system.toml"], "none.system.toml"),
        (&["blind.system.toml", "--state", "30"], "expected one of '0', '45'"),
        (&["blind.system.toml", "--emergent", "0"], "--emergent"),
        (&["blind.system.toml", "--error=-1"], "--error"),
        (&["blind.system.toml", "--out", "x.ies"], "x.ies"),
    ] {
        let run = cfs(folder, &[&["goniophotometer"], arguments].concat());
        let told = String::from_utf8_lossy(&run.stderr).into_owned();
        assert_eq!((run.status.code(), run.stdout.len()), (Some(2), 0), "{arguments:?}: {told}");
        assert!(told.contains(part) && !told.contains("panicked"), "{arguments:?}: {told}");
    }
    assert_eq!(std::fs::read_dir(folder).unwrap().count(), 3);
}

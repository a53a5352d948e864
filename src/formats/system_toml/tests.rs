//! Tests of reading system files, and of the errors for wrong ones.

use super::*;
use crate::compute::system::panes::coated::{self, CoatedPane};

const BLIND: &str = "name = \"Blind\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.080\nspacing = 0.072\n\
                     angles = [30.0, -30.0]\nupper = { reflectance = 0.8, specular = 0.1, roughness = 2.0 }\n\
                     lower = { reflectance = 0.2 }\n";

fn error(text: &str) -> String {
    read(text.as_bytes()).unwrap_err().to_string()
}

#[test]
fn a_blind_with_its_states() {
    let file = read(BLIND.as_bytes()).unwrap();
    assert_eq!(file.system.states(), ["30", "-30"]);
    let SystemKind::Venetian(blind) = &file.system.kind else { panic!() };
    assert_eq!(blind.profile, SlatProfile::Flat { width: 0.08 });
    assert!((blind.upper.spread - 2_f64.to_radians()).abs() < 1e-15 && blind.lower.mirror == 0.0);
}

#[test]
fn steps_of_a_range_are_counted_without_rounding() {
    let text = BLIND.replace("[30.0, -30.0]", "{ from = -25.0, to = 75.0, step = 5.0 }");
    let states = read(text.as_bytes()).unwrap().system.states();
    assert_eq!((states.len(), states[0].as_str(), states[20].as_str()), (21, "-25", "75"));
    assert!(error(&text.replace("step = 5.0", "step = 0.0")).contains("a step above 0"));
}

#[test]
fn wrong_values_are_told_by_their_key() {
    for (from, to, expected) in [
        ("spacing = 0.072", "spacing = -1.0", "venetian.spacing: -1; expected metres, above 0"),
        ("spacing = 0.072", "spacing = nan", "venetian.spacing: NaN"),
        ("reflectance = 0.2", "reflectance = 1.2", "venetian.lower.reflectance: 1.2; expected 0 to 1"),
        ("reflectance = 0.8", "reflectance = 0.95", "expected at most 1 together"),
        ("-30.0", "30.0", "venetian.angles: 30 twice"),
        ("-30.0", "100.0", "venetian.angles: 100; expected -90 to 90"),
        ("spacing", "spacings", "line 5, venetian: unknown field `spacings`"),
        ("\"venetian\"", "\"blind\"", "line 2, kind: unknown variant `blind`"),
        ("\"venetian\"", "\"pane\"", "venetian: a table of another kind than \"pane\""),
    ] {
        let told = error(&BLIND.replacen(from, to, 1));
        assert!(told.contains(expected), "{from} → {to}: {told}");
    }
    assert!(error("kind = \"pane\"\nname = \"x\"").contains("a table [pane]"));
    assert!(read(b"\xff").is_err() && read(&vec![b' '; 2 << 20]).is_err());
}

#[test]
fn a_pane_by_its_data_sheet() {
    let text = |keys: &str| format!("name = \"p\"\nkind = \"pane\"\n[pane]\nindex = 1.52\nthickness = 0.004\n{keys}\n");
    let read = |keys: &str| match read(text(keys).as_bytes()).unwrap().system.kind {
        SystemKind::Pane(stack) => stack,
        _ => panic!(),
    };
    let coated::Layer::Clear(pane) = read("transmittance_normal = 0.80").pane else { panic!() };
    let tau = crate::compute::system::panes::glazing::stack(&[pane], 0.0).transmitted;
    assert!((tau - 0.8).abs() < 1e-12);
    let coated = read("transmittance_normal = 0.7\nreflectance_normal = 0.12\npanes = 2");
    assert_eq!(coated.panes, 2);
    assert_eq!(coated.pane, coated::Layer::Coated(CoatedPane { transmittance: 0.7, front: 0.12, back: 0.12 }));
    assert!(error(&text("transmittance_normal = 0.7\nreflectance_normal = 0.4")).contains("expected 0 to 0.3"));
    assert!(error(&text("transmittance_normal = 0.99")).contains("pane.transmittance_normal: 0.99"));
}

#[test]
fn stacks_name_their_layers() {
    let text = "name = \"s\"\nkind = \"stack\"\n[stack]\nlayers = [{ file = \"a.system.toml\" }, \
                { catalogue = \"blind\", state = \"each\" }]";
    let SystemKind::Stack(layers) = read(text.as_bytes()).unwrap().system.kind else { panic!() };
    assert_eq!(layers[0].source, LayerSource::File("a.system.toml".into()));
    assert_eq!(layers[1], Layer { source: LayerSource::Catalogue("blind".into()), state: EACH_STATE.into() });
    assert!(error(&text.replace("file =", "files =")).contains("unknown field"));
    let twice = text.replace("\"a.system.toml\" }", "\"a.system.toml\", state = \"each\" }");
    assert!(error(&twice).contains("one moving layer"));
}

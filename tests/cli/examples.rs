//! What the files in `examples` show.

use cfs::study::SceneFile;
use std::path::Path;
use std::process::{Command, Output};

/// Runs the program in the package's folder with an empty catalogue in `folder`.
fn cfs(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_cfs"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("CFS_CATALOGUE", folder.join("catalogue.sqlite"))
        .output()
        .unwrap()
}

fn succeed(folder: &Path, arguments: &[&str]) -> String {
    let output = cfs(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// (y, E, E_direct, E_interreflected) of each row.
fn rows(table: &str) -> Vec<[f64; 4]> {
    let mut lines = table.lines();
    let header = lines.next().unwrap();
    assert!(header.starts_with("x,y,z,nx,ny,nz,E_lx,E_direct_lx,E_interreflected_lx,E_error_lx,"), "{header}");
    lines
        .map(|line| {
            let numbers: Vec<f64> = line.split(',').map(|word| word.parse().unwrap()).collect();
            [numbers[1], numbers[6], numbers[7], numbers[8]]
        })
        .collect()
}

#[test]
fn office_scales_with_its_glass() {
    let folder = tempfile::tempdir().unwrap();
    let whole = rows(&succeed(folder.path(), &["room", "examples/office.toml"]));
    assert_eq!(whole.len(), 8 * 12);

    // An ideal window reflects nothing into the room, so everything in it is proportional to the transmittance.
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/office.toml")).unwrap();
    assert!(text.contains("\"transparent\", transmittance = 0.8"));
    let half = folder.path().join("half.toml");
    std::fs::write(&half, text.replace("\"transparent\", transmittance = 0.8", "\"transparent\", transmittance = 0.4"))
        .unwrap();
    let half = rows(&succeed(folder.path(), &["room", half.to_str().unwrap()]));
    for (a, b) in whole.iter().zip(&half) {
        for k in 1..4 {
            assert!(a[k] > 0.0 && (b[k] / a[k] - 0.5).abs() < 1e-6, "{a:?} {b:?}");
        }
        assert!((a[2] + a[3] - a[1]).abs() < 1e-6 * a[1], "{a:?}");
    }
    // Less than what the open ground gets, and less in the depth than at the window.
    assert!(whole.iter().all(|row| row[1] < 10_000.0));
    assert!(whole[..16].iter().all(|front| whole[80..].iter().all(|back| front[1] > back[1])));
}

#[test]
fn blind_keeps_the_sun_out() {
    let folder = tempfile::tempdir().unwrap();
    let shaded = rows(&succeed(folder.path(), &["room", "examples/blind.toml"]));
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/blind.toml")).unwrap();
    let open = folder.path().join("open.toml");
    let system = "system = { catalogue = \"venetian-80-72\", state = \"controlled\" }";
    assert!(text.contains(system));
    std::fs::write(&open, text.replace(system, "system = { ideal = \"transparent\", transmittance = 1.0 }")).unwrap();
    let open = rows(&succeed(folder.path(), &["room", open.to_str().unwrap()]));
    let most = |rows: &[[f64; 4]]| rows.iter().map(|row| row[1]).fold(0.0, f64::max);
    // Sun of 70 klx at about 41° brings more than 40 klx to the floor; of a blind's scattered light less than half.
    assert!(most(&open) > 40_000.0, "{}", most(&open));
    assert!(most(&shaded) > 100.0 && most(&shaded) < 0.5 * most(&open), "{}", most(&shaded));
}

#[test]
fn commented_keys_of_the_office_are_keys() {
    // Take the comment sign off every line "# key = value" one at a time: no reader may call the key unknown.
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/office.toml")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let is_key = |line: &str| {
        let word = line.strip_prefix("# ").and_then(|rest| rest.split(" = ").next());
        line.contains(" = ") && word.is_some_and(|word| word.chars().all(|c| c.is_ascii_lowercase() || c == '_'))
    };
    let mut tried = 0;
    // The table that a key belongs to may be a comment itself: its sign goes too.
    let mut table = None;
    for (index, line) in lines.iter().enumerate() {
        if line.starts_with('[') {
            table = None;
        } else if line.starts_with("# [") {
            table = Some(index);
        }
        if !is_key(line) {
            continue;
        }
        let mut changed = lines.clone();
        for place in table.into_iter().chain([index]) {
            changed[place] = &lines[place][2..];
        }
        if let Err(error) = SceneFile::parse(&changed.join("\n")) {
            assert!(!error.to_string().contains("unknown"), "{line}: {error}");
        }
        tried += 1;
    }
    assert!(tried >= 10, "{tried} keys only");
    assert!(SceneFile::parse(&text.replace("# longitude", "longtude")).unwrap_err().to_string().contains("longtude"));
}

#[test]
fn the_measured_example_is_whole_by_its_symmetry() {
    let folder = tempfile::tempdir().unwrap();
    let text = succeed(folder.path(), &["info", "examples/opal.btdf.txt"]);
    assert!(text.contains("145 incident directions × 25 emergent cells"), "{text}");
    assert!(text.contains("137 incidences are images of the 8 measured ones") && !text.contains("warning"), "{text}");
    let json = succeed(folder.path(), &["info", "examples/opal.btdf.txt", "--json"]);
    let info: serde_json::Value = serde_json::from_str(&json).unwrap();
    let rows = info["tau_dir_hem"].as_array().unwrap();
    assert_eq!(rows.len(), 145);
    // The eight lines by hand: rings of π/4, π/2 and π/4 sr of projected solid angle.
    let by_hand = |q: [f64; 3]| std::f64::consts::PI * (0.25 * q[0] + 0.5 * q[1] + 0.25 * q[2]);
    let close = |k: usize, q| (rows[k]["tau"].as_f64().unwrap() - by_hand(q)).abs() < 1e-9;
    assert!(close(144, OPAL_NORMAL) && close(7, OPAL_GRAZING), "{} {}", rows[144], rows[7]);
}

/// The values of the example's rings for light along the normal and at 84°.
const OPAL_NORMAL: [f64; 3] = [0.1776, 0.1974, 0.2151];
const OPAL_GRAZING: [f64; 3] = [0.0753, 0.0837, 0.0913];

//! `cfs picture` and `cfs report`: what is handed on says the same as the tables.

use crate::common::not_looked_at;
use crate::program::cfs;
use std::path::Path;
use std::process::Command;

/// A blind in a southern façade in Stuttgart, moved by the control.
const SCENE: &str = r#"
[room]
width = 4.0
depth = 6.0
height = 3.0
reflectance = { floor = 0.2, walls = 0.5, ceiling = 0.7 }
[[aperture]]
surface = "facade"
origin = [0.5, 0.9]
size = [3.0, 1.8]
system = { catalogue = "venetian-80-72", state = "controlled" }
[site]
azimuth = 180.0
latitude = 48.78
longitude = 9.18
utc_offset = 1.0
ground_reflectance = 0.2
[sky]
model = "cie"
type = 12
illuminance = "clear-sky"
time = "2026-03-21T12:00"
[control]
mode = "cut-off"
[sensors]
plane = { z = 0.85, nx = 6, ny = 8, normal = [0.0, 0.0, 1.0] }
"#;

fn succeed(folder: &Path, arguments: &[&str]) -> String {
    let output = cfs(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn refuse(folder: &Path, arguments: &[&str]) -> String {
    let output = cfs(folder, arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

/// All texts of an SVG.
fn words(svg: &str) -> Vec<String> {
    let tree = roxmltree::Document::parse(svg).unwrap();
    let texts = tree.descendants().filter(|node| node.has_tag_name("text"));
    texts.filter_map(|node| node.text().map(str::to_owned)).collect()
}

/// Mean of the illuminances in the table of `cfs room`, as it is written for people.
fn mean(table: &str) -> String {
    let values: Vec<f64> = table.lines().skip(1).map(|line| line.split(',').nth(6).unwrap().parse().unwrap()).collect();
    cfs::drawing::ticks::si(values.iter().sum::<f64>() / values.len() as f64, "lx")
}

#[test]
fn every_tile_is_a_picture_that_says_what_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("s.toml"), SCENE).unwrap();
    let mean = mean(&succeed(folder, &["room", "s.toml"]));
    let units = [
        ("btdf", "q / (1/sr) (log)"),
        ("transmittance", "τ"),
        ("sky", "cd/m² (log)"),
        ("lid", "C0–C180, cd"),
        ("room", "lx"),
        ("control", "slat angle / °"),
    ];
    for (tile, unit) in units {
        let out = format!("{tile}.svg");
        succeed(folder, &["picture", "s.toml", "--tile", tile, "--size", "160x120mm", "--out", &out]);
        let svg = std::fs::read_to_string(folder.join(&out)).unwrap();
        assert!(svg.contains("width=\"160mm\" height=\"120mm\""), "{tile}");
        assert!(!svg.contains("<image"), "{tile} is drawn, not photographed");
        let words = words(&svg);
        assert!(words.iter().any(|text| text == unit), "{tile} {unit}: {words:?}");
        assert!(
            words.iter().any(|text| text.starts_with("Stuttgart, south, 21 Mar 12:00, clear")),
            "{tile}: {words:?}"
        );
        assert!(words.iter().any(|text| text == concat!("cfs ", env!("CARGO_PKG_VERSION"))), "{tile}: {words:?}");
        let head = words.iter().find(|text| text.contains(" – ")).unwrap();
        assert!(head.contains("enetian") && head.ends_with('°'), "{head}");
        if tile == "room" {
            assert!(words.concat().contains(&format!("mean {mean} · min ")), "{mean}: {words:?}");
            assert!(words.iter().any(|text| text == "300 lx"), "{words:?}");
        }
        // Nothing is written beyond the paper: 640 × 480 units.
        let tree = roxmltree::Document::parse(&svg).unwrap();
        for node in tree.descendants().filter(|node| node.has_tag_name("text")) {
            let number = |name: &str| node.attribute(name).unwrap().parse::<f64>().unwrap();
            let wide = cfs::drawing::font::width(node.text().unwrap(), number("font-size"));
            let share = match node.attribute("text-anchor") {
                Some("start") => 0.0,
                Some("end") => 1.0,
                _ => 0.5,
            };
            let (x, y) = (number("x"), number("y"));
            assert!((0.0..=480.0).contains(&y), "{tile}: {:?}", node.text());
            if node.attribute("transform").is_none() {
                let left = x - share * wide;
                assert!(left >= -0.5 && left + wide <= 640.5, "{tile}: {:?} {left} {wide}", node.text());
            }
        }
    }
    succeed(folder, &["picture", "s.toml", "--tile", "room", "--size", "800x500", "--print", "--out", "room.png"]);
    let png = image::load_from_memory(&std::fs::read(folder.join("room.png")).unwrap()).unwrap();
    assert_eq!((png.width(), png.height()), (800, 500));
}

#[test]
fn what_cannot_be_a_picture_or_a_report_is_refused_in_a_line() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(
        folder.join("s.toml"),
        SCENE.replace("\"controlled\"", "\"45\"").replace("[control]\nmode = \"cut-off\"\n", ""),
    )
    .unwrap();
    let still = SCENE.replace(
        "{ catalogue = \"venetian-80-72\", state = \"controlled\" }",
        "{ ideal = \"diffuse\", transmittance = 0.5 }",
    );
    std::fs::write(folder.join("still.toml"), still.replace("[control]\nmode = \"cut-off\"\n", "")).unwrap();
    for (arguments, wrong) in [
        (&["picture", "still.toml", "--tile", "control", "--out", "a.svg"][..], "no control"),
        (&["picture", "s.toml", "--tile", "plan", "--out", "a.svg"], "expected one of btdf, transmittance"),
        (&["picture", "s.toml", "--tile", "room", "--size", "90x90", "--out", "a.svg"], "expected e.g. 1600x1200"),
        (&["picture", "s.toml", "--tile", "room", "--out", "a.jpg"], ".svg or .png"),
        (&["report", "still.toml", "--out", "a.doc"], "written as .pdf"),
        (&["report", "still.toml", "--sheet", "--tender", "t.txt", "--out", "a.pdf"], "{colour} is not a field"),
        (&["report", "no-such-product", "--out", "a.pdf"], "no-such-product"),
    ] {
        std::fs::write(folder.join("t.txt"), "{name} in {colour}").unwrap();
        let said = refuse(folder, arguments);
        assert!(said.contains(wrong), "{arguments:?}: {said}");
        for name in ["a.svg", "a.jpg", "a.pdf", "a.doc"] {
            assert!(!folder.join(name).exists());
        }
    }
}

/// What a program of poppler says of a file; `None` where it is not installed.
#[track_caller]
fn poppler(folder: &Path, program: &str, arguments: &[&str]) -> Option<String> {
    match Command::new(program).args(arguments).current_dir(folder).output() {
        Ok(output) => {
            assert!(output.status.success(), "{program}: {}", String::from_utf8_lossy(&output.stderr));
            Some(String::from_utf8(output.stdout).unwrap())
        }
        Err(_) => {
            not_looked_at("poppler's programs are not installed");
            None
        }
    }
}

#[test]
fn reports_hold_the_figures_as_text_in_an_embedded_font() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("s.toml"), SCENE).unwrap();
    let mean = mean(&succeed(folder, &["room", "s.toml"]));
    let question = "Reicht das Licht für Büroarbeit ohne Blendung?";
    succeed(folder, &["report", "s.toml", "--title", "Büro Süd", "--question", question, "--out", "study.pdf"]);
    succeed(folder, &["report", "s.toml", "--sheet", "--out", "sheet.pdf"]);
    for name in ["study.pdf", "sheet.pdf"] {
        assert!(std::fs::read(folder.join(name)).unwrap().starts_with(b"%PDF-"));
        let Some(fonts) = poppler(folder, "pdffonts", &[name]) else { return };
        // A table's row: name, type, encoding, embedded, subset, unicode.
        let rows: Vec<&str> = fonts.lines().skip(2).collect();
        assert!(
            !rows.is_empty() && rows.iter().all(|row| row.contains("DejaVuSans") && row.contains("yes yes yes")),
            "{fonts}"
        );
    }
    let Some(study) = poppler(folder, "pdftotext", &["-layout", "study.pdf", "-"]) else { return };
    for text in ["Büro Süd", question, &mean, "uniformity", "Stuttgart, south, 21 Mar 12:00", "page 1 of", "Accuracy"]
    {
        assert!(study.contains(text), "{text}: {study}");
    }
    let Some(sheet) = poppler(folder, "pdftotext", &["-layout", "sheet.pdf", "-"]) else { return };
    for text in
        ["Product sheet", "τ, normal incidence", "Tender text", "Visible transmittance at normal incidence", "Data"]
    {
        assert!(sheet.contains(text), "{text}: {sheet}");
    }
    assert!(!sheet.contains('{'), "no field is left open");
    // The shipped template is printed for a start.
    assert!(succeed(folder, &["report", "--template"]).contains("{tau_normal}"));
}

/// The same scene with two candidates.
fn compared() -> String {
    format!(
        "{SCENE}\n[[compare]]\nname = \"Blind, cut-off\"\nsystem = {{ catalogue = \"venetian-80-72\", state = \"controlled\" }}\n\
         control = {{ mode = \"cut-off\" }}\n[[compare]]\nname = \"Opal\"\nsystem = {{ ideal = \"diffuse\", transmittance = 0.5 }}\n"
    )
}

#[test]
fn a_study_tells_its_candidates_as_the_table_does_and_draws_them_on_one_scale() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("s.toml"), compared()).unwrap();
    std::fs::write(folder.join("alone.toml"), SCENE).unwrap();
    succeed(folder, &["report", "s.toml", "--out", "study.pdf"]);
    succeed(folder, &["report", "alone.toml", "--out", "alone.pdf"]);
    let said = refuse(folder, &["report", "s.toml", "--base", "3", "--out", "a.pdf"]);
    assert!(said.contains("--base 3") && said.contains("1 to 2") && !folder.join("a.pdf").exists(), "{said}");
    let table: serde_json::Value = serde_json::from_str(&succeed(folder, &["compare", "s.toml", "--json"])).unwrap();
    let plain = succeed(folder, &["compare", "s.toml"]);
    let Some(study) = poppler(folder, "pdftotext", &["-layout", "study.pdf", "-"]) else { return };
    let Some(alone) = poppler(folder, "pdftotext", &["-layout", "alone.pdf", "-"]) else { return };
    for text in
        ["1 Blind, cut-off", "2 Opal", "Side by side on one scale: Room", "Difference from 1 Blind, cut-off: Room"]
    {
        assert!(study.contains(text) && !alone.contains(text), "{text}: {study}");
    }
    // The figures are those of the table, to the digit.
    let row = |text: &str, name: &str| -> Vec<String> {
        let line = text.lines().map(str::trim).find(|line| line.starts_with(name));
        let line = line.unwrap_or_else(|| panic!("{name}: {text}"));
        line[name.len()..].split("  ").map(|cell| cell.trim().trim_start_matches("▲ ").to_owned()).collect()
    };
    for name in ["Mean illuminance / lx", "Minimum illuminance / lx", "Luminous flux / lm", "Uniformity U_o"] {
        let cells = |text: &str| row(text, name).into_iter().filter(|cell| !cell.is_empty()).collect::<Vec<_>>();
        let (wanted, found) = (cells(&plain), cells(&study));
        assert!(wanted.len() >= 3 && found[..2] == wanted[..2], "{name}: {wanted:?} {found:?}");
    }
    // Marked is what is better beyond the errors, and nothing else.
    let figures = table["figures"].as_array().unwrap();
    let better: usize = figures.iter().map(|figure| figure["better"].as_array().unwrap().len()).sum();
    let marks = study.lines().filter(|line| !line.contains("marks values")).map(|line| line.matches('▲').count());
    assert_eq!(marks.sum::<usize>(), better);
    assert!(better > 0);
}

#[test]
fn reports_and_pictures_speak_german_where_they_are_asked_to() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("s.toml"), compared()).unwrap();
    let german = |arguments: &[&str]| succeed(folder, &[arguments, &["--language", "de"]].concat());
    german(&["picture", "s.toml", "--tile", "room", "--out", "room.svg"]);
    let words = words(&std::fs::read_to_string(folder.join("room.svg")).unwrap());
    assert!(words.iter().any(|text| text.starts_with("Raum – ")), "{words:?}");
    assert!(words.iter().any(|text| text.starts_with("Stuttgart, Süd, 21. März 12:00 Uhr, klar")), "{words:?}");
    assert!(
        refuse(folder, &["picture", "s.toml", "--tile", "room", "--language", "fr", "--out", "a.svg"])
            .contains("en or de")
    );
    german(&["report", "s.toml", "--out", "study.pdf"]);
    german(&["report", "s.toml", "--sheet", "--out", "sheet.pdf"]);
    assert!(german(&["report", "--template"]).contains("Hersteller: {maker}"));
    for name in ["study.pdf", "sheet.pdf"] {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        let holds = |text: &str| bytes.windows(text.len()).any(|part| part == text.as_bytes());
        assert!(
            holds("<dc:language><rdf:Bag><rdf:li>de</rdf:li></rdf:Bag></dc:language>")
                || holds("/Lang (de)")
                || holds("/Lang(de)"),
            "{name}"
        );
    }
    let headings: [(&str, &[&str], &[&str]); 2] = [
        (
            "study.pdf",
            &[
                "Tageslichtstudie",
                "Kennwerte",
                "Bilder",
                "Vergleich",
                "Genauigkeit",
                "Beleuchtungsstärke",
                "Seite 1 von",
            ],
            &["Daylight study", "Figures", "Pictures", "Comparison", "Accuracy", "uniformity", "page 1 of"],
        ),
        (
            "sheet.pdf",
            &[
                "Produktblatt",
                "Verteilung des durchgelassenen Lichts",
                "Stellungen",
                "Anwendungsbeispiel",
                "Ausschreibungstext",
                "Lichttransmissionsgrad",
            ],
            &[
                "Product sheet",
                "Distribution of transmitted light",
                "Application example",
                "Tender text",
                "normal incidence",
                "Manufacturer",
            ],
        ),
    ];
    for (name, wanted, unwanted) in headings {
        let Some(text) = poppler(folder, "pdftotext", &["-layout", name, "-"]) else { return };
        for word in wanted {
            assert!(text.contains(word), "{name}, {word}: {text}");
        }
        for word in unwanted {
            assert!(!text.contains(word), "{name}, {word}: {text}");
        }
        // Figures have their comma: of the lines that tell one, none has a point between digits.
        let pointed = |line: &str| {
            let bytes = line.as_bytes();
            bytes.windows(3).any(|three| three[0].is_ascii_digit() && three[1] == b'.' && three[2].is_ascii_digit())
        };
        let told = |line: &&str| {
            ["τ,", "Gleichmäßigkeit", "Mittlere", "τ senkrecht"].iter().any(|word| line.trim().starts_with(word))
        };
        let lines: Vec<&str> = text.lines().filter(told).collect();
        assert!(lines.iter().any(|line| line.contains(',')) && !lines.iter().any(|line| pointed(line)), "{lines:?}");
    }
}

#[test]
fn a_product_sheet_tells_how_far_its_figures_may_be_off() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    succeed(folder, &["report", "venetian-80-72", "--state", "45", "--out", "sheet.pdf"]);
    let figures = succeed(folder, &["compare", "venetian-80-72:45", "clear-double"]);
    let Some(sheet) = poppler(folder, "pdftotext", &["-layout", "sheet.pdf", "-"]) else { return };
    let line = figures.lines().find(|line| line.starts_with("τ hemispherical")).unwrap();
    let value = line["τ hemispherical".len()..].trim().split("  ").next().unwrap();
    assert!(value.contains(" ± ") && sheet.contains(value), "{value}: {sheet}");
}

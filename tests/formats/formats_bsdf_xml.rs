//! The BSDF XML reader and writer on small files made here: axes, structures, repairs, refusals, round trips.

use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{AngularTransmittance, Band, Btdf, Component, Dataset, Scattered};
use cfs::compute::direction::{Dir, Emergent, Facade, Incident};
use cfs::compute::doctor::examine;
use cfs::formats::bsdf_xml::{read, write, write_matrices};
use std::fmt::Write as _;

/// Five directions: the normal and right, up, left, down in Klems azimuth.
const RINGS: [(f64, f64, usize); 2] = [(0.0, 30.0, 1), (30.0, 90.0, 4)];
const N: usize = 5;

/// Projected solid angles of the five cells, in closed form.
fn weights() -> [f64; N] {
    let pi = std::f64::consts::PI;
    let outer = pi * 0.75 / 4.0;
    [pi * 0.25, outer, outer, outer, outer]
}

struct File {
    structure: &'static str,
    blocks: Vec<(&'static str, &'static str, String)>,
}

impl File {
    fn matrix(blocks: &[(&'static str, &'static str, [[f64; N]; N])]) -> Self {
        let text = |rows: &[[f64; N]; N]| {
            rows.iter().map(|row| row.map(|v| v.to_string()).join(",\t")).collect::<Vec<_>>().join(",\n")
        };
        Self { structure: "Columns", blocks: blocks.iter().map(|(band, name, m)| (*band, *name, text(m))).collect() }
    }

    fn tree(rank: &'static str, name: &'static str, data: &str) -> Self {
        Self { structure: rank, blocks: vec![("Visible", name, data.to_owned())] }
    }

    fn xml(&self) -> String {
        let mut xml = String::from(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<WindowElement xmlns=\"http://windows.lbl.gov\">\n",
        );
        xml +=
            "<WindowElementType>System</WindowElementType>\n<FileType>BSDF</FileType>\n<Optical><Layer>\n<Material>\n";
        xml += "<Name> Sample &amp; Co </Name><Manufacturer>\n\tMaker\n</Manufacturer>";
        xml += "<Thickness unit=\"miLLimeter\">12</Thickness></Material>\n<DataDefinition>\n";
        write!(
            xml,
            "<IncidentDataStructure>{}</IncidentDataStructure>\n<AngleBasis><AngleBasisName>Five</AngleBasisName>\n",
            self.structure
        )
        .unwrap();
        for (low, high, n) in RINGS {
            writeln!(xml, "<AngleBasisBlock><nPhis>{n}</nPhis><ThetaBounds><LowerTheta>{low}</LowerTheta><UpperTheta>{high}</UpperTheta></ThetaBounds></AngleBasisBlock>").unwrap();
        }
        xml += "</AngleBasis></DataDefinition>\n";
        let bases = if self.structure.starts_with("Tensor") {
            "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>"
        } else {
            "<ColumnAngleBasis>Five</ColumnAngleBasis><RowAngleBasis>Five</RowAngleBasis>"
        };
        for (band, name, data) in &self.blocks {
            write!(xml, "<WavelengthData><Wavelength unit=\"Integral\">{band}</Wavelength><WavelengthDataBlock>\n<WavelengthDataDirection>{name}</WavelengthDataDirection>{bases}<ScatteringData>\n{data}\n</ScatteringData></WavelengthDataBlock></WavelengthData>\n").unwrap();
        }
        xml + "</Layer></Optical></WindowElement>\n"
    }
}

/// One value at (row, column).
fn single(row: usize, column: usize, value: f64) -> [[f64; N]; N] {
    let mut matrix = [[0.0; N]; N];
    matrix[row][column] = value;
    matrix
}

/// A plausible matrix without any symmetry; column sums below 1.
fn uneven() -> [[f64; N]; N] {
    std::array::from_fn(|r| std::array::from_fn(|c| 0.01 * (1 + (r * 7 + c * 3) % 11) as f64))
}

fn front(dataset: &Dataset) -> &Btdf {
    dataset.transmission().expect("a front transmission")
}

fn towards(theta_deg: f64, phi_deg: f64) -> Dir<Facade> {
    Dir::from_theta_phi(theta_deg.to_radians(), phi_deg.to_radians())
}

fn codes(dataset: &Dataset) -> Vec<&'static str> {
    examine(dataset).iter().map(|one| one.finding.code).collect()
}

#[test]
fn columns_are_incident_and_klems_azimuths_follow_the_light_seen_from_the_room() {
    // Light that travels downwards (Klems 270, cell 4: from a sun above) is sent to the right (Klems 0, cell 1).
    let dataset = read(File::matrix(&[("Visible", "Transmission Front", single(1, 4, 0.5))]).xml().as_bytes()).unwrap();
    let sun_above = Incident(towards(60.0, 90.0));
    // Seen from the room, right is −x of the façade frame, whose x runs right seen from outside: Klems (cos, sin)
    // lies along (+x, −y) of the through-name and so the light itself goes to −x.
    let to_the_right_from_inside = Emergent(Dir::new(glam::DVec3::new(-0.8, 0.0, -0.6)).unwrap());
    assert_eq!(front(&dataset).q(sun_above, to_the_right_from_inside), 0.5);
    assert!((front(&dataset).tau(sun_above) - 0.5 * weights()[1]).abs() < 1e-12);
    assert_eq!(front(&dataset).tau(Incident(towards(60.0, 270.0))), 0.0);
    assert_eq!((dataset.name.as_str(), dataset.manufacturer.as_str()), ("Sample & Co", "Maker"));
    assert_eq!(dataset.thickness, Some(0.012));
}

#[test]
fn rows_are_the_transpose_of_columns() {
    let mut rows = File::matrix(&[("Visible", "Transmission Front", single(4, 1, 0.5))]);
    rows.structure = "Rows";
    let columns = File::matrix(&[("Visible", "Transmission Front", single(1, 4, 0.5))]);
    assert_eq!(read(rows.xml().as_bytes()).unwrap().visible, read(columns.xml().as_bytes()).unwrap().visible);
}

#[test]
fn a_missing_front_comes_from_the_back_turned_by_180_degrees() {
    // T_front[o, i] = T_back[i′, o′], the prime turning Klems azimuths by 180° within the ring.
    let back = uneven();
    let turn = [0, 3, 4, 1, 2];
    let expected: [[f64; N]; N] = std::array::from_fn(|o| std::array::from_fn(|i| back[turn[i]][turn[o]]));
    let derived = read(File::matrix(&[("Visible", "Transmission Back", back)]).xml().as_bytes()).unwrap();
    let direct = read(File::matrix(&[("Visible", "Transmission Front", expected)]).xml().as_bytes()).unwrap();
    assert_eq!(front(&derived), front(&direct));
    assert_eq!(derived.derived, [Component::TransmissionFront]);
    assert!(codes(&derived).contains(&"front-by-reciprocity"));
    // And the two together are reciprocal.
    let both = File::matrix(&[("Visible", "Transmission Front", expected), ("Visible", "Transmission Back", back)]);
    let both = read(both.xml().as_bytes()).unwrap();
    assert!(examine(&both).iter().any(|one| one.finding.message.contains("is excellent")));
}

#[test]
fn the_same_numbers_in_every_dress() {
    let plain =
        File::matrix(&[("Solar", "Transmission Front", uneven()), ("Visible", "Transmission Front", uneven())]).xml();
    let expected = read(plain.as_bytes()).unwrap();
    assert!(expected.solar.is_some());
    let utf16: Vec<u8> = [0xFF, 0xFE].into_iter().chain(plain.encode_utf16().flat_map(u16::to_le_bytes)).collect();
    let dresses: Vec<Vec<u8>> = vec![
        plain.replace('\n', "\r\n").into_bytes(),
        [&[0xEF, 0xBB, 0xBF], plain.as_bytes()].concat(),
        format!("Recover using: genBSDF -recover x\n{plain}").into_bytes(),
        plain
            .replace("<ScatteringData>", "<ScatteringData><![CDATA[")
            .replace("</ScatteringData>", "]]><!-- end --></ScatteringData>")
            .into_bytes(),
        plain.replace("http://windows.lbl.gov", "http://www.ise.fraunhofer.de").into_bytes(),
        plain.replace("AngleBasis>Five", "AngleBasis>fIVE").into_bytes(),
        plain.replace(">Visible<", ">\r\n\t\tvisible\t<").into_bytes(),
        plain.replace(",\t", " ").replace(",\n", "\n\n").into_bytes(),
        utf16.clone(),
        utf16[2..].to_vec(),
        plain.replace('\n', "\r").into_bytes(),
        [b"<!-- \xe9 -->\n", plain.as_bytes()].concat(),
    ];
    for (k, dress) in dresses.iter().enumerate() {
        let got = read(dress).unwrap_or_else(|error| panic!("dress {k}: {error}"));
        assert_eq!(got.visible, expected.visible, "dress {k}");
        assert_eq!(got.solar, expected.solar, "dress {k}");
    }
}

/// A `WavelengthData` element of a layer.
fn of_layer(layer: &str, direction: &str, data: &str) -> String {
    format!(
        "<WavelengthData><LayerNumber>{layer}</LayerNumber><Wavelength>Visible</Wavelength><WavelengthDataBlock>\
         <WavelengthDataDirection>{direction}</WavelengthDataDirection><ColumnAngleBasis>Five</ColumnAngleBasis>\
         <RowAngleBasis>Five</RowAngleBasis><ScatteringData>{data}</ScatteringData></WavelengthDataBlock></WavelengthData>"
    )
}

#[test]
fn data_of_layers_are_not_those_of_the_system() {
    let plain = File::matrix(&[("Visible", "Transmission Front", uneven())]).xml();
    let with = |more: &str| plain.replacen("<WavelengthData>", &format!("{more}<WavelengthData>"), 1);
    let absorbed = of_layer("1", "Absorbed Front", "0.1 0.1 0.1 0.1 0.2") + &of_layer("System", "Absorbed Back", "0.1");
    let layer = of_layer("2", "Transmission Front", &"0.1 ".repeat(N * N));
    let expected = read(plain.as_bytes()).unwrap();
    for (more, code) in [(absorbed, "absorbed-not-read"), (layer.clone(), "layers-not-read")] {
        let got = read(with(&more).as_bytes()).unwrap();
        assert_eq!(got.visible, expected.visible, "{code}");
        assert_eq!(codes(&got).iter().filter(|one| **one == code).count(), 1, "{code}");
    }
    // One layer alone is the system; of two, neither is.
    let system = plain.find("<WavelengthData>").unwrap();
    let end = plain.find("</Layer>").unwrap();
    let alone = [&plain[..system], &layer, &plain[end..]].concat();
    // The sum of q over the projected hemisphere, 0.1 · π.
    assert!((front(&read(alone.as_bytes()).unwrap()).tau_normal() - 0.1 * std::f64::consts::PI).abs() < 1e-12);
    let other = of_layer("3", "Transmission Front", &"0.1 ".repeat(N * N));
    let error = read([&plain[..system], &layer, &other, &plain[end..]].concat().as_bytes()).unwrap_err().to_string();
    assert!(error.contains("layers 2, 3 and none of the system"), "{error}");
}

#[test]
fn a_transmission_without_a_side_is_that_of_both() {
    for rank in ["TensorTree3", "TensorTree4"] {
        // A Lambertian sheet of q = 0.5/π transmits one half.
        let half = read(File::tree(rank, "Transmission", "{ 0.15915494309 }").xml().as_bytes()).unwrap();
        assert!((front(&half).tau_hemispherical() - 0.5).abs() < 1e-9 && codes(&half).contains(&"side-not-told"));
        assert!(half.visible.transmission_back.is_some());
    }
    let leaves: Vec<String> = (0..16).map(|k| format!("{{{}}}", 0.01 * f64::from(k))).collect();
    let tree = format!("{{{}}}", leaves.concat());
    let visible = |name| read(File::tree("TensorTree4", name, &tree).xml().as_bytes()).unwrap().visible;
    assert_eq!(visible("Transmission"), visible("Transmission Back"));
    // Traced from outside alone, it has the reflection of the outside beside it.
    let mut file = File::tree("TensorTree4", "Transmission", &tree);
    file.blocks.push(("Visible", "Reflection Front", "{ 0.1 }".to_owned()));
    let from_outside = read(file.xml().as_bytes()).unwrap().visible;
    assert_eq!(from_outside.transmission_front, visible("Transmission Front").transmission_front);
}

#[test]
fn a_back_of_one_number_is_a_placeholder_unless_it_agrees_with_the_front() {
    let both = |front, back| {
        let blocks = [("Visible", "Transmission Front", front), ("Visible", "Transmission Back", back)];
        read(File::matrix(&blocks).xml().as_bytes()).unwrap()
    };
    for number in [1e-4, 1.0 / std::f64::consts::PI] {
        let left_out = both(uneven(), [[number; N]; N]);
        assert!(left_out.visible.transmission_back.is_none() && codes(&left_out).contains(&"back-placeholder"));
    }
    let measured = both([[0.16; N]; N], [[0.155; N]; N]);
    assert!(measured.visible.transmission_back.is_some() && !codes(&measured).contains(&"back-placeholder"));
}

#[test]
fn repairs_and_doubts_are_told() {
    let xml = |name, m| File::matrix(&[("Visible", name, m)]).xml();
    let mut negative = uneven();
    negative[2][2] = -1.2e-4;
    let cases = [
        (xml("Transmission Front", negative).into_bytes(), "negative-values"),
        (format!("junk\n{}", xml("Transmission Front", uneven())).into_bytes(), "junk-before-xml"),
        (xml("Transmission Front", [[0.0; N]; N]).into_bytes(), "opaque"),
        (xml("Reflection Back", uneven()).into_bytes(), "no-transmission"),
        (xml("Transmission Front", [[1.02 / std::f64::consts::PI; N]; N]).into_bytes(), "energy-above-one"),
        (
            File::matrix(&[("Visible", "Transmission Front", uneven()), ("Visible", "Reflection Front", uneven())])
                .xml()
                .into_bytes(),
            "block-mislabelled",
        ),
        (
            File::matrix(&[
                ("Visible", "Transmission Front", uneven()),
                ("Visible", "Transmission Back", [[0.0; N]; N]),
            ])
            .xml()
            .into_bytes(),
            "back-placeholder",
        ),
        (
            File::matrix(&[
                ("Visible", "Transmission Front", uneven()),
                ("Visible", "Transmission Back", single(0, 0, 0.4)),
            ])
            .xml()
            .into_bytes(),
            "reciprocity",
        ),
        (
            xml("Transmission Front", uneven())
                .replace("Sample", "\u{1}")
                .into_bytes()
                .iter()
                .map(|b| if *b == 1 { 0xE9 } else { *b })
                .collect(),
            "encoding-repaired",
        ),
        (xml("Transmission Front", uneven()).into_bytes(), "unknown-basis-name"),
    ];
    for (bytes, code) in cases {
        let dataset = read(&bytes).unwrap_or_else(|error| panic!("{code}: {error}"));
        assert!(codes(&dataset).contains(&code), "{code} not in {:?}", dataset.findings);
    }
}

#[test]
fn refusals_name_the_place_and_what_would_be_right() {
    let good =
        File::matrix(&[("Visible", "Transmission Front", uneven()), ("Visible", "Transmission Back", uneven())]).xml();
    let first = uneven()[0][0].to_string();
    let swap = |from: &str, to: &str| good.replacen(from, to, 1);
    let data = "<ScatteringData>\n";
    let cases: Vec<(String, &str)> = vec![
        (String::new(), "empty"),
        ("no xml at all".into(), "not XML"),
        (good[..good.len() - 20].into(), "truncated"),
        (good.replace("WindowElement", "DoorElement"), "<WindowElement>"),
        (swap(data, "<ScatteringData>\n0.1 "), "26 numbers; expected 25 numbers"),
        (swap(&format!("{data}{first},"), data), "24 numbers; expected 25 numbers"),
        (swap(&format!("{data}{first}"), &format!("{data}nan")), "value 1 is 'nan', not a finite number"),
        (swap(&format!("{data}{first}"), &format!("{data}1e999")), "not a finite number"),
        (swap(&format!("{data}{first}"), &format!("{data}1.5D-03")), "'1.5D-03', not a number"),
        (
            swap(&format!("{data}{first}"), &format!("{data}1e308")),
            "which no cell can have; expected values of at most 1e9",
        ),
        (swap(&format!("{data}{first}"), &format!("{data}-0.5")), "negative values"),
        (good.replace("Transmission Back", "Transmission Front"), "duplicate block Transmission Front (Visible)"),
        (swap("Transmission Back", "Transmission Up"), "unknown WavelengthDataDirection 'Transmission Up'"),
        (good.replace(">Visible<", ">Solar<"), "only a Solar band"),
        (swap("Columns", "Diagonals"), "IncidentDataStructure 'Diagonals'"),
        (swap("<nPhis>4", "<nPhis>5"), "25 numbers; expected 36 numbers"),
        (swap("<nPhis>4", "<nPhis>1e9"), "1 to 7200"),
        (swap("<LowerTheta>30", "<LowerTheta>40"), "where the ring before ends"),
        (good.replace(">Five<", ">LBNL/Klems Quarter<"), "with a list of 5 directions"),
        (swap("<ColumnAngleBasis>Five", "<ColumnAngleBasis>Six"), "unknown angle basis 'Six'"),
        (
            swap(
                "<?xml version=\"1.0\" encoding=\"UTF-8\"?>",
                "<?xml version=\"1.0\"?><!DOCTYPE x [<!ENTITY a \"b\">]>",
            ),
            "document type declaration",
        ),
        (swap("<Material>", &format!("<Material {}>", "a='' ".repeat(10_000))), "attributes"),
        (swap("<Material>", &"<Material>".repeat(100_000)), "nested more than"),
        (swap("<Material>", &"<Material a='/>'>".repeat(100_000)), "nested more than"),
    ];
    for (xml, gist) in cases {
        let message = read(xml.as_bytes()).expect_err(gist).to_string();
        assert!(message.contains(gist), "wanted '{gist}' in '{message}'");
        assert_eq!(message.lines().count(), 1);
    }
}

#[test]
fn no_prefix_and_no_flipped_byte_of_a_file_makes_it_panic() {
    let good = File::matrix(&[("Visible", "Transmission Front", uneven())]).xml().into_bytes();
    for end in 0..good.len() {
        drop(read(&good[..end]));
    }
    for at in 0..good.len() {
        let mut bad = good.clone();
        bad[at] ^= 0x15;
        drop(read(&bad));
    }
}

#[test]
fn a_rank_4_tree_stands_as_klems_azimuths_do() {
    // Incident square: upper half of its second coordinate, lit; that is Klems azimuth 0…180 as for matrices: light
    // travelling upwards, from below outside.
    let leaf = |child: usize| if child >> 1 & 1 == 1 { "{ 0.2 }" } else { "{ 0 }" };
    let data = format!("{{ {} }}", (0..16).map(leaf).collect::<Vec<_>>().join(" "));
    let dataset = read(File::tree("TensorTree4", "Transmission Front", &data).xml().as_bytes()).unwrap();
    let tau = |phi| front(&dataset).tau(Incident(towards(40.0, phi)));
    assert!((tau(270.0) - 0.2 * std::f64::consts::PI).abs() < 1e-12 && tau(90.0) == 0.0);
    // The same halves as a back block: Klems azimuths for light from inside, then turned by reciprocity.
    let dataset = read(File::tree("TensorTree4", "Transmission Back", &data).xml().as_bytes()).unwrap();
    let upwards = Emergent::from_undeviated(towards(40.0, 90.0));
    let downwards = Emergent::from_undeviated(towards(40.0, 270.0));
    // Back: light inside travelling upwards goes anywhere. Front: light from anywhere leaves against that way.
    let any = Incident(towards(20.0, 123.0));
    assert!((front(&dataset).q(any, upwards) - 0.2).abs() < 1e-12 && front(&dataset).q(any, downwards) == 0.0);
}

#[test]
fn broken_trees_are_refused() {
    for (data, gist) in [
        ("{{1}{1}", "before the end"),
        ("{ 1 2 3 }", "3 numbers in one leaf"),
        ("{ 1", "unbalanced"),
        ("{ inf }", "finite"),
        ("{ 1 } 2", "after the tree"),
    ] {
        let xml = File::tree("TensorTree3", "Transmission Front", data).xml();
        let message = read(xml.as_bytes()).expect_err(gist).to_string();
        assert!(message.contains(gist), "wanted '{gist}' in '{message}'");
    }
}

#[test]
fn what_is_written_reads_back() {
    let source = File::matrix(&[
        ("Visible", "Transmission Front", uneven()),
        ("Visible", "Transmission Back", uneven()),
        ("Visible", "Reflection Back", single(3, 2, 0.7)),
        ("Solar", "Reflection Front", single(1, 2, 0.3)),
    ]);
    let dataset = read(source.xml().as_bytes()).unwrap();
    let again = read(&write(&dataset).unwrap().bytes).unwrap();
    assert_eq!(
        (&again.name, &again.manufacturer, again.thickness),
        (&dataset.name, &dataset.manufacturer, dataset.thickness)
    );
    for (a, b) in [(&again.visible, &dataset.visible), (again.solar.as_ref().unwrap(), dataset.solar.as_ref().unwrap())]
    {
        assert_eq!(a.components(), b.components());
        for component in b.components() {
            let (Some(Scattered::Cells(x)), Some(Scattered::Cells(y))) =
                (&a.get(component).unwrap().scattered, &b.get(component).unwrap().scattered)
            else {
                panic!("matrices")
            };
            assert!(x.values().iter().zip(y.values().iter()).all(|(x, y)| (x - y).abs() <= 1e-8 * y), "{component:?}");
        }
    }
}

#[test]
fn closed_forms_keep_their_transmittance_in_a_file() {
    let schlick = AngularTransmittance::sample(90, |theta| 0.9 * (1.0 - (1.0 - theta.cos()).powi(5)));
    let pane = Btdf {
        regular: Some(schlick.clone()),
        scattered: Some(Scattered::Lambert(AngularTransmittance::Constant(0.05))),
    };
    let expected = schlick.hemispherical() + 0.05;
    let visible = Band { transmission_front: Some(pane), ..Band::default() };
    let written = write(&Dataset { visible, ..Dataset::default() }).unwrap();
    assert!(written.findings.iter().any(|finding| finding.code == "regular-in-cells"));
    let again = read(&written.bytes).unwrap();
    assert!((front(&again).tau_hemispherical() - expected).abs() < 1e-4);
    assert_eq!(front(&again).incident_basis().rings(), RingBasis::klems_full(AzimuthMap::KLEMS_FRONT).rings());
    // Straight light is on the diagonal.
    let sun = Incident(towards(40.0, 90.0));
    assert!(front(&again).q(sun, Emergent::from_undeviated(sun.0)) > 10.0);
}

#[test]
fn a_tree_keeps_its_flux_on_klems_cells() {
    let grid = |k: usize| {
        format!(
            "{{ {} }}",
            (0..16).map(|j| (0.01 * ((k * 5 + j * 3) % 13) as f64).to_string()).collect::<Vec<_>>().join(" ")
        )
    };
    let data = format!("{{ {} }}", (0..16).map(grid).collect::<Vec<_>>().join("\n"));
    let tree = read(File::tree("TensorTree4", "Transmission Front", &data).xml().as_bytes()).unwrap();
    let klems = read(&write_matrices(&tree).unwrap().bytes).unwrap();
    let (a, b) = (front(&tree).tau_hemispherical(), front(&klems).tau_hemispherical());
    assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
    // Well inside one of the tree's cells both say the same.
    let (sun, out) = (Incident(towards(40.0, 75.0)), Emergent::from_undeviated(towards(50.0, 105.0)));
    let (a, b) = (front(&tree).q(sun, out), front(&klems).q(sun, out));
    assert!((a / b - 1.0).abs() < 0.02, "{a} {b}");
}

#[test]
fn the_templates_own_words_are_no_name() {
    let xml = File::matrix(&[("Visible", "Transmission Front", single(1, 4, 0.5))])
        .xml()
        .replace("<Name> Sample &amp; Co </Name>", "<Name>\n Name </Name>");
    let dataset = read(xml.as_bytes()).unwrap();
    assert_eq!((dataset.name.as_str(), dataset.manufacturer.as_str()), ("", "Maker"));
    assert!(codes(&dataset).contains(&"template-word"));
}

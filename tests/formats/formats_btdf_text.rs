//! Measured datasets as text: orientation, layouts, symmetry, families, round trips, hostile files.

use crate::btdf_text::{File, function, names, uneven, vector};
use crate::common::{data, left_out};
use cfs::catalogue::{Catalogue, Grouping, Origin, SourceFile, check, gather};
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{Band, Btdf, CellMatrix, Component, Dataset, Scattered, Severity, reciprocity_error};
use cfs::compute::direction::{Dir, Emergent, Incident};
use cfs::formats::btdf_text::{read, write, write_component};
use cfs::formats::{Format, merge_sides, read_dataset, write_dataset};
use glam::DVec3;
use std::f64::consts::PI;

#[test]
fn light_from_above_right_to_below_left_stays_so() {
    // One incidence, one bright cell, all four functions; by bits: right/left and up/down each decided alone.
    for component in Component::ALL {
        for (phi_e, phi_a) in [(45.0, 225.0), (45.0, 135.0), (45.0, 315.0), (45.0, 45.0), (225.0, 90.0)] {
            let mut file = File::new(component);
            let inside = matches!(component, Component::TransmissionBack | Component::ReflectionBack);
            let theta_e = if inside { 130.0 } else { 50.0 };
            file.directions = vec![[theta_e, phi_e]];
            file.incidence = "listed";
            let (e, bright) = (vector(theta_e, phi_e), {
                let emergent_inward = matches!(component, Component::TransmissionFront | Component::ReflectionBack);
                vector(if emergent_inward { 135.0 } else { 45.0 }, phi_a)
            });
            let dataset = file.read(|_, a| if (a - bright).length() < 1e-9 { 0.3 } else { 0.0 });
            let btdf = function(&dataset, component);
            let (incident, name) = names(component, e, bright);
            let leaving = Emergent::from_undeviated(name);
            assert_eq!(btdf.q(incident, leaving), 0.3, "{component:?} {phi_e} {phi_a}");
            let v = name.vector();
            for wrong in [DVec3::new(-v.x, v.y, v.z), DVec3::new(v.x, -v.y, v.z), DVec3::new(-v.x, -v.y, v.z)] {
                let other = (wrong - v).length() > 0.3;
                assert!(!other || btdf.q(incident, Emergent::from_undeviated(Dir::from_unit(wrong))) == 0.0);
            }
            if component == Component::TransmissionFront {
                // In façade vectors, no names: what comes from (+x, +y, +z) leaves where the file says.
                assert_eq!(btdf.q(Incident(Dir::from_unit(e)), Emergent(Dir::from_unit(bright))), 0.3);
            }
            let again = read(&write_component(&dataset, component).unwrap().bytes).unwrap();
            assert_eq!(again.visible, dataset.visible);
        }
    }
}

#[test]
fn a_file_from_each_side_of_one_system_is_reciprocal() {
    let klems = |inside: bool| -> Vec<[f64; 2]> {
        RingBasis::klems_full(AzimuthMap::FACADE)
            .cells()
            .map(|cell| {
                let theta = cell.theta().to_degrees();
                [if inside { 180.0 - theta } else { theta }, cell.phi.to_degrees()]
            })
            .collect()
    };
    let limits = [0.0, 5.0, 15.0, 25.0, 35.0, 45.0, 55.0, 65.0, 75.0, 90.0];
    let sectors = [1.0, 8.0, 16.0, 20.0, 24.0, 24.0, 24.0, 16.0, 12.0];
    let rings = |inward: bool| -> Vec<[f64; 3]> {
        let pairs = limits.windows(2).zip(sectors);
        pairs.map(|(w, n)| if inward { [180.0 - w[1], 180.0 - w[0], n] } else { [w[0], w[1], n] }).rev().collect()
    };
    // Any function of the two ends of the light's path, each a direction away from the element.
    let path = |outer: DVec3, inner: DVec3| {
        assert!(outer.z > -1e-9 && inner.z < 1e-9);
        uneven(outer, inner)
    };
    let mut front =
        File { rings: rings(true), incidence: "klems-145", mean: true, ..File::new(Component::TransmissionFront) };
    front.directions = klems(false);
    let mut back = File { rings: rings(false), ..front.clone() };
    (back.component, back.directions) = (Component::TransmissionBack, klems(true));
    let (front, back) = (front.read(path), back.read(|e, a| path(a, e)));
    let error =
        reciprocity_error(function(&front, Component::TransmissionFront), function(&back, Component::TransmissionBack));
    assert!(error.unwrap() < 1e-12, "{error:?}");
    // Up and down exchanged on one side must be found.
    let upside_down = |e: DVec3, a: DVec3| path(a * DVec3::new(1.0, -1.0, 1.0), e);
    let mut wrong =
        File { rings: rings(false), incidence: "klems-145", mean: true, ..File::new(Component::TransmissionBack) };
    wrong.directions = klems(true);
    let wrong = wrong.read(upside_down);
    let error = reciprocity_error(
        function(&front, Component::TransmissionFront),
        function(&wrong, Component::TransmissionBack),
    );
    assert!(error.unwrap() > 0.1, "{error:?}");
    // Both files are one dataset.
    let merged = merge_sides(vec![front, back]);
    assert_eq!(merged.len(), 1);
    assert_eq!(merged[0].visible.components(), [Component::TransmissionFront, Component::TransmissionBack]);
    let said = check(&merged[0]);
    assert!(said.iter().all(|one| one.severity == Severity::Info), "{said:?}");
}

#[test]
fn values_stay_in_their_places_and_tau_is_their_sum() {
    for component in Component::ALL {
        let file = File::new(component);
        let dataset = file.read(uneven);
        let btdf = function(&dataset, component);
        let Some(Scattered::Directions(data)) = &btdf.scattered else { panic!("values at directions") };
        assert_eq!(data.lattice().unwrap().name(), "Tregenza 145");
        for [t, p] in file.directions.iter().step_by(17) {
            let mut tau = 0.0;
            for [a, b, n] in &file.rings {
                let weight = PI / n * (a.to_radians().cos().powi(2) - b.to_radians().cos().powi(2)).abs();
                let cap = *n == 1.0;
                let theta = if cap { if *a == 0.0 { 0.0 } else { 180.0 } } else { 0.5 * (a + b) };
                for k in 0..*n as usize {
                    let (e, out) = (vector(*t, *p), vector(theta, 360.0 * k as f64 / n));
                    let (incident, name) = names(component, e, out);
                    let q = btdf.q(incident, Emergent::from_undeviated(name));
                    assert_eq!(q, uneven(e, out), "{component:?} θ {t} φ {p} → {theta} {k}");
                    tau += weight * q;
                }
            }
            let (incident, _) = names(component, vector(*t, *p), DVec3::Z);
            assert!((btdf.tau(incident) - tau).abs() < 1e-12);
        }
        let again = read(&write_component(&dataset, component).unwrap().bytes).unwrap();
        assert_eq!(again.visible, dataset.visible, "{component:?}");
        assert_eq!(write_component(&again, component).unwrap(), write_component(&dataset, component).unwrap());
    }
}

#[test]
fn means_over_incident_cells_are_a_matrix_and_listed_means_are_refused() {
    let mut file = File { mean: true, ..File::new(Component::TransmissionFront) };
    // In any order of records.
    file.directions.reverse();
    file.directions.swap(3, 70);
    let dataset = file.read(uneven);
    let Some(Scattered::Cells(matrix)) = &function(&dataset, Component::TransmissionFront).scattered else { panic!() };
    assert_eq!(matrix.incident(), &RingBasis::tregenza());
    let sun = vector(36.0, 80.0);
    let down = vector(135.0, 270.0);
    let q = function(&dataset, Component::TransmissionFront)
        .q(Incident(Dir::from_unit(sun)), Emergent(Dir::from_unit(down)));
    assert_eq!(q, uneven(sun, down));
    assert_eq!(read(&write(&dataset).unwrap().bytes).unwrap().visible, dataset.visible);
    file.incidence = "listed";
    let error = read(file.text(uneven).as_bytes()).unwrap_err().to_string();
    assert!(error.contains("incident_mean") && error.contains("no cells"), "{error}");
}

#[test]
fn rings_may_be_unsorted_and_have_gaps_but_not_overlap() {
    let sorted = File::new(Component::TransmissionFront);
    let mut shuffled = sorted.clone();
    shuffled.rings.swap(0, 2);
    assert_eq!(shuffled.read(uneven).visible, {
        let mut rising = sorted.clone();
        rising.rings.sort_by(|a, b| a[0].total_cmp(&b[0]));
        rising.read(uneven).visible
    });
    let mut gap = sorted.clone();
    gap.rings.remove(1);
    let dataset = gap.read(uneven);
    let btdf = function(&dataset, Component::TransmissionFront);
    let sun = Incident(Dir::from_unit(vector(48.0, 90.0)));
    assert_eq!(btdf.q(sun, Emergent(Dir::from_unit(vector(135.0, 270.0)))), 0.0);
    assert!(btdf.q(sun, Emergent(Dir::from_unit(vector(105.0, 270.0)))) > 0.0);
    assert_eq!(read(&write(&dataset).unwrap().bytes).unwrap().visible, dataset.visible);
    let mut overlap = sorted;
    overlap.rings[1][0] -= 1.0;
    let error = read(overlap.text(uneven).as_bytes()).unwrap_err().to_string();
    assert!(error.contains("overlap") && error.contains("line 8"), "{error}");
}

#[test]
fn the_format_is_known_by_name_and_by_content() {
    let text = File::new(Component::TransmissionFront).text(uneven);
    assert_eq!(Format::from_name("A/B.BTDF.TXT"), Some(Format::BtdfText));
    assert_eq!(Format::sniff("x.dat", text.as_bytes()), Some(Format::BtdfText));
    assert_eq!(Format::from_name("notes.txt"), None);
    assert_eq!(Format::stem("dir/Panel A.btdf.txt"), "Panel A");
    assert_eq!(Format::stem("x.xml"), "x");
    assert_eq!(Format::stem(".hidden"), ".hidden");
    let error = read_dataset("x.btdf.txt", b"nonsense").unwrap_err().to_string();
    assert!(error.contains("---"), "{error}");
}

#[test]
fn header_fields_survive_writing() {
    let mut file = File::new(Component::TransmissionFront);
    file.more = "manufacturer = \"M \\\"x\\\" \\\\ \\n---\\n ü\"\nstate = 22.5\nthickness = 0.006\ndescription = '''\n a\n\tb'''\n".into();
    let dataset = file.read(uneven);
    assert_eq!((dataset.state.as_str(), dataset.thickness), ("22.5", Some(0.006)));
    assert_eq!(dataset.manufacturer, "M \"x\" \\ \n---\n ü");
    let again = read(&write(&dataset).unwrap().bytes).unwrap();
    assert_eq!(again, dataset);
}

#[test]
fn writes_other_functions_with_their_flux_and_says_what_it_changed() {
    let klems = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let values: Vec<f64> = (0..145 * 145).map(|k| f64::from((k * 7919) % 101) / 900.0).collect();
    let matrix = CellMatrix::new(klems.clone(), klems, values).unwrap();
    let lone = |btdf: Btdf| Dataset {
        visible: Band { transmission_front: Some(btdf), ..Band::default() },
        ..Dataset::default()
    };
    // A Klems matrix comes back cell by cell.
    let dataset = lone(Btdf::from_cells(matrix.clone()));
    let written = write_dataset(Format::BtdfText, std::slice::from_ref(&dataset)).unwrap();
    assert!(written.findings.is_empty(), "{:?}", written.findings);
    let again = read(&written.bytes).unwrap();
    let (a, b) = (dataset.transmission().unwrap(), again.transmission().unwrap());
    assert!(matches!(&b.scattered, Some(Scattered::Cells(_))));
    for i in matrix.incident().cells() {
        for o in matrix.emergent().cells() {
            let (e, out) = (Incident(i.centre()), Emergent::from_undeviated(o.centre()));
            assert_eq!(a.q(e, out), b.q(e, out));
        }
    }
    // Everything else keeps its flux.
    for (btdf, code) in [
        (Btdf::ideal_diffuse(0.6), "resampled"),
        (Btdf::ideal_transparent(0.9), "regular-in-cells"),
        (Btdf { regular: Btdf::ideal_transparent(0.2).regular, ..Btdf::from_cells(matrix) }, "regular-in-cells"),
    ] {
        let written = write(&lone(btdf.clone())).unwrap();
        assert!(written.findings.iter().any(|f| f.code == code));
        let again = read(&written.bytes).unwrap();
        let got = again.transmission().unwrap();
        assert!((got.tau_hemispherical() - btdf.tau_hemispherical()).abs() < 1e-9);
        for theta in [0.0, 30.0, 70.0] {
            let sun = Incident(Dir::from_unit(vector(theta, 90.0)));
            assert!((got.tau(sun) - btdf.tau(sun)).abs() < 1e-9, "{theta}");
            // Light from above still goes down.
            let [up, down] = [90.0, 270.0].map(|phi| got.q(sun, Emergent(Dir::from_unit(vector(180.0 - theta, phi)))));
            assert!(down >= up);
        }
    }
    // Half sectors, which the format cannot say.
    let equal = RingBasis::equal_area(6);
    let values = (0..145 * equal.len()).map(|k| f64::from((k as u32 * 7919) % 101) / 900.0).collect();
    let matrix = CellMatrix::new(RingBasis::tregenza(), equal, values).unwrap();
    let written = write(&lone(Btdf::from_cells(matrix.clone()))).unwrap();
    assert!(written.findings.iter().any(|f| f.code == "resampled"));
    let tau = read(&written.bytes).unwrap().transmission().unwrap().tau_hemispherical();
    assert!((tau - matrix.tau_hemispherical()).abs() < 1e-9);
    assert!(write_dataset(Format::BtdfText, &[dataset.clone(), dataset]).is_err());
    assert!(write(&Dataset::default()).is_err());
}

#[test]
fn files_of_one_name_are_a_family_with_all_they_tell() {
    let source = |name: &str, component: Component, more: &str| {
        let text = File { more: more.into(), ..File::new(component) }.text(uneven);
        SourceFile::read(name, text.as_bytes()).unwrap()
    };
    let about = "kind = \"venetian\"\ntags = [\"blind\"]\norigin = \"measured\"\nauthor = \"Lab\"\nmethod = \"scanning\"\n\
                 date = 2026-03-01\ninside_face = \"matt\"\n";
    let files = vec![
        source("a0.btdf.txt", Component::TransmissionFront, &format!("state = 0\n{about}")),
        source("a0r.btdf.txt", Component::ReflectionBack, "state = \"0\"\n"),
        source("a45.btdf.txt", Component::TransmissionFront, "state = \"45\"\n"),
    ];
    let mut products = gather(files.clone(), Grouping::Proposed);
    assert_eq!(products.len(), 1);
    let product = products.remove(0);
    assert_eq!(product.datasets.iter().map(|d| d.state.as_str()).collect::<Vec<_>>(), ["0", "45"]);
    assert_eq!(product.datasets[0].visible.components(), [Component::TransmissionFront, Component::ReflectionBack]);
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    let key = catalogue.import(&product.datasets, product.meta).unwrap().key;
    let stored = catalogue.product(&key).unwrap();
    assert_eq!((stored.kind.as_str(), stored.tags.as_slice()), ("venetian", &["blind".to_owned()][..]));
    let from = &stored.provenance;
    assert_eq!((from.origin, from.author.as_str(), from.date.as_str()), (Origin::Measured, "Lab", "2026-03-01"));
    assert_eq!(from.source_file, "a0.btdf.txt, a0r.btdf.txt, a45.btdf.txt");
    assert_eq!(stored.states[1].value, Some(45.0));
    // Out as a package and in again: the directions are kept, values to f32.
    let package = catalogue.export_package(std::slice::from_ref(&key)).unwrap();
    let mut other = Catalogue::empty_in_memory().unwrap();
    let back = other.import_package(&package).unwrap().remove(0).key;
    let (a, b) = (catalogue.dataset(&key, Some("45")).unwrap(), other.dataset(&back, Some("45")).unwrap());
    assert_eq!(a, b);
    let (a, b) = (product.datasets[1].transmission().unwrap(), b.transmission().unwrap());
    let sun = Incident(Dir::from_unit(vector(24.0, 60.0)));
    let out = Emergent(Dir::from_unit(vector(135.0, 225.0)));
    assert!(a.q(sun, out) > 0.0 && (b.q(sun, out) / a.q(sun, out) - 1.0).abs() < 1e-6);
    // Other names are other products, unless one name is asked for; states without a key take the file's name.
    let mut renamed = files[2].clone();
    renamed.datasets[0].name = "Other".into();
    assert_eq!(gather(vec![files[0].clone(), renamed.clone()], Grouping::Proposed).len(), 2);
    assert_eq!(gather(vec![files[0].clone(), renamed], Grouping::One).len(), 1);
    let nameless = ["p.btdf.txt", "q.btdf.txt"].map(|name| source(name, Component::TransmissionFront, ""));
    let states: Vec<String> =
        gather(nameless.to_vec(), Grouping::Proposed)[0].datasets.iter().map(|d| d.state.clone()).collect();
    assert_eq!(states, ["p", "q"]);
    let tilted = ["v45.btdf.txt", "v0.btdf.txt"].map(|name| source(name, Component::TransmissionFront, ""));
    let product = gather(tilted.to_vec(), Grouping::Proposed).remove(0);
    assert_eq!(product.datasets.iter().map(|d| d.state.as_str()).collect::<Vec<_>>(), ["0", "45"]);
    assert_eq!(product.sources, ["v0.btdf.txt", "v45.btdf.txt"]);
}

#[test]
fn analytic_systems_have_their_exact_transmittances() {
    let Some(folder) = data("reference/systems") else { return };
    let mut table = csv::Reader::from_path(folder.join("ana_tau.csv")).unwrap();
    let names: Vec<String> = table.headers().unwrap().iter().skip(2).map(str::to_owned).collect();
    let rows: Vec<Vec<f64>> =
        table.records().map(|row| row.unwrap().iter().map(|field| field.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 145);
    for (column, name) in names.iter().enumerate() {
        let path = folder.join(format!("ana_{name}.btdf.txt"));
        if left_out(&path) {
            continue;
        }
        let bytes = std::fs::read(path).unwrap();
        let start = std::time::Instant::now();
        let dataset = read(&bytes).unwrap();
        println!("{name}: {} bytes in {:?}", bytes.len(), start.elapsed());
        assert!(dataset.findings.is_empty(), "{name}: {:?}", dataset.findings);
        let Some(Scattered::Directions(data)) = &dataset.transmission().unwrap().scattered else { panic!("{name}") };
        assert_eq!(data.lattice().unwrap().name(), "Tregenza 145");
        for (k, row) in rows.iter().enumerate() {
            let d = data.incident()[k].0;
            let theta_phi = [d.theta().to_degrees(), d.phi().to_degrees()];
            assert!((theta_phi[0] - row[0]).abs() < 1e-9 && (row[0] == 0.0 || (theta_phi[1] - row[1]).abs() < 1e-9));
            let tau = data.tau_by_direction()[k];
            assert!((tau - row[2 + column]).abs() < 2e-4, "{name} {k}: {tau} {}", row[2 + column]);
        }
        let written = write(&dataset).unwrap();
        assert!(written.findings.is_empty());
        assert_eq!(read(&written.bytes).unwrap().visible, dataset.visible, "{name}");
        // Slats at 20° and panels: where the light of a high sun goes, from the closed forms.
        let sun = Incident(Dir::from_unit(vector(48.0, 90.0)));
        let [straight, mirrored] = [270.0, 90.0].map(|phi| data.q(sun, Emergent(Dir::from_unit(vector(132.0, phi)))));
        match name.as_str() {
            "clear" | "scatter" => assert!(straight > 10.0 * mirrored),
            "lcp" => assert!(mirrored > straight, "{mirrored} {straight}"),
            _ => {}
        }
    }
}

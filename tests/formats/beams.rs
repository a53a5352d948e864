//! The description that goes with the numbers of a file: there and back, changed numbers, newer versions.

use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{Btdf, CellMatrix, Dataset, DescribedState, Finding, Severity, TreeRank};
use cfs::formats::bsdf_xml::{self, TreeForm};
use cfs::formats::{btdf_text, merge_sides, system_toml};

const BLIND: &str = "# a 'comment' & \"more\" <of> it -- 50 % ψ?>\r\nname = \"Blind\"\nkind = \"venetian\"\n[venetian]\n\
                     width = 0.08\nspacing = 0.072\nangles = [0, 45]\nupper = { reflectance = 0.5 }\nlower = { \
                     reflectance = 0.3 }\n";

fn matrix(tau: f64, map: AzimuthMap) -> Btdf {
    let basis = RingBasis::klems_full(map);
    let n = basis.len();
    let values = (0..n * n).map(|k| tau / std::f64::consts::PI * (1.0 + 0.3 * (k as f64).sin())).collect();
    Btdf::from_cells(CellMatrix::new(basis.clone(), basis, values).unwrap())
}

/// Numbers with a description; which numbers does not matter here.
fn dataset(described: Option<DescribedState>) -> Dataset {
    let mut dataset = Dataset { name: "Blind".into(), state: "45".into(), described, ..Dataset::default() };
    dataset.visible.transmission_front = Some(matrix(0.4, AzimuthMap::KLEMS_FRONT));
    dataset.visible.transmission_back = Some(matrix(0.3, AzimuthMap::KLEMS_BACK));
    dataset
}

fn blind(text: &str) -> DescribedState {
    system_toml::described(text, "45").unwrap()
}

fn not_restored(dataset: &Dataset) -> Option<&Finding> {
    dataset.findings.iter().find(|finding| finding.code == "beams-not-restored")
}

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).unwrap()
}

#[test]
fn xml_is_known_again_and_is_otherwise_what_it_was() {
    let described = blind(BLIND);
    let given = dataset(Some(described.clone()));
    let matrices = bsdf_xml::write(&given).unwrap();
    assert!(matrices.findings.iter().all(|finding| finding.code != "state-not-written"));
    let plain = bsdf_xml::write(&dataset(None)).unwrap();
    let [with, without] = [matrices.bytes, plain.bytes].map(text);
    let start = with.find("<?cfs-system").unwrap();
    let end = with[start..].find("?>").unwrap() + start;
    assert!(with.replacen(&with[start..end + 4], "", 1) == without, "the instruction alone is more");
    let form = TreeForm { level: Some(2), tolerance: Some(0.1), ..TreeForm::of_rank(TreeRank::Four) };
    let tree = text(bsdf_xml::write_tree(&given, form).unwrap().bytes);
    for xml in [with.clone(), tree, with.replace('\n', "\r\n"), with.replace("e-1,", "e-1 ,")] {
        let read = bsdf_xml::read(xml.as_bytes()).unwrap();
        assert_eq!(read.described.as_ref(), Some(&described));
        assert_eq!(read.state, "45");
        assert_eq!(not_restored(&read), None);
    }
    let own = bsdf_xml::read(with.as_bytes()).unwrap();
    let foreign = bsdf_xml::read(without.as_bytes()).unwrap();
    assert_eq!(own.visible, foreign.visible);
    assert_eq!((foreign.described, foreign.state.as_str(), foreign.description), (None, "", own.description));
}

#[test]
fn changed_xml_is_read_without_the_description() {
    let with = text(bsdf_xml::write(&dataset(Some(blind(BLIND)))).unwrap().bytes);
    let first = with.find("<ScatteringData>").unwrap();
    let number = with[first..].find("e-1,").unwrap() + first;
    let mut edited = with.clone();
    edited.replace_range(number..number + 4, "e-2,");
    let swapped = with.replace("Transmission Back", "Reflection Front");
    let bases = with
        .replace("<UpperTheta>5</UpperTheta>", "<UpperTheta>6</UpperTheta>")
        .replace("<LowerTheta>5<", "<LowerTheta>6<");
    let described = with.replace("spacing = 0.072", "spacing = 0.062");
    let cut = with.replace("fingerprint=", "fingerprints=");
    for xml in [edited, swapped, bases, described, cut] {
        assert!(xml != with);
        let read = bsdf_xml::read(xml.as_bytes()).unwrap();
        assert_eq!((read.described.as_ref(), read.state.as_str()), (None, ""));
        assert_eq!(not_restored(&read).unwrap().severity, Severity::Warning);
    }
    let newer = bsdf_xml::read(with.replace("version=\"1\" state", "version=\"2\" state").as_bytes()).unwrap();
    let told = &not_restored(&newer).unwrap().message;
    assert!(newer.described.is_none() && told.contains("newer version of cfs; this program reads 1"), "{told}");
    // A name is no number.
    let renamed = bsdf_xml::read(with.replace("<Name>Blind<", "<Name>Other<").as_bytes()).unwrap();
    assert!(renamed.name == "Other" && renamed.described.is_some());
}

#[test]
fn text_is_known_again() {
    for own in [BLIND.to_owned(), BLIND.replace('\r', ""), format!("{}#\n---\n", BLIND.replace("---", ""))] {
        // The last is no system file with its line of three hyphens, which no header may hold as a line either.
        let described = DescribedState { text: own.clone(), state: "45".into() };
        let file = text(btdf_text::write(&dataset(Some(described.clone()))).unwrap().bytes);
        let read = btdf_text::read(file.as_bytes()).unwrap();
        let is_one = system_toml::described(&own, "45").is_some();
        assert_eq!(read.described, is_one.then_some(described), "{own}");
        assert_eq!(not_restored(&read).is_none(), is_one);
    }
    let mut other_key = dataset(Some(blind(BLIND)));
    other_key.state = "half closed".into();
    let read = btdf_text::read(&btdf_text::write(&other_key).unwrap().bytes).unwrap();
    assert_eq!((read.state.as_str(), read.described), ("half closed", other_key.described));
    let plain = text(btdf_text::write(&dataset(None)).unwrap().bytes);
    assert!(!plain.contains("beams") && btdf_text::read(plain.as_bytes()).unwrap().described.is_none());
}

#[test]
fn the_functions_of_a_state_keep_the_description_when_all_have_it() {
    let given = dataset(Some(blind(BLIND)));
    let sides: Vec<String> = given
        .visible
        .components()
        .into_iter()
        .map(|component| text(btdf_text::write_component(&given, component).unwrap().bytes))
        .collect();
    let merged = |sides: &[String]| {
        let read = sides.iter().map(|file| btdf_text::read(file.as_bytes()).unwrap());
        merge_sides(read.collect()).remove(0).described
    };
    assert_eq!(merged(&sides), given.described);
    let edited = sides[1].replacen("\n180 0 0.0", "\n180 0 0.1", 1);
    assert!(edited != sides[1]);
    assert_eq!(merged(&[sides[0].clone(), edited]), None);
}

#[test]
fn changed_text_is_read_without_the_description_and_newer_text_is_refused() {
    let file = text(btdf_text::write(&dataset(Some(blind(BLIND)))).unwrap().bytes);
    let body = file.rfind("---\n").unwrap();
    let number = file[body..].find(" 0.1").unwrap() + body;
    let mut edited = file.clone();
    edited.replace_range(number..number + 4, " 0.2");
    for changed in [
        edited,
        file.replace("light_from = \"outside\"", "light_from = \"outside\"\nsystem_state = \"0\""),
        file.replace("state = \"45\"", "state = \"0\""),
        file.replace("incident_mean = true", "incident_mean = false"),
        file.replace("fingerprint = \"", "fingerprint = \"0"),
        file.replace("width = 0.08", "width = 0.09"),
    ] {
        assert!(changed != file);
        let read = btdf_text::read(changed.as_bytes()).unwrap();
        assert!(read.described.is_none() && not_restored(&read).is_some());
    }
    // Comments, blanks and names are no numbers.
    let noted = file.replacen("name = \"Blind\"", "name = \"Other\" # noted", 1) + "\n  # the end\n";
    assert!(btdf_text::read(noted.as_bytes()).unwrap().described.is_some());
    let refused =
        |from: &str, to: &str| btdf_text::read(file.replacen(from, to, 1).as_bytes()).unwrap_err().to_string();
    let newer = refused("cfs-beams 1\"", "cfs-beams 2\"\nrays = 3");
    assert!(newer.contains("\"cfs-beams 2\", written by a newer version of cfs"), "{newer}");
    assert!(newer.contains("expected cfs-beams 1, the newest that this program reads"), "{newer}");
    assert!(refused("cfs-btdf 1", "cfs-btdf 2").contains("written by a newer version of cfs"));
    assert!(refused("beams = \"cfs-beams 1\"\n", "").contains("the key system without beams"));
    assert!(refused("cfs-beams 1", "beams").contains("expected beams = \"cfs-beams 1\""));
}

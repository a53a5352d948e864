//! Taking in folders of files: what they make without a click, what is asked, what is changed by hand, kept and undone.

use crate::common::data;
use crate::driven::{apply, settle};
use crate::files_view::{import, killed, products, proposed, said, sheet, wait_for, window, window_in};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::import::proposal::{Import, ImportFields, StateWords};
use cfs::app::import::step::{Choose, Step, Word};
use cfs::app::state::Sheet;
use cfs::catalogue::Ambiguity;
use cfs::formats::luminaire::{Description, Luminaire, Opening, Photometry};
use cfs::formats::{eulumdat, ies};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

fn write(folder: &Path, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(&path, bytes).unwrap();
    path
}

fn open(harness: &mut Harness<'_, App>, path: &Path) {
    apply(harness, Command::OpenPaths(vec![path.to_owned()]));
}

/// Two families of ten states: one with signs, one by numbers that its data confirm; and five luminaires.
fn families_and_luminaires(folder: &Path) {
    for (state, angle) in [-75, -60, -45, -30, -15, 0, 15, 30, 45, 60].into_iter().enumerate() {
        let tau = 0.6 - 0.005 * f64::from(i32::abs(angle)) - 0.001 * state as f64;
        write(folder, &format!("made one/raff_{angle}.xml"), sheet("Raffstore", tau));
    }
    for step in 0..10 {
        let tau = 0.7 - 0.06 * f64::from(step);
        write(folder, &format!("made two/q{:02}.xml", 10 * step), sheet("Quer", tau));
    }
    let luminaire = Luminaire {
        format: String::new(),
        text: Description { name: "Downlight 7".into(), manufacturer: "Leuchten AG".into(), ..Description::default() },
        photometry: Photometry::C,
        opening: Opening::default(),
        c_deg: vec![0.0],
        gamma_deg: vec![0.0, 45.0, 90.0],
        intensity: vec![100.0, 70.0, 0.0],
        lamp_flux: Some(300.0),
        power: 10.0,
        findings: vec![],
    };
    write(folder, "made one/down.ldt", eulumdat::write(&luminaire));
    write(folder, "made two/down.ldt", eulumdat::write(&luminaire));
    write(folder, "lamp.ies", ies::write(&luminaire, ies::IesEdition::Lm63_2002));
    write(folder, "made two/lamp.IES", ies::write(&luminaire, ies::IesEdition::Lm63_2002));
    write(folder, "tm33.xml", "<?xml version=\"1.0\"?><IESTM33-22><Version>1.1</Version></IESTM33-22>");
}

/// Keys of the states of the product that a file of this name belongs to.
fn keys_of(import: &Import, file: &str) -> Vec<String> {
    let product = import.products.iter().find(|product| product.sources.iter().any(|source| source == file));
    product.unwrap_or_else(|| panic!("{file}")).states.iter().map(StateWords::key).collect()
}

fn luminaires_are_told(import: &Import) {
    let told: Vec<&String> = import.left_out.iter().filter(|text| text.contains(": a luminaire (")).collect();
    assert_eq!(told.len(), 5, "{:?}", import.left_out);
    for (file, words) in
        [("lamp.ies", "IES LM-63)"), ("down.ldt", "EULUMDAT): Downlight 7, Leuchten AG"), ("tm33.xml", "TM-33")]
    {
        assert!(told.iter().any(|text| text.contains(file) && text.contains(words)), "{file}: {told:?}");
    }
}

const SIGNED: [&str; 10] = ["-75", "-60", "-45", "-30", "-15", "0", "15", "30", "45", "60"];
const TENS: [&str; 10] = ["0", "10", "20", "30", "40", "50", "60", "70", "80", "90"];

#[test]
fn families_are_found_among_other_files_and_what_is_not_certain_is_asked() {
    let folder = tempfile::tempdir().unwrap();
    families_and_luminaires(folder.path());
    // Cloth of three openings, which let more and more through; samples; one sheet by itself, and it again.
    for (percent, tau) in [("05", 0.05), ("10", 0.1), ("20", 0.2)] {
        write(folder.path(), &format!("cloth{percent}.xml"), sheet("Cloth", tau));
    }
    for number in 1..4 {
        write(folder.path(), &format!("sample{number}.xml"), sheet("Sample", 0.1 * f64::from(number) + 0.003));
    }
    write(folder.path(), "single.xml", sheet("Single", 0.33));
    write(folder.path(), "z again.xml", sheet("Other name", 0.33));
    let mut harness = window();
    let before = products(&harness);
    open(&mut harness, folder.path());
    let found = import(&harness);
    assert!(found.failures.is_empty(), "{:?}", found.failures);
    luminaires_are_told(found);
    assert_eq!(keys_of(found, "raff_0.xml"), SIGNED);
    assert_eq!(keys_of(found, "q00.xml"), TENS);
    assert_eq!(keys_of(found, "single.xml"), [""]);
    let asked: Vec<&str> =
        found.products.iter().filter(|one| one.ambiguity.is_some()).map(|one| one.fields.name.as_str()).collect();
    assert_eq!(asked, ["Cloth"], "a question, and only this");
    assert_eq!(found.products.len(), 2 + 1 + 3 + 2);
    let again = found.products.iter().find(|one| one.same_as.is_some()).expect("the same data are known");
    assert!(!again.wanted());
    // The question is in its place, in words.
    assert!(harness.query_by_label(&Ambiguity::NumbersAlone.question()).is_some());
    assert!(harness.query_by_label("1 question open: the files concerned stay here.").is_some());
    // What is certain goes in at once; the question stays, and so does the sheet.
    harness.get_by_label("Add 6 products to catalogue").click();
    settle(&mut harness);
    assert_eq!(products(&harness), before + 6);
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Import));
    assert!(import(&harness).products.iter().any(|one| one.ambiguity.is_some()));
    let cloth = import(&harness).products.iter().find(|one| one.ambiguity.is_some()).unwrap().fields.name.clone();
    harness.get_by_label(&format!("Separate: {cloth}")).click();
    settle(&mut harness);
    assert_eq!(import(&harness).questions(), 0);
    assert_eq!(import(&harness).wanted().count(), 3);
    apply(&mut harness, Command::AddImport);
    assert_eq!(products(&harness), before + 9);
    // Two steps took them in; each is taken out as a whole.
    for (command, end) in [(Command::Undo, 0), (Command::Redo, 9)] {
        let mut counts = BTreeSet::from([products(&harness) - before]);
        for _ in 0..10 {
            apply(&mut harness, command.clone());
            counts.insert(products(&harness) - before);
        }
        assert_eq!((products(&harness) - before, counts), (end, BTreeSet::from([0, 6, 9])));
    }
    // Now all of it is there already, by its content, whatever the files are called.
    open(&mut harness, &folder.path().join("z again.xml"));
    assert!(harness.query_by_label("Already in the catalogue as Single").is_some());
    // Of a family one file alone too: what the catalogue holds counts state by state.
    open(&mut harness, &folder.path().join("made two/q30.xml"));
    assert!(harness.query_by_label("Already in the catalogue as Quer").is_some());
}

#[cfg(unix)]
#[test]
fn of_all_makers_files_in_one_folder_nine_in_ten_are_right_without_a_click_and_none_is_wrong_in_silence() {
    let Some(root) = data("data/bsdf") else { return };
    let folder = tempfile::tempdir().unwrap();
    // As they lie there, linked file by file, with made families and luminaires between them.
    let mut truth: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for maker in std::fs::read_dir(&root).unwrap().flatten() {
        let name = maker.file_name().to_string_lossy().into_owned();
        std::fs::create_dir_all(folder.path().join(&name)).unwrap();
        for file in std::fs::read_dir(maker.path()).unwrap().flatten() {
            let target = folder.path().join(&name).join(file.file_name());
            std::os::unix::fs::symlink(file.path(), &target).unwrap();
            let id = target.display().to_string();
            let family = match (name.as_str(), file.file_name().to_string_lossy().as_ref()) {
                ("tt_slats_b", _) => "slats".to_owned(),
                ("clear_and_venetian_w7", "ven0.xml" | "ven45.xml") => "venetian".to_owned(),
                _ => id.clone(),
            };
            truth.entry(family).or_default().push(id);
        }
    }
    families_and_luminaires(folder.path());
    for made in ["made one", "made two"] {
        let files = std::fs::read_dir(folder.path().join(made)).unwrap().flatten().map(|file| file.path());
        let files = files.filter(|path| path.extension().is_some_and(|end| end == "xml"));
        truth.insert(made.to_owned(), files.map(|path| path.display().to_string()).collect());
    }
    let mut harness = window();
    open(&mut harness, folder.path());
    let found = import(&harness);
    luminaires_are_told(found);
    for family in truth.values_mut() {
        family.sort();
    }
    let families: BTreeSet<Vec<String>> = truth.into_values().collect();
    let (mut right, mut asked, mut all) = (0, 0, 0);
    for product in &found.products {
        all += product.files.len();
        let mut files = product.files.clone();
        files.sort();
        match (families.contains(&files), &product.ambiguity) {
            (true, None) => right += files.len(),
            (_, Some(_)) => asked += files.len(),
            (false, None) => panic!("wrong in silence: {files:?}"),
        }
    }
    assert_eq!(right + asked, all);
    assert!(right as f64 >= 0.9 * all as f64, "{right} of {all} right without a click, {asked} asked");
    // Every file is somewhere: in a product, or told.
    let told = found.failures.len();
    let given: usize = families.iter().map(Vec::len).sum();
    assert_eq!(all + told, given, "{:?}", found.failures);
    assert!(all >= 48, "{all}");
    assert_eq!(keys_of(found, "b00.xml"), ["0", "10", "30", "45", "60"]);
    assert_eq!(keys_of(found, "ven0.xml"), ["0", "45"]);
    assert_eq!(
        (keys_of(found, "raff_0.xml"), keys_of(found, "q00.xml")),
        (SIGNED.map(str::to_owned).to_vec(), TENS.map(str::to_owned).to_vec())
    );
}

/// Three files of numbers that are no angles, and one of something else.
fn loose(folder: &Path) {
    for (file, tau) in [("panel a.xml", 0.5), ("panel b.xml", 0.4), ("panel c.xml", 0.3)] {
        write(folder, file, sheet("Panel", tau));
    }
    write(folder, "other.xml", sheet("Other", 0.2));
}

#[test]
fn rows_are_put_together_by_mouse_and_keyboard_and_states_get_angles_before_anything_is_stored() {
    let folder = tempfile::tempdir().unwrap();
    loose(folder.path());
    let mut harness = window();
    open(&mut harness, folder.path());
    assert_eq!(import(&harness).products.len(), 4);
    // A click, and with Shift a range.
    harness.get_by_role_and_label(Role::ListBoxOption, "panel a.xml").click();
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::ListBoxOption, "panel c.xml").click_modifiers(Modifiers::SHIFT);
    harness.run_steps(2);
    assert_eq!(import(&harness).selected.len(), 3);
    // Space takes one out and in again.
    harness.get_by_role_and_label(Role::ListBoxOption, "panel b.xml").focus();
    harness.run_steps(1);
    for count in [2, 3] {
        harness.key_press(Key::Space);
        harness.run_steps(2);
        assert_eq!(import(&harness).selected.len(), count);
    }
    harness.get_by_label("Make one product").click();
    settle(&mut harness);
    assert_eq!(import(&harness).products.len(), 2);
    let names = |harness: &Harness<'_, App>| keys_of(import(harness), "panel a.xml");
    assert_eq!(names(&harness), ["panel a", "panel b", "panel c"]);
    // Angles are typed in the rows; the order of the states follows them.
    for (file, angle) in [("panel a.xml", "45"), ("panel b.xml", "−10"), ("panel c.xml", "22,5")] {
        harness.get_by_role_and_label(Role::TextInput, &format!("Angle of {file}")).focus();
        harness.run_steps(1);
        harness.get_by_role_and_label(Role::TextInput, &format!("Angle of {file}")).type_text(angle);
        harness.run_steps(2);
    }
    assert_eq!(names(&harness), ["45", "-10", "22.5"]);
    apply(&mut harness, Command::AddImport);
    let shelf = harness.state().shell.state.shelf().unwrap();
    let panel = shelf.product("panel").unwrap();
    let states: Vec<_> = panel.states.iter().map(|one| (one.key.as_str(), one.value, one.label.as_str())).collect();
    assert_eq!(
        states,
        [("-10", Some(-10.0), "panel b"), ("22.5", Some(22.5), "panel c"), ("45", Some(45.0), "panel a")]
    );
    let tau = panel.states[0].tau_hemispherical.unwrap();
    assert!((tau - 0.4).abs() < 0.01, "the data went with their names: {tau}");
}

#[test]
fn files_are_taken_apart_and_given_to_another_product_and_what_was_typed_goes_with_them() {
    let folder = tempfile::tempdir().unwrap();
    for (file, tau) in [("ven0", 0.5), ("ven30", 0.4), ("ven60", 0.2)] {
        write(folder.path(), &format!("{file}.xml"), sheet("Venetian", tau));
    }
    write(folder.path(), "closed.xml", sheet("Lost", 0.01));
    let mut harness = window();
    open(&mut harness, folder.path());
    let place = |harness: &Harness<'_, App>, file: &str| {
        let found = import(harness);
        let row = found.rows().find(|row| found.products[row.0].sources[row.1] == file);
        row.unwrap_or_else(|| panic!("{file}"))
    };
    let closed = place(&harness, "closed.xml");
    apply(&mut harness, Command::Import(Step::Name(closed, StateWords { angle: "85".into(), name: "closed".into() })));
    let venetian = place(&harness, "ven0.xml").0;
    apply(&mut harness, Command::Import(Step::Choose(closed, Choose::Only)));
    apply(&mut harness, Command::Import(Step::StatesOf(venetian)));
    assert_eq!(import(&harness).products.len(), 1);
    let mut keys = keys_of(import(&harness), "closed.xml");
    keys.sort();
    assert_eq!(keys.iter().filter(|key| *key == "85").count(), 1, "{keys:?}");
    // One of them is something else after all.
    let flat = place(&harness, "ven0.xml");
    apply(&mut harness, Command::Import(Step::Choose(flat, Choose::Only)));
    harness.get_by_label("Make separate products").click();
    settle(&mut harness);
    assert_eq!(import(&harness).products.len(), 2);
    assert_eq!(import(&harness).products.iter().map(|one| one.datasets.len()).max(), Some(3));
    // Two states of one name are told, and nothing is stored.
    let thirty = place(&harness, "ven30.xml");
    apply(&mut harness, Command::Import(Step::Name(thirty, StateWords { angle: "85".into(), name: String::new() })));
    let problem = import(&harness).products[thirty.0].problem().expect("a problem");
    assert!(problem.contains("85") && !import(&harness).products[thirty.0].ready(), "{problem}");
    assert!(harness.query_by_label(&problem).is_some());
    apply(&mut harness, Command::Import(Step::Name(thirty, StateWords { angle: "x".into(), name: String::new() })));
    assert!(import(&harness).products[thirty.0].problem().unwrap().contains("“x” is not an angle"));
}

#[test]
fn words_are_typed_once_for_all_that_are_chosen() {
    let folder = tempfile::tempdir().unwrap();
    loose(folder.path());
    let mut harness = window();
    open(&mut harness, folder.path());
    harness.get_by_label("Select all").click();
    harness.run_steps(3);
    assert!(harness.query_by_label("Details of 4 products").is_some());
    harness.get_by_role_and_label(Role::TextInput, "Kind").focus();
    harness.run_steps(1);
    harness.get_by_role_and_label(Role::TextInput, "Kind").type_text("prism");
    harness.run_steps(2);
    apply(&mut harness, Command::Import(Step::Word(Word::Author, "Prüfstelle".to_owned())));
    apply(&mut harness, Command::AddImport);
    let shelf = harness.state().shell.state.shelf().unwrap();
    for key in ["panel", "panel-2", "panel-3", "other"] {
        let product = shelf.product(key).unwrap();
        assert_eq!((product.kind.as_str(), product.provenance.author.as_str()), ("prism", "Prüfstelle"));
        assert_eq!(product.manufacturer, "Nobody", "what was not typed stays");
    }
}

#[test]
fn a_row_is_seen_and_turned_before_it_is_stored() {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "sheet.xml", sheet("Sheet", 0.3));
    let mut harness = window();
    open(&mut harness, &path);
    harness.get_by_label("Turn upside down").click();
    settle(&mut harness);
    assert_eq!(import(&harness).products[0].repairs.len(), 1);
    assert!(harness.query_by_label("Repaired: Turn upside down").is_some());
    harness.get_by_label("Turn upside down").click();
    settle(&mut harness);
    assert!(import(&harness).products[0].repairs.is_empty(), "twice is not at all");
}

fn zip(files: &[(&str, &[u8])]) -> Vec<u8> {
    use std::io::Write as _;
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, bytes) in files {
        zip.start_file(*name, zip::write::SimpleFileOptions::default()).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

#[test]
fn an_archive_with_folders_and_a_package_in_it_is_taken_in_like_a_folder() {
    let mut catalogue = cfs::catalogue::Catalogue::empty_in_memory().unwrap();
    let mut dataset = cfs::compute::btdf::Dataset { name: "Packed".into(), ..Default::default() };
    dataset.visible.transmission_front = Some(cfs::compute::btdf::Btdf::ideal_diffuse(0.44));
    let key = catalogue.import(&[dataset], Default::default()).unwrap().key;
    let package = catalogue.export_package(&[key]).unwrap();
    let [flat, steep] = [("Venetian", 0.5), ("Venetian", 0.2)].map(|(name, tau)| sheet(name, tau));
    let bytes = zip(&[
        ("blinds/ven0.xml", flat.as_bytes()),
        ("blinds/ven45.xml", steep.as_bytes()),
        ("blinds/readme.pdf", b"%PDF"),
        ("packed.cfsp", &package),
        ("more.zip", &zip(&[("deeper.zip", &zip(&[("deepest.zip", &zip(&[("a.xml", b"x")]))]))])),
        ("damaged.xml", b"<WindowElement>"),
    ]);
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "all.zip", bytes);
    let mut harness = window();
    let before = products(&harness);
    open(&mut harness, &path);
    assert_eq!(
        proposed(&harness),
        [("Venetian", &["0", "45"][..]), ("Packed", &[""])]
            .map(|(name, keys)| (name.to_owned(), keys.iter().map(|&key| key.to_owned()).collect::<Vec<_>>()))
    );
    let left_out = &import(&harness).left_out;
    assert!(left_out.iter().any(|text| text.starts_with("all.zip/blinds/readme.pdf: not a dataset")), "{left_out:?}");
    assert!(
        left_out.iter().any(|text| text.starts_with("all.zip/more.zip/deeper.zip/deepest.zip: an archive more")),
        "{left_out:?}"
    );
    assert!(import(&harness).failures[0].starts_with("all.zip/damaged.xml: "));
    apply(&mut harness, Command::AddImport);
    assert_eq!(products(&harness), before + 2);
    // What is there already is not taken twice, nor taken out by undo.
    let path = write(folder.path(), "packed.cfsp", package);
    open(&mut harness, &path);
    assert!(!import(&harness).products[0].wanted());
    apply(&mut harness, Command::AddAnyway(0, true));
    apply(&mut harness, Command::AddImport);
    assert_eq!(products(&harness), before + 2);
    assert!(said(&harness).iter().any(|text| text.contains("already there")), "{:?}", said(&harness));
    apply(&mut harness, Command::Undo);
    assert_eq!(products(&harness), before + 2);
}

#[test]
fn an_import_that_is_left_is_a_draft_after_a_restart_too_and_a_discarded_one_comes_back() {
    let (folder, files) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    loose(files.path());
    let mut harness = window_in(folder.path());
    open(&mut harness, files.path());
    let rows: Vec<_> =
        import(&harness).rows().filter(|row| import(&harness).products[row.0].sources[row.1] != "other.xml").collect();
    for row in rows {
        apply(&mut harness, Command::Import(Step::Choose(row, Choose::Also)));
    }
    apply(&mut harness, Command::Import(Step::Together));
    let number = import(&harness).products.iter().position(|one| one.datasets.len() == 3).unwrap();
    let fields = ImportFields { name: "Three panels".into(), ..ImportFields::default() };
    apply(&mut harness, Command::EditImport(number, Box::new(fields)));
    let arranged = proposed(&harness);
    harness.get_by_label("Keep as draft").click();
    settle(&mut harness);
    assert!(harness.state().imports.open().is_none() && harness.state().imports.drafts().len() == 1);
    wait_for(folder.path(), "\"import\": null");
    let left = killed(folder.path());
    let mut next = window_in(left.path());
    apply(&mut next, Command::Sheet(Some(Sheet::Import)));
    let name = next.state().imports.drafts()[0].name.clone();
    next.get_by_label(&format!("Continue: {name}")).click();
    settle(&mut next);
    assert_eq!(proposed(&next), arranged);
    assert!(next.state().imports.drafts().is_empty());
    // Discarded, back, and discarded again.
    next.get_by_label("Discard").click();
    settle(&mut next);
    assert!(next.state().imports.open().is_none());
    apply(&mut next, Command::Undo);
    assert_eq!(proposed(&next), arranged);
    apply(&mut next, Command::Redo);
    assert!(next.state().imports.open().is_none() && next.state().imports.drafts().is_empty());
    // What is opened over something else leaves it as a draft.
    open(&mut next, files.path());
    open(&mut next, &files.path().join("other.xml"));
    assert_eq!(next.state().imports.drafts().len(), 1);
}

#[test]
fn the_sheet_can_be_read_at_all_sizes() {
    let folder = tempfile::tempdir().unwrap();
    families_and_luminaires(folder.path());
    loose(folder.path());
    for (percent, tau) in [("05", 0.05), ("10", 0.1)] {
        write(folder.path(), &format!("a cloth of a name that is long {percent}.xml"), sheet("Cloth", tau));
    }
    let mut harness = window();
    open(&mut harness, folder.path());
    crate::legible::can_be_read(&mut harness, "import");
    apply(&mut harness, Command::Import(Step::ChooseAll));
    crate::legible::can_be_read(&mut harness, "import, all chosen");
}

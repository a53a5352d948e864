//! What bytes once did to a reader, by the stored input that did it.

use crate::readers::Target;
use cfs::catalogue;
use cfs::compute::btdf::{Btdf, Dataset, Scattered, TensorTree, TreeAxes, TreeError, TreeNode, TreeRank};
use cfs::compute::limits;
use cfs::formats::control_curve::read_control_curve;
use cfs::formats::package::{self, Package, PackageProduct, PackageState};
use cfs::formats::{bsdf_xml, dataset_blob, eulumdat, ies, luminaire_index, scan};
use cfs::study::{Scene, SceneFile, SystemLibrary};
use std::path::Path;

fn stored(target: &str, name: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(target).join(name);
    let input = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    Target::named(target).unwrap().file(&input)
}

fn told<T>(read: Result<T, impl ToString>) -> String {
    read.err().expect("refused").to_string()
}

#[test]
fn a_tree_of_few_bytes_whose_branches_share_their_children_has_not_more_leaves_than_can_be_counted() {
    // 145 nodes, which stood for 16⁹ leaves: reading never ended.
    let error = told(dataset_blob::decode(&stored("cfsd", "branches-that-share-children")));
    assert!(error.contains("names children that another node has already"), "{error}");
    let mut nodes = vec![TreeNode::Branch(1)];
    nodes.extend(std::iter::repeat_n(TreeNode::Leaf(0.1), 16));
    nodes[1] = TreeNode::Branch(9);
    assert_eq!(TensorTree::new(TreeRank::Three, TreeAxes::Front, nodes.clone()).map(|tree| tree.leaves()), Ok(15));
    nodes[2] = TreeNode::Branch(9);
    assert_eq!(TensorTree::new(TreeRank::Three, TreeAxes::Front, nodes), Err(TreeError::Shared(2)));
}

#[test]
fn the_name_of_a_tilt_file_is_not_cut_within_a_letter() {
    let error = told(ies::read(&stored("ies", "tilt-file-with-an-umlaut-where-it-is-cut")));
    assert!(error.contains("TILT=Aäää") && error.contains("external tilt file"), "{error}");
}

#[test]
fn one_number_is_not_filled_up_to_a_matrix_beyond_memory() {
    // 648 000 × 648 000 values, of which the file holds one, were asked for: the program was ended by the system.
    let error = told(bsdf_xml::read(&stored("bsdf-matrix", "one-number-for-cells-beyond-memory")));
    assert!(error.contains(&format!("more than {} directions", limits::CELLS)), "{error}");
    let error = told(bsdf_xml::read(&stored("bsdf-matrix", "cells-within-limits-whose-matrix-is-not")));
    assert!(error.contains(&format!("at most {} values", limits::VALUES)), "{error}");
}

#[test]
fn what_bsdf_xml_may_hold_the_catalogue_can_keep() {
    // Taken in, and then refused whenever it was read from the catalogue.
    let error = told(bsdf_xml::read(&stored("bsdf-matrix", "value-that-the-compact-form-does-not-hold")));
    assert!(error.contains("value 1 is 1e10, which no cell can have"), "{error}");
}

#[test]
fn states_of_one_dataset_share_its_tree() {
    // Each had a copy: a thousand states of one large tree filled the memory.
    let mut dataset = Dataset::default();
    let mut nodes = vec![TreeNode::Branch(1)];
    nodes.extend(std::iter::repeat_n(TreeNode::Leaf(0.1), 16));
    let tree = TensorTree::new(TreeRank::Four, TreeAxes::Front, nodes).unwrap();
    let scattered = Some(Scattered::Tree(Box::new(tree)));
    dataset.visible.transmission_front = Some(Btdf { regular: None, scattered });
    let blob = dataset_blob::encode(&dataset);
    let hash = dataset_blob::content_hash(&blob);
    let product = |key: &str| PackageProduct {
        key: key.to_owned(),
        name: key.to_owned(),
        states: vec![PackageState { dataset: hash.clone(), ..PackageState::default() }],
        ..PackageProduct::default()
    };
    let package = Package { products: vec![product("a"), product("b")], datasets: [(hash.clone(), blob)].into() };
    let unpacked = catalogue::unpack(&package::write(&package).unwrap()).unwrap();
    let nodes = |product: usize| match &unpacked[product].0[0].visible.transmission_front.as_ref().unwrap().scattered {
        Some(Scattered::Tree(tree)) => tree.nodes().as_ptr(),
        other => panic!("a tree became {other:?}"),
    };
    assert_eq!(nodes(0), nodes(1));
}

#[test]
fn angles_beyond_the_turn_give_no_negative_flux() {
    let error = told(ies::read(&stored("ies", "gamma-above-the-zenith")));
    assert!(error.contains("gamma angle: 3.5e2 °; expected 0 to 1.8e2 °"), "{error}");
}

#[test]
fn a_plane_just_before_360_degrees_is_not_written_as_360() {
    let error = told(ies::read(&stored("ies", "plane-that-is-written-as-360")));
    assert!(error.contains("plane C"), "{error}");
}

#[test]
fn lamps_of_next_to_no_light_keep_their_intensities_in_eulumdat() {
    // 0.00001 lm were written as 0 lm, and intensities as 10⁸ times what they are.
    let weak = b"IESNA:LM-63-2002\nTILT=NONE\n1 0.00001 1 3 1 1 2 1 1 0\n1 1 0\n0 90 180\n0\n5 2 0\n";
    let weak = ies::read(weak).unwrap();
    let again = eulumdat::read(&eulumdat::write(&weak)).unwrap();
    assert!((again.peak() / weak.peak() - 1.0).abs() < 1e-6, "{} cd of {} cd", again.peak(), weak.peak());
}

#[test]
fn a_turn_that_does_not_begin_at_c0_can_be_handed_on_as_ies() {
    // Written from 10° to 360°, which no reader takes.
    let lines = |planes: &str| {
        format!("x\n1\n0\n2\n0\n2\n0\n{}1\n1\nlamp\n1000\n\n\n10\n{}{planes}", "\n".repeat(18), "0\n".repeat(10))
    };
    let turned = eulumdat::read(lines("10\n190\n0\n90\n100\n100\n300\n300\n").as_bytes()).unwrap();
    let again = ies::read(&ies::write(&turned, ies::IesEdition::Lm63_2002)).unwrap();
    assert_eq!(again.c_deg, [0.0, 10.0, 190.0]);
    // C0 lies 170° behind the last plane and 10° before the first.
    assert!((again.plane(0)[0] - (300.0 - 200.0 * 170.0 / 180.0)).abs() < 0.1, "{:?}", again.plane(0));
}

#[test]
fn light_beyond_lamps_and_lamps_beyond_counting_are_written_so_that_they_are_read() {
    // No lamps, and a flux above all that lamps are believed to have; lamps whose flux has no reciprocal.
    for (lamps, lit) in [("-1", "500000000000"), ("1e-320", "0")] {
        let text =
            format!("IESNA:LM-63-2002\nTILT=NONE\n1 {lamps} 1 3 1 1 2 1 1 0\n1 1 0\n0 90 180\n0\n{lit} {lit} {lit}\n");
        let bright = ies::read(text.as_bytes()).unwrap();
        let again = eulumdat::read(&eulumdat::write(&bright)).unwrap();
        assert!(
            (again.peak() - bright.peak()).abs() <= 1e-6 * bright.peak(),
            "{} cd of {} cd",
            again.peak(),
            bright.peak()
        );
    }
}

#[test]
fn an_index_has_no_negative_light_and_no_size_that_is_written_as_nothing() {
    let error = told(luminaire_index::read(&stored("index", "flux-below-zero")));
    assert!(error.contains("line 2: flux_lm -5e0; expected light, 0 or more"), "{error}");
    let error = told(luminaire_index::read(&stored("index", "size-that-is-written-as-zero")));
    assert!(error.contains("line 2: width 1e-9; expected a length above 0 m"), "{error}");
}

#[test]
fn messages_do_not_repeat_a_whole_file() {
    let word = "x".repeat(100_000);
    assert!(told(scan::read_scan(format!("1 2 3\n{word}\n").as_bytes())).len() < 200);
    let scene = format!("[room]\n{word} = 1\n");
    assert!(told(SceneFile::parse(&scene)).len() < 2000);
}

#[test]
fn texts_beyond_what_such_files_have_are_refused_before_their_words_are_listed() {
    // A gigabyte of numbers took sixteen of memory.
    let long = " ".repeat(limits::TEXT_BYTES + 1);
    let bytes = long.as_bytes();
    let length = bytes.len().to_string();
    for error in [
        told(ies::read(bytes)),
        told(eulumdat::read(bytes)),
        told(luminaire_index::read(bytes)),
        told(scan::read_scan(bytes)),
        told(read_control_curve(bytes)),
        told(SceneFile::parse(&long)),
    ] {
        assert!(error.contains(&format!("a text of {length} bytes; expected at most")), "{error}");
    }
    assert!(told(ies::read(&bytes[..limits::TEXT_BYTES])).contains("no TILT line"));
}

#[test]
fn apertures_beyond_counting_are_refused_before_each_is_held_against_all_others() {
    struct Nothing;
    impl SystemLibrary for Nothing {
        fn load(
            &self,
            _: &cfs::study::scene_file::SystemKeys,
            _: &Path,
            _: cfs::study::system::Need,
        ) -> Result<std::sync::Arc<cfs::study::System>, cfs::study::StudyError> {
            panic!("apertures are judged first")
        }
        fn controlled_state(
            &self,
            _: &str,
            _: &cfs::study::control::ControlQuestion<'_>,
        ) -> Result<String, cfs::study::StudyError> {
            panic!("apertures are judged first")
        }
    }
    let office = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/office.toml")).unwrap();
    let mut file = SceneFile::parse(&office).unwrap();
    file.aperture = vec![file.aperture[0].clone(); limits::APERTURES + 1];
    let error = told(Scene::resolve(&file, Path::new("."), &Nothing));
    assert_eq!(error, "aperture: 10001 apertures (allowed: up to 10000)");
}

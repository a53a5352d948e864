//! Hours of a year against the rooms of the same moments, where beams, trees and skylines come in: what the year prepares once
//! must not be told from what is computed for the hour alone.

use crate::rooms::*;
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{Btdf, CellMatrix, Dataset, Scattered, TensorTree, TreeAxes, TreeNode, TreeRank};
use cfs::compute::estimate::Silent;
use cfs::study::year::{Step, scene_at, year};
use cfs::study::{Library, Scene, SceneFile, Session, SystemLibrary};
use std::path::Path;

/// High and low suns, before the façade, beside and behind it, and a sky without sun.
const WEATHER: &str = "place Test\nlatitude 40\nlongitude 0\ntime_zone 0\nsite_elevation 0\nweather_data_file_units 1\n\
                       12 21 9.5 500 60\n12 21 12.5 750 70\n3 21 15.5 600 110\n6 21 6.5 400 80\n6 21 12.5 850 110\n11 2 11.5 0 120\n";
const SUNNY_BEFORE_THE_FACADE: usize = 4;
const BLIND: &str = "name = \"Blind\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 0.072\n\
    angles = [0.0, 45.0]\nupper = { reflectance = 0.6 }\nlower = { reflectance = 0.5 }\n";

/// A room that reflects, with four sensors, one at the window.
fn text(system: &str, sky: &str, more: &str) -> String {
    format!(
        "[room]\nwidth = 4.0\ndepth = 5.0\nheight = 3.0\nreflectance = {{ floor = 0.2, walls = 0.5, ceiling = 0.7 }}\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 0.9]\nsize = [3.0, 1.8]\nreflectance = 0.1\nsystem = {system}\n\
         [site]\nazimuth = 170.0\nlatitude = 40.0\nlongitude = 0.0\nutc_offset = 0.0\nground_reflectance = 0.2\n\
         [sky]\nmodel = \"uniform\"\ndiffuse_horizontal = 1.0\n{sky}\n\
         [sensors]\npoints = [[1.8, 0.6, 0.8], [2.6, 1.4, 0.8], [1.2, 2.6, 0.8], [2.0, 4.4, 0.8]]\n\
         {more}\n[year]\nweather = \"w.wea\"\n"
    )
}

/// What an hour is found to be.
struct Hour {
    /// Light of beams at the sensors in the room of the moment. \[lx\]
    beams: Vec<f64>,
    /// All of it. \[lx\]
    light: Vec<f64>,
}

/// What is seen straight through under a sky that is steep about the sun may be off by so much more than is stated, which is
/// judged under other skies.
const STEEP: f64 = 2e-3;

/// Every hour lies within the errors that both state for themselves, plus `slack` of its value, and within `bound` of it. The
/// data's limit, which both share, is left out where the room tells it apart.
fn hours_are_moments(name: &str, text: &str, library: &dyn SystemLibrary, [slack, bound]: [f64; 2]) -> Vec<Hour> {
    let folder = tempfile::tempdir().unwrap();
    let base = folder.path();
    std::fs::write(base.join("w.wea"), WEATHER).unwrap();
    std::fs::write(base.join("blind.system.toml"), BLIND).unwrap();
    let file = SceneFile::parse(text).unwrap();
    let session = Session::new();
    let year = year(&file, base, library, &session, &|_| true, &Silent).unwrap();
    assert_eq!(year.light.dark, 0, "{name}");
    // By itself: nothing of what the year has prepared stands in for the moment.
    let moments = Session::new();
    let places = year.light.places;
    let mut hours = Vec::new();
    for (row, &k) in year.chosen.iter().enumerate() {
        let time = year.steps.list[k].time;
        let hour = scene_at(&file, base, library, time, &Silent).unwrap();
        let scene = Scene::resolve(&hour, Path::new(base), library).unwrap();
        let room = moments.room(&scene, &Silent).unwrap();
        let mean = totals(&room).iter().sum::<f64>() / places as f64;
        assert!(mean > 1.0, "{name}, {time}: {mean} lx");
        let mut worst: f64 = 0.0;
        for (s, sensor) in room.sensors.iter().enumerate() {
            let [own, error] = [&year.light.values, &year.light.errors].map(|table| f64::from(table.row(row)[s]));
            let moment = sensor.total().value;
            let off = (own - moment).abs();
            worst = worst.max(off / moment.max(0.05 * mean));
            assert!(
                off <= error + sensor.numerical_error() + slack * moment,
                "{name}, {time}, sensor {}: {own} ± {error} lx, the room {moment} ± {}",
                s + 1,
                sensor.numerical_error()
            );
        }
        println!("{name}, {time}: {worst:.1e} of {mean:.0} lx");
        assert!(worst <= bound, "{name}, {time}: {worst}");
        let beams = room.sensors.iter().map(|sensor| sensor.beam).collect();
        hours.push(Hour { beams, light: totals(&room) });
    }
    hours
}

/// Sensor hours with and without a beam, of the sunny ones before the façade: both have to be looked at.
fn lit(hours: &[Hour]) -> (usize, usize) {
    let all = hours.iter().flat_map(|hour| &hour.beams);
    let with = all.filter(|beam| **beam > 100.0).count();
    (with, SUNNY_BEFORE_THE_FACADE * hours[0].beams.len() - with)
}

#[test]
fn light_between_slats_is_that_of_the_moment() {
    let library = Library::default();
    let of = |state: &str| text(&format!("{{ file = \"blind.system.toml\", state = \"{state}\" }}"), "", "");
    let flat = hours_are_moments("flat slats", &of("0"), &library, [0.0, 5e-3]);
    let (with, without) = lit(&flat);
    assert!(with > 0 && without > 0, "{with} {without}");
    let closed = hours_are_moments("closed slats", &of("45"), &library, [0.0, 5e-3]);
    assert!(lit(&closed).0 < with);
    assert!(closed.iter().zip(&flat).all(|(a, b)| a.light[3] < b.light[3]));
}

#[test]
fn slats_that_follow_the_sun_are_those_of_the_moment() {
    let system = "{ file = \"blind.system.toml\", state = \"controlled\" }";
    let control = "[control]\nmode = \"cut-off\"\n";
    let hours = hours_are_moments("cut-off", &text(system, "", control), &Library::default(), [0.0, 5e-3]);
    assert_eq!(lit(&hours).0, 0, "what the control lets through is no beam");
}

#[test]
fn a_beam_taken_out_of_cells_is_that_of_the_moment() {
    let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let n = basis.len();
    let mut values = vec![0.04; n * n];
    for (k, weight) in basis.projected_solid_angles().into_iter().enumerate() {
        values[k * n + k] += 0.5 / weight;
    }
    let made = Made(Some(from_matrix(CellMatrix::new(basis.clone(), basis, values).unwrap())));
    let hours = hours_are_moments("peak in cells", &text(MADE, "", ""), &made, [0.0, 5e-3]);
    let (with, without) = lit(&hours);
    assert!(with > 0 && without > 0, "{with} {without}");
}

/// A tree of uneven depth with values that nothing makes regular.
fn grown() -> Dataset {
    fn grow(place: usize, level: u32, nodes: &mut Vec<TreeNode>, seed: &mut u64) {
        let mut random = || {
            *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (*seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        if level == 3 || (level > 0 && random() < 0.3) {
            nodes[place] = TreeNode::Leaf(0.3 * random());
            return;
        }
        let start = nodes.len();
        nodes[place] = TreeNode::Branch(u32::try_from(start).unwrap());
        nodes.extend(vec![TreeNode::Leaf(0.0); TreeRank::Three.children()]);
        for child in 0..TreeRank::Three.children() {
            grow(start + child, level + 1, nodes, seed);
        }
    }
    let (mut nodes, mut seed) = (vec![TreeNode::Leaf(0.0)], 5);
    grow(0, 0, &mut nodes, &mut seed);
    let tree = TensorTree::new(TreeRank::Three, TreeAxes::Front, nodes).unwrap();
    let mut dataset = Dataset { name: "made".into(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf { regular: None, scattered: Some(Scattered::Tree(Box::new(tree))) });
    dataset
}

#[test]
fn a_tree_is_that_of_the_moment() {
    hours_are_moments("tree", &text(MADE, "", ""), &Made(Some(grown())), [0.0, 5e-3]);
}

#[test]
fn a_skyline_of_bearings_is_that_of_the_moment() {
    let skyline = "skyline = { altitudes = [[100.0, 8.0], [150.0, 30.0], [185.0, 34.0], [190.0, 5.0], [260.0, 20.0]], luminance = 800.0 }";
    let made = Made(Some(klems(rough)));
    // Of what is seen straight through, a corner of the sky between the roofs hangs on few directions: its errors say so.
    let pane = hours_are_moments("pane behind a skyline", &text(TRANSPARENT, skyline, ""), &made, [STEEP, 0.1]);
    let open = hours_are_moments("pane", &text(TRANSPARENT, "", ""), &made, [STEEP, 2e-2]);
    // The morning's sun of December stands behind it, that of noon in its gap.
    let sum = |hours: &[Hour], k: usize| hours[k].beams.iter().sum::<f64>();
    assert!(sum(&open, 0) > 0.0 && sum(&pane, 0) == 0.0, "{} {}", sum(&open, 0), sum(&pane, 0));
    assert!((sum(&pane, 1) / sum(&open, 1) - 1.0).abs() < 1e-6, "{} {}", sum(&pane, 1), sum(&open, 1));
    hours_are_moments("cells behind a skyline", &text(MADE, skyline, ""), &made, [0.0, 2e-2]);
}

/// An overhang, a fin, a neighbour and the building itself.
const BOXES: &str = "[[outside]]\nbox = { from = [-0.5, -1.2, 2.75], to = [4.5, 0.0, 2.9] }\nreflectance = 0.5\n\
    [[outside]]\nbox = { from = [3.55, -0.9, 0.5], to = [3.7, 0.0, 2.7] }\nreflectance = 0.6\n\
    [[outside]]\nbox = { from = [-10.0, -25.0, 0.0], to = [14.0, -15.0, 8.0] }\nreflectance = 0.3\n\
    [building]\nfrom = [-6.0, 0.0, 0.0]\nto = [10.0, 12.0, 9.0]\nreflectance = 0.3\n";

/// Hours of June, beside those of the whole year and by themselves.
#[test]
fn hours_behind_boxes_do_not_depend_on_the_number_computed_together() {
    let file = SceneFile::parse(&text(MADE, "", BOXES).replace("w.wea", "builtin:renton")).unwrap();
    let made = Made(Some(klems(rough)));
    let of =
        |wanted: &dyn Fn(&Step) -> bool| year(&file, Path::new("."), &made, &Session::new(), wanted, &Silent).unwrap();
    let (all, june) = (of(&|_| true), of(&|step| step.month == 6));
    assert!(june.chosen.len() == 720 && june.light.dark < 360 && all.chosen.len() == 8760);
    for (row, &k) in june.chosen.iter().enumerate() {
        assert_eq!(june.light.values.row(row), all.light.values.row(k), "{}", june.steps.list[k].time);
    }
}

#[test]
fn light_behind_boxes_is_that_of_the_moment() {
    let made = Made(Some(klems(rough)));
    // Shares of cells stand for edges of shadows outside.
    hours_are_moments("pane behind boxes", &text(TRANSPARENT, "", BOXES), &made, [0.0, 8e-3]);
    hours_are_moments("cells behind boxes", &text(MADE, "", BOXES), &made, [0.0, 2e-2]);
}

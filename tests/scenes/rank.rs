//! Rankings as the library makes them: coarse results before full ones, cancelling, other weights.

use cfs::catalogue::{Catalogue, NewProduct};
use cfs::compute::btdf::{Btdf, Dataset};
use cfs::compute::estimate::{Estimate, Progress, Silent};
use cfs::compute::rank::{Better, Objective};
use cfs::study::rank::{Found, Group, Item, List, Parts, Row, Shard, Stage, groups, keys, lists_of, run};
use cfs::study::year::{Need, Step, climate, figures, metrics, year_in};
use cfs::study::{Library, SceneFile, Session, Store, StudyError};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

const SCENE: &str = r#"
[room]
width = 4.0
depth = 5.0
height = 3.0
reflectance = { floor = 0.2, walls = 0.5, ceiling = 0.7 }
[[aperture]]
surface = "facade"
origin = [0.5, 1.0]
size = [3.0, 1.8]
reflectance = 0.0
system = "ranked"
[site]
latitude = 47.48
longitude = -122.22
utc_offset = -8.0
ground_reflectance = 0.2
[sky]
model = "uniform"
diffuse_horizontal = 1.0
[sensors]
plane = { z = 0.85, nx = 1, ny = 2 }
[year]
weather = "builtin:renton"
[year.lighting]
power = 10.0
target = 500.0
[rank]
[[rank.objective]]
figure = "lighting.LENI_kWh_m2"
better = "less"
worst = 36.5
best = 0.0
[[rank.objective]]
figure = "cDA300"
better = "more"
worst = 0.0
best = 1.0
[[rank.objective]]
figure = "EN17037.minimum.target.time_by_hour"
better = "more"
worst = 0.0
best = 1.0
[[rank.objective]]
figure = "ASE1000_250"
better = "less"
worst = 1.0
best = 0.0
"#;

/// A catalogue with diffusers of these transmittances, and the list that the scene asks for.
fn prepared(folder: &Path, scene: &str, taus: &[f64]) -> (Library, Vec<Group>) {
    let path = folder.join("catalogue.cfsdb");
    let mut catalogue = Catalogue::open(&path).unwrap();
    for tau in taus {
        let mut dataset = Dataset { name: format!("Rankling {tau}"), ..Dataset::default() };
        dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(*tau));
        catalogue.import(&[dataset], NewProduct::default()).unwrap();
    }
    drop(catalogue);
    let library = Library::with_catalogue(Some(&path));
    let find = |words: &str| library.search(words).map(|(products, _)| products);
    let groups = groups("scene", &SceneFile::parse(scene).unwrap(), folder, Some("rankling"), &find).unwrap();
    (library, groups)
}

fn all(groups: &[Group]) -> Vec<Item> {
    Shard::WHOLE.items(&groups.iter().map(|group| group.products.len()).collect::<Vec<_>>())
}

#[test]
fn data_on_cells_come_first_and_their_errors_hold_what_follows() {
    let folder = tempfile::tempdir().unwrap();
    let (library, groups) = prepared(folder.path(), SCENE, &[0.2, 0.4, 0.6]);
    let items = all(&groups);
    let heard: Mutex<Vec<(Stage, Item, Found)>> = Mutex::new(Vec::new());
    let told = |answer: cfs::study::rank::Answer<'_>| {
        heard.lock().unwrap().push((answer.stage, answer.item, answer.outcome.clone().unwrap()));
    };
    let outcomes =
        run(&groups, &items, &library, &Session::new(), &[Stage::Coarse, Stage::Full], &told, &Silent).unwrap();
    let heard = heard.into_inner().unwrap();
    assert_eq!(heard.len(), 6);
    assert!(heard[..3].iter().all(|(stage, ..)| *stage == Stage::Coarse), "all of them before any with beams");
    for (_, item, coarse) in &heard[..3] {
        let full = outcomes[item.product].as_ref().unwrap();
        for (k, (coarse, full)) in coarse.figures.iter().zip(&full.figures).enumerate() {
            // A diffuser's data have no beams to blur.
            assert!((coarse.value - full.value).abs() <= full.error, "{k}: {coarse:?} {full:?}");
            assert!(coarse.error > full.error || k == 3, "{k}: {coarse:?} {full:?}");
        }
        assert_eq!(full.figures[3], Estimate::exact(0.0), "no sun comes through a diffuser");
        // Sums over hours, zones and sensors: what is left are digits.
        for k in [0, 1] {
            let sum: f64 = full.parts[k].values.iter().sum();
            assert!((sum - full.figures[k].value).abs() < 1e-7 * sum, "{k}");
        }
        assert!(full.parts[2].values.is_empty());
    }
    // By one thread: what is coarsely the best comes first.
    let order: Mutex<Vec<usize>> = Mutex::new(Vec::new());
    let told = |answer: cfs::study::rank::Answer<'_>| {
        if answer.stage == Stage::Full {
            order.lock().unwrap().push(answer.item.product);
        }
    };
    let stages = [Stage::Coarse, Stage::Full];
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    alone.install(|| run(&groups, &items, &library, &Session::new(), &stages, &told, &Silent)).unwrap();
    assert_eq!(order.into_inner().unwrap(), [2, 1, 0], "the more light the better");
    // The same by pieces of one, whatever was computed before.
    let keys = keys(&groups, &items);
    assert!(keys[0] != keys[1] && keys[1] != keys[2]);
    for (item, outcome) in items.iter().zip(&outcomes) {
        let alone = run(&groups, &[*item], &library, &Session::new(), &[Stage::Full], &|_| (), &Silent).unwrap();
        assert_eq!(&alone[0], outcome);
    }
    let lists = lists_of(&groups, &items, outcomes, &keys);
    let ranking = lists[0].ranking(&lists[0].objectives);
    let names: Vec<&str> = ranking.order.iter().map(|&k| lists[0].ranked()[k].0.product.as_str()).collect();
    assert_eq!(
        names,
        ["rankling-0-6", "rankling-0-4", "rankling-0-2"],
        "the more light the better, as nothing is too much here"
    );
}

/// A pane whose figures need not the hours without people: none but those that say so.
#[test]
fn figures_of_occupied_hours_do_without_the_others() {
    let text = SCENE
        .replace("system = \"ranked\"", "system = { ideal = \"transparent\", transmittance = 0.6 }")
        .replace("[year.lighting]", "lm83 = true\nsolar = true\neyes = [{ point = [2.0, 2.5, 1.2], direction = [0.0, -1.0, 0.0] }]\n[year.lighting]");
    let file = SceneFile::parse(&text[..text.find("[rank]").unwrap()]).unwrap();
    let (library, base) = (Library::default(), Path::new("."));
    let mut climate = climate(&file, base).unwrap();
    let [all, occupied] = [true, false].map(|unoccupied| {
        climate.settings.unoccupied = unoccupied;
        let year = year_in(&climate, &file, base, &library, &Session::new(), &|_| true, &Silent).unwrap();
        let stated = metrics(&year, &figures(&year)).into_iter();
        let own: Vec<(String, f64, bool)> = stated
            .filter_map(|one| Some((one.key(), one.estimate()?.value, one.metric.needs.contains(&Need::Unoccupied))))
            .collect();
        (year.light.dark, own)
    });
    assert!(occupied.0 > all.0 + 800, "{} {}", occupied.0, all.0);
    let same: Vec<_> = all.1.iter().filter(|(.., unoccupied)| !unoccupied).collect();
    assert!(same.len() > 20 && same.len() + 10 < all.1.len() && same.len() == occupied.1.len(), "{same:?}");
    for ((key, a, _), (other, b, _)) in same.into_iter().zip(&occupied.1) {
        assert!(key == other && (a - b).abs() <= 1e-9 * a.abs(), "{key}: {a}, {other}: {b}");
    }
}

/// However little a session may store: what the products of a climate share need not be computed for each.
#[test]
fn the_light_of_a_year_stays_in_use_from_product_to_product() {
    // Black, so that nothing else is as large.
    let text = SCENE
        .replace("system = \"ranked\"", "system = { ideal = \"transparent\", transmittance = 0.6 }")
        .replace("floor = 0.2, walls = 0.5, ceiling = 0.7", "floor = 0.0, walls = 0.0, ceiling = 0.0");
    let file = SceneFile::parse(&text[..text.find("[rank]").unwrap()]).unwrap();
    let base = Path::new(".");
    let climate = climate(&file, base).unwrap();
    let store = Arc::new(Store::new(1));
    let session = Session::storing(&store);
    let march = |step: &Step| step.month == 3;
    year_in(&climate, &file, base, &Library::default(), &session, &march, &Silent).unwrap();
    store.set_limit(0);
    assert!(store.bytes() > 8760 * 16, "{} bytes are less than the hours of a year", store.bytes());
    drop(climate);
    store.set_limit(1);
    assert_eq!(store.bytes(), 0);
}

/// Prisms are the worst of the built-in products: their fans are as wide as cells.
#[test]
fn what_beams_change_is_within_the_errors_of_data_on_cells() {
    let folder = tempfile::tempdir().unwrap();
    let library = Library::with_catalogue(Some(&folder.path().join("catalogue.cfsdb")));
    let text = SCENE.replace("reflectance = 0.0\n", "").replace("EN17037.minimum.target.time_by_hour", "UDI_x").replace(
        "[year]\nweather = \"builtin:renton\"\n",
        "[year]\nweather = \"builtin:renton\"\neyes = [{ point = [2.0, 2.5, 1.2], direction = [0.0, -1.0, 0.0] }]\n",
    );
    let scene = SceneFile::parse(&text.replace("ASE1000_250", "glare.Ev_1.share_above_0.40")).unwrap();
    for words in ["prismatic-45-45", "laser-cut-panel-100"] {
        let find = |words: &str| library.search(words).map(|(products, _)| products);
        let groups = groups("scene", &scene, folder.path(), Some(words), &find).unwrap();
        let item = all(&groups).into_iter().find(|item| groups[0].products[item.product].key == words).unwrap();
        let of = |stage| {
            let found = run(&groups, &[item], &library, &Session::new(), &[stage], &|_| (), &Silent).unwrap();
            found.into_iter().next().unwrap().unwrap().figures
        };
        let (coarse, full) = (of(Stage::Coarse), of(Stage::Full));
        assert_ne!(coarse, full, "beams change something");
        for (k, (coarse, full)) in coarse.iter().zip(&full).enumerate() {
            assert!((coarse.value - full.value).abs() <= coarse.error + full.error, "{words} {k}: {coarse:?} {full:?}");
        }
    }
}

#[test]
fn a_shade_that_stands_in_for_blinds_is_told() {
    let folder = tempfile::tempdir().unwrap();
    for (figure, told) in
        [("cDA300", vec![]), ("sDA300_50_LM83_12", vec!["LM-83: a shade of 5 % stands in for blinds"])]
    {
        let (library, groups) = prepared(folder.path(), &SCENE.replace("cDA300", figure), &[0.3]);
        let outcomes =
            run(&groups, &all(&groups), &library, &Session::new(), &[Stage::Full], &|_| (), &Silent).unwrap();
        assert_eq!(outcomes[0].as_ref().unwrap().approximate, told);
    }
}

/// On another machine they may wait to be computed: the same row has to come of it.
#[test]
fn whether_data_of_a_description_are_there_yet_is_not_told() {
    let folder = tempfile::tempdir().unwrap();
    let library = Library::with_catalogue(Some(&folder.path().join("catalogue.cfsdb")));
    let scene = SceneFile::parse(&SCENE.replace("reflectance = 0.0\n", "")).unwrap();
    let asked = || {
        let find = |words: &str| library.search(words).map(|(products, _)| products);
        let groups = groups("scene", &scene, folder.path(), Some("egg-crate-white"), &find).unwrap();
        let found = run(&groups, &all(&groups), &library, &Session::new(), &[Stage::Coarse], &|_| (), &Silent).unwrap();
        let missed = groups[0].products[0].findings.iter().any(|finding| finding.code == "error-target-missed");
        (missed, found.into_iter().next().unwrap().unwrap(), keys(&groups, &all(&groups)))
    };
    let (before, after) = (asked(), asked());
    assert_eq!((before.0, after.0), (false, true), "the first asking computes the data");
    assert_eq!((before.1, before.2), (after.1, after.2));
}

/// Withdrawn when the first product is finished.
#[derive(Default)]
struct Impatient(AtomicUsize);

impl Progress for Impatient {
    fn advance(&self, stage: &'static str, _: usize, _: usize) {
        if stage == "products" {
            self.0.fetch_add(1, Ordering::Relaxed);
        }
    }

    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed) > 0
    }
}

#[test]
fn a_ranking_can_be_withdrawn() {
    let folder = tempfile::tempdir().unwrap();
    let (library, groups) = prepared(folder.path(), SCENE, &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
    let answer = run(&groups, &all(&groups), &library, &Session::new(), &[Stage::Full], &|_| (), &Impatient::default());
    assert!(matches!(answer, Err(StudyError::Cancelled(_))), "{answer:?}");
}

#[test]
fn other_weights_order_anew() {
    let objective = |better, worst, best| Objective { better, worst, best, weight: 1.0 };
    let objectives = vec![objective(Better::Less, 12.0, 2.0), objective(Better::More, 0.0, 1.0)];
    // Figures of a hundred products, spread evenly.
    let row = |k: usize| {
        let [a, b] = [0.618_034, 0.754_878].map(|step: f64| (step * k as f64).fract());
        let parts =
            Parts { zones: vec!["front".to_owned(), "rear".to_owned()], values: vec![(2.0 + 10.0 * a) / 16.0; 16] };
        let figures = vec![Estimate::new(2.0 + 10.0 * a, 0.1), Estimate::new(b, 0.02)];
        let found = Found { figures, parts: vec![parts, Parts::default()], approximate: Vec::new() };
        Row { product: format!("p{k:03}"), key: String::new(), outcome: Ok(found) }
    };
    let list = List {
        number: 0,
        scene: String::new(),
        climate: String::new(),
        azimuth: 180.0,
        figures: vec!["a".to_owned(), "b".to_owned()],
        objectives: objectives.clone(),
        rows: (0..100).map(row).collect(),
    };
    let first = |weight: f64| {
        let mut other = objectives.clone();
        other[0].weight = weight;
        let ranking = list.ranking(&other);
        assert_eq!(ranking.list.len(), 100);
        ranking.order[0]
    };
    let least = |of: &dyn Fn(usize) -> f64| (0..100).min_by(|&a, &b| of(a).total_cmp(&of(b))).unwrap();
    let figures = |k: usize| list.rows[k].outcome.as_ref().unwrap().figures.clone();
    assert_eq!(first(1e6), least(&|k| figures(k)[0].value));
    assert_eq!(first(1e-6), least(&|k| -figures(k)[1].value));
}

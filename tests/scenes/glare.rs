//! Glare at an eye: patches against 10⁵ directions of the same luminances, sources found by other means; hours of a year
//! against the same hours as scenes.

use crate::common::data;
use cfs::compute::direction::{Dir, Emergent};
use cfs::compute::estimate::Silent;
use cfs::compute::glare::{Gaze, Kind, dgp, position_index};
use cfs::compute::room::direct::Sensor;
use cfs::study::year::{scene_at, year};
use cfs::study::{Library, Scene, SceneFile, Session};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use std::path::Path;

const EYES: [([f64; 3], [f64; 3]); 2] = [([2.5, 2.0, 1.2], [0.0, -1.0, 0.0]), ([1.2, 1.4, 1.2], [0.8, -0.6, 0.0])];

fn eye((position, normal): ([f64; 3], [f64; 3])) -> Sensor {
    Sensor { position: DVec3::from_array(position), normal: DVec3::from_array(normal) }
}

/// A room behind a system under a clear sky.
fn text(system: &str, sun: [f64; 2]) -> String {
    format!(
        "[room]\nwidth = 5.0\ndepth = 6.0\nheight = 3.0\nreflectance = {{ floor = 0.2, walls = 0.5, ceiling = 0.7 }}\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 0.9]\nsize = [4.0, 1.8]\nreflectance = 0.0\n\
         system = {system}\n[site]\nazimuth = 180.0\nground_reflectance = 0.2\n\
         [sky]\nmodel = \"cie\"\ntype = 12\ndiffuse_horizontal = 20000.0\n\
         sun = {{ altitude = {}, azimuth = {}, direct_normal = 70000.0 }}\n\
         [sensors]\npoints = [[2.5, 2.0, 0.85]]\nnormal = [0.0, 0.0, 1.0]\n",
        sun[0], sun[1]
    )
}

/// Sources of a picture of even pixels: Σ L² ω / P², by flooding from pixel to pixel within 0.1 rad.
fn sources_of_picture(scene: &Scene, session: &Session, eye: &Sensor, side: usize) -> f64 {
    let gaze = Gaze::new(eye);
    let lids: Vec<_> =
        (0..scene.apertures.len()).map(|index| session.lid(scene, index, &Silent).unwrap().lid).collect();
    let step = PI / side as f64;
    let mut bright: Vec<(DVec2, DVec3, f64, f64)> = Vec::new();
    for at in 0..side * side {
        let place = step * (DVec2::new((at % side) as f64, (at / side) as f64) + 0.5) - 0.5 * PI;
        let sigma = place.length();
        if sigma >= 0.5 * PI {
            continue;
        }
        let to = gaze.direction(place);
        let solid_angle = step * step * sigma.sin() / sigma;
        for (one, lid) in scene.apertures.iter().zip(&lids) {
            let aperture = &one.aperture;
            let through = aperture.surface.facade_from_room(to);
            let corner = aperture.surface.facade_from_room(aperture.corner - eye.position);
            let on = through * (corner.z / through.z) - corner;
            if through.z > 0.0 && (0.0..aperture.size[0]).contains(&on.x) && (0.0..aperture.size[1]).contains(&on.y) {
                let luminance = lid.luminance(Emergent::from_undeviated(Dir::from_unit(through)));
                if luminance > 2000.0 {
                    bright.push((place, to, luminance, solid_angle));
                }
            }
        }
    }
    let sum = |group: &[usize]| {
        let (mut omega, mut flux, mut middle) = (0.0, 0.0, DVec2::ZERO);
        for &k in group {
            let (place, _, luminance, solid_angle) = bright[k];
            omega += solid_angle;
            flux += luminance * solid_angle;
            middle += luminance * solid_angle * place;
        }
        if omega > 0.0 { flux * flux / omega / position_index(middle / flux).powi(2) } else { 0.0 }
    };
    flooded(&bright, 0.1)
        .iter()
        .map(|group| {
            let (peak, rest): (Vec<usize>, Vec<usize>) = group.iter().partition(|&&k| bright[k].2 >= 5e4);
            let picked: Vec<_> = peak.iter().map(|&k| bright[k]).collect();
            let peaks = flooded(&picked, 0.1);
            let of = |part: &Vec<usize>| part.iter().map(|&k| peak[k]).collect::<Vec<_>>();
            sum(&rest) + peaks.iter().map(|part| sum(&of(part))).sum::<f64>()
        })
        .sum()
}

/// Groups of what is within an angle, from one to the next; by tiles of the picture.
fn flooded(list: &[(DVec2, DVec3, f64, f64)], within: f64) -> Vec<Vec<usize>> {
    let tile = |place: DVec2| (place / within).floor().as_ivec2();
    let mut tiles: std::collections::HashMap<glam::IVec2, Vec<usize>> = std::collections::HashMap::new();
    for (k, one) in list.iter().enumerate() {
        tiles.entry(tile(one.0)).or_default().push(k);
    }
    let cosine = within.cos();
    let mut groups = Vec::new();
    for first in 0..list.len() {
        let own = tiles.get_mut(&tile(list[first].0)).unwrap();
        let Some(at) = own.iter().position(|&k| k == first) else { continue };
        own.swap_remove(at);
        let mut group = vec![first];
        let mut next = 0;
        while next < group.len() {
            let (place, to, ..) = list[group[next]];
            let middle = tile(place);
            // The picture stretches by up to π/2: two tiles on.
            for (dx, dy) in (-2..=2).flat_map(|dx| (-2..=2).map(move |dy| (dx, dy))) {
                if let Some(others) = tiles.get_mut(&(middle + glam::IVec2::new(dx, dy))) {
                    let (near, far): (Vec<usize>, Vec<usize>) =
                        others.iter().partition(|&&k| list[k].1.dot(to) >= cosine);
                    *others = far;
                    group.extend(near);
                }
            }
            next += 1;
        }
        groups.push(group);
    }
    groups
}

/// The same by patches and by the picture, within 0.002.
fn patches_are_the_picture(scene: &Scene, name: &str) {
    let session = Session::new();
    for eye in EYES.map(eye) {
        let found = session.glare(scene, &eye, &Silent).unwrap();
        let picture = sources_of_picture(scene, &session, &eye, 360);
        let own: f64 = found.glare.sources.sum;
        let expected = dgp(found.vertical.value, picture);
        let off = (found.glare.dgp.value - expected).abs();
        println!("{name}: DGP {:.4} of {expected:.4}, Σ {own:.4e} of {picture:.4e}", found.glare.dgp.value);
        assert!(off <= 0.002, "{name}: {} of {expected}", found.glare.dgp.value);
        assert!(off <= found.glare.dgp.error + 1e-4, "{name}: {off} of ± {}", found.glare.dgp.error);
        assert!(
            found.discs.is_empty()
                && found.dgps.is_some() != found.glare.sources.list.iter().any(|s| s.kind != Kind::Bright)
        );
        assert!(found.glare.dgp.error < 0.03, "{name}: ± {}", found.glare.dgp.error);
    }
}

fn resolved(text: &str, base: &Path) -> Scene {
    Scene::resolve(&SceneFile::parse(text).unwrap(), base, &Library::default()).unwrap()
}

#[test]
fn patches_of_a_pane_and_of_an_even_sheet_are_10_5_directions() {
    // The sun stands beside what the eyes see.
    let folder = Path::new(".");
    let pane = resolved(&text("{ ideal = \"transparent\", transmittance = 0.65 }", [35.0, 250.0]), folder);
    patches_are_the_picture(&pane, "pane");
    let even = resolved(&text("{ ideal = \"diffuse\", transmittance = 0.45 }", [35.0, 200.0]), folder);
    patches_are_the_picture(&even, "even");
}

#[test]
fn patches_of_slats_on_cells_are_10_5_directions() {
    let Some(folder) = data("reference/cases/annual") else { return };
    for (file, sun) in
        [("slats_0.xml", [50.0, 190.0]), ("slats_45.xml", [30.0, 170.0]), ("slats_15.xml", [25.0, 140.0])]
    {
        let text = text(&format!("{{ file = \"{file}\" }}"), sun) + "[compute]\ninterpolation = \"patch\"\n";
        patches_are_the_picture(&resolved(&text, &folder), file);
    }
}

#[test]
fn a_sun_straight_at_the_eye_is_a_source_of_its_own_size() {
    let scene = resolved(&text("{ ideal = \"transparent\", transmittance = 0.5 }", [10.0, 180.0]), Path::new("."));
    let found = Session::new().glare(&scene, &eye(EYES[0]), &Silent).unwrap();
    let sun = found.glare.sources.list[0];
    assert_eq!((sun.kind, found.dgps), (Kind::Sun, None));
    let disc = PI * 0.2665_f64.to_radians().powi(2);
    assert!((sun.luminance / (0.5 * 70000.0 / disc) - 1.0).abs() < 1e-9 && (sun.solid_angle / disc - 1.0).abs() < 1e-9);
    // 10° above the line of sight: Guth's index exp(0.03398·10 + 21e-5·100).
    assert!((sun.position_index / (0.3398_f64 + 0.021).exp() - 1.0).abs() < 1e-6, "{}", sun.position_index);
    assert!(found.glare.dgp.value > 0.45);
    // Past the lintel nothing of it is seen.
    let high = resolved(&text("{ ideal = \"transparent\", transmittance = 0.5 }", [60.0, 180.0]), Path::new("."));
    let found = Session::new().glare(&high, &eye(EYES[0]), &Silent).unwrap();
    assert!(found.discs.is_empty() && found.dgps.is_some());
}

/// Hours of a year have the glare of the same hours as scenes.
fn hours_are_moments(system: &str, [sky, more]: [&str; 2], times: &[&str], base: &Path) {
    let text = text(system, [35.0, 200.0])
        .replace(
            "azimuth = 180.0\nground",
            "azimuth = 180.0\nlatitude = 47.48\nlongitude = -122.22\nutc_offset = -8.0\nground",
        )
        .replace("[sensors]", &format!("{sky}[sensors]"));
    let [(a, b), (c, d)] = EYES;
    let text = format!(
        "{text}{more}[year]\nweather = \"builtin:renton\"\neyes = [{{ point = {a:?}, direction = {b:?} }}, \
         {{ point = {c:?}, direction = {d:?} }}]\n"
    );
    let file = SceneFile::parse(&text).unwrap();
    let (session, library) = (Session::new(), Library::default());
    let wanted = |step: &cfs::study::year::Step| times.iter().any(|time| step.time.to_string().contains(time));
    let year = year(&file, base, &library, &session, &wanted, &Silent).unwrap();
    let dgp = year.dgp.as_ref().unwrap();
    assert_eq!(year.chosen.len(), times.len());
    for (row, &k) in year.chosen.iter().enumerate() {
        let hour = scene_at(&file, base, &library, year.steps.list[k].time, &Silent).unwrap();
        let scene = Scene::resolve(&hour, base, &library).unwrap();
        for (number, one) in dgp.row(row).iter().enumerate() {
            let moment = session.glare(&scene, &eye(EYES[number]), &Silent).unwrap();
            let (own, expected) = (one.unwrap(), moment.glare.dgp);
            println!("{system} {row} {number}: {own:?} {expected:?}");
            let allowed = 0.002 + own.error + expected.error;
            assert!((own.value - expected.value).abs() <= allowed, "{system} {row}: {own:?} {expected:?}");
        }
    }
}

#[test]
fn hours_of_a_year_have_the_glare_of_the_same_moments() {
    let times = ["-12-21T12", "-03-21T09", "-06-21T15"];
    hours_are_moments("{ ideal = \"transparent\", transmittance = 0.65 }", ["", ""], &times, Path::new("."));
    hours_are_moments("{ ideal = \"diffuse\", transmittance = 0.45 }", ["", ""], &times, Path::new("."));
    // Described: slats by bands of the profile angle and by cells, panes before slats, prisms, walls of holes.
    let folder = tempfile::tempdir().unwrap();
    let slats = "kind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 0.072\nangles = [30.0]\n";
    let matt = "upper = { reflectance = 0.6 }\nlower = { reflectance = 0.5 }\n";
    let systems = [
        ("matt", format!("{slats}{matt}")),
        ("mirror", format!("{slats}upper = {{ reflectance = 0.15, specular = 0.7 }}\nlower = {{ reflectance = 0.3 }}\n")),
        ("pane", "kind = \"pane\"\n[pane]\nindex = 1.52\nthickness = 0.004\ntransmittance_normal = 0.9\npanes = 2\n".into()),
        ("behind", "kind = \"stack\"\n[stack]\nlayers = [{ file = \"pane.system.toml\" }, { file = \"matt.system.toml\", state = \"30\" }]\n".into()),
        ("panel", "kind = \"laser-cut-panel\"\n[laser-cut-panel]\nindex = 1.49\ndepth = 0.006\nspacing = 0.004\n".into()),
        ("grid", "kind = \"perforated\"\n[perforated]\nhole = \"rectangle\"\nwidth = 0.0127\nheight = 0.0127\npitch = [0.014, 0.014]\nthickness = 0.0127\nreflectance = 0.8\n".into()),
    ];
    for (name, description) in &systems {
        let file = folder.path().join(format!("{name}.system.toml"));
        std::fs::write(file, format!("name = \"{name}\"\n{description}")).unwrap();
    }
    for (name, _) in &systems {
        hours_are_moments(&format!("{{ file = \"{name}.system.toml\" }}"), ["", ""], &times, folder.path());
    }
    // Before the sun of March, not of December and June.
    let skyline =
        "skyline = { altitudes = [[100.0, 30.0], [140.0, 30.0], [170.0, 5.0], [260.0, 20.0]], luminance = 900.0 }\n";
    for system in ["{ ideal = \"transparent\", transmittance = 0.65 }", "{ file = \"mirror.system.toml\" }"] {
        hours_are_moments(system, [skyline, ""], &times, folder.path());
    }
    let Some(folder) = data("reference/cases/annual") else { return };
    let patch = "[compute]\ninterpolation = \"patch\"\n";
    hours_are_moments("{ file = \"slats_30.xml\" }", ["", patch], &times, &folder);
}

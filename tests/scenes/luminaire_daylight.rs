//! From a scene's sky to the luminaire file: the file holds the flux that the aperture lets in.

use cfs::compute::angle::Bearing;
use cfs::compute::btdf::{AngularTransmittance, Btdf, Scattered};
use cfs::compute::direction::{Orientation, Surface};
use cfs::compute::lid::c_gamma::{Aim, CGammaTable, Step};
use cfs::compute::lid::{Emission, Facing};
use cfs::formats::luminaire::{Description, Luminaire};
use cfs::formats::{eulumdat, ies};
use cfs::study::scene_file::SceneFile;
use cfs::study::sky::outside_from_keys;
use std::path::Path;

fn scene(direct_normal: f64) -> SceneFile {
    toml::from_str(&format!(
        r#"
[room]
width = 4.0
depth = 6.0
height = 3.0
reflectance = {{ floor = 0.2, walls = 0.5, ceiling = 0.7 }}
[[aperture]]
surface = "facade"
origin = [0.0, 1.0]
size = [4.0, 1.5]
system = {{ ideal = "transparent", transmittance = 0.8 }}
[site]
azimuth = 165.0
ground_reflectance = 0.2
[sky]
model = "cie"
type = 12
diffuse_horizontal = 12000.0
sun = {{ altitude = 25.0, azimuth = 190.0, direct_normal = {direct_normal} }}
[sensors]
points = [[2.0, 2.0, 0.85]]
normal = [0.0, 0.0, 1.0]
"#
    ))
    .expect("a scene file")
}

#[test]
fn file_flux_is_the_exitance_times_the_area() {
    let clear = Btdf { regular: Some(AngularTransmittance::Constant(0.8)), scattered: None };
    let diffuser = Btdf { regular: None, scattered: Some(Scattered::Lambert(AngularTransmittance::Constant(0.5))) };
    for direct_normal in [0.0, 60000.0] {
        let scene = scene(direct_normal);
        let (outside, sun) = outside_from_keys(&scene.sky, &scene.site, Path::new(".")).expect("sky");
        for surface in [Surface::Facade, Surface::Roof] {
            let facing = Facing {
                outside: &outside,
                sun: sun.as_ref(),
                orientation: Orientation::new(Bearing::from_degrees(165.0)),
                surface,
            };
            for btdf in [&clear, &diffuser] {
                let emission = Emission::new(btdf, &facing);
                // Integrated over incidence, not over emergence: an independent way to the same flux.
                let flux = emission.exitance(&facing).value * 6.0;
                let lid = emission.lid(&facing, [4.0, 1.5]);
                assert_eq!(!lid.beams.is_empty(), direct_normal > 0.0 && btdf.regular.is_some());
                let table = CGammaTable::new(&lid, Aim::of(surface), Step::for_lid(&lid));
                assert!((table.flux.value / flux - 1.0).abs() < 1e-3, "{} {flux}", table.flux.value);
                let luminaire = Luminaire::from_table(&table, lid.size, Description::default());
                let ldt = eulumdat::read(&eulumdat::write(&luminaire)).expect("EULUMDAT");
                let lm63 = ies::read(&ies::write(&luminaire, ies::IesEdition::Lm63_2002)).expect("LM-63");
                for read in [ldt, lm63] {
                    assert!((read.flux() / flux - 1.0).abs() < 1e-3, "{} {flux}", read.flux());
                }
            }
        }
    }
}

/// At bearing 190 the sun stands 25° west of the normal of a façade that faces 165; x runs east, so the beam goes to the
/// right seen from outside, down and in.
#[test]
fn sunbeam_goes_where_the_sun_sends_it() {
    let scene = scene(60000.0);
    let (outside, sun) = outside_from_keys(&scene.sky, &scene.site, Path::new(".")).expect("sky");
    let facing = Facing {
        outside: &outside,
        sun: sun.as_ref(),
        orientation: Orientation::new(Bearing::from_degrees(165.0)),
        surface: Surface::Facade,
    };
    let clear = Btdf { regular: Some(AngularTransmittance::Constant(1.0)), scattered: None };
    let lid = Emission::new(&clear, &facing).lid(&facing, [4.0, 1.5]);
    let table = CGammaTable::new(&lid, Aim::Mounted, Step::FINE);
    let peak = (0..table.intensity.len()).max_by(|&a, &b| table.intensity[a].total_cmp(&table.intensity[b]));
    let peak = peak.expect("a table");
    // Altitude 25° above the horizon goes down to γ = 65°; 25° of azimuth to the right of C0 is C335.
    assert!((peak / table.angles()).abs_diff(335) <= 1, "C {}", peak / table.angles());
    assert!((peak % table.angles()).abs_diff(65) <= 1, "gamma {}", peak % table.angles());
}

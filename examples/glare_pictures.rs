//! Writes fisheye pictures (Radiance HDR) of what an observer sees, with the luminances of this program, and
//! `glare.csv` with the DGP that this program computes.
//!
//! `cargo run --example glare_pictures -- FOLDER`
//!
//! `.ci/glare` compares the DGP with that of `evalglare` for the same pictures. There are four systems (open
//! aperture, fabric, blind, laser-cut panel), three positions of the sun and two observers. The surfaces of the room
//! have a uniform luminance that matches the vertical illuminance at the observer. The solar disc fills whole pixels.
//! Look at the printed lines: DGP with its uncertainty, and the glare sources.

use anyhow::Context as _;
use cfs::compute::direction::{Dir, Emergent};
use cfs::compute::estimate::Silent;
use cfs::compute::glare::Gaze;
use cfs::compute::lid::Lid;
use cfs::compute::room::direct::Sensor;
use cfs::study::session::glare::EyeGlare;
use cfs::study::{Library, Scene, SceneFile, Session};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;

/// Number of pixels along a side of the picture, 0.15° each.
const SIDE: usize = 1200;
const BLIND: &str = "name = \"Blind\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 0.072\nangles = [30.0]\n\
    upper = { reflectance = 0.6 }\nlower = { reflectance = 0.6 }\n";
const SYSTEMS: [(&str, &str); 4] = [
    ("clear", "{ ideal = \"transparent\", transmittance = 0.7 }"),
    ("fabric", "{ file = \"SYSTEMS/screen-white-3.system.toml\" }"),
    ("blind", "{ file = \"blind.system.toml\" }"),
    ("laser-cut", "{ file = \"SYSTEMS/laser-cut-panel.system.toml\" }"),
];
/// Solar altitude and azimuth \[°\], diffuse horizontal and direct normal illuminance \[lx\].
const SUNS: [[f64; 4]; 3] = [[14.0, 184.0, 4e3, 6e2], [38.0, 165.0, 1e4, 1.5e4], [55.0, 215.0, 9e3, 3e4]];
const EYES: [([f64; 3], [f64; 3]); 2] = [([2.5, 2.0, 1.2], [0.0, -1.0, 0.0]), ([1.2, 3.0, 1.2], [0.8, -0.6, 0.0])];

fn scene(system: &str, [altitude, azimuth, sky, sun]: [f64; 4], base: &Path) -> anyhow::Result<Scene> {
    let systems = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/systems");
    let system = system.replace("SYSTEMS", &systems.display().to_string());
    let text = format!(
        "[room]\nwidth = 5.0\ndepth = 6.0\nheight = 3.0\nreflectance = {{ floor = 0.2, walls = 0.5, ceiling = 0.7 }}\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 0.9]\nsize = [4.0, 1.8]\nreflectance = 0.0\n\
         system = {system}\n[site]\nazimuth = 180.0\nground_reflectance = 0.2\n[sky]\nmodel = \"cie\"\ntype = 12\n\
         diffuse_horizontal = {sky}\nsun = {{ altitude = {altitude}, azimuth = {azimuth}, direct_normal = {sun} }}\n\
         [sensors]\npoints = [[2.5, 2.0, 0.85]]\nnormal = [0.0, 0.0, 1.0]\n"
    );
    Ok(Scene::resolve(&SceneFile::parse(&text)?, base, &Library::default())?)
}

/// Computes the luminances of the pixels, row by row from the top. \[cd/m²\]
fn picture(scene: &Scene, lids: &[Lid], eye: &Sensor, found: &EyeGlare) -> Vec<f64> {
    let gaze = Gaze::new(eye);
    let step = PI / SIDE as f64;
    let mut luminance = vec![0.0; SIDE * SIDE];
    let mut walls = Vec::new();
    let (mut lit, mut dark) = (0.0, 0.0);
    // Pixels of each disc, and their solid angle.
    let mut discs: Vec<(Vec<usize>, f64)> = vec![(Vec::new(), 0.0); found.discs.len()];
    for (at, pixel) in luminance.iter_mut().enumerate() {
        let place = step * DVec2::new((at % SIDE) as f64 + 0.5, (SIDE - 1 - at / SIDE) as f64 + 0.5) - 0.5 * PI;
        let sigma = place.length();
        if sigma >= 0.5 * PI {
            continue;
        }
        let to = gaze.direction(place);
        let omega = step * step * sigma.sin() / sigma;
        let mut seen = None;
        for (one, lid) in scene.apertures.iter().zip(lids) {
            let aperture = &one.aperture;
            let through = aperture.surface.facade_from_room(to);
            let corner = aperture.surface.facade_from_room(aperture.corner - eye.position);
            let on = through * (corner.z / through.z) - corner;
            if through.z > 0.0 && (0.0..aperture.size[0]).contains(&on.x) && (0.0..aperture.size[1]).contains(&on.y) {
                seen = Some(lid.luminance(Emergent::from_undeviated(Dir::from_unit(through))));
            }
        }
        match seen {
            Some(own) => {
                *pixel = own;
                lit += own * omega * sigma.cos();
            }
            None => {
                walls.push(at);
                dark += omega * sigma.cos();
            }
        }
        for (disc, (pixels, solid_angle)) in found.discs.iter().zip(&mut discs) {
            if disc.to.distance(to) < (disc.solid_angle / PI).sqrt() {
                pixels.push(at);
                *solid_angle += omega;
            }
        }
    }
    for (disc, (pixels, solid_angle)) in found.discs.iter().zip(&discs) {
        let light = disc.luminance * disc.solid_angle;
        lit += light * disc.to.dot(gaze.forward);
        pixels.iter().for_each(|&at| luminance[at] += light / solid_angle);
    }
    let even = ((found.vertical.value - lit) / dark).max(0.0);
    walls.iter().for_each(|&at| luminance[at] += even);
    luminance
}

/// Formats a picture as Radiance HDR: pixels with shared exponents, 179 lm/W.
fn radiance(luminance: &[f64]) -> Vec<u8> {
    let mut bytes = format!(
        "#?RADIANCE\nVIEW= -vta -vp 0 0 0 -vd 0 1 0 -vu 0 0 1 -vh 180 -vv 180\nFORMAT=32-bit_rle_rgbe\n\n-Y {SIDE} +X {SIDE}\n"
    )
    .into_bytes();
    for l in luminance {
        let value = l / 179.0;
        if value < 1e-32 {
            bytes.extend([0; 4]);
            continue;
        }
        let exponent = value.log2().floor() as i32 + 1;
        // Rounded down, because Radiance reads a mantissa as the middle of its step.
        let mantissa = (value * 256.0 / 2_f64.powi(exponent)).min(255.0) as u8;
        bytes.extend([mantissa, mantissa, mantissa, (exponent + 128) as u8]);
    }
    bytes
}

fn main() -> anyhow::Result<()> {
    let folder = std::env::args().nth(1).context("expected a folder to write into")?;
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("blind.system.toml"), BLIND)?;
    let mut table = String::from("picture,dgp,dgp_error,vertical_lx,sources,discs\n");
    let session = Session::new();
    for (name, system) in SYSTEMS {
        for (number, sun) in SUNS.into_iter().enumerate() {
            let scene = scene(system, sun, folder)?;
            let lids: Vec<Lid> = (0..scene.apertures.len())
                .map(|index| Ok(session.lid(&scene, index, &Silent)?.lid))
                .collect::<anyhow::Result<_>>()?;
            for (k, (position, normal)) in EYES.into_iter().enumerate() {
                let eye = Sensor { position: DVec3::from_array(position), normal: DVec3::from_array(normal) };
                let found = session.glare(&scene, &eye, &Silent)?;
                let file = format!("{name}_{number}_{k}.hdr");
                std::fs::write(folder.join(&file), radiance(&picture(&scene, &lids, &eye, &found)))?;
                let dgp = found.glare.dgp;
                writeln!(
                    table,
                    "{file},{:.5},{:.5},{:.1},{},{}",
                    dgp.value,
                    dgp.error,
                    found.vertical.value,
                    found.glare.sources.list.len(),
                    found.discs.len()
                )?;
                println!("{file}: DGP {:.4} ± {:.4}, {:?}", dgp.value, dgp.error, found.glare.sources.list);
            }
        }
    }
    std::fs::write(folder.join("glare.csv"), table)?;
    Ok(())
}

//! Light that façades, boxes and ground send each other: closed forms, energy, and a radiosity solution of small patches and
//! strips that shares nothing with the program.

use crate::outside::{a_box, seen, setting};
use crate::rooms;
use cfs::compute::direction::Dir;
use cfs::compute::estimate::{Estimate, Silent};
use cfs::compute::sky::{Distribution, Finish, Outside, Setting, irradiance};
use cfs::compute::surroundings::solid::Solid;
use cfs::study::facade::facade_light;
use cfs::study::sky::outside_from_keys;
use cfs::study::{Library, RoomResult, Scene, SceneFile};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use std::path::Path;

/// Maximum relative difference from a reference.
const BAR: f64 = 0.01;
/// Uncertainty of the patches and strips of this file, relative.
const REFERENCE: f64 = 1e-3;
const DARK: &str = "model = \"uniform\"\ndiffuse_horizontal = 0.0";

pub(crate) fn file(text: &rooms::Text, ground_height: f64, outside: &str) -> SceneFile {
    let mut file = SceneFile::parse(&(text.toml() + outside)).unwrap_or_else(|e| panic!("{e}"));
    file.site.ground_height = ground_height;
    file
}

pub(crate) fn room(file: &SceneFile) -> RoomResult {
    rooms::compute(&Scene::resolve(file, Path::new("."), &Library::default()).unwrap_or_else(|e| panic!("{e}")))
}

pub(crate) fn building(from: [f64; 3], to: [f64; 3], reflectance: f64) -> String {
    format!("[building]\nfrom = {from:?}\nto = {to:?}\nreflectance = {reflectance:?}\n")
}

/// Compares a result with a reference of relative uncertainty `reference`, by the bar and by the stated error.
pub(crate) fn close(what: &str, found: Estimate, exact: f64, reference: f64) {
    let off = found.value - exact;
    println!("{what}: {:.3} ± {:.3}, reference {exact:.3}, {off:+.4}", found.value, found.error);
    assert!(off.abs() <= BAR * exact, "{what}: {found:?} {exact}");
    assert!(off.abs() <= found.error + reference * exact, "{what}: {found:?} {exact}");
    assert!(found.error <= 2.0 * BAR * exact, "{what}: {found:?} says too little");
}

/// Form factor from a small surface to a polygon in front of its plane: Lambert's sum over the edges.
pub(crate) fn factor(at: DVec3, normal: DVec3, corners: &[DVec3]) -> f64 {
    let side = |k: usize| {
        let [a, b] = [k, (k + 1) % corners.len()].map(|k| (corners[k] - at).normalize());
        let across = a.cross(b);
        across.normalize_or_zero().dot(normal) * across.length().atan2(a.dot(b))
    };
    (0..corners.len()).map(side).sum::<f64>().abs() / (2.0 * PI)
}

/// Form factor between equal squares opposite each other; `x`: side per distance.
fn between_squares(x: f64) -> f64 {
    let s = (1.0 + x * x).sqrt();
    let logarithm = (s * s / (1.0 + 2.0 * x * x).sqrt()).ln();
    2.0 / (PI * x * x) * (logarithm + 2.0 * x * s * (x / s).atan() - 2.0 * x * x.atan())
}

/// Solves for illuminances of which each surface reflects its part to all others. `factors`: of the row's surface to the
/// column's; `falling`: illuminance by everything else. \[lx\]
pub(crate) fn solved(factors: &[Vec<f64>], reflectance: &[f64], falling: &[f64]) -> Vec<f64> {
    let mut e = falling.to_vec();
    loop {
        let mut change = 0.0_f64;
        for i in 0..e.len() {
            let reflected = (0..e.len()).map(|j| factors[i][j] * reflectance[j] * e[j]).sum::<f64>();
            change = change.max((falling[i] + reflected - e[i]).abs() / (falling[i] + reflected).max(1e-9));
            e[i] = falling[i] + reflected;
        }
        if change < 1e-8 {
            return e;
        }
    }
}

/// A small rectangle of a surface.
#[derive(Clone)]
pub(crate) struct Patch {
    corners: [DVec3; 4],
    pub(crate) normal: DVec3,
}

impl Patch {
    pub(crate) fn centre(&self) -> DVec3 {
        self.corners.iter().sum::<DVec3>() / 4.0
    }

    pub(crate) fn area(&self) -> f64 {
        (self.corners[1] - self.corners[0]).cross(self.corners[3] - self.corners[0]).length()
    }

    /// Gauss's points, which count alike.
    pub(crate) fn places(&self) -> [DVec3; 4] {
        self.corners.map(|corner| self.centre().lerp(corner, 1.0 / 3.0_f64.sqrt()))
    }

    /// Cuts the rectangle at `origin` with the sides `u` and `v`.
    pub(crate) fn cut(origin: DVec3, u: DVec3, v: DVec3, [n, m]: [u32; 2]) -> Vec<Self> {
        let corner = |k: u32, l: u32| origin + u * (f64::from(k) / f64::from(n)) + v * (f64::from(l) / f64::from(m));
        let one = |k, l| Self {
            corners: [corner(k, l), corner(k + 1, l), corner(k + 1, l + 1), corner(k, l + 1)],
            normal: u.cross(v).normalize(),
        };
        (0..n).flat_map(|k| (0..m).map(move |l| (k, l))).map(|(k, l)| one(k, l)).collect()
    }
}

/// Form factors of each patch to all others: means over Gauss's four points of it.
pub(crate) fn factors(patches: &[Patch]) -> Vec<Vec<f64>> {
    let to = |from: &Patch, other: &Patch| {
        if from.normal.dot(other.centre() - from.centre()) < 1e-9 {
            return 0.0;
        }
        from.places().map(|place| factor(place, from.normal, &other.corners)).iter().sum::<f64>() / 4.0
    };
    patches.iter().map(|from| patches.iter().map(|other| to(from, other)).collect()).collect()
}

#[test]
fn an_aperture_before_an_equal_shining_square_gets_their_form_factor() {
    for (away, system) in
        [(0.6, rooms::DIFFUSE), (3.0, rooms::DIFFUSE), (3.0, rooms::TRANSPARENT), (20.0, rooms::DIFFUSE)]
    {
        let text = rooms::Text {
            room: [4.0, 6.0, 4.0],
            apertures: vec![rooms::facade([0.5, 0.5], [3.0, 3.0], system)],
            sky: DARK.into(),
            ..rooms::Text::default()
        };
        let square = a_box([0.5, -away - 0.2, 0.5], [3.5, -away, 3.5], "luminance = 1000.0");
        let exact = 9.0 * 1000.0 * PI * between_squares(3.0 / away);
        close(&format!("square {away} m away"), room(&file(&text, 0.0, &square)).flux, exact, 0.0);
    }
}

#[test]
fn a_square_lit_by_an_equal_one_has_their_form_factor_in_the_mean() {
    // The second square turns back what the shining one sends it, over black ground.
    for (away, reflectance) in [(1.0, 0.9), (4.0, 0.3)] {
        let solid = |x: f64| Solid::new(DVec3::new(x, -4.0, 1.0), DVec3::new(x + 0.1, -2.0, 3.0), 0.0);
        let boxes = vec![
            (solid(-0.1 - 0.5 * away), Finish::Luminance(1000.0)),
            (solid(0.5 * away), Finish::Reflectance(reflectance)),
        ];
        let dark = Outside::new(Distribution::uniform(), 0.0).unwrap().with_ground(0.0, 0.0).unwrap();
        let eye = DVec3::new(-0.4 * away, -1.0, 2.0);
        let seen = seen(&dark, None, setting(boxes, -1.0), eye);
        let n = 16;
        let at = |k: i32| 2.0 * (f64::from(k) + 0.5) / f64::from(n);
        let luminance = |k: i32| {
            let place = DVec3::new(0.5 * away, -4.0 + at(k % n), 1.0 + at(k / n));
            seen.luminance(Dir::from_unit((place - eye).normalize()))
        };
        let mean = (0..n * n).map(luminance).sum::<f64>() / f64::from(n * n);
        let exact = 1000.0 * reflectance * between_squares(2.0 / away);
        println!("square lit from {away} m: {mean:.3} {exact:.3} {:+.4} %", 100.0 * (mean / exact - 1.0));
        assert!((mean / exact - 1.0).abs() < BAR, "{away}: {mean} {exact}");
    }
}

#[test]
fn two_squares_on_the_ground_light_each_other() {
    // The façade of a building that is the room alone, and a wall of the same size, under uniform sky on black ground.
    let (side, away, count) = (4.0, 2.5, 16);
    for reflectance in [0.0, 0.5, 0.99] {
        let u = side * DVec3::X;
        let mut patches = Patch::cut(DVec3::ZERO, u, side * DVec3::Z, [count; 2]);
        patches.extend(Patch::cut(DVec3::new(side, -away, 0.0), -u, side * DVec3::Z, [count; 2]));
        let [facade, wall] = [0.0, -away].map(|y| [[0.0, y], [side, y]]);
        let sky = |patch: &Patch| {
            // Half of the sky less what the other square hides above the patch.
            let at = patch.centre();
            let [[x0, y], [x1, _]] = if at.y == 0.0 { wall } else { facade };
            let above = [(x0, at.z), (x1, at.z), (x1, side), (x0, side)].map(|(x, z)| DVec3::new(x, y, z));
            10_000.0 * (0.5 - factor(at, patch.normal, &above))
        };
        let falling: Vec<f64> = patches.iter().map(sky).collect();
        let e = solved(&factors(&patches), &vec![reflectance; patches.len()], &falling);
        let exact: f64 = patches.iter().zip(&e).filter(|(p, _)| p.centre().y == 0.0).map(|(p, e)| p.area() * e).sum();
        let text = rooms::Text {
            room: [side, 6.0, side],
            apertures: vec![rooms::facade([0.0, 0.0], [side; 2], rooms::DIFFUSE) + "\nreflectance = 0.0"],
            sky: rooms::UNIFORM.into(),
            ..rooms::Text::default()
        };
        // As thin as a box may be.
        let outside = a_box([0.0, -away - 2e-6, 0.0], [side, -away, side], &format!("reflectance = {reflectance:?}"))
            + &building([0.0; 3], [side, 6.0, side], reflectance);
        close(&format!("facing squares {reflectance}"), room(&file(&text, 0.0, &outside)).flux, exact, REFERENCE);
    }
}

/// Width, depth and height of a closed hall that ends at the façade, and where a lamp runs along the whole of its ceiling.
const HALL: [f64; 3] = [6.0, 7.0, 4.0];
const LAMP: [f64; 2] = [4.5, 5.1];

/// Boxes around the hall: walls beside and opposite the façade, ceiling on both sides of the lamp, the lamp. Faces of the boxes
/// meet the hall's edges.
fn around() -> [[[f64; 3]; 2]; 6] {
    let ([x, y, z], [a, b]) = (HALL, LAMP);
    [
        [[-1.0, -y - 1.0, 0.0], [0.0, 0.0, z + 1.0]],
        [[x, -y - 1.0, 0.0], [x + 1.0, 0.0, z + 1.0]],
        [[0.0, -y - 1.0, 0.0], [x, -y, z + 1.0]],
        [[0.0, -y, z], [a, 0.0, z + 1.0]],
        [[b, -y, z], [x, 0.0, z + 1.0]],
        [[a, -y, z], [b, 0.0, z + 1.0]],
    ]
}

/// The hall's inside in patches, those of the façade first, those of the lamp last, `fine` times finer along both sides than the
/// coarsest. With the numbers of both.
fn inside(fine: u32) -> (Vec<Patch>, usize, usize) {
    let ([x, y, z], [a, b]) = (HALL, LAMP);
    let (right, out, up) = (DVec3::X, -DVec3::Y, DVec3::Z);
    let cut = |origin, u, v, count: [u32; 2]| Patch::cut(origin, u, v, count.map(|count| fine * count));
    let mut patches = cut(DVec3::ZERO, x * right, z * up, [12, 8]);
    let facade = patches.len();
    patches.extend(cut(x * right + y * out, -x * right, z * up, [12, 8]));
    patches.extend(cut(y * out, -y * out, z * up, [14, 8]));
    patches.extend(cut(x * right, y * out, z * up, [14, 8]));
    patches.extend(cut(y * out, x * right, -y * out, [12, 14]));
    patches.extend(cut(y * out + z * up, -y * out, a * right, [14, 9]));
    patches.extend(cut(y * out + z * up + b * right, -y * out, (x - b) * right, [14, 2]));
    let lamp = cut(y * out + z * up + a * right, -y * out, (b - a) * right, [28, 2]);
    patches.extend_from_slice(&lamp);
    (patches, facade, lamp.len())
}

#[test]
fn a_closed_hall_keeps_the_light_of_its_lamp_until_it_is_absorbed() {
    // What the lamp sends less what falls on it is (1 − ρ) ΣE·A of all others, whatever the shape: light that goes to and fro
    // adds 1 + ρ + ρ² + … = 1/(1 − ρ).
    let (patches, _, lamp) = inside(1);
    for reflectance in [0.5, 0.99] {
        let solid = |[from, to]: [[f64; 3]; 2]| Solid::new(DVec3::from(from), DVec3::from(to), 0.0);
        let mut boxes: Vec<_> = around().map(|ends| (solid(ends), Finish::Reflectance(reflectance))).into();
        boxes[5].1 = Finish::Luminance(1000.0);
        boxes.push((solid([[-1.0, 0.0, 0.0], [HALL[0] + 1.0, 1.0, HALL[2] + 1.0]]), Finish::Reflectance(reflectance)));
        let dark = Outside::new(Distribution::uniform(), 0.0).unwrap().with_ground(reflectance, 0.0).unwrap();
        // The room stands inside a wall, where it hides nothing.
        let hall = Setting { room: solid([[1.0, 0.4, 1.0], [1.1, 0.5, 1.1]]), ..setting(boxes, 0.0) };
        let eye = DVec3::new(2.7, -3.1, 1.9);
        let seen = seen(&dark, None, hall, eye);
        let (mut absorbed, mut sent) = (0.0, 0.0);
        for (k, patch) in patches.iter().enumerate() {
            for place in patch.places() {
                if k < patches.len() - lamp {
                    let luminance = seen.luminance(Dir::from_unit((place - eye).normalize()));
                    absorbed += (1.0 - reflectance) / reflectance * 0.25 * patch.area() * PI * luminance;
                } else {
                    let below = seen.seen_from(place + 1e-6 * patch.normal);
                    let back = irradiance(&below, Dir::from_unit(patch.normal)).value;
                    sent += 0.25 * patch.area() * (1000.0 * PI - back);
                }
            }
        }
        println!("hall {reflectance}: {absorbed:.2} {sent:.2}: {:+.4} %", 100.0 * (absorbed / sent - 1.0));
        assert!((absorbed / sent - 1.0).abs() < BAR, "{reflectance}: {absorbed} {sent}");
    }
}

#[test]
fn the_facade_of_a_closed_hall_gets_what_small_patches_say() {
    compare_hall(&[0.0, 0.5]);
}

/// Compares the flux through the façade of the closed hall, all of whose surfaces but the lamp have one of the reflectances.
pub(crate) fn compare_hall(reflectances: &[f64]) {
    // Where the lamp meets the façade, what patches are off falls as their size does: at ρ = 0.9 they give 14 143, 14 121 and
    // 14 113 lm with one, two and three times as many along a side. Two of them tell the limit.
    let grids = [1, 2].map(|fine| {
        let (patches, facade, lamp) = inside(fine);
        let factors = factors(&patches);
        (patches, facade, lamp, factors)
    });
    for &reflectance in reflectances {
        let [coarse, fine] = grids.each_ref().map(|(patches, facade, lamp, factors)| {
            let others = patches.len() - lamp;
            let mut albedo = vec![reflectance; others];
            albedo.resize(patches.len(), 0.0);
            let falling: Vec<f64> = factors.iter().map(|row| row[others..].iter().sum::<f64>() * 1000.0 * PI).collect();
            let e = solved(factors, &albedo, &falling);
            patches[..*facade].iter().zip(&e).map(|(patch, e)| patch.area() * e).sum::<f64>()
        });
        let exact = 2.0 * fine - coarse;
        let text = rooms::Text {
            room: [HALL[0], 6.0, HALL[2]],
            apertures: vec![rooms::facade([0.0, 0.0], [HALL[0], HALL[2]], rooms::DIFFUSE) + "\nreflectance = 0.0"],
            ground: reflectance,
            sky: DARK.into(),
            ..rooms::Text::default()
        };
        let finish = format!("reflectance = {reflectance:?}");
        let mut boxes = around().map(|[from, to]| a_box(from, to, &finish));
        boxes[5] = boxes[5].replace(&finish, "luminance = 1000.0");
        let outside = boxes.concat() + &building([0.0; 3], [HALL[0], 6.0, HALL[2]], reflectance);
        close(&format!("hall's façade {reflectance}"), room(&file(&text, 0.0, &outside)).flux, exact, REFERENCE);
    }
}

/// Section of an endless street between a building at y = 0 and a row of houses of the same height at y = −`wide`.
struct Canyon {
    wide: f64,
    /// Heights of ground and eaves. \[m\]
    ground: f64,
    eaves: f64,
    /// Reflectances of building, row opposite and ground.
    reflectance: [f64; 3],
    /// Luminance at the horizon \[cd/m²\], and the rise to the zenith: L = horizon·(1 + rise·sin γ).
    horizon: f64,
    rise: f64,
    /// Parts of the direction to the sun towards −y and up, and its normal illuminance. \[lx\]
    sun: [f64; 3],
}

/// Strips on each surface of the canyon.
const STRIPS: usize = 240;

/// Illuminance by sky and reflected light by strip of building, row opposite and ground. \[lx\]
struct Strips(Vec<f64>);

impl Canyon {
    /// Point of a surface at a share of its width, in coordinates y and z.
    fn point(&self, surface: usize, share: f64) -> DVec2 {
        let y = [0.0, -self.wide, -self.wide * (1.0 - share)][surface];
        DVec2::new(y, if surface == 2 { self.ground } else { self.ground + share * (self.eaves - self.ground) })
    }

    /// Illuminance by the sky. \[lx\]
    fn by_sky(&self, surface: usize, at: DVec2) -> f64 {
        let over = |away: f64| (self.eaves - at.y).atan2(away);
        // Along the street the sky at a profile angle ψ counts as horizon·(1 + rise·8/(3π)·sin ψ).
        let rise = self.rise * 8.0 / (3.0 * PI);
        let on_ground = |psi: f64| -psi.cos() + rise * (0.5 * psi - 0.25 * (2.0 * psi).sin());
        let on_wall = |psi: f64| psi.sin() + 0.5 * rise * psi.sin().powi(2);
        let seen = match surface {
            2 => on_ground(PI - over(-at.x)) - on_ground(over(at.x + self.wide)),
            _ => on_wall(0.5 * PI) - on_wall(over(self.wide)),
        };
        0.5 * PI * self.horizon * seen
    }

    /// Illuminance by the sun \[lx\], 0 in the shade.
    fn by_sun(&self, surface: usize, at: DVec2) -> f64 {
        let [outward, up, normal] = self.sun;
        let towards = [outward, -outward, up][surface];
        let away = if outward > 0.0 { at.x + self.wide } else { -at.x };
        if towards > 0.0 && at.y + away / outward.abs() * up > self.eaves { normal * towards } else { 0.0 }
    }

    /// Mean illuminance by the sun over a part of a surface. \[lx\]
    fn mean_by_sun(&self, surface: usize, [low, high]: [f64; 2]) -> f64 {
        let at = |k: i32| low + (high - low) * (f64::from(k) + 0.5) / 200.0;
        (0..200).map(|k| self.by_sun(surface, self.point(surface, at(k)))).sum::<f64>() / 200.0
    }

    /// Solves for the light of all strips; what strips exchange is found by crossed strings.
    fn strips(&self) -> Strips {
        let share = |k: usize| k as f64 / STRIPS as f64;
        let all: Vec<(usize, usize)> = (0..3).flat_map(|surface| (0..STRIPS).map(move |k| (surface, k))).collect();
        let ends = |(surface, k): (usize, usize)| [k, k + 1].map(|k| self.point(surface, share(k)));
        let factor = |from, to| {
            let ([a, b], [c, d]): ([DVec2; 2], [DVec2; 2]) = (ends(from), ends(to));
            (a.distance(c) + b.distance(d) - a.distance(d) - b.distance(c)).abs() / (2.0 * a.distance(b))
        };
        let factors: Vec<Vec<f64>> = all
            .iter()
            .map(|from| all.iter().map(|to| if from.0 == to.0 { 0.0 } else { factor(*from, *to) }).collect())
            .collect();
        let albedo: Vec<f64> = all.iter().map(|(surface, _)| self.reflectance[*surface]).collect();
        let sun = all.iter().map(|(surface, k)| self.mean_by_sun(*surface, [share(*k), share(k + 1)]));
        let sun: Vec<f64> = sun.collect();
        let sky = |(surface, k): &(usize, usize)| {
            self.by_sky(*surface, self.point(*surface, share(*k) + 0.5 / STRIPS as f64))
        };
        let falling: Vec<f64> = all.iter().zip(&sun).map(|(strip, sun)| sky(strip) + sun).collect();
        let e = solved(&factors, &albedo, &falling);
        Strips(e.iter().zip(&sun).map(|(e, sun)| e - sun).collect())
    }

    /// Luminance in a direction from a point in front of the row of houses. \[cd/m²\]
    fn luminance(&self, strips: &Strips, eye: DVec3, direction: DVec3) -> f64 {
        let at = eye + direction * ((-self.wide - eye.y) / direction.y);
        if at.z > self.eaves {
            return self.horizon * (1.0 + self.rise * direction.normalize().z);
        }
        let (surface, share) = match at.z > self.ground {
            true => (1, (at.z - self.ground) / (self.eaves - self.ground)),
            false => (2, 1.0 + (eye.y + direction.y * (self.ground - eye.z) / direction.z) / self.wide),
        };
        let smooth = strips.at(surface, share);
        self.reflectance[surface] / PI * (smooth + self.by_sun(surface, self.point(surface, share)))
    }
}

impl Strips {
    /// Illuminance at a share of a surface's width, linear between the middles of strips.
    fn at(&self, surface: usize, share: f64) -> f64 {
        let place = (share * STRIPS as f64 - 0.5).clamp(0.0, STRIPS as f64 - 1.0);
        let first = (place as usize).min(STRIPS - 2);
        let [a, b] = [first, first + 1].map(|k| self.0[surface * STRIPS + k]);
        a + (b - a) * (place - first as f64)
    }
}

#[test]
fn in_an_endless_street_facade_and_room_get_what_strips_say() {
    let ([u, v], [width, tall]) = ([0.5, 1.0], [3.0, 1.5]);
    // Overcast and uniform sky; altitude of the sun and its azimuth from the façade's normal.
    let in_front = Some((62.0_f64, 25.0_f64));
    let behind = Some((48.0, 155.0));
    for (name, reflectance, rise, sun, [wide, ground, eaves]) in [
        ("black, uniform", [0.0, 0.0, 0.0], 0.0, None, [12.0, -5.0, 10.0]),
        ("uniform", [0.4, 0.5, 0.2], 0.0, None, [12.0, -5.0, 10.0]),
        ("narrow and white, uniform", [0.99, 0.99, 0.99], 0.0, None, [4.0, -8.0, 8.0]),
        ("overcast", [0.3, 0.6, 0.3], 2.0, None, [9.0, 0.0, 4.0]),
        ("overcast, sun in front", [0.5, 0.4, 0.3], 2.0, in_front, [15.0, -3.0, 9.0]),
        ("overcast, sun behind", [0.3, 0.8, 0.2], 2.0, behind, [10.0, -6.0, 6.0]),
    ] {
        let normal = 60_000.0;
        let direction = sun.map_or([1.0, 0.0, 0.0], |(altitude, aside)| {
            let (altitude, aside): (f64, f64) = (altitude.to_radians(), aside.to_radians());
            [altitude.cos() * aside.cos(), altitude.sin(), normal]
        });
        let horizon = 10_000.0 / (PI * (1.0 + 2.0 / 3.0 * rise));
        let canyon = Canyon { wide, ground, eaves, reflectance, horizon, rise, sun: direction };
        let strips = canyon.strips();
        let [low, high] = [v, v + tall].map(|z| (z - ground) / (eaves - ground));
        let smooth =
            (0..100).map(|k| strips.at(0, low + (high - low) * (f64::from(k) + 0.5) / 100.0)).sum::<f64>() / 100.0;
        let direct = canyon.mean_by_sun(0, [low, high]);

        let sky = if rise == 0.0 { rooms::UNIFORM } else { rooms::OVERCAST };
        let disc = sun.map_or(String::new(), |(altitude, aside)| {
            format!("\nsun = {{ altitude = {altitude:?}, azimuth = {:?}, direct_normal = {normal:?} }}", 180.0 + aside)
        });
        let points: Vec<[f64; 3]> = [0.4, 1.2, 2.5, 5.5].iter().map(|y| [1.3, *y, 1.1]).collect();
        let text = |system: &str| rooms::Text {
            apertures: vec![rooms::facade([u, v], [width, tall], system) + "\nreflectance = 0.0"],
            ground: reflectance[2],
            sky: format!("{sky}{disc}"),
            sensors: rooms::points(&points, [0.0, -1.0, 0.0]),
            ..rooms::Text::default()
        };
        let row =
            a_box([-600.0, -wide - 8.0, ground], [600.0, -wide, eaves], &format!("reflectance = {:?}", reflectance[1]));
        let outside = row + &building([-600.0, 0.0, ground], [600.0, 9.0, eaves], reflectance[0]);

        let diffuse = file(&text(rooms::DIFFUSE), ground, &outside);
        let (sky, disc) = outside_from_keys(&diffuse.sky, &diffuse.site, Path::new(".")).unwrap();
        let light = facade_light(&diffuse, Path::new("."), (&sky, disc.as_ref()), &Silent).unwrap();
        close(&format!("{name}: façade"), light.diffuse, smooth, REFERENCE);
        assert!((light.direct - direct).abs() <= 0.01 * direct, "{name}: {} {direct}", light.direct);
        close(&format!("{name}: flux"), room(&diffuse).flux, width * tall * (smooth + direct), REFERENCE);
        if direct > 0.0 {
            continue;
        }
        for (point, sensor) in points.iter().zip(room(&file(&text(rooms::TRANSPARENT), ground, &outside)).sensors) {
            let eye = DVec3::from(*point);
            // Between heights at which ground, shadow and eaves show.
            let shows = |height: f64| (eye.z + (height - eye.z) * eye.y / (wide + eye.y)).clamp(v, v + tall);
            let shadow = eaves + wide * canyon.sun[1] / canyon.sun[0].min(-1e-3);
            let lines = [f64::NEG_INFINITY, ground, shadow.max(ground), eaves, f64::INFINITY].map(shows);
            let n = 80;
            let part = |x: usize, z: usize, [low, high]: [f64; 2]| {
                let share = |k: usize| (k as f64 + 0.5) / n as f64;
                let to = DVec3::new(u + width * share(x), 0.0, low + (high - low) * share(z)) - eye;
                let counts = to.y * to.y / to.length_squared().powi(2) * width * (high - low) / (n * n) as f64;
                canyon.luminance(&strips, eye, to) * counts
            };
            let between = |ends: &[f64]| -> f64 { (0..n * n).map(|k| part(k % n, k / n, [ends[0], ends[1]])).sum() };
            let exact = lines.windows(2).map(between).sum();
            close(&format!("{name}: sensor {} m inside", eye.y), sensor.total(), exact, REFERENCE);
        }
    }
}

//! Slats of the numerical goniophotometer: against published reference cases, closed forms, conservation laws.

mod flat_slats;
pub mod kit;

use crate::common::data;
use cfs::compute::basis::{self, RingBasis};
use cfs::compute::btdf::Component;
use cfs::compute::direction::Dir;
use cfs::compute::estimate::Silent;
use cfs::compute::system::measure::{Measured, Setting, Side};
use cfs::compute::system::slats::{SlatArray, SlatProfile, Surface};
use flat_slats::FlatSlats;
use std::f64::consts::PI;
use std::time::Instant;

fn setting(basis: &RingBasis) -> Setting<'_> {
    Setting { incident: basis, emergent: basis, error: 0.01, seed: 1 }
}

fn measure(array: &SlatArray) -> Measured {
    array.measure(&setting(&kit::klems()), &Silent).unwrap()
}

#[test]
fn blinds_are_those_of_the_reference_cases() {
    let Some(folder) = data(kit::FOLDER) else { return };
    let cases = kit::venetians(&folder);
    assert!(cases.len() >= 9, "{} venetian states", cases.len());
    let mut wrong = vec![];
    println!("state            s      | worst τ, ρ | patches from outside, inside | quality");
    for case in cases {
        let start = Instant::now();
        let measured = measure(&case.array);
        let seconds = start.elapsed().as_secs_f64();
        let uncertainty = case.column("uncertainty").unwrap();
        let mut worst = [0.0_f64; 2];
        for (side, suffix) in [(Side::Front, "front"), (Side::Back, "back")] {
            let seen = measured.seen(side);
            for (k, (q, quantity)) in [(&seen.transmitted, "tau"), (&seen.reflected, "rho")].into_iter().enumerate() {
                let expected = case.column(&format!("{quantity}_{suffix}")).unwrap();
                let shares = measured.shares(q);
                for (i, cell) in kit::rows(side).into_iter().enumerate() {
                    let tau = shares[cell];
                    let off = (tau - expected[i]).abs() - uncertainty[i];
                    worst[k] = worst[k].max(off);
                    if off > 0.003 {
                        wrong.push(format!("{} {quantity}_{suffix} cell {i}: {tau} for {}", case.name, expected[i]));
                    }
                }
            }
        }
        let band = measured.band();
        let patches = [Component::TransmissionFront, Component::ReflectionFront]
            .map(|c| kit::patch_error(&kit::matrix(&band, c), &kit::matrix(&case.best, c)));
        let back = [Component::TransmissionBack, Component::ReflectionBack]
            .map(|c| kit::patch_error(&kit::matrix(&band, c), &kit::matrix(&case.best, c)));
        let quality = measured.quality();
        let (off, name) = (worst, &case.name);
        println!("{name:16} {seconds:.3}  | {off:.5?} | {patches:.4?} {back:.4?} | {quality:.6?}");
        if patches.iter().chain(&back).any(|error| *error > 0.03) {
            wrong.push(format!("{}: patches {patches:?} {back:?}", case.name));
        }
        if quality.balance > 1e-3 || quality.reciprocity.is_some_and(|r| r > 0.01) {
            wrong.push(format!("{}: {quality:?}", case.name));
        }
    }
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong[..wrong.len().min(30)].join("\n"));
}

/// τ, ρ and every value against a second model: strips of slats that are flat and matt, on averaged directions.
#[test]
fn flat_matt_slats_are_those_of_a_second_model() {
    for (tilt, upper, lower) in [(0.0, 0.5, 0.5), (40.0, 0.8, 0.3), (-25.0, 0.2, 0.7), (70.0, 0.9, 0.9)] {
        let profile = SlatProfile::Flat { width: 0.080 };
        let sides = [upper, lower].map(Surface::matt);
        let array = SlatArray::new(profile, 0.0, 0.072, f64::to_radians(tilt), sides).unwrap();
        let second = FlatSlats { width: 0.080, spacing: 0.072, tilt: f64::to_radians(tilt), upper, lower };
        let measured = measure(&array);
        let (ours, theirs) = (measured.band(), second.band().unwrap());
        for component in Component::ALL {
            let (a, b) = (kit::matrix(&ours, component), kit::matrix(&theirs, component));
            let off = kit::patch_error(&a, &b);
            let (a, b) = (measured.shares(&a), measured.shares(&b));
            let totals = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            println!("{tilt:5}° {upper} {lower} {component:?}: patches {off:.5}, totals {totals:.5}");
            assert!(off < 0.005 && totals < 0.005, "{tilt}° {component:?}: {off} {totals}");
        }
    }
}

/// τ and ρ of single directions against the tables' centre values, and against pywincalc's uniform mode.
#[test]
fn single_directions_are_those_of_the_references() {
    let Some(folder) = data(kit::FOLDER) else { return };
    let mut compared = 0;
    for case in kit::venetians(&folder) {
        let theta = case.column("theta_e_deg").unwrap();
        let phi = case.column("phi_e_deg").unwrap();
        let (mut centre, mut pywincalc) = ([0.0_f64; 2], [0.0_f64; 2]);
        for (side, suffix) in [(Side::Front, "front"), (Side::Back, "back")] {
            // From inside the name is the opposite of the direction towards the source.
            let psi: Vec<f64> = (0..145)
                .map(|i| {
                    let (t, p) = (theta[i].to_radians(), phi[i].to_radians());
                    let up = if side == Side::Front { p.sin() } else { -p.sin() };
                    (t.sin() * up).atan2(t.cos().abs())
                })
                .collect();
            let shares = case.array.profile_shares(side, &psi, 1, &Silent).unwrap();
            for (k, quantity) in ["tau", "rho"].into_iter().enumerate() {
                let got = |i: usize| if k == 0 { shares[i].transmitted } else { shares[i].reflected };
                let off = |column: Option<Vec<f64>>| {
                    column.map_or(0.0, |c| (0..145).map(|i| (got(i) - c[i]).abs()).fold(0.0, f64::max))
                };
                centre[k] = centre[k].max(off(case.column(&format!("{quantity}_{suffix}_centre"))));
                let column = case.column(&format!("{quantity}_{suffix}_pywincalc_uniform20"));
                compared += usize::from(column.is_some());
                pywincalc[k] = pywincalc[k].max(off(column));
            }
            for share in &shares {
                let sum = share.transmitted + share.reflected + share.absorbed;
                assert!((sum - 1.0).abs() < 1e-3, "{}: {share:?}", case.name);
            }
        }
        println!(
            "{:16} centre τ {:.5} ρ {:.5}  pywincalc τ {:.5} ρ {:.5}",
            case.name, centre[0], centre[1], pywincalc[0], pywincalc[1]
        );
        assert!(centre.iter().all(|off| *off < 0.0015), "{}: {centre:?}", case.name);
        // 0 where the tables have no column of it.
        assert!(pywincalc.iter().all(|off| *off < 0.002), "{}: {pywincalc:?}", case.name);
    }
    assert!(compared >= 16, "{compared}");
}

const FLAT: SlatProfile = SlatProfile::Flat { width: 0.080 };

fn array(profile: SlatProfile, tilt: f64, upper: Surface, lower: Surface) -> SlatArray {
    SlatArray::new(profile, 0.0, 0.072, tilt.to_radians(), [upper, lower]).unwrap()
}

fn largest(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Largest difference of τ and ρ from either side.
fn apart(a: &Measured, b: &Measured) -> f64 {
    let one = |side: Side| {
        let (a, b) = (a.seen(side), b.seen(side));
        let basis = kit::klems();
        let weight = basis.projected_solid_angles();
        let shares = |q: &[f64]| -> Vec<f64> {
            q.chunks(weight.len()).map(|row| row.iter().zip(&weight).map(|(q, w)| q * w).sum()).collect()
        };
        let t = largest(&shares(&a.transmitted), &shares(&b.transmitted));
        t.max(largest(&shares(&a.reflected), &shares(&b.reflected)))
    };
    one(Side::Front).max(one(Side::Back))
}

#[test]
fn black_slats_let_uniform_light_pass_as_crossed_strings_say() {
    for tilt in [-60.0, 0.0, 30.0, 89.0] {
        let m = measure(&array(FLAT, tilt, Surface::matt(0.0), Surface::matt(0.0)));
        let weight = m.incident.projected_solid_angles();
        let mean = |q: &[f64]| m.shares(q).iter().zip(&weight).map(|(t, w)| t * w).sum::<f64>() / PI;
        // Openings of the parallelogram: diagonals less sides over twice the pitch, as far as they see each other.
        let (w, s, b) = (0.080_f64, 0.072_f64, f64::to_radians(tilt));
        let long = (w * w + s * s + 2.0 * w * s * b.sin().abs()).sqrt();
        let short = (w * w + s * s - 2.0 * w * s * b.sin().abs()).sqrt();
        let exact = (long + short - 2.0 * w) / (2.0 * s);
        assert!((mean(&m.front.transmitted) - exact).abs() < 1e-6, "{tilt}: {} {exact}", mean(&m.front.transmitted));
        assert_eq!(mean(&m.front.reflected), 0.0);
        assert!(m.quality().balance < 1e-3, "{:?}", m.quality());
    }
}

#[test]
fn the_direct_share_is_exact_in_every_cell() {
    // Black curved slats on other cells than the incident ones: the mean of the closed form over many directions.
    let slats = array(SlatProfile::Arc { width: 0.08, rise: 0.012 }, 25.0, Surface::matt(0.0), Surface::matt(0.0));
    let (incident, emergent) = (RingBasis::tregenza(), kit::klems());
    let m =
        slats.measure(&Setting { incident: &incident, emergent: &emergent, error: 0.01, seed: 0 }, &Silent).unwrap();
    let tau = m.shares(&m.front.transmitted);
    for cell in [0, 7, 33, 60, 90, 110, 130, 144] {
        let mean = cfs::compute::basis::cell_mean(&incident.cell(cell), 1000, |d| {
            let psi = cfs::compute::profile_angle::profile_angle(d).unwrap();
            (1.0 - slats.profile().extent(slats.tilt() + psi) / (slats.spacing() * psi.cos())).max(0.0)
        });
        assert!((tau[cell] - mean).abs() < 1e-5, "{cell}: {} {mean}", tau[cell]);
    }
}

#[test]
fn white_slats_lose_nothing() {
    let profiles = [FLAT, SlatProfile::Arc { width: 0.08, rise: -0.01 }];
    for (profile, tilt) in profiles.iter().flat_map(|p| [0.0, 50.0, -80.0].map(|tilt| (p.clone(), tilt))) {
        let m = measure(&array(profile.clone(), tilt, Surface::matt(1.0), Surface::matt(1.0)));
        let (t, r) = (m.shares(&m.front.transmitted), m.shares(&m.front.reflected));
        assert!(t.iter().zip(&r).all(|(t, r)| (t + r - 1.0).abs() < 1e-3), "{profile:?} {tilt}");
        assert!(m.front.absorbed.iter().all(|a| a.abs() < 1e-12));
    }
}

#[test]
fn closed_slats_are_a_matt_sheet() {
    let profiles = [(FLAT, 0.0), (FLAT, 0.001)];
    for (profile, thickness) in profiles {
        for (tilt, front, back) in [(90.0_f64, 0.7, 0.4), (-90.0, 0.4, 0.7)] {
            let faces = [Surface::matt(0.7), Surface::matt(0.4)];
            let slats = SlatArray::new(profile.clone(), thickness, 0.072, tilt.to_radians(), faces).unwrap();
            let m = measure(&slats);
            assert!(m.front.transmitted.iter().chain(&m.back.transmitted).all(|q| *q < 1e-9));
            // Solid slats that lie on one another have steps.
            let slack = if thickness > 0.0 { 0.01 } else { 1e-4 };
            assert!(m.shares(&m.front.reflected).iter().all(|r| (r - front).abs() < slack), "{tilt} {thickness}");
            assert!(m.shares(&m.back.reflected).iter().all(|r| (r - back).abs() < slack), "{tilt} {thickness}");
        }
    }
    // Curved slats run through one another: still tight.
    let curved = SlatProfile::Arc { width: 0.08, rise: 0.008 };
    let m = measure(&array(curved, 90.0, Surface::matt(0.7), Surface::matt(0.4)));
    assert!(m.front.transmitted.iter().all(|q| *q < 1e-6), "{:?}", m.shares(&m.front.transmitted));
    assert!(m.quality().balance < 1e-3);
}

#[test]
fn level_mirrors_pass_light_after_as_many_reflections_as_unfolding_counts() {
    let rho = 0.9_f64;
    let slats = array(FLAT, 0.0, Surface::mirror(rho), Surface::mirror(rho));
    let m = measure(&slats);
    let unfolded = |psi: f64| {
        let crossed = 0.080 / 0.072 * psi.tan().abs();
        let part = crossed.fract();
        (1.0 - part) * rho.powf(crossed.floor()) + part * rho.powf(crossed.floor() + 1.0)
    };
    let tau = m.shares(&m.front.transmitted);
    for (i, cell) in m.incident.cells().enumerate() {
        let mean = cfs::compute::basis::cell_mean(&cell, 200, |d| {
            unfolded(cfs::compute::profile_angle::profile_angle(d).unwrap())
        });
        assert!((tau[i] - mean).abs() < 1e-3, "{i}: {} {mean}", tau[i]);
    }
    assert!(m.shares(&m.front.reflected).iter().all(|r| *r < 1e-4));
    assert!(m.quality().balance < 1e-3, "{:?}", m.quality());
    assert!(m.quality().reciprocity.unwrap() < 0.01);
}

#[test]
fn mixed_surfaces_keep_energy_and_reciprocity() {
    let mixed = Surface { diffuse: 0.3, mirror: 0.5, spread: 0.0 };
    let step = SlatProfile::Polyline(vec![[-0.04, 0.0], [-0.01, 0.006], [0.0, -0.004], [0.04, 0.002]]);
    let arc = |rise: f64| SlatProfile::Arc { width: 0.08, rise };
    let rough = |degrees: f64| Surface { diffuse: 0.2, mirror: 0.6, spread: f64::to_radians(degrees) };
    let list = [
        (arc(0.01), 15.0, mixed, Surface::matt(0.5)),
        (arc(0.02), 45.0, Surface::mirror(1.0), Surface::mirror(1.0)),
        (step, 30.0, mixed, mixed),
        (FLAT, -40.0, rough(3.0), Surface::matt(0.3)),
        (FLAT, 20.0, rough(0.5), mixed),
        (FLAT, 20.0, rough(15.0), rough(5.0)),
        (arc(-0.01), 0.0, rough(45.0), rough(45.0)),
    ];
    for (profile, tilt, upper, lower) in list {
        let start = Instant::now();
        let m = measure(&array(profile.clone(), tilt, upper, lower));
        let (quality, back) = (m.quality(), reflected_way_back(&m));
        println!("{profile:?} {tilt}: {quality:?} {back:?} {:?}", start.elapsed());
        assert!(quality.balance < 1e-3 && quality.reciprocity.unwrap() < 0.01, "{profile:?}: {quality:?}");
        assert!(back.iter().all(|apart| *apart < 0.01), "{profile:?}: {back:?}");
    }
}

/// Reciprocity of the light thrown back on either side: its weighted difference from its way back.
fn reflected_way_back(m: &Measured) -> [f64; 2] {
    let (n, weight) = (m.incident.len(), m.incident.projected_solid_angles());
    // What is thrown back is named against its way.
    let opposite = |c: basis::Cell| m.incident.index(Dir::from_theta_phi(c.theta(), c.phi + PI)).unwrap();
    let turn: Vec<usize> = m.incident.cells().map(opposite).collect();
    Side::BOTH.map(|side| {
        let q = &m.seen(side).reflected;
        let (mut apart, mut flux) = (0.0, 0.0);
        for (i, o) in (0..n).flat_map(|i| (0..n).map(move |o| (i, o))) {
            let scale = weight[i] * weight[o];
            apart += (q[i * n + o] - q[turn[o] * n + turn[i]]).abs() * scale;
            flux += q[i * n + o] * scale;
        }
        apart / flux
    })
}

#[test]
fn turned_upside_down_the_blind_does_the_same_to_light_from_below() {
    let (upper, lower) = (Surface { diffuse: 0.5, mirror: 0.3, spread: 0.0 }, Surface::matt(0.3));
    let points = vec![[-0.04, 0.0], [0.0, 0.012], [0.04, 0.003]];
    let mirrored: Vec<[f64; 2]> = points.iter().map(|[u, v]| [*u, -v]).collect();
    let a = measure(&array(SlatProfile::Polyline(points), 20.0, upper, lower));
    let b = measure(&array(SlatProfile::Polyline(mirrored), -20.0, lower, upper));
    let n = a.incident.len();
    let turn: Vec<usize> = (0..n)
        .map(|i| {
            let c = a.incident.cell(i);
            a.incident.index(Dir::from_theta_phi(c.theta(), -c.phi)).unwrap()
        })
        .collect();
    for side in Side::BOTH {
        let turned = |q: &[f64]| -> Vec<f64> {
            turn.iter().flat_map(|&i| turn.iter().map(move |&o| (i, o))).map(|(i, o)| q[i * n + o]).collect()
        };
        for (a, b) in
            [(&a.seen(side).transmitted, &b.seen(side).transmitted), (&a.seen(side).reflected, &b.seen(side).reflected)]
        {
            assert!(kit::patch_error(&turned(b), a) < 1e-3, "{side:?}");
        }
    }
}

#[test]
fn limits_of_shapes_meet() {
    let faces = [Surface::matt(0.6), Surface { diffuse: 0.2, mirror: 0.5, spread: 0.0 }];
    let of =
        |profile: SlatProfile, thickness: f64| measure(&SlatArray::new(profile, thickness, 0.072, 0.6, faces).unwrap());
    let flat = of(FLAT, 0.0);
    // A bent mirror of this rise turns light by 4·rise/width at its edges.
    assert!(apart(&of(SlatProfile::Arc { width: 0.08, rise: 1e-6 }, 0.0), &flat) < 1e-3);
    assert!(apart(&of(FLAT, 1e-5), &flat) < 1e-3);
    let polyline = SlatProfile::Polyline(vec![[0.04, 0.0], [0.01, 0.0], [-0.04, 0.0]]);
    assert!(apart(&of(polyline, 0.0), &flat) < 5e-4);
    let arc = SlatProfile::Arc { width: 0.08, rise: 0.008 };
    let facets = SlatProfile::Polyline(arc.polyline(96));
    let off = apart(&of(arc, 0.0), &of(facets, 0.0));
    assert!(off < 2e-3, "{off}");
}

#[test]
fn any_number_of_threads_gives_the_same_values() {
    let rough = Surface { diffuse: 0.3, mirror: 0.5, spread: 0.03 };
    let slats = array(SlatProfile::Arc { width: 0.08, rise: 0.01 }, 30.0, rough, Surface::matt(0.5));
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| measure(&slats))
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn stated_errors_hold() {
    let slats = array(FLAT, 40.0, Surface::matt(0.9), Surface::matt(0.8));
    let basis = kit::klems();
    let fine = slats.measure(&Setting { error: 1e-4, ..setting(&basis) }, &Silent).unwrap();
    let usual = measure(&slats);
    for side in Side::BOTH {
        let (a, b) = (usual.seen(side), fine.seen(side));
        let t = usual.shares(&a.transmitted).into_iter().zip(fine.shares(&b.transmitted));
        for (i, (t, exact)) in t.enumerate() {
            assert!((t - exact).abs() <= a.error[i] + b.error[i] + 2e-4, "{side:?} {i}: {t} {exact} {}", a.error[i]);
        }
    }
    assert!(fine.quality().error < 1e-3);
}

struct Unwanted;
impl cfs::compute::estimate::Progress for Unwanted {
    fn cancelled(&self) -> bool {
        true
    }
}

#[test]
fn a_withdrawn_question_is_left() {
    let slats = array(FLAT, 40.0, Surface::matt(0.9), Surface::matt(0.8));
    assert!(slats.measure(&setting(&kit::klems()), &Unwanted).is_err());
}

#[test]
fn values_that_cannot_be_are_named() {
    let good = [Surface::matt(0.5), Surface::matt(0.5)];
    let new = |profile, thickness, spacing, tilt: f64, faces| {
        SlatArray::new(profile, thickness, spacing, tilt, faces).unwrap_err().to_string()
    };
    let bright = [Surface { diffuse: 0.7, mirror: 0.4, spread: 0.0 }, Surface::matt(0.5)];
    let text = new(FLAT, 0.0, 0.072, 0.0, bright);
    assert!(text.contains("upper.specular = 0.4") && text.contains("0.3"), "{text}");
    assert!(new(FLAT, 0.0, -1.0, 0.0, good).starts_with("spacing = -1"));
    assert!(new(FLAT, 0.0, f64::NAN, 0.0, good).starts_with("spacing = NaN"));
    assert!(new(FLAT, 0.05, 0.072, 0.0, good).starts_with("thickness = 0.05"));
    assert!(new(FLAT, 0.0, 0.072, 2.0, good).starts_with("angle = 114"));
    assert!(new(SlatProfile::Polyline(vec![[0.0, 0.0]]), 0.0, 0.072, 0.0, good).starts_with("profile = 1"));
    assert!(new(SlatProfile::Arc { width: 0.08, rise: 0.05 }, 0.0, 0.072, 0.0, good).starts_with("rise = 0.05"));
}

#[test]
fn an_outline_stands_at_its_tilt() {
    let slats = array(FLAT, 30.0, Surface::matt(0.5), Surface::matt(0.5));
    let line = &slats.outline()[0];
    let (inner, outer) = (line[0], line[line.len() - 1]);
    assert!(outer[0] > inner[0] && outer[1] < inner[1], "the outer edge is lowered");
    assert!((outer[0] - 0.04 * 30_f64.to_radians().cos()).abs() < 1e-12);
    let solid = SlatArray::new(FLAT, 0.002, 0.072, 0.0, [Surface::matt(0.5); 2]).unwrap();
    let polygon = &solid.outline()[0];
    let area: f64 = (0..polygon.len())
        .map(|k| {
            let (a, b) = (polygon[k], polygon[(k + 1) % polygon.len()]);
            0.5 * (a[1] * b[0] - a[0] * b[1])
        })
        .sum();
    assert!((area - 0.080 * 0.002).abs() < 1e-12, "{area}");
}

//! Clear systems under the numerical goniophotometer: panes, laser-cut and prismatic panels, profiles between panes,
//! against closed forms, conservation laws and the reference kit.

mod bar;
mod kit;

use bar::bar;
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::direction::{Dir, Facade};
use cfs::compute::estimate::Silent;
use cfs::compute::system::clear::prism::Prisms;
use cfs::compute::system::clear::{Body, ClearSection, Material, Outline, OutlineError};
use cfs::compute::system::laser_cut::CutPanel;
use cfs::compute::system::laser_cut::LaserCutPanel;
use cfs::compute::system::measure::beams::Effort;
use cfs::compute::system::measure::beams::{Beams, Shares, SharpBeam, SharpBeams};
use cfs::compute::system::measure::{Measured, OpticalModel, Setting, Side};
use cfs::compute::system::panes::Panes;
use cfs::compute::system::panes::coated::{Layer, stack};
use cfs::compute::system::panes::glazing::{Pane, fresnel};
use glam::DVec3;
use std::f64::consts::PI;

fn klems() -> RingBasis {
    RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)
}

fn measure(specimen: &dyn OpticalModel) -> Measured {
    let basis = klems();
    let setting = Setting { incident: &basis, emergent: &basis, error: 0.01, seed: 1 };
    specimen.measure(&setting, &Silent).unwrap()
}

const PANE: Pane = Pane { index: 1.52, thickness: 0.004, absorption: 10.0 };

fn cut_panel() -> CutPanel {
    let sheet = Pane { index: 1.49, thickness: 0.006, absorption: 0.0 };
    CutPanel { panel: LaserCutPanel { sheet, spacing: 0.004 }, cut_loss: 0.0 }
}

fn prisms() -> Prisms {
    let material = Material { index: 1.49, absorption: 0.0 };
    Prisms { material, angles: [42.0, 5.0].map(f64::to_radians), pitch: 0.001, base: 0.001, flipped: false }
}

#[test]
fn cases_of_the_reference_kit() {
    if kit::folder().is_none() {
        return;
    }
    let specimens: [(&str, Box<dyn OpticalModel>); 4] = [
        ("pane1", Box::new(Panes::equal(Layer::Clear(PANE), 1))),
        ("pane2", Box::new(Panes::equal(Layer::Clear(PANE), 2))),
        ("lcp", Box::new(SharpBeams(cut_panel()))),
        ("prism", Box::new(prisms().section().unwrap().optical_model())),
    ];
    let mut wrong = vec![];
    for (name, specimen) in specimens {
        let start = std::time::Instant::now();
        let measured = measure(specimen.as_ref());
        let seconds = start.elapsed().as_secs_f64();
        let (found, quality) = (kit::compare(name, &measured), measured.quality());
        println!("{name}: {found:?} {quality:?} {seconds:.3} s");
        // The table of the prism is drawn at random, 40 000 rays a cell: standard errors up to 0.0025 where it states
        // 0.002, three of which hold for all of its 580 values.
        let allowed = if name == "prism" { 0.0055 } else { 0.003 };
        let near = found.worst.iter().all(|worst| *worst <= allowed);
        let patches = found.patches.iter().flatten().all(|error| *error <= 0.03);
        let balanced = quality.balance < 1e-6 && quality.reciprocity.is_some_and(|error| error < 0.01);
        if !(near && patches && balanced) {
            wrong.push(name);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn beams_turn_as_their_slopes_say() {
    let section = prisms().section().unwrap();
    let effort = Effort { share: 1e-2, seed: 3, surfaces: u32::MAX };
    let name = |x: f64, y: f64| Dir::from_unit(DVec3::new(x, y, (1.0 - x * x - y * y).sqrt()));
    let (mut here, mut beside) = (Shares::default(), Shares::default());
    let mut compared = 0;
    for (x, y) in [(0.1, 0.3), (-0.4, 0.5), (0.2, -0.6), (0.6, 0.1)] {
        for side in Side::BOTH {
            section.beams(name(x, y), side, effort, &mut here);
            for (axis, [dx, dy]) in [[1e-6, 0.0], [0.0, 1e-6]].into_iter().enumerate() {
                section.beams(name(x + dx, y + dy), side, effort, &mut beside);
                for beam in here.beams.iter().filter(|beam| beam.share > 0.02) {
                    let expected = beam.y + 1e-6 * beam.change[axis];
                    let near = beside.beams.iter().any(|b| {
                        b.transmitted == beam.transmitted
                            && (b.share - beam.share).abs() < 1e-3
                            && (b.y - expected).abs() < 1e-9
                    });
                    assert!(near, "{x} {y} {side:?} {axis} {beam:?} {:?}", beside.beams);
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 30, "{compared}");
}

fn sheet(index: f64, absorption: f64) -> ClearSection {
    let face = |z: f64| vec![[z, 0.0], [z, 0.01]];
    let outline = Outline::Sheet { outer: face(0.0), inner: face(-0.004) };
    ClearSection::new(0.01, vec![Body { outline, material: Material { index, absorption } }], [None, None]).unwrap()
}

fn totals(system: &impl Beams, name: Dir<Facade>, side: Side) -> [f64; 3] {
    let mut shares = Shares::default();
    system.beams(name, side, Effort { share: 1e-7, seed: 5, surfaces: u32::MAX }, &mut shares);
    let sum = |transmitted: bool| shares.beams.iter().filter(|b| b.transmitted == transmitted).map(|b| b.share).sum();
    [sum(true), sum(false), shares.absorbed]
}

#[test]
fn light_caught_in_dark_prisms_is_absorbed_in_the_end() {
    // 1000 times darker than glass: what total reflection keeps in falls below the least number a computer holds.
    let material = Material { index: 1.49, absorption: 5000.0 };
    let angles = [90.0_f64, 35.0].map(f64::to_radians);
    let section = Prisms { material, angles, pitch: 0.001, base: 0.001, flipped: false }.section().unwrap();
    for (theta, phi) in [(0.0, 0.0), (0.6, 1.5), (1.2, -1.0), (1.5, 3.0)] {
        for side in Side::BOTH {
            let [t, r, a] = totals(&section, Dir::from_theta_phi(theta, phi), side);
            assert!((t + r + a - 1.0).abs() < 1e-12 && t < 0.02 && r < 0.9, "{theta} {phi} {side:?}: {t} {r} {a}");
        }
    }
}

#[test]
fn a_slab_under_the_tracer_is_the_pane() {
    let pane = Pane { index: 1.52, thickness: 0.004, absorption: 10.0 };
    for theta in [0.0, 0.4, 1.0, 1.45] {
        for phi in [0.0, 0.7, 2.0, 4.4] {
            let [t, r, a] = totals(&sheet(1.52, 10.0), Dir::from_theta_phi(theta, phi), Side::Front);
            let exact = stack(&[Layer::Clear(pane)], theta);
            assert!(
                (t - exact.transmitted).abs() < 1e-6 && (r - exact.reflected_front).abs() < 1e-6,
                "{theta} {phi}: {t} {r}"
            );
            assert!((t + r + a - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn bars_that_touch_are_a_laser_cut_panel() {
    // Bars with an air gap of no width between them: Edmonds' panel, from shape alone. In the vertical plane only:
    // elsewhere total reflection at the cuts turns the polarisation, which the closed form leaves out (some 0.1 %).
    let bar = Outline::Closed(vec![[0.0, 0.0], [0.0, 0.004], [-0.006, 0.004], [-0.006, 0.0]]);
    let body = Body { outline: bar, material: Material { index: 1.49, absorption: 0.0 } };
    let section = ClearSection::new(0.004, vec![body], [None, None]).unwrap();
    let mut shares = Shares::default();
    for (theta, phi) in [(0.3, 0.5 * PI), (0.8, 1.5 * PI), (1.1, 0.5 * PI)] {
        let name = Dir::from_theta_phi(theta, phi);
        section.beams(name, Side::Front, Effort { share: 1e-7, seed: 5, surfaces: u32::MAX }, &mut shares);
        let y = name.vector().y;
        let sum = |transmitted: bool, sign: f64| -> f64 {
            let fits = |b: &&SharpBeam| b.transmitted == transmitted && (b.y - sign * y).abs() < 1e-9;
            shares.beams.iter().filter(fits).map(|b| b.share).sum()
        };
        let exact = cut_panel().panel.shares(name, 0.0);
        let expected = [
            (true, 1.0, exact.straight),
            (true, -1.0, exact.deflected),
            (false, 1.0, exact.mirrored),
            (false, -1.0, exact.returned),
        ];
        for (transmitted, sign, share) in expected {
            assert!(
                (sum(transmitted, sign) - share).abs() < 1e-4,
                "{theta} {phi} {transmitted} {sign}: {} {share}",
                sum(transmitted, sign)
            );
        }
    }
}

#[test]
fn a_prism_bends_by_snells_law_and_returns_by_total_reflection() {
    let effort = Effort { share: 1e-6, seed: 9, surfaces: u32::MAX };
    let mut shares = Shares::default();
    // 30° above, vertical flank below: light on the flat face at normal incidence leaves the slope at asin(n sin 30°).
    let n: f64 = 1.49;
    let prism = Prisms { angles: [30.0, 90.0].map(f64::to_radians), ..prisms() };
    prism.section().unwrap().beams(Dir::from_theta_phi(0.0, 0.0), Side::Front, effort, &mut shares);
    let slope = 30_f64.to_radians();
    let refracted = (n * slope.sin()).asin();
    // Travelling inwards; the slope's normal rises, so light turns away from the normal: down. Its name points up.
    let y = (refracted - slope).sin();
    let found: f64 = shares.beams.iter().filter(|b| b.transmitted && (b.y - y).abs() < 1e-9).map(|b| b.share).sum();
    let enters = 1.0 - ((n - 1.0) / (n + 1.0)).powi(2);
    let ([s, p], _) = fresnel(n, refracted);
    // Mirrored at the slope the light goes elsewhere; what comes back in this direction is below 1 %.
    assert!((found - enters * (1.0 - 0.5 * (s + p))).abs() < 0.01, "{found} {y}");
    // Right angle with 45° flanks: total reflection twice, straight back. Only the first surface's reflection differs.
    let prism = Prisms { angles: [45.0; 2].map(f64::to_radians), ..prisms() };
    let [t, r, _] = totals(&prism.section().unwrap(), Dir::from_theta_phi(0.0, 0.0), Side::Front);
    assert!(t < 1e-6 && (r - 1.0).abs() < 1e-6, "{t} {r}");
}

#[test]
fn deviation_is_least_where_light_crosses_symmetrically() {
    // A closed prism of 40° between far neighbours: at the symmetric passage sin((A + D)/2) = n sin(A/2).
    let (apex, n) = (40_f64.to_radians(), 1.49_f64);
    let half = 0.5 * apex;
    let outline = Outline::Closed(vec![[0.0, 0.002], [-0.002 * half.tan(), 0.0], [0.002 * half.tan(), 0.0]]);
    let body = Body { outline, material: Material { index: n, absorption: 0.0 } };
    let section = ClearSection::new(0.05, vec![body], [None, None]).unwrap();
    let mut shares = Shares::default();
    // The strongest beam beside what passes by, as deviation.
    let mut deviation = |incidence: f64| {
        let travel = incidence - half;
        let name = Dir::from_theta_phi(travel.abs(), if travel > 0.0 { 1.5 * PI } else { 0.5 * PI });
        section.beams(name, Side::Front, Effort { share: 1e-6, seed: 2, surfaces: u32::MAX }, &mut shares);
        let turned = shares.beams.iter().filter(|b| b.transmitted && (b.y - name.vector().y).abs() > 1e-6);
        let beam = turned.max_by(|a, b| a.share.total_cmp(&b.share)).unwrap();
        (beam.y.asin() - name.vector().y.asin()).abs()
    };
    let symmetric = (n * half.sin()).asin();
    let least = 2.0 * symmetric - apex;
    assert!((deviation(symmetric) - least).abs() < 1e-9, "{} {least}", deviation(symmetric));
    assert!(deviation(symmetric + 0.05) > least && deviation(symmetric - 0.05) > least);
}

#[test]
fn flipped_prisms_exchange_the_sides() {
    let (there, turned) = (prisms().section().unwrap(), Prisms { flipped: true, ..prisms() }.section().unwrap());
    for (theta, phi) in [(0.2, 1.0), (0.9, 4.0), (1.2, 2.2)] {
        let name = Dir::from_theta_phi(theta, phi);
        // Mirrored in the plane, light that travelled to +y still does: the name turns by 180° as the side changes.
        let other = Dir::from_theta_phi(theta, phi + PI);
        for (a, b) in totals(&there, name, Side::Front).into_iter().zip(totals(&turned, other, Side::Back)) {
            assert!((a - b).abs() < 1e-5, "{theta} {phi}: {a} {b}");
        }
    }
}

fn grooves(upper: f64, lower: f64) -> ClearSection {
    Prisms { angles: [upper, lower].map(f64::to_radians), ..prisms() }.section().unwrap()
}

#[test]
fn light_in_steep_grooves_ends() {
    let mut shares = Shares::default();
    for (upper, lower) in [(89.0, 89.0), (89.8, 89.9), (90.0, 80.0), (80.0, 80.0)] {
        let section = grooves(upper, lower);
        let (mut surfaces, mut lost): (u64, f64) = (0, 0.0);
        for number in 0..40_u32 {
            let name = Dir::from_theta_phi(0.035 * f64::from(number), 0.9 * f64::from(number));
            let side = Side::BOTH[number as usize % 2];
            let effort = Effort { share: 0.01, seed: u64::from(number), surfaces: Effort::SURFACES };
            section.beams(name, side, effort, &mut shares);
            let sum: f64 = shares.beams.iter().map(|b| b.share).sum();
            assert!((sum + shares.absorbed - 1.0).abs() < 1e-9, "{upper} {lower} {number}: {sum} {}", shares.absorbed);
            lost += shares.lost / 40.0;
            surfaces += u64::from(shares.surfaces);
        }
        assert!(lost < 0.02, "{upper} {lower}: {lost}");
        println!("{upper} {lower}: {surfaces} surfaces, {lost:.5} given up");
        // Ten times the usual surfaces, and then one beam to its end.
        assert!(surfaces < 40 * 15 * u64::from(Effort::SURFACES), "{upper} {lower}: {surfaces}");
    }
}

#[test]
fn less_effort_means_more_noise_but_no_bias() {
    let section = grooves(80.0, 75.0);
    let name = Dir::from_theta_phi(0.7, 2.0);
    let mut shares = Shares::default();
    // Mean and its standard error, of what is transmitted and of what goes down into the room.
    let mut mean = |share: f64, surfaces: u32, count: u32| {
        let (mut sum, mut squares) = ([0.0; 2], [0.0; 2]);
        for seed in 0..count {
            let effort = Effort { share, seed: u64::from(seed) << 20, surfaces };
            section.beams(name, Side::Front, effort, &mut shares);
            let passed = shares.beams.iter().filter(|b| b.transmitted);
            let (all, down) =
                passed.fold((0.0, 0.0), |(all, down), b| (all + b.share, down + if b.y > 0.0 { b.share } else { 0.0 }));
            for (k, value) in [all, down].into_iter().enumerate() {
                sum[k] += value;
                squares[k] += value * value;
            }
        }
        let n = f64::from(count);
        [0, 1].map(|k| [sum[k] / n, ((squares[k] / n - (sum[k] / n).powi(2)) / n).sqrt()])
    };
    let exact = mean(1e-3, 1_000_000, 3);
    // Single rays; divided beams; one for all after ten surfaces; shares that grow.
    for (share, surfaces, count) in
        [(f64::INFINITY, u32::MAX, 40_000), (0.1, u32::MAX, 2000), (0.01, 1, 20_000), (0.01, 30, 4000)]
    {
        for ([found, error], [expected, doubt]) in mean(share, surfaces, count).into_iter().zip(exact) {
            let allowed = 4.0 * error.hypot(doubt);
            assert!(allowed < 0.012, "{share} {surfaces}: {allowed}");
            assert!((found - expected).abs() < allowed, "{share} {surfaces}: {found} {expected} ± {allowed}");
        }
    }
}

#[test]
fn stated_errors_hold() {
    let basis = klems();
    let section = grooves(70.0, 20.0).optical_model();
    let run = |error: f64, seed: u64| {
        let setting = Setting { incident: &basis, emergent: &basis, error, seed };
        section.measure(&setting, &Silent).unwrap()
    };
    let fine = run(0.006, 9);
    assert!(fine.quality().error <= 0.006, "{:?}", fine.quality());
    let (mut over, mut count, mut worst) = (0, 0, 0.0_f64);
    for seed in 1..=3 {
        let coarse = run(0.05, seed);
        assert!(coarse.quality().error <= 0.05, "{:?}", coarse.quality());
        for side in Side::BOTH {
            let (seen, best) = (coarse.seen(side), fine.seen(side));
            let found = [&seen.transmitted, &seen.reflected].map(|q| coarse.shares(q));
            let expected = [&best.transmitted, &best.reflected].map(|q| fine.shares(q));
            for i in 0..basis.len() {
                let off = (0..2).map(|k| (found[k][i] - expected[k][i]).abs()).fold(0.0, f64::max);
                over += usize::from(off > seen.error[i] + best.error[i]);
                count += 1;
                worst = worst.max(off);
            }
        }
    }
    // The allowed error holds for all cells, the stated ones for nearly all, without being far too large.
    assert!(worst < 0.05 && worst > 0.003, "{worst}");
    assert!(over * 50 <= count, "{over} of {count}");
}

#[test]
fn profiles_between_panes_keep_energy() {
    let outline = Outline::Closed(bar(0.012, 0.004, [0.0015, 0.0015], 0.5));
    let body = Body { outline, material: Material { index: 1.49, absorption: 0.0 } };
    let pane = Pane { index: 1.52, thickness: 0.004, absorption: 5.0 };
    let section = ClearSection::new(0.006, vec![body], [Some(pane), Some(pane)]).unwrap();
    assert_eq!(section.outline().len(), 3);
    let mut shares = Shares::default();
    for (theta, phi) in [(0.2, 1.0), (0.9, 4.0)] {
        section.beams(
            Dir::from_theta_phi(theta, phi),
            Side::Front,
            Effort { share: 2e-3, seed: 5, surfaces: u32::MAX },
            &mut shares,
        );
        let sum: f64 = shares.beams.iter().map(|b| b.share).sum();
        assert!((sum + shares.absorbed - 1.0).abs() < 1e-9 && shares.absorbed > 0.02, "{theta} {phi} {sum}");
        assert!(shares.lost < 1e-3, "{}", shares.lost);
    }
}

#[test]
fn outlines_that_are_no_bodies_are_told() {
    let material = Material { index: 1.49, absorption: 0.0 };
    let section = |points: Vec<[f64; 2]>| {
        ClearSection::new(1.0, vec![Body { outline: Outline::Closed(points), material }], [None, None])
    };
    let bow = section(vec![[0.0, 0.0], [0.5, 0.5], [0.5, 0.0], [0.0, 0.7]]);
    assert!(matches!(bow, Err(OutlineError::Crossing(0, 0))), "{bow:?}");
    let high = section(vec![[0.0, 0.0], [0.5, 0.0], [0.6, 1.4], [0.1, 1.4]]);
    assert!(matches!(high, Err(OutlineError::Crossing(0, 0))), "{high:?}");
    assert!(section(vec![[0.0, 0.0], [0.5, f64::NAN], [0.5, 0.5]]).is_err());
}

#[test]
fn redirecting_glass_keeps_energy_and_reciprocity_in_all_cells() {
    let outline = Outline::Closed(vec![[-0.006, 0.0], [0.006, 0.0], [0.006, 0.003], [-0.006, 0.004]]);
    let body = Body { outline, material: Material { index: 1.49, absorption: 2.0 } };
    let pane = Pane { index: 1.52, thickness: 0.004, absorption: 5.0 };
    let section = ClearSection::new(0.006, vec![body], [Some(pane), Some(pane)]).unwrap();
    let basis = klems();
    let setting = Setting { incident: &basis, emergent: &basis, error: 0.02, seed: 1 };
    let measured = section.optical_model().measure(&setting, &Silent).unwrap();
    let quality = measured.quality();
    println!("{quality:?}");
    assert!(quality.balance < 1e-6, "{quality:?}");
    assert!(quality.reciprocity.unwrap() < 0.05, "{quality:?}");
    assert!(quality.error < 0.02, "{quality:?}");
    let weight = measured.emergent.projected_solid_angles();
    let [front, back] = [&measured.front, &measured.back].map(|seen| {
        let shares = measured.shares(&seen.transmitted);
        shares.iter().zip(&weight).map(|(t, w)| t * w).sum::<f64>() / PI
    });
    // Uniform light: the same both ways.
    assert!((front - back).abs() < 2e-3, "{front} {back}");
}

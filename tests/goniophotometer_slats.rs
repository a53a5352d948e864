//! Slats of the numerical goniophotometer: against published reference cases, closed forms, conservation laws.

#[path = "goniophotometer/kit.rs"]
mod kit;

use cfs::compute::basis::RingBasis;
use cfs::compute::btdf::Component;
use cfs::compute::estimate::Silent;
use cfs::compute::goniophotometer::{Measured, Setting, Side, Specimen};
use cfs::compute::section::{SlatArray, Surface};
use cfs::compute::system::slat_profile::SlatProfile;
use std::time::Instant;

fn setting(basis: &RingBasis) -> Setting<'_> {
    Setting { incident: basis, emergent: basis, error: 0.01, seed: 1 }
}

fn measure(array: &SlatArray) -> Measured {
    array.measure(&setting(&kit::klems()), &Silent).unwrap()
}

#[test]
fn blinds_are_those_of_the_reference_cases() {
    let Some(folder) = kit::folder() else {
        eprintln!("SKIPPED: the reference cases of blinds (set CFS_TEST_DATA)");
        return;
    };
    let cases = kit::venetians(&folder);
    assert!(cases.len() >= 9, "{} venetian states", cases.len());
    let mut wrong = vec![];
    println!("state            s      | τ worst  ρ worst | patches T      R | balance  reciprocity  stated");
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
        println!(
            "{:16} {seconds:.3}  | {:.5}  {:.5} | {:.4} {:.4}  {:.4} {:.4} | {:.1e} {:.1e} {:.1e}",
            case.name,
            worst[0],
            worst[1],
            patches[0],
            back[0],
            patches[1],
            back[1],
            quality.balance,
            quality.reciprocity.unwrap_or(f64::NAN),
            quality.error
        );
        if patches.iter().chain(&back).any(|error| *error > 0.03) {
            wrong.push(format!("{}: patches {patches:?} {back:?}", case.name));
        }
        if quality.balance > 1e-3 || quality.reciprocity.is_some_and(|r| r > 0.01) {
            wrong.push(format!("{}: {quality:?}", case.name));
        }
    }
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong[..wrong.len().min(30)].join("\n"));
}

#[test]
fn scratch() {
    for case in kit::venetians(&kit::folder().unwrap()) {
        if case.name == "ven_mirror_15" {
            let k = kit::klems();
            for error in [0.01, 0.0025, 0.0006] {
                let start = Instant::now();
                let m = case.array.measure(&Setting { incident: &k, emergent: &k, error, seed: 1 }, &Silent).unwrap();
                println!("{error} {:?} {:?}", m.quality(), start.elapsed());
                for side in Side::BOTH {
                    let (t, r) = (m.shares(&m.seen(side).transmitted), m.shares(&m.seen(side).reflected));
                    let rest: Vec<String> = (0..145)
                        .map(|i| format!("{:.0}", 1e5 * (t[i] + r[i] + m.seen(side).absorbed[i] - 1.0)))
                        .collect();
                    println!("{}", rest.join(" "));
                }
            }
        }
    }
}

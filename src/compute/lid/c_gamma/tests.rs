//! The table of planes and angles: angles and directions, flux, interpolation, against closed forms.

use super::*;
use crate::compute::basis::{AzimuthMap, RingBasis};
use crate::compute::lid::SunBeam;
use crate::compute::system::measure::ProfileLight;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

fn lid(parts: Vec<EmergentLuminance>) -> Lid {
    Lid { surface: Surface::Facade, size: [1.2, 1.0], parts, beams: Vec::new() }
}

#[test]
fn angles_and_directions_are_inverse() {
    for aim in [Aim::Mounted, Aim::Down] {
        for (c, gamma) in [(0.3, 0.2), (1.9, 1.2), (4.0, 2.8), (6.2, 1.57)] {
            let (c_back, gamma_back) = aim.angles(aim.direction(c, gamma));
            assert!((c_back - c).abs() < 1e-12 && (gamma_back - gamma).abs() < 1e-12);
        }
    }
}

#[test]
fn lambert_is_the_cosine_and_its_flux_is_pi() {
    let uniform = lid(vec![EmergentLuminance::Uniform(1000.0)]);
    for (aim, peak_c, peak_gamma) in [(Aim::Mounted, 0, 36), (Aim::Down, 0, 0)] {
        let table = CGammaTable::new(&uniform, aim, Step::NORMAL);
        let flux = PI * 1000.0 * 1.2;
        assert!((table.flux.value / flux - 1.0).abs() < 1e-12);
        assert!((table.zonal_flux() / flux - 1.0).abs() < 1e-12);
        assert!((table.scaled_by - 1.0).abs() < 5e-4, "{}", table.scaled_by);
        // The average over a cell of 2.5° flattens the cosine by less than Δ²/12.
        assert!((table.plane(peak_c)[peak_gamma] / 1200.0 - 1.0).abs() < 4e-4);
        for plane in 0..table.planes() {
            for angle in 0..table.angles() {
                let (c, g) = (plane as f64 * 2.5_f64.to_radians(), angle as f64 * 2.5_f64.to_radians());
                let cosine = match aim {
                    Aim::Mounted => g.sin() * c.cos(),
                    Aim::Down => g.cos(),
                };
                // Nodes in the aperture's plane hold half a cell of light: their mean is not zero.
                assert!((table.plane(plane)[angle] - 1200.0 * cosine.max(0.0)).abs() < 0.006 * 1200.0);
            }
        }
    }
}

#[test]
fn function_flux_agrees_with_polar_quadrature() {
    // A bright spot of 6° above the horizon and a dark ground: steps at y = 0.
    let spot = Dir::<Facade>::from_theta_phi(0.7, 1.2);
    let f = move |d: Dir<Facade>| {
        let glow = ((d.dot(spot) - 1.0) / 0.006).exp();
        if d.vector().y > 0.0 { 1000.0 + 2e5 * glow } else { 100.0 }
    };
    let n = 1000;
    let mut independent = 0.0;
    for i in 0..n {
        // Equal steps of sin²θ carry equal projected solid angle.
        let theta = ((i as f64 + 0.5) / n as f64).sqrt().asin();
        for k in 0..n {
            independent += f(Dir::from_theta_phi(theta, (k as f64 + 0.5) * 2.0 * PI / n as f64));
        }
    }
    independent *= PI / (n * n) as f64 * 1.2;
    let lid = lid(vec![EmergentLuminance::Function(Arc::new(f))]);
    for aim in [Aim::Mounted, Aim::Down] {
        let table = CGammaTable::new(&lid, aim, Step::NORMAL);
        assert!((table.flux.value / independent - 1.0).abs() < 1e-4, "{} {independent}", table.flux.value);
        assert!((table.zonal_flux() / independent - 1.0).abs() < 1e-4);
        assert!((table.flux.value - independent).abs() < table.flux.error.max(1e-4 * independent));
    }
}

#[test]
fn bands_are_the_function_that_they_stand_for_and_their_flux_is_exact() {
    for upright in [false, true] {
        let q = (0..181).map(|k| if k % 7 < 3 { 40.0 * f64::from(k) } else { 1000.0 }).collect();
        let bands = ProfileLight { upright, q, error: 0.0 };
        let exact = bands.share() * 1.2;
        let same = bands.clone();
        let function =
            lid(vec![EmergentLuminance::Function(Arc::new(move |undeviated: Dir<Facade>| same.at(undeviated)))]);
        let lid = lid(vec![EmergentLuminance::Bands(bands)]);
        for aim in [Aim::Mounted, Aim::Down] {
            let [table, other] = [&lid, &function].map(|lid| CGammaTable::new(lid, aim, Step::FINE));
            assert!((table.flux.value / exact - 1.0).abs() < 1e-12 && (table.zonal_flux() / exact - 1.0).abs() < 1e-12);
            assert!((other.flux.value / exact - 1.0).abs() < 1e-3, "{} {exact}", other.flux.value);
            let largest = other.intensity.iter().copied().fold(0.0, f64::max);
            // Bands as unlike as these are met by 6 points over half a step.
            for (a, b) in table.intensity.iter().zip(&other.intensity) {
                assert!((a - b).abs() < 0.06 * largest, "{a} {b} of {largest}");
            }
        }
    }
}

#[test]
fn cell_flux_is_exact_and_narrow_cells_keep_it() {
    let basis = Arc::new(RingBasis::klems_full(AzimuthMap::KLEMS_FRONT));
    let mut luminance = vec![0.0; basis.len()];
    luminance[100] = 5000.0;
    let exact = 5000.0 * basis.cell(100).projected_solid_angle() * 1.2;
    let lid = lid(vec![EmergentLuminance::Cells { basis: basis.clone(), luminance }]);
    for (aim, step) in [(Aim::Mounted, Step::NORMAL), (Aim::Down, Step::NORMAL), (Aim::Mounted, Step::FINE)] {
        let table = CGammaTable::new(&lid, aim, step);
        assert!((table.zonal_flux() / exact - 1.0).abs() < 1e-12);
        assert!((table.scaled_by - 1.0).abs() < 5e-4);
        // In the middle of the cell the table has the intensity itself.
        let (c, gamma) = aim.angles(Emergent::from_undeviated(basis.cell(100).centre()));
        let delta = step.degrees().to_radians();
        let node = table.plane((c / delta).round() as usize % table.planes())[(gamma / delta).round() as usize];
        let expected = 5000.0 * 1.2 * basis.cell(100).theta().cos();
        assert!((node / expected - 1.0).abs() < 0.05, "{node} {expected}");
    }
}

#[test]
fn beam_keeps_flux_and_direction() {
    let down_right = Dir::<Facade>::new(DVec3::new(0.31, -0.62, -0.72)).unwrap();
    let lid =
        Lid { beams: vec![SunBeam { direction: Emergent(down_right), flux: 900.0, straight: true }], ..lid(vec![]) };
    for aim in [Aim::Mounted, Aim::Down] {
        let table = CGammaTable::new(&lid, aim, Step::for_lid(&lid));
        assert_eq!(table.step, Step::FINE);
        assert!((table.zonal_flux() - 900.0).abs() < 1e-9);
        let delta = table.step.degrees().to_radians();
        let mut sum = DVec3::ZERO;
        for plane in 0..table.planes() {
            for angle in 0..table.angles() {
                let (c, g) = (plane as f64 * delta, angle as f64 * delta);
                sum += aim.direction(c, g).0.vector() * table.plane(plane)[angle] * g.sin();
            }
        }
        let mean = Dir::<Facade>::new(sum).unwrap();
        assert!(mean.dot(down_right) > 0.05_f64.to_radians().cos(), "{:?}", mean);
    }
}

/// Light that goes up and right (seen from outside) must be found where C and γ say so, and nowhere else.
#[test]
fn up_is_up_and_right_is_right() {
    let only = |x: f64, y: f64| {
        lid(vec![EmergentLuminance::Function(Arc::new(move |undeviated: Dir<Facade>| {
            let goes = undeviated.reversed().vector();
            f64::from(goes.x * x > 0.0 && goes.y * y > 0.0)
        }))])
    };
    for (x, y) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
        let table = CGammaTable::new(&only(x, y), Aim::Mounted, Step::NORMAL);
        for plane in 0..table.planes() {
            let c = plane as f64 * 2.5;
            for (angle, &value) in table.plane(plane).iter().enumerate() {
                let gamma = angle as f64 * 2.5;
                let goes_up = gamma > 91.0;
                let goes_down = gamma < 89.0;
                // Seen from outside, C90 is to the left: C turns from into the room over −x.
                // Nadir and zenith are on both sides.
                let pole = angle == 0 || angle == table.angles() - 1;
                let right = c > 271.0 && !pole;
                let left = c > 1.0 && c < 89.0 && !pole;
                if value > 1e-3 {
                    assert!(if y > 0.0 { !goes_down } else { !goes_up }, "C {c} γ {gamma}");
                    assert!(if x > 0.0 { !left } else { !right }, "C {c} γ {gamma}");
                }
            }
        }
    }
}

#[test]
fn steps_divide_the_quarter() {
    assert_eq!(Step::from_degrees(2.5), Ok(Step::NORMAL));
    assert_eq!(Step::from_degrees(1.0), Ok(Step::FINE));
    for wrong in [0.5, 7.0, 30.0, -1.0, f64::NAN, 0.0] {
        assert!(Step::from_degrees(wrong).is_err());
    }
}

#[test]
fn empty_distribution_is_a_table_of_zeros() {
    let table = CGammaTable::new(&lid(vec![]), Aim::Mounted, Step::NORMAL);
    assert!(table.intensity.iter().all(|&i| i == 0.0) && table.flux.value == 0.0);
}

/// The two peaks are the table's own: together its largest value, apart what each kind of light gives alone.
#[test]
fn peaks_are_the_tables_largest_values_of_scattered_light_and_of_beams() {
    let glow = |spot: Dir<Facade>| {
        EmergentLuminance::Function(Arc::new(move |undeviated: Dir<Facade>| {
            50.0 + 9000.0 * ((undeviated.dot(spot) - 1.0) / 0.02).exp()
        }))
    };
    // Brightest upwards to the right; the beam goes down to the left.
    let spot = Emergent(Dir::new(DVec3::new(0.4, 0.5, -0.77)).unwrap());
    let beam = Emergent(Dir::new(DVec3::new(-0.31, -0.62, -0.72)).unwrap());
    let scattered = lid(vec![glow(spot.undeviated_incident())]);
    let both = Lid { beams: vec![SunBeam { direction: beam, flux: 900.0, straight: true }], ..scattered.clone() };
    let table = CGammaTable::new(&both, Aim::Mounted, Step::for_lid(&both));
    let peaks = Peaks::of(&both, &Silent).unwrap();
    let near =
        |peak: &Peak, to: Emergent| Aim::Mounted.direction(peak.c, peak.gamma).0.dot(to.0) > 1.1_f64.to_radians().cos();
    let (own, sun) = (peaks.scattered.unwrap(), peaks.beam.unwrap());
    assert!(near(&sun, beam) && own.intensity < 0.01 * sun.intensity, "{peaks:?}");
    assert_eq!(sun.intensity, table.intensity.iter().copied().fold(0.0, f64::max));
    // The largest of L·cosθ leans a little from the spot towards the normal.
    let alone = CGammaTable::new(&scattered, Aim::Mounted, Step::FINE).peaks();
    assert!(alone.beam.is_none());
    let alone = alone.scattered.unwrap();
    assert_eq!((alone.c, alone.gamma), (own.c, own.gamma));
    assert!((alone.intensity / own.intensity - 1.0).abs() < 5e-3, "{alone:?} {own:?}");
    assert!(Peaks::of(&lid(vec![]), &Silent).unwrap().scattered.is_none());
}

#[test]
fn a_table_that_is_no_longer_needed_ends_soon() {
    /// Cancelled from the hundredth question on.
    #[derive(Default)]
    struct Hundred(AtomicUsize);
    impl Progress for Hundred {
        fn cancelled(&self) -> bool {
            self.0.fetch_add(1, Ordering::Relaxed) >= 100
        }
    }
    let asked = Arc::new(AtomicUsize::new(0));
    let counted = Arc::clone(&asked);
    let light = lid(vec![EmergentLuminance::Function(Arc::new(move |_| {
        counted.fetch_add(1, Ordering::Relaxed);
        100.0
    }))]);
    let points = |progress: &dyn Progress| {
        let is_cancelled = Peaks::of(&light, progress).is_err();
        (is_cancelled, asked.swap(0, Ordering::Relaxed))
    };
    let (is_cancelled, whole) = points(&Silent);
    assert!(!is_cancelled);
    let (is_cancelled, part) = points(&Hundred::default());
    assert!(is_cancelled && 20 * part < whole, "{part} of {whole}");
}

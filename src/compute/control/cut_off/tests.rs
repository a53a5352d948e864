//! Cut-off against the classic closed form, the extent's own definition, and rays that meet slats or do not.

use super::*;
use crate::compute::system::slats::Surface;
use std::f64::consts::FRAC_PI_2;

fn flat(width: f64, spacing: f64) -> SlatRow {
    SlatRow::new(SlatProfile::Flat { width }, spacing).unwrap()
}

fn sections() -> Vec<SlatRow> {
    let arc = |width, rise, spacing| SlatRow::new(SlatProfile::Arc { width, rise }, spacing).unwrap();
    let polyline =
        |points: &[[f64; 2]], spacing| SlatRow::new(SlatProfile::Polyline(points.to_vec()), spacing).unwrap();
    vec![
        flat(0.080, 0.072),
        flat(0.080, 0.060),
        flat(0.050, 0.060),
        arc(0.080, 0.008, 0.072),
        arc(0.080, -0.008, 0.072),
        arc(0.025, 0.0125, 0.020),
        arc(0.060, 0.010, 0.070),
        polyline(&[[-0.04, 0.0], [-0.01, 0.006], [0.01, 0.002], [0.04, 0.008]], 0.072),
        polyline(&[[0.05, -0.01], [0.0, 0.012], [-0.03, 0.0]], 0.070),
    ]
}

/// Section of a slat in many pieces, for tracing rays across the blind.
struct Rays {
    points: Vec<[f64; 2]>,
    spacing: f64,
}

impl Rays {
    fn new(section: &SlatRow) -> Self {
        Self { points: section.profile.polyline(400), spacing: section.spacing }
    }

    /// Whether a ray from outside through (outward 0, upward `height`) at profile angle `psi` meets no slat.
    fn passes(&self, tilt: f64, psi: f64, height: f64) -> bool {
        let (sin, cos) = tilt.sin_cos();
        // β > 0 lowers the outer edge: (u, v) → (u cosβ + v sinβ, v cosβ − u sinβ).
        let turned = |[u, v]: [f64; 2]| [u * cos + v * sin, v * cos - u * sin];
        let slope = psi.tan();
        let reach = self.points.iter().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max) * (1.0 + slope.abs());
        let first = ((height - reach) / self.spacing).floor() as i64;
        let last = ((height + reach) / self.spacing).ceil() as i64;
        // Height of the ray over a point, whose sign differs between the ends of what it meets.
        let above = |p: [f64; 2], slat: i64| height + slope * p[0] - p[1] - slat as f64 * self.spacing;
        !(first..=last).any(|slat| {
            let sides = self.points.windows(2).map(|ends| {
                let [a, b] = [turned(ends[0]), turned(ends[1])];
                above(a, slat) * above(b, slat)
            });
            sides.into_iter().any(|product| product <= 0.0)
        })
    }

    /// Returns rays that pass the edges of the shadows at a distance \[m\], and some in between.
    fn any_passes(&self, tilt: f64, psi: f64, distance: f64) -> bool {
        let (sin, cos) = tilt.sin_cos();
        let heights = self.points.iter().map(|[u, v]| (v * cos - u * sin) - psi.tan() * (u * cos + v * sin));
        let [low, high] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], h| [a.min(h), b.max(h)]);
        let step = distance / psi.cos();
        let between = (0..40).map(|k| self.spacing * f64::from(k) / 40.0 + 1.234e-5);
        [low - step, high + step].into_iter().chain(between).any(|height| self.passes(tilt, psi, height))
    }
}

#[test]
fn flat_slats_have_the_known_closed_form() {
    for psi in (0..=60).map(|k| f64::from(k).to_radians()) {
        // asin((s/w) cosψ) − ψ
        let known = (0.072 / 0.080 * psi.cos()).asin() - psi;
        let found = flat(0.080, 0.072).cut_off([-1.4, 1.4], 0.0, [psi, psi]).unwrap();
        assert!((found - known.max(0.0)).abs() < 1e-12, "{psi}: {found} {known}");
    }
}

#[test]
fn rays_agree_at_every_section_on_both_sides_of_the_limit() {
    for section in sections() {
        let rays = Rays::new(&section);
        let (mut found, mut none) = (0, 0);
        for psi in (-60..=85).step_by(5).map(|k| f64::from(k).to_radians()) {
            for range in [[-1.4, 1.4], [0.0, 1.5], [-1.5, 0.0]] {
                let Some(tilt) = section.cut_off(range, 0.0, [psi, psi]) else {
                    // No tilt of the range blocks the light.
                    for k in 0..=200 {
                        let tilt = range[0] + (range[1] - range[0]) * f64::from(k) / 200.0;
                        assert!(!section.blocks(tilt, 0.0, [psi, psi]));
                        assert!(rays.any_passes(tilt, psi, 1e-9), "{section:?} {tilt} {psi}");
                    }
                    none += 1;
                    continue;
                };
                found += 1;
                assert!(!rays.any_passes(tilt, psi, 1e-6), "{section:?} ψ {psi} β {tilt}");
                // Everything more open lets light through.
                for k in 0..100 {
                    let open = tilt * f64::from(k) / 100.0;
                    if (range[0]..=range[1]).contains(&open) && open != tilt && (tilt - open).abs() > 1e-4 {
                        assert!(rays.any_passes(open, psi, 1e-9), "{section:?} ψ {psi} β {open} before {tilt}");
                    }
                }
            }
        }
        assert!(found > 20, "{section:?}: {found} {none}");
    }
}

#[test]
fn spans_and_tolerances_are_kept_whole() {
    for section in sections() {
        for low in (-40..=80).step_by(8).map(|k| f64::from(k).to_radians()) {
            for (width, tolerance) in [(0.0093, 0.0), (0.0093, 0.02), (0.3, 0.01), (1.0, 0.0)] {
                let span = [low, f64::min(low + width, 1.55)];
                let Some(tilt) = section.cut_off([-1.4, 1.4], tolerance, span) else { continue };
                assert!(section.blocks(tilt, tolerance, span));
                let at = |k: usize, n: usize, [a, b]: [f64; 2]| a + (b - a) * k as f64 / n as f64;
                for i in 0..=60 {
                    for j in 0..=8 {
                        let (psi, off) = (at(i, 60, span), at(j, 8, [-tolerance, tolerance]));
                        let share = section.direct_share(tilt + off, psi);
                        assert!(share < 1e-8, "{section:?} {span:?} ± {tolerance}: {share} at {psi}");
                    }
                }
                // A little more open, some light of the span gets past some of the tolerance.
                let open = tilt - 1e-3 * tilt.signum();
                if tilt != 0.0 {
                    let most = (0..=2000)
                        .flat_map(|i| [-tolerance, tolerance].map(|off| (at(i, 2000, span), off)))
                        .map(|(psi, off)| section.direct_share(open + off, psi))
                        .fold(0.0, f64::max);
                    assert!(most > 0.0, "{section:?} {span:?} ± {tolerance}: {tilt} could be more open");
                }
            }
        }
    }
}

#[test]
fn arcs_found_by_search_are_those_of_the_closed_form() {
    let arc = SlatRow::new(SlatProfile::Arc { width: 0.08, rise: 0.01 }, 0.07).unwrap();
    let pieces = SlatRow::new(SlatProfile::Polyline(arc.profile.polyline(300)), 0.07).unwrap();
    for psi in (0..=70).step_by(10).map(|k| f64::from(k).to_radians()) {
        let span = [psi, psi + 0.01];
        let [a, b] = [&arc, &pieces].map(|section| section.cut_off([-1.4, 1.4], 0.0, span).unwrap());
        assert!((a - b).abs() < 1e-4, "{psi}: {a} {b}");
    }
}

#[test]
fn either_sense_of_rotation_is_used_where_the_device_turns_that_way() {
    let section = flat(0.080, 0.072);
    let psi = 30_f64.to_radians();
    let down = section.cut_off([0.0, 1.5], 0.0, [psi, psi]).unwrap();
    let up = section.cut_off([-1.5, 0.0], 0.0, [psi, psi]).unwrap();
    // β + ψ = ± asin(s/w cosψ).
    let alpha = (0.9 * psi.cos()).asin();
    assert!((down - (alpha - psi)).abs() < 1e-12 && (up - (-alpha - psi)).abs() < 1e-12, "{down} {up}");
    // Light from below, as to a rooflight's: the other sense is the more open one.
    let below = section.cut_off([-1.5, 1.5], 0.0, [-psi, -psi]).unwrap();
    assert!((below + down).abs() < 1e-12, "{below}");
    // A device that cannot turn far enough has no answer.
    assert_eq!(section.cut_off([0.0, 0.2], 0.0, [psi, psi]), None);
}

#[test]
fn sections_that_are_none_are_refused() {
    let arc = |rise| SlatProfile::Arc { width: 0.08, rise };
    for (profile, spacing) in [
        (SlatProfile::Flat { width: 0.0 }, 0.07),
        (SlatProfile::Flat { width: f64::NAN }, 0.07),
        (SlatProfile::Flat { width: 0.08 }, -0.07),
        (arc(0.05), 0.07),
        (arc(0.0), 0.07),
        (SlatProfile::Polyline(vec![[0.0, 0.0]]), 0.07),
        (SlatProfile::Polyline(vec![[0.0, 0.0]; 3]), 0.07),
    ] {
        assert_eq!(SlatRow::new(profile, spacing), None);
    }
}

#[test]
fn thick_slats_shade_by_their_thickness_too() {
    let face = Surface::matt(0.5);
    let (width, spacing, thickness) = (0.2, 0.18, 0.028);
    let blind = Venetian {
        profile: SlatProfile::Flat { width },
        spacing,
        thickness,
        angles: vec![0.0],
        upper: face,
        lower: face,
    };
    let section = SlatRow::of(&blind).unwrap();
    for k in 1..17 {
        let psi = f64::to_radians(5.0 * f64::from(k));
        let tilt = section.cut_off([-FRAC_PI_2, FRAC_PI_2], 0.0, [psi, psi]).unwrap();
        // The shadow of a rectangle: w sinα + t cosα = s cosψ at the limit.
        let extent = |tilt: f64| width * (tilt + psi).sin().abs() + thickness * (tilt + psi).cos().abs();
        let needed = spacing * psi.cos();
        assert!(extent(tilt) >= needed - 1e-9, "{psi}: {tilt}");
        assert!(tilt == 0.0 || (extent(tilt) - needed).abs() < 1e-6, "{psi}: {tilt}");
        assert!(tilt.abs() <= flat(width, spacing).cut_off([-FRAC_PI_2, FRAC_PI_2], 0.0, [psi, psi]).unwrap().abs());
    }
    // Light of 38° is blocked by horizontal slats of this thickness, not by sheets.
    let psi = f64::to_radians(38.0);
    assert!(section.blocks(0.0, 0.0, [psi, psi]) && !flat(width, spacing).blocks(0.0, 0.0, [psi, psi]));
}

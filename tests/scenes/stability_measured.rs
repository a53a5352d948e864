//! Stiff and extreme cases of data measured at single directions: suns at vertices, on edges, at the normal and below the
//! lowest row, dark indicatrices, single lobes, noise at grazing, one incidence alone; and extreme skies.

use crate::rooms::*;
use cfs::compute::basis::RingBasis;
use cfs::compute::btdf::{Btdf, Dataset, Indicatrices, Scattered};
use cfs::compute::direction::{Dir, Facade, Incident};
use cfs::study::RoomResult;
use std::f64::consts::PI;
use std::sync::Arc;

/// Tregenza's directions as a façade lattice has them.
fn lattice() -> Vec<Incident> {
    RingBasis::tregenza().cells().map(|cell| Incident(cell.centre())).collect()
}

/// A system from q of an incident and an emergent direction (through-name), at the middles of about 1600 cells.
fn measured(incident: Vec<Incident>, q: impl Fn(Dir<Facade>, Dir<Facade>) -> f64) -> Dataset {
    let emergent = RingBasis::equal_area(20);
    let values = incident.iter().flat_map(|i| emergent.cells().map(|o| q(i.0, o.centre())).collect::<Vec<f64>>());
    let values = values.collect();
    of(Indicatrices::new(incident, emergent, values).unwrap())
}

fn of(data: Indicatrices) -> Dataset {
    let mut dataset = Dataset { name: "measured".into(), ..Dataset::default() };
    dataset.visible.transmission_front =
        Some(Btdf { regular: None, scattered: Some(Scattered::Directions(Arc::new(data))) });
    dataset
}

/// A lobe straight on, each with the same flux on the cells.
fn straight(sigma_degrees: f64) -> Dataset {
    let emergent = RingBasis::equal_area(20);
    let weight = emergent.projected_solid_angles();
    let sigma = sigma_degrees.to_radians();
    let mut values = Vec::new();
    for i in lattice() {
        let lobe = |o: Dir<Facade>| ((o.dot(i.0) - 1.0) / (sigma * sigma)).exp();
        let row: Vec<f64> = emergent.cells().map(|cell| lobe(cell.centre())).collect();
        let flux: f64 = row.iter().zip(&weight).map(|(q, w)| q * w).sum();
        values.extend(row.iter().map(|q| 0.8 * q / flux));
    }
    of(Indicatrices::new(lattice(), emergent, values).unwrap())
}

/// All light of a direction in the one cell that holds it.
fn needle() -> Dataset {
    let emergent = RingBasis::equal_area(20);
    let weight = emergent.projected_solid_angles();
    let mut values = vec![0.0; 145 * emergent.len()];
    for (row, i) in lattice().into_iter().enumerate() {
        let cell = emergent.index(i.0).unwrap();
        values[row * emergent.len() + cell] = 0.8 / weight[cell];
    }
    of(Indicatrices::new(lattice(), emergent, values).unwrap())
}

/// Finite, never negative, errors stated, flux closed; returns the result.
fn sane(what: &str, text: &Text, system: &Dataset) -> RoomResult {
    let result = compute(&text.scene_with(system.clone()));
    for row in &result.sensors {
        for e in [row.direct, row.interreflected, row.total()] {
            assert!(e.value.is_finite() && e.value >= 0.0, "{what}: {e:?} at {}", row.sensor.position);
            assert!(e.error.is_finite() && e.error >= 0.0, "{what}: {e:?} at {}", row.sensor.position);
        }
    }
    assert!(result.flux.value.is_finite() && result.flux.value >= 0.0, "{what}: {:?}", result.flux);
    // Before it is closed: in a corridor 1000 times as long as wide the first bounce is sampled coarsely.
    let most = if what.contains("1000.0, 1.0]") { 0.5 } else { 0.1 };
    assert!(result.flux_gap.is_finite() && result.flux_gap < most, "{what}: gap of flux {}", result.flux_gap);
    result
}

const GREY: [f64; 3] = [0.2, 0.5, 0.7];

fn window() -> Vec<String> {
    vec![facade([0.5, 1.0], [3.0, 1.5], MADE)]
}

#[test]
fn the_sun_at_vertices_on_edges_at_the_normal_and_below_the_lowest_row() {
    // Straight before the façade altitude is θ: rows at 12°, 24°, … are vertices, 18° lies on an edge; azimuths near 90°
    // from the normal are beyond the row at θ = 84°.
    let suns = [
        (12.0, 180.0),
        (24.0, 180.0),
        (18.0, 180.0),
        (0.3, 180.0),
        (1e-9, 180.0),
        (84.0, 180.0),
        (87.0, 180.0),
        (89.9, 180.0),
        (30.0, 96.0),
        (30.0, 91.0),
        (30.0, 90.0),
        (0.5, 269.0),
    ];
    for (name, system, tau) in [("lobe", straight(4.0), 0.8), ("needle", needle(), 0.8)] {
        for (altitude, azimuth) in suns {
            let what = format!("{name}, sun at {altitude}°, {azimuth}°");
            let text = Text { apertures: window(), sky: sun_alone(altitude, azimuth), ..Text::default() };
            let result = sane(&what, &text, &system);
            // τ is the same at all directions: so is the flux between and beyond them, as far as the disc is seen.
            let open = text.clone();
            let open = Text { apertures: vec![facade([0.5, 1.0], [3.0, 1.5], TRANSPARENT)], ..open }.result();
            let want = tau * open.flux.value;
            assert!(
                (result.flux.value - want).abs() <= 1e-6 * want + result.flux.error,
                "{what}: {:?} {want}",
                result.flux
            );
        }
    }
}

#[test]
fn the_sun_moves_past_vertices_and_edges_without_a_jump() {
    let system = straight(6.0);
    for azimuth in [180.0, 100.0] {
        let mut last: Option<Vec<f64>> = None;
        for step in 0..60 {
            let altitude = 10.0 + 0.05 * f64::from(step);
            let text = Text { apertures: window(), sky: sun_alone(altitude, azimuth), ..Text::default() };
            let values = totals(&sane("moving", &text, &system));
            if let Some(last) = last {
                let most = values.iter().copied().fold(0.0, f64::max);
                for (a, b) in last.iter().zip(&values) {
                    assert!((a - b).abs() < 0.05 * most, "{altitude}°, {azimuth}°: {a} {b} of {most}");
                }
            }
            last = Some(values);
        }
    }
}

#[test]
fn dark_indicatrices_give_no_light_and_no_nan() {
    let shut = measured(lattice(), |_, _| 0.0);
    // Open for light from below alone, as slats that are shut upwards.
    let half = measured(lattice(), |i, _| if i.vector().y > 0.0 { 0.0 } else { 0.5 / PI });
    for sky in [clear(35.0, 190.0, 60_000.0), sun_alone(24.0, 180.0)] {
        let text = Text { apertures: window(), reflectance: GREY, sky, ..Text::default() };
        let result = sane("shut", &text, &shut);
        assert_eq!(result.flux.value, 0.0);
        assert!(totals(&result).iter().all(|e| *e == 0.0));
        sane("half shut", &text, &half);
    }
}

#[test]
fn an_even_diffuser_is_its_closed_form_however_it_was_measured() {
    let one = |theta: f64, phi: f64| Incident(Dir::from_theta_phi(theta, phi));
    let lists = [
        ("lattice", lattice()),
        ("the normal alone", vec![one(0.0, 0.0)]),
        ("one oblique", vec![one(1.0, 2.0)]),
        ("two", vec![one(0.3, 0.0), one(0.9, 1.0)]),
        ("on a line", vec![one(0.8, 0.0), one(0.4, 0.0), one(0.0, 0.0), one(0.4, PI), one(0.8, PI)]),
    ];
    for sky in [clear(35.0, 190.0, 60_000.0), sun_alone(3.0, 100.0), OVERCAST.to_owned()] {
        let text = Text { sky, ground: 0.2, ..Text::default() };
        let ideal = Text { apertures: vec![facade([0.5, 1.0], [3.0, 1.5], DIFFUSE)], ..text.clone() }.result();
        for (what, list) in &lists {
            let text = Text { apertures: window(), ..text.clone() };
            let result = sane(what, &text, &measured(list.clone(), |_, _| 0.5 / PI));
            for (a, b) in result.sensors.iter().zip(&ideal.sensors) {
                let (e, want) = (a.direct, 0.5 * b.direct.value);
                // A single direction says nothing of grazing light: what it makes of it is stated.
                assert!((e.value - want).abs() <= e.error + 1e-6 * want, "{what}: {e:?}, closed form {want}");
            }
        }
    }
}

#[test]
fn noise_at_grazing_stays_where_it_is() {
    // Signal over cosine: q explodes towards the rim, at both ends; finite, and no more flux than the data hold.
    let noisy = measured(lattice(), |i, o| {
        let wave = (37.0 * o.vector().x + 91.0 * o.vector().y + 13.0 * i.vector().y).sin();
        0.1 * (1.0 + 0.9 * wave) * (1.0 + 0.02 / o.vector().z / i.vector().z)
    });
    let most = match &noisy.visible.transmission_front.as_ref().unwrap().scattered {
        Some(Scattered::Directions(data)) => data.tau_by_direction().iter().copied().fold(0.0, f64::max),
        _ => unreachable!(),
    };
    for sky in [clear(35.0, 190.0, 60_000.0), sun_alone(20.0, 95.0), UNIFORM.to_owned()] {
        let text = Text { apertures: window(), sky, ..Text::default() };
        let result = sane("noise", &text, &noisy);
        let open = Text { apertures: vec![facade([0.5, 1.0], [3.0, 1.5], TRANSPARENT)], ..text }.result();
        assert!(result.flux.value <= 1.5 * most * open.flux.value, "{:?}, open {:?}", result.flux, open.flux);
    }
}

#[test]
fn narrow_lobes_through_extreme_rooms() {
    let system = needle();
    let sky = clear(35.0, 190.0, 60_000.0);
    for (room, origin, size, z) in [
        ([0.1, 0.15, 0.075], [0.0125, 0.025], [0.075, 0.0375], 0.02),
        ([10_000.0, 15_000.0, 7_500.0], [1250.0, 2500.0], [7500.0, 3750.0], 2000.0),
        ([4.0, 6.0, 3.0], [0.0, 0.0], [4.0, 3.0], 0.85),
        ([4.0, 6.0, 3.0], [2.0, 1.5], [1e-3, 1e-3], 0.85),
        ([1.0, 1000.0, 1.0], [0.1, 0.2], [0.8, 0.6], 0.4),
    ] {
        let sensors = format!("plane = {{ z = {z:?}, nx = 3, ny = 4 }}");
        let apertures = vec![facade(origin, size, MADE)];
        let text = Text { room, reflectance: [0.95; 3], apertures, sky: sky.clone(), sensors, ..Text::default() };
        sane(&format!("{room:?}"), &text, &system);
    }
}

#[test]
fn skylines_clear_the_light_below_them_from_measured_data_too() {
    let system = straight(4.0);
    let mut last = f64::INFINITY;
    for altitude in [0.001, 20.0, 45.0, 89.9] {
        let sky = format!("{OVERCAST}\nobstruction = {{ altitude = {altitude:?}, luminance = 0.0 }}");
        let text = Text { apertures: window(), sky, ..Text::default() };
        let flux = sane("skyline", &text, &system).flux.value;
        assert!(flux < last, "{altitude}°: {flux} after {last}");
        last = flux;
    }
}

#[test]
fn perez_skies_at_the_borders_of_their_bins() {
    // ε on both sides of every border: finite, and no more than a bin's own step between neighbours.
    use cfs::compute::sky::perez::PerezState;
    for border in [1.0, 1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2, 12.0] {
        for nudge in [-1e-9, 0.0, 1e-9] {
            let zenith = 60_f64.to_radians();
            let cubed = 1.041 * zenith.powi(3);
            let diffuse = 100.0;
            let direct = (diffuse * ((border + nudge) * (1.0 + cubed) - cubed - 1.0)).max(0.0);
            let state = PerezState::new(0.5 * PI - zenith, direct, diffuse, 1.0).unwrap();
            assert!((state.clearness - border).abs() < 1e-6, "{border}: {}", state.clearness);
            assert!(state.coefficients.iter().all(|c| c.is_finite()));
            assert!(state.diffuse_efficacy() > 0.0 && state.direct_efficacy() >= 0.0);
        }
    }
    // Night and a black sky have no state.
    assert!(PerezState::new(-0.1, 0.0, 10.0, 1.0).is_none() && PerezState::new(0.5, 0.0, 0.0, 1.0).is_none());
}

#[test]
fn a_date_beside_the_suns_angles_gives_the_earth_s_distance() {
    use cfs::compute::sky::perez::eccentricity;
    // Perihelion in January, aphelion in July: (1 ± 0.0167)².
    assert!(
        (eccentricity(3) - 1.0167_f64.powi(2)).abs() < 2e-3 && (eccentricity(185) - 0.9833_f64.powi(2)).abs() < 2e-3
    );
    let outside = |time: &str, sun: &str, factor: f64| {
        let sky = format!(
            "model = \"perez\"\ndirect_horizontal_irradiance = {:?}\ndiffuse_horizontal_irradiance = {:?}\n{time}{sun}",
            300.0 * factor,
            120.0 * factor
        );
        let file = cfs::study::SceneFile::parse(&Text { apertures: window(), sky, ..Text::default() }.toml()).unwrap();
        cfs::study::sky::outside_from_keys(&file.sky, &file.site, std::path::Path::new(".")).unwrap()
    };
    let angles = "sun = { altitude = 40.0, azimuth = 200.0 }\n";
    let (plain, sun) = outside("", angles, 1.0);
    let (winter, same_sun) = outside("time = \"2026-01-03T12:00\"\n", angles, 1.0);
    // The angles say where the sun is, the date how near: Δ is that of less diffuse light at the mean distance.
    let zenith = |outside: &cfs::compute::sky::Outside| {
        let up = cfs::compute::direction::Dir::from_unit(glam::DVec3::Z);
        outside.luminance(up) / outside.diffuse_horizontal()
    };
    assert_eq!(sun.unwrap().direction, same_sun.unwrap().direction);
    let (nearer, _) = outside("", angles, 1.0 / eccentricity(3));
    assert!((zenith(&winter) / zenith(&nearer) - 1.0).abs() < 1e-9, "{} {}", zenith(&winter), zenith(&nearer));
    assert!((zenith(&winter) / zenith(&plain) - 1.0).abs() > 1e-5);
}

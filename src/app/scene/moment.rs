//! Date and time of the scene: re-export of the study's module.

pub use crate::study::moment::*;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::scene::first_scene;
    use std::path::Path;

    #[test]
    fn steps_cross_midnight_and_months() {
        let mut scene = first_scene();
        assert!(step(&mut scene, 11, 12 * 60));
        assert_eq!(words(of(&scene).unwrap()), "2 Apr 00:00");
        scene.sky.time = None;
        assert!(!step(&mut scene, 1, 0));
    }

    #[test]
    fn the_equinox_noon_in_stuttgart_is_where_the_almanac_has_it() {
        // Altitude at noon of the equinox is 90° − latitude, within the declination's change over a day (0.4°).
        let (altitude, bearing) = sun(&first_scene(), Path::new("")).unwrap();
        assert!((altitude.to_degrees() - (90.0 - 48.78)).abs() < 0.8, "{}", altitude.to_degrees());
        assert!((bearing - 180.0).abs() < 12.0, "{bearing}");
        let hours = sun_hours(&first_scene(), Path::new("")).unwrap();
        assert!((hours.set.unwrap() - hours.rise.unwrap() - 12.15).abs() < 0.15);
    }

    #[test]
    fn an_hour_of_a_weather_has_the_sun_that_its_light_comes_from() {
        use crate::study::scene_file::{DstKey, SceneFile, SkyModelKey};
        let mut scene = first_scene();
        scene.sky.weather = Some("builtin:new-york".into());
        scene.sky.model = SkyModelKey::Weather;
        scene.sky.illuminance = Default::default();
        (scene.sky.cie_type, scene.sky.diffuse_horizontal, scene.sky.sun) = (None, None, Default::default());
        let at = |scene: &mut SceneFile, hour: i8| {
            set(scene, jiff::civil::date(2026, 7, 1).at(hour, 30, 0, 0));
            let light = crate::study::sky::hour_of_weather(&scene.sky, &scene.site, Path::new("")).unwrap().unwrap();
            let (altitude, bearing) = sun(scene, Path::new("")).unwrap();
            assert_eq!((altitude, bearing), (light.hour.sun.altitude(), light.hour.sun.bearing().degrees()));
            (light.interval, altitude)
        };
        scene.site.dst = DstKey::None;
        let standard = at(&mut scene, 12);
        assert!(standard.0.ends_with("12:00–13:00"), "{standard:?}");
        // Stuttgart's sun is another: the place of the weather counts.
        let here = sun(&first_scene(), Path::new("")).unwrap().0;
        assert!((standard.1 - here).abs() > 0.1, "{standard:?} {here}");
        // What the clock on the wall says in summer.
        scene.site.dst = DstKey::Us;
        assert_eq!(at(&mut scene, 13), standard);
        assert_ne!(at(&mut scene, 12), standard);
    }

    #[test]
    fn dragging_the_sun_finds_its_moment_again() {
        let mut scene = first_scene();
        step(&mut scene, 20, 150);
        let (altitude, bearing) = sun(&scene, Path::new("")).unwrap();
        let mut other = first_scene();
        assert!(towards(&mut other, altitude, bearing.to_radians(), true));
        let found = sun(&other, Path::new("")).unwrap();
        assert!((found.0 - altitude).abs() < 0.02 && (found.1 - bearing).abs() < 1.5, "{found:?} {altitude} {bearing}");
    }

    #[test]
    fn dragging_the_sun_stays_in_its_day() {
        let start = of(&first_scene()).unwrap();
        // Where the sun stands in August, in the south-east and low in the west, and where it never is.
        for (altitude, bearing) in [(50.0_f64, 150.0_f64), (30.0, 120.0), (5.0, 262.0), (80.0, 10.0), (0.0, 0.0)] {
            let mut scene = first_scene();
            assert!(towards(&mut scene, altitude.to_radians(), bearing.to_radians(), false));
            let now = of(&scene).unwrap();
            assert_eq!(now.date(), start.date(), "{altitude} {bearing}");
            let (height, _) = sun(&scene, Path::new("")).unwrap();
            assert!(height > 0.0, "{altitude} {bearing}: {now}");
        }
        // On the day's path it finds its moment.
        let mut scene = first_scene();
        assert!(set_clock(&mut scene, 15, 20));
        let (altitude, bearing) = sun(&scene, Path::new("")).unwrap();
        let mut other = first_scene();
        assert!(towards(&mut other, altitude, bearing.to_radians(), false));
        assert_eq!(of(&other), of(&scene));
    }

    #[test]
    fn date_and_clock_are_set_apart() {
        let mut scene = first_scene();
        assert!(set_date(&mut scene, jiff::civil::date(2026, 12, 1)) && set_clock(&mut scene, 9, 37));
        assert_eq!(words(of(&scene).unwrap()), "1 Dec 09:37");
        assert!(!set_clock(&mut scene, 24, 0));
        assert_eq!(words(of(&scene).unwrap()), "1 Dec 09:37");
    }

    #[test]
    fn the_sun_is_before_the_facade_or_behind_it() {
        assert!(before_facade((0.5, 180.0), 180.0) && before_facade((0.5, 100.0), 180.0));
        assert!(!before_facade((0.5, 80.0), 180.0) && !before_facade((-0.1, 180.0), 180.0));
        assert!(before_facade((0.5, 350.0), 20.0));
        assert_eq!(height_words(-14.6, 0), "15° below the horizon");
        assert_eq!(height_words(0.2, 0), "on the horizon");
    }

    #[test]
    fn bearings_read_as_words() {
        assert_eq!(bearing_word(180.0), "south");
        assert_eq!(bearing_word(-44.0), "north-west");
        assert_eq!(bearing_word(359.0), "north");
        assert_eq!(clock(6.508), "06:30");
    }

    #[test]
    fn heights_read_as_words() {
        assert_eq!(height_words(41.24, 1), "at 41.2°");
        assert_eq!(height_words(-15.2, 0), "15° below the horizon");
        assert_eq!(height_words(-0.02, 1), "on the horizon");
    }
}

//! Incident direction that the tiles have in common: re-export of the study's module.

pub use crate::study::incidence::*;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::scene::first_scene;
    use crate::app::scene::moment;
    use crate::compute::direction::{Dir, Incident};
    use std::path::Path;

    #[test]
    fn a_choice_goes_before_the_sun_and_without_both_light_is_perpendicular() {
        let mut scene = first_scene();
        let chosen = Incident(Dir::from_theta_phi(0.5, 1.0));
        assert_eq!(Incidence::shown(Some(chosen), &scene, Path::new("")).source, Source::Chosen);
        let sun = Incidence::shown(None, &scene, Path::new(""));
        assert_eq!(sun.source, Source::Sun);
        // Noon of the equinox before a south façade: the profile angle is about the altitude, 41°.
        assert!(sun.texts()[0].contains("profile angle 4"), "{:?}", sun.texts());
        moment::step(&mut scene, 0, 11 * 60);
        let night = Incidence::shown(None, &scene, Path::new(""));
        assert_eq!(night.source, Source::Normal);
        assert!(night.texts()[0].contains("θ 0°") && night.texts()[0].contains("sun not in front of the façade"));
        let turned = Dir::from_theta_phi(0.5, std::f64::consts::TAU - 0.002);
        assert_eq!(direction_text(turned), "θ 29°, φ 0°");
        assert!(sun.texts().iter().all(|text| text.contains(&direction_text(sun.direction.0))));
    }
}

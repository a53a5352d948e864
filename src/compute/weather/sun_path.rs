//! Position of the sun at any minute of a day: the Solar Position Algorithm at midnights, smooth between them.
//!
//! Seen from the centre of the earth, the sun's declination and the difference of its hour angle from that of the mean
//! sun (the equation of time) change slowly and smoothly, so that a cubic through four midnights is as good as the
//! algorithm itself (1e-7°) at a hundredth of its cost; the earth's rotation and the parallax at the location are
//! exact. A year of hours with its sunrises costs some milliseconds.

use crate::compute::weather::record::Station;
use glam::DVec3;
use solar_positioning::time::JulianDate;
use solar_positioning::{Location, SolarPositions, delta_t};
use std::f64::consts::{PI, TAU};

/// Error for a day outside the range of years of the Solar Position Algorithm.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("no position of the sun: {0}")]
pub struct SunPathError(String);

/// Position of the sun at one moment, seen from the centre of the earth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Node {
    /// Equation of time as an angle: hour angle of the sun minus that of the mean sun. \[rad\]
    equation: f64,
    /// Declination. \[rad\]
    declination: f64,
    /// Sine of the sun's horizontal parallax: radius of the earth over the distance of the sun.
    parallax: f64,
}

/// Positions of the sun at one location, day by day: [`Self::turn_to`] selects the day, [`Self::at`] returns the sun's
/// direction at its minutes.
#[derive(Debug, Clone)]
pub struct SunPath {
    sin_latitude: f64,
    cos_latitude: f64,
    longitude: f64,
    /// UTC offset of the location's clock, positive ahead of UTC. \[d\]
    ahead: f64,
    /// Position of the location relative to the centre of the earth, in units of the earth's equatorial radius:
    /// distance from the axis; `axial` is the component along the axis towards the north pole.
    radial: f64,
    axial: f64,
    day: Option<i64>,
    /// Positions at four local midnights, between which is interpolated: one day before the selected day's begin, at
    /// its begin, at its end, and one day after its end.
    nodes: [Node; 4],
}

/// Ratio of the earth's axes: 1 − 1/298.257, as in the Solar Position Algorithm (Reda & Andreas, NREL).
const FLATTENING: f64 = 0.996_647_19;

impl SunPath {
    /// Creates the sun path of a station's location, taken at sea level: the elevation changes directions by less than
    /// a thousandth of a second of arc.
    pub fn new(station: &Station) -> Self {
        let latitude = station.latitude.to_radians();
        let (sin_latitude, cos_latitude) = latitude.sin_cos();
        let (sin_u, cos_u) = (FLATTENING * sin_latitude).atan2(cos_latitude).sin_cos();
        Self {
            sin_latitude,
            cos_latitude,
            longitude: station.longitude.to_radians(),
            ahead: station.utc_offset / 24.0,
            radial: cos_u,
            axial: FLATTENING * sin_u,
            day: None,
            nodes: [Node::default(); 4],
        }
    }

    /// Selects the day (days since 1 January 1970) that the minutes of [`Self::at`] belong to.
    ///
    /// # Errors
    /// Returns an error if the day is out of the algorithm's range.
    pub fn turn_to(&mut self, day: i64) -> Result<(), SunPathError> {
        if self.day == Some(day) {
            return Ok(());
        }
        if self.day == Some(day - 1) {
            self.nodes.rotate_left(1);
            self.nodes[3] = self.node(day + 2)?;
        } else {
            self.day = None;
            for (k, offset) in (-1..3).enumerate() {
                self.nodes[k] = self.node(day + offset)?;
            }
        }
        self.day = Some(day);
        Ok(())
    }

    /// Computes the position of the sun seen from the centre of the earth at the local midnight with which a day begins
    /// (days since 1 January 1970).
    fn node(&self, day: i64) -> Result<Node, SunPathError> {
        let wrong = |error: solar_positioning::Error| SunPathError(error.to_string());
        let universal = day as f64 - self.ahead;
        let julian = 2_440_587.5 + universal;
        let seconds = delta_t::estimate(1970.0 + day as f64 / 365.2425).map_err(wrong)?;
        let time = JulianDate::new(julian, seconds).map_err(wrong)?;
        let prepared = SolarPositions::new().for_time_from_julian(time).map_err(wrong)?;
        // An observer on the equator at Greenwich: without parallax, up, east and north are the earth's own axes.
        let seen = prepared.at(Location { latitude: 0.0, longitude: 0.0 }, 0.0, None).map_err(wrong)?;
        let (sin_height, cos_height) = seen.elevation_angle().to_radians().sin_cos();
        let (sin_azimuth, cos_azimuth) = seen.azimuth().to_radians().sin_cos();
        let parallax = (8.794_f64 / 3600.0).to_radians().sin() / prepared.earth_radius_vector().unwrap_or(1.0);
        let length = (1.0 - (parallax * cos_height).powi(2)).sqrt() - parallax * sin_height;
        let up = length * sin_height + parallax;
        let (east, north) = (length * cos_height * sin_azimuth, length * cos_height * cos_azimuth);
        let hour_angle = (-east).atan2(up);
        let mean = TAU * (universal.rem_euclid(1.0) - 0.5);
        let equation = (hour_angle - mean + PI).rem_euclid(TAU) - PI;
        Ok(Node { equation, declination: north.atan2(east.hypot(up)), parallax })
    }

    /// Returns the unit vector to the sun's centre (x east, y north, z up; true altitude, no refraction) `minutes`
    /// after the local midnight with which the selected day begins; valid up to some hours before and after the day.
    pub fn at(&self, minutes: f64) -> DVec3 {
        let t = minutes / 1440.0;
        // Lagrange's polynomials on −1, 0, 1, 2.
        let weights = [
            -t * (t - 1.0) * (t - 2.0) / 6.0,
            (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
            -(t + 1.0) * t * (t - 2.0) / 2.0,
            (t + 1.0) * t * (t - 1.0) / 6.0,
        ];
        let (mut equation, mut declination) = (0.0, 0.0);
        for (weight, node) in weights.iter().zip(&self.nodes) {
            equation += weight * node.equation;
            declination += weight * node.declination;
        }
        let parallax = self.nodes[1].parallax;
        // Midnights are whole days of local time: only the offset from UT is left of the date.
        let hour_angle = equation + TAU * (t - self.ahead - 0.5) + self.longitude;
        let (sin_declination, cos_declination) = declination.sin_cos();
        let (sin_hour, cos_hour) = hour_angle.sin_cos();
        let radial = cos_declination * cos_hour - parallax * self.radial;
        let axial = sin_declination - parallax * self.axial;
        let north = axial * self.cos_latitude - radial * self.sin_latitude;
        let up = radial * self.cos_latitude + axial * self.sin_latitude;
        let way = DVec3::new(-cos_declination * sin_hour, north, up);
        // Of unit length but for the parallax, 4e-5.
        way / way.length()
    }
}

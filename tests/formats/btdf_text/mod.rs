//! Files made for tests of the text format, and tests of what one reader step does each.

mod damaged;
mod filled;

use cfs::compute::btdf::{Btdf, Component, Dataset};
use cfs::compute::direction::{Dir, Facade, Incident};
use cfs::formats::btdf_text::read;
use glam::DVec3;
use std::fmt::Write as _;

/// Unit vector of angles as the files count them, in degrees.
pub fn vector(theta: f64, phi: f64) -> DVec3 {
    let (theta, phi) = (theta.to_radians(), phi.to_radians());
    DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
}

/// Tregenza's 145 directions as the format lists them.
pub fn tregenza() -> Vec<[f64; 2]> {
    let rows = [30, 30, 24, 24, 18, 12, 6];
    let mut list = Vec::new();
    for (row, count) in rows.into_iter().enumerate() {
        list.extend((0..count).map(|k| [84.0 - 12.0 * row as f64, 360.0 * f64::from(k) / f64::from(count)]));
    }
    list.push([0.0, 0.0]);
    list
}

/// What a file is to hold.
#[derive(Clone)]
pub struct File {
    pub component: Component,
    pub rings: Vec<[f64; 3]>,
    pub incidence: &'static str,
    pub mean: bool,
    pub directions: Vec<[f64; 2]>,
    pub more: String,
}

impl File {
    pub fn new(component: Component) -> Self {
        let inward = matches!(component, Component::TransmissionFront | Component::ReflectionBack);
        let mut rings = vec![[0.0, 10.0, 1.0], [10.0, 30.0, 8.0], [30.0, 60.0, 16.0], [60.0, 90.0, 20.0]];
        if inward {
            rings = rings.into_iter().rev().map(|[a, b, n]| [180.0 - b, 180.0 - a, n]).collect();
        }
        let inside = matches!(component, Component::TransmissionBack | Component::ReflectionBack);
        let directions = tregenza().into_iter().map(|[t, p]| [if inside { 180.0 - t } else { t }, p]).collect();
        Self { component, rings, incidence: "tregenza-145", mean: false, directions, more: String::new() }
    }

    pub fn header(&self, layout: &str) -> String {
        let (quantity, side) = match self.component {
            Component::TransmissionFront => ("btdf", "outside"),
            Component::TransmissionBack => ("btdf", "inside"),
            Component::ReflectionFront => ("brdf", "outside"),
            Component::ReflectionBack => ("brdf", "inside"),
        };
        let rings = if layout == "rings" {
            let list: Vec<String> = self.rings.iter().map(|[a, b, n]| format!("[{a:?}, {b:?}, {n}]")).collect();
            format!("rings = [{}]\n", list.join(", "))
        } else {
            String::new()
        };
        format!(
            "# made by a test\n---\nformat = \"cfs-btdf 1\"\nname = \"Made\"\nquantity = \"{quantity}\"\nlight_from = \"{side}\"\n\
             layout = \"{layout}\"\n{rings}incidence = \"{}\"\nincident_mean = {}\n{}---\n",
            self.incidence, self.mean, self.more
        )
    }

    /// Centres of the cells in the file's angles, in its order.
    pub fn cells(&self) -> Vec<[f64; 2]> {
        let mut list = Vec::new();
        for [a, b, n] in &self.rings {
            let cap = (*a == 0.0 || *b == 180.0) && *n == 1.0;
            let theta = if cap { if *a == 0.0 { 0.0 } else { 180.0 } } else { 0.5 * (a + b) };
            list.extend((0..*n as usize).map(|k| [theta, 360.0 * k as f64 / n]));
        }
        list
    }

    /// Layout `rings`: `q` of the incident and the emergent direction, both as vectors.
    pub fn text(&self, q: impl Fn(DVec3, DVec3) -> f64) -> String {
        let mut text = self.header("rings");
        let cells = self.cells();
        for [t, p] in &self.directions {
            let _ = write!(text, "{t} {p}");
            for [a, b] in &cells {
                let _ = write!(text, " {}", q(vector(*t, *p), vector(*a, *b)));
            }
            text.push_str("   # a record\n");
        }
        text
    }

    /// Layout `points` with the given emergent directions.
    pub fn points(&self, emergent: &[[f64; 2]], q: impl Fn(DVec3, DVec3) -> f64) -> String {
        let mut text = self.header("points");
        for [t, p] in &self.directions {
            for [a, b] in emergent {
                let _ = writeln!(text, "{t} {p} {a} {b} {}", q(vector(*t, *p), vector(*a, *b)));
            }
        }
        text
    }

    pub fn read(&self, q: impl Fn(DVec3, DVec3) -> f64) -> Dataset {
        read(self.text(q).as_bytes()).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// Without any symmetry.
pub fn uneven(e: DVec3, a: DVec3) -> f64 {
    0.05 * (0.7 * e.x - 0.3 * e.y + 0.6 * a.x + 0.8 * a.y + 0.5 * e.x * a.y).exp()
}

pub fn function(dataset: &Dataset, component: Component) -> &Btdf {
    dataset.visible.get(component).expect("the function that the header names")
}

pub fn codes(dataset: &Dataset) -> Vec<&str> {
    dataset.findings.iter().map(|finding| finding.code).collect()
}

/// Name of an incident or emergent direction, straight from the definitions of `compute::direction`.
pub fn names(component: Component, e: DVec3, a: DVec3) -> (Incident, Dir<Facade>) {
    let (incident, emergent) = match component {
        Component::TransmissionFront => (e, -a),
        Component::TransmissionBack => (-e, a),
        Component::ReflectionFront => (e, DVec3::new(-a.x, -a.y, a.z)),
        // The travelling light −e, mirrored in the plane, keeps its name.
        Component::ReflectionBack => (-e, DVec3::new(a.x, a.y, -a.z)),
    };
    (Incident(Dir::from_unit(incident)), Dir::from_unit(emergent))
}

//! Computation: photometry and numerics without files, windows or clocks.
//!
//! # Examples
//!
//! ## Sky
//!
//! A traditional overcast sky of the horizontal illuminance E has the zenith luminance 9E/(7π) and gives a vertical
//! plane (3/14 + 4/(7π))·E, to which open ground of the reflectance ρ adds ρE/2.
//!
//! ```
//! use cfs_compute::direction::Dir;
//! use cfs_compute::sky::{Distribution, Outside, irradiance};
//! use glam::DVec3;
//! use std::f64::consts::PI;
//!
//! let (south, zenith) = (Dir::from_unit(DVec3::NEG_Y), Dir::from_unit(DVec3::Z));
//! let overcast = Distribution::cie(16, zenith).ok_or("no such sky type")?;
//! let outside = Outside::new(overcast, 10_000.0)?.with_ground(0.2, 0.0)?;
//! assert!((outside.luminance(zenith) - 10_000.0 * 9.0 / (7.0 * PI)).abs() < 1e-6);
//! let vertical = irradiance(&outside, south);
//! let expected = 10_000.0 * (3.0 / 14.0 + 4.0 / (7.0 * PI) + 0.5 * 0.2);
//! assert!((vertical.value - expected).abs() <= vertical.error);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## Dataset
//!
//! Patch-averaged data of an ideal diffuser hold q = τ/π for every pair of cells and transmit τ of uniform light: the
//! projected solid angles of a basis add up to π.
//!
//! ```
//! use cfs_compute::btdf::{Btdf, CellMatrix, Component, Dataset};
//! use cfs_compute::system::measure::front_basis;
//! use std::f64::consts::PI;
//!
//! let cells = front_basis();
//! let q = vec![0.5 / PI; cells.len() * cells.len()];
//! let matrix = CellMatrix::new(cells.clone(), cells, q).ok_or("not one value per pair of cells")?;
//! let mut dataset = Dataset { name: "Diffuser".to_owned(), ..Dataset::default() };
//! dataset.visible.set(Component::TransmissionFront, Btdf::from_cells(matrix));
//! let transmission = dataset.transmission().ok_or("no transmission")?;
//! assert!((transmission.tau_hemispherical() - 0.5).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## Optical model
//!
//! The virtual goniophotometer computes data of a described system: black horizontal slats as wide as their pitch
//! transmit √2 − 1 of uniform light, the view factor between the two open sides of the gap between two slats.
//!
//! ```
//! use cfs_compute::estimate::Silent;
//! use cfs_compute::system::SystemKind;
//! use cfs_compute::system::measure::{Setting, front_basis};
//! use cfs_compute::system::slats::{SlatProfile, Surface, Venetian};
//!
//! let (profile, black) = (SlatProfile::Flat { width: 0.08 }, Surface::matt(0.0));
//! let blind = Venetian { profile, spacing: 0.08, thickness: 0.0, angles: vec![0.0], upper: black, lower: black };
//! let model = SystemKind::Venetian(blind).family().optical_model("0")?;
//! let cells = front_basis();
//! let setting = Setting { incident: &cells, emergent: &cells, error: 0.01, seed: 1 };
//! let (band, quality) = model.examine(&setting, &Silent)?;
//! let tau = band.transmission_front.ok_or("no transmission")?.tau_hemispherical();
//! assert!((tau - (2_f64.sqrt() - 1.0)).abs() <= quality.error);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## Luminous intensity distribution
//!
//! An ideal diffuser of transmittance τ under the illuminance E has the luminance L = τE/π, and an aperture of area A
//! with it the LID I(θ) = L·A·cosθ; a uniform sky over black ground gives a façade half of the horizontal illuminance.
//!
//! ```
//! use cfs_compute::angle::Bearing;
//! use cfs_compute::btdf::Btdf;
//! use cfs_compute::direction::{Dir, Emergent, Orientation, Surface};
//! use cfs_compute::lid::{Emission, Facing};
//! use cfs_compute::sky::{Distribution, Outside};
//!
//! let outside = Outside::new(Distribution::uniform(), 10_000.0)?;
//! let orientation = Orientation::new(Bearing::from_degrees(180.0));
//! let facing = Facing { outside: &outside, sun: None, orientation, surface: Surface::Facade };
//! let lid = Emission::new(&Btdf::ideal_diffuse(0.5), &facing).lid(&facing, [1.2, 1.0]);
//! let intensity = lid.intensity(Emergent::from_undeviated(Dir::from_theta_phi(1.0, 0.0)));
//! let expected = 0.5 * 5_000.0 / std::f64::consts::PI * 1.2 * 1_f64.cos();
//! assert!((intensity / expected - 1.0).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## Room
//!
//! A sensor point that faces the middle of a square aperture of luminance L and side 2 m from the distance d receives
//! E = 4L·s·atan(s), s = 1 m/√(1 m² + d²).
//!
//! ```
//! use cfs_compute::direction::Surface;
//! use cfs_compute::room::aperture::Aperture;
//! use cfs_compute::room::direct::{Reception, Sensor};
//! use glam::DVec3;
//!
//! let luminance = 1000.0;
//! let aperture = Aperture { surface: Surface::Facade, corner: DVec3::new(1.0, 0.0, 1.0), size: [2.0, 2.0] };
//! for distance in [0.5, 1.0, 2.0, 4.0_f64] {
//!     let sensor = Sensor { position: DVec3::new(2.0, distance, 2.0), normal: DVec3::NEG_Y };
//!     let illuminance = luminance * Reception::new(&sensor, &aperture, None).uniform;
//!     let s = 1.0 / distance.hypot(1.0);
//!     assert!((illuminance / (4.0 * luminance * s * s.atan()) - 1.0).abs() < 1e-9);
//! }
//! ```
//!
//! ## State by control
//!
//! Cut-off control chooses the most open state that blocks direct sun of the profile angle ψ: for flat slats the first
//! one whose tilt reaches asin(pitch/width · cosψ) − ψ.
//!
//! ```
//! use cfs_compute::control::controller::cut_off_state;
//! use cfs_compute::control::cut_off::SlatRow;
//! use cfs_compute::system::slats::SlatProfile;
//!
//! let slats = SlatRow::new(SlatProfile::Flat { width: 0.08 }, 0.072).ok_or("not a row of slats")?;
//! let tilts: Vec<f64> = (0..=15).map(|k| f64::from(5 * k).to_radians()).collect();
//! let psi = 30_f64.to_radians();
//! let state = cut_off_state(&slats, &tilts, 0.0, [psi, psi]);
//! let cut_off = (0.072 / 0.08 * psi.cos()).asin() - psi;
//! assert!(tilts[state - 1] < cut_off && cut_off <= tilts[state]);
//! assert!(slats.direct_share(tilts[state], psi) == 0.0 && slats.direct_share(tilts[state - 1], psi) > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## Weather hour
//!
//! The sun of the hour about noon of the summer solstice has the altitude 90° − latitude + 23.44°, and direct sunlight
//! has about 100 lm/W.
//!
//! ```
//! use cfs_compute::weather::{Day, Quantity, Reading, Record, Station, Weather};
//!
//! let day = Day::new(2025, 6, 21).ok_or("no such day")?;
//! let noon = Record { day, start: 41_400, direct: Some(800.0), diffuse: Some(120.0), global: None, dew_point: None,
//!     direct_illuminance: None, diffuse_illuminance: None, line: 1 };
//! let station = Station { latitude: 51.48, ..Station::default() };
//! let weather = Weather { format: "", station, quantity: Quantity::NormalIrradiance, interval: 60, clock: 0.0,
//!     tested: None, first_weekday: None, records: vec![noon], findings: vec![], field_names: ["direct", "diffuse"] };
//! let hour = weather.hours(Reading::default())?.at(0)?;
//! assert!((hour.sun.altitude().to_degrees() - (90.0 - 51.48 + 23.44)).abs() < 0.02);
//! assert!((90.0..120.0).contains(&(hour.direct_normal / 800.0)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## Year
//!
//! A sensor point with 5 % of the diffuse horizontal illuminance, a half sine of 20 klx over the 12 occupied hours of
//! every day, receives at least 300 lx in 10 and at least 500 lx in 8 of them.
//!
//! ```
//! use cfs_compute::year::autonomy::Autonomy;
//! use cfs_compute::year::{Step, StepTable};
//! use std::f64::consts::PI;
//!
//! let diffuse = |k: usize| 20_000.0 * (PI * ((k % 24) as f64 - 5.5) / 12.0).sin().max(0.0);
//! let step = |k| Step { month: 1 + (k / 730) as u8, occupied: diffuse(k) > 0.0, diffuse_horizontal: diffuse(k) };
//! let steps: Vec<Step> = (0..8760).map(step).collect();
//! let illuminances: Vec<f64> = steps.iter().map(|step| 0.05 * step.diffuse_horizontal).collect();
//! let table = StepTable::of_rows(1, &illuminances).ok_or("not one value per step and sensor")?;
//! let light = table.columns(0..1).ok_or("no sensor")?;
//! let figures = Autonomy::of(&steps, light);
//! assert_eq!([figures.da_300[0], figures.da_500[0]], [10.0 / 12.0, 8.0 / 12.0]);
//! // The sum of the 12 sines of a day is 1/sin(π/24).
//! assert!((figures.mean[0] - 1000.0 / (24.0 * (PI / 24.0).sin())).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## Beam
//!
//! Horizontal mirror slats as wide as their pitch transmit 1 − tanψ of direct sun of the profile angle ψ < 45°
//! undeviated and redirect the rest upwards: the through direction of that beam is mirrored at the horizon.
//!
//! ```
//! use cfs_compute::direction::Dir;
//! use cfs_compute::system::measure::{OpticalModel, Side};
//! use cfs_compute::system::slats::{SlatArray, SlatModel, SlatProfile, Surface};
//! use std::f64::consts::FRAC_PI_2;
//!
//! let profile = SlatProfile::Flat { width: 0.08 };
//! let model = SlatModel::new(SlatArray::new(profile, 0.0, 0.08, 0.0, [Surface::mirror(1.0); 2])?);
//! let psi = 30_f64.to_radians();
//! let [sun, mirrored] = [FRAC_PI_2, -FRAC_PI_2].map(|phi| Dir::from_theta_phi(psi, phi));
//! let beams = model.beams(sun, Side::Front);
//! let share = |to| beams.iter().filter(|b| b.directions[0].dot(to) > 1.0 - 1e-9).map(|b| b.share).sum::<f64>();
//! assert!((share(sun) - (1.0 - psi.tan())).abs() < 1e-9 && (share(mirrored) - psi.tan()).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## Luminaire table
//!
//! A C-γ table has the flux of its LID within its error: an aperture of area A and luminance L₀cosθ emits (2/3)π·L₀·A.
//!
//! ```
//! use cfs_compute::direction::{Dir, Facade, Surface};
//! use cfs_compute::lid::c_gamma::{Aim, CGammaTable, Step};
//! use cfs_compute::lid::{EmergentLuminance, Lid};
//! use std::f64::consts::PI;
//! use std::sync::Arc;
//!
//! let luminance = |through: Dir<Facade>| 1000.0 * through.vector().z;
//! let parts = vec![EmergentLuminance::Function(Arc::new(luminance))];
//! let lid = Lid { surface: Surface::Facade, size: [1.2, 1.0], parts, beams: Vec::new() };
//! let table = CGammaTable::new(&lid, Aim::of(lid.surface), Step::NORMAL);
//! let flux = 2.0 / 3.0 * PI * 1000.0 * lid.area();
//! assert!((table.zonal_flux() - flux).abs() <= table.flux.error);
//! ```
//!
//! # Rooms, foundations first
//!
//! Each room uses only those before it, and inside a room no two files use each other; `tests/tidy` reads this list.
//!
//! - `limits`: the table of all limits
//! - `angle`: angles and bearings as types
//! - `direction`: directions and their frames
//! - `profile_angle`: directions in the section across slats
//! - `dot`: sums of products
//! - `estimate`: numbers with their error, progress and cancelling
//! - `quadrature`: integrals with errors
//! - `sweep`: several quantities integrated along one variable at once, with errors
//! - `sequence`: random and evenly spread numbers
//! - `scaling`: symmetric matrices scaled to given sums
//! - `polygon`: convex polygons cut, their areas and solid angles
//! - `basis`: divisions of the hemisphere into cells
//! - `wavelet`: compact rows of values on cells
//! - `btdf`: BSDF data of a system, its four functions
//! - `surroundings`: boxes and a skyline in front of the façade, their edges and shadows
//! - `sky`: luminances outside, the sun and its disc
//! - `weather`: the weather of a place, interval by interval, with sun and light
//! - `system`: described systems, one room per family, and the virtual goniophotometer that computes data of them
//! - `incidence`: interpolation between incident directions
//! - `doctor`: data checks and repairs
//! - `lid`: the aperture as a luminaire
//! - `room`: apertures, direct light and interreflection
//! - `glare`: glare of an observer by apertures and the sun
//! - `sunlight`: hours of sun on an aperture, the view out of it
//! - `control`: shading control, the choice of a system's state
//! - `year`: annual figures from the illuminances of a year
//! - `rank`: ranking by figures with errors
//!
//! # Symbols
//!
//! | symbol | identifier | unit | meaning |
//! | --- | --- | --- | --- |
//! | q | `q`, luminance coefficient | 1/sr | luminance leaving per illuminance arriving (eq 2) |
//! | τ | `tau` | – | directional-hemispherical transmittance (eq 1) |
//! | E | `illuminance` | lx | |
//! | L | `luminance` | cd/m² | |
//! | I | `intensity` | cd | eq 5 |
//! | Φ | `flux` | lm | |
//! | ω_e | [`direction::Incident`] | | towards the source |
//! | ω_a | [`direction::Emergent`] | | in which light leaves |
//! | PΩ | `projected_solid_angle` | sr | ∫cosθ dω of a cell |
//! | γ | `altitude` | rad | above the horizon |
//!
//! Equation numbers are those of the IEA SHC Task 31 report of 2005. Everything is SI; angles are radians inside.

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::disallowed_methods))]

// Layers have these names in all crates.
use crate as compute;

pub mod angle;
pub mod basis;
pub mod btdf;
pub mod control;
pub mod direction;
pub mod doctor;
pub mod dot;
pub mod estimate;
pub mod glare;
pub mod incidence;
pub mod lid;
pub mod limits;
pub mod polygon;
pub mod profile_angle;
pub mod quadrature;
pub mod rank;
pub mod room;
pub mod scaling;
pub mod sequence;
pub mod sky;
pub mod sunlight;
pub mod surroundings;
pub mod sweep;
pub mod system;
pub mod wavelet;
pub mod weather;
pub mod year;

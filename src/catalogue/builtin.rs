//! The products that come with the program: computed from closed forms on first start, renewed by newer programs.

use super::{Catalogue, CatalogueError, CurvePoint, NewProduct, Origin, Provenance, StateName, store};
use crate::compute::btdf::{Band, Btdf, Dataset, Finding};
use crate::compute::system::diffuser::{Opal, Spreading, lambertian};
use crate::compute::system::glazing::{self, Pane};
use crate::compute::system::laser_cut::LaserCutPanel;
use crate::compute::system::slats::{FlatSlats, cut_off_tilt};
use rayon::prelude::*;
use rusqlite::OptionalExtension;

/// Raised whenever the built-in products change; a file with a lower number gets the new ones.
pub const BUILTIN_VERSION: i64 = 2;

/// Refractive index of soda-lime glass.
const GLASS: f64 = 1.52;
/// Refractive index of acrylic (PMMA).
const ACRYLIC: f64 = 1.49;

const FRESNEL: &str = "Fresnel and Bouguer-Lambert, both polarisations through the whole stack, no interference";
const OPAL: &str = "Separable closed form q = t F(θe) F(θa)/(π F̄) with Fresnel's F of one surface";
const LOBE: &str =
    "Gaussian lobe in direction cosines plus separable haze, balanced to the clear sheet's τ(θ) (symmetric Sinkhorn)";
const EDMONDS: &str =
    "Closed form after Edmonds, Solar Energy Materials and Solar Cells 29 (1993), with Fresnel's faces";
const SLATS: &str = "Strip radiosity with Hottel's crossed strings, 20 strips a face, and the exact direct share";

/// A product to be built in.
struct Recipe {
    key: &'static str,
    name: &'static str,
    kind: &'static str,
    description: &'static str,
    method: &'static str,
    tags: &'static [&'static str],
    /// The symmetric systems need not say which face is inside.
    inside: &'static str,
    states: Vec<(StateName, String, Make)>,
    curve: Vec<CurvePoint>,
}

/// The optical part of one state.
enum Make {
    Band(Band),
    Panes(Vec<Pane>),
    Opal(Opal),
    Spreading(Spreading),
    LaserCut(LaserCutPanel),
    Slats(FlatSlats),
}

impl Make {
    /// `None` only for parameters out of range.
    fn band(&self) -> Option<Band> {
        match self {
            Self::Band(band) => Some(band.clone()),
            Self::Panes(panes) => Some(glazing::band(panes)),
            Self::Opal(opal) => opal.band(),
            Self::Spreading(sheet) => sheet.band(),
            Self::LaserCut(panel) => Some(panel.band()),
            Self::Slats(slats) => slats.band(),
        }
    }

    /// Period of what is to be seen of it. \[m\]
    fn structure(&self) -> Option<f64> {
        match self {
            Self::Slats(slats) => Some(slats.spacing),
            Self::LaserCut(panel) => Some(panel.spacing),
            _ => None,
        }
    }

    /// What the representation does to this system.
    fn findings(&self) -> Vec<Finding> {
        match self {
            Self::Slats(_) | Self::LaserCut(_) => vec![Finding::info(
                "straight-light-in-cells",
                "Light that passes unscattered is spread over its Klems cell (10° to 15°), as the data resolve it.",
            )],
            _ => Vec::new(),
        }
    }
}

fn single(make: Make) -> Vec<(StateName, String, Make)> {
    vec![(StateName::default(), String::new(), make)]
}

/// A pane of known transmittance at normal incidence.
fn pane(index: f64, thickness: f64, tau: f64) -> Pane {
    Pane::with_normal_transmittance(index, thickness, tau)
        .expect("the table of built-in products asks for less than a clear pane lets through")
}

fn recipes() -> Vec<Recipe> {
    let clear = pane(GLASS, 0.004, 0.90);
    let open = Band {
        transmission_front: Some(Btdf::ideal_transparent(1.0)),
        transmission_back: Some(Btdf::ideal_transparent(1.0)),
        reflection_front: Some(Btdf::ideal_diffuse(0.0)),
        reflection_back: Some(Btdf::ideal_diffuse(0.0)),
    };
    let plain = |key, name, kind, method, tags, description, make| Recipe {
        key,
        name,
        kind,
        description,
        method,
        tags,
        inside: "either (symmetric)",
        states: single(make),
        curve: Vec::new(),
    };
    let opal = |transmittance, reflectance| Make::Opal(Opal { index: ACRYLIC, transmittance, reflectance });
    let spreading = |index, regular, lobe, spread: f64, transmittance, absorbed| {
        let spread = spread.to_radians();
        Make::Spreading(Spreading { index, regular, lobe, spread, transmittance, absorbed })
    };
    vec![
        plain(
            "open-aperture",
            "Open aperture",
            "ideal",
            "Definition",
            &["reference"],
            "Nothing in the opening: all light goes straight on. Reference for every comparison.",
            Make::Band(open),
        ),
        plain(
            "ideal-diffuser",
            "Ideal diffuser",
            "ideal",
            "Definition",
            &["reference", "diffusing"],
            "Half of the light leaves with the same luminance in every direction, whatever its incidence; a third is \
             thrown back the same way.",
            Make::Band(lambertian(0.5, 1.0 / 3.0)),
        ),
        plain(
            "clear-single",
            "Clear glass, single",
            "pane",
            FRESNEL,
            &["glass", "transparent"],
            "One pane of clear float glass, 4 mm, n = 1.52, τ = 0.90 at normal incidence.",
            Make::Panes(vec![clear]),
        ),
        plain(
            "clear-double",
            "Clear glass, double",
            "pane",
            FRESNEL,
            &["glass", "transparent"],
            "Two panes of clear float glass, 4 mm each, without coating.",
            Make::Panes(vec![clear; 2]),
        ),
        plain(
            "clear-triple",
            "Clear glass, triple",
            "pane",
            FRESNEL,
            &["glass", "transparent"],
            "Three panes of clear float glass, 4 mm each, without coating.",
            Make::Panes(vec![clear; 3]),
        ),
        plain(
            "grey-single",
            "Grey tinted glass, single",
            "pane",
            FRESNEL,
            &["glass", "transparent", "solar control"],
            "One body-tinted pane, 6 mm, τ = 0.44 at normal incidence; absorption alone, no coating.",
            Make::Panes(vec![pane(GLASS, 0.006, 0.44)]),
        ),
        plain(
            "opal-light",
            "Opal acrylic, light",
            "diffuser",
            OPAL,
            &["diffusing", "acrylic"],
            "Translucent sheet with smooth surfaces, τ = 0.60 at normal incidence, diffuse reflectance 0.27.",
            opal(0.60, 0.27),
        ),
        plain(
            "opal-dense",
            "Opal acrylic, dense",
            "diffuser",
            OPAL,
            &["diffusing", "acrylic"],
            "Translucent sheet with smooth surfaces, τ = 0.35 at normal incidence, diffuse reflectance 0.52.",
            opal(0.35, 0.52),
        ),
        plain(
            "acrylic-diffuser-clear",
            "Acrylic diffuser, lightly frosted",
            "diffuser",
            LOBE,
            &["diffusing", "acrylic"],
            "Sheet that keeps 15 % of its light straight and spreads 65 % in a lobe of σ = 8°; τ = 0.85.",
            spreading(ACRYLIC, 0.15, 0.65, 8.0, 0.85, 0.2),
        ),
        plain(
            "acrylic-diffuser-haze",
            "Acrylic diffuser, hazy",
            "diffuser",
            LOBE,
            &["diffusing", "acrylic"],
            "Sheet that spreads 55 % of its light in a lobe of σ = 20° and the rest evenly; τ = 0.70.",
            spreading(ACRYLIC, 0.0, 0.55, 20.0, 0.70, 0.2),
        ),
        plain(
            "satinated-glass",
            "Satinated glass",
            "diffuser",
            LOBE,
            &["diffusing", "glass"],
            "Etched pane: 90 % of the light in a lobe of σ = 12°, the rest evenly; τ = 0.88.",
            spreading(GLASS, 0.0, 0.90, 12.0, 0.88, 0.2),
        ),
        plain(
            "laser-cut-panel",
            "Laser-cut panel",
            "laser-cut-panel",
            EDMONDS,
            &["redirecting", "acrylic"],
            "Acrylic sheet 6 mm with horizontal cuts every 4 mm, which turn light from above up to the ceiling. Losses \
             at the cuts (5 to 10 % in real panels) are left out.",
            Make::LaserCut(LaserCutPanel {
                sheet: Pane { index: ACRYLIC, thickness: 0.006, absorption: 0.0 },
                spacing: 0.004,
            }),
        ),
        venetian(),
    ]
}

/// Slats 80 mm wide every 72 mm, grey-white, with the cut-off control curve.
fn venetian() -> Recipe {
    let (width, spacing) = (0.080, 0.072);
    let states = (0..=15)
        .map(|step| {
            let degrees = f64::from(step * 5);
            let slats = FlatSlats { width, spacing, tilt: degrees.to_radians(), upper: 0.7, lower: 0.7 };
            let name = StateName { label: format!("slats {degrees}°"), value: Some(degrees) };
            (name, format!("{degrees}"), Make::Slats(slats))
        })
        .collect();
    let curve = (0..=18)
        .map(|step| {
            let psi = f64::from(step * 5);
            let tilt = cut_off_tilt(width, spacing, psi.to_radians()).unwrap_or_default().to_degrees();
            CurvePoint { profile_angle: psi, value: tilt.clamp(0.0, 75.0) }
        })
        .collect();
    Recipe {
        key: "venetian-80-72",
        name: "Venetian blind 80/72, matt",
        kind: "venetian",
        description: "Flat slats 80 mm wide every 72 mm, both faces matt with a reflectance of 0.7. Angle 0 is \
                      horizontal; > 0: outer edge lowered. The control curve keeps the sun just out.",
        method: SLATS,
        tags: &["blind", "moving", "solar control"],
        inside: "room side as seen from outside: outer edges lowered at positive angles",
        states,
        curve,
    }
}

/// The built-in products with their datasets, in their order. Takes some tens of milliseconds.
pub fn builtin_products() -> Vec<(NewProduct, Vec<Dataset>)> {
    recipes()
        .into_par_iter()
        .map(|recipe| {
            let datasets = recipe.states.par_iter().map(|(_, key, make)| Dataset {
                name: recipe.name.to_owned(),
                description: recipe.description.to_owned(),
                state: key.clone(),
                visible: make.band().expect("parameters of built-in products are in range"),
                findings: make.findings(),
                structure: make.structure(),
                ..Dataset::default()
            });
            let datasets = datasets.collect();
            let product = NewProduct {
                key: Some(recipe.key.to_owned()),
                name: recipe.name.to_owned(),
                kind: recipe.kind.to_owned(),
                description: recipe.description.to_owned(),
                provenance: Provenance {
                    origin: Origin::Computed,
                    author: "cfs".to_owned(),
                    method: recipe.method.to_owned(),
                    inside_face: recipe.inside.to_owned(),
                    ..Provenance::default()
                },
                tags: recipe.tags.iter().map(|&tag| tag.to_owned()).collect(),
                states: recipe.states.into_iter().map(|(name, ..)| name).collect(),
                control_curve: recipe.curve,
                ..NewProduct::default()
            };
            (product, datasets)
        })
        .collect()
}

/// Chord and pitch \[m\] of the flat slats of a built-in product; `None` for everything else.
pub fn builtin_slats(key: &str) -> Option<(f64, f64)> {
    let recipe = recipes().into_iter().find(|recipe| recipe.key == key)?;
    recipe.states.first().and_then(|(_, _, make)| match make {
        Make::Slats(slats) => Some((slats.width, slats.spacing)),
        _ => None,
    })
}

/// Puts this program's built-in products into a file that has none or older ones, in one transaction. Rows of the
/// user's and favourites stay. A file that a newer program filled is left as it is.
pub(super) fn renew(catalogue: &mut Catalogue) -> Result<(), CatalogueError> {
    if version(&catalogue.db)? >= BUILTIN_VERSION {
        return Ok(());
    }
    // Computed before the lock is taken, so that other connections do not wait for it.
    let records = builtin_products()
        .into_par_iter()
        .map(|(meta, datasets)| store::prepare(&datasets, meta))
        .collect::<Result<Vec<_>, _>>()?;
    let tx = catalogue.change()?;
    if version(&tx)? >= BUILTIN_VERSION {
        return Ok(());
    }
    tx.execute("DELETE FROM product_text WHERE rowid IN (SELECT id FROM product WHERE builtin = 1)", [])?;
    tx.execute("DELETE FROM product WHERE builtin = 1", [])?;
    for (rank, mut record) in (0_i64..).zip(records) {
        record.product.builtin = true;
        record.product.key = store::free_key(&tx, &record.product.key)?;
        store::insert(&tx, &record, rank)?;
    }
    tx.execute("DELETE FROM dataset WHERE hash NOT IN (SELECT dataset FROM state)", [])?;
    tx.execute("INSERT OR REPLACE INTO meta VALUES ('builtin_version', ?)", [BUILTIN_VERSION.to_string()])?;
    tx.commit()?;
    Ok(())
}

/// Version of the built-in products in the file; 0 without any.
fn version(db: &rusqlite::Connection) -> Result<i64, CatalogueError> {
    let text: Option<String> =
        db.query_row("SELECT value FROM meta WHERE key = 'builtin_version'", [], |row| row.get(0)).optional()?;
    Ok(text.and_then(|text| text.parse().ok()).unwrap_or(0))
}

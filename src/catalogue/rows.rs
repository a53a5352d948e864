//! Rows of product lists, read from the tables of the database.

use super::query::Figure;
use super::representative::{FirstRule, Numbers, representative};
use super::sight::VISIBLE;
use super::verified::damaged_products;
use super::{CatalogueError, CurvePoint, Origin};
use rusqlite::{Connection, Row};
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

/// Figures, each with the index of its column in the table of states.
const COLUMNS: [(Figure, usize); 5] = [
    (Figure::TauNormal, 6),
    (Figure::TauHemispherical, 7),
    (Figure::ToCeiling, 9),
    (Figure::SunBlocked, 10),
    (Figure::View, 11),
];

/// Product in a list. Its figures are those of the state that represents the product, see
/// [`representative`](super::representative()).
#[derive(Debug, Clone, PartialEq)]
pub struct ProductRow {
    /// Key by which scenes name the product.
    pub key: String,
    /// Name of the product.
    pub name: String,
    /// Maker of the product; may be empty.
    pub manufacturer: String,
    /// Kind of product, such as `venetian`; may be empty.
    pub kind: String,
    /// Origin of the data, measured or computed.
    pub origin: Origin,
    /// Keys of the states in their order; one empty key for a product with a single state.
    pub states: Vec<String>,
    /// Index in `states` of the state that represents the product.
    pub representative: usize,
    /// Hash of the dataset of that state; `None` while it is not computed yet.
    pub dataset: Option<Arc<str>>,
    /// Control rule that the product gets by default when it is chosen.
    pub rule: FirstRule,
    /// Visible transmittance τ of light from outside at normal incidence; `None` when unknown.
    pub tau_normal: Option<f64>,
    /// Visible hemispherical transmittance τ: of light from outside under uniform luminance; `None` when unknown.
    pub tau_hemispherical: Option<f64>,
    /// Visible transmittances τ of light from outside at the profile angles [`PROFILE_ANGLES`](super::PROFILE_ANGLES),
    /// rising from light from below to light from above; empty when unknown.
    pub tau_profile: Vec<f64>,
    /// Share of the transmitted flux that leaves upwards, to the ceiling, under a sky of uniform luminance; `None` when
    /// unknown.
    pub to_ceiling: Option<f64>,
    /// Share of direct sunlight that is not transmitted at 45° solar altitude (1 − τ); `None` when unknown.
    pub sun_blocked: Option<f64>,
    /// Normal–normal transmittance; `None` when unknown.
    pub view: Option<f64>,
    /// Whether the user marked it as a favourite.
    pub favourite: bool,
    /// Whether the product comes with the program.
    pub builtin: bool,
    /// Subscribed folder of packages that the product comes from; empty for others.
    pub subscribed: String,
}

impl ProductRow {
    /// Returns a figure of the state that represents the product; `None` when unknown.
    pub const fn figure(&self, figure: Figure) -> Option<f64> {
        match figure {
            Figure::TauNormal => self.tau_normal,
            Figure::TauHemispherical => self.tau_hemispherical,
            Figure::ToCeiling => self.to_ceiling,
            Figure::SunBlocked => self.sun_blocked,
            Figure::View => self.view,
        }
    }

    /// Whether the product has more than one state.
    pub const fn moves(&self) -> bool {
        self.states.len() > 1
    }

    /// Returns the key of the state that represents the product; empty for a product with a single state without key.
    pub fn state(&self) -> &str {
        self.states.get(self.representative).map_or("", String::as_str)
    }
}

/// Product as the search needs it: its row in lists and its searchable texts.
#[derive(Debug, Clone)]
pub struct Sought {
    /// Row of the product in lists.
    pub row: Arc<ProductRow>,
    /// Description of the product, as free text.
    pub description: String,
    /// Tags to find the product by.
    pub tags: Vec<String>,
    /// Collections that contain the product.
    pub collections: Vec<String>,
}

/// State while it is read.
struct StateRow {
    key: String,
    numbers: Numbers,
    figures: [Option<f64>; COLUMNS.len()],
    profile: String,
    dataset: Option<Arc<str>>,
}

/// Lists that belong to products (tags, collections, states), by the products' ids.
#[derive(Default)]
struct Lists {
    states: HashMap<i64, Vec<StateRow>>,
    curves: HashMap<i64, Vec<CurvePoint>>,
    tags: HashMap<i64, Vec<String>>,
    collections: HashMap<i64, Vec<String>>,
    /// Ids of products with values that do not have the types of their columns.
    unreadable: BTreeSet<i64>,
}

impl Lists {
    /// Adds a row that is being verified to the lists. `table`: table that it comes from.
    fn take(&mut self, table: &str, product: i64, row: &Row<'_>) -> rusqlite::Result<()> {
        match table {
            "state" => {
                let mut figures = [None; COLUMNS.len()];
                for (figure, (_, column)) in figures.iter_mut().zip(COLUMNS) {
                    *figure = row.get(column)?;
                }
                let numbers = Numbers { value: row.get(4)?, tau_hemispherical: figures[1] };
                let (key, profile, dataset) = (row.get(2)?, row.get(8)?, row.get(5)?);
                let state = StateRow { key, numbers, figures, profile, dataset };
                self.states.entry(product).or_default().push(state);
            }
            "control_point" => {
                let point = CurvePoint { profile_angle: row.get(2)?, value: row.get(3)? };
                self.curves.entry(product).or_default().push(point);
            }
            "tag" => self.tags.entry(product).or_default().push(row.get(1)?),
            _ => {}
        }
        Ok(())
    }
}

/// Returns the products whose rows are as they were stored, in the order of the catalogue – built-in ones first in
/// theirs, then the user's by name – and the keys of the damaged ones.
pub(super) fn read(db: &Connection) -> Result<(Vec<Sought>, Vec<String>), CatalogueError> {
    let mut lists = Lists::default();
    let mut damaged = damaged_products(db, &mut |table, product, row| {
        if lists.take(table, product, row).is_err() {
            lists.unreadable.insert(product);
        }
    })?;
    damaged.append(&mut lists.unreadable);
    let mut collections =
        db.prepare("SELECT p.id, c.name FROM collection c JOIN product p ON p.key = c.product_key ORDER BY 1, 2")?;
    let mut rows = collections.query([])?;
    while let Some(row) = rows.next()? {
        lists.collections.entry(row.get(0)?).or_default().push(row.get(1)?);
    }
    // Descriptions are read only for products whose rule depends on them: those with several states and no curve. Keys
    // last: products of the same name keep their places from one search to the next.
    let mut statement = db.prepare(&format!(
        "SELECT p.id, p.key, p.name, p.manufacturer, p.kind, p.origin, p.builtin, p.description,
                EXISTS (SELECT 1 FROM favourite WHERE product_key = p.key),
                CASE WHEN EXISTS (SELECT 1 FROM control_point WHERE product = p.id)
                       OR NOT EXISTS (SELECT 1 FROM state WHERE product = p.id AND position = 1)
                     THEN '' ELSE p.system END,
                coalesce((SELECT folder FROM subscribed WHERE product_key = p.key), '')
         FROM product p WHERE 1{VISIBLE} ORDER BY p.builtin DESC, p.rank, p.name COLLATE NOCASE, p.key"
    ))?;
    let mut rows = statement.query([])?;
    let (mut list, mut left_out) = (Vec::new(), Vec::new());
    while let Some(row) = rows.next()? {
        let id: i64 = row.get(0)?;
        if damaged.contains(&id) {
            // Even the bytes of the key may be none of a text.
            left_out.push(String::from_utf8_lossy(row.get_ref(1)?.as_bytes().unwrap_or_default()).into_owned());
            continue;
        }
        let own = lists.states.remove(&id).unwrap_or_default();
        let curve = lists.curves.remove(&id).unwrap_or_default();
        let numbers: Vec<Numbers> = own.iter().map(|state| state.numbers).collect();
        let (rule, place) = representative(&numbers, &curve, row.get_ref(9)?.as_str().unwrap_or_default());
        let stands = own.get(place);
        let figure = |figure: Figure| {
            let at = COLUMNS.iter().position(|(column, _)| *column == figure)?;
            stands.and_then(|state| state.figures[at])
        };
        let product = ProductRow {
            key: row.get(1)?,
            name: row.get(2)?,
            manufacturer: row.get(3)?,
            kind: row.get(4)?,
            origin: Origin::from_word(&row.get::<_, String>(5)?),
            representative: place,
            dataset: stands.and_then(|state| state.dataset.clone()),
            rule,
            tau_normal: figure(Figure::TauNormal),
            tau_hemispherical: figure(Figure::TauHemispherical),
            tau_profile: stands.map(|state| list_of(&state.profile)).unwrap_or_default(),
            to_ceiling: figure(Figure::ToCeiling),
            sun_blocked: figure(Figure::SunBlocked),
            view: figure(Figure::View),
            states: own.into_iter().map(|state| state.key).collect(),
            favourite: row.get(8)?,
            builtin: row.get(6)?,
            subscribed: row.get(10)?,
        };
        list.push(Sought {
            row: Arc::new(product),
            description: row.get(7)?,
            tags: lists.tags.remove(&id).unwrap_or_default(),
            collections: lists.collections.remove(&id).unwrap_or_default(),
        });
    }
    Ok((list, left_out))
}

/// Returns a list stored as JSON, such as transmittances; empty when the text is not a list.
pub(super) fn list_of<T: serde::de::DeserializeOwned>(text: &str) -> Vec<T> {
    serde_json::from_str(text).unwrap_or_default()
}

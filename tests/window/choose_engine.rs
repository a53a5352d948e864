//! A catalogue of five products, and an engine that knows their figures.

use crate::driven::Idle;
use cfs::app::catalogue::shelf::{Addition, Query, Shelf};
use cfs::app::results::engine::{Engine, LidFigures, Question, RoomFigures, SurfaceFigures};
use cfs::app::shell::error::AppError;
use cfs::catalogue::NewProduct;
use cfs::compute::btdf::{Btdf, Dataset};
use cfs::compute::estimate::{Cancelled, Estimate, Progress};
use cfs::study::StudyError;
use cfs::study::accuracy::Accuracy;
use cfs::study::rank::{Answer, Found, Group, Item, Parts, Stage};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

/// Knows figures of products by their keys; counts the years that it was asked for, and may keep whole years waiting.
#[derive(Default)]
pub struct Ranks {
    pub years: AtomicUsize,
    pub hold: AtomicBool,
}

/// Energy falls and light falls from a to d; e has no data.
fn value(product: &str, figure: &str) -> Option<f64> {
    let place = ["a", "b", "c", "d"].iter().position(|key| *key == product)?;
    Some(match figure {
        "lighting.LENI_kWh_m2" => [16.0, 12.0, 8.0, 4.0][place],
        "UDI_a" => [0.85, 0.7, 0.45, 0.3][place],
        "UDI_x" => [0.0, 0.3, 0.1, 0.2][place],
        "movements" => [0.0, 400.0, 100.0, 900.0][place],
        _ => 0.1,
    })
}

impl Engine for Ranks {
    fn rank(
        &self,
        groups: &[Group],
        items: &[Item],
        _shelf: &dyn Shelf,
        told: &(dyn Fn(Answer<'_>) + Sync),
        progress: &dyn Progress,
    ) -> Result<(), AppError> {
        for stage in [Stage::Coarse, Stage::Full] {
            for item in items {
                while stage == Stage::Full && self.hold.load(Ordering::Relaxed) && !progress.cancelled() {
                    std::thread::sleep(Duration::from_millis(1));
                }
                if progress.cancelled() {
                    return Err(StudyError::Cancelled(Cancelled).into());
                }
                let group = &groups[item.group];
                let product = &group.products[item.product].key;
                let error = if stage == Stage::Coarse { 0.02 } else { 0.001 };
                let figures: Option<Vec<Estimate>> = group
                    .figures
                    .iter()
                    .map(|figure| value(product, figure).map(|value| Estimate::new(value, error * value)))
                    .collect();
                let outcome =
                    figures.ok_or_else(|| "no transmission for light from outside".to_owned()).map(|figures| {
                        let parts = figures.iter().map(|figure| Parts {
                            zones: vec!["front".to_owned(), "rear".to_owned()],
                            values: (0..16).map(|part| if part == 3 { figure.value } else { 0.0 }).collect(),
                        });
                        let parts = parts.collect();
                        let approximate =
                            if product == "b" { vec!["measured in 13 directions".to_owned()] } else { vec![] };
                        Found { parts, figures, approximate }
                    });
                if stage == Stage::Full {
                    self.years.fetch_add(1, Ordering::Relaxed);
                }
                told(Answer { item: *item, stage, outcome: &outcome });
            }
        }
        Ok(())
    }

    fn room(&self, question: &Question, progress: &dyn Progress) -> Result<RoomFigures, AppError> {
        Idle.room(question, progress)
    }

    fn surfaces(&self, question: &Question, progress: &dyn Progress) -> Result<SurfaceFigures, AppError> {
        Idle.surfaces(question, progress)
    }

    fn lid(&self, question: &Question, progress: &dyn Progress) -> Result<LidFigures, AppError> {
        Idle.lid(question, progress)
    }

    fn accuracy(&self, question: &Question, progress: &dyn Progress) -> Result<Accuracy, AppError> {
        Idle.accuracy(question, progress)
    }

    fn luminaire(&self, lid: &LidFigures, path: &Path) -> Result<Vec<u8>, AppError> {
        Idle.luminaire(lid, path)
    }
}

pub fn addition(key: &str, name: &str, tau: f64) -> Addition {
    let mut dataset = Dataset { name: name.to_owned(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(tau));
    let product = NewProduct {
        key: Some(key.to_owned()),
        name: name.to_owned(),
        kind: if name.ends_with("pane") { "pane" } else { "shade" }.to_owned(),
        ..NewProduct::default()
    };
    Addition { datasets: vec![Arc::new(dataset)], product }
}

/// A catalogue of four products with figures and one without.
pub fn shelf() -> Result<Arc<dyn Shelf>, AppError> {
    let shelf = cfs::app::results::backend::memory_shelf()?;
    let all: Vec<String> = shelf.search(&Query::default())?.entries.iter().map(|entry| entry.key.clone()).collect();
    for key in &all {
        shelf.delete(key)?;
    }
    for (key, name, tau) in [
        ("a", "Apricot pane", 0.2),
        ("b", "Blue pane", 0.3),
        ("c", "Retroreflecting light-guiding venetian blind 80 mm, perforated, white outside", 0.4),
        ("d", "Deep screen", 0.5),
        ("e", "Empty frame", 0.6),
    ] {
        shelf.add(&addition(key, name, tau))?;
    }
    Ok(shelf)
}

//! Library of the systems in the window's scenes: files and closed forms (ideal systems) from the library of
//! [`crate::study`], products from the catalogue.

use crate::app::catalogue::shelf::Shelf;
use crate::app::shell::error::AppError;
use crate::catalogue::Product;
use crate::compute::estimate::Progress;
use crate::study::control::{ControlQuestion, Device};
use crate::study::outside::LitObstructions;
use crate::study::scene_file::SystemKeys;
use crate::study::system::Need;
use crate::study::{Library, StudyError, System, SystemLibrary};
use std::path::Path;
use std::sync::Arc;

/// Library of systems: files and closed forms (ideal systems), and products of the catalogue.
pub struct WindowLibrary<'a> {
    /// Library of files and closed forms (ideal systems).
    pub files: &'a Library,
    /// Catalogue of the products.
    pub shelf: &'a dyn Shelf,
    /// Receiver of the progress of products' data that have to be computed first.
    pub progress: &'a dyn Progress,
}

impl SystemLibrary for WindowLibrary<'_> {
    fn load(&self, keys: &SystemKeys, base: &Path, need: Need) -> Result<Arc<System>, StudyError> {
        let SystemKeys::Catalogue { key, state } = keys else { return self.files.load(keys, base, need) };
        let study_error = |error: AppError| match error {
            AppError::Study(error) => error,
            other => StudyError::Catalogue(other.to_string()),
        };
        self.shelf.provide(key, state.as_deref(), self.progress).map_err(study_error)?;
        let dataset = self.shelf.load(key, state.as_deref()).map_err(study_error)?;
        let model = self.files.model_of(&dataset);
        // The product's name: a dataset's own may be that of another product with the same data.
        let label = self.shelf.product(key).map_err(|error| StudyError::Catalogue(error.to_string()))?.name.clone();
        Ok(Arc::new(System { label, state: dataset.state.clone(), dataset, model }))
    }

    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        self.shelf.controlled_state(product, asked)
    }

    fn device(&self, keys: &SystemKeys, base: &Path) -> Result<Device, StudyError> {
        match keys {
            SystemKeys::Catalogue { key, .. } => Device::of(&self.product(key)?),
            other => self.files.device(other, base),
        }
    }

    fn controlled_description(&self, path: &Path, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        self.files.controlled_description(path, asked)
    }

    fn lit_obstructions(&self) -> Option<&LitObstructions> {
        self.files.lit_obstructions()
    }
}

impl WindowLibrary<'_> {
    /// Returns all information about a product, given by its key.
    ///
    /// # Errors
    /// Returns an error if the catalogue does not have the product.
    pub fn product(&self, key: &str) -> Result<Product, StudyError> {
        match self.shelf.product(key) {
            Ok(product) => Ok((*product).clone()),
            Err(AppError::Study(error)) => Err(error),
            Err(other) => Err(StudyError::Catalogue(other.to_string())),
        }
    }
}

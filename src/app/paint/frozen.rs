//! Shapes that stay the same from frame to frame: turned into triangles once.

use egui::epaint::Tessellator;
use egui::{Mesh, Shape, Ui};
use std::sync::Arc;

/// Resolution that triangles depend on beside the shapes: bits of the pixels per point.
pub type Grain = u32;

/// Returns the resolution of triangles, for keys of cached meshes.
pub fn grain(ui: &Ui) -> Grain {
    ui.pixels_per_point().to_bits()
}

/// Returns shapes without text as triangles.
pub fn frozen(ui: &Ui, shapes: impl IntoIterator<Item = Shape>) -> Arc<Mesh> {
    let options = ui.ctx().tessellation_options(|options| *options);
    // Texts alone need the font's texture.
    let mut tessellator = Tessellator::new(ui.pixels_per_point(), options, [1, 1], Vec::new());
    let mut mesh = Mesh::default();
    shapes.into_iter().for_each(|shape| tessellator.tessellate_shape(shape, &mut mesh));
    Arc::new(mesh)
}

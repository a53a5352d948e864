//! Shapes that are the same in many frames: they are converted to triangles once instead of in every frame.

use egui::epaint::Tessellator;
use egui::{Mesh, Shape, Ui};
use std::sync::Arc;

/// Resolution of the screen, on which the triangles of a shape depend: the number of pixels per point, as the bits of
/// an `f32`.
pub type Grain = u32;

/// Returns the resolution of the screen, as part of the keys of cached meshes.
pub fn grain(ui: &Ui) -> Grain {
    ui.pixels_per_point().to_bits()
}

/// Returns the triangles of shapes, which must not contain text.
pub fn frozen(ui: &Ui, shapes: impl IntoIterator<Item = Shape>) -> Arc<Mesh> {
    let options = ui.ctx().tessellation_options(|options| *options);
    // Texts alone need the font's texture.
    let mut tessellator = Tessellator::new(ui.pixels_per_point(), options, [1, 1], Vec::new());
    let mut mesh = Mesh::default();
    shapes.into_iter().for_each(|shape| tessellator.tessellate_shape(shape, &mut mesh));
    Arc::new(mesh)
}

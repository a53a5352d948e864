//! Texts as labels of the window (feature `egui`). Only the crate of one of two types may convert between them.

use super::Text;

impl From<Text> for egui::RichText {
    fn from(text: Text) -> Self {
        text.get().into()
    }
}

impl From<Text> for egui::WidgetText {
    fn from(text: Text) -> Self {
        text.get().into()
    }
}

//! Display of the window: colours, languages, letters, its place on the screen.

pub mod font_search;
pub mod fonts;
pub mod language;
pub mod right_to_left;
pub mod text_size;
pub mod text_sizing;
pub mod theme;
pub mod window_place;

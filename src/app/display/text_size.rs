//! Text size, with which everything in the window is scaled: in steps, and limited so that the window has room for its
//! minimum content.

use egui::Vec2;

/// Text sizes that can be set, as factors on that of the desktop.
pub const SIZES: [f32; 8] = [0.8, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75, 2.0];

/// Minimum size (width, height) of a window in which everything is readable at the text size of the desktop. \[points\]
pub const LEAST_WINDOW: Vec2 = Vec2::new(960.0, 600.0);

/// Minimum size (width, height) of the window, for text of the smallest size \[points of the desktop\]: the space that
/// task bar and window title leave on a screen of 1366 × 768 pixels at a desktop scale of 150 %.
pub const SMALLEST_WINDOW: Vec2 = Vec2::new(768.0, 440.0);

/// Command that changes the text size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextSize {
    /// One step larger.
    Larger,
    /// One step smaller.
    Smaller,
    /// Size of the desktop.
    Normal,
}

impl TextSize {
    /// Returns the text size after this change of `size`, both as factors on that of the desktop.
    pub fn after(self, size: f32) -> f32 {
        match self {
            Self::Larger => SIZES.into_iter().find(|one| *one > size + 1e-3).unwrap_or(size),
            Self::Smaller => SIZES.into_iter().rev().find(|one| *one < size - 1e-3).unwrap_or(size),
            Self::Normal => 1.0,
        }
    }
}

/// Returns the largest of [`SIZES`] up to `wanted` for which a window of the size `window` \[points of the desktop\]
/// has room; the smallest if there is none.
pub fn fitting(wanted: f32, window: Vec2) -> f32 {
    let most = (window / LEAST_WINDOW).min_elem();
    let fits = |size: &f32| *size <= wanted + 1e-3 && *size <= most + 1e-3;
    SIZES.into_iter().rev().find(fits).unwrap_or(SIZES[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::vec2;

    #[test]
    fn steps_go_to_the_next_size_and_end_at_the_last() {
        assert_eq!(TextSize::Larger.after(1.0), 1.1);
        assert_eq!(TextSize::Smaller.after(1.0), 0.9);
        // Of an earlier program's, or typed into the file.
        assert_eq!((TextSize::Larger.after(1.2), TextSize::Smaller.after(1.2)), (1.25, 1.1));
        assert_eq!((TextSize::Larger.after(2.0), TextSize::Smaller.after(0.8)), (2.0, 0.8));
        assert_eq!(TextSize::Normal.after(1.75), 1.0);
    }

    #[test]
    fn text_is_no_larger_than_the_window_has_room_for() {
        assert_eq!(fitting(2.0, LEAST_WINDOW), 1.0);
        assert_eq!(fitting(2.0, vec2(1280.0, 720.0)), 1.1);
        assert_eq!(fitting(2.0, vec2(1920.0, 1200.0)), 2.0);
        assert_eq!(fitting(1.25, vec2(1920.0, 1200.0)), 1.25);
        assert_eq!(fitting(0.8, vec2(1920.0, 1200.0)), 0.8);
        // Windows of small screens, and a file that says nonsense.
        assert_eq!(fitting(1.0, vec2(900.0, 560.0)), 0.9);
        assert_eq!(fitting(1.5, SMALLEST_WINDOW), 0.8);
        assert_eq!(fitting(0.0, LEAST_WINDOW), 0.8);
        assert_eq!(fitting(f32::NAN, LEAST_WINDOW), 0.8);
    }
}

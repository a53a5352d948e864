//! Saved position and zoom of the window: values that the current desktop cannot show are corrected.

use crate::app::shell::disk::write_whole;
use std::path::Path;

/// Range of zoom factors with which a window can be opened; the text sizes of the program lie well within it.
const ZOOM: std::ops::RangeInclusive<f32> = 0.2..=5.0;
/// Minimum length of each side of a window that must lie on a monitor, so that it can be grabbed. \[px\]
const LEAST_SHOWN: i64 = 64;

/// Rectangle of a window or monitor: left, top, width, height. \[px\]
type Area = [i64; 4];

/// Corrects the zoom factor in the saved state of the window, given by its file, if it is out of range; a file that
/// cannot be read is not changed.
pub(in crate::app) fn repair_saved(file: &Path) {
    let Ok(saved) = std::fs::read_to_string(file) else { return };
    if let Some(repaired) = with_sound_zoom(&saved) {
        // If this fails, the window opens as it would without.
        _ = write_whole(file, repaired.as_bytes(), &[]);
    }
}

/// Returns the saved state with its zoom factor replaced by 1 if it is out of range; `None` if nothing is to be
/// corrected.
fn with_sound_zoom(saved: &str) -> Option<String> {
    const KEY: &str = "zoom_factor:";
    let start = saved.find(KEY)? + KEY.len();
    let length = saved[start..].find([',', ')'])?;
    let zoom = saved[start..start + length].trim().parse::<f32>();
    (!zoom.is_ok_and(|zoom| ZOOM.contains(&zoom)))
        .then(|| format!("{}1.0{}", &saved[..start], &saved[start + length..]))
}

/// Whether enough of a window lies on one of the monitors, see [`LEAST_SHOWN`].
fn is_shown(window: Area, monitors: &[Area]) -> bool {
    let overlap = |axis: usize, monitor: &Area| {
        let end = (window[axis] + window[axis + 2]).min(monitor[axis] + monitor[axis + 2]);
        end - window[axis].max(monitor[axis])
    };
    monitors.iter().any(|monitor| (0..2).all(|axis| overlap(axis, monitor) >= LEAST_SHOWN.min(window[axis + 2])))
}

/// Moves the window to the first monitor if it lies on none, because the monitor it was on is disconnected.
pub(in crate::app) fn bring_on_screen(creation: &eframe::CreationContext<'_>) {
    let Some(window) = creation.winit_window() else { return };
    // Where the desktop alone places windows there is no position.
    let Ok(at) = window.outer_position() else { return };
    let size = window.outer_size();
    let monitors: Vec<_> = window.available_monitors().collect();
    let area = |x: i32, y: i32, width: u32, height: u32| [x.into(), y.into(), width.into(), height.into()];
    let areas: Vec<Area> = monitors
        .iter()
        .map(|one| area(one.position().x, one.position().y, one.size().width, one.size().height))
        .collect();
    if !is_shown(area(at.x, at.y, size.width, size.height), &areas)
        && let Some(first) = monitors.first()
    {
        window.set_outer_position(first.position());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zoom_out_of_range_is_dropped_and_another_kept() {
        let saved =
            |zoom: &str| format!("{{\"egui\": \"(options:(a:1,zoom_factor:{zoom},b:2))\", \"window\": \"(x:3)\"}}");
        for wrong in ["0", "0.0", "-1.0", "1e9", "NaN", "x"] {
            assert_eq!(with_sound_zoom(&saved(wrong)), Some(saved("1.0")), "{wrong}");
        }
        for right in ["1.0", "0.8", "2"] {
            assert_eq!(with_sound_zoom(&saved(right)), None, "{right}");
        }
        assert_eq!(with_sound_zoom("{}"), None);
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("app.ron");
        repair_saved(&file);
        assert!(!file.exists());
        std::fs::write(&file, saved("0.0")).unwrap();
        repair_saved(&file);
        assert_eq!(std::fs::read_to_string(&file).unwrap(), saved("1.0"));
    }

    #[test]
    fn a_window_on_a_monitor_that_is_gone_is_not_shown() {
        let one = [[0, 0, 1920, 1080]];
        assert!(is_shown([100, 100, 1280, 720], &one));
        assert!(is_shown([1800, 1000, 1280, 720], &one));
        assert!(!is_shown([1900, 100, 1280, 720], &one));
        assert!(!is_shown([100, -900, 1280, 720], &one));
        let two = [one[0], [1920, 0, 1920, 1080]];
        assert!(is_shown([1930, 100, 1280, 720], &two));
        assert!(!is_shown([3900, 100, 1280, 720], &two));
        assert!(!is_shown([0, 0, 100, 100], &[]));
    }
}

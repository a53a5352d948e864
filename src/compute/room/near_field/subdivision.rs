//! Illuminance of a sensor by an aperture divided into point luminaires (eq 17 and 18): each part emits from its middle
//! with the distribution of the aperture. Accurate at a distance; near the aperture and for narrow lobes it fails, and
//! its error estimate includes that only as long as the points are not much further apart than the details of the
//! luminance.

use super::kernel::kernel;
use crate::compute::estimate::Estimate;
use crate::compute::room::aperture::View;
use glam::DVec3;

/// Minimum distance of a part from the sensor in units of its largest dimension: the photometric distance, at which a
/// Lambertian disc deviates from a point source by 1 %, 1 / (1 + 0.1²).
pub const PHOTOMETRIC_DISTANCE: f64 = 5.0;
/// Maximum number of parts by the distance rule; reached by sensors nanometres from the aperture. Chosen: cost; the
/// error is stated.
const MOST_PARTS: usize = 1 << 16;

/// Computes the illuminance of a sensor by an aperture divided into `[m, n]` equal parts along x_F and y_F. \[lx\] The
/// error is the difference from half as many along each side (from twice as many for a single part). `luminance`:
/// returns the luminance of the aperture in the direction of a vector from the sensor, façade frame, of any length
/// \[cd/m²\].
pub fn fixed(view: &View, parts: [usize; 2], luminance: impl Fn(DVec3) -> f64) -> Estimate {
    let value = sum(view, parts, &luminance);
    let error = if parts == [1, 1] {
        (sum(view, [2, 2], &luminance) - value).abs() * 4.0 / 3.0
    } else {
        (sum(view, parts.map(|n| n.div_ceil(2)), &luminance) - value).abs()
    };
    Estimate::new(value, error)
}

/// Sums the illuminances of the sensor by `m` × `n` equal parts of the aperture. \[lx\]
fn sum(view: &View, [m, n]: [usize; 2], luminance: &impl Fn(DVec3) -> f64) -> f64 {
    let step = [(view.x[1] - view.x[0]) / m as f64, (view.y[1] - view.y[0]) / n as f64];
    let mut total = 0.0;
    for j in 0..n {
        for i in 0..m {
            let to = DVec3::new(
                view.x[0] + (i as f64 + 0.5) * step[0],
                view.y[0] + (j as f64 + 0.5) * step[1],
                view.distance,
            );
            let kernel = kernel(view, to);
            if kernel > 0.0 {
                total += kernel * luminance(to);
            }
        }
    }
    total * step[0] * step[1]
}

/// Computes the illuminance of a sensor by an aperture whose parts are halved until each is at least
/// [`PHOTOMETRIC_DISTANCE`] times its largest dimension away. \[lx\] The error is the difference from the result with
/// half that distance. `luminance`: returns the luminance of the aperture in the direction of a vector from the sensor,
/// façade frame, of any length \[cd/m²\].
pub fn by_distance(view: &View, luminance: impl Fn(DVec3) -> f64) -> Estimate {
    let value = cut(view, PHOTOMETRIC_DISTANCE, &luminance);
    Estimate::new(value, (cut(view, 0.5 * PHOTOMETRIC_DISTANCE, &luminance) - value).abs())
}

/// Sums the illuminances of the sensor by parts that are at least `factor` times their largest dimension away. \[lx\]
fn cut(view: &View, factor: f64, luminance: &impl Fn(DVec3) -> f64) -> f64 {
    let mut open = vec![(view.x, view.y)];
    let (mut total, mut parts) = (0.0, 1);
    while let Some((x, y)) = open.pop() {
        let size = [x[1] - x[0], y[1] - y[0]];
        let middle = [0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1])];
        let to = DVec3::new(middle[0], middle[1], view.distance);
        let largest = size[0].max(size[1]);
        if parts < MOST_PARTS && to.length() < factor * largest {
            parts += 1;
            if size[0] >= size[1] {
                open.extend([([x[0], middle[0]], y), ([middle[0], x[1]], y)]);
            } else {
                open.extend([(x, [y[0], middle[1]]), (x, [middle[1], y[1]])]);
            }
            continue;
        }
        let kernel = kernel(view, to);
        if kernel > 0.0 {
            total += kernel * luminance(to) * size[0] * size[1];
        }
    }
    total
}

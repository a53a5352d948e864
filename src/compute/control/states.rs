//! Choice of one of a device's states for a demanded value.

/// Difference below which a state's value counts as equal to the demanded one. \[rad, or the state's own unit\] Above
/// the rounding of degrees converted to radians, below any tilt that a device distinguishes.
const SLACK: f64 = 1e-9;

/// Returns the index of the least closed state whose value is at least `demanded` (in the unit of `values`), so that
/// rounding never admits direct sun; if none is, of the most closed one. A larger value is more closed. `None` without
/// states.
pub fn towards_closed(values: &[f64], demanded: f64) -> Option<usize> {
    let most_closed = (0..values.len()).max_by(|&a, &b| values[a].total_cmp(&values[b]))?;
    (0..values.len())
        .filter(|&i| values[i] >= demanded - SLACK)
        .min_by(|&a, &b| values[a].total_cmp(&values[b]))
        .or(Some(most_closed))
}

/// Returns the index of the most open state: that whose value is nearest to 0. `None` without states.
pub fn most_open(values: &[f64]) -> Option<usize> {
    by_openness(values).into_iter().next()
}

/// Returns the index of the most closed state: that with the greatest value (for slats, the outer edge lowest). `None`
/// without states.
pub fn most_closed(values: &[f64]) -> Option<usize> {
    towards_closed(values, f64::INFINITY)
}

/// Returns the index of the state whose value is nearest to the demanded one. `None` without states.
pub fn nearest(values: &[f64], demanded: f64) -> Option<usize> {
    (0..values.len()).min_by(|&a, &b| (values[a] - demanded).abs().total_cmp(&(values[b] - demanded).abs()))
}

/// Returns the indices of the states from the most open (nearest to 0) to the most closed; of two tilts that are
/// equally open in opposite senses the positive one comes first.
pub fn by_openness(values: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].abs().total_cmp(&values[b].abs()).then(values[b].total_cmp(&values[a])));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_goes_towards_closed() {
        let states = [0.0, 15.0, 30.0, 75.0];
        assert_eq!(towards_closed(&states, 15.1), Some(2));
        assert_eq!(towards_closed(&states, 15.0), Some(1));
        assert_eq!(towards_closed(&states, 80.0), Some(3));
        assert_eq!(most_open(&[-30.0, 10.0, 60.0]), Some(1));
        assert_eq!(most_closed(&states), Some(3));
        assert_eq!(nearest(&states, 22.0), Some(1));
        assert_eq!(by_openness(&[-10.0, 0.0, 10.0, 20.0]), [1, 2, 0, 3]);
        assert_eq!((most_open(&[]), nearest(&[], 1.0), towards_closed(&[], 1.0)), (None, None, None));
    }
}

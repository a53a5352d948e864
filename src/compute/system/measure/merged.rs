//! Merging of beams of equal directions.

use super::parallel::Beam;

/// Difference up to which two direction cosines count as the same: above all rounding of f64 (2⁻⁵² ≈ 2.2e-16 per
/// operation), and
/// 0.0002″ as an angle.
pub const SAME: f64 = 1e-9;

/// Merges beams of equal directions into one with the sum of their shares. The order of the result depends on the
/// directions only.
pub fn merged(beams: impl IntoIterator<Item = Beam>) -> Vec<Beam> {
    let beams: Vec<Beam> = beams.into_iter().collect();
    if beams.len() < 2 {
        return beams;
    }
    let mut placed: Vec<((bool, [i64; 4]), Beam)> = beams
        .into_iter()
        .map(|beam| {
            let [a, b] = beam.directions.map(|direction| direction.vector());
            ((beam.transmitted, [a.x, a.y, b.x, b.y].map(place)), beam)
        })
        .collect();
    // Stable: equal names are summed in their order.
    placed.sort_by_key(|(key, _)| *key);
    placed.dedup_by(|(key, beam), (kept, sum)| {
        let same = key == kept;
        if same {
            sum.share += beam.share;
        }
        same
    });
    placed.into_iter().map(|(_, beam)| beam).collect()
}

/// Returns the number of the interval of width [`SAME`] that contains a direction cosine; cosines with the same number
/// count as equal.
pub fn place(cosine: f64) -> i64 {
    let scaled = cosine / SAME;
    (scaled + 0.5_f64.copysign(scaled)) as i64
}

/// Returns the beams in the order of falling share, without the faintest ones, which together carry at most `share` of
/// the incident flux.
pub fn without_faint(mut beams: Vec<Beam>, share: f64) -> Vec<Beam> {
    beams.sort_by(|a, b| b.share.total_cmp(&a.share));
    let mut left = share;
    while let Some(last) = beams.last().filter(|last| last.share <= left) {
        left -= last.share;
        beams.pop();
    }
    beams
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Dir;

    #[test]
    fn equal_names_make_one_beam_and_the_faintest_go() {
        let direction = |theta: f64| Dir::from_theta_phi(theta, 1.0);
        let beams = [
            Beam::through(direction(0.5), 0.3),
            Beam::back(direction(0.5), 0.1),
            Beam::through(direction(0.5 + 1e-12), 0.2),
            Beam::through(direction(0.6), 4e-7),
            Beam::through(direction(0.7), 5e-7),
            Beam { directions: [direction(0.5), direction(0.6)], share: 0.05, transmitted: true },
        ];
        let made = without_faint(merged(beams), 6e-7);
        let shares: Vec<f64> = made.iter().map(|beam| beam.share).collect();
        assert_eq!(made.len(), 4);
        assert!((shares[0] - 0.5).abs() < 1e-15 && made[0].transmitted);
        assert!(shares[1..] == [0.1, 0.05, 5e-7]);
    }
}

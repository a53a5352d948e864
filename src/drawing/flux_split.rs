//! Split of the transmitted flux by the zones of the room at which it is directed, in shares and in words.

use crate::texts::{Text, fixed, tiles as say};

/// Transmitted luminous flux by zone of the room, where a zone is a range of elevations of the emergent direction; each
/// as a share of the flux that is incident on the system. Their sum is the transmittance τ for the incidence
/// considered.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FluxSplit {
    /// Share of the incident flux that leaves upwards, towards the ceiling.
    pub ceiling: f64,
    /// Share of the incident flux that leaves downwards at a moderate angle, towards the work plane.
    pub work_zone: f64,
    /// Share of the incident flux that leaves nearly horizontally, towards the eyes of people in the room.
    pub eye_zone: f64,
    /// Share of the incident flux that leaves steeply down, towards the floor near the façade.
    pub floor: f64,
}

impl FluxSplit {
    /// Returns the transmittance τ: the sum of the shares of all zones.
    pub fn total(&self) -> f64 {
        self.parts().iter().map(|(_, share)| share).sum()
    }

    /// Returns the four zones from top to bottom (ceiling, eyes, work plane, floor), each with its translated name and
    /// its share of the incident flux.
    pub fn parts(&self) -> [(Text, f64); 4] {
        [
            (say::CEILING, self.ceiling),
            (say::EYE_ZONE, self.eye_zone),
            (say::WORK_ZONE, self.work_zone),
            (say::FLOOR, self.floor),
        ]
    }

    /// Returns the index, from top to bottom, of the zone with the largest share.
    fn greatest(&self) -> usize {
        let parts = self.parts();
        (0..4).fold(0, |best, zone| if parts[zone].1 > parts[best].1 { zone } else { best })
    }

    /// Returns a sentence on the zone with the largest share, as "Of 41 % transmitted, 28 goes to the
    /// ceiling."
    pub fn sentence(&self) -> String {
        if self.total() <= 0.0 {
            return say::NOTHING_TRANSMITTED.into();
        }
        let zone = self.greatest();
        let (all, share) = (percent(self.total()), percent(self.parts()[zone].1));
        match zone {
            0 => say::of_transmitted_ceiling(all, share),
            1 => say::of_transmitted_eye(all, share),
            2 => say::of_transmitted_work(all, share),
            _ => say::of_transmitted_floor(all, share),
        }
    }

    /// Returns four texts of falling length, of which a caller shows the longest that fits: all zones with their
    /// percentages in one line, the same with short names, the zone with the largest share with the total, and that
    /// zone alone.
    pub fn lines(&self) -> [String; 4] {
        let all = percent(self.total());
        let [ceiling, eye, work, floor] = self.parts().map(|(_, share)| percent(share));
        let (zone, share) = self.parts()[self.greatest()];
        let share = percent(share);
        [
            say::split_line(&ceiling, &eye, &work, &floor),
            say::split_line_short(ceiling, eye, work, floor),
            say::split_most(&share, all, zone),
            format!("{zone}: {share} %"),
        ]
    }
}

/// Returns a share of one as a number in per cent, without the sign: whole, with one decimal below 1 %.
pub fn percent(share: f64) -> String {
    let value = 100.0 * share;
    fixed(value, usize::from(value < 1.0 && value > 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_sentence_about_the_split() {
        let split = FluxSplit { ceiling: 0.28, work_zone: 0.06, eye_zone: 0.05, floor: 0.02 };
        assert_eq!(split.sentence(), "Of 41 % transmitted, 28 goes to the ceiling.");
        assert_eq!(FluxSplit::default().sentence(), "Nothing is transmitted.");
    }
}

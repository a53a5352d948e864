//! Split of the transmitted light by the zones of the room that it reaches, in shares and in words.

use crate::texts::{Text, fixed, tiles as say};

/// Transmitted light by zone of the room, as shares of the incident light; their sum is τ of that situation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FluxSplit {
    /// Share upwards, on the ceiling.
    pub ceiling: f64,
    /// Share on the work plane.
    pub work_zone: f64,
    /// Share at the height of the eyes.
    pub eye_zone: f64,
    /// Share steeply down, on the floor near the façade.
    pub floor: f64,
}

impl FluxSplit {
    /// Returns the sum of the shares.
    pub fn total(&self) -> f64 {
        self.parts().iter().map(|(_, share)| share).sum()
    }

    /// Returns the zones from top to bottom with their names and shares.
    pub fn parts(&self) -> [(Text, f64); 4] {
        [
            (say::CEILING, self.ceiling),
            (say::EYE_ZONE, self.eye_zone),
            (say::WORK_ZONE, self.work_zone),
            (say::FLOOR, self.floor),
        ]
    }

    /// Returns the number of the zone with the largest share, from top to bottom.
    fn greatest(&self) -> usize {
        let parts = self.parts();
        (0..4).fold(0, |best, zone| if parts[zone].1 > parts[best].1 { zone } else { best })
    }

    /// Returns a sentence on the zone with the largest share, as "41 % of the light is transmitted, 28 % to the ceiling."
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

    /// Returns all zones in one line, in the order of the bar, then ever shorter versions of it.
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

/// Returns a share as whole percents; with one decimal below 1 %.
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

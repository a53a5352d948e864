//! Where transmitted light goes, in shares and in words.

/// Where the transmitted light goes, as shares of the light that arrives; their sum is τ of that situation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FluxSplit {
    /// Upwards, on the ceiling.
    pub ceiling: f64,
    /// On the work plane.
    pub work_zone: f64,
    /// At the height of the eyes.
    pub eye_zone: f64,
    /// Steeply down, on the floor near the façade.
    pub floor: f64,
}

impl FluxSplit {
    /// Sum of the shares.
    pub fn total(&self) -> f64 {
        self.parts().iter().map(|(_, share)| share).sum()
    }

    /// The zones from top to bottom with their names.
    pub fn parts(&self) -> [(&'static str, f64); 4] {
        [("ceiling", self.ceiling), ("eye zone", self.eye_zone), ("work zone", self.work_zone), ("floor", self.floor)]
    }

    /// The zone that gets most, with its share.
    fn greatest(&self) -> (&'static str, f64) {
        self.parts().into_iter().fold(("", -1.0), |best, part| if part.1 > best.1 { part } else { best })
    }

    /// "Of 41 % transmitted, 28 goes to the ceiling."
    pub fn sentence(&self) -> String {
        if self.total() <= 0.0 {
            return "Nothing is transmitted.".to_owned();
        }
        let (zone, share) = self.greatest();
        format!("Of {} % transmitted, {} goes to the {zone}.", percent(self.total()), percent(share))
    }

    /// All zones in one line, in the order of the bar, and shorter.
    pub fn lines(&self) -> [String; 4] {
        let all = percent(self.total());
        let [ceiling, eye, work, floor] = self.parts().map(|(_, share)| percent(share));
        let (zone, share) = self.greatest();
        let share = percent(share);
        [
            format!("ceiling {ceiling} · eye zone {eye} · work zone {work} · floor {floor} %"),
            format!("ceiling {ceiling}, eye {eye}, work {work}, floor {floor} %"),
            format!("{share} of {all} % to the {zone}"),
            format!("{zone}: {share} %"),
        ]
    }
}

/// Whole percents; one decimal below 1 %.
pub fn percent(share: f64) -> String {
    let value = 100.0 * share;
    if value >= 1.0 || value <= 0.0 { format!("{value:.0}") } else { format!("{value:.1}") }
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

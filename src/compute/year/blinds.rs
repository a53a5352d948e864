//! Operation of blinds by IES LM-83-12, § 2.2.6, for spatial daylight autonomy, independent of the control that the
//! blinds have in use.
//!
//! Hour by hour: while more than 2 % of the analysis points have 1000 lx or more directly from the sun, a group of
//! apertures closes, one after another. A group consists of the apertures of the same plane with the same product. The
//! standard does not say which of several groups is first: here the one that by itself puts the sun on most points,
//! then the first one.

use super::autonomy::Autonomy;
use super::hours::{Light, Step, StepTable};
use crate::compute::estimate::Estimate;

/// Illuminance by direct sun from which an analysis point counts as sunlit. \[lx\] Source: IES LM-83-12, § 2.2.6.
pub const DIRECT_SUN: f64 = 1000.0;
/// Maximum share of the analysis points that may have [`DIRECT_SUN`] before a group of blinds closes. Source: IES
/// LM-83-12, § 2.2.6.
pub const SHARE: f64 = 0.02;

/// Illuminances by direct sun at the analysis points through one group of apertures, with its blinds open and with its
/// blinds closed. \[lx\]
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GroupSun {
    /// Illuminance by direct sun with the group's blinds open, one entry per analysis point. \[lx\]
    pub open: Vec<Estimate>,
    /// Illuminance by direct sun with the group's blinds closed, one entry per analysis point. \[lx\]
    pub closed: Vec<Estimate>,
}

/// Groups of apertures whose blinds are closed in one step, and whether the errors of the sun's illuminances could
/// change them.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Worked {
    /// Whether the blinds of each group are closed.
    pub closed: Vec<bool>,
    /// Whether other groups would be closed with less or more illuminance by direct sun, within its error.
    pub unsure: bool,
}

impl Worked {
    /// Creates a step in which the blinds of all `groups` groups are open.
    pub fn open(groups: usize) -> Self {
        Self { closed: vec![false; groups], unsure: false }
    }
}

/// Determines the groups of apertures whose blinds close in one step by the rule of IES LM-83-12.
pub fn worked(groups: &[GroupSun]) -> Worked {
    let [closed, less, more] = [0.0, -1.0, 1.0].map(|sign| one_by_one(groups, sign));
    Worked { unsure: less != closed || more != closed, closed }
}

/// Closes groups one after another until few enough points are sunlit, and returns whether each is closed; `sign`:
/// multiple of the illuminances' errors that is added to them.
fn one_by_one(groups: &[GroupSun], sign: f64) -> Vec<bool> {
    let points = groups.first().map_or(0, |group| group.open.len());
    let light = |one: Estimate| (one.value + sign * one.error).max(0.0);
    let mut closed = vec![false; groups.len()];
    loop {
        let at = |point: usize| {
            let through =
                |(group, shut): (&GroupSun, &bool)| light(if *shut { &group.closed } else { &group.open }[point]);
            groups.iter().zip(&closed).map(through).sum::<f64>()
        };
        let lit: Vec<usize> = (0..points).filter(|&point| at(point) >= DIRECT_SUN).collect();
        if lit.len() as f64 <= SHARE * points as f64 {
            return closed;
        }
        let brings = |group: &GroupSun| {
            let all = lit.iter().map(|&point| light(group.open[point]));
            (all.clone().filter(|e| *e >= DIRECT_SUN).count(), all.sum::<f64>())
        };
        let mut next: Option<(usize, (usize, f64))> = None;
        for (k, group) in groups.iter().enumerate().filter(|(k, _)| !closed[*k]) {
            let own = brings(group);
            if own.1 > 0.0 && next.is_none_or(|(_, most)| own.0 > most.0 || own.0 == most.0 && own.1 > most.1) {
                next = Some((k, own));
            }
        }
        // No open group brings sun to these points: closing more would not help.
        let Some((k, _)) = next else { return closed };
        closed[k] = true;
    }
}

/// Annual results of a room whose blinds are operated by the rule of IES LM-83-12.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Blinds {
    /// Spatial daylight autonomy sDA300/50% with the blinds operated by the rule, 0 … 1.
    pub sda_300_50: f64,
    /// Occupied hours with closed blinds, one entry per group of apertures. \[h\]
    pub closed_hours: Vec<f64>,
}

impl Blinds {
    /// Computes the results of a year or a part of one from the illuminances `light` with the blinds operated by the
    /// rule, and the closed groups `worked` of every step. `length`: duration of a step. \[h\] `sign`: treatment of
    /// unsure steps: −1 counts them as dark with all blinds open (lower limit), 1 as lit with all blinds closed (upper
    /// limit), 0 uses them as given.
    pub fn of(steps: &[Step], light: Light<'_>, worked: &[Worked], length: f64, sign: f64) -> Self {
        let unsure = vec![if sign < 0.0 { 0.0 } else { f32::MAX }; light.places()];
        let mut shifted = StepTable::zeros(steps.len(), light.places(), 0);
        for (step, one) in worked.iter().enumerate() {
            shifted.set(step, if one.unsure && sign != 0.0 { &unsure } else { light.row(step) });
        }
        let groups = worked.iter().map(|one| one.closed.len()).max().unwrap_or(0);
        let closed = |group: usize| {
            let counts = |(step, one): (&Step, &Worked)| {
                let shut = one.closed.get(group).copied().unwrap_or(false);
                step.occupied && if one.unsure && sign != 0.0 { sign > 0.0 } else { shut }
            };
            length * steps.iter().zip(worked).filter(|pair| counts(*pair)).count() as f64
        };
        Self {
            sda_300_50: shifted.columns(0..light.places()).map_or(0.0, |all| Autonomy::of(steps, all).sda_300_50),
            closed_hours: (0..groups).map(closed).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn group(open: &[f64], closed: f64) -> GroupSun {
        let exact = |e: &f64| Estimate::exact(*e);
        GroupSun { open: open.iter().map(exact).collect(), closed: vec![Estimate::exact(closed); open.len()] }
    }

    /// The sun at the first `lit` of 100 points.
    fn on(lit: usize) -> Vec<f64> {
        (0..100).map(|k| if k < lit { 5000.0 } else { 0.0 }).collect()
    }

    #[test]
    fn two_points_of_a_hundred_are_allowed() {
        for (lit, closes) in [(0, false), (2, false), (3, true)] {
            let worked = worked(&[group(&on(lit), 0.0)]);
            assert_eq!(worked, Worked { closed: vec![closes], unsure: false }, "{lit}");
        }
        let faint: Vec<f64> = on(50).iter().map(|e| e.min(999.9)).collect();
        assert!(!worked(&[group(&faint, 0.0)]).closed[0]);
        // Together they reach what neither does alone.
        let half: Vec<f64> = on(50).iter().map(|e| e.min(600.0)).collect();
        assert_eq!(worked(&[group(&half, 0.0), group(&half, 0.0)]).closed, [true, false]);
    }

    #[test]
    fn groups_close_one_after_another_and_only_those_with_sun() {
        let (a, b) = (group(&on(3), 0.0), group(&on(10), 0.0));
        assert_eq!(worked(&[a.clone(), b.clone()]).closed, [true, true]);
        assert_eq!(worked(&[group(&on(2), 0.0), b.clone()]).closed, [false, true]);
        assert_eq!(worked(&[group(&on(0), 0.0), b]).closed, [false, true]);
        // What comes through closed blinds closes the others, not those without sun.
        assert_eq!(worked(&[group(&on(10), 2000.0), group(&on(0), 0.0), a]).closed, [true, false, true]);
    }

    #[test]
    fn an_error_that_reaches_the_limit_is_told() {
        let mut near = group(&on(3), 0.0);
        near.open[2] = Estimate::new(1001.0, 2.0);
        assert_eq!(worked(&[near.clone()]), Worked { closed: vec![true], unsure: true });
        near.open[2].error = 0.5;
        assert!(!worked(&[near]).unsure);
    }

    #[test]
    fn unsure_steps_leave_their_figures_open() {
        let steps = vec![Step { month: 1, occupied: true, diffuse_horizontal: 1.0 }; 4];
        let light = [400.0, 100.0, 400.0, 100.0];
        let one = |closed, unsure| Worked { closed: vec![closed], unsure };
        let worked = [one(true, false), one(false, false), one(true, true), one(false, false)];
        let of = |sign| {
            Blinds::of(&steps, StepTable::of_rows(1, &light).unwrap().columns(0..1).unwrap(), &worked, 0.5, sign)
        };
        assert_eq!(of(0.0), Blinds { sda_300_50: 1.0, closed_hours: vec![1.0] });
        assert_eq!(of(-1.0), Blinds { sda_300_50: 0.0, closed_hours: vec![0.5] });
        assert_eq!(of(1.0), of(0.0));
    }
}

//! Checks for directions without data and for spikes at grazing angles.

use super::at::At;
use super::blocks::{Block, Blocks, Turn};
use super::diagnosis::Diagnosis;
use crate::compute::btdf::{Component, Finding};
use crate::compute::direction::Dir;

/// Ratio to the neighbouring values from which a value in the last 10° before grazing counts as a spike. Chosen:
/// affects reporting only.
const SPIKE: f64 = 2.0;
/// Polar angle from which incidence counts as grazing: 79°. \[rad\] Chosen: includes the middle of the outermost Klems
/// ring (82.5°), not that of the next one; affects reporting only.
const GRAZING: f64 = 1.38;

/// Returns findings about missing patches and spikes in all functions of a band.
pub(super) fn check(at: &At, blocks: &Blocks) -> Vec<Diagnosis> {
    let mut list = Vec::new();
    for component in Component::ALL {
        let Some(block) = blocks.get(component) else { continue };
        list.extend(gaps(at, blocks, component, block));
        list.extend(spikes(at, blocks, component, block));
    }
    list
}

/// Returns a finding if a function is zero for many incident directions, or for single ones among neighbours with
/// light.
fn gaps(at: &At, blocks: &Blocks, component: Component, block: &Block) -> Option<Diagnosis> {
    let n = blocks.weight.len();
    let largest = block.tau.iter().copied().fold(0.0, f64::max);
    if largest <= 0.0 {
        return None;
    }
    let dark = block.tau.iter().filter(|tau| **tau == 0.0).count();
    let place = format!("{} ({})", component.words(), at.name);
    if 2 * dark > n && n > 10 {
        return Some(
            Finding::warning(
                "missing-patches",
                format!("{place} is zero for {dark} of {n} incident directions: most were not measured."),
            )
            .into(),
        );
    }
    let emitted: Vec<f64> = (0..n).map(|o| (0..n).map(|i| blocks.weight[i] * block.q[i * n + o]).sum()).collect();
    let most = emitted.iter().copied().fold(0.0, f64::max);
    let rows = alone(blocks, &block.tau, largest);
    let columns = alone(blocks, &emitted, most);
    if rows.is_empty() && columns.is_empty() {
        return None;
    }
    let angles = |list: &[usize]| {
        let cell = |k: &usize| blocks.basis.cell(*k);
        let names = list
            .iter()
            .take(3)
            .map(|k| format!("θ {:.0}° φ {:.0}°", cell(k).theta().to_degrees(), cell(k).phi.to_degrees()));
        names.collect::<Vec<_>>().join(", ")
    };
    let mut message = format!("{place}: zero among neighbours that are not, for");
    if !rows.is_empty() {
        message.push_str(&format!(" {} incident directions ({} …)", rows.len(), angles(&rows)));
    }
    if !columns.is_empty() {
        let and = if rows.is_empty() { "" } else { " and" };
        message.push_str(&format!("{and} {} emergent directions ({} …)", columns.len(), angles(&columns)));
    }
    message.push_str(": missing patches.");
    Some(Finding::warning("missing-patches", message).into())
}

/// Returns the cells whose value is zero although the neighbours on their ring have light; `largest`: largest of the
/// values.
fn alone(blocks: &Blocks, values: &[f64], largest: f64) -> Vec<usize> {
    let mut list = Vec::new();
    for (index, ring) in blocks.basis.rings().iter().enumerate() {
        let first = blocks.basis.first_cell(index);
        let around = |k: usize| values[first + k % ring.sectors];
        for k in 0..ring.sectors {
            // What is dark on both sides alike is dark by construction, as mirrors are from along their slats.
            let image = blocks.turned(Turn::LeftRight, first + k);
            if values[first + k] != 0.0 || (image != first + k && values[image] == 0.0) {
                continue;
            }
            let lit = if ring.sectors == 1 {
                // A ring that is one cell: the means of the rings beside it.
                let beside = [index.checked_sub(1), Some(index + 1)];
                let mut rings = beside.into_iter().flatten().filter_map(|other| {
                    let ring = blocks.basis.rings().get(other)?;
                    let first = blocks.basis.first_cell(other);
                    Some(values[first..first + ring.sectors].iter().sum::<f64>() / ring.sectors as f64)
                });
                rings.any(|mean| mean > 0.05 * largest)
            } else if ring.sectors > 3 {
                around(k + 1).max(around(k + 2)) > 0.05 * largest
                    && around(k + ring.sectors - 1).max(around(k + ring.sectors - 2)) > 0.05 * largest
            } else {
                false
            };
            // A patch is missing when light comes from all around it, also from the rings beside it.
            let cell = blocks.basis.cell(first + k);
            let beside = |theta: f64| {
                let inside = theta > 0.0 && theta < std::f64::consts::FRAC_PI_2;
                let other = inside.then(|| blocks.basis.index(Dir::from_theta_phi(theta, cell.phi))).flatten();
                other.is_none_or(|other| values[other] > 0.02 * largest)
            };
            if lit && beside(cell.theta_min - 1e-3) && beside(cell.theta_max + 1e-3) {
                list.push(first + k);
            }
        }
    }
    list
}

/// Returns a finding if a function has values far above their neighbours near grazing incidence.
fn spikes(at: &At, blocks: &Blocks, component: Component, block: &Block) -> Option<Diagnosis> {
    let transmission = component.is_transmission();
    let rings = blocks.tau_by_ring(block);
    let [.., before, last] = rings.as_slice() else { return None };
    // Reflection rises towards grazing everywhere; transmission nowhere.
    // Scattering systems may leak there; panes never do.
    if transmission
        && blocks.straight_share(block) > 0.9
        && last.0 > GRAZING
        && last.1 > 0.02
        && last.1 > 1.25 * before.1
    {
        let message = format!(
            "{} ({}) rises towards grazing incidence, from {:.3} at {:.0}° to {:.3} at {:.0}°, where it should fall.",
            component.words(),
            at.name,
            before.1,
            before.0.to_degrees(),
            last.1,
            last.0.to_degrees()
        );
        return Some(Finding::warning("grazing-spike", message).into());
    }
    let (index, ring) = blocks.basis.rings().iter().enumerate().find(|(_, ring)| ring.theta_max > 1.56)?;
    let (first, count) = (blocks.basis.first_cell(index), ring.sectors);
    let values = &block.tau[first..first + count];
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let median = sorted[count / 2];
    let odd = (0..count).find(|k| {
        let (left, right) = (values[(k + count - 1) % count], values[(k + 1) % count]);
        // Along slats and ribs light slips through on both sides.
        let opposite = blocks.turned(Turn::HalfRound, first + k);
        count > 4
            && median > 0.01
            && values[*k] > SPIKE * left.max(right).max(median)
            && values[*k] > 0.1
            && values[*k] > SPIKE * block.tau[opposite]
    })?;
    let cell = blocks.basis.cell(first + odd);
    let message = format!(
        "{} ({}): {:.3} at θ {:.0}°, φ {:.0}°, more than {SPIKE:.0} times the directions beside it: a grazing spike.",
        component.words(),
        at.name,
        values[odd],
        cell.theta().to_degrees(),
        cell.phi.to_degrees()
    );
    Some(Finding::warning("grazing-spike", message).into())
}

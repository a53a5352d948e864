//! Emergent cells from the header's list of rings.

use super::MOST_CELLS;
use super::frame::Naming;
use crate::compute::basis::{AzimuthMap, Ring, RingBasis};
use crate::formats::location::{FormatError, Location};

/// Emergent cells of a file, and for every cell the column of the file with its value, if the two orders differ.
pub(super) struct FileRings {
    /// Emergent cells of the rings.
    pub basis: RingBasis,
    /// Index of the column of the file for every cell; `None` if the orders are the same.
    pub columns: Option<Vec<usize>>,
}

/// Returns the emergent cells of the rings that the header lists. Their order is that of the file if the rings rise or
/// fall throughout; otherwise they are sorted.
pub(super) fn file_rings(list: &[[f64; 3]], line: usize, naming: Naming) -> Result<FileRings, FormatError> {
    let at = |k: usize| Location::line(line).in_element(format!("rings, ring {}", k + 1));
    let [low, high] = naming.range();
    if list.is_empty() {
        return Err(FormatError::new(Location::line(line).in_element("rings"), "an empty list", "at least one ring"));
    }
    let mut cells = 0_usize;
    for (k, &[from, to, sectors]) in list.iter().enumerate() {
        if !(from >= low - 1e-6 && to <= high + 1e-6 && from < to) {
            return Err(FormatError::new(
                at(k),
                format!("θ from {from} to {to}"),
                format!("rising angles within {low}…{high}° for this quantity and side"),
            ));
        }
        if !(1.0..=7200.0).contains(&sectors) || sectors.fract() != 0.0 {
            return Err(FormatError::new(at(k), format!("{sectors} sectors"), "a whole number of sectors, 1 to 7200"));
        }
        cells += sectors as usize;
        if cells > MOST_CELLS {
            return Err(FormatError::new(
                at(k),
                format!("more than {MOST_CELLS} cells"),
                format!("at most {MOST_CELLS} cells"),
            ));
        }
    }
    let mut order: Vec<usize> = (0..list.len()).collect();
    let rising = list.windows(2).all(|w| w[1][0] >= w[0][1] - 1e-7);
    let falling = list.windows(2).all(|w| w[1][1] <= w[0][0] + 1e-7);
    if !rising && !falling {
        order.sort_by(|&a, &b| list[a][0].total_cmp(&list[b][0]));
        if let Some(pair) = order.windows(2).find(|w| list[w[1]][0] < list[w[0]][1] - 1e-7) {
            let (a, b) = (list[pair[0]], list[pair[1]]);
            return Err(FormatError::new(
                at(pair[0].max(pair[1])),
                format!("θ {} to {} overlaps θ {} to {}", b[0], b[1], a[0], a[1]),
                "rings that do not overlap (gaps are zero)",
            ));
        }
    }
    // Sorted rings rise in the file's θ: in names they rise or fall.
    let rings: Vec<Ring> = order.iter().map(|&k| ring(list[k], naming)).collect();
    let azimuth = AzimuthMap { sign: 1.0, offset: naming.turn() };
    let basis = RingBasis::new(format!("rings {cells}"), rings, azimuth).map_err(|error| {
        FormatError::new(Location::line(line).in_element("rings"), error.to_string(), "rings that do not overlap")
    })?;
    let columns = (!rising && !falling).then(|| {
        let first: Vec<usize> =
            list.iter().scan(0, |sum, ring| Some(std::mem::replace(sum, *sum + ring[2] as usize))).collect();
        order.iter().flat_map(|&k| first[k]..first[k] + list[k][2] as usize).collect()
    });
    Ok(FileRings { basis, columns })
}

fn ring([from, to, sectors]: [f64; 3], naming: Naming) -> Ring {
    let (a, b) = (naming.theta(from), naming.theta(to));
    Ring {
        theta_min: a.min(b).clamp(0.0, 90.0).to_radians(),
        theta_max: a.max(b).clamp(0.0, 90.0).to_radians(),
        sectors: sectors as usize,
        first_phi: 0.0,
    }
}

//! BSDF data of one incident direction as they are used: original, spread by a filter for diffuse light, or compressed
//! by wavelets.

use super::compact::LOSSLESS_BELOW;
use crate::compute::btdf::{Btdf, Indicatrix, Scattered};
use crate::compute::direction::Incident;
use crate::compute::incidence::filter::{Filter, Kernel, Spreader};
use crate::compute::incidence::schemes::DiffuseScheme;
use crate::compute::lid::Interpolator;
use crate::compute::wavelet::{CompactError, CompactRows, Criterion};
use std::sync::Arc;

/// Version of the data of one incident direction: original or processed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum DataForm {
    /// Original data, measured or computed.
    #[default]
    Measured,
    /// Data spread over the patch of incident directions that one direction represents, for diffuse light.
    Filtered,
    /// Data compressed by wavelets, like large datasets in the catalogue.
    Compact,
}

impl DataForm {
    /// All versions, in the order in which they are offered.
    pub const ALL: [Self; 3] = [Self::Measured, Self::Filtered, Self::Compact];
}

/// Processing by which a version was made from the original data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum How {
    /// Filter of an interpolation scheme for diffuse light.
    Filter {
        /// Scheme to which the filter belongs.
        scheme: DiffuseScheme,
        /// Whether the scene uses the filter; if not, it divides the sky into finer patches instead.
        in_force: bool,
    },
    /// Compression by wavelets.
    Wavelets {
        /// Number of values that are stored for this indicatrix after compression, including τ.
        kept: usize,
        /// Number of values before compression.
        cells: usize,
        /// Maximum share of the transmitted flux that compression may shift to wrong directions.
        allowed: f64,
        /// Whether the catalogue stores the data compressed; if not, they are small enough to be stored without loss.
        in_force: bool,
    },
}

/// Difference of processed data from the original data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// Largest absolute difference of the luminance coefficient of any emergent patch. \[1/sr\]
    pub largest: f64,
    /// Share of the transmitted flux in wrong directions: ½∫|Δq| cosθ dω / τ.
    pub misplaced: f64,
}

/// Data of one incident direction after processing.
#[derive(Debug, Clone, PartialEq)]
pub struct Formed {
    /// Luminance coefficients by emergent direction.
    pub indicatrix: Indicatrix,
    /// Processing by which they were made.
    pub how: How,
    /// Difference from the original data; `None` if these are no longer known.
    pub difference: Option<Difference>,
}

/// Reason why data of an incident direction cannot be processed in this manner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoForm {
    /// Nothing is scattered, or only by a closed form such as Lambert's.
    NoValues,
    /// The data are means over incident patches, so that they need not be spread over a patch.
    Means,
    /// The data are a tensor tree, which is already compact.
    Tree,
    /// The incident directions do not form a lattice of patches.
    NoLattice,
    /// The values cannot be compressed, for this reason.
    Values(CompactError),
}

/// Returns the index of the row of data that a computation without interpolation uses for an incident direction: that
/// of its patch, or of the nearest direction of the data. `None` outside the hemisphere and for data in closed form.
pub fn row_of(btdf: &Btdf, incident: Incident) -> Option<usize> {
    match btdf.scattered.as_ref()? {
        Scattered::Cells(matrix) => matrix.incident().index(incident.0),
        Scattered::Directions(data) => data.standing_for(incident.0),
        _ => None,
    }
}

/// Returns the filter of an interpolation scheme for diffuse light, and the scheme to which it belongs; for a scheme
/// without a filter that over the patch is returned.
fn filter_of(scheme: DiffuseScheme) -> (DiffuseScheme, Filter) {
    let own = |kernel| Filter { kernel, sharp_only: false };
    match scheme {
        DiffuseScheme::FilterNarrow => (scheme, own(Kernel::NARROW)),
        DiffuseScheme::FilterMatched => (scheme, own(Kernel::MATCHED)),
        DiffuseScheme::FilterWide => (scheme, own(Kernel::WIDE)),
        _ => (DiffuseScheme::FilterPatch, Filter { kernel: Kernel::Patch, sharp_only: true }),
    }
}

/// Returns the data of the patch or direction nearest to `incident`, spread by the filter of an interpolation scheme
/// for diffuse light.
///
/// # Errors
/// Returns the reason if the data cannot be filtered.
pub fn filtered(
    btdf: &Btdf,
    incident: Incident,
    scheme: DiffuseScheme,
    interpolator: impl FnOnce() -> Option<Arc<Interpolator>>,
) -> Result<Formed, NoForm> {
    let data = match &btdf.scattered {
        Some(Scattered::Directions(data)) => data,
        Some(Scattered::Cells(_) | Scattered::Tree(_)) => return Err(NoForm::Means),
        _ => return Err(NoForm::NoValues),
    };
    if data.lattice().is_none() {
        return Err(NoForm::NoLattice);
    }
    let row = row_of(btdf, incident).ok_or(NoForm::NoValues)?;
    let interpolator = interpolator().ok_or(NoForm::NoLattice)?;
    let model = interpolator.model();
    let (used, filter) = filter_of(scheme);
    let q = Spreader::new(model, filter, model.grid()).ok_or(NoForm::NoLattice)?.indicatrix(row);
    let difference = difference(&data.emergent().projected_solid_angles(), &data.row(row), &q);
    Ok(Formed {
        indicatrix: Indicatrix { basis: data.emergent().clone(), q },
        how: How::Filter { scheme: used, in_force: used == scheme },
        difference: Some(difference),
    })
}

/// Returns the data of the patch or direction nearest to `incident`, compressed like datasets of more than
/// [`LOSSLESS_BELOW`] bytes in the catalogue.
///
/// # Errors
/// Returns the reason if the data cannot be compressed.
pub fn compressed(btdf: &Btdf, incident: Incident) -> Result<Formed, NoForm> {
    if matches!(btdf.scattered, Some(Scattered::Tree(_))) {
        return Err(NoForm::Tree);
    }
    let row = row_of(btdf, incident).ok_or(NoForm::NoValues)?;
    let (basis, rows, values) = match &btdf.scattered {
        Some(Scattered::Cells(matrix)) => (matrix.emergent(), matrix.compact_rows(), matrix.row(row)),
        Some(Scattered::Directions(data)) => (data.emergent(), data.compact_rows(), data.row(row)),
        _ => return Err(NoForm::NoValues),
    };
    let criterion = Criterion::ARCHIVE;
    let how = |kept, in_force| How::Wavelets { kept, cells: basis.len(), allowed: criterion.threshold(), in_force };
    if let Some(rows) = rows {
        let q = values.into_owned();
        let kept = rows.quantised(row).1.count();
        return Ok(Formed {
            indicatrix: Indicatrix { basis: basis.clone(), q },
            how: how(kept, true),
            difference: None,
        });
    }
    let made = CompactRows::compress(basis, 1, |_| values.to_vec(), criterion).map_err(NoForm::Values)?;
    let q = made.row(0);
    let difference = difference(&basis.projected_solid_angles(), &values, &q);
    Ok(Formed {
        indicatrix: Indicatrix { basis: basis.clone(), q },
        how: how(made.numbers(), false),
        difference: Some(difference),
    })
}

/// Returns the difference of processed luminance coefficients (`made`) from the original ones (`given`). `weights`:
/// projected solid angles of the emergent patches. \[sr\]
fn difference(weights: &[f64], given: &[f64], made: &[f64]) -> Difference {
    let tau: f64 = given.iter().zip(weights).map(|(q, w)| q * w).sum();
    let differences = || given.iter().zip(made).map(|(a, b)| (a - b).abs());
    let moved: f64 = differences().zip(weights).map(|(d, w)| d * w).sum();
    Difference {
        largest: differences().fold(0.0, f64::max),
        misplaced: if tau > 0.0 { 0.5 * moved / tau } else { 0.0 },
    }
}

/// Size below which datasets are stored without loss. \[MB\]
pub const LOSSLESS_MEGABYTES: f64 = LOSSLESS_BELOW as f64 / (1 << 20) as f64;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::RingBasis;
    use crate::compute::btdf::{CellMatrix, Indicatrices};
    use crate::compute::direction::Dir;

    /// A lobe that follows the light, on Tregenza's directions.
    fn btdf() -> Btdf {
        let (patches, cells) = (RingBasis::tregenza(), RingBasis::equal_area(40));
        let incident: Vec<Incident> = patches.cells().map(|cell| Incident(cell.centre())).collect();
        let lobe = |a: Dir<_>, b: Dir<_>| 30.0 * (-(a.vector().angle_between(b.vector()) / 0.06_f64).powi(2)).exp();
        let values =
            incident.iter().flat_map(|d| cells.cells().map(|cell| 0.02 + lobe(d.0, cell.centre())).collect::<Vec<_>>());
        let data = Indicatrices::new(incident.clone(), cells.clone(), values.collect()).unwrap();
        Btdf { regular: None, scattered: Some(Scattered::Directions(Arc::new(data))) }
    }

    fn interpolator(btdf: &Btdf) -> Option<Arc<Interpolator>> {
        match &btdf.scattered {
            Some(Scattered::Directions(data)) => Some(Arc::new(Interpolator::new(data.clone()))),
            _ => None,
        }
    }

    fn flux(one: &Indicatrix) -> f64 {
        one.q.iter().zip(one.basis.projected_solid_angles()).map(|(q, w)| q * w).sum()
    }

    #[test]
    fn the_filter_spreads_a_lobe_over_its_patch_and_keeps_its_flux() {
        let btdf = btdf();
        let d = Incident(Dir::from_theta_phi(0.6, 1.2));
        let raw = btdf.indicatrix(d).unwrap();
        let made = filtered(&btdf, d, DiffuseScheme::Auto, || interpolator(&btdf)).unwrap();
        assert_eq!(made.how, How::Filter { scheme: DiffuseScheme::FilterPatch, in_force: false });
        assert!((flux(&made.indicatrix) - btdf.tau(d)).abs() < 1e-6);
        let most = |q: &[f64]| q.iter().copied().fold(0.0, f64::max);
        assert!(most(&made.indicatrix.q) < 0.8 * most(&raw.q));
        let apart = made.difference.unwrap();
        assert!(apart.largest > 0.2 * most(&raw.q) && apart.misplaced > 0.1 && apart.misplaced < 1.0, "{apart:?}");
        let wide = filtered(&btdf, d, DiffuseScheme::FilterWide, || interpolator(&btdf)).unwrap();
        assert_eq!(wide.how, How::Filter { scheme: DiffuseScheme::FilterWide, in_force: true });
        assert!(most(&wide.indicatrix.q) < most(&made.indicatrix.q));
    }

    #[test]
    fn wavelets_keep_few_numbers_within_what_is_allowed() {
        let btdf = btdf();
        let d = Incident(Dir::from_theta_phi(0.6, 1.2));
        let made = compressed(&btdf, d).unwrap();
        let How::Wavelets { kept, cells, allowed, in_force } = made.how else { panic!("{:?}", made.how) };
        assert!(!in_force && kept > 1 && kept < cells / 2, "{kept} of {cells}");
        let apart = made.difference.unwrap();
        assert!(apart.misplaced > 0.0 && apart.misplaced <= allowed + 1e-9 && apart.largest > 0.0, "{apart:?}");
        assert!((flux(&made.indicatrix) / btdf.tau(d) - 1.0).abs() < 1e-6);
        // What is held so already is shown as it is held.
        let Some(Scattered::Directions(data)) = &btdf.scattered else { unreachable!() };
        let held = Arc::new(data.compacted(Criterion::ARCHIVE).unwrap());
        let held = Btdf { regular: None, scattered: Some(Scattered::Directions(held)) };
        let shown = compressed(&held, d).unwrap();
        assert_eq!(shown.indicatrix, held.indicatrix(d).unwrap());
        assert!(matches!(shown.how, How::Wavelets { kept: own, in_force: true, .. } if own == kept), "{:?}", shown.how);
        assert_eq!(shown.difference, None);
    }

    #[test]
    fn means_over_cells_are_not_filtered_and_closed_forms_have_no_values() {
        let d = Incident(Dir::from_theta_phi(0.6, 1.2));
        let cells = RingBasis::tregenza();
        let matrix = CellMatrix::new(cells.clone(), cells, vec![0.1; 145 * 145]).unwrap();
        let means = Btdf::from_cells(matrix);
        let none = || None;
        assert_eq!(filtered(&means, d, DiffuseScheme::Auto, none), Err(NoForm::Means));
        assert!(compressed(&means, d).is_ok());
        let lambert = Btdf::ideal_diffuse(0.5);
        assert_eq!(filtered(&lambert, d, DiffuseScheme::Auto, none), Err(NoForm::NoValues));
        assert_eq!(compressed(&lambert, d), Err(NoForm::NoValues));
    }

    #[test]
    fn a_tree_is_told_to_be_one() {
        use crate::compute::btdf::{TensorTree, TreeAxes, TreeNode, TreeRank};
        let tree = TensorTree::new(TreeRank::Three, TreeAxes::Front, vec![TreeNode::Leaf(0.1)]).unwrap();
        let btdf = Btdf { regular: None, scattered: Some(Scattered::Tree(Box::new(tree))) };
        assert_eq!(compressed(&btdf, Incident(Dir::from_theta_phi(0.5, 0.0))).unwrap_err(), NoForm::Tree);
    }
}

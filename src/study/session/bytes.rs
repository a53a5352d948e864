//! Memory that the tables of stored results take.

use crate::compute::room::direct::Reception;
use crate::compute::room::gather::Reconstruction;
use crate::compute::room::grid::CellWeights;

/// Returns the memory of rows of values. \[bytes\]
pub(super) fn of_rows<T>(rows: &[Vec<T>]) -> usize {
    rows.iter().map(|row| size_of_val(row) + size_of_val(&row[..])).sum()
}

/// Returns the memory of the weights with which a sensor sees the patches of a mesh. \[bytes\]
pub(super) fn of_reconstruction(one: &Reconstruction) -> usize {
    size_of_val(one) + size_of_val(&one.weights[..]) + size_of_val(&one.slopes[..])
}

/// Returns the memory of a sensor's response to the cells of an aperture. \[bytes\]
pub(super) fn of_reception(one: &Reception) -> usize {
    size_of_val(one) + size_of_val(&one.cells[..])
}

/// Returns the memory of the weights with which a sensor sees emergent cells at points of an aperture. \[bytes\]
pub(super) fn of_cells(cells: &CellWeights) -> usize {
    cells.iter().map(|cell| size_of_val(cell) + size_of_val(&cell.1[..])).sum()
}

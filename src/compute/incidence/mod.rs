//! Interpolation between incident directions: from indicatrices (q over the emergent directions) measured at single
//! incident directions to the light of any sun and any sky.
//!
//! The indicatrices of the IEA SHC Task 31 report move and change shape between incident directions 12° apart. Here
//! each is split into a smooth base and a few lobes; every lobe is matched with a lobe at the neighbouring directions,
//! which shows how its centre and its flux change with the incident direction; an indicatrix in between consists of the
//! lobes of the three surrounding directions, each shifted by its response (the change of its centre with the incident
//! direction), and of their bases.
//!
//! | file | content |
//! | --- | --- |
//! | `lattice` | the triangles between incident directions |
//! | `grid` | emergent cells with neighbours, weights and interpolation between them |
//! | `lobes` | division of an indicatrix into base and lobes |
//! | `raster` | a lobe as samples on a square grid, which can be rotated at little cost |
//! | `response` | correspondence of lobes at neighbouring directions, and their responses |
//! | `flux` | interpolation of fluxes between the directions: cubics and kinks |
//! | `grazing` | extrapolation of τ to θ = 90° |
//! | `filter` | filter for diffuse light: spreads each indicatrix over the patch that its incident direction represents
//! |
//! | `model` | the indicatrix of any incident direction |
//! | `superpose` | luminance of the room side under sky and sun |
//! | `schemes` | interpolation schemes of the IEA SHC Task 31 report, for comparison |
//! | `judge` | share of flux in wrong directions between two indicatrices |
//! | `left_out` | accuracy of each scheme, by cross-validation |
//! | `ways` | treatment of the lobes within a triangle of incident directions (shifted, fading, blended), for display |

pub mod filter;
pub mod flux;
pub mod grazing;
pub mod grid;
pub mod judge;
pub mod lattice;
pub mod left_out;
pub mod lobes;
pub mod model;
pub mod raster;
pub mod response;
#[cfg(test)]
mod samples;
pub mod schemes;
pub mod superpose;
#[cfg(test)]
mod synthetic;
#[cfg(test)]
mod tests;
pub mod ways;

//! Between incident directions: from indicatrices at single directions to any sun and any sky.
//!
//! | file | what |
//! | --- | --- |
//! | `lattice` | the triangles between incident directions |
//! | `grid` | emergent cells as a picture |
//! | `lobes` | an indicatrix as base and lobes |
//! | `response` | how lobes move and change with the incidence |
//! | `flux` | fluxes between the directions |
//! | `choice` | which scheme suits which triangle, by leaving out |
//! | `filter` | the matched filter for diffuse light |
//! | `schemes` | other ways between the directions, side by side |
//! | `model` | the indicatrix of any incident direction |

pub mod choice;
pub mod filter;
pub mod flux;
pub mod grazing;
pub mod grid;
pub mod lattice;
pub mod lobes;
pub mod model;
pub mod raster;
pub mod response;
#[cfg(test)]
mod samples;
pub mod schemes;
pub mod superpose;

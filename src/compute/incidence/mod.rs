//! Interpolation between incident directions: from indicatrices at single directions to any sun and any sky.
//!
//! The report's indicatrices move and change shape between incident directions 12° apart. Here each is split into a
//! smooth base and a few lobes; every lobe is followed to the neighbouring directions, which tells how it moves and
//! how its flux changes; an indicatrix in between is made of the lobes of the three directions around, each moved by
//! its own response, and of their bases.
//!
//! | file | what |
//! | --- | --- |
//! | `lattice` | the triangles between incident directions |
//! | `grid` | emergent cells as a picture |
//! | `lobes` | an indicatrix as base and lobes |
//! | `raster` | a lobe as a picture that is cheap to move |
//! | `response` | which lobe is the same one at a neighbour, and how it moves |
//! | `flux` | fluxes between the directions: cubics and kinks |
//! | `grazing` | beyond the last row |
//! | `filter` | the matched filter for diffuse light |
//! | `model` | the indicatrix of any incident direction |
//! | `superpose` | sky and sun through it |
//! | `schemes` | the report's schemes of interpolation beside it |
//! | `judge` | the difference of two indicatrices |
//! | `left_out` | accuracy of each scheme, by leaving directions out |
//! | `ways` | treatment of the lobes between three directions |

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

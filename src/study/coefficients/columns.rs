//! V·T: illuminances at the sensors by incident patch of one aperture, and the table that they make with the outside.

use super::described::Described;
use super::transport::{ACROSS, Column, Transport};
use super::views::{Opening, Views, Want};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::dot::add_scaled;
use crate::compute::quadrature::gauss_legendre;
use crate::study::error::StudyError;
use crate::study::session::sky_patches::SkyPatches;
use faer::Mat;
use rayon::prelude::*;

/// Number of incident patches whose columns are in memory together. Chosen: cost only, no effect on results.
const TOGETHER: usize = 64;

/// Illuminances at the sensors per illuminance through each incident patch, without direct light by regular
/// transmission.
pub(super) struct Columns<'a> {
    patches: &'a RingBasis,
    /// Number of illuminances in a row, see [`Opening::places`].
    places: usize,
    described: Option<&'a Described>,
    transport: &'a Transport,
    /// Regular transmission, whose interreflections are among the illuminances, with the responses of the sensors to
    /// luminances of the patches.
    straight: Option<(&'a AngularTransmittance, Views)>,
}

impl<'a> Columns<'a> {
    /// Prepares the columns of an aperture. `described`: scattered light of a description; without it that of the data
    /// (`transport`); `regular`: regular transmittance of the system.
    pub fn new(
        opening: &Opening<'_>,
        (described, transport): (Option<&'a Described>, &'a Transport),
        patches: &'a RingBasis,
        regular: Option<&'a AngularTransmittance>,
    ) -> Result<Self, StudyError> {
        // Direct light by regular transmission is computed separately.
        let straight = match (regular, opening.room) {
            (Some(tau), Some(_)) => Some((tau, Views::new(opening, patches.clone().into(), Want::Reflected)?)),
            _ => None,
        };
        Ok(Self { patches, places: opening.places(), described, transport, straight })
    }

    /// Returns the number of incident patches.
    pub fn count(&self) -> usize {
        self.patches.len()
    }

    /// Returns the relative gap of flux of the interreflection of regular transmission.
    pub fn gap(&self) -> f64 {
        self.straight.as_ref().map_or(0.0, |(_, views)| views.gap)
    }

    /// Computes the columns of all patches and passes each to `put`, in the order of the patches.
    pub fn each(&self, mut put: impl FnMut(usize, &Column)) {
        let across = gauss_legendre(ACROSS);
        let column = |p: usize| {
            let cell = self.patches.cell(p);
            let mut column = match self.described {
                Some(described) => described.through_patch(p),
                None => self.transport.through_patch(p, &cell, self.places),
            };
            if let Some((tau, views)) = &self.straight {
                // Regular transmission leaves by the patch that it entered through, as a luminance uniform over it.
                let passed = tau.ring_mean(cell.theta_min, cell.theta_max, &across);
                views.add(p, passed / cell.projected_solid_angle(), &mut column.light);
            }
            column
        };
        for first in (0..self.count()).step_by(TOGETHER) {
            let block = first..(first + TOGETHER).min(self.count());
            let found: Vec<Column> = block.into_par_iter().map(column).collect();
            found.iter().enumerate().for_each(|(k, column)| put(first + k, column));
        }
    }

    /// Returns the table of an aperture all of whose points see the same patches of the outside: a column for each
    /// patch that reaches above the horizon, one for the ground and one for the skyline; rows as in [`Column`].
    pub fn table(&self, sky: &SkyPatches) -> Mat<f32> {
        // Patches wholly under the horizon hold ground and skyline only, and need no column of the sky.
        let open = sky.samples.cells();
        let width = open.len() + 2;
        // Only lobes between directions have an uncertainty of interpolation: others save the fourth table.
        let rows = self.places * if self.transport.estimates_uncertainty() { 4 } else { 3 };
        let mut table = Mat::zeros(rows, width);
        let mut put = |to: usize, light: &mut dyn Iterator<Item = f64>| {
            table.col_as_slice_mut(to).iter_mut().zip(light).for_each(|(to, e): (&mut f32, f64)| *to = e as f32);
        };
        // Both are uniform, whatever the sky: summed over all patches now, a new sky needs their two luminances alone.
        let shares = [&sky.ground, &sky.skyline];
        let mut uniform = shares.map(|_| vec![0.0; rows]);
        let mut open = open.iter().enumerate().peekable();
        self.each(|p, column| {
            if let Some((to, _)) = open.next_if(|(_, open)| **open == p) {
                put(to, &mut column.light.iter().chain(&column.difference).copied());
            }
            for (sum, shares) in uniform.iter_mut().zip(shares) {
                let (light, difference) = sum.split_at_mut(3 * self.places);
                add_scaled(light, &column.light, shares[p]);
                add_scaled(difference, &column.difference, shares[p]);
            }
        });
        uniform.into_iter().enumerate().for_each(|(k, sum)| put(width - 2 + k, &mut sum.into_iter()));
        table
    }
}

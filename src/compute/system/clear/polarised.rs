//! Polarised light at a surface between clear materials: Stokes parameters, Fresnel's equations with the phases of
//! total reflection.

use crate::compute::system::panes::glazing::{Pane, fresnel};
use glam::DVec3;

/// Stokes parameters of a beam with fields E_s and E_p along the unit vectors s and p = k × s/|k| (k: wave vector): I =
/// |E_s|² + |E_p|², Q = |E_s|² − |E_p|², U + iV = 2 E_s E_p*.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stokes {
    /// Flux I of the light, as a share of the incident flux.
    pub i: f64,
    /// Stokes parameter Q: flux polarised along s minus that along p.
    pub q: f64,
    /// Stokes parameter U: flux polarised at +45° between s and p minus that at −45°.
    pub u: f64,
    /// Stokes parameter V: excess of one sense of circular polarisation over the other, in flux.
    pub v: f64,
}

impl Stokes {
    /// Creates the Stokes parameters of unpolarised light of the given flux.
    pub const fn unpolarised(flux: f64) -> Self {
        Self { i: flux, q: 0.0, u: 0.0, v: 0.0 }
    }

    /// Returns the Stokes parameters multiplied by a factor.
    pub fn scaled(self, factor: f64) -> Self {
        Self { i: self.i * factor, q: self.q * factor, u: self.u * factor, v: self.v * factor }
    }

    /// Returns the Stokes parameters in a frame rotated by the angle of the given cosine and sine: s′ = cos · s + sin ·
    /// p.
    fn turned(self, cos: f64, sin: f64) -> Self {
        let (cos2, sin2) = (cos * cos - sin * sin, 2.0 * cos * sin);
        Self { i: self.i, q: cos2 * self.q + sin2 * self.u, u: cos2 * self.u - sin2 * self.q, v: self.v }
    }

    /// Returns the Stokes parameters after a surface: `s` and `p` are its reflectances (or transmittances) for both
    /// polarisations, `product` the complex product r_s r_p* (or t_s t_p*).
    fn through(self, s: f64, p: f64, product: [f64; 2]) -> Self {
        let (half, gap) = (0.5 * (s + p), 0.5 * (s - p));
        let [re, im] = product;
        Self {
            i: half * self.i + gap * self.q,
            q: gap * self.i + half * self.q,
            u: re * self.u - im * self.v,
            v: im * self.u + re * self.v,
        }
    }
}

/// Polarised light of a beam: Stokes parameters with the unit vector s that they refer to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PolarisedLight {
    /// Stokes parameters of the light with respect to `s`.
    pub stokes: Stokes,
    /// Unit vector s, perpendicular to the wave vector.
    pub s: DVec3,
}

impl PolarisedLight {
    /// Creates unpolarised light of flux 1 with wave vector `k`.
    pub fn unpolarised(k: DVec3) -> Self {
        Self { stokes: Stokes::unpolarised(1.0), s: k.any_orthogonal_vector().normalize_or(DVec3::X) }
    }

    /// Returns the light with its Stokes parameters referred to a surface with normal `normal`: s is perpendicular to
    /// the plane of incidence. At normal incidence any frame is right.
    fn in_frame_of(self, k: DVec3, normal: DVec3) -> Self {
        let across = k.cross(normal);
        let length2 = across.length_squared();
        if length2 < 1e-20 {
            return self;
        }
        let s = across / length2.sqrt();
        let p = k.cross(self.s) / k.length();
        Self { stokes: self.stokes.turned(self.s.dot(s), p.dot(s)), s }
    }
}

/// Reflected and transmitted part of light at a surface between two clear materials.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Divided {
    /// Reflected light.
    pub reflected: PolarisedLight,
    /// Transmitted light; `None` in total reflection.
    pub transmitted: Option<PolarisedLight>,
    /// Magnitudes of the wave vector's component normal to the surface, in front of the surface and behind it (0 in
    /// total reflection).
    pub normal: [f64; 2],
}

/// Divides light with wave vector `k` at the surface between its material, of squared refractive index `n2`, and one of
/// squared index `beyond2`. `normal` is the surface's unit normal against the light.
pub(super) fn divide(light: PolarisedLight, k: DVec3, normal: DVec3, n2: f64, beyond2: f64) -> Divided {
    let light = light.in_frame_of(k, normal);
    let before = (-k.dot(normal)).max(0.0);
    let behind2 = beyond2 - n2 + before * before;
    let with = |stokes| PolarisedLight { stokes, s: light.s };
    if behind2 <= 0.0 {
        // r_s = (a − ib)/(a + ib), r_p = (β a − i n² b)/(β a + i n² b): of modulus 1, apart in phase.
        let evanescent = (-behind2).sqrt();
        // r_s r_p* = w²/|w|², w = (a − ib)(β a + i n² b).
        let (field_s, field_p) = ([before, evanescent], [beyond2 * before, n2 * evanescent]);
        let re = field_s[0] * field_p[0] + field_s[1] * field_p[1];
        let im = field_s[0] * field_p[1] - field_s[1] * field_p[0];
        let scale = 1.0 / (re * re + im * im).max(f64::MIN_POSITIVE);
        let product = [(re * re - im * im) * scale, 2.0 * re * im * scale];
        return Divided {
            reflected: with(light.stokes.through(1.0, 1.0, product)),
            transmitted: None,
            normal: [before, 0.0],
        };
    }
    let behind = behind2.sqrt();
    let rs = (before - behind) / (before + behind);
    let rp = (beyond2 * before - n2 * behind) / (beyond2 * before + n2 * behind);
    let (share_s, share_p) = (rs * rs, rp * rp);
    let passed = ((1.0 - share_s) * (1.0 - share_p)).sqrt();
    Divided {
        reflected: with(light.stokes.through(share_s, share_p, [rs * rp, 0.0])),
        transmitted: Some(with(light.stokes.through(1.0 - share_s, 1.0 - share_p, [passed, 0.0]))),
        normal: [before, behind],
    }
}

/// Computes the effect of a plane-parallel pane in air on polarised light, all its inner reflections summed, at the
/// polar angle `theta` \[rad\]: for transmission and for reflection, the shares of both polarisations s and p, and the
/// product of their field factors.
///
/// On every path the fields gather factors t_s t_p or r_s r_p that are real, so that the product sums as the shares
/// do, by the same geometric series.
fn pane(pane: &Pane, theta: f64) -> [[f64; 3]; 2] {
    let shares = pane.polarised(theta);
    let ([rs, rp], inner) = fresnel(pane.index, theta);
    let cos = theta.cos().max(0.0);
    // Signs of the fields' reflection: s always against, p changes at Brewster's angle.
    let sign = (cos - pane.index * inner) * (pane.index * cos - inner);
    let both = (rs * rp).sqrt() * sign.signum();
    let through = ((1.0 - rs) * (1.0 - rp)).sqrt();
    let passed = pane.internal(inner);
    let product = if 1.0 - both.abs() < 1e-12 {
        [0.0, both.signum()]
    } else {
        let transmitted = through * through * passed / (1.0 - (both * passed).powi(2));
        [transmitted, both * (1.0 + passed * transmitted)]
    };
    [
        [shares[0].transmitted, shares[1].transmitted, product[0]],
        [shares[0].reflected_front, shares[1].reflected_front, product[1]],
    ]
}

/// Returns the light that a pane parallel to the façade transmits and reflects, for light with wave vector `k` (z: the
/// pane's normal).
pub(super) fn at_pane(light: PolarisedLight, k: DVec3, sheet: &Pane) -> [PolarisedLight; 2] {
    let normal = DVec3::new(0.0, 0.0, -k.z.signum());
    let light = light.in_frame_of(k, normal);
    let theta = k.truncate().length().atan2(k.z.abs());
    pane(sheet, theta)
        .map(|[s, p, product]| PolarisedLight { stokes: light.stokes.through(s, p, [product, 0.0]), s: light.s })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(theta: f64, phi: f64, index: f64) -> DVec3 {
        index * DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), -theta.cos())
    }

    /// Outward normal of the surfaces of the tests.
    const UP: DVec3 = DVec3::Z;

    #[test]
    fn shares_are_fresnels() {
        for degrees in [0.0, 20.0, 56.66, 75.0, 89.0] {
            let theta = f64::to_radians(degrees);
            let k = wave(theta, 0.7, 1.0);
            let divided = divide(PolarisedLight::unpolarised(k), k, UP, 1.0, 1.52_f64.powi(2));
            let ([s, p], _) = fresnel(1.52, theta);
            assert!((divided.reflected.stokes.i - 0.5 * (s + p)).abs() < 1e-14, "{degrees}");
            assert!((divided.reflected.stokes.q - 0.5 * (s - p)).abs() < 1e-14);
            assert!((divided.transmitted.unwrap().stokes.i + divided.reflected.stokes.i - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn fresnels_rhomb_makes_light_circular() {
        // Fresnel's rhomb: two total reflections at 54°37′ in glass of 1.51 turn linear light at 45° circular.
        let (theta, n) = (f64::to_radians(54.0 + 37.0 / 60.0), 1.51);
        let k = wave(theta, 0.5 * std::f64::consts::PI, n);
        let s = k.cross(UP).normalize();
        let linear = PolarisedLight { stokes: Stokes { i: 1.0, q: 0.0, u: 1.0, v: 0.0 }, s };
        let once = divide(linear, k, UP, n * n, 1.0);
        assert!(once.transmitted.is_none());
        let back = DVec3::new(k.x, k.y, -k.z);
        let twice = divide(once.reflected, back, -UP, n * n, 1.0).reflected.stokes;
        assert!(
            (twice.i - 1.0).abs() < 1e-14 && twice.u.abs() < 3e-3 && (twice.v.abs() - 1.0).abs() < 1e-4,
            "{twice:?}"
        );
    }

    #[test]
    fn turning_the_frame_keeps_the_light() {
        let light = Stokes { i: 1.0, q: 0.3, u: -0.4, v: 0.5 };
        let there = light.turned(0.6, 0.8);
        let back = there.turned(0.6, -0.8);
        assert!((back.q - light.q).abs() < 1e-15 && (back.u - light.u).abs() < 1e-15);
        assert!((there.q.hypot(there.u) - light.q.hypot(light.u)).abs() < 1e-15);
    }

    #[test]
    fn a_pane_is_the_sum_of_its_paths() {
        let sheet = Pane { index: 1.6, thickness: 0.01, absorption: 15.0 };
        for degrees in [0.0, 35.0, 62.0, 85.0] {
            let theta = f64::to_radians(degrees);
            let k = wave(theta, 1.1, 1.0);
            // Light that is not the pane's own: partly linear in another frame, partly circular.
            let light =
                PolarisedLight { stokes: Stokes { i: 1.0, q: 0.2, u: 0.6, v: -0.3 }, ..PolarisedLight::unpolarised(k) };
            let [through, back] = at_pane(light, k, &sheet);
            let n2 = sheet.index * sheet.index;
            let first = divide(light, k, UP, 1.0, n2);
            let (inner_cos, passed) = (first.normal[1] / sheet.index, sheet.internal(first.normal[1] / sheet.index));
            assert!(inner_cos > 0.0);
            let (mut sum, mut returned) = ([0.0; 4], [0.0; 4]);
            let add = |to: &mut [f64; 4], s: Stokes| {
                for (to, part) in to.iter_mut().zip([s.i, s.q, s.u, s.v]) {
                    *to += part;
                }
            };
            add(&mut returned, first.reflected.stokes);
            let mut inside = first.transmitted.unwrap();
            let mut inner = DVec3::new(k.x, k.y, -first.normal[1]);
            for bounce in 0..60 {
                inside.stokes = inside.stokes.scaled(passed);
                let normal = if bounce % 2 == 0 { UP } else { -UP };
                let next = divide(inside, inner, normal, n2, 1.0);
                let out = next.transmitted.unwrap().stokes;
                if bounce % 2 == 0 {
                    add(&mut sum, out);
                } else {
                    add(&mut returned, out);
                }
                inside = next.reflected;
                inner.z = -inner.z;
            }
            for (found, exact) in [(through.stokes, sum), (back.stokes, returned)] {
                let found = [found.i, found.q, found.u, found.v];
                for k in 0..4 {
                    assert!((found[k] - exact[k]).abs() < 1e-10, "{degrees} {k}: {found:?} {exact:?}");
                }
            }
        }
    }
}

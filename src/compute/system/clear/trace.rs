//! Tracing of all beams that light of one incident direction is divided into.

use super::beam::{Axes, Front, WideBeam};
use super::hit::{Hit, extent, nearest};
use super::polarised::{PolarisedLight, at_pane, divide};
use super::section::{ClearSection, Region};
use crate::compute::sequence::Random;
use crate::compute::system::measure::beams::Effort;
use glam::{DVec2, DVec3};

/// Beam that leaves the section, transmitted or reflected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leaving {
    /// Share of the incident flux that the beam carries.
    pub share: f64,
    /// Direction cosine of the beam's travel along y (upward); that along x is the one of the incident light.
    pub y: f64,
    /// Direction cosine of the beam's travel along z, positive outwards.
    pub z: f64,
    /// Derivatives of `y` with respect to the incident light's direction cosines along x and y.
    pub change: [f64; 2],
}

/// Result of a trace: the light of one incident direction after the section, averaged over the heights at which it
/// meets the section.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Emission {
    /// Beams that leave, in no particular order.
    pub leaving: Vec<Leaving>,
    /// Share of the incident flux that is absorbed, including `lost`.
    pub absorbed: f64,
    /// Share of the incident flux whose tracing was given up: light still caught between total reflections after very
    /// many surfaces, which the least absorption would remove, and rounding errors at corners. It counts as an error of
    /// all shares.
    pub lost: f64,
    /// Number of surfaces that all beams together were traced to, a measure of the cost.
    pub surfaces: u32,
    /// Buffer of beams that are still to be traced; empty between traces.
    waiting: Vec<WideBeam>,
}

impl Emission {
    fn clear(&mut self) {
        self.leaving.clear();
        (self.absorbed, self.lost, self.surfaces) = (0.0, 0.0, 0);
    }
}

/// Factor on the maximum number of surfaces of [`Effort`] up to which the beams of one direction are followed
/// separately. Chosen: cost; beyond it one beam represents all without bias, so that results change within their stated
/// error. Held by `tests/compute/goniophotometer_glass.rs::less_effort_means_more_noise_but_no_bias`.
const SURFACE_FACTOR: u32 = 10;
/// Number of surfaces after which the tracing of light is given up. Chosen: cost; the light given up is part of the
/// stated error. Held by `tests/compute/goniophotometer_glass.rs::light_in_steep_grooves_ends`: on average at most 2 %
/// in steep grooves.
const MOST_SURFACES: u32 = 2000;
/// Flux below which a beam counts as absorbed: caught between total reflections in absorbing material, all of it is
/// absorbed in the end. Chosen: some 50 roundings of f64 (2⁻⁵² ≈ 2.2e-16) of the incident flux, which is 1.
const FAINT: f64 = 1e-14;
/// Fraction of the smallest divided share below which a part of a beam is traced only with a probability, then with
/// more flux. Chosen: cost; both parts keep their mean flux, so that results change within their stated error.
const NEGLIGIBLE: f64 = 1e-3;

/// Returns a random number in 0 … 1, made from all 64 bits; stored results depend on these exact numbers.
const fn drawn(random: &mut Random) -> f64 {
    random.bits() as f64 / (1_u128 << 64) as f64
}

impl ClearSection {
    /// Traces unpolarised light that travels along `direction` (x, y, z; unit length, z not 0) into `out`, which is
    /// emptied first.
    pub fn trace(&self, direction: DVec3, effort: Effort, out: &mut Emission) {
        out.clear();
        let stack = std::mem::take(&mut out.waiting);
        let mut work = Work { section: self, share: effort.share, random: Random(effort.seed), stack, out };
        let most = effort.surfaces.saturating_mul(SURFACE_FACTOR);
        let beam = self.incident(direction);
        work.meet_pane(beam, usize::from(direction.z > 0.0), true);
        while let Some(beam) = work.stack.pop() {
            work.share = effort.share_after(work.out.surfaces);
            let beam = if work.out.surfaces > most { work.one_of_all(beam) } else { beam };
            work.follow(beam);
        }
        let stack = std::mem::take(&mut work.stack);
        out.waiting = stack;
    }

    /// Returns the incident light with wave vector `k` as a beam in front of the section, one period high.
    fn incident(&self, k: DVec3) -> WideBeam {
        let axes = Axes::new(k);
        let z = if k.z < 0.0 { self.depth[1] + 0.5 } else { self.depth[0] - 0.5 };
        let front = Front::new(&axes, [DVec2::new(z, 0.0), DVec2::new(z, 1.0)]);
        let change = [DVec2::new(-k.x / k.z, 0.0), DVec2::new(-k.y / k.z, 1.0)];
        WideBeam { region: 0, k, light: PolarisedLight::unpolarised(k), front, change, surfaces: 0 }
    }
}

/// Parts of a beam that are too small to be traced separately: one of them, chosen at random in proportion to its flux,
/// represents all of them. Their flux is kept exactly.
#[derive(Default)]
struct Handful {
    /// Border that the representative part meets; `range` is that part's extent across the beam.
    hit: Option<Hit>,
    range: [f64; 2],
    /// Flux of all parts together, as a share of the incident flux.
    flux: f64,
}

impl Handful {
    fn add(&mut self, hit: Option<Hit>, range: [f64; 2], flux: f64, random: &mut Random) {
        self.flux += flux;
        if drawn(random) * self.flux < flux {
            (self.hit, self.range) = (hit, range);
        }
    }
}

struct Work<'a> {
    section: &'a ClearSection,
    /// Minimum share of the incident flux that a beam must carry to be divided, at the current number of surfaces.
    share: f64,
    random: Random,
    stack: Vec<WideBeam>,
    out: &'a mut Emission,
}

impl Work<'_> {
    /// Returns one of all remaining beams, chosen at random in proportion to its flux, with the flux of all; it is not
    /// divided any more.
    fn one_of_all(&mut self, last: WideBeam) -> WideBeam {
        self.share = f64::INFINITY;
        let (mut chosen, mut flux) = (last, last.light.stokes.i);
        while let Some(beam) = self.stack.pop() {
            flux += beam.light.stokes.i;
            if drawn(&mut self.random) * flux < beam.light.stokes.i {
                chosen = beam;
            }
        }
        whole(chosen, flux)
    }

    /// Traces a beam to all surfaces that it meets, and adds the beams that arise there.
    fn follow(&mut self, mut beam: WideBeam) {
        let section = self.section;
        let region = &section.regions[beam.region];
        if beam.light.stokes.i < FAINT {
            self.out.absorbed += beam.light.stokes.i;
            return;
        }
        if beam.surfaces > MOST_SURFACES {
            self.lose(beam.light.stokes.i);
            return;
        }
        let axes = Axes::new(beam.k);
        let [[c0, _], [c1, _]] = beam.front.ends;
        let width = beam.front.width();
        if beam.light.stokes.i < self.share || width < 1e-9 {
            // A single ray, anywhere in the beam.
            let c = if width > 0.0 { c0 + width * drawn(&mut self.random) } else { c0 };
            let place = [c, beam.front.at(c)];
            beam.front.ends = [place, place];
            self.out.surfaces += 1;
            let hit = nearest(region, &axes, &beam.front, c);
            self.surface(&beam, &axes, region, hit.as_ref(), [c, c], beam.light.stokes.i);
            return;
        }
        let mut c = c0;
        let mut left = beam.light.stokes.i;
        let mut small = Handful::default();
        while c1 - c > 1e-10 * width {
            self.out.surfaces += 1;
            let probe = c + (1e-9_f64).min(0.5 * (c1 - c));
            let hit = nearest(region, &axes, &beam.front, probe);
            let mut end = extent(region, &axes, &beam.front, probe, hit.as_ref());
            if c1 - end <= 1e-9 {
                end = c1;
            }
            let flux = if end == c1 { left } else { beam.light.stokes.i * ((end - c) / width) };
            left -= flux;
            if flux >= self.share {
                self.surface(&beam, &axes, region, hit.as_ref(), [c, end], flux);
            } else if flux > 0.0 {
                small.add(hit, [c, end], flux, &mut self.random);
                if small.flux >= self.share {
                    self.one_of(&beam, &axes, region, &mut small);
                }
            }
            c = end;
        }
        self.one_of(&beam, &axes, region, &mut small);
    }

    /// Traces one ray that represents all small parts of a beam.
    fn one_of(&mut self, beam: &WideBeam, axes: &Axes, region: &Region, small: &mut Handful) {
        let Handful { hit, range, flux } = std::mem::take(small);
        let c = range[0] + (range[1] - range[0]) * drawn(&mut self.random);
        self.surface(beam, axes, region, hit.as_ref(), [c, c], flux);
    }

    /// Divides the part of a beam between the coordinates `range` across it, with flux `flux`, at the surface `hit`
    /// that it meets there.
    fn surface(
        &mut self,
        beam: &WideBeam,
        axes: &Axes,
        region: &Region,
        hit: Option<&Hit>,
        range: [f64; 2],
        flux: f64,
    ) {
        if flux <= 0.0 {
            return;
        }
        let mut light = beam.light;
        light.stokes = light.stokes.scaled(flux / light.stokes.i);
        let Some(hit) = hit else {
            if beam.region == 0 {
                let ends = range.map(|c| axes.place([c, beam.front.at(c)]));
                let front = Front::new(axes, ends);
                let towards = usize::from(beam.k.z < 0.0);
                self.meet_pane(WideBeam { light, front, ..*beam }, towards, false);
            } else {
                self.lose(flux);
            }
            return;
        };
        if region.absorption > 0.0 {
            let kept = mean_transmittance(region, beam, range.map(|c| hit.at(c) - beam.front.at(c)));
            self.out.absorbed += flux * (1.0 - kept);
            light.stokes = light.stokes.scaled(kept);
        }
        let normal = DVec3::new(0.0, hit.normal.y, hit.normal.x);
        let beyond2 = self.section.regions[hit.beyond].n2;
        let divided = divide(light, beam.k, normal, region.n2, beyond2);
        let [before, behind] = divided.normal;
        let places = range.map(|c| axes.place([c, hit.at(c)]) - DVec2::new(0.0, hit.copy as f64));
        // Sheets extend without end; keep near the origin.
        let floor = places[0].y.floor();
        let confined = self.section.regions[hit.beyond].confined || region.confined;
        let places = if confined { places } else { places.map(|place| place - DVec2::new(0.0, floor)) };
        let child = |k: DVec3, region: usize, light: PolarisedLight, change: [DVec2; 2]| WideBeam {
            region,
            k,
            light,
            front: Front::new(&Axes::new(k), places),
            change,
            surfaces: beam.surfaces + 1,
        };
        let slopes = beam.change.map(|change| -change.dot(hit.normal));
        let flux = [divided.reflected.stokes.i, divided.transmitted.map_or(0.0, |through| through.stokes.i)];
        let [back, on] = if flux[1] > 0.0 { self.followed(flux) } else { flux };
        if back > 0.0 {
            let change = [0, 1].map(|i| beam.change[i] + 2.0 * slopes[i] * hit.normal);
            let reflected = child(beam.k + 2.0 * before * normal, beam.region, divided.reflected, change);
            self.stack.push(whole(reflected, back));
        }
        if let Some(through) = divided.transmitted
            && on > 0.0
        {
            let ratio = before / behind;
            let change = [0, 1].map(|i| beam.change[i] + slopes[i] * (1.0 - ratio) * hit.normal);
            let transmitted = child(beam.k + (before - behind) * normal, hit.beyond, through, change);
            self.stack.push(whole(transmitted, on));
        }
    }

    /// Returns the flux with which two parts of a beam, of flux `a` and `b`, are traced: if they are small, one of
    /// them, chosen at random, with the flux of both and the other with 0. The mean of each part's flux stays
    /// unchanged.
    fn followed(&mut self, [a, b]: [f64; 2]) -> [f64; 2] {
        let total = a + b;
        let least = NEGLIGIBLE * self.share;
        if total < self.share {
            if drawn(&mut self.random) * total < a { [total, 0.0] } else { [0.0, total] }
        } else if a < least {
            // A trifle: followed seldom, with more flux then.
            if drawn(&mut self.random) * least < a { [least, total - least] } else { [0.0, total] }
        } else if b < least {
            if drawn(&mut self.random) * least < b { [total - least, least] } else { [total, 0.0] }
        } else {
            [a, b]
        }
    }

    /// Divides a beam in the air at the outer (`side` 0) or inner (1) pane; `inwards`: the beam travels towards the
    /// room.
    fn meet_pane(&mut self, beam: WideBeam, side: usize, inwards: bool) {
        let Some(pane) = self.section.panes[side] else {
            if inwards {
                self.stack.push(beam);
            } else {
                self.leave(&beam);
            }
            return;
        };
        let before = beam.light.stokes.i;
        let [through, back] = at_pane(beam.light, beam.k, &pane);
        self.out.absorbed += before - through.stokes.i - back.stokes.i;
        let through = WideBeam { light: through, surfaces: beam.surfaces + 1, ..beam };
        // Reflected at a distance that does not matter: on average every height is as likely.
        let k = DVec3::new(beam.k.x, beam.k.y, -beam.k.z);
        let axes = Axes::new(beam.k);
        let places = beam.front.ends.map(|end| axes.place(end));
        let back = WideBeam {
            light: back,
            k,
            front: Front::new(&Axes::new(k), places),
            change: beam.change.map(|change| DVec2::new(-change.x, change.y)),
            surfaces: beam.surfaces + 1,
            ..beam
        };
        if inwards {
            self.leave(&back);
            self.stack.push(through);
        } else if before < self.share {
            // Weak light takes one of both ways, or weaker and weaker parts would travel between two panes.
            let total = through.light.stokes.i + back.light.stokes.i;
            if drawn(&mut self.random) * total < through.light.stokes.i {
                self.leave(&whole(through, total));
            } else if total > 0.0 {
                self.stack.push(whole(self.behind(back), total));
            }
        } else {
            self.leave(&through);
            self.stack.push(self.behind(back));
        }
    }

    /// Returns a beam that a pane reflects back to the bodies, started outside the depths that they occupy.
    fn behind(&self, beam: WideBeam) -> WideBeam {
        let axes = Axes::new(beam.k);
        let [low, high] = self.section.depth;
        let z = if beam.k.z < 0.0 { high + 0.5 } else { low - 0.5 };
        let places = beam.front.ends.map(|end| {
            let place = axes.place(end);
            // There and back: the lateral way of both passages.
            let way = 2.0 * (z - place.x).abs() * axes.along.y / axes.along.x.abs();
            DVec2::new(place.x, place.y + way)
        });
        let shift = places[0].y.floor();
        let places = places.map(|place| {
            let along = (z - place.x) / axes.along.x;
            DVec2::new(z, place.y + along * axes.along.y - shift)
        });
        WideBeam { front: Front::new(&axes, places), ..beam }
    }

    fn lose(&mut self, flux: f64) {
        self.out.lost += flux;
        self.out.absorbed += flux;
    }

    fn leave(&mut self, beam: &WideBeam) {
        let (share, k) = (beam.light.stokes.i, beam.k);
        if share > 0.0 {
            self.out.leaving.push(Leaving { share, y: k.y, z: k.z, change: beam.change.map(|change| change.y) });
        }
    }
}

/// Returns the beam with its flux set to `flux`, so that it represents other beams too.
fn whole(mut beam: WideBeam, flux: f64) -> WideBeam {
    if beam.light.stokes.i <= 0.0 {
        return beam;
    }
    beam.light.stokes = beam.light.stokes.scaled(flux / beam.light.stokes.i);
    beam
}

/// Returns the internal transmittance of a region, averaged over a beam whose two edges travel the given `lengths` in
/// the section. \[periods\]
///
/// The light that is left is assumed to be uniformly distributed across the beam, which is exact for weak absorption or
/// parallel borders.
fn mean_transmittance(region: &Region, beam: &WideBeam, lengths: [f64; 2]) -> f64 {
    // The true way is longer than its section.
    let slant = region.n2.sqrt() / DVec2::new(beam.k.y, beam.k.z).length();
    let [a, b] = lengths.map(|length| length.max(0.0) * slant * region.absorption);
    let (mean, half) = (0.5 * (a + b), 0.5 * (b - a).abs());
    // sinh(h)/h
    let spread = if half < 1e-3 { 1.0 + half * half / 6.0 } else { half.sinh() / half };
    ((-mean).exp() * spread).min(1.0)
}

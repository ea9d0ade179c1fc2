//! What a surface scatters at one hit: up to eight weighted BSDFs, each in a frame of its own.
//!
//! Masks, blends, two-sided materials, normal maps and coats become this list. Its frame is that of the interpolated
//! shading normal; each BSDF may see it turned over (two-sided) or turned by a normal map, or both, and through a coat.

use arrayvec::ArrayVec;
use glam::{Mat3, Vec2, Vec3};

use super::coat::{self, Coat, Layer};
use super::{Bsdf, BsdfEval, BsdfFeatures, BsdfSample, albedo};
use crate::color::{Rgb, Split};

/// The most BSDFs that one hit may have.
pub const MOST_LOBES: usize = 8;

/// The most coats that one hit may have.
pub const MOST_COATS: usize = 4;

/// All that scatters at a hit, for one `wo`.
#[derive(Clone, Debug, Default)]
pub struct Lobes<'a> {
    lobes: ArrayVec<Lobe<'a>, MOST_LOBES>,
    /// What their normal maps do. Apart from the lobes, which most scenes need alone and which are copied at every hit.
    maps: ArrayVec<Perturbation, MOST_LOBES>,
    coats: ArrayVec<Coat<'a>, MOST_COATS>,
}

/// One BSDF with its share.
#[derive(Clone, Copy, Debug)]
struct Lobe<'a> {
    /// What `f` is multiplied by: positive; the sum over all lobes that are no coat's reflection is at most 1.
    weight: f32,
    /// In proportion to it the lobe is chosen: its weight, which a coat divides between itself and what it covers.
    chance: f32,
    before: bool,
    after: bool,
    /// Which of `maps` is this lobe's, counted from 1; 0 for none.
    map: u8,
    /// Which of `coats` covers it, counted from 1; 0 for none.
    coat: u8,
    bsdf: Bsdf<'a>,
}

/// From the frame of the hit to that of a BSDF: first perhaps over, then by a normal map, then perhaps over.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turn {
    /// A two-sided material around the normal map turns the surface over.
    pub before: bool,
    /// What the normal map does.
    pub map: Option<Perturbation>,
    /// A two-sided material inside the normal map turns the surface over.
    pub after: bool,
}

/// A normal that a map has turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Perturbation {
    /// Columns: the axes of the turned frame in the frame of the hit; z is the normal.
    axes: Mat3,
    /// α² of the shadowing; 0 for none.
    alpha2: f32,
}

impl Perturbation {
    /// The frame around the normal `n` (not zero, not necessarily unit) whose x axis leans towards that of the hit.
    /// With `shadowing`, light fades out towards the terminator as on a rough surface whose slopes the map shows
    /// (Conty Estevez, Lecocq and Stein 2019, eqs. 2 and 3).
    pub fn new(n: Vec3, shadowing: bool) -> Self {
        let z = n.try_normalize().unwrap_or(Vec3::Z);
        let x = (Vec3::X - z * z.x).try_normalize().unwrap_or(Vec3::NEG_Z);
        let alpha2 = if shadowing { (0.125 * tan2(z)).min(1.0) } else { 0.0 };
        Self { axes: Mat3::from_cols(x, z.cross(x), z), alpha2 }
    }
}

/// tan² of the angle to the z axis.
fn tan2(v: Vec3) -> f32 {
    (1.0 - v.z * v.z).max(0.0) / (v.z * v.z)
}

#[inline]
fn over(v: Vec3, turned: bool) -> Vec3 {
    if turned { Vec3::new(v.x, v.y, -v.z) } else { v }
}

impl Lobe<'_> {
    #[inline]
    fn is_turned(&self) -> bool {
        self.before || self.after || self.map != 0 || self.coat != 0
    }

    #[inline]
    fn is_plain(&self) -> bool {
        self.weight == 1.0 && !self.after && self.map == 0 && self.coat == 0
    }
}

impl Turn {
    /// A direction of the hit in the frame of the BSDF; `None` where the map's normal and the shading normal see it from
    /// different sides.
    #[inline]
    fn to_lobe(self, v: Vec3) -> Option<Vec3> {
        let v = over(v, self.before);
        let turned = match &self.map {
            Some(map) => map.axes.transpose() * v,
            None => v,
        };
        (self.map.is_none() || v.z * turned.z > 0.0).then(|| over(turned, self.after))
    }

    /// The other way.
    #[inline]
    fn to_hit(self, v: Vec3) -> Option<Vec3> {
        let turned = over(v, self.after);
        let v = match &self.map {
            Some(map) => (map.axes * turned).normalize(),
            None => turned,
        };
        (self.map.is_none() || v.z * turned.z > 0.0).then(|| over(v, self.before))
    }

    /// Share of the light from `wi` (in the frame of the hit) that the slopes of the map let through.
    #[inline]
    fn unshadowed(&self, wi: Vec3) -> f32 {
        match &self.map {
            Some(map) if map.alpha2 > 0.0 => 2.0 / (1.0 + (1.0 + map.alpha2 * tan2(wi)).sqrt()),
            _ => 1.0,
        }
    }
}

impl<'a> Lobes<'a> {
    /// Adds a coat that lobes can lie in. There must be room for it.
    pub fn push_coat(&mut self, coat: Coat<'a>) {
        self.coats.push(coat);
    }

    /// Adds a lobe whose `f` is multiplied by `weight`; one of weight 0 is left out. There must be room for it, and its coat
    /// must be there.
    #[inline]
    pub fn push(&mut self, weight: f32, turn: Turn, layer: Layer, bsdf: Bsdf<'a>) {
        if weight > 0.0 {
            let (chance, coat) = match layer {
                Layer::Bare => (weight, 0),
                Layer::Top(i) => (weight * self.coats[usize::from(i)].share, 0),
                Layer::Under(i) => (weight * (1.0 - self.coats[usize::from(i)].share), i + 1),
            };
            let Turn { before, map, after } = turn;
            let map = map.map_or(0, |map| {
                self.maps.push(map);
                self.maps.len() as u8
            });
            self.lobes.push(Lobe { weight, chance, before, after, map, coat, bsdf });
        }
    }

    #[inline]
    fn turn(&self, lobe: &Lobe) -> Turn {
        let map = lobe.map.checked_sub(1).map(|i| self.maps[usize::from(i)]);
        Turn { before: lobe.before, map, after: lobe.after }
    }

    /// The coats of a lobe: that around its normal map, and that in it.
    #[inline]
    fn coats(&self, lobe: &Lobe) -> [Option<&Coat<'a>>; 2] {
        match lobe.coat.checked_sub(1).map(|i| &self.coats[usize::from(i)]) {
            Some(coat) if coat.in_map => [None, Some(coat)],
            outer => [outer, None],
        }
    }

    #[inline]
    fn sample_lobe(&self, lobe: &Lobe, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        if !lobe.is_turned() {
            return lobe.bsdf.sample(wo, u_lobe, u);
        }
        let turn = self.turn(lobe);
        if lobe.coat != 0 {
            return self.sample_coated(lobe, turn, wo, u_lobe, u);
        }
        let sample = lobe.bsdf.sample(turn.to_lobe(wo)?, u_lobe, u)?;
        let wi = turn.to_hit(sample.wi)?;
        Some(BsdfSample { wi, weight: sample.weight * turn.unshadowed(wi), ..sample })
    }

    #[inline(never)]
    fn sample_coated(&self, lobe: &Lobe, turn: Turn, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        let [outer, inner] = self.coats(lobe);
        let o1 = coat::enter(outer, wo)?;
        let o2 = coat::enter(inner, turn.to_lobe(o1.v)?)?;
        let sample = lobe.bsdf.sample(o2.v, u_lobe, u)?;
        let i2 = coat::leave(inner, sample.wi)?;
        let below = turn.to_hit(i2.v)?;
        let i1 = coat::leave(outer, below)?;
        let through = o1.transmittance * o2.transmittance * i2.transmittance * i1.transmittance;
        Some(BsdfSample {
            wi: i1.v,
            weight: sample.weight * through * turn.unshadowed(below),
            pdf: if sample.delta { sample.pdf } else { sample.pdf * (i2.narrowing * i1.narrowing) },
            ..sample
        })
    }

    #[inline]
    fn eval_lobe(&self, lobe: &Lobe, wo: Vec3, wi: Vec3) -> BsdfEval {
        if !lobe.is_turned() {
            return lobe.bsdf.eval(wo, wi);
        }
        let turn = self.turn(lobe);
        if lobe.coat != 0 {
            return self.eval_coated(lobe, turn, wo, wi).unwrap_or(BsdfEval::ZERO);
        }
        let (Some(wo), Some(local)) = (turn.to_lobe(wo), turn.to_lobe(wi)) else {
            return BsdfEval::ZERO;
        };
        let value = lobe.bsdf.eval(wo, local);
        BsdfEval { f_cos: value.f_cos * turn.unshadowed(wi), ..value }
    }

    #[inline(never)]
    fn eval_coated(&self, lobe: &Lobe, turn: Turn, wo: Vec3, wi: Vec3) -> Option<BsdfEval> {
        let [outer, inner] = self.coats(lobe);
        let (o1, i1) = (coat::enter(outer, wo)?, coat::enter(outer, wi)?);
        let o2 = coat::enter(inner, turn.to_lobe(o1.v)?)?;
        let i2 = coat::enter(inner, turn.to_lobe(i1.v)?)?;
        let value = lobe.bsdf.eval(o2.v, i2.v);
        let through = o1.transmittance * o2.transmittance * i2.transmittance * i1.transmittance;
        let narrowing = i1.narrowing * i2.narrowing;
        Some(BsdfEval {
            f_cos: value.f_cos * through * (narrowing * turn.unshadowed(i1.v)),
            pdf: value.pdf * narrowing,
        })
    }

    /// As [`Bsdf::sample`], over all lobes.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        match &self.lobes[..] {
            [lobe] if lobe.is_plain() => {
                let mut sample = lobe.bsdf.sample(over(wo, lobe.before), u_lobe, u)?;
                sample.wi = over(sample.wi, lobe.before);
                Some(sample)
            }
            _ => self.sample_any(wo, u_lobe, u),
        }
    }

    /// Apart from the case of one BSDF of full weight, which nearly all hits are.
    #[inline(never)]
    fn sample_any(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        if let [lobe] = &self.lobes[..] {
            let sample = self.sample_lobe(lobe, wo, u_lobe, u)?;
            return Some(BsdfSample { weight: sample.weight * lobe.weight, ..sample });
        }
        let total = self.total();
        let mut rest = u_lobe * total;
        let mut chosen = self.lobes.last()?; // where rounding eats up the last of them
        for lobe in &self.lobes {
            if rest < lobe.chance {
                chosen = lobe;
                break;
            }
            rest -= lobe.chance;
        }
        let u_lobe = (rest / chosen.chance).clamp(0.0, 1.0f32.next_down());
        let sample = self.sample_lobe(chosen, wo, u_lobe, u)?;
        if sample.delta {
            // chosen with the probability chance / total, and nothing else can give this direction
            let weight = sample.weight * (total * (chosen.weight / chosen.chance));
            return Some(BsdfSample { weight, ..sample });
        }
        let BsdfEval { f_cos, pdf } = self.eval(wo, sample.wi);
        (pdf > 0.0 && pdf.is_finite()).then(|| BsdfSample { weight: f_cos * (1.0 / pdf), pdf, ..sample })
    }

    /// As [`Bsdf::eval`], over all lobes.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        match &self.lobes[..] {
            [lobe] if lobe.is_plain() => lobe.bsdf.eval(over(wo, lobe.before), over(wi, lobe.before)),
            _ => self.eval_any(wo, wi),
        }
    }

    #[inline(never)]
    fn eval_any(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        if let [lobe] = &self.lobes[..] {
            let value = self.eval_lobe(lobe, wo, wi);
            return BsdfEval { f_cos: value.f_cos * lobe.weight, ..value };
        }
        let total = self.total();
        let mut sum = BsdfEval::ZERO;
        for lobe in &self.lobes {
            let value = self.eval_lobe(lobe, wo, wi);
            sum.f_cos += value.f_cos * lobe.weight;
            sum.pdf += value.pdf * (lobe.chance / total);
        }
        sum
    }

    /// As [`Bsdf::has_non_delta`], of any.
    #[inline]
    pub fn has_non_delta(&self) -> bool {
        self.lobes.iter().any(|lobe| lobe.bsdf.has_non_delta())
    }

    /// As [`Bsdf::near_delta`], of all.
    #[inline]
    pub fn near_delta(&self) -> bool {
        self.lobes.iter().all(|lobe| lobe.bsdf.near_delta())
    }

    /// As [`Bsdf::features`]: sums of the albedos, the widest roughness.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let mut sum = BsdfFeatures { albedo: Rgb::ZERO, diffuse_albedo: Rgb::ZERO, roughness: 0.0 };
        for lobe in &self.lobes {
            if let Some(of_lobe) = self.features_of(lobe, wo) {
                sum.albedo += of_lobe.albedo * lobe.weight;
                sum.diffuse_albedo += of_lobe.diffuse_albedo * lobe.weight;
                sum.roughness = sum.roughness.max(of_lobe.roughness);
            }
        }
        sum
    }

    /// Under a coat by quadrature over its own draws: 21 are within 5 %, and every hit pays for each.
    fn features_of(&self, lobe: &Lobe, wo: Vec3) -> Option<BsdfFeatures> {
        let turn = self.turn(lobe);
        if lobe.coat == 0 {
            return Some(lobe.bsdf.features(turn.to_lobe(wo)?));
        }
        let [outer, inner] = self.coats(lobe);
        let below = coat::enter(inner, turn.to_lobe(coat::enter(outer, wo)?.v)?)?.v;
        let draw = |(i, u): (usize, Vec2)| {
            let u_lobe = (i * 8 % 21) as f32 / 21.0;
            self.sample_coated(lobe, turn, wo, u_lobe, u).map_or(Split::ZERO, |s| s.weight)
        };
        let sum = albedo::lattice::<21, 13>().enumerate().map(draw).fold(Split::ZERO, |a, b| a + b);
        Some(BsdfFeatures {
            albedo: sum.total() / 21.0,
            diffuse_albedo: sum.diffuse / 21.0,
            roughness: lobe.bsdf.features(below).roughness,
        })
    }

    /// The normal for the feature layers, in the frame of the hit: the likeliest lobe's, on the side that its BSDF refers
    /// to.
    pub fn normal(&self) -> Vec3 {
        let weightiest = self.lobes.iter().reduce(|a, b| if b.chance > a.chance { b } else { a });
        weightiest.map_or(Vec3::Z, |lobe| {
            let Turn { before, map, after } = self.turn(lobe);
            let z = over(Vec3::Z, after);
            over(map.map_or(z, |map| map.axes * z), before)
        })
    }

    fn total(&self) -> f32 {
        self.lobes.iter().map(|lobe| lobe.chance).sum()
    }
}

#[cfg(test)]
mod tests;

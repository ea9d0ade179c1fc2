//! What a surface scatters at one hit: up to eight weighted BSDFs, each in a frame of its own.
//!
//! Masks, blends, two-sided materials and normal maps become this list. Its frame is that of the interpolated
//! shading normal; each BSDF may see it turned over (two-sided) or turned by a normal map, or both.

use arrayvec::ArrayVec;
use glam::{Mat3, Vec2, Vec3};

use super::{Bsdf, BsdfEval, BsdfFeatures, BsdfSample};
use crate::color::Rgb;

/// The most BSDFs that one hit may have.
pub const MOST_LOBES: usize = 8;

/// All that scatters at a hit, for one `wo`.
#[derive(Clone, Debug, Default)]
pub struct Lobes<'a> {
    lobes: ArrayVec<Lobe<'a>, MOST_LOBES>,
    /// What their normal maps do. Apart from the lobes, which most scenes need alone and which are copied at every hit.
    maps: ArrayVec<Perturbation, MOST_LOBES>,
}

/// One BSDF with its share.
#[derive(Clone, Copy, Debug)]
struct Lobe<'a> {
    /// What `f` is multiplied by: positive; the sum over all lobes is at most 1.
    weight: f32,
    before: bool,
    after: bool,
    /// Which of `maps` is this lobe's, counted from 1; 0 for none.
    map: u8,
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
        self.before || self.after || self.map != 0
    }

    #[inline]
    fn is_plain(&self) -> bool {
        self.weight == 1.0 && !self.after && self.map == 0
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
    /// Adds a lobe whose `f` is multiplied by `weight`; one of weight 0 is left out. There must be room for it.
    #[inline]
    pub fn push(&mut self, weight: f32, turn: Turn, bsdf: Bsdf<'a>) {
        if weight > 0.0 {
            let Turn { before, map, after } = turn;
            let map = map.map_or(0, |map| {
                self.maps.push(map);
                self.maps.len() as u8
            });
            self.lobes.push(Lobe { weight, before, after, map, bsdf });
        }
    }

    #[inline]
    fn turn(&self, lobe: &Lobe) -> Turn {
        let map = lobe.map.checked_sub(1).map(|i| self.maps[usize::from(i)]);
        Turn { before: lobe.before, map, after: lobe.after }
    }

    #[inline]
    fn sample_lobe(&self, lobe: &Lobe, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        if !lobe.is_turned() {
            return lobe.bsdf.sample(wo, u_lobe, u);
        }
        let turn = self.turn(lobe);
        let sample = lobe.bsdf.sample(turn.to_lobe(wo)?, u_lobe, u)?;
        let wi = turn.to_hit(sample.wi)?;
        Some(BsdfSample { wi, weight: sample.weight * turn.unshadowed(wi), ..sample })
    }

    #[inline]
    fn eval_lobe(&self, lobe: &Lobe, wo: Vec3, wi: Vec3) -> BsdfEval {
        if !lobe.is_turned() {
            return lobe.bsdf.eval(wo, wi);
        }
        let turn = self.turn(lobe);
        let (Some(wo), Some(local)) = (turn.to_lobe(wo), turn.to_lobe(wi)) else {
            return BsdfEval::ZERO;
        };
        let value = lobe.bsdf.eval(wo, local);
        BsdfEval { f_cos: value.f_cos * turn.unshadowed(wi), ..value }
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
            if rest < lobe.weight {
                chosen = lobe;
                break;
            }
            rest -= lobe.weight;
        }
        let u_lobe = (rest / chosen.weight).clamp(0.0, 1.0f32.next_down());
        let sample = self.sample_lobe(chosen, wo, u_lobe, u)?;
        if sample.delta {
            // chosen with chance weight / total, and nothing else can give this direction
            return Some(BsdfSample { weight: sample.weight * total, ..sample });
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
            sum.pdf += value.pdf * (lobe.weight / total);
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
            if let Some(wo) = self.turn(lobe).to_lobe(wo) {
                let of_lobe = lobe.bsdf.features(wo);
                sum.albedo += of_lobe.albedo * lobe.weight;
                sum.diffuse_albedo += of_lobe.diffuse_albedo * lobe.weight;
                sum.roughness = sum.roughness.max(of_lobe.roughness);
            }
        }
        sum
    }

    /// The normal for the feature layers, in the frame of the hit: the weightiest lobe's, on the side that its BSDF
    /// refers to.
    pub fn normal(&self) -> Vec3 {
        let weightiest = self.lobes.iter().reduce(|a, b| if b.weight > a.weight { b } else { a });
        weightiest.map_or(Vec3::Z, |lobe| {
            let Turn { before, map, after } = self.turn(lobe);
            let z = over(Vec3::Z, after);
            over(map.map_or(z, |map| map.axes * z), before)
        })
    }

    fn total(&self) -> f32 {
        self.lobes.iter().map(|lobe| lobe.weight).sum()
    }
}

#[cfg(test)]
mod tests;

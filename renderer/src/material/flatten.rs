//! Nested materials become lists: what is seen from each side, and what lets light straight through.

use limpid_scenes::{Coat, Material, MaterialId, MaterialKind, NormalMap, Scalar, Scene};

use super::coat::CoatModel;
use super::{Coatings, Model, error, prepare};
use crate::bsdf::{Layer, MOST_COATS, MOST_LOBES};
use crate::prepare::PrepareError;

/// A material as one of its sides shows it.
#[derive(Default)]
pub struct Side {
    /// What scatters.
    pub pieces: Vec<Piece>,
    /// What pieces lie under.
    pub coats: Vec<CoatModel>,
    /// What lets light straight through.
    pub holes: Vec<Share>,
}

/// One model with its share.
#[derive(Clone)]
pub struct Piece {
    pub share: Share,
    /// See [`Turn`](crate::bsdf::Turn).
    pub before: bool,
    pub map: Option<Map>,
    pub after: bool,
    pub layer: Layer,
    pub model: Model,
}

/// A product of numbers in [0, 1].
#[derive(Clone, Default)]
pub struct Share {
    /// Number, or 1 less the number.
    pub factors: Vec<(Scalar, bool)>,
}

impl Share {
    pub fn times(&self, scalar: Scalar, complement: bool) -> Self {
        let mut factors = self.factors.clone();
        factors.push((scalar, complement));
        Self { factors }
    }
}

/// What turns the shading normal.
#[derive(Clone, Copy)]
pub struct Map {
    pub map: NormalMap,
    pub flip_invalid: bool,
    pub shadowing: bool,
}

/// Where in the nesting a material is met.
#[derive(Clone, Default)]
struct Context {
    share: Share,
    before: bool,
    map: Option<Map>,
    after: bool,
    layer: Layer,
    /// Seen from behind, in the frame that is innermost so far.
    behind: bool,
}

/// Works through the nesting of one material.
pub struct Flatten<'a> {
    pub scene: &'a Scene,
    pub coatings: &'a mut Coatings,
    /// The outermost material, which errors name.
    pub outer: MaterialId,
}

impl Flatten<'_> {
    /// The side of the normal and the side behind.
    pub fn sides(&mut self) -> Result<[Side; 2], PrepareError> {
        let mut sides = [Side::default(), Side::default()];
        for (side, behind) in sides.iter_mut().zip([false, true]) {
            self.add(self.outer, Context { behind, ..Context::default() }, side)?;
        }
        Ok(sides)
    }

    fn add(&mut self, id: MaterialId, cx: Context, side: &mut Side) -> Result<(), PrepareError> {
        let material = &self.scene.materials[id.0 as usize];
        let part = |scalar, complement| Context { share: cx.share.times(scalar, complement), ..cx.clone() };
        match &material.kind {
            MaterialKind::TwoSided { front, back } => {
                for &inner in [front, back] {
                    if self.scene.any_material(inner, |kind| {
                        kind.transmits() || matches!(kind, MaterialKind::TwoSided { .. })
                    }) {
                        let inner = &self.scene.materials[inner.0 as usize].name;
                        return Err(error(
                            material,
                            format!("\"{inner}\" inside it has two sides already"),
                            "use the inner bsdf without `twosided`",
                        ));
                    }
                }
                if !cx.behind {
                    return self.add(*front, cx, side);
                }
                let (before, after) = if cx.map.is_some() { (cx.before, true) } else { (true, false) };
                self.add(*back, Context { before, after, behind: false, ..cx }, side)
            }
            MaterialKind::Mask { opacity, inner } => {
                self.hole(part(*opacity, true).share, side)?;
                self.add(*inner, part(*opacity, false), side)
            }
            MaterialKind::Blend { weight, first, second } => {
                self.add(*first, part(*weight, true), side)?;
                self.add(*second, part(*weight, false), side)
            }
            MaterialKind::Mixture { parts } => {
                for &(weight, inner) in parts {
                    self.add(inner, part(Scalar::Constant(weight), false), side)?;
                }
                Ok(())
            }
            MaterialKind::Perturbed { map, flip_invalid, shadowing, inner } => {
                if cx.map.is_some() {
                    return Err(error(
                        material,
                        "a normal or bump map inside another".into(),
                        "keep one of them, or bake both into one picture",
                    ));
                }
                let map = Some(Map { map: *map, flip_invalid: *flip_invalid, shadowing: *shadowing });
                self.add(*inner, Context { map, ..cx }, side)
            }
            MaterialKind::Coated { coat, inner } => self.coated(material, coat, *inner, cx, side),
            MaterialKind::Null => self.hole(cx.share, side),
            _ => {
                // A one-sided model is black from behind. Counted from the front, so that no nesting is endless.
                let model = prepare(material, self.coatings)?;
                if cx.behind && !material.kind.transmits() {
                    return Ok(());
                }
                let Context { share, before, map, after, layer, .. } = cx;
                side.pieces.push(Piece { share, before, map, after, layer, model });
                self.check(side)
            }
        }
    }

    /// The coat's own reflection, which both sides show, and what lies below.
    fn coated(
        &mut self,
        material: &Material,
        coat: &Coat,
        inner: MaterialId,
        cx: Context,
        side: &mut Side,
    ) -> Result<(), PrepareError> {
        let name = &self.scene.materials[inner.0 as usize].name;
        if cx.layer != Layer::Bare {
            return Err(error(material, "a coat inside another".into(), "keep one of them"));
        }
        if self.scene.any_material(inner, MaterialKind::lets_through) {
            let problem = format!("its coat covers \"{name}\", which lets light through");
            return Err(error(material, problem, "use the inner bsdf without a coat"));
        }
        let index = side.coats.len() as u8;
        let (coat, model) = CoatModel::prepare(material, coat, cx.map.is_some(), self.coatings)?;
        side.coats.push(coat);
        // Seen from behind, the innermost frame is turned over.
        let (before, after) = if cx.map.is_some() {
            (cx.before, cx.after || cx.behind)
        } else {
            (cx.before || cx.behind, cx.after)
        };
        let (share, map, layer) = (cx.share.clone(), cx.map, Layer::Top(index));
        side.pieces.push(Piece { share, before, map, after, layer, model });
        self.check(side)?;
        self.add(inner, Context { layer: Layer::Under(index), ..cx }, side)
    }

    fn hole(&mut self, share: Share, side: &mut Side) -> Result<(), PrepareError> {
        side.holes.push(share);
        self.check(side)
    }

    fn check(&self, side: &Side) -> Result<(), PrepareError> {
        let outer = &self.scene.materials[self.outer.0 as usize];
        if side.coats.len() > MOST_COATS {
            return Err(error(outer, format!("made of more than {MOST_COATS} coats"), "blend fewer"));
        }
        if side.pieces.len() <= MOST_LOBES && side.holes.len() <= MOST_LOBES {
            return Ok(());
        }
        Err(error(outer, format!("made of more than {MOST_LOBES} bsdfs"), "blend fewer"))
    }
}

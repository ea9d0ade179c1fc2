//! Lights with a surface.

use std::f64::consts::PI;

use glam::{DVec2, DVec3, Vec2};
use limpid_scenes::Color;

use super::choice::Weigh;
use super::cylinder::Cylinder;
use super::disk::Disk;
use super::rectangle::Rectangle;
use super::sphere::Sphere;
use super::triangles::Triangles;
use super::{Drawn, LightForm, LightHit, weighted_mean};
use crate::texture::Textures;

/// A surface that emits on one side.
pub struct SurfaceLight {
    pub form: Form,
    pub emission: Color,
}

/// What emits.
pub enum Form {
    Triangles(Triangles),
    Rectangle(Rectangle),
    Sphere(Sphere),
    Cylinder(Cylinder),
    Disk(Disk),
}

impl SurfaceLight {
    pub fn new(form: LightForm, emission: Color, textures: &Textures) -> Self {
        let form = match form {
            LightForm::Triangles(triangles) => Form::Triangles(Triangles::new(triangles, emission, textures)),
            LightForm::Rectangle(rectangle) => {
                Form::Rectangle(Rectangle::new(&rectangle, emission, textures))
            }
            LightForm::Sphere(sphere) => Form::Sphere(Sphere::new(&sphere)),
            LightForm::Cylinder(cylinder) => Form::Cylinder(Cylinder::new(&cylinder)),
            LightForm::Disk(disk) => Form::Disk(Disk::new(&disk)),
        };
        Self { form, emission }
    }

    /// π · area · mean luminance.
    pub fn weigh(&self, textures: &Textures) -> Weigh {
        let area = match &self.form {
            Form::Triangles(form) => form.area(),
            Form::Rectangle(form) => form.area(),
            Form::Sphere(form) => form.area(),
            Form::Cylinder(form) => form.area(),
            Form::Disk(form) => form.area(),
        };
        if self.emission == Color::Constant([0.0; 3]) || area.is_nan() || area <= 0.0 {
            return Weigh::Never;
        }
        let mean = match &self.form {
            Form::Triangles(form) => form.mean(),
            Form::Rectangle(form) => form.mean(),
            // In proportion to the area at uv, as long as the shape is round.
            Form::Sphere(_) => {
                weighted_mean(self.emission, textures, |uv: Vec2| (PI * f64::from(uv.y)).sin())
            }
            Form::Cylinder(_) => weighted_mean(self.emission, textures, |_| 1.0),
            Form::Disk(_) => weighted_mean(self.emission, textures, |uv: Vec2| uv.x.into()),
        };
        Weigh::Power(PI * area * mean)
    }
}

impl Form {
    #[inline]
    pub fn sample(&self, p: DVec3, choice: f64, u: DVec2) -> Option<Drawn> {
        match self {
            Self::Triangles(form) => form.sample(p, choice, u),
            Self::Rectangle(form) => form.sample(p, choice, u),
            Self::Sphere(form) => form.sample(p, u),
            Self::Cylinder(form) => form.sample(p, u),
            Self::Disk(form) => form.sample(p, u),
        }
    }

    #[inline]
    pub fn pdf(&self, p: DVec3, at: &LightHit, wi: DVec3) -> f64 {
        match self {
            Self::Triangles(form) => form.pdf(p, at.p.as_dvec3(), at.prim),
            Self::Rectangle(form) => form.pdf(p, at.p.as_dvec3(), at.uv.uv),
            Self::Sphere(form) => form.pdf(p, wi),
            Self::Cylinder(form) => form.pdf(p, at.p.as_dvec3()),
            Self::Disk(form) => form.pdf(p, at.p.as_dvec3()),
        }
    }
}

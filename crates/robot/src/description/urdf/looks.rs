//! `<visual>`: what links look like. It moves nothing, so what is not understood is a warning, and not drawn.

use crate::description::diagnostic::nearest;
use crate::description::reader::Reader;
use crate::description::tree::{Look, Shape};
use crate::description::xml::{Element, Text, shown};
use crate::geometry::{Rotation, Transform, Vector};
use std::collections::HashMap;

/// Colours by the names of materials: red, green, blue and how opaque, from 0 to 1.
pub(super) type Materials = HashMap<String, [f64; 4]>;

/// Larger numbers stand in no drawing, metres.
const LARGEST: f64 = 1e6;

impl Reader {
    /// The materials that are named anywhere in a robot; of several with one name the first counts.
    pub(super) fn materials(&mut self, robot: Element) -> Materials {
        let of_links = robot.all("link").flat_map(|l| l.all("visual")).flat_map(|v| v.all("material"));
        let mut found = Materials::new();
        for material in robot.all("material").chain(of_links) {
            let name = material.attribute("name").map(|n| n.text).unwrap_or_default();
            if name.is_empty() || found.contains_key(name) {
                continue;
            }
            if let Some(colour) = self.colour(material) {
                found.insert(name.into(), colour);
            }
        }
        found
    }

    /// What a link looks like.
    pub(super) fn looks(&mut self, link: Element, materials: &Materials) -> Vec<Look> {
        link.all("visual").filter_map(|visual| self.look(visual, materials)).collect()
    }

    fn look(&mut self, visual: Element, materials: &Materials) -> Option<Look> {
        self.known(visual, &["origin", "geometry", "material", "meshes"]);
        let Some(geometry) = visual.one("geometry", &mut self.out) else {
            self.out.warning(visual.span(), "a <visual> without <geometry>: it is not drawn");
            return None;
        };
        let shape = self.shape(geometry)?;
        let origin = match visual.one("origin", &mut self.out) {
            Some(origin) => self.place(origin)?,
            None => Transform::identity(),
        };
        let material = visual.one("material", &mut self.out);
        let named = |m: Element| materials.get(m.attribute("name")?.text).copied();
        let colour = material.and_then(|m| self.colour(m).or_else(|| named(m)));
        Some(Look { shape, origin, colour })
    }

    fn shape(&mut self, geometry: Element) -> Option<Shape> {
        const KNOWN: &[&str] = &["box", "cylinder", "sphere", "mesh"];
        let Some(element) = geometry.children().next() else {
            self.out.warning(geometry.span(), "an empty <geometry>: it is not drawn");
            return None;
        };
        match element.name().unwrap_or_default() {
            "box" => Some(Shape::Box(self.sizes(element, "size")?)),
            "cylinder" => {
                let ([radius], [length]) = (self.sizes(element, "radius")?, self.sizes(element, "length")?);
                Some(Shape::Cylinder { radius, length })
            }
            "sphere" => {
                let [radius] = self.sizes(element, "radius")?;
                Some(Shape::Sphere { radius })
            }
            "mesh" => self.mesh(element),
            other => {
                let message = format!("<{}> is no shape that is known: it is not drawn", shown(other));
                let finding = self.out.warning(element.span(), message);
                if let Some(near) = nearest(other, KNOWN.iter().copied()) {
                    finding.hint(format!("did you mean <{near}>?"));
                }
                None
            }
        }
    }

    fn mesh(&mut self, mesh: Element) -> Option<Shape> {
        let file = mesh.attribute("filename").map(|f| super::plain(f.text.trim())).filter(|f| !f.is_empty());
        let Some(file) = file else {
            self.out.warning(mesh.span(), "a <mesh> without `filename`: it is not drawn");
            return None;
        };
        let scale = match mesh.attribute("scale") {
            // One number scales all three directions.
            Some(value) if value.words().len() == 1 => [self.doubles::<1>(&value, "scale")?[0]; 3],
            Some(value) => self.doubles(&value, "scale")?,
            None => [1.0; 3],
        };
        Some(Shape::Mesh { file, scale })
    }

    /// `<origin xyz rpy>` in doubles.
    fn place(&mut self, origin: Element) -> Option<Transform<f64>> {
        let mut three = |name: &str| match origin.attribute(name) {
            Some(value) => self.doubles(&value, name),
            None => Some([0.0; 3]),
        };
        let (xyz, rpy) = (three("xyz")?, three("rpy")?);
        let rotation = Rotation::from_rpy(rpy[0], rpy[1], rpy[2]);
        Some(Transform::from_rotation_translation(rotation, Vector([xyz[0], xyz[1], xyz[2]])))
    }

    /// `<color rgba>` of a material.
    fn colour(&mut self, material: Element) -> Option<[f64; 4]> {
        let value = material.all("color").next()?.attribute("rgba")?;
        self.colour_of(&value)
    }

    /// Red, green, blue and how opaque.
    pub(in crate::description) fn colour_of(&mut self, value: &Text) -> Option<[f64; 4]> {
        self.doubles::<4>(value, "rgba").map(|parts| parts.map(|x| x.clamp(0.0, 1.0)))
    }

    /// Lengths that are not negative.
    fn sizes<const N: usize>(&mut self, element: Element, name: &'static str) -> Option<[f64; N]> {
        let Some(value) = element.attribute(name) else {
            let message = format!("a <{}> without `{name}`: it is not drawn", element.full_name());
            self.out.warning(element.span(), message);
            return None;
        };
        let sizes = self.doubles(&value, name)?;
        if sizes.iter().any(|x| *x < 0.0) {
            self.out.warning(value.span, format!("`{name}` is negative: it is not drawn"));
            return None;
        }
        Some(sizes)
    }

    /// Numbers as doubles; nothing where they are none, which is said.
    pub(in crate::description) fn doubles<const N: usize>(
        &mut self,
        value: &Text,
        name: &str,
    ) -> Option<[f64; N]> {
        let number = |word: &Text| match word.exact {
            Some(exact) => exact.eval(|_| None).ok(),
            None => word.text.parse::<f64>().ok(),
        };
        let words = value.words();
        let numbers: Option<Vec<f64>> =
            words.iter().map(|w| number(w).filter(|x| x.abs() <= LARGEST)).collect();
        let numbers = numbers.and_then(|n| n.try_into().ok());
        if numbers.is_none() && !self.out.is_full() {
            let plural = if N == 1 { "number" } else { "numbers" };
            let message = format!("`{name}` is not {N} {plural}: it is not drawn");
            self.out.warning(value.span.clone(), message);
        }
        numbers
    }
}

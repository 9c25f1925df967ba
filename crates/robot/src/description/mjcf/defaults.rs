//! Classes of defaults, and the attributes of an element with those of its class behind them.

use super::super::diagnostic::{Diagnostics, nearest};
use super::super::xml::{Element, Text, shown};
use std::collections::HashMap;

/// How many classes there may be.
const MAX_CLASSES: usize = 2000;

/// The ways to say how a frame is turned.
pub(super) const TURNS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// The elements of which defaults are read.
const WITH_DEFAULTS: [&str; 6] = ["joint", "site", "geom", "mesh", "material", "equality"];

type Attributes<'a> = Vec<(&'a str, Text<'a>)>;

/// The classes of a model; the first one is that of what has no class.
pub(super) struct Classes<'a> {
    all: Vec<HashMap<&'static str, Attributes<'a>>>,
    by_name: HashMap<&'a str, usize>,
}

/// An element, and the defaults of its class.
#[derive(Clone, Copy)]
pub(super) struct Resolved<'a, 'c> {
    pub own: Element<'a>,
    defaults: Option<&'c Attributes<'a>>,
}

impl<'a> Resolved<'a, '_> {
    /// An element that has no defaults.
    pub fn bare(own: Element<'a>) -> Self {
        Resolved { own, defaults: None }
    }

    pub fn get(&self, name: &str) -> Option<Text<'a>> {
        self.own.attribute(name).or_else(|| self.default(name))
    }

    pub fn default(&self, name: &str) -> Option<Text<'a>> {
        self.defaults?.iter().find(|a| a.0 == name).map(|a| a.1.clone())
    }
}

impl<'a> Classes<'a> {
    /// The classes of the `<default>` elements of a model: of each its own attributes over those of the class around it.
    pub fn of(model: Element<'a>, out: &mut Diagnostics) -> Self {
        let mut classes = Classes { all: vec![HashMap::new()], by_name: HashMap::new() };
        classes.by_name.insert("main", 0);
        for top in model.all("default") {
            top.only(&["class"], out);
            if let Some(class) = top.attribute("class").filter(|c| c.text != "main") {
                out.error(class.span, format!("the outermost class is `main`, not `{}`", shown(class.text)));
            }
            let mut open = vec![(top, 0)];
            while let Some((element, class)) = open.pop() {
                classes.define(element, class, out);
                for inner in element.all("default") {
                    inner.only(&["class"], out);
                    let Some(name) = inner.attribute("class") else {
                        out.error(inner.span(), "a <default> inside another has a `class`");
                        continue;
                    };
                    if classes.all.len() >= MAX_CLASSES {
                        out.error(inner.span(), format!("more than {MAX_CLASSES} classes"));
                        return classes;
                    }
                    if classes.by_name.contains_key(name.text) {
                        out.error(name.span, format!("the class `{}` is given twice", shown(name.text)));
                        continue;
                    }
                    classes.by_name.insert(name.text, classes.all.len());
                    open.push((inner, classes.all.len()));
                    classes.all.push(classes.all[class].clone());
                }
            }
        }
        classes
    }

    /// Takes the attributes of a class's own elements.
    fn define(&mut self, class: Element<'a>, number: usize, out: &mut Diagnostics) {
        for element in class.children() {
            let Some(kind) = WITH_DEFAULTS.into_iter().find(|k| element.name() == Some(k)) else { continue };
            match kind {
                "joint" => element.only(super::joints::ATTRIBUTES, out),
                "site" => element.only(super::bodies::SITE, out),
                "geom" => element.only(super::geoms::ATTRIBUTES, out),
                _ => {}
            }
            let own: Attributes = element.attributes().collect();
            let known = self.all[number].entry(kind).or_default();
            let turns = |name: &str| TURNS.contains(&name);
            if own.iter().any(|a| turns(a.0)) {
                known.retain(|a| !turns(a.0));
            }
            known.retain(|k| own.iter().all(|o| o.0 != k.0));
            known.extend(own);
            known.truncate(64);
        }
    }

    /// The class of a name; one that is not there is reported.
    pub fn find(&self, name: &Text, out: &mut Diagnostics) -> Option<usize> {
        let found = self.by_name.get(name.text).copied();
        if found.is_none() {
            let finding = out.error(name.span.clone(), format!("there is no class `{}`", shown(name.text)));
            // Hash maps have no order: of several that are as near, the first one in it is named.
            let mut names: Vec<&str> = self.by_name.keys().copied().take(1000).collect();
            names.sort_unstable();
            if let Some(near) = nearest(name.text, names) {
                finding.hint(format!("did you mean `{near}`?"));
            }
        }
        found
    }

    /// An element with the defaults of its own class, or of the one that is in force.
    pub fn resolve(&self, own: Element<'a>, class: Option<usize>, out: &mut Diagnostics) -> Resolved<'a, '_> {
        let kind = own.name().unwrap_or_default();
        self.resolve_as(kind, own, class, out)
    }

    /// An element with the defaults of another kind of element.
    pub fn resolve_as(
        &self,
        kind: &str,
        own: Element<'a>,
        class: Option<usize>,
        out: &mut Diagnostics,
    ) -> Resolved<'a, '_> {
        let named = own.attribute("class").and_then(|name| self.find(&name, out));
        Resolved { own, defaults: self.all[named.or(class).unwrap_or(0)].get(kind) }
    }
}

//! Elements one after the other: those of xacro do what they say, others are taken over.

use super::macros::Block;
use super::scope::{BLOCK, Scope, Stored};
use super::value::{Fault, Val, decimal};
use super::{MAX_DEPTH, MAX_FILES, MAX_WORK, Shared, Xacro};
use crate::description::xml::{Attribute, Node, Value, parse, shown};
use std::rc::Rc;

impl Xacro<'_> {
    /// The elements that these stand for, in the result.
    pub(super) fn body(
        &mut self,
        tree: &Shared,
        children: &[usize],
        scope: Scope,
        depth: usize,
    ) -> Vec<usize> {
        let mut all = vec![];
        for &child in children {
            self.work += 1;
            if self.work > MAX_WORK || self.out.is_full() {
                if self.work == MAX_WORK + 1 {
                    let span = tree.nodes[child].span.clone();
                    self.fault(span, Fault::new(format!("more than {MAX_WORK} elements are expanded")));
                }
                return all;
            }
            let element = tree.nodes[child].clone();
            if depth > MAX_DEPTH {
                let message = "macros, files and elements stand in each other too deeply";
                self.fault(element.span, Fault::new(message));
                // Once is enough: what is so deep is so often.
                self.work = MAX_WORK + 1;
                return all;
            }
            match self.element((tree, child, &element), scope, depth) {
                Ok(nodes) => all.extend(nodes),
                Err(fault) => self.fault(element.span, fault),
            }
        }
        all
    }

    fn element(
        &mut self,
        (tree, index, element): (&Shared, usize, &Node),
        scope: Scope,
        depth: usize,
    ) -> Result<Vec<usize>, Fault> {
        let Some(name) = element.name.strip_prefix("xacro:") else {
            return Ok(vec![self.taken_over((tree, element), scope, depth)]);
        };
        let attribute = |name: &str| element.attributes.iter().find(|a| a.name == name);
        let needs = |name: &str| {
            attribute(name).ok_or_else(|| Fault::new(format!("<{}> without `{name}`", shown(&element.name))))
        };
        match name {
            "include" => self.include(&needs("filename")?.value, element, scope, depth),
            "property" => {
                let name = self.value(&needs("name")?.value, scope.names)?.show();
                self.set_property(&name, (tree, element), scope)?;
                Ok(vec![])
            }
            "arg" => {
                let name = needs("name")?.value.text.clone();
                self.unasked.remove(&name);
                if let Some(default) = attribute("default")
                    && !self.arguments.contains_key(&name)
                {
                    let value = self.value(&default.value, scope.names)?.show();
                    self.arguments.insert(name, value);
                }
                Ok(vec![])
            }
            "macro" => {
                self.define(tree, index, scope);
                Ok(vec![])
            }
            "if" | "unless" => {
                let condition = &needs("value")?.value;
                let holds = self.value(condition, scope.names)?.truth();
                let takes = holds.map_err(|fault| fault.at(condition.span.clone()))? == (name == "if");
                Ok(if takes { self.body(tree, &element.children, scope, depth + 1) } else { vec![] })
            }
            "insert_block" => {
                let name = self.value(&needs("name")?.value, scope.names)?;
                self.insert(&name, scope, depth)
            }
            "call" if self.macros.seen(scope.macros, name).is_none() => {
                let name = self.value(&needs("macro")?.value, scope.names)?.show();
                let others = element.attributes.iter().filter(|a| a.name != "macro").cloned().collect();
                self.call(&name, (tree, &Node { attributes: others, ..element.clone() }), scope, depth)
            }
            "element" if self.macros.seen(scope.macros, name).is_none() => {
                let name = self.given_name(needs("xacro:name")?, scope)?;
                let others = element.attributes.iter().filter(|a| a.name != "xacro:name").cloned().collect();
                let element = Node { name, attributes: others, ..element.clone() };
                match element.name.starts_with("xacro:") && element.name != "xacro:element" {
                    true => self.element((tree, index, &element), scope, depth + 1),
                    false => Ok(vec![self.taken_over((tree, &element), scope, depth)]),
                }
            }
            "attribute" if self.macros.seen(scope.macros, name).is_none() => {
                let (name, value) = (needs("name")?, needs("value")?);
                let name = Attribute { name: self.given_name(name, scope)?, ..value.clone() };
                if let (Some(set), Some(&inside)) = (self.attribute(&name, scope.names), self.inside.last()) {
                    let attributes = &mut self.result.nodes[inside].attributes;
                    attributes.retain(|a| a.name != set.name);
                    attributes.push(set);
                }
                Ok(vec![])
            }
            name => self.call(name, (tree, element), scope, depth),
        }
    }

    /// The name that an attribute gives to an element or attribute.
    fn given_name(&mut self, attribute: &Attribute, scope: Scope) -> Result<String, Fault> {
        let name = self.value(&attribute.value, scope.names)?.show();
        let is_letter = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | ':');
        match name.starts_with(|c: char| c.is_alphabetic() || c == '_') && name.chars().all(is_letter) {
            true => Ok(name),
            false => {
                let message = format!("`{}` is no name of an element or attribute", shown(&name));
                Err(Fault::new(message).at(attribute.value.span.clone()))
            }
        }
    }

    /// An element that is not xacro's, with what stands in it expanded.
    fn taken_over(&mut self, (tree, element): (&Shared, &Node), scope: Scope, depth: usize) -> usize {
        let number = self.result.nodes.len();
        self.result.nodes.push(Node { attributes: vec![], children: vec![], ..element.clone() });
        let attributes = element.attributes.iter().filter_map(|a| self.attribute(a, scope.names)).collect();
        self.result.nodes[number].attributes = attributes;
        self.inside.push(number);
        self.result.nodes[number].children = self.body(tree, &element.children, scope, depth + 1);
        self.inside.pop();
        number
    }

    fn include(
        &mut self,
        filename: &Value,
        element: &Node,
        scope: Scope,
        depth: usize,
    ) -> Result<Vec<usize>, Fault> {
        let attribute = |name: &str| element.attributes.iter().find(|a| a.name == name);
        let inner = match attribute("ns") {
            None => scope,
            Some(space) => {
                let name = self.value(&space.value, scope.names)?.show();
                let is_word = name.starts_with(|c: char| c.is_alphabetic() || c == '_')
                    && name.chars().all(|c| c.is_alphanumeric() || c == '_');
                if !is_word {
                    let message = format!("`{}` is no name for a namespace", shown(&name));
                    return Err(Fault::new(message).at(space.value.span.clone()));
                }
                // Its macros see no others, its properties those around.
                let (names, macros) = (self.scopes.space(Some(scope.names)), self.macros.space(None));
                let inner = Scope { names, macros };
                self.scopes.set(scope.names, &name, Stored::Known(Val::Space(inner)));
                inner
            }
        };
        let is_optional =
            attribute("optional").is_some_and(|a| matches!(a.value.text.as_str(), "true" | "True" | "1"));
        let wanted = self.value(filename, scope.names)?.show();
        if wanted.contains(['*', '?', '[']) {
            let matching = self.matching(&wanted).map_err(|why| why.at(filename.span.clone()))?;
            if matching.is_empty() {
                self.out
                    .warning(filename.span.clone(), format!("`{}` is the name of no file", shown(&wanted)));
            }
            let mut all = vec![];
            for wanted in matching {
                all.extend(self.included(&wanted, (filename, is_optional), inner, depth)?);
            }
            return Ok(all);
        }
        self.included(&wanted, (filename, is_optional), inner, depth)
    }

    /// The files whose names a pattern matches, in the order of their names.
    fn matching(&mut self, pattern: &str) -> Result<Vec<String>, Fault> {
        let (folder, last) =
            pattern.rsplit_once('/').map_or(("", pattern), |(f, l)| (&pattern[..=f.len()], l));
        if folder.contains(['*', '?', '[']) {
            return Err(Fault::new("a pattern is read in the name of a file, not in that of its folder"));
        }
        let from = self.files.name(self.open.last().copied().unwrap_or(0)).to_string();
        let mut names = self.sources.files(&from, if folder.is_empty() { "." } else { folder });
        // A name that begins with a point is matched by one that does.
        names.retain(|n| matches(last, n) && (last.starts_with('.') || !n.starts_with('.')));
        names.sort();
        names.dedup();
        Ok(names.into_iter().map(|name| format!("{folder}{name}")).collect())
    }

    /// What stands in a file.
    fn included(
        &mut self,
        wanted: &str,
        (filename, is_optional): (&Value, bool),
        inner: Scope,
        depth: usize,
    ) -> Result<Vec<usize>, Fault> {
        let (name, text) = match self.open_file(wanted) {
            Ok(found) => found,
            Err(_) if is_optional => return Ok(vec![]),
            Err(why) => return Err(why.at(filename.span.clone())),
        };
        if self.open.iter().any(|&f| self.sources.canonical(self.files.name(f)) == name) {
            let message = format!("`{}` includes itself", shown(wanted));
            return Err(Fault::new(message).at(filename.span.clone()));
        }
        let (file, start) = self.files.add(name, text);
        let text = self.files.text(file).to_string();
        let Some(tree) = parse(&text, start, &mut self.out) else { return Ok(vec![]) };
        self.open.push(file);
        let children = tree.nodes[0].children.clone();
        let result = self.body(&Rc::new(tree), &children, inner, depth + 1);
        self.open.pop();
        Ok(result)
    }

    /// The text of a file that the one at hand names, and its name.
    pub(super) fn open_file(&mut self, wanted: &str) -> Result<(String, String), Fault> {
        if self.files.count() >= MAX_FILES {
            return Err(Fault::new(format!("more than {MAX_FILES} files")));
        }
        let from = self.files.name(self.open.last().copied().unwrap_or(0)).to_string();
        self.sources.open(&from, wanted).map_err(Fault::new)
    }

    fn set_property(
        &mut self,
        name: &str,
        (tree, element): (&Shared, &Node),
        Scope { names: scope, .. }: Scope,
    ) -> Result<(), Fault> {
        let attribute = |name: &str| element.attributes.iter().find(|a| a.name == name);
        let mut is_so = |name: &str, otherwise: bool| match attribute(name) {
            Some(a) => self.value(&a.value, scope)?.truth(),
            None => Ok(otherwise),
        };
        let (is_removed, is_lazy) = (is_so("remove", false)?, is_so("lazy_eval", true)?);
        if is_removed {
            while let Some(at) = self.scopes.find(scope, name) {
                self.scopes.remove(at, name);
            }
            return Ok(());
        }
        let wider = attribute("scope").map(|s| s.value.text.as_str());
        let to = match wider {
            None => scope,
            Some("parent") => {
                let mut at = self.scopes.parent(scope);
                // A macro of a namespace has the scope around that as its caller's.
                while let Some(space) =
                    at.filter(|&s| !self.scopes.is_space(scope) && self.scopes.is_space(s))
                {
                    at = self.scopes.parent(space);
                }
                at.unwrap_or(scope)
            }
            Some("global") => 0,
            Some(other) => {
                return Err(Fault::new(format!("`{}` is no scope", shown(other)))
                    .hint("scopes are parent and global"));
            }
        };
        if let Some(default) = attribute("default") {
            if self.scopes.find(scope, name).is_none() {
                self.scopes.set(to, name, Self::lazy(&default.value.text, &default.value.span));
            }
        } else if let Some(value) = attribute("value") {
            // What names itself means what it was before, and what goes to another scope what it is here.
            let text = value.value.text.as_str();
            let names_itself = text.contains('$')
                && text.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == name);
            let stored = if wider.is_some() || names_itself || !is_lazy {
                let known = self.text(text, scope);
                if names_itself && known.is_err() {
                    self.scopes.remove(scope, name);
                }
                Stored::Known(known?.unquoted())
            } else {
                Self::lazy(text, &value.value.span)
            };
            self.scopes.set(to, name, stored);
        } else {
            let block = Block::Raw(tree.clone(), element.children.clone());
            self.scopes.set(to, &format!("{BLOCK}{name}"), Stored::Block(block));
        }
        Ok(())
    }

    /// An attribute with its expressions evaluated.
    pub(super) fn attribute(&mut self, attribute: &Attribute, scope: usize) -> Option<Attribute> {
        if !attribute.value.text.contains('$') {
            return Some(attribute.clone());
        }
        let span = attribute.value.span.clone();
        match self.parts(&attribute.value.text, scope) {
            Ok(parts) => {
                let (mut text, mut exact) = (String::new(), vec![]);
                for part in &parts {
                    let start = text.len();
                    text.push_str(&part.show());
                    if let Val::Number(e) = part
                        && decimal(*e).is_none()
                    {
                        exact.push((start..text.len(), *e));
                    }
                }
                Some(Attribute { value: Value { text, span, is_plain: false, exact }, ..attribute.clone() })
            }
            Err(fault) => {
                self.fault(span, fault);
                None
            }
        }
    }
}

/// Whether a pattern of the shell matches a name: `*` stands for any letters, `?` for one, `[a-c]` and `[!a-c]` for one of these or of the
/// others.
fn matches(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) = (pattern.chars().collect(), name.chars().collect());
    let (mut p, mut n) = (0, 0);
    // Where the last `*` stands, and how far it reaches.
    let mut star: Option<(usize, usize)> = None;
    while n < name.len() {
        let one = match pattern.get(p) {
            Some('*') => {
                star = Some((p, n));
                p += 1;
                continue;
            }
            Some('[') => bracket(&pattern[p..], name[n]),
            Some('?') => Some((true, 1)),
            Some(c) => Some((*c == name[n], 1)),
            None => None,
        };
        match (one, star) {
            (Some((true, length)), _) => (p, n) = (p + length, n + 1),
            (_, Some((at, reach))) => {
                star = Some((at, reach + 1));
                (p, n) = (at + 1, reach + 1);
            }
            (_, None) => return false,
        }
    }
    pattern[p..].iter().all(|c| *c == '*')
}

/// Whether the letters in a bracket have one, and the length of the bracket; one that is not closed is a letter.
fn bracket(pattern: &[char], c: char) -> Option<(bool, usize)> {
    let is_not = pattern.get(1) == Some(&'!');
    let start = if is_not { 2 } else { 1 };
    let Some(end) = (start + 1..pattern.len()).find(|&k| pattern[k] == ']') else {
        return Some((c == '[', 1));
    };
    let (mut k, mut found) = (start, false);
    while k < end {
        if k + 2 < end && pattern[k + 1] == '-' {
            found |= (pattern[k]..=pattern[k + 2]).contains(&c);
            k += 3;
        } else {
            found |= pattern[k] == c;
            k += 1;
        }
    }
    Some((found != is_not, end + 1))
}

#[cfg(test)]
mod tests {
    use super::matches;

    /// As Python's `fnmatch` has it.
    #[test]
    fn patterns_match_names() {
        for (pattern, name, is_one) in [
            ("*.xacro", "arm.xacro", true),
            ("*.xacro", "arm.urdf", false),
            ("a*b*c", "aXbYbZc", true),
            ("a*b*c", "acb", false),
            ("?.xacro", "a.xacro", true),
            ("?.xacro", "ab.xacro", false),
            ("[a-c]1", "b1", true),
            ("[!a-c]1", "b1", false),
            ("[]]", "]", true),
            ("a[b", "a[b", true),
            ("*", "", true),
        ] {
            assert_eq!(matches(pattern, name), is_one, "{pattern} {name}");
        }
        let long = "a".repeat(4000);
        assert!(!matches(&"a*".repeat(1000), &format!("b{long}")));
    }
}

//! XML with places and bounds, for the readers of robot descriptions.
//!
//! There are no entities: a document type is refused. Nothing here recurses.

use super::diagnostic::{Diagnostics, nearest};
use roxmltree::{Attribute, Document, Error, Node, ParsingOptions};
use std::ops::Range;

/// The longest text that is read, in bytes.
pub const MAX_XML_BYTES: usize = 16 << 20;
/// The largest number of elements, texts and comments.
const MAX_NODES: u32 = 400_000;
/// How deep elements may stand in elements.
const MAX_DEPTH: usize = 64;
/// The largest number of attributes of one element.
const MAX_ATTRIBUTES: usize = 256;

/// How some editors begin a text.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// What stands before the text proper.
pub(super) fn preamble(text: &str, out: &mut Diagnostics) -> usize {
    let start =
        text.len() - text.trim_start_matches(|c: char| c == BYTE_ORDER_MARK || c.is_whitespace()).len();
    let is_declared = text[start..].starts_with("<?xml");
    if start > 0 && is_declared && text[..start] != *"\u{feff}" {
        out.warning(0..0, "blank lines before `<?xml` are skipped").hint("other readers refuse the file");
    }
    start
}

/// The document, its places counted from `start` on; nothing where it is none, which is said.
pub(super) fn parse<'t>(text: &'t str, start: usize, out: &mut Diagnostics) -> Option<Document<'t>> {
    if text.len() > MAX_XML_BYTES {
        out.error(0..0, format!("the text has {} bytes; {MAX_XML_BYTES} are allowed", text.len()));
        return None;
    }
    if let Some(at) = text.find('\u{fffd}') {
        out.error(at..at + 3, "not UTF-8").hint("save the file as UTF-8");
        return None;
    }
    let body = &text[start..];
    if let Some(at) = too_many_attributes(body) {
        let span = start + at..start + at + 1;
        out.error(span, format!("an element with more than {MAX_ATTRIBUTES} attributes"));
        return None;
    }
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    let document = match Document::parse_with_options(body, options) {
        Ok(document) => document,
        Err(why) => {
            refuse(body, start, &why, out);
            return None;
        }
    };
    let deep = depth(&document).filter(|d| d.0 > MAX_DEPTH);
    if let Some((_, at)) = deep {
        out.error(
            start + at..start + at + 1,
            format!("elements stand in elements more than {MAX_DEPTH} deep"),
        );
        return None;
    }
    Some(document)
}

/// Says why a text is no document.
fn refuse(body: &str, start: usize, why: &Error, out: &mut Diagnostics) {
    let at = match why {
        Error::DtdDetected => body.find("<!DOCTYPE").unwrap_or(0),
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => body.trim_end().len(),
        Error::NoRootNode | Error::NodesLimitReached => 0,
        _ => offset(body, why.pos().row as usize, why.pos().col as usize),
    };
    let message = match why {
        Error::DtdDetected => "a document type is not read".to_string(),
        Error::NodesLimitReached => format!("more than {MAX_NODES} elements"),
        Error::NoRootNode => "there is no element".into(),
        Error::UnexpectedCloseTag(expected, found, _) => {
            format!("`</{}>` closes `<{}>`", shown(found), shown(expected))
        }
        Error::DuplicatedAttribute(name, _) => format!("`{}` is given twice", shown(name)),
        Error::UnknownNamespace(prefix, _) => format!("the prefix `{}:` is not declared", shown(prefix)),
        _ => {
            let text = why.to_string();
            let place = format!(" at {}", why.pos());
            format!("not XML: {}", shown(&text.replace(&place, "")))
        }
    };
    let finding = out.error(start + at..start + at, message);
    match why {
        Error::DtdDetected => finding.hint("entities are not replaced: write what they stand for"),
        Error::UnknownNamespace(prefix, _) => {
            finding.hint(format!(
                "declare it: <robot xmlns:{0}=\"http://www.ros.org/wiki/{0}\">",
                shown(prefix)
            ));
        }
        Error::InvalidAttributeValue(_) => {
            finding.hint("a `<` in a value is written `&lt;`; is a quote missing before it?")
        }
        _ => {}
    }
}

/// A word of the text as it can be shown.
pub(super) fn shown(word: &str) -> String {
    word.chars().take(60).map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// The byte of a line and column, both from 1, columns in characters.
fn offset(text: &str, line: usize, column: usize) -> usize {
    let before: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let rest = &text[before.min(text.len())..];
    before + rest.char_indices().nth(column.saturating_sub(1)).map_or(rest.len(), |c| c.0)
}

/// Where a tag begins that has too many attributes: they are compared with each other when they are read.
fn too_many_attributes(text: &str) -> Option<usize> {
    let mut at = 0;
    while let Some(found) = text[at..].find('<') {
        let tag = at + found;
        let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")]
            .into_iter()
            .find(|(open, _)| text[tag..].starts_with(open));
        if let Some((_, close)) = skipped {
            at = text[tag..].find(close).map(|n| tag + n + close.len())?;
            continue;
        }
        let (mut quote, mut count, mut end) = (None, 0, None);
        for (i, b) in text.as_bytes()[tag + 1..].iter().enumerate() {
            match (quote, b) {
                (None, b'"' | b'\'') => (quote, count) = (Some(*b), count + 1),
                (Some(q), b) if q == *b => quote = None,
                (None, b'>') => {
                    end = Some(tag + 2 + i);
                    break;
                }
                _ => {}
            }
        }
        if count > MAX_ATTRIBUTES {
            return Some(tag);
        }
        at = end?;
    }
    None
}

/// How deep the deepest element stands, and where.
fn depth(document: &Document) -> Option<(usize, usize)> {
    let mut open: Vec<(usize, Node)> = vec![(1, document.root_element())];
    let mut deepest: Option<(usize, usize)> = None;
    while let Some((depth, node)) = open.pop() {
        if deepest.is_none_or(|d| d.0 < depth) {
            deepest = Some((depth, node.range().start));
        }
        if depth <= MAX_DEPTH {
            open.extend(node.children().filter(Node::is_element).map(|n| (depth + 1, n)));
        }
    }
    deepest
}

/// An element and where its text begins.
#[derive(Clone, Copy)]
pub(super) struct Element<'a, 't> {
    node: Node<'a, 't>,
    start: usize,
}

/// A value and its place.
#[derive(Clone, Debug)]
pub(super) struct Text<'a> {
    pub text: &'a str,
    /// All of it.
    pub span: Range<usize>,
    /// True if the bytes of the text stand in the file as they are.
    is_plain: bool,
}

impl<'a, 't> Element<'a, 't> {
    pub fn root(document: &'a Document<'t>, start: usize) -> Self {
        Element { node: document.root_element(), start }
    }

    /// Its name; nothing where it has a prefix.
    pub fn name(&self) -> Option<&'a str> {
        let name = self.node.tag_name();
        name.namespace().is_none().then(|| name.name())
    }

    /// Its name with its prefix.
    pub fn full_name(&self) -> String {
        let name = self.node.tag_name();
        let prefix = name.namespace().and_then(|uri| self.node.lookup_prefix(uri));
        prefix.map_or_else(|| name.name().to_string(), |p| format!("{p}:{}", name.name()))
    }

    /// The beginning of its tag.
    pub fn span(&self) -> Range<usize> {
        let at = self.start + self.node.range().start;
        at..at + 1 + self.full_name().len()
    }

    pub fn children(&self) -> impl Iterator<Item = Element<'a, 't>> + use<'a, 't> {
        let start = self.start;
        self.node.children().filter(Node::is_element).map(move |node| Element { node, start })
    }

    /// The children of this name.
    pub fn all(&self, name: &'static str) -> impl Iterator<Item = Element<'a, 't>> + use<'a, 't> {
        self.children().filter(move |c| c.name() == Some(name))
    }

    /// The first child of this name; a second one is reported.
    pub fn one(&self, name: &'static str, out: &mut Diagnostics) -> Option<Element<'a, 't>> {
        let mut all = self.all(name);
        let first = all.next();
        if let Some(second) = all.next() {
            out.warning(second.span(), format!("a second <{name}>; the first one counts"));
        }
        first
    }

    pub fn attribute(&self, name: &str) -> Option<Text<'a>> {
        self.node.attributes().find(|a| a.namespace().is_none() && a.name() == name).map(|a| self.text(&a))
    }

    fn text(&self, attribute: &Attribute<'a, 't>) -> Text<'a> {
        let range = attribute.range_value();
        let is_plain = attribute.value().len() == range.len();
        Text { text: attribute.value(), span: self.start + range.start..self.start + range.end, is_plain }
    }

    /// Warns of attributes that are not among these.
    pub fn only(&self, known: &[&str], out: &mut Diagnostics) {
        for attribute in self.node.attributes().filter(|a| a.namespace().is_none()) {
            let name = attribute.name();
            if known.contains(&name) || out.is_full() {
                continue;
            }
            let range = attribute.range_qname();
            let element = self.full_name();
            let span = self.start + range.start..self.start + range.end;
            let finding = out.warning(span, format!("<{element}> has no `{}`: it is skipped", shown(name)));
            if let Some(near) = nearest(name, known.iter().copied()) {
                finding.hint(format!("did you mean `{near}`?"));
            }
        }
    }
}

impl<'a> Text<'a> {
    /// The words between blanks, with their places.
    pub fn words(&self) -> Vec<Text<'a>> {
        let at = |word: &str| word.as_ptr() as usize - self.text.as_ptr() as usize;
        let place = |word: &'a str| match self.is_plain {
            true => self.span.start + at(word)..self.span.start + at(word) + word.len(),
            false => self.span.clone(),
        };
        let words = self.text.split_whitespace();
        words.map(|word| Text { text: word, span: place(word), is_plain: self.is_plain }).collect()
    }
}

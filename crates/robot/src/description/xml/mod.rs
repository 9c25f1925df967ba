//! XML with places and bounds, for the readers of robot descriptions.
//!
//! There are no entities: a document type is refused. Nothing here recurses.

mod tree;
mod write;

pub(super) use tree::{Attribute, Element, Node, Text, Tree, Value};
pub(super) use write::{escaped, number};

use super::diagnostic::Diagnostics;
use roxmltree::{Document, Error, ParsingOptions};

/// The longest text that is read, in bytes.
pub const MAX_XML_BYTES: usize = 16 << 20;
/// The largest number of elements, texts and comments.
const MAX_NODES: u32 = 400_000;
/// How deep elements may stand in elements where a format does not nest what it describes.
const MAX_DEPTH: usize = 64;
/// The largest number of attributes of one element.
const MAX_ATTRIBUTES: usize = 256;

/// How some editors begin a text.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// The name of the root element of a text, if it begins as XML does.
pub fn root_element(text: &str) -> Option<&str> {
    let mut rest = text;
    loop {
        rest = rest.trim_start_matches(|c: char| c == BYTE_ORDER_MARK || c.is_whitespace());
        let skipped =
            [("<!--", "-->"), ("<?", "?>"), ("<!", ">")].into_iter().find(|s| rest.starts_with(s.0));
        match skipped {
            Some((_, close)) => rest = &rest[rest.find(close)? + close.len()..],
            None => break,
        }
    }
    let name = rest.strip_prefix('<')?;
    let end = name.find(|c: char| c.is_whitespace() || matches!(c, '>' | '/' | '<')).unwrap_or(name.len());
    Some(&name[..end]).filter(|n| !n.is_empty())
}

/// What stands before the text proper.
fn preamble(text: &str, file: usize, out: &mut Diagnostics) -> usize {
    let start =
        text.len() - text.trim_start_matches(|c: char| c == BYTE_ORDER_MARK || c.is_whitespace()).len();
    let is_declared = text[start..].starts_with("<?xml");
    if start > 0 && is_declared && text[..start] != *"\u{feff}" {
        out.warning(file..file, "blank lines before `<?xml` are skipped")
            .hint("other readers refuse the file");
    }
    start
}

/// The elements of a text that begins at byte `file` of all that is read; nothing where it is no document, which is said.
pub(super) fn parse(text: &str, file: usize, out: &mut Diagnostics) -> Option<Tree> {
    parse_to(MAX_DEPTH, text, file, out)
}

/// As [`parse`] does, for elements that stand in each other so deep at most.
pub(super) fn parse_to(most: usize, text: &str, file: usize, out: &mut Diagnostics) -> Option<Tree> {
    if text.len() > MAX_XML_BYTES {
        out.error(file..file, format!("the text has {} bytes; {MAX_XML_BYTES} are allowed", text.len()));
        return None;
    }
    if let Some(at) = text.find('\u{fffd}') {
        out.error(file + at..file + at + 3, "not UTF-8").hint("save the file as UTF-8");
        return None;
    }
    let before = preamble(text, file, out);
    let start = file + before;
    let body = &text[before..];
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
    let deep = depth(&document, most).filter(|d| d.0 > most);
    if let Some((_, at)) = deep {
        let message = format!("elements stand in elements more than {most} deep");
        out.error(start + at..start + at + 1, message);
        return None;
    }
    Some(Tree::of(&document, start))
}

/// Says why a text is no document.
fn refuse(body: &str, start: usize, why: &Error, out: &mut Diagnostics) {
    let at = match why {
        Error::DtdDetected => body.find("<!DOCTYPE").unwrap_or(0),
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => body.trim_end().len(),
        Error::NoRootNode => 0,
        Error::NodesLimitReached => node(body, MAX_NODES as usize).unwrap_or(0),
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

/// Where the element or comment begins before which there are so many, texts between them counted.
fn node(text: &str, count: usize) -> Option<usize> {
    let (mut seen, mut at) = (0, 0);
    while let Some(found) = text[at..].find('<') {
        let tag = at + found;
        // The text in front of it.
        seen += usize::from(found > 0);
        if !text[tag..].starts_with("</") {
            seen += 1;
        }
        if seen >= count {
            return Some(tag);
        }
        let closed =
            if text[tag..].starts_with("<!--") { text[tag..].find("-->") } else { text[tag..].find('>') };
        at = tag + closed? + 1;
    }
    None
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
fn depth(document: &Document, most: usize) -> Option<(usize, usize)> {
    let mut open: Vec<(usize, roxmltree::Node)> = vec![(1, document.root_element())];
    let mut deepest: Option<(usize, usize)> = None;
    while let Some((depth, node)) = open.pop() {
        if deepest.is_none_or(|d| d.0 < depth) {
            deepest = Some((depth, node.range().start));
        }
        if depth <= most {
            open.extend(node.children().filter(roxmltree::Node::is_element).map(|n| (depth + 1, n)));
        }
    }
    deepest
}

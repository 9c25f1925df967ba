//! Rows that stand on others than the row above, and frames with names: a tree.

use super::fields::{Fields, Reader};
use super::frames::FrameCells;
use super::joints::Draft;
use super::{Convention, Described};
use crate::description::branches::{BASE, NamedFrame, RowTree};
use crate::description::diagnostic::nearest;
use crate::description::{Description, Diagnostic, NotCoupled, Severity};
use crate::geometry::Transform;
use toml::Spanned;
use toml::de::DeValue;

/// What makes rows a tree.
pub(super) struct Branches {
    after: Vec<Option<usize>>,
    frames: Vec<NamedFrame>,
    tip: Option<String>,
}

impl Branches {
    /// The tree of rows that were read as a table.
    pub fn tree(self, d: Description) -> RowTree {
        RowTree { frames: self.frames, tip: self.tip, ..RowTree::of_rows(d, self.after) }
    }
}

impl Described {
    /// The tree of rows, if it is one.
    pub fn tree(self) -> Option<RowTree> {
        match self {
            Described::Tree(tree) => Some(*tree),
            Described::Chain(_) | Described::Linkage(_) => None,
        }
    }

    /// The chain, or of a tree the one to its tip; what it was read with goes on.
    ///
    /// # Errors
    /// If a tree has no such chain.
    pub fn chain(
        self,
        mut findings: Vec<Diagnostic>,
    ) -> Result<(Description, Vec<Diagnostic>), Vec<Diagnostic>> {
        let finding = |severity, message| Diagnostic { severity, span: 0..0, message, hint: None };
        let (what, chain) = match self {
            Described::Chain(d) => return Ok((*d, findings)),
            Described::Tree(tree) => {
                ("a tree", tree.chain(None, None, Convention::Khalil).map_err(NotCoupled::NoChain))
            }
            Described::Linkage(linkage) => {
                ("a tree with closed loops", linkage.chain(None, None, None, Convention::Khalil))
            }
        };
        match chain {
            Ok(chain) => {
                let message = format!("{what}: this is the chain from `{}` to `{}`", chain.from, chain.to);
                findings.insert(0, finding(Severity::Note, message));
                Ok((chain.description, findings))
            }
            Err(why) => {
                findings.insert(0, finding(Severity::Error, why.to_string()));
                Err(findings)
            }
        }
    }
}

impl Reader<'_> {
    /// Finds out whether the rows are a tree; gives the cells of its frames.
    pub fn branches(
        &mut self,
        fields: &Fields,
        drafts: &[Draft],
        convention: Option<Convention>,
    ) -> Vec<FrameCells> {
        let keys = ["frames", "tip"].map(|k| fields.get(k));
        let has_after = drafts.iter().any(|d| d.fields.get("after").is_some());
        let is_closed = fields.get("closures").is_some();
        if !has_after && !is_closed && keys.iter().all(Option::is_none) {
            return vec![];
        }
        if convention != Some(Convention::Khalil) {
            for key in keys.iter().flatten() {
                self.out
                    .error(key.span(), "a tree stands in the convention khalil")
                    .hint("convention = \"khalil\": each row names the row that it stands `after`");
            }
            return vec![];
        }
        if let Some(value) = fields.get("tool") {
            self.out
                .error(value.span(), "`tool` in a tree")
                .hint("frames with names are [[frames]]: name, on, xyz, rpy");
        }
        let names: Vec<Option<String>> = drafts.iter().map(|d| self.string(d.fields.get("name"))).collect();
        let mut after = vec![];
        for (j, draft) in drafts.iter().enumerate() {
            let row = draft.fields.get("after").map(|v| self.row_named(v, &names, j));
            after.push(row.unwrap_or(Some(j.checked_sub(1))).flatten());
        }
        let (frames, cells) = self.named_frames(keys[0], &names);
        let tip = self.string(keys[1]);
        let known = |name: &str| {
            let row = (0..names.len())
                .any(|j| names[j].as_deref().map_or((j + 1).to_string() == name, |n| n == name));
            row || frames.iter().any(|f| f.name == name)
        };
        if let (Some(tip), Some(value)) = (&tip, keys[1])
            && !known(tip)
        {
            let all = names.iter().flatten().chain(frames.iter().map(|f| &f.name)).map(String::as_str);
            let near = nearest(tip, all).map(|n| format!("did you mean `{n}`?"));
            self.out
                .error(value.span(), "there is no frame of this name")
                .hint(near.unwrap_or("`tip` names a row or one of [[frames]]".into()));
        }
        self.say_doubled(drafts, &names, &frames, keys[0]);
        self.branches = Some(Branches { after, frames, tip });
        cells
    }

    /// The row that a value names, one of the first `most`: by its name or its number; "base" and 0 are frame 0.
    pub(super) fn row_named(
        &mut self,
        value: &Spanned<DeValue>,
        names: &[Option<String>],
        most: usize,
    ) -> Option<Option<usize>> {
        let (row, shown) = match value.get_ref() {
            DeValue::String(text) if text == BASE => return Some(None),
            DeValue::String(text) => {
                let by_name = names.iter().position(|n| n.as_deref() == Some(text.as_ref()));
                let number =
                    text.parse::<usize>().ok().filter(|n| (1..=names.len()).contains(n)).map(|n| n - 1);
                (by_name.or(number), text.to_string())
            }
            DeValue::Integer(n) => match n.as_str().parse::<usize>() {
                Ok(0) => return Some(None),
                Ok(n) if n <= names.len() => (Some(n - 1), n.to_string()),
                _ => (None, n.as_str().to_string()),
            },
            _ => (None, String::new()),
        };
        match row {
            Some(row) if row < most => Some(Some(row)),
            Some(_) => {
                self.out
                    .error(value.span(), format!("`{shown}` does not come before this row"))
                    .hint("rows are written from the base outwards");
                None
            }
            None => {
                let near = nearest(&shown, names.iter().flatten().map(String::as_str));
                let near = near.map(|n| format!("did you mean `{n}`?"));
                let hint =
                    near.unwrap_or("a row is named by its `name` or its number; \"base\" is frame 0".into());
                self.out.error(value.span(), "there is no row of this name").hint(hint);
                None
            }
        }
    }

    fn named_frames(
        &mut self,
        value: Option<&Spanned<DeValue>>,
        names: &[Option<String>],
    ) -> (Vec<NamedFrame>, Vec<FrameCells>) {
        let (mut frames, mut all) = (vec![], vec![]);
        let Some(array) = value.and_then(|v| self.array(v, "[[frames]]")) else { return (frames, all) };
        if array.len() > super::MAX_ROWS {
            self.out.error(
                value.map_or(0..0, Spanned::span),
                format!("{} frames; {} are allowed", array.len(), super::MAX_ROWS),
            );
            return (frames, all);
        }
        for item in array.iter() {
            let Some(fields) = self.table(item, "frames") else { continue };
            let (pose, cells) = self.pose(&fields, &["name", "on"]);
            let name = self.string(fields.get("name"));
            if name.is_none() {
                self.out.error(fields.span.clone(), "a frame has a name");
            }
            let on = match fields.get("on") {
                Some(value) => self.row_named(value, names, names.len()),
                None => {
                    self.out
                        .error(fields.span.clone(), "on which row does this frame stand?")
                        .hint("on = \"NAME\", or the number of a row; \"base\" is frame 0");
                    None
                }
            };
            all.push(cells);
            if let (Some(name), Some(on)) = (name, on) {
                frames.push(NamedFrame { name, on, pose: pose.unwrap_or_else(Transform::identity) });
            }
        }
        (frames, all)
    }

    /// Every frame has a name of its own.
    fn say_doubled(
        &mut self,
        drafts: &[Draft],
        names: &[Option<String>],
        frames: &[NamedFrame],
        value: Option<&Spanned<DeValue>>,
    ) {
        let mut seen: Vec<String> = vec![BASE.into()];
        let rows = names
            .iter()
            .enumerate()
            .map(|(j, n)| (n.clone().unwrap_or((j + 1).to_string()), drafts[j].cells.span.clone()));
        let spans = frames.iter().map(|f| (f.name.clone(), value.map_or(0..0, Spanned::span)));
        for (name, span) in rows.chain(spans).collect::<Vec<_>>() {
            if seen.contains(&name) {
                self.out.error(span, format!("a second frame is called `{name}`"));
            } else {
                seen.push(name);
            }
        }
    }
}

//! Slides as Typst markup: each step is a page, on which what is to come keeps its place.

use super::{Pace, Slide, deck, place};
use crate::document::{Document, Section};
use crate::render::typst::{HEAD, parts, quoted, words};
use crate::words::Wording;
use std::fmt::Write;

/// How slides look, and what makes one.
const LOOK: &str = r##"#let ink = rgb("#17395c")
#let faint = luma(110)
#let number = counter("slide")
#set page(width: 841.89pt, height: 473.56pt, margin: (x: 48pt, top: 30pt, bottom: 40pt), footer: context align(right, text(11pt, fill: faint)[#number.display() / #number.final().first()]))
#set text(font: "New Computer Modern", size: 16pt)
#set par(leading: 0.6em, spacing: 0.85em)
#set table(stroke: none, inset: (x: 0.55em, y: 0.36em))
#set list(indent: 0.4em, spacing: 0.6em)
#set figure(numbering: none)
#show heading.where(level: 1): set text(1em / 1.4)
#show heading.where(level: 2): set text(1em / 1.2, weight: "regular")
#show heading: it => it.body
#show figure.where(kind: table): set figure.caption(position: top)
#show figure.caption: it => text(0.85em, it.body)
#show math.equation.where(block: true): set align(left)
#show math.equation.where(block: true): it => pad(left: 1em, it)
#show figure.where(kind: image): it => align(center, layout(size => {
  let own = measure(it.body)
  let grown = calc.min(size.width / own.width, 295pt / own.height, 2.4)
  scale(grown * 100%, reflow: true, it.body)
  v(1em, weak: true)
  it.caption
}))
// What is too tall is set wider and scaled down.
#let fitted(body) = layout(size => {
  let share = 1.0
  let tall(share) = measure(block(width: size.width / share, body)).height * share
  while share > 0.3 and tall(share) > size.height { share -= 0.04 }
  if share == 1.0 { body } else { scale(share * 100%, origin: top + left, reflow: true, block(width: size.width / share, body)) }
})
#let slide(title, under, place, bookmark, reminder, ..all) = {
  let steps = all.pos()
  for shown in if paced { range(steps.len()) } else { (steps.len() - 1,) } {
    pagebreak(weak: true)
    let is-first = shown == 0 or not paced
    if is-first { number.step() }
    let head = block(width: 100%, stroke: (bottom: 0.8pt + ink), inset: (bottom: 0.5em), {
      set text(1.3em, fill: ink, weight: "bold", hyphenate: false)
      if is-first and bookmark { heading(level: 1, title) } else { title }
      if under != none {
        set text(0.77em, weight: "regular")
        h(0.9em)
        if is-first and place.starts-with(regex("1/|$")) { heading(level: 2, under) } else { under }
      }
      h(1fr)
      text(0.6em, fill: faint, weight: "regular", place)
    })
    // Each by itself, so that lists do not grow together.
    let body = {
      if reminder != none { text(fill: faint, reminder) }
      for (k, step) in steps.enumerate() { block(width: 100%, if k <= shown { step } else { hide(step) }) }
    }
    grid(rows: (auto, 1fr), row-gutter: 1.1em, head, fitted(body))
  }
}
"##;

/// The slides of a document.
pub fn slides(document: &Document, pace: Pace) -> String {
    let said = document.language.words();
    let title = quoted(&document.title);
    let deck = deck(document);
    let steps = |slide: &Slide| if pace == Pace::Steps { slide.steps.len() } else { 1 };
    let mut out = HEAD.to_string();
    let _ = writeln!(out, "// {} pages", 1 + deck.iter().map(steps).sum::<usize>());
    let _ = writeln!(out, "#let paced = {}", pace == Pace::Steps);
    out.push_str(LOOK);
    let _ = writeln!(
        out,
        "#set text(lang: \"{}\")\n#set document(title: {title}, date: none)\n\n#number.step()\n#v(1fr)\n\
         #align(center, text(2em, fill: ink, weight: \"bold\", hyphenate: false, {title}))",
        said.code()
    );
    if let Some(author) = &document.author {
        let author = quoted(author);
        let _ = writeln!(out, "#set document(author: {author})\n#align(center, text(1.2em, {author}))");
    }
    out.push_str("#v(1.4fr)\n\n");
    for slide in &deck {
        one(slide, said, &mut out);
    }
    out
}

fn one(slide: &Slide, said: &dyn Wording, out: &mut String) {
    let set = |section: &Section| {
        let mut out = String::new();
        parts(section, said, 1, &mut out);
        out
    };
    let optional = |content: Option<String>| content.map_or("none".into(), |c| format!("[{c}]"));
    let _ = writeln!(
        out,
        "#slide([{}], {}, \"{}\", {}, {},",
        words(&slide.title, &slide.names),
        optional(slide.under.as_ref().map(|line| words(line, &slide.names))),
        place(slide.place),
        slide.opens,
        optional(slide.reminder.as_ref().map(set)),
    );
    for step in &slide.steps {
        let _ = writeln!(out, "[{}],", set(step));
    }
    out.push_str(")\n\n");
}

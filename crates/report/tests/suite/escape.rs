//! Whatever words a document contains, in no format do they become anything but words.

use denavit_report::document::{Block, Branch, Line, Math};
use denavit_report::figure::drawing::{Anchor, Drawing, Ink, Label, Shape};
use denavit_report::words::Tongue;
use denavit_report::{Document, Figure, Part, Section, Table, render};
use denavit_symbolic::Expr;
use denavit_symbolic::vocabulary::Vocabulary;
use proptest::prelude::*;

/// A document with these words at every place that takes words.
fn document(words: &str) -> Document {
    let line = || Line::new(words).strong(words).math(Expr::symbol(words));
    let drawing = || Drawing {
        width: 100.0,
        height: 100.0,
        description: words.into(),
        shapes: vec![Shape::Text {
            at: [10.0, 10.0],
            anchor: Anchor::Start,
            size: 10.0,
            ink: Ink::Line,
            label: Label::words(words).and(Label::symbol(words, words)),
        }],
    };
    let branch = Branch { line: line(), children: vec![] };
    let mut section = Section::new(Vocabulary::new().symbol(words));
    section.heading(2, line());
    section.paragraph(line());
    section.push(Block::List(vec![line(), line()]));
    section.push(Block::Tree(Branch { line: line(), children: vec![branch] }));
    section.push(Part::Summary(vec![(line(), line())]));
    section.push(Part::Equations(vec![Math::equation(Expr::symbol(words), Expr::int(1))]));
    section.push(Part::Table(Table { caption: line(), head: vec![line()], rows: vec![vec![line()]] }));
    let figure = || Figure { caption: line(), pictures: vec![(drawing(), Line::default())] };
    section.push(Part::Figure(figure()));
    section
        .push(Part::Figure(Figure { pictures: vec![(drawing(), line()), (drawing(), line())], ..figure() }));
    section.push(Part::Code(words.into()));
    Document {
        title: words.into(),
        author: Some(format!("{words}a")),
        language: Tongue::English,
        sections: vec![section],
    }
}

/// Words made of what means something in one of the formats.
fn hostile() -> impl Strategy<Value = String> {
    let fragments = prop::sample::select(vec![
        "\\",
        "\\\\",
        "{",
        "}",
        "$",
        "$$",
        "#",
        "%",
        "&",
        "_",
        "^",
        "~",
        "<",
        ">",
        "\"",
        "'",
        "`",
        "```",
        "*",
        "**",
        "|",
        "[",
        "]",
        "(",
        ")",
        "!",
        "-",
        "- ",
        "1. ",
        "+",
        "=",
        "\n",
        "\n\n",
        "\r",
        "\t",
        " ",
        "  ",
        "\0",
        "\u{7f}",
        "\u{85}",
        "\u{a0}",
        "\u{200b}",
        "\u{202e}",
        "\u{2028}",
        "\u{fffe}",
        "é",
        "œ",
        "θ",
        "中",
        "🤖",
        "/",
        "//",
        "/*",
        "@",
        ":",
        ";",
        "</p>",
        "<script>",
        "-->",
        "]]>",
        "&lt;",
        "&#60;",
        "\\end{document}",
        "\\input{x}",
        "#eval(1)",
        "#{",
        "]#",
        "$x$",
        "![a](b)",
        "[a](b)",
        "# a",
        "> a",
        "| a | b |",
        "<!--",
        "\\)",
        "\\]",
        "http://a.b",
        "a@b.c",
        "x",
        "link 1",
        "θ1",
    ]);
    prop::collection::vec(fragments, 1..8).prop_map(|all| all.concat())
}

/// Element and attribute names in order.
fn elements(html: &str) -> Vec<String> {
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let tree = roxmltree::Document::parse_with_options(html, options).expect("well-formed");
    // How a formula is built depends on the length of its names.
    let is_inside = |n: &roxmltree::Node| n.ancestors().skip(1).any(|a| a.tag_name().name() == "math");
    let named = |n: roxmltree::Node| {
        // What is wide can be scrolled by keys.
        let scrolls = |name: &str| ["tabindex", "role", "aria-label"].contains(&name);
        let attributes: Vec<&str> = n.attributes().map(|a| a.name()).filter(|a| !scrolls(a)).collect();
        format!("{} {}", n.tag_name().name(), attributes.join(" "))
    };
    const MATHS: &[&str] = &[
        "mrow", "mi", "mo", "mn", "msub", "mtable", "mtr", "mtd", "mspace", "mtext", "mfrac", "msup", "msqrt",
    ];
    let all = || tree.descendants().filter(roxmltree::Node::is_element);
    assert!(all().filter(is_inside).all(|n| MATHS.contains(&n.tag_name().name())));
    all().filter(|n| !is_inside(n)).map(named).collect()
}

/// Kinds of markup in order; letters of words left aside.
fn markup(typst: &str) -> Vec<String> {
    let root = typst_syntax::parse(typst);
    assert!(root.errors().is_empty(), "{:?}\n{typst}", root.errors());
    let mut kinds = vec![];
    let mut stack = vec![&root];
    while let Some(node) = stack.pop() {
        kinds.push(format!("{:?}", node.kind()));
        stack.extend(node.children());
    }
    kinds
}

/// TeX's own characters and control words, in order, without those that escaping writes.
fn commands(latex: &str) -> String {
    let mut text = latex.to_string();
    let escapes = [
        "\\textbackslash{}",
        "\\textasciitilde{}",
        "\\textasciicircum{}",
        "\\textless{}",
        "\\textgreater{}",
        "\\textbar{}",
        "{\\oe}",
        "\\#",
        "\\$",
        "\\%",
        "\\&",
        "\\_",
        "\\{",
        "\\}",
        "$\\theta$",
        "\\theta",
    ];
    for escape in escapes {
        text = text.replace(escape, "");
    }
    text.chars().filter(|c| "\\{}$&#%".contains(*c)).collect()
}

/// Kinds of Markdown in order; words left aside.
fn events(markdown: &str) -> Vec<String> {
    let options = pulldown_cmark::Options::all();
    let parser = pulldown_cmark::Parser::new_ext(markdown, options);
    let mut kinds: Vec<String> = vec![];
    for event in parser {
        use pulldown_cmark::{Event, Tag, TagEnd};
        match event {
            Event::Text(_) | Event::SoftBreak => {}
            // Either spelling of what stands out.
            Event::Start(Tag::Strong) | Event::End(TagEnd::Strong) => kinds.push("strong".into()),
            Event::InlineHtml(tag) if ["<strong>", "</strong>"].contains(&&*tag) => {
                kinds.push("strong".into())
            }
            Event::Start(tag) => kinds.push(format!("{:?}", std::mem::discriminant(&tag))),
            Event::End(_) => kinds.push("end".into()),
            Event::InlineMath(_) | Event::DisplayMath(_) => kinds.push("math".into()),
            other => kinds.push(format!("{:?}", std::mem::discriminant(&other))),
        }
    }
    kinds
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn words_stay_words_in_html(words in hostile()) {
        prop_assert_eq!(elements(&render::html(&document(&words))), elements(&render::html(&document("x"))));
    }

    #[test]
    fn words_stay_words_in_typst(words in hostile()) {
        let plain = |d: &Document| {
            let mut kinds = markup(&render::typst(d));
            // A name with an index is set with one.
            kinds.sort();
            kinds.dedup();
            kinds
        };
        // With a name that has an index, and with one that fills a line.
        let mut allowed = plain(&document("xx_1"));
        allowed.extend(plain(&document(&"long name ".repeat(12))));
        for kind in plain(&document(&words)) {
            let is_maths = kind.starts_with("Math") || ["Text", "Space", "Underscore", "Hash", "Shorthand", "LeftParen", "RightParen"].contains(&&kind[..]);
            prop_assert!(allowed.contains(&kind) || is_maths, "{} in {:?}", kind, words);
        }
    }

    #[test]
    fn words_stay_words_in_latex(words in hostile()) {
        let name = |d: &Document| {
            let mut d = d.clone();
            // Names in formulas have a grammar of their own, tested where formulas are printed.
            for part in &mut d.sections[0].parts {
                if let Part::Equations(all) = part { all.clear(); }
            }
            render::latex(&d)
        };
        let text = name(&document(&words));
        let begun = text.matches("\\begin{").count();
        prop_assert_eq!(begun, text.matches("\\end{").count());
        prop_assert_eq!(text.matches("\\end{document}").count(), 1);
        prop_assert!(!text.replace("\\\\", "").contains("\\input"));
        let depth = commands(&text).chars().fold(0_i32, |d, c| d + i32::from(c == '{') - i32::from(c == '}'));
        prop_assert_eq!(depth, 0);
        prop_assert!(text.chars().all(|c| c == '\n' || !c.is_control()));
    }

    #[test]
    fn words_stay_words_in_markdown(words in hostile()) {
        let kinds = |w: &str| {
            let mut d = document(w);
            for part in &mut d.sections[0].parts {
                if let Part::Equations(all) = part { all.clear(); }
            }
            events(&render::markdown(&d, "figures").text)
        };
        prop_assert_eq!(kinds(&words), kinds("x"), "{}", render::markdown(&document(&words), "figures").text);
    }
}

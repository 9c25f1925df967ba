//! HTML of the Markdown that sheets are written in, with formulas in TeX between `\(…\)` and `\[…\]`, as MathJax reads them.

/// A text that is no markup.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// The HTML; `figure` says where a picture is.
pub(super) fn html(markdown: &str, figure: impl Fn(&str) -> String) -> String {
    let (mut out, mut lines) = (String::new(), markdown.lines().peekable());
    while let Some(line) = lines.next() {
        let line = line.trim();
        let heading = line.bytes().take_while(|b| *b == b'#').count();
        if line.is_empty() {
        } else if line == "$$" {
            let formula: Vec<&str> = lines.by_ref().take_while(|l| l.trim() != "$$").collect();
            out += &format!("<p>\\[{}\\]</p>\n", escaped(&formula.join(" ")));
        } else if heading > 0 {
            let level = heading + 1;
            out += &format!("<h{level}>{}</h{level}>\n", spans(line[heading..].trim()));
        } else if let Some(rest) = line.strip_prefix("![") {
            let (alt, rest) = rest.split_once("](").unwrap_or((rest, ""));
            let source = figure(rest.trim_end_matches(')'));
            out += &format!("<p><img src=\"{}\" alt=\"{}\"></p>\n", escaped(&source), escaped(alt));
        } else if line.starts_with('|') {
            out += "<table border=\"1\" cellpadding=\"4\">\n";
            out += &row(line, "th");
            while let Some(line) = lines.next_if(|l| l.trim_start().starts_with('|')) {
                // The line below the heads.
                if line.contains(|c: char| !matches!(c, '|' | ':' | '-' | ' ')) {
                    out += &row(line.trim(), "td");
                }
            }
            out += "</table>\n";
        } else if let Some(item) = line.strip_prefix("- ") {
            out += &format!("<ul><li>{}</li>", spans(item));
            while let Some(line) = lines.next_if(|l| l.trim_start().starts_with("- ")) {
                out += &format!("<li>{}</li>", spans(line.trim().trim_start_matches("- ")));
            }
            out += "</ul>\n";
        } else {
            out += &format!("<p>{}</p>\n", spans(line));
        }
    }
    out
}

fn row(line: &str, tag: &str) -> String {
    let cells = line.trim_matches('|').split(" | ").map(str::trim);
    let cells: String = cells.map(|c| format!("<{tag}>{}</{tag}>", spans(c))).collect();
    format!("<tr>{cells}</tr>\n")
}

/// Formulas and words that stand out in a line.
pub(super) fn spans(line: &str) -> String {
    let mut out = String::new();
    for (k, part) in line.split('$').enumerate() {
        if k % 2 == 1 {
            out += &format!("\\({}\\)", escaped(part));
            continue;
        }
        for (k, words) in part.split("**").enumerate() {
            let words = escaped(words).replace("\\*", "*").replace("\\_", "_");
            out += &if k % 2 == 1 { format!("<b>{words}</b>") } else { words };
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::html;

    #[test]
    fn sheets_become_pages() {
        let markdown = "## The arm\n\n![a < b](figures/figure-1.svg)\n\n| $j$ | **d** |\n|:-:|--:|\n| 1 | $q_{1}$ |\n\n- one\n- $x < y$\n\n$$\nA = B\n$$";
        let expected = "<h3>The arm</h3>\n<p><img src=\"at/figures/figure-1.svg\" alt=\"a &lt; b\"></p>\n\
                        <table border=\"1\" cellpadding=\"4\">\n<tr><th>\\(j\\)</th><th><b>d</b></th></tr>\n\
                        <tr><td>1</td><td>\\(q_{1}\\)</td></tr>\n</table>\n\
                        <ul><li>one</li><li>\\(x &lt; y\\)</li></ul>\n<p>\\[A = B\\]</p>\n";
        assert_eq!(html(markdown, |name| format!("at/{name}")), expected);
    }
}

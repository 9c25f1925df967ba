//! A question of PrairieLearn: `info.json`, `question.html`, the pictures. Nothing is drawn at random there: each seed is a question.

use super::html::escaped;
use super::{SHARE, asked, body, by_hand, mark, quoted, written};
use crate::exercise::Exercise;

/// The files of the question's folder with their texts.
pub fn prairielearn(e: &Exercise) -> Vec<(String, String)> {
    let sheet = body(&e.statement);
    let name = |path: &str| path.rsplit('/').next().unwrap_or(path).to_string();
    let mut text = sheet.text;
    let mut files = vec![];
    for (path, svg) in sheet.figures {
        text = drawn(&text, &path, &name(&path));
        files.push((format!("clientFilesQuestion/{}", name(&path)), svg));
    }
    let mut page = panel("pl-question-panel", &text);
    let (mut number, mut is_numeric) = (0, false);
    for question in e.questions.iter().filter(|q| !q.fields.is_empty()) {
        page += &panel("pl-question-panel", &format!("### {}", question.name));
        let mut group = "";
        for field in &question.fields {
            if field.group != group {
                group = &field.group;
                page += &panel("pl-question-panel", &format!("**{group}**"));
            }
            number += 1;
            is_numeric = true;
            let label = escaped(&format!("${} =$", apart(&field.label)));
            page += &format!(
                "<pl-number-input answers-name=\"a{number}\" label=\"{label}\" suffix=\"{}\" comparison=\"relabs\" rtol=\"{SHARE}\" \
                 atol=\"{}\" correct-answer=\"{}\"></pl-number-input>\n",
                escaped(&field.unit),
                written(field.least()),
                written(field.value)
            );
        }
    }
    for (k, question) in (1..).zip(by_hand(e)) {
        page += &panel("pl-question-panel", &format!("### {}\n\n{}", question.name, asked(e, question)));
        page += &format!("<pl-rich-text-editor file-name=\"task{k}.html\"></pl-rich-text-editor>\n");
    }
    page += &panel("pl-answer-panel", &body(&e.solution).text);
    files.push(("question.html".into(), page));
    files.push(("info.json".into(), info(e, is_numeric)));
    files
}

/// Braces that Mustache does not take for its own.
fn apart(text: &str) -> String {
    let mut text = text.to_string();
    while text.contains("{{") {
        text = text.replace("{{", "{ {");
    }
    text
}

fn panel(tag: &str, markdown: &str) -> String {
    format!("<{tag}>\n<markdown>\n{}\n</markdown>\n</{tag}>\n", apart(markdown.trim()))
}

/// The Markdown of a picture as the element that shows it.
fn drawn(text: &str, path: &str, name: &str) -> String {
    let is_it = |line: &&str| line.starts_with("![") && line.contains(path);
    let shown = format!("</markdown>\n<pl-figure file-name=\"{name}\"></pl-figure>\n<markdown>");
    text.lines().map(|line| if is_it(&line) { shown.as_str() } else { line }).collect::<Vec<_>>().join("\n")
}

fn info(e: &Exercise, is_numeric: bool) -> String {
    let [a, b] = mark(e);
    // A random number by its form (RFC 9562), the same for the same exercise.
    let uuid = format!(
        "{:08x}-{:04x}-4{:03x}-8{:03x}-{:012x}",
        a >> 32,
        (a >> 16) & 0xffff,
        a & 0xfff,
        b >> 52,
        b & 0xffff_ffff_ffff
    );
    let title = format!("{} ({})", e.statement.title, e.options.seed);
    let kind = e.options.kind.name();
    let grading = if is_numeric { "Internal" } else { "Manual" };
    format!(
        "{{\n  \"uuid\": \"{uuid}\",\n  \"title\": {},\n  \"topic\": \"Robot kinematics\",\n  \"tags\": [\"denavit\", \"{kind}\"],\n  \
         \"type\": \"v3\",\n  \"gradingMethod\": \"{grading}\",\n  \"singleVariant\": true\n}}\n",
        quoted(&title)
    )
}

//! Moodle XML: of each exercise a question with gaps for the numbers, and an essay for each task that asks for formulas.

use super::html::{escaped, html, spans};
use super::{Question, answer, asked, body, by_hand, written};
use crate::exercise::Exercise;
use base64::Engine;

/// One file for all of them, in a category of their own: a quiz that draws from it gives each student another.
pub fn moodle(all: &[Exercise]) -> String {
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<quiz>\n");
    if let Some(first) = all.first() {
        let kind = first.options.kind.name();
        out += &format!(
            "<question type=\"category\"><category><text>$course$/top/Denavit/{kind}</text></category></question>\n"
        );
    }
    for e in all {
        out += &gaps(e).unwrap_or_default();
        by_hand(e).for_each(|question| out += &essay(e, question));
    }
    out + "</quiz>\n"
}

/// A text that stands as it is.
fn kept(text: &str) -> String {
    format!("<![CDATA[{}]]>", text.replace("]]>", "]]]]><![CDATA[>"))
}

/// The sheet, and its pictures as files.
fn sheet(e: &Exercise) -> (String, String) {
    let sheet = body(&e.statement);
    let name = |path: &str| path.rsplit('/').next().unwrap_or(path).to_string();
    let text = html(&sheet.text, |path| format!("@@PLUGINFILE@@/{}", name(path)));
    let file = |(path, svg): &(String, String)| {
        let data = base64::engine::general_purpose::STANDARD.encode(svg);
        format!("<file name=\"{}\" path=\"/\" encoding=\"base64\">{data}</file>", escaped(&name(path)))
    };
    (text, sheet.figures.iter().map(file).collect())
}

/// The numbers of a sheet as gaps; nothing if it has none.
fn gaps(e: &Exercise) -> Option<String> {
    let (mut text, files) = sheet(e);
    let mut count = 0;
    for question in e.questions.iter().filter(|q| !q.fields.is_empty()) {
        text += &format!("<h4>{}</h4>\n", escaped(&question.name));
        let mut group = "";
        for field in &question.fields {
            if field.group != group {
                group = &field.group;
                text += &format!("<p><b>{}</b></p>\n", spans(group));
            }
            let gap = format!("{{1:NUMERICAL:={}:{}}}", written(field.value), written(field.tolerance()));
            text += &format!("<p>\\({}\\) = {gap} {}</p>\n", escaped(&field.label), escaped(&field.unit));
            count += 1;
        }
    }
    let title = format!("{} ({})", e.statement.title, e.options.seed);
    (count > 0).then(|| {
        format!(
            "<question type=\"cloze\">\n<name><text>{}</text></name>\n<questiontext format=\"html\"><text>{}</text>{files}\
             </questiontext>\n<generalfeedback format=\"html\"><text>{}</text></generalfeedback>\n</question>\n",
            escaped(&title),
            kept(&text),
            kept(&html(&body(&e.solution).text, str::to_string)),
        )
    })
}

/// A task that a teacher marks, with its solution.
fn essay(e: &Exercise, question: &Question) -> String {
    let (text, files) = sheet(e);
    let text =
        format!("{text}<h4>{}</h4>\n{}", escaped(&question.name), html(&asked(e, question), str::to_string));
    let title = format!("{} ({}): {}", e.statement.title, e.options.seed, question.name);
    format!(
        "<question type=\"essay\">\n<name><text>{}</text></name>\n<questiontext format=\"html\"><text>{}</text>{files}</questiontext>\n\
         <defaultgrade>{}</defaultgrade>\n<responseformat>editorfilepicker</responseformat>\n<responserequired>0</responserequired>\n\
         <responsefieldlines>15</responsefieldlines>\n<attachments>3</attachments>\n<attachmentsrequired>0</attachmentsrequired>\n\
         <graderinfo format=\"html\"><text>{}</text></graderinfo>\n</question>\n",
        escaped(&title),
        kept(&text),
        question.points,
        kept(&html(&answer(e, question), str::to_string)),
    )
}

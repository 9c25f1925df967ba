//! A notebook for Jupyter, as the source of an assignment for nbgrader: what stands between its marks is taken out of what students get.

use super::{answer, asked, body, by_hand, mark, quoted, written};
use crate::exercise::Exercise;
use base64::Engine;

/// The notebook (nbformat 4.5).
pub fn notebook(e: &Exercise) -> String {
    let sheet = body(&e.statement);
    let (mut text, mut attached) = (format!("# {}\n\n{}", e.statement.title, sheet.text), vec![]);
    for (path, svg) in &sheet.figures {
        let name = path.rsplit('/').next().unwrap_or(path);
        text = text.replace(&format!("]({path})"), &format!("](attachment:{name})"));
        let data = base64::engine::general_purpose::STANDARD.encode(svg);
        attached.push(format!("{}: {{\"image/svg+xml\": {}}}", quoted(name), quoted(&data)));
    }
    let mark = format!("{:016x}", mark(e)[0]);
    let mut cells = vec![markdown(&format!("sheet-{mark}"), &text, &attached.join(", "), None)];
    for (k, question) in (1..).zip(by_hand(e)) {
        let id = format!("task-{k}-{mark}");
        cells.push(markdown(
            &format!("{id}-asked"),
            &format!("## {}\n\n{}", question.name, asked(e, question)),
            "",
            None,
        ));
        // A cell of words that is an answer is emptied as a whole.
        cells.push(markdown(&id, &answer(e, question), "", Some(question.points)));
    }
    for (k, question) in (1..).zip(e.questions.iter().filter(|q| !q.fields.is_empty())) {
        let id = format!("numbers-{k}-{mark}");
        let (mut asked, mut solution, mut tests) =
            (format!("## {}\n", question.name), String::new(), String::new());
        let mut group = "";
        for (n, field) in (1..).zip(&question.fields) {
            if field.group != group {
                group = &field.group;
                asked += &format!("\n**{group}**\n\n");
            }
            let unit = if field.unit.is_empty() { String::new() } else { format!(" ({})", field.unit) };
            asked += &format!("- `x{k}_{n}`: ${}${unit}\n", field.label);
            solution += &format!("x{k}_{n} = {}\n", written(field.value));
            tests += &format!(
                "assert abs(x{k}_{n} - ({})) <= {}, \"x{k}_{n}\"\n",
                written(field.value),
                written(field.tolerance())
            );
        }
        cells.push(markdown(&format!("{id}-asked"), &asked, "", None));
        let solution = format!("### BEGIN SOLUTION\n{solution}### END SOLUTION");
        cells.push(code(&id, &solution, "\"grade\": false, \"solution\": true, \"locked\": false"));
        let tests = format!("### BEGIN HIDDEN TESTS\n{tests}### END HIDDEN TESTS");
        let graded = format!(
            "\"grade\": true, \"solution\": false, \"locked\": true, \"points\": {}",
            question.points
        );
        cells.push(code(&format!("{id}-test"), &tests, &graded));
    }
    format!(
        "{{\n \"cells\": [\n{}\n ],\n \"metadata\": {{\"kernelspec\": {{\"display_name\": \"Python 3\", \"language\": \"python\", \"name\": \
         \"python3\"}}, \"language_info\": {{\"name\": \"python\"}}}},\n \"nbformat\": 4,\n \"nbformat_minor\": 5\n}}\n",
        cells.join(",\n")
    )
}

/// What nbgrader is told of a cell.
fn told(id: &str, what: &str, kind: &str) -> String {
    format!(
        "{{\"nbgrader\": {{\"grade_id\": {}, \"schema_version\": 3, \"cell_type\": \"{kind}\", \"task\": false, {what}}}}}",
        quoted(id)
    )
}

/// A cell of words; with points it is the place of an answer.
fn markdown(id: &str, text: &str, attached: &str, points: Option<u32>) -> String {
    let what = match points {
        Some(points) => {
            format!("\"grade\": true, \"solution\": true, \"locked\": false, \"points\": {points}")
        }
        None => "\"grade\": false, \"solution\": false, \"locked\": true".into(),
    };
    let attached =
        if attached.is_empty() { String::new() } else { format!("\"attachments\": {{{attached}}}, ") };
    format!(
        "  {{\"cell_type\": \"markdown\", \"id\": {}, {attached}\"metadata\": {}, \"source\": {}}}",
        quoted(id),
        told(id, &what, "markdown"),
        quoted(text)
    )
}

fn code(id: &str, text: &str, what: &str) -> String {
    format!(
        "  {{\"cell_type\": \"code\", \"id\": {}, \"execution_count\": null, \"outputs\": [], \"metadata\": {}, \"source\": {}}}",
        quoted(id),
        told(id, what, "code"),
        quoted(text)
    )
}

//! The class as a page: the table, the slips, and each document with its marks.

use super::class::{Class, Held};
use super::html::{escaped, prose, style};
use super::sheet::earned;
use crate::terminal::decimals;

const TABLES: &str = "
table { border-collapse: collapse; margin: 1rem 0; }
th, td { padding: .25rem .7rem; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
section { margin-top: 2.5rem; border-top: 2px solid var(--line); }
.scroll { overflow-x: auto; }
";

/// The page.
pub fn page(class: &Class) -> String {
    let title = escaped(&class.title);
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>{}{TABLES}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n",
        style()
    );
    out += "<div class=\"scroll\"><table>\n<tr><th>student</th>";
    out += &class
        .columns()
        .iter()
        .map(|c| format!("<th class=\"number\">{}</th>", escaped(c)))
        .collect::<String>();
    out += "</tr>\n";
    for (k, s) in class.submissions.iter().enumerate() {
        let row = class.row(s);
        out += &format!("<tr><td><a href=\"#s{k}\">{}</a></td>", escaped(&row[0]));
        out +=
            &row[1..].iter().map(|c| format!("<td class=\"number\">{}</td>", escaped(c))).collect::<String>();
        out += "</tr>\n";
    }
    out += "</table></div>\n";
    let slips = class.slips();
    if !slips.is_empty() {
        out += "<h2>Slips</h2>\n<table>\n<tr><th class=\"number\">students</th><th>claim</th><th>slip</th><th>who</th></tr>\n";
        for s in slips {
            out += &format!(
                "<tr><td class=\"number\">{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                s.students.len(),
                prose(s.claim),
                escaped(s.slip),
                escaped(&s.students.join(", "))
            );
        }
        out += "</table>\n";
    }
    for (k, s) in class.submissions.iter().enumerate() {
        out += &format!("<section id=\"s{k}\">\n<h2>{}</h2>\n", escaped(&s.name));
        match &s.outcome {
            Err(why) => {
                out += &format!("<p>Not held against the robot:</p>\n<pre>{}</pre>\n", escaped(why));
            }
            Ok(held) => {
                out += &items(class, held);
                out += &held.page;
            }
        }
        out += "</section>\n";
    }
    out + "</main>\n</body>\n</html>\n"
}

/// The sheet of a document.
fn items(class: &Class, held: &Held) -> String {
    let (Some(rubric), Some(sheet)) = (&class.rubric, &held.sheet) else { return String::new() };
    let mut out = String::from(
        "<table>\n<tr><th>item</th><th class=\"number\">points</th><th class=\"number\">of</th><th></th></tr>\n",
    );
    for ((item, mark), remark) in rubric.items.iter().zip(&sheet.marks).zip(&held.remarks) {
        out += &format!(
            "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td>{}</td></tr>\n",
            escaped(&item.name),
            earned(mark.points, mark.open),
            decimals(item.points, 2),
            prose(remark)
        );
    }
    out + "</table>\n"
}

//! The sections of a report, one file each.

mod compared;
mod dynamics;
mod errata;
mod example;
mod forward;
mod inverse;
mod links;
mod picture;
mod references;
mod setting;
mod summary;
mod table;
mod velocity;
mod workspace;

pub use compared::compared;
pub(crate) use example::numbers;
pub(crate) use inverse::within_turns;
pub(crate) use setting::Setting;
pub use setting::{Errata, Level, ReportOptions, Topic};
pub(crate) use table::{ends, rows, values};

use crate::document::{Document, Section};
use crate::words::Tongue;
use denavit::description::Description;

/// The report about a robot.
pub fn report(description: &Description, options: &ReportOptions) -> Document {
    document(&Setting::new(description, options))
}

/// The same report in several languages, whichever the options name; what sections share is derived once.
///
/// ```
/// use denavit_report::words::Tongue;
/// use denavit_report::{ReportOptions, Topic, reports};
///
/// let arm = denavit::catalogue::robot("scara").expect("it is in the catalogue");
/// let options = ReportOptions { topics: vec![Topic::Summary, Topic::Forward], ..ReportOptions::default() };
/// let [english, french] = &reports(&arm, &options, &[Tongue::English, Tongue::French])[..] else { panic!() };
/// assert_ne!(english.title, french.title);
/// ```
pub fn reports(description: &Description, options: &ReportOptions, languages: &[Tongue]) -> Vec<Document> {
    let mut setting = Setting::new(description, options);
    let document = |language: &Tongue| {
        setting.options.language = *language;
        document(&setting)
    };
    languages.iter().map(document).collect()
}

fn document(setting: &Setting) -> Document {
    let Setting { options, .. } = setting;
    let sections = Topic::ALL.into_iter().filter(|t| options.topics.contains(t)).flat_map(|topic| {
        let made: Vec<Section> = match topic {
            Topic::Summary => vec![summary::section(setting)],
            Topic::Figures => picture::section(setting).into_iter().collect(),
            Topic::Table => table::sections(setting),
            Topic::Links => vec![links::section(setting)],
            Topic::Forward => forward::sections(setting).into(),
            Topic::Example => example::section(setting).into_iter().collect(),
            Topic::Inverse => inverse::sections(setting),
            Topic::Velocity => velocity::sections(setting),
            Topic::Dynamics => dynamics::section(setting).into_iter().collect(),
            Topic::Workspace => workspace::section(setting).into_iter().collect(),
            Topic::Errata => errata::section(setting).into_iter().collect(),
            Topic::References => vec![references::section(setting)],
        };
        made
    });
    let title = given(&options.title).unwrap_or_else(|| setting.words().title(&setting.description.name));
    let author = given(&options.author);
    Document { title, author, language: options.language, sections: sections.collect() }
}

/// A text that is told; an empty one is none.
fn given(text: &Option<String>) -> Option<String> {
    text.clone().filter(|t| !t.trim().is_empty())
}

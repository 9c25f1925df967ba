//! The sections of a report, one file each.

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

pub use setting::{Errata, ReportOptions, Topic};

use crate::document::{Document, Section};
use denavit::description::Description;
use setting::Setting;

/// The report about a robot.
pub fn report(description: &Description, options: &ReportOptions) -> Document {
    let setting = Setting::new(description, options);
    let language = options.language;
    let sections = Topic::ALL.into_iter().filter(|t| options.topics.contains(t)).flat_map(|topic| {
        let made: Vec<Section> = match topic {
            Topic::Summary => vec![summary::section(&setting)],
            Topic::Figures => picture::section(&setting).into_iter().collect(),
            Topic::Table => table::sections(&setting),
            Topic::Links => vec![links::section(&setting)],
            Topic::Forward => forward::sections(&setting).into(),
            Topic::Example => example::section(&setting).into_iter().collect(),
            Topic::Inverse => inverse::sections(&setting),
            Topic::Velocity => velocity::sections(&setting),
            Topic::Workspace => workspace::section(&setting).into_iter().collect(),
            Topic::Errata => errata::section(&setting).into_iter().collect(),
            Topic::References => vec![references::section(&setting)],
        };
        made
    });
    let title = language.words().title(&description.name);
    Document { title, language, sections: sections.collect() }
}

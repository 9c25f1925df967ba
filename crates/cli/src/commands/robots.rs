//! `denavit robots`: the catalogue, and the structures, linkages and parallel robots beside it.

use crate::arguments::RobotsArguments;
use crate::failure::Failure;
use crate::terminal::{Align, table};
use denavit::catalogue;
use denavit::description::parallel::Parallel;
use denavit::description::{Description, Linkage, RowTree};
use denavit_parallel::catalogue as on_legs;
use denavit_wire::catalogue::{Catalogue, Closed, OnLegs, Structure};
use denavit_wire::robot::joints;
use std::io::Write;

/// Lists the catalogue, the structures, the linkages and the parallel robots.
///
/// # Errors
/// If nothing can be written.
pub fn run(arguments: &RobotsArguments) -> Result<(), Failure> {
    let robots: Vec<(&str, Description)> = catalogue::names()
        .into_iter()
        .filter_map(|name| Some((name, catalogue::robot(name)?)))
        .filter(|(name, d)| arguments.filter.as_ref().is_none_or(|text| matches(text, name, &d.name)))
        .collect();
    let structures: Vec<(&str, RowTree)> = catalogue::structures()
        .into_iter()
        .filter_map(|name| Some((name, catalogue::structure(name)?)))
        .filter(|(name, t)| arguments.filter.as_ref().is_none_or(|text| matches(text, name, &t.name)))
        .collect();
    let linkages: Vec<(&str, Linkage)> = catalogue::linkages()
        .into_iter()
        .filter_map(|name| Some((name, catalogue::linkage(name)?)))
        .filter(|(name, l)| arguments.filter.as_ref().is_none_or(|text| matches(text, name, &l.tree.name)))
        .collect();
    let parallel: Vec<(&str, Parallel)> = on_legs::names()
        .filter_map(|name| Some((name, on_legs::robot(name)?)))
        .filter(|(name, p)| arguments.filter.as_ref().is_none_or(|text| matches(text, name, &p.name)))
        .collect();
    let mut out = anstream::stdout();
    let is_empty = robots.is_empty() && structures.is_empty() && linkages.is_empty() && parallel.is_empty();
    if let (true, Some(text)) = (is_empty, &arguments.filter) {
        return Err(Failure::No(format!("no robot of the catalogue matches `{text}`")));
    }
    if arguments.json {
        let trees = structures.iter().map(|(name, tree)| (*name, tree));
        let closed = linkages.iter().map(|(name, linkage)| (*name, linkage));
        let list = Catalogue::of(robots.iter().map(|(name, d)| (*name, d)), trees, closed)
            .with(parallel.iter().map(|(name, p)| (*name, p)));
        writeln!(out, "{}", denavit_wire::text(&list))?;
        return Ok(());
    }
    let rows: Vec<Vec<String>> = robots
        .iter()
        .map(|(name, d)| vec![(*name).into(), d.name.clone(), joints(d), d.convention.to_string()])
        .collect();
    if !rows.is_empty() {
        write!(out, "{}", table(&["name", "robot", "joints", "convention"], &[Align::Left; 4], &rows))?;
    }
    let gap = if rows.is_empty() || structures.is_empty() { "" } else { "\n" };
    let rows: Vec<Vec<String>> = structures
        .iter()
        .map(|(name, tree)| Structure::of(name, tree))
        .map(|s| vec![s.name, s.title, s.joints.to_string(), s.tips.join(", ")])
        .collect();
    if !rows.is_empty() {
        write!(out, "{gap}{}", table(&["name", "tree", "joints", "tips"], &[Align::Left; 4], &rows))?;
    }
    let gap = if robots.is_empty() && structures.is_empty() { "" } else { "\n" };
    let rows: Vec<Vec<String>> = linkages
        .iter()
        .map(|(name, linkage)| Closed::of(name, linkage))
        .map(|c| vec![c.name, c.title, c.driven.to_string(), c.passive.to_string(), c.loops.to_string()])
        .collect();
    if !rows.is_empty() {
        let header = ["name", "closed loops", "driven", "passive", "loops"];
        write!(out, "{gap}{}", table(&header, &[Align::Left; 5], &rows))?;
    }
    let gap = if robots.is_empty() && structures.is_empty() && linkages.is_empty() { "" } else { "\n" };
    let rows: Vec<Vec<String>> = parallel
        .iter()
        .map(|(name, p)| OnLegs::of(name, p))
        .map(|p| vec![p.name, p.title, p.kind.into(), p.drives.to_string()])
        .collect();
    if !rows.is_empty() {
        let header = ["name", "parallel", "kind", "drives"];
        write!(out, "{gap}{}", table(&header, &[Align::Left; 4], &rows))?;
    }
    Ok(())
}

fn matches(text: &str, name: &str, title: &str) -> bool {
    let text = text.to_lowercase();
    name.contains(&text) || title.to_lowercase().contains(&text)
}

//! The online part of this crate as text: what generated packages embed, so that there is one source of it.

/// The files of the online part, by name: all but what measures ([`Plan::new`](crate::Plan::new)), what
/// asks the processor for its instructions ([`Plan::solve`](crate::Plan::solve)), and what prints.
pub const FILES: &[(&str, &str)] = &[
    ("answer.rs", include_str!("answer.rs")),
    ("arm.rs", include_str!("arm.rs")),
    ("candidate.rs", include_str!("candidate.rs")),
    ("certificate.rs", include_str!("certificate.rs")),
    ("chart.rs", include_str!("chart.rs")),
    ("charts.rs", include_str!("charts.rs")),
    ("determinant.rs", include_str!("determinant.rs")),
    ("eigen.rs", include_str!("eigen.rs")),
    ("eliminate.rs", include_str!("eliminate.rs")),
    ("extract.rs", include_str!("extract.rs")),
    ("forms.rs", include_str!("forms.rs")),
    ("fourier.rs", include_str!("fourier.rs")),
    ("instructions.rs", include_str!("instructions.rs")),
    ("lanes.rs", include_str!("lanes.rs")),
    ("newton.rs", include_str!("newton.rs")),
    ("plan.rs", include_str!("plan.rs")),
    ("products.rs", include_str!("products.rs")),
    ("remaining.rs", include_str!("remaining.rs")),
    ("rigid.rs", include_str!("rigid.rs")),
    ("roots.rs", include_str!("roots.rs")),
    ("slides.rs", include_str!("slides.rs")),
    ("solve.rs", include_str!("solve.rs")),
    ("split.rs", include_str!("split.rs")),
    ("triple.rs", include_str!("triple.rs")),
    ("wide.rs", include_str!("wide.rs")),
    ("wide_roots.rs", include_str!("wide_roots.rs")),
    ("work.rs", include_str!("work.rs")),
];

/// The root, whose list of modules names also what is not among [`FILES`].
const ROOT: &str = include_str!("lib.rs");

/// The files of a module with the items of this crate that [`FILES`] hold: `mod.rs` and those that it names; poses are
/// solved by `Plan::solve_portably`. Paths to the crate become paths to the module.
pub fn module() -> Vec<(String, String)> {
    const LEFT_OUT: [&str; 6] = [
        "mod measure;",
        "mod native;",
        "pub use native::Isa;",
        "pub mod source;",
        "mod tables;",
        "pub use tables::Tables;",
    ];
    let is_left_out = |line: &&str| LEFT_OUT.contains(&line.trim());
    let root: String =
        ROOT.lines().filter(|line| !is_left_out(line)).map(|line| format!("{line}\n")).collect();
    let files = FILES.iter().map(|&(name, text)| (name.to_string(), text.replace("crate::", "super::")));
    std::iter::once(("mod.rs".to_string(), root)).chain(files).collect()
}

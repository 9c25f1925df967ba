//! Plots: few shapes, everything on the page, equal scales, the same call the same drawing.

use denavit::inverse::JointSpace;
use denavit::workspace::Workspace;
use denavit::{Robot, catalogue};
use denavit_report::figure::drawing::{Drawing, Ink, Label, Segment, Shape};
use denavit_report::figure::plot::{Curve, Panel, arm_line, curves, workspace_plot};

fn arm(name: &str) -> (Robot<f64>, Workspace) {
    let description = catalogue::robot(name).expect("a robot of the catalogue");
    let robot = Robot::numeric(&description).expect("all parameters have values");
    let space = JointSpace::new(&description, &robot);
    let workspace = Workspace::new(&robot, &space).expect("a workspace");
    (robot, workspace)
}

/// All places of a drawing lie on its page, and are numbers.
fn check_on_page(drawing: &Drawing) {
    let on_page = |[x, y]: [f64; 2]| {
        let is_on = (-1.0..=drawing.width + 1.0).contains(&x) && (-1.0..=drawing.height + 1.0).contains(&y);
        assert!(is_on, "({x}, {y}) is not on the page");
    };
    for shape in &drawing.shapes {
        match shape {
            Shape::Text { at, .. } => on_page(*at),
            Shape::Path { segments, .. } => {
                for segment in segments {
                    match segment {
                        Segment::Move(p) | Segment::Line(p) => on_page(*p),
                        Segment::Cubic(a, b, c) => [a, b, c].into_iter().for_each(|p| on_page(*p)),
                        Segment::Close => {}
                    }
                }
            }
        }
    }
}

/// The width and the height of the path that is filled with an ink.
fn extent(drawing: &Drawing, wanted: Ink) -> [f64; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let filled = drawing.shapes.iter().find_map(|s| match s {
        Shape::Path { segments, fill, .. } if *fill == Some(wanted) => Some(segments),
        _ => None,
    });
    for segment in filled.expect("a filled path") {
        if let Segment::Move(p) | Segment::Line(p) = segment {
            for k in 0..2 {
                (low[k], high[k]) = (low[k].min(p[k]), high[k].max(p[k]));
            }
        }
    }
    [high[0] - low[0], high[1] - low[1]]
}

#[test]
fn a_workspace_is_drawn_with_equal_scales() {
    // A disc of radius 2.2 m.
    let (_, workspace) = arm("planar-3r");
    let drawing = workspace_plot(&workspace, None);
    check_on_page(&drawing);
    let [wide, high] = extent(&drawing, Ink::Scale(0.0625));
    assert!((wide - high).abs() < 0.01 * wide, "{wide} × {high}");
    assert!(drawing.width <= 440.0 + 1e-9);
    assert!(drawing.shapes.len() < 1500);
    assert!(drawing.description.contains("x from −2.200 to 2.200 m"), "{}", drawing.description);
    assert_eq!(drawing, workspace_plot(&workspace, None));
}

#[test]
fn an_arm_is_drawn_where_it_lies_in_the_section() {
    let (robot, workspace) = arm("staubli-rx90");
    // Stretched out in its half plane; then with a wrist that leads out of it.
    let line = arm_line(&workspace, &robot, &[0.0; 6]).expect("in the half plane");
    assert_eq!(line.first(), Some(&[0.0, 0.0]));
    let tip = line.last().expect("a tip");
    assert!((tip[0].hypot(tip[1]) - 0.9 / f64::sqrt(2.0)).abs() < 1e-9, "{tip:?}");
    let with = workspace_plot(&workspace, Some(&line));
    check_on_page(&with);
    assert!(with.shapes.len() > workspace_plot(&workspace, None).shapes.len());
    let (robot, workspace) = arm("puma560");
    assert_eq!(arm_line(&workspace, &robot, &[0.3; 6]), None);
}

fn lines_in(drawing: &Drawing, ink: Ink) -> usize {
    let is_of = |s: &&Shape| matches!(s, Shape::Path { stroke: Some(s), .. } if s.ink == ink);
    drawing.shapes.iter().filter(is_of).count()
}

#[test]
fn curves_are_interrupted_where_there_is_no_value() {
    let points = |gap: bool| {
        let at = |k: u8| [f64::from(k), if gap && k == 5 { f64::NAN } else { f64::from(k) }];
        (0..10).map(at).collect()
    };
    let lines = [false, true].map(|gap| Curve {
        name: Label::symbol("q", if gap { "2" } else { "1" }),
        points: points(gap),
        is_dashed: gap,
    });
    let across = Label::words("t / s");
    let [one, two] = [&lines[..], &lines[..1]]
        .map(|curves| Panel { label: Label::words("q / rad"), curves: curves.to_vec() });
    let drawing = curves("Joints", &across, std::slice::from_ref(&one), &[]);
    check_on_page(&drawing);
    // The line and its sample in the legend; two pieces and the sample.
    assert_eq!([0, 1].map(|k| lines_in(&drawing, Ink::Series(k))), [2, 3]);
    // Another panel has the line alone; both have the mark at 4, none that at 40.
    let both = curves("Joints", &across, &[one, two], &[4.0, 40.0]);
    check_on_page(&both);
    assert_eq!([0, 1].map(|k| lines_in(&both, Ink::Series(k))), [3, 3]);
    assert_eq!(lines_in(&both, Ink::Accent), 2);
    assert!(both.height > 1.5 * drawing.height);
    check_on_page(&curves("", &across, &[], &[]));
}

//! Pictures of every robot of the catalogue: labels apart from each other, everything on the sheet, always the same.

use denavit::catalogue;
use denavit::description::{Convention, Description, read_toml};
use denavit_report::figure::drawing::{Anchor, Drawing, Ink, Label, LabelPiece, Segment, Shape};
use denavit_report::figure::{Arm, Bounds, FigureOptions, isometric, labels, scheme, svg, tikz, typst};

fn description(name: &str) -> Description {
    catalogue::robot(name).expect("a robot of the catalogue")
}

fn drawings(arm: &Arm) -> [Drawing; 3] {
    let every = FigureOptions { y_axes: true, highlight: vec![0, 1], ..FigureOptions::main() };
    [isometric(arm, &FigureOptions::main()), scheme(arm, &FigureOptions::main()), isometric(arm, &every)]
}

fn points(drawing: &Drawing) -> Vec<[f64; 2]> {
    let mut points = vec![];
    for shape in &drawing.shapes {
        match shape {
            Shape::Text { at, .. } => points.push(*at),
            Shape::Path { segments, .. } => {
                for segment in segments {
                    match segment {
                        Segment::Move(p) | Segment::Line(p) => points.push(*p),
                        Segment::Cubic(a, b, p) => points.extend([*a, *b, *p]),
                        Segment::Close => {}
                    }
                }
            }
        }
    }
    points
}

fn check(name: &str, drawing: &Drawing) {
    let mut rects = vec![];
    for shape in &drawing.shapes {
        if let Shape::Text { at, anchor, size, label, .. } = shape {
            let rect = labels::rect(*at, *anchor, *size, label);
            for (other, what) in &rects {
                let [l, t, r, b]: &[f64; 4] = other;
                let apart = rect[0] >= *r || rect[2] <= *l || rect[1] >= *b || rect[3] <= *t;
                assert!(apart, "{name}: {label:?} on {what:?}");
            }
            rects.push((rect, label));
        }
    }
    let points = points(drawing);
    assert!(points.iter().flatten().all(|x| x.is_finite()), "{name}");
    for [x, y] in points {
        let inside =
            (-0.01..=drawing.width + 0.01).contains(&x) && (-0.01..=drawing.height + 0.01).contains(&y);
        assert!(inside, "{name}: ({x}, {y}) is outside {} × {}", drawing.width, drawing.height);
    }
}

#[test]
fn every_robot_has_pictures_that_can_be_read() {
    for name in catalogue::names() {
        let description = description(name);
        let arm = Arm::new(&description).expect(name);
        assert_eq!(arm.pose().len(), description.variables().len());
        for drawing in drawings(&arm) {
            check(name, &drawing);
            assert!(drawing.height <= 420.0 && drawing.shapes.len() > 10, "{name}");
        }
        for joint in &arm.skeleton().joints {
            assert!((joint.axis.norm() - 1.0).abs() < 1e-9, "{name}");
        }
        let last = arm.skeleton().tool.translation;
        let robot = denavit::Robot::numeric(&description);
        if let Ok(robot) = robot {
            assert!((robot.pose(arm.pose()).translation - last).norm() < 1e-9, "{name}");
        }
    }
}

/// Every joint variable and every z axis of a line diagram is named once.
#[test]
fn nothing_is_left_unnamed() {
    for name in ["puma560", "ur5e", "staubli-rx90", "franka-panda", "smart5-six-rail"] {
        let arm = Arm::new(&description(name)).expect(name);
        let drawing = scheme(&arm, &FigureOptions::main());
        let written: Vec<String> = drawing
            .shapes
            .iter()
            .filter_map(|s| match s {
                Shape::Text { label, .. } => Some(label.0.iter().map(|p| p.text.as_str()).collect()),
                Shape::Path { .. } => None,
            })
            .collect();
        for joint in &arm.skeleton().joints {
            let number = joint.number.expect("a joint of its own") + 1;
            assert!(written.contains(&format!("q{number}")), "{name}: q{number} in {written:?}");
            let z = format!("z{}", joint.frame);
            assert!(written.contains(&z), "{name}: {z} in {written:?}");
        }
        for length in &arm.skeleton().lengths {
            let label: String = length.label.0.iter().map(|p| p.text.as_str()).collect();
            assert!(written.contains(&label), "{name}: {label} in {written:?}");
        }
    }
}

#[test]
fn pictures_are_the_same_every_time() {
    for name in ["puma560", "prrrrp", "kuka-iiwa-14"] {
        let [a, b] = [0, 1].map(|_| drawings(&Arm::new(&description(name)).expect(name)));
        assert_eq!(a, b, "{name}");
    }
}

#[test]
fn conventions_make_no_difference_to_where_the_hand_is() {
    for name in ["puma560", "staubli-rx90", "franka-panda", "scara"] {
        let description = description(name);
        for convention in Convention::ALL {
            let arm = Arm::new(&description.converted(convention).description).expect(name);
            let robot = denavit::Robot::numeric(&description).expect(name);
            let hand = robot.pose(arm.pose()).translation;
            assert!((arm.skeleton().tool.translation - hand).norm() < 1e-9, "{name} {convention}");
            drawings(&arm).iter().for_each(|d| check(name, d));
        }
    }
}

#[test]
fn poses_of_one_arm_have_one_scale() {
    let arm = Arm::new(&description("puma560")).expect("puma560");
    let view = arm.view();
    let poses: Vec<Arm> =
        [-1.0, 0.0, 1.0].iter().map(|q1| arm.at(&[*q1, 0.5, -1.0, 0.2, 0.7, 0.0])).collect();
    let bounds = poses.iter().fold(Bounds::empty(), |b, a| b.with(&a.bounds(&view)));
    let options =
        FigureOptions { view: Some(view), bounds: Some(bounds), ..FigureOptions::small(150.0, 150.0) };
    let sheets: Vec<Drawing> = poses.iter().map(|a| isometric(a, &options)).collect();
    for sheet in &sheets {
        assert_eq!([sheet.width, sheet.height], [sheets[0].width, sheets[0].height]);
        check("puma560", sheet);
    }
}

#[test]
fn odd_arms_are_drawn_too() {
    for text in [
        "name = \"one\"\nconvention = \"standard\"\n[[joints]]\ntheta = \"q1\"\n",
        "name = \"one\"\nconvention = \"craig\"\n[[joints]]\nd = \"q1\"\n",
        "name = \"same\"\nconvention = \"khalil\"\n[[joints]]\ntheta = \"q1\"\n[[joints]]\ntheta = \"q2\"\n[[joints]]\nr = \"q3\"\n",
        "name = \"long\"\nconvention = \"standard\"\n[[joints]]\ntheta = \"q1\"\nd = \"15 m\"\n[[joints]]\ntheta = \"q2\"\na = \"1 mm\"\n",
        "name = \"fixed\"\nconvention = \"standard\"\n[[joints]]\na = \"1 m\"\n[[joints]]\ntheta = \"q1\"\n",
    ] {
        let (description, _) = read_toml(text).unwrap_or_else(|e| panic!("{e:?}"));
        let arm = Arm::new(&description).expect("no parameters");
        drawings(&arm).iter().for_each(|d| check(text, d));
    }
}

/// Text that tries to get out, and harmless text, in the same places.
fn hostile(text: &str) -> Drawing {
    let piece = |italic, subscript| LabelPiece { text: text.into(), italic, subscript };
    let label = Label(vec![piece(true, false), piece(false, true), piece(false, false)]);
    let shape = Shape::Text { at: [10.0, 20.0], anchor: Anchor::Middle, size: 10.0, ink: Ink::Line, label };
    Drawing { width: 100.0, height: 50.0, description: text.into(), shapes: vec![shape] }
}

const HOSTILE: [&str; 12] = [
    "\"><script>alert(1)</script>",
    "'&<>\"",
    "]]></svg>",
    "\\input{/etc/passwd}",
    "}$\\end{tikzpicture}",
    "$$%#_^~{",
    "\\\\\"",
    "\" + read(\"x\") + \"",
    "]#eval(\"1\")[",
    "\u{0}\u{7}\u{1b}\n\r\t\u{85}\u{ffff}",
    "\u{2028}\u{202e}/* // */",
    "\\u{7d}\\",
];

#[test]
fn text_stays_text_in_svg() {
    let shape = |text: &str| {
        [svg::Palette::File, svg::Palette::Page].map(|p| {
            let out = svg::svg(&hostile(text), p, text);
            let marks: String = out.chars().filter(|c| "<>\"".contains(*c)).collect();
            assert!(!out.contains("script>") && !out.chars().any(|c| c.is_control() && c != '\n'), "{out}");
            // An ampersand begins an entity.
            for part in out.split('&').skip(1) {
                let entity = ["lt;", "gt;", "amp;", "quot;", "#39;"].iter().any(|e| part.starts_with(e));
                assert!(entity, "{out}");
            }
            marks
        })
    };
    for text in HOSTILE {
        assert_eq!(shape(text), shape("a"), "{text}");
    }
}

#[test]
fn text_stays_text_in_tikz() {
    for text in HOSTILE {
        let out = tikz::tikz(&hostile(text));
        let node = out.lines().find(|l| l.starts_with("\\node")).expect("a node");
        assert_eq!(out.lines().count(), tikz::tikz(&hostile("a")).lines().count(), "{out}");
        let (mut depth, mut dollars) = (0i32, 0);
        let mut chars = node.chars().peekable();
        while let Some(c) = chars.next() {
            match c {
                '\\' => {
                    let mut word = String::new();
                    while let Some(c) = chars.next_if(char::is_ascii_alphabetic) {
                        word.push(c);
                    }
                    if word.is_empty() {
                        let next = chars.next().expect("no backslash at the end");
                        assert!("{}$&#%_, ".contains(next), "{node}");
                    } else {
                        let known = [
                            "node",
                            "fontsize",
                            "selectfont",
                            "mathit",
                            "mathrm",
                            "backslash",
                            "sim",
                            "mbox",
                            "textasciicircum",
                        ];
                        assert!(known.contains(&word.as_str()), "{word} in {node}");
                    }
                }
                '{' => depth += 1,
                '}' => depth -= 1,
                '$' => dollars += 1,
                '%' | '#' | '~' | '&' => panic!("{c} in {node}"),
                _ => {}
            }
            assert!(depth >= 0, "{node}");
        }
        assert_eq!((depth, dollars), (0, 2), "{node}");
    }
}

#[test]
fn text_stays_text_in_typst() {
    // What is left when string literals are taken out.
    let rest = |text: &str| {
        let out = typst::typst(&hostile(text));
        let (mut rest, mut inside, mut escaped) = (String::new(), false, false);
        for c in out.chars() {
            match c {
                _ if escaped => escaped = false,
                '\\' if inside => escaped = true,
                '"' => inside = !inside,
                c if inside => assert!(!c.is_control(), "{out}"),
                c => rest.push(c),
            }
        }
        assert!(!inside, "{out}");
        // Widths follow the text.
        rest.replace(|c: char| c.is_ascii_digit() || c == '.' || c == '-', "")
    };
    for text in HOSTILE {
        assert_eq!(rest(text), rest("a"), "{text}");
    }
}

#[test]
fn colours_of_a_page_are_defined_for_light_and_dark() {
    let style = svg::style();
    let (light, dark) = style.split_once("@media (prefers-color-scheme:dark)").expect("two palettes");
    let arm = Arm::new(&description("cylindrical-wrist")).expect("an arm");
    for drawing in drawings(&arm) {
        let out = svg::svg(&drawing, svg::Palette::Page, "x");
        for part in out.split("var(").skip(1) {
            let name = part.split(',').next().expect("a name");
            assert!(light.contains(&format!("{name}:")) && dark.contains(&format!("{name}:")), "{name}");
        }
    }
}

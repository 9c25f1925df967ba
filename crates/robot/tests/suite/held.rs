//! What each format has a place for: what it says of itself is what comes back.

use denavit::description::{
    Alone, AxesAs, Convention, Decimals, Description, Format, Mechanism, Part, TableKind, TableOptions,
    read_mjcf, read_par, read_table, read_toml, read_urdf, write_axes, write_mjcf, write_par, write_table,
    write_toml, write_tree, write_urdf,
};

/// A robot of which everything is said: two links.
fn full() -> String {
    let both = "velocity = 2\nacceleration = 3\nmass = 2\ncom = [0, 0, \"0.1 m\"]\ninertia = [1, 0, 0, 1, 0, 1]\nrotor = 0.1\n\
                viscous = 0.5\ncoulomb = 0.25\n";
    format!(
        "name = \"t\"\nconvention = \"khalil\"\ngravity = [0, 0, -9]\n\
         [[joints]]\nname = \"mast\"\ntheta = \"q1\"\nlimits = [-1, 1]\n{both}\
         [[joints]]\nname = \"boom\"\nd = \"0.3 m\"\ntheta = \"q2\"\nlimits = [-2, 2]\n{both}\
         [poses]\nhome = [0.5, 0.25]\n"
    )
}

fn of_mechanism(m: &Mechanism) -> Description {
    m.chain(None, None, Convention::Khalil).expect("a chain").description
}

/// What is read back of a format.
fn back(d: &Description, format: Format) -> Vec<(String, Description)> {
    let named = |name: &str, d: Description| (name.to_string(), d);
    let toml = |text: &str| read_toml(text).expect("a robot").0;
    match format {
        Format::RobotFile => {
            vec![named("toml", toml(&write_toml(d))), named("tree", toml(&write_tree(&d.as_tree())))]
        }
        Format::Axes => [AxesAs::Lines, AxesAs::Screws, AxesAs::BodyScrews]
            .map(|written| named("axes", toml(&write_axes(d, written).expect("axes"))))
            .to_vec(),
        Format::Urdf => {
            let (m, _) = read_urdf(&write_urdf(&Mechanism::of(d).expect("numbers")), Decimals::Meant)
                .expect("a robot");
            vec![named("urdf", of_mechanism(&m))]
        }
        Format::Mjcf => {
            let text = write_mjcf(&Mechanism::of(d).expect("bodies"));
            let (m, _) = read_mjcf("", &text, &mut Alone, Decimals::Meant).0.expect("a robot");
            vec![named("mjcf", of_mechanism(&m))]
        }
        Format::Par => {
            let (tree, _) =
                read_par(&write_par(&d.as_tree()).expect("a file").text, Decimals::Meant).expect("rows");
            let tree = tree.tree().expect("a tree");
            vec![named("par", tree.chain(None, None, Convention::Khalil).expect("a chain").description)]
        }
        Format::Table => [TableKind::Markdown, TableKind::Latex, TableKind::Csv]
            .map(|kind| {
                let text = write_table(d, kind).expect("a table");
                named("table", read_table(&text, kind, &TableOptions::default()).expect("a robot").0)
            })
            .to_vec(),
    }
}

#[test]
fn a_format_holds_what_it_says() {
    let (full, _) = read_toml(&full()).expect("a robot");
    let all: Vec<Part> = Part::ALL.into_iter().filter(|p| *p != Part::Efforts).collect();
    assert_eq!(full.parts(), all);
    for format in Format::ALL {
        for (name, read) in back(&full, format) {
            let expected: Vec<Part> = all.iter().copied().filter(|p| format.holds(*p)).collect();
            assert_eq!(read.parts(), expected, "{name}");
        }
    }
}

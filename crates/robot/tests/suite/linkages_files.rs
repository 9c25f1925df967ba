//! Closed loops in robot files and `.par` files: what is read, what is found wrong, what is written.

use crate::common::Random;
use crate::linkages::{Between, SR400, anywhere, catalogued, linkage, par};
use denavit::catalogue;
use denavit::closure::{Loops, findings};
use denavit::description::{
    Convention, Decimals, Described, NoPar, Severity, line_column, read_par, read_robot, read_toml,
    write_linkage, write_linkage_par,
};

#[test]
fn what_is_written_reads_back_to_the_same() {
    for name in catalogue::linkages() {
        let l = catalogued(name);
        let text = write_linkage(&l);
        let back = linkage(&text);
        assert_eq!(write_linkage(&back), text, "{name}");
        // A joint that follows another has no place in a `.par` file.
        let file = match write_linkage_par(&l) {
            Ok(file) => Some(file.text),
            Err(why) => {
                assert_eq!((name, why), ("four-bar-gripper", NoPar::Follows("right crank".into())));
                None
            }
        };
        let from_par = file.as_deref().map_or_else(|| back.clone(), par);
        let file = file.unwrap_or_default();
        let [a, b, c] = [&l, &back, &from_par].map(|l| Loops::new(l).expect("values"));
        let mut random = Random(17);
        let mut closed = 0;
        for _ in 0..40 {
            let q = anywhere(&a, &mut random);
            let [x, y, z] = [&a, &b, &c].map(|l| l.assemblies(&q));
            assert_eq!((x.len(), x.len()), (y.len(), z.len()), "{name}\n{file}");
            for ((x, y), z) in x.iter().zip(&y).zip(&z) {
                closed += 1;
                assert_eq!(x.passive, y.passive, "{name}");
                let near = x.passive.iter().zip(&z.passive).all(|(p, o)| ((p - o) / 2.0).sin().abs() < 1e-9);
                assert!(near, "{name}: {:?} {:?}\n{}", x.passive, z.passive, file);
            }
        }
        assert!(closed > 10, "{name}");
    }
}

fn said(text: &str) -> Vec<String> {
    let shown = |d: &denavit::description::Diagnostic| {
        let (line, column) = line_column(text, d.span.start);
        format!("{line}:{column}: {}: {}", d.severity.name(), d.message)
    };
    match read_robot(text) {
        Err(all) => all.iter().filter(|d| d.severity == Severity::Error).map(shown).collect(),
        Ok((Described::Linkage(l), _)) => findings(&l).iter().map(shown).collect(),
        Ok(_) => vec!["no linkage".into()],
    }
}

const HEAD: &str = "name = \"x\"\nconvention = \"khalil\"\n[[joints]]\nname = \"a\"\ntheta = \"q1\"\n[[joints]]\nname = \"b\"\n\
    d = 1\ntheta = \"p1\"\n[[joints]]\nname = \"c\"\nafter = \"base\"\nd = 4\ntheta = \"p2\"\n[[closures]]\n";

#[test]
fn what_is_wrong_with_a_loop_has_its_place() {
    let of = |tail: &str| said(&format!("{HEAD}{tail}"));
    let good = "left = { after = \"b\", d = 3, theta = \"p3\" }\nright = { after = \"c\", d = 3 }\n";
    assert_eq!(of(good), [""; 0]);
    assert_eq!(
        of("left = { after = \"bb\", d = 3, theta = \"p3\" }\n"),
        ["15:1: error: a closure without `right`", "16:18: error: there is no row of this name"]
    );
    assert_eq!(
        of(
            "left = { after = \"b\", d = 3, theta = \"p3\" }\nright = { after = \"c\", d = 3, theta = \"p4\" }\n"
        ),
        ["17:40: error: the right side of a closure is constant, and holds `p4`"]
    );
    assert_eq!(
        of("left = { after = \"b\", d = 3, theta = \"p4\" }\nright = { after = \"c\", d = 3 }\n"),
        ["16:39: error: `p4` comes before `p3`"]
    );
    assert_eq!(
        of("left = { after = \"b\", d = 3, theta = \"q2\" }\nright = { after = \"c\", d = 3 }\n"),
        ["16:39: error: `q2` is not the variable of a cut joint"]
    );
    assert_eq!(
        of("left = { after = \"b\", d = 3, b = 0.001, theta = \"p3\" }\nright = { after = \"c\", d = 3 }\n"),
        ["15:1: error: `loop 1` cannot be assembled: its sides end 1.000e-3 m apart along its axes"]
    );
    assert_eq!(
        of(
            "left = { after = \"b\", d = 3, alpha = 0.000004, theta = \"p3\" }\nright = { after = \"c\", d = 3 }\n"
        )[..1],
        [
            "15:1: warning: `loop 1` is over-constrained by its decimals: its axes are up to 4.0e-6 rad off parallel"
        ]
    );
    assert_eq!(
        of(&format!("{good}[modes]\nopen = \"+\"\nflat = \"p1 = -q1\"\nodd = \"p9 = q1\"\n")),
        ["21:7: error: there is no passive joint `p9`"]
    );
    assert_eq!(
        of(&format!("{good}[modes]\nopen = \"+\"\nflat = \"p1 = -q1\"\nmany = \"+-\"\n")),
        [
            "20:8: error: no assembly mode is told by what is said of `flat`",
            "21:8: error: no assembly mode is told by what is said of `many`"
        ]
    );
    // The crank is 1 and the rest 0.1: nowhere closed.
    let short = "left = { after = \"b\", d = 0.1, theta = \"p3\" }\nright = { after = \"c\", d = 0.1 }\n";
    assert_eq!(
        of(short),
        [
            "15:1: warning: not closed wherever it was tried; with all driven joints at 0: `loop 1` is open by 2.8 m"
        ]
    );
    // One more joint in the loop: nothing determines it.
    let free = HEAD
        .replace("[[closures]]\n", "[[joints]]\nname = \"d\"\nd = 2\ntheta = \"p3\"\n[[closures]]\n")
        + "left = { after = \"b\", d = 3, theta = \"p4\" }\nright = { after = \"d\", d = 2 }\n";
    let said_of = said(&free);
    assert!(
        said_of.iter().any(|s| s.contains("warning: the mobility is 2 (5 joints, constraints of rank 3 at")
            && s.contains("and 1 joint is driven")),
        "{said_of:#?}"
    );
    assert!(said_of.iter().any(|s| s.contains("found by Newton's method")), "{said_of:#?}");
    // Two joints driven where one can be.
    let jammed = HEAD.replace("\"p2\"", "\"q2\"")
        + "left = { after = \"b\", d = 3, theta = \"p2\" }\nright = { after = \"c\", d = 3 }\n";
    let said_of = said(&jammed);
    assert!(!said_of.is_empty(), "{said_of:#?}");
}

#[test]
fn a_serial_file_knows_nothing_of_loops() {
    let text = "name = \"x\"\nconvention = \"standard\"\n[parameters]\np1 = 1\n[[joints]]\ntheta = \"q1\"\na = \"p1\"\n";
    let (d, findings) = read_toml(text).expect("p1 is a length here");
    assert_eq!((d.parameters.len(), findings.len()), (1, 0));
    let modes = format!("{text}[modes]\nopen = \"+\"\n");
    assert!(read_toml(&modes).expect_err("no loops")[0].message.contains("no closed loop"));
}

#[test]
fn par_files_with_loops_are_held_to_their_numbers() {
    let errors = |text: &str| match read_par(text, Decimals::Meant) {
        Err(all) => all.iter().filter(|d| d.severity == Severity::Error).map(|d| d.message.clone()).collect(),
        Ok(_) => vec!["read".to_string()],
    };
    assert_eq!(errors(SR400), ["read"]);
    let found = errors(&SR400.replace("NF = 10", "NF = 11"));
    assert!(found.contains(&"9 joints for 8 links need 10 frames, not 11".to_string()), "{found:?}");
    assert_eq!(
        errors(&SR400.replace("mu = {1,1,0,1,1,1,1,0,0,0}", "mu = {1,1,0,1,1,1,1,0,1,0}")),
        ["frame 9 is that of a cut joint, and has a motor"]
    );
    assert_eq!(
        errors(&SR400.replace("ant = {0,1,2,3,4,5,1,7,8,3}", "ant = {0,1,2,3,4,5,1,7,8,9}")),
        ["frame 10 stands on the frame of a cut joint"]
    );
    assert_eq!(
        errors("NL = 1\nNJ = 1\nNF = 1\nType = 2\ntheta = {th1}\nsigma = {0}\n"),
        ["a mechanism with closed loops, of 1 joints for 1 links"]
    );
}

#[test]
fn nothing_panics_on_descriptions_at_random() {
    let mut random = Random(99);
    for _ in 0..60 {
        let rows = 1 + (random.between(0.0, 5.0) as usize);
        let mut text = String::from("name = \"x\"\nconvention = \"khalil\"\n");
        let (mut q, mut p) = (0, 0);
        let angle = |random: &mut Random| {
            ["0", "90 deg", "-90 deg", "30 deg", "0.1"][random.between(0.0, 4.99) as usize]
        };
        for j in 0..rows {
            let after = random.between(0.0, j as f64 + 0.99) as usize;
            text += &format!(
                "[[joints]]\nafter = {after}\nalpha = \"{}\"\nd = {:.1}\n",
                angle(&mut random),
                random.between(-1.0, 1.0)
            );
            let cell = if random.between(0.0, 1.0) < 0.8 { "theta" } else { "r" };
            if random.between(0.0, 1.0) < 0.4 {
                q += 1;
                text += &format!("{cell} = \"q{q}\"\n");
            } else {
                p += 1;
                text += &format!("{cell} = \"p{p}\"\n");
            }
        }
        for _ in 0..=(random.between(0.0, 1.9) as usize) {
            p += 1;
            let [a, b] = [0, 1].map(|_| random.between(0.0, rows as f64 + 0.99) as usize);
            text += &format!(
                "[[closures]]\nleft = {{ after = {a}, d = {:.1}, theta = \"p{p}\" }}\nright = {{ after = {b}, alpha = \"{}\", d = 0.5 }}\n",
                random.between(-1.0, 1.0),
                angle(&mut random)
            );
        }
        let Ok((Described::Linkage(l), _)) = read_robot(&text) else { panic!("{text}") };
        let _ = findings(&l);
        let _ = l.chain(None, None, None, Convention::Standard);
        let loops = Loops::new(&l).expect("values");
        let q: Vec<f64> = (0..q).map(|_| random.between(-2.0, 2.0)).collect();
        for a in loops.assemblies(&q).into_iter().take(4) {
            assert!(a.residual < 1e-8, "{text}");
            if let Ok((_, place)) = loops.place(None) {
                let _ = loops.rates(&place, &q, &a.passive);
            }
        }
        let _ = write_linkage(&l);
        let _ = write_linkage_par(&l);
    }
}

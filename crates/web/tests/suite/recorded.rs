//! Recorded motion, held against the robot in hand.

use crate::ask::{ask, told};
use serde_json::{Value, json};

/// A recording is held against the robot as the command line does, and comes with the motion to be played.
#[test]
fn a_recording_is_held_and_played() {
    let file = told("open", json!({ "text": "ur5", "kind": "robot" }))["file"].clone();
    told("edit", json!({ "file": file }));
    let rows = (0..80).map(|k| {
        let t = f64::from(k) / 25.0;
        let joint = |i: u32| {
            let (a, b) = (f64::from(i), f64::from(3 * i + 1));
            [0.2, -1.4, 1.3, -0.6, 1.1, 0.4][i as usize]
                + 0.4 * (0.7 * t + a).sin()
                + 0.2 * (1.1 * t + b).sin()
        };
        let q: Vec<f64> = (0..6).map(joint).collect();
        let frames = told("scene", json!({ "q": q }))["frames"].clone();
        let hand = frames.as_array().expect("frames").last().expect("a hand").clone();
        let entry = |r: usize, c: usize| hand[r][c].as_f64().expect("a number");
        let mut row = vec![t];
        row.extend(q);
        // The second joint runs the other way, the position is in millimetres.
        row[2] = -row[2];
        row.extend((0..3).map(|r| 1e3 * entry(r, 3)));
        row.extend((0..9).map(|k| entry(k / 3, k % 3)));
        row
    });
    let lines: Vec<String> =
        rows.map(|r| r.iter().map(f64::to_string).collect::<Vec<_>>().join(",")).collect();
    let head = "t,q1,q2,q3,q4,q5,q6,x,y,z,r11,r12,r13,r21,r22,r23,r31,r32,r33";
    let text = format!("{head}\n{}\n", lines.join("\n"));
    let answer = told("recording", json!({ "name": "run.csv", "latin1": text }));
    let kinds: Vec<&str> = answer["recorded"]["findings"]
        .as_array()
        .expect("findings")
        .iter()
        .map(|f| f["kind"].as_str().expect("a kind"))
        .collect();
    assert_eq!(kinds.len(), 2, "{kinds:?}");
    let views = answer["views"].as_array().expect("views");
    assert_eq!(views.len(), 2);
    let largest = |view: &Value, what: &str| {
        let all = view[what].as_array().expect("numbers");
        assert_eq!(all.len(), 80);
        all.iter().map(|x| x.as_f64().expect("a number")).fold(0.0, f64::max)
    };
    assert!(largest(&views[0], "shift") < 1e-6 && largest(&views[0], "turn") < 1e-6);
    assert!(largest(&views[1], "shift") > 1.0);
    assert_eq!(views[0]["path"]["q"][0].as_array().expect("joints").len(), 6);
    // The same as columns; what is none is refused in words.
    let columns: Vec<Value> = head
        .split(',')
        .enumerate()
        .map(|(c, name)| {
            let values: Vec<f64> = lines
                .iter()
                .map(|l| l.split(',').nth(c).expect("a cell").parse().expect("a number"))
                .collect();
            json!({ "name": name, "values": values })
        })
        .collect();
    let again = told("recording", json!({ "name": "run.parquet", "columns": columns }));
    assert_eq!(again["recorded"]["findings"], answer["recorded"]["findings"]);
    for wrong in [
        json!({ "name": "run.csv", "latin1": "" }),
        json!({ "name": "run.csv", "latin1": "t,q1\n0,1\n" }),
        json!({ "name": "run.xyz", "latin1": "1" }),
        json!({ "name": "run.parquet", "columns": [] }),
        json!({ "name": "run.npz", "latin1": "PK\u{3}\u{4}\u{ff}" }),
    ] {
        let refused = ask("recording", wrong.clone());
        assert!(refused["error"].as_str().is_some_and(|e| e.len() > 8), "{wrong}: {refused}");
    }
}

//! Lists, texts and YAML of xacro's expressions; elements that it makes.

use crate::xacro::{refused, with};

/// What each expression of lists, texts and YAML gives with the reference, xacro 2.1.1 of PyPI; `sum` and `enumerate` stand there in
/// `python`.
#[test]
fn lists_parts_formats_and_yaml_as_the_reference_has_them() {
    let yaml = "base: &base {length: 0.5, radius: 0.1, name: one}
arm:
  <<: *base
  radius: 0.2
  text: \"quoted
    over lines\"
again: *base
minutes: 1:30
sexa: 1:30.5
list: [3, 1, 2]
names: [left, right]
tagged: !!str 12
";
    let head = "<xacro:property name='d' value=\"${xacro.load_yaml('v.yaml')}\"/><xacro:property name='side' value='left'/>
<xacro:property name='l' value='${[3, 1, 2]}'/>";
    let name = |expression: &str| {
        let escaped = expression.replace('<', "&lt;");
        let (reading, files) = with(&format!("{head}<link name=\"{escaped}\"/>"), &[("v.yaml", yaml)], &[]);
        let said = |list: Vec<denavit::description::Diagnostic>| -> String {
            list.iter().map(|d| files.render(d)).collect()
        };
        reading.map(|r| r.0.bodies[0].name.clone()).map_err(said)
    };
    for (expression, value) in [
        ("${l[0:2]}", "[3, 1]"),
        ("${l[::-1]}", "[2, 1, 3]"),
        ("${l[-2:]}", "[1, 2]"),
        ("${side[1:3]}", "ef"),
        ("${side[0]}", "l"),
        ("${side[::2]}", "lf"),
        ("${[2*x for x in l]}", "[6, 2, 4]"),
        ("${[x for x in l if x > 1]}", "[3, 2]"),
        ("${[x + y for x in l for y in [10, 20] if y > 10]}", "[23, 21, 22]"),
        ("${[i*v for i, v in python.enumerate(l)]}", "[0, 1, 4]"),
        ("${'%s_link' % side}", "left_link"),
        ("${'%s_%02d|%5.2f|%-4s|%g' % (side, 7, 1.5, 'a', 0.0001)}", "left_07| 1.50|a   |0.0001"),
        ("${'%d%%' % 50}", "50%"),
        ("${python.sum([x*x for x in l])}", "14"),
        ("${sorted(l)}", "[1, 2, 3]"),
        ("${min(l) + max(l)}", "4"),
        ("${list(range(3))}", "[0, 1, 2]"),
        ("${[x for x in range(1, 10, 3)]}", "[1, 4, 7]"),
        ("${len(l[1:])}", "2"),
        ("${'-'.join([str(x) for x in l])}", "3-1-2"),
        ("${[n for n in d.names]}", "['left', 'right']"),
        ("${d.arm.length}", "0.5"),
        ("${d.arm.radius}", "0.2"),
        ("${d.arm.text}", "quoted over lines"),
        ("${d.again.name}", "one"),
        ("${d.minutes}", "90"),
        ("${d.sexa}", "90.5"),
        ("${d.tagged}", "12"),
        ("${[k for k in d.base.keys()]}", "['length', 'radius', 'name']"),
        ("${python.any([x > 2 for x in l])}", "True"),
        ("${python.all([x > 2 for x in l])}", "False"),
        ("${l + [4]}", "[3, 1, 2, 4]"),
        ("${[0]*3}", "[0, 0, 0]"),
        ("${(1, 2)[1]}", "2"),
        ("${[a if a > 1 else 0 for a in l]}", "[3, 0, 2]"),
        ("${l.index(2)}", "2"),
        ("${[[y*x for y in [1,2]] for x in l]}", "[[3, 6], [1, 2], [2, 4]]"),
        ("${[a*b for a, b in python.zip(l, [1,2,3])]}", "[3, 2, 6]"),
        ("${[x for x in l][1]}", "1"),
        ("${side + str(len(l))}", "left3"),
        ("${'%.3f' % 0.12345}", "0.123"),
        ("${'%5d' % 3}", "    3"),
        ("${'%+d' % 3}", "+3"),
        ("${d.list[1:]}", "[1, 2]"),
        ("${round(2.5)} ${round(3.5)} ${round(-2.5)} ${round(0.125, 2)}", "2 4 -2 0.12"),
        ("${1 if 'False' else 2}", "1"),
        ("${1 < 2 <= 2 < 3} ${1 < 2 > 5} ${3 > 2 == 2}", "True False True"),
        ("${5 not in l} ${3 not in l} ${'x' not in side}", "True False True"),
        ("${not 5 in l}", "True"),
        ("${1 in l != [1]}", "True"),
        ("${dict(a=1, b='two')}", "{'a': 1, 'b': 'two'}"),
        ("${dict(a=1)['a'] + dict([('a', 2), ('b', 3)])['b']}", "4"),
        ("${len(dict())} ${dict(dict(a=1), a=2)}", "0 {'a': 2}"),
        ("${hypot(3, 4) + 0.5} ${fmod(-7, 3) - 0.5} ${fmod(7.5, -2)}", "5.5 -1.5 1.5"),
        ("${copysign(2.5, -1)} ${trunc(-2.5)}", "-2.5 -2"),
        ("${[k for k in dict(x=1, y=2)]}", "['x', 'y']"),
        ("${1 if '10' < '9' else 2}", "1"),
    ] {
        assert_eq!(name(expression).as_deref(), Ok(value), "{expression}");
    }
    for (expression, said) in [
        ("${x for x in l}", "`x` is not defined"),
        ("${[x for x]}", "`in` is missing"),
        ("${l[5]}", "there is no entry 5"),
        ("${l[::0]}", "a step of 0"),
        ("${'%s %s' % side}", "fewer values"),
        ("${'%s' % (1, 2)}", "more values"),
        ("${[y for x in l]}", "`y` is not defined"),
        ("${[x for x in range(100000)]}", "more than 10000 values"),
        (
            "${[a+b+c+d for a in range(999) for b in range(999) for c in range(999) for d in l]}",
            "more than 200000 values",
        ),
        ("${len([[l*900 for x in range(999)] for y in range(999)])}", "more than 200000 values"),
    ] {
        let found = name(expression).expect_err(expression);
        assert!(found.contains(said), "{expression}: {found}");
    }
}

/// Elements and attributes whose names are worked out.
#[test]
fn elements_and_attributes_are_made() {
    let text = "<xacro:property name='kind' value='link'/><xacro:element xacro:name='${kind}' name='a_${1 + 1}'/>
<xacro:element xacro:name='joint' name='j'><xacro:attribute name='type' value='fix${\"ed\"}'/>
<parent link='a_2'/><xacro:element xacro:name='child'><xacro:attribute name='link' value='b'/></xacro:element></xacro:element>
<link name='b'/>";
    let (reading, _) = with(text, &[], &[]);
    let m = reading.expect("it is read").0;
    let names: Vec<&str> = m.bodies.iter().map(|b| b.name.as_str()).collect();
    assert_eq!(names, ["a_2", "b"]);
    assert_eq!((m.joints[0].name.as_str(), m.joints[0].child), ("j", 1));
    let said = |text: &str| refused(with(text, &[], &[])).remove(0);
    assert!(said("<xacro:element name='x'/>").contains("without `xacro:name`"));
    assert!(said("<xacro:element xacro:name='a b'/>").contains("`a b` is no name of an element"));
    assert!(said("<link name='a'><xacro:attribute name='x'/></link>").contains("without `value`"));
}

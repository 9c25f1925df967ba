//! xacro: what it expands to, exactly, and what it refuses, with places.

use crate::common::Random;
use denavit::description::{Alone, Convention, Decimals, Files, Mechanism, Reading, Sources, read_xacro};
use denavit_symbolic::Expr;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// The name of the first file.
const MAIN: &str = "main.xacro";

/// Files by name, packages in folders of their name; the first file has another name, too.
struct Shelf(BTreeMap<String, String>);

impl Sources for Shelf {
    fn open(&mut self, _: &str, wanted: &str) -> Result<(String, String), String> {
        let text = self.0.get(wanted).ok_or_else(|| format!("no file `{wanted}`"))?;
        Ok((self.canonical(wanted), text.clone()))
    }

    fn files(&mut self, _: &str, folder: &str) -> Vec<String> {
        let top = if folder == "." { String::new() } else { folder.to_string() };
        let name = |n: &String| n.strip_prefix(top.as_str()).filter(|n| !n.contains('/')).map(str::to_string);
        self.0.keys().filter_map(name).collect()
    }

    fn package(&mut self, name: &str) -> Option<String> {
        (name == "arms").then(|| "/arms".into())
    }

    fn variable(&self, name: &str) -> Option<String> {
        (name == "HEIGHT").then(|| "0.5".into())
    }

    fn canonical(&self, name: &str) -> String {
        if name == MAIN { format!("/{MAIN}") } else { name.into() }
    }
}

fn robot(inner: &str) -> String {
    format!("<robot xmlns:xacro='http://www.ros.org/wiki/xacro' name='r'>\n{inner}\n</robot>")
}

/// A robot of one joint, whose origin has this `xyz` and `rpy`.
fn joint(xyz: &str, rpy: &str) -> String {
    format!(
        "<link name='a'/><link name='b'/><joint name='j' type='continuous'><origin xyz='{xyz}' rpy='{rpy}'/>\
         <parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint>"
    )
}

pub fn with(inner: &str, files: &[(&str, &str)], arguments: &[(&str, &str)]) -> (Reading, Files) {
    let mut shelf = Shelf(
        files
            .iter()
            .map(|(n, t)| (n.to_string(), if n.ends_with("yaml") { (*t).into() } else { robot(t) }))
            .collect(),
    );
    shelf.0.insert(MAIN.into(), robot(inner));
    let arguments: Vec<_> = arguments.iter().map(|(n, v)| (n.to_string(), v.to_string())).collect();
    read_xacro(MAIN, &robot(inner), &mut shelf, &arguments, Decimals::Meant)
}

#[track_caller]
fn read(inner: &str) -> Mechanism {
    let (reading, files) = with(inner, &[], &[]);
    reading.unwrap_or_else(|list| panic!("{}", list.iter().map(|d| files.render(d)).collect::<String>())).0
}

/// `place: message | hint` of each finding.
pub fn refused((reading, files): (Reading, Files)) -> Vec<String> {
    let list = reading.expect_err("it is refused");
    let hint = |h: &Option<String>| h.as_ref().map_or(String::new(), |h| format!(" | {h}"));
    list.iter().map(|d| format!("{}: {}{}", files.place(&d.span), d.message, hint(&d.hint))).collect()
}

/// The three numbers of the origin's place.
fn place(m: &Mechanism) -> [Expr; 3] {
    m.joints[0].origin.translation.0
}

fn decimal(text: &str) -> Expr {
    denavit_symbolic::Rational::from_decimal(text).unwrap().into()
}

#[test]
fn numbers_are_exact() {
    for (expression, value) in [
        ("0.1 + 0.2", decimal("0.3")),
        ("1/3 + 1/6", decimal("0.5")),
        ("2*(3 - 5)", decimal("-4")),
        ("-2**2", decimal("-4")),
        ("2**-1", decimal("0.5")),
        ("7 % 3", decimal("1")),
        ("-7 // 2", decimal("-4")),
        ("sin(pi/6)", decimal("0.5")),
        ("cos(radians(60))", decimal("0.5")),
        ("degrees(pi/4)", decimal("45")),
        ("sqrt(0.25)", decimal("0.5")),
        ("degrees(atan2(1, 1))", decimal("45")),
        ("degrees(acos(0.5))", decimal("60")),
        ("max(1, 3, 2) + min(4, 5)", decimal("7")),
        ("abs(-0.5) + int(2.7) + round(0.5)", decimal("2.5")),
        ("[1, 2, 3][1] + [4, 5][-1]", decimal("7")),
        ("1 if 2 > 3 else 4", decimal("4")),
        ("5 if not (1 == 2 or 'a' != 'a') and 'b' in 'abc' else undefined", decimal("5")),
        ("math.pi/math.pi", decimal("1")),
        ("len('abc') + len([1, 2])", decimal("5")),
        ("1e-3*1000", decimal("1")),
        ("True + 1", decimal("2")),
    ] {
        let quoted = expression.replace('\'', "&apos;").replace('>', "&gt;");
        let m = read(&joint(&format!("${{{quoted}}} 0 0"), "0 0 0"));
        assert_eq!(place(&m)[0], value, "{expression}");
    }
    // What is no decimal keeps its value.
    let m = read(&joint("${1/3} ${sqrt(2)/2} 0", "${pi/5} 0 ${radians(37)}"));
    assert_eq!(place(&m)[0], Expr::int(1) / Expr::int(3));
    assert_eq!(
        place(&m)[1] * place(&m)[1],
        Expr::int(2).sqrt() / Expr::int(2) * (Expr::int(2).sqrt() / Expr::int(2))
    );
    let turned = denavit::geometry::Rotation::from_rpy(
        Expr::pi() / Expr::int(5),
        Expr::int(0),
        Expr::pi() * Expr::from(denavit_symbolic::Rational::new(37, 180)),
    );
    assert_eq!(m.joints[0].origin.rotation, turned);
}

#[test]
fn properties_are_lazy_and_see_their_scope() {
    let xyz = |inner: &str| place(&read(&format!("{inner}{}", joint("${a} ${b} 0", "0 0 0"))));
    // Used before what they refer to is given; one that names itself means what it was.
    let found = xyz("<xacro:property name='a' value='${2*b}'/><xacro:property name='b' value='0.25'/>");
    assert_eq!(found[0], decimal("0.5"));
    let found = xyz(
        "<xacro:property name='b' value='1'/><xacro:property name='b' value='${b + 1}'/><xacro:property name='a' value='${b}'/>",
    );
    assert_eq!(found[..2], [decimal("2"), decimal("2")]);
    // A default is only one.
    let found = xyz(
        "<xacro:property name='a' value='1'/><xacro:property name='a' default='5'/><xacro:property name='b' default='3'/>",
    );
    assert_eq!(found[..2], [decimal("1"), decimal("3")]);
    // A macro's own are its own, unless it says otherwise; it sees those of its caller.
    let found = xyz(
        "<xacro:macro name='m' params='x'><xacro:property name='a' value='9'/><xacro:property name='b' value='${x + a}' scope='parent'/></xacro:macro>
         <xacro:property name='a' value='1'/><xacro:property name='b' value='0'/><xacro:m x='${a + 1}'/>",
    );
    assert_eq!(found[..2], [decimal("1"), decimal("11")]);
}

#[test]
fn macros_take_values_blocks_and_defaults() {
    let inner = "
<xacro:macro name='link' params='name parent:=^|base xyz:=&apos;0 0 0&apos; *origin **more'>
  <link name='${name}'/>
  <joint name='${name}_joint' type='continuous'>
    <xacro:insert_block name='origin'/><parent link='${parent}'/><child link='${name}'/>
    <xacro:insert_block name='more'/>
  </joint>
  <link name='${name}_tip'/>
  <joint name='${name}_fixed' type='fixed'><origin xyz='${xyz}'/><parent link='${name}'/><child link='${name}_tip'/></joint>
</xacro:macro>
<link name='base'/>
<xacro:property name='h' value='0.5'/>
<xacro:link name='one'><origin xyz='0 0 ${h}'/><x><axis xyz='0 0 1'/></x></xacro:link>
<xacro:property name='parent' value='one'/>
<xacro:link name='two' xyz='1 2 3'><origin xyz='0 0 ${2*h}'/><x><axis xyz='0 1 0'/></x></xacro:link>
";
    let m = read(inner);
    let joint = |name: &str| m.joints.iter().find(|j| j.name == name).unwrap();
    assert_eq!(m.bodies[joint("two_joint").parent].name, "one");
    assert_eq!(joint("two_joint").origin.translation[2], Expr::int(1));
    assert_eq!(joint("two_joint").axis[1], Expr::int(1));
    assert_eq!(joint("two_fixed").origin.translation.0, [1, 2, 3].map(Expr::int));
    assert_eq!(joint("one_joint").origin.translation[2], decimal("0.5"));
    assert_eq!(m.chain(None, Some("two_tip"), Convention::Standard).unwrap().joints.len(), 2);
}

#[test]
fn conditions_arguments_and_files() {
    let main = "<xacro:arg name='long' default='false'/><xacro:arg name='x' default='0.1'/>
<xacro:include filename='lengths.xacro'/>
<xacro:include filename='$(find arms)/lengths.xacro'/>
<xacro:include filename='none.xacro' optional='true'/>
<xacro:if value='$(arg long)'><xacro:property name='l' value='2'/></xacro:if>
<xacro:unless value='${$(arg long)}'><xacro:property name='l' value='1'/></xacro:unless>";
    let files = [
        ("lengths.xacro", "<xacro:property name='k' value='3'/>"),
        ("/arms/lengths.xacro", "<xacro:property name='n' value='7'/>"),
    ];
    let text = format!("{main}{}", joint("${l} ${k} ${n + $(arg x)}", "0 0 0"));
    let unasked = with(&text, &files, &[("X", "0.2"), ("long", "true")]).0.unwrap().1;
    let messages: Vec<&str> = unasked.iter().map(|d| &*d.message).collect();
    assert_eq!(messages, ["no argument `X` is asked for: its value is not used"]);
    let read = |arguments: &[(&str, &str)]| place(&with(&text, &files, arguments).0.unwrap().0);
    assert_eq!(read(&[]), [decimal("1"), decimal("3"), decimal("7.1")]);
    assert_eq!(read(&[("long", "true"), ("x", "-1")]), [decimal("2"), decimal("3"), decimal("6")]);
}

#[test]
fn faults_have_the_place_of_the_text_and_of_the_call() {
    let one = |inner: &str| refused(with(inner, &[], &[]));
    for (inner, said) in [
        (
            "<xacro:property name='link' value='a'/><link name='${lnk}'/>",
            "main.xacro:2:52: `lnk` is not defined | did you mean `link`?",
        ),
        ("<xacro:foo/>", "main.xacro:2:1: the macro `foo` is not defined"),
        (
            "<xacro:property name='a' value='${a + 1}'/><link name='${a}'/>",
            "main.xacro:2:1: `a` is not defined",
        ),
        (
            "<xacro:property name='a' value='${b}'/><xacro:property name='b' value='${a}'/><link name='${a}'/>",
            "main.xacro:2:91: `a` refers to itself",
        ),
        ("<xacro:if value='maybe'/>", "main.xacro:2:18: `maybe` is neither true nor false"),
        ("<xacro:include filename='x.xacro'/>", "main.xacro:2:26: no file `x.xacro`"),
        (
            "<xacro:include filename='$(find legs)/x.xacro'/>",
            "main.xacro:2:26: the package `legs` is not found | say where it is: --package legs=FOLDER",
        ),
        (
            "<link name='$(arg n)'/>",
            "main.xacro:2:13: the argument `n` is not given | give it: --arg n=VALUE",
        ),
        (
            "<link name='$(eval a)'/>",
            "main.xacro:2:13: the argument `a` is not given | give it: --arg a=VALUE",
        ),
        ("<link name='$(env HOME)'/>", "main.xacro:2:13: the environment has no variable `HOME`"),
        (
            "<link name='$(anon a)'/>",
            "main.xacro:2:13: `$(anon …)` is not read | expand the file with xacro first",
        ),
        (
            "<xacro:macro name='m' params='a'/><xacro:m a='1' b='2'/>",
            "main.xacro:2:50: the macro `m` has no parameter `b`",
        ),
        (
            "<xacro:macro name='m' params='*a'/><xacro:m><link name='a'/><link name='b'/></xacro:m>",
            "main.xacro:2:61: the macro `m` takes no further block",
        ),
        ("<xacro:include filename='main.xacro'/>", "main.xacro:2:26: `main.xacro` includes itself"),
        (
            "<xacro:include filename='main.xacro' ns='a b'/>",
            "main.xacro:2:42: `a b` is no name for a namespace",
        ),
        ("<xacro:in.m/>", "main.xacro:2:1: the macro `in.m` is not defined"),
        ("<link name='${1/0}'/>", "main.xacro:2:13: a division by 0"),
        ("<link name='${1 +}'/>", "main.xacro:2:13: an expression that is not complete"),
        ("<link name='${(1}'/>", "main.xacro:2:13: `)` is missing"),
        ("<link name='${1'/>", "main.xacro:2:13: `}` is missing"),
        ("<link name='${lambda x: x}'/>", "main.xacro:2:13: `lambda` is not defined"),
    ] {
        let found = one(inner);
        assert!(found[0].starts_with(said), "{inner}: {found:?}");
    }
    // In a macro, in another file: both places.
    let files = [(
        "m.xacro",
        "<xacro:macro name='m' params='l'>\n<link name='a'/>\n<joint name='j' type='fixed'><origin xyz='0 ${l + k} 0'/></joint>\n</xacro:macro>",
    )];
    let found = refused(with("<xacro:include filename='m.xacro'/>\n<xacro:m l='1'/>", &files, &[]));
    assert_eq!(found, ["m.xacro:4:43: `k` is not defined | expanded from main.xacro:3:1"]);
    // What the reader of the URDF finds later, too.
    let files = [(
        "m.xacro",
        "<xacro:macro name='m' params='l'>\n<link name='a'/>\n<joint name='j' type='fixed'><origin xyz='${l} 0'/></joint>\n</xacro:macro>",
    )];
    let found = refused(with("<xacro:include filename='m.xacro'/>\n<xacro:m l='1'/>", &files, &[]));
    assert!(
        found.iter().any(|f| f == "m.xacro:4:43: `xyz` has 2 numbers, not 3 | expanded from main.xacro:3:1"),
        "{found:?}"
    );
}

#[test]
fn hostile_files_are_refused_at_once() {
    let ring = [
        ("a.xacro", "<xacro:include filename='b.xacro'/>"),
        ("b.xacro", "<xacro:include filename='a.xacro'/>"),
    ];
    let twice = "<xacro:macro name='m' params=''><xacro:m/><xacro:m/></xacro:macro><xacro:m/>";
    let doubling: String = (0..60)
        .map(|i| format!("<xacro:macro name='m{i}'><xacro:m{0}/><xacro:m{0}/></xacro:macro>", i + 1))
        .collect::<String>()
        + "<xacro:macro name='m60'><link name='a'/></xacro:macro><xacro:m0/>";
    let squares: String = (0..200)
        .map(|i| format!("<xacro:property name='p{}' value='${{p{i}*p{i}}}'/>", i + 1))
        .collect::<String>()
        + "<xacro:property name='p0' value='1.1'/><link name='${p200}'/>";
    let long = format!(
        "<xacro:property name='p0' value='1'/>{}<link name='${{p5000}}'/>",
        (0..5000)
            .map(|i| format!("<xacro:property name='p{}' value='${{p{i} + 1}}'/>", i + 1))
            .collect::<String>()
    );
    let deep = format!("<link name='${{{}1{}}}'/>", "(".repeat(1000), ")".repeat(1000));
    let choices = format!("<link name='${{{}}}'/>", "1 if 0 else ".repeat(200) + "2");
    let minus = format!("<link name='${{{}1}}'/>", "-".repeat(3900));
    for (name, inner, said) in [
        ("ring of files", "<xacro:include filename='a.xacro'/>", "includes itself"),
        ("macro that calls itself", twice, "deeply"),
        ("doubling", &doubling, "elements are expanded"),
        ("squares", &squares, "too"),
        ("properties of properties", &long, "deeply"),
        ("brackets", &deep, "brackets in brackets"),
        ("choices", &choices, "brackets in brackets"),
        ("signs", &minus, "no link"),
        ("power", "<link name='${9**9**9}'/>", "value"),
    ] {
        let start = Instant::now();
        let (reading, files) = with(inner, &ring, &[]);
        let shown: Vec<String> = match reading {
            Ok((m, _)) => vec![format!("no link is wrong: {}", m.bodies.len())],
            Err(list) => list.iter().map(|d| files.render(d)).collect(),
        };
        assert!(shown.iter().any(|s| s.contains(said)), "{name}: {:?}", &shown[..shown.len().min(3)]);
        assert!(start.elapsed() < Duration::from_secs(20), "{name} took {:?}", start.elapsed());
    }
}

const VALUES: &str = "\
# of an arm
arm:
  base: {xyz: [0.1, 0.2, 0.3], rpy: [0, !degrees 90,
         !radians pi/6]}   # goes on
  upper:
    length: 0.425
    'odd name': -1.5e-3
    \"text\": \"a: b # c\"
links:
- name: one
  size: !millimeters 120
-
  name: two
  size: !inches 2
  fixed: yes
- [1, 2, 3]
count: 0x10
octal: 010
big: 1_000
none: ~
last: it's plain, all of it
";

/// What each expression gives with the reference, xacro 2.1.1 of PyPI, in the same file; a third is exact here alone.
#[test]
fn values_of_yaml_namespaces_and_evaluated_arguments() {
    let inner = "<xacro:property name='length' value='2'/><xacro:property name='twice' value='${2*length + outer}'/>
<xacro:macro name='part' params='name k:=${length} **more'><link name='${name}_${k}_${length}'/><xacro:insert_block name='more'/>
<xacro:own name='${name}'/><xacro:property name='told' value='${length + 1}' scope='parent'/></xacro:macro>
<xacro:macro name='own' params='name'><link name='${name}_own'/></xacro:macro>";
    let head = "<xacro:property name='d' value=\"${xacro.load_yaml('v.yaml')}\"/>
<xacro:property name='length' value='7'/><xacro:property name='outer' value='0.5'/><xacro:property name='quoted' value=\"'1.0'\"/>
<xacro:arg name='n' default='3'/><xacro:arg name='flag' default='true'/><xacro:arg name='s' default='ab'/>
<xacro:include filename='inner.xacro' ns='sp'/>";
    let files = [("v.yaml", VALUES), ("inner.xacro", inner)];
    let part = "<xacro:sp.part name='p'><a><link name='given_${length}'/></a></xacro:sp.part>";
    let links = |text: &str| -> Vec<String> {
        let joined = |pair: &[&str]| {
            format!(
                "<joint name='{1}' type='fixed'><parent link='{0}'/><child link='{1}'/></joint>",
                pair[0], pair[1]
            )
        };
        let names = ["p_7_2", "given_7", "p_own", "last"];
        let joints: String = names.windows(2).filter(|_| text.contains(part)).map(joined).collect();
        let (reading, files) = with(&format!("{head}{text}{joints}"), &files, &[]);
        let said = |list: Vec<denavit::description::Diagnostic>| -> String {
            list.iter().map(|d| files.render(d)).collect()
        };
        let m = reading.unwrap_or_else(|list| panic!("{text}: {}", said(list))).0;
        m.bodies.into_iter().map(|b| b.name).collect()
    };
    assert_eq!(links(&format!("{part}<link name='last'/>")), ["p_7_2", "given_7", "p_own", "last"]);
    for (expression, value) in [
        ("${d.arm.base.xyz[1]}", "0.2"),
        ("${d['arm']['upper']['length']*2}", "0.85"),
        ("${d.links[1]['size']}", "0.0508"),
        ("${len(d.links)}", "3"),
        ("${d.count}", "16"),
        ("${d.octal}", "8"),
        ("${d.big}", "1000"),
        ("${d.none}", "None"),
        ("${d.last}", "it's plain, all of it"),
        ("${d.arm.upper.text}", "a: b # c"),
        ("${d.arm.base.rpy[1]}", "1.5707963267948966"),
        ("${d.arm.upper['odd name']}", "-0.0015"),
        ("${d.links[2][0]}", "1"),
        ("${d.links[0]['name']}", "one"),
        ("${d.links[1].fixed}", "True"),
        ("${sp.twice}", "4.5"),
        ("${sp.length}", "2"),
        ("$(eval 2*n + 1)", "7"),
        ("$(eval s if flag else n)", "ab"),
        ("${quoted}", "1.0"),
        ("${xacro.arg('n')}", "3"),
        ("$(optenv NO_SUCH_THING a  b)", "a b"),
        ("${'arm' in d}", "True"),
        ("$(optenv HEIGHT 7)$(env HEIGHT)", "0.50.5"),
    ] {
        assert_eq!(links(&format!("<link name=\"{expression}\"/>")), [value], "{expression}");
    }
    let told = format!(
        "{part}<xacro:property name='last' value='${{told == 3}}'/><xacro:if value='${{last}}'><link name='last'/></xacro:if>"
    );
    assert_eq!(links(&told).len(), 4);
    // Angles stay what they are.
    let (reading, _) = with(
        &format!(
            "{head}{}",
            joint("${d.arm.upper.length/3} 0 0", "0 ${d.arm.base.rpy[1]} ${d.arm.base.rpy[2]}")
        ),
        &files,
        &[],
    );
    let m = reading.unwrap().0;
    assert_eq!(place(&m)[0], decimal("0.425") / Expr::int(3));
    let turn = |d: i64| Expr::pi() / Expr::int(d);
    assert_eq!(
        m.joints[0].origin.rotation,
        denavit::geometry::Rotation::from_rpy(Expr::int(0), turn(2), turn(6))
    );
}

#[test]
fn what_is_wrong_in_yaml_has_its_place() {
    let said = |yaml: &str, expression: &str| {
        let inner = format!(
            "<xacro:property name='d' value=\"${{load_yaml('v.yaml')}}\"/><link name='${{{expression}}}'/>"
        );
        refused(with(&inner, &[("v.yaml", yaml)], &[])).remove(0)
    };
    let deep = format!("a: {}1", "[".repeat(100));
    // Each list holds the one before ten times.
    let mut many = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n".to_string();
    for k in 0..6 {
        many += &format!("a{0}: &a{0} [{1}]\n", k + 1, vec![format!("*a{k}"); 10].join(", "));
    }
    for (yaml, expression, expected) in [
        ("a: *x\n", "d.a", "v.yaml:1:4: not YAML: while parsing node, found unknown anchor"),
        ("a: &x [*x]\n", "d.a", "v.yaml:1:8: this anchor stands for what it stands in"),
        ("a: 1\n b: 2\n", "d.a", "v.yaml:2:3: not YAML: mapping values are not allowed in this context"),
        ("? [1]\n: 2\n", "d.a", "v.yaml:1:5: a name that is a list or a map is not read"),
        ("a: {<<: 1}\n", "d.a", "v.yaml:1:9: `<<` takes a map, or a list of maps"),
        (&many, "d.a", "v.yaml:5:45: more than 100000 values"),
        ("a: [1, 2\nb: 3", "d.a", "v.yaml:2:2: not YAML: illegal placement of ':' indicator"),
        ("a: [1,\n", "d.a", "v.yaml:2:1: not YAML: while parsing a node, did not find expected node content"),
        (
            "{a: 1",
            "d.a",
            "v.yaml:1:6: not YAML: while parsing a flow mapping, did not find expected ',' or '}'",
        ),
        ("a: !turns 1\n", "d.a", "v.yaml:1:4: the tag `!turns` is not read"),
        ("a: !degrees 1/0\n", "d.a", "v.yaml:1:4: a division by 0"),
        ("a: 1\n---\nb: 2", "d.a", "v.yaml:2:1: a second document is not read"),
        (
            "a: 'x\n",
            "d.a",
            "v.yaml:1:4: not YAML: while scanning a quoted scalar, found unexpected end of stream",
        ),
        (" a: 1\nb: 2\n", "d.a", "v.yaml:2:1: not YAML: did not find expected <document start>"),
        (&deep, "d.a", "v.yaml:1:63: values stand in values more than 60 deep"),
        ("length: 1\n", "d.lenght", "main.xacro:2:70: there is no `lenght` | did you mean `length`?"),
        ("- 1\n", "d[3]", "main.xacro:2:70: there is no entry 3: the list has 1"),
        ("- 1\n", "d + 1", "main.xacro:2:70: a list is no number"),
    ] {
        assert_eq!(said(yaml, expression), expected, "{yaml}");
    }
}

/// Pieces of expressions and elements thrown together: nothing panics.
#[test]
fn soup_does_no_harm() {
    let mut random = Random(20);
    let words = [
        "${",
        "}",
        "$(arg a)",
        "$(find arms)",
        "$$",
        "1",
        "0.5",
        "pi",
        "a",
        "+",
        "-",
        "*",
        "/",
        "**",
        "//",
        "%",
        "(",
        ")",
        "[",
        "]",
        ",",
        " if ",
        " else ",
        " not ",
        " in ",
        "&apos;",
        "sin(",
        "radians(",
        ".lower()",
        ".a",
        "load_yaml(",
        "$(eval ",
        "é",
        "<xacro:m/>",
        "<xacro:property name='a' value='${",
        "'/>",
        "<xacro:if value='",
        "</xacro:if>",
        "<xacro:macro name='m' params='*b c:=^'>",
        "</xacro:macro>",
        "<link name='",
        "<xacro:insert_block name='b'/>",
    ];
    for _ in 0..20_000 {
        let mut inner = String::from("<link name='${");
        for _ in 0..1 + (random.unit() * 12.0) as usize {
            inner.push_str(words[(random.unit() * words.len() as f64) as usize]);
        }
        inner.push_str("}'/>");
        let (reading, files) = read_xacro("soup", &robot(&inner), &mut Alone, &[], Decimals::Meant);
        if let Err(list) = reading {
            assert!(!list.is_empty(), "refused without a reason: {inner}");
            list.iter().for_each(|d| assert!(!files.render(d).is_empty()));
        }
    }
}

/// `*` in the name of a file that is included stands for any letters; the files come in the order of their names.
#[test]
fn files_are_included_by_a_pattern() {
    let files = [
        ("parts/b.xacro", "<link name='b'/>"),
        ("parts/a.xacro", "<link name='a'/>"),
        ("parts/.hidden.xacro", "<link name='hidden'/>"),
        ("parts/c.urdf", "<link name='c'/>"),
        ("parts/deep/d.xacro", "<link name='d'/>"),
    ];
    let joint = "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>";
    let include = |pattern: &str| format!("<xacro:include filename='{pattern}'/>{joint}");
    let (reading, files_read) = with(&include("parts/*.xacro"), &files, &[]);
    let (m, _) =
        reading.unwrap_or_else(|f| panic!("{}", f.iter().map(|d| files_read.render(d)).collect::<String>()));
    assert_eq!(m.bodies.iter().map(|b| b.name.as_str()).collect::<Vec<_>>(), ["a", "b"]);
    let said = |pattern: &str| {
        let (reading, read) = with(&include(pattern), &files, &[]);
        reading.unwrap_err().iter().map(|d| read.render(d)).collect::<String>()
    };
    assert!(said("parts/x*.xacro").contains("`parts/x*.xacro` is the name of no file"));
    assert!(said("p*/a.xacro").contains("a pattern is read in the name of a file"));
    assert!(said("*.xacro").contains("includes itself"));
}

//! Kinds of number: double-double against mpmath, intervals against what they must contain, all against one another.

use crate::support::{random, steps};
use denavit_program::{Domain, Extended, Interval};
use denavit_symbolic::Rational;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

// Values to 45 digits: mpmath 1.3.0 with mp.dps = 80.

/// x (a double), sin x, cos x; some rows are doubles that are exceptionally near to multiples of π/2.
const SINES: &[(f64, &str, &str)] = &[
    (
        0.5,
        "0.479425538604203000273287935215571388081803368",
        "0.877582561890372716116281582603829651991645197",
    ),
    (
        1.0,
        "0.841470984807896506652502321630298999622563061",
        "0.540302305868139717400936607442976603732310421",
    ),
    (
        -2.25,
        "-0.778073196887921241410966675587757320804460743",
        "-0.628173622722739088913389057396403306788815281",
    ),
    (
        1e-5,
        "9.99999999983333415136470576607823318448800874e-6",
        "0.999999999950000000000416658486359886510984914",
    ),
    (
        -1e-12,
        "-9.99999999999999979886647462588948700586186896e-13",
        "0.999999999999999999999999500000000000000020113",
    ),
    (
        3.140625,
        "0.00096765343878227946499529001767959010846105723",
        "-0.999999531823301611704207031882105416738679994",
    ),
    (
        1000.0,
        "0.826879540532002560255887429109218141212724968",
        "0.562379076290702991078249226605395968755811822",
    ),
    (
        -54321.125,
        "-0.152970268643462173048337735987064501293474021",
        "-0.988230791319086056672973732224001232656534739",
    ),
    (
        355.0,
        "-3.01443533594884492143302800086500995902558071e-5",
        "-0.999999999545658980165935841692754081123824951",
    ),
    (
        22.0,
        "-0.00885130929040387592169025681577233246328920395",
        "-0.999960826394637126454174739212693774135988467",
    ),
    (
        999999.5,
        "-0.756251087561677993029776712003020818586287202",
        "0.65428150865035093481204375571012014146577322",
    ),
    (
        1000000.0,
        "-0.349993502171292952117652486780771469061406605",
        "0.936752127533144786938532535074918775708097804",
    ),
    (
        0.00048828125,
        "0.000488281230597446593473993075068350978848160285",
        "0.999999880790712817694517044046316279768278345",
    ),
    (
        -FRAC_PI_4,
        "-0.70710678118654750275194295621751674626154324",
        "0.707106781186547546049745767992180669501683341",
    ),
    (
        FRAC_PI_2,
        "0.999999999999999999999999999999998125300271673",
        "6.1232339957367658861303296613750014646403778e-17",
    ),
    (
        45.553093477052,
        "0.999999999999999999999999999999999999808431486",
        "-6.18980636588357700015067146560965595823777678e-19",
    ),
    (
        321307.9594422229,
        "-0.999999999999999999999999999999999018931822307",
        "-4.42960083459612952075989057886353786371442549e-17",
    ),
    (
        57844706.68111352,
        "-6.79401531959440151784710890968314559598645128e-18",
        "0.999999999999999999999999999999999976920677919",
    ),
    (
        -1125899906842624.0,
        "-0.496396515208940840876821859865411368093356474",
        "0.868095904660550604334592502063501320395739261",
    ),
];

/// x, √x
const ROOTS: &[(&str, &str)] = &[
    ("2", "1.41421356237309504880168872420969807856967188"),
    ("3", "1.73205080756887729352744634150587236694280525"),
    ("0.1", "0.316227766016837933199889354443271853371955514"),
    ("1e-20", "1.0e-10"),
    ("1e20", "10000000000.0"),
    ("123456789.01234567890", "11111.1110611111109935555550265555525531866476"),
];

/// y, x, atan2(y, x)
const ANGLES: &[(&str, &str, &str)] = &[
    ("1", "1", "0.78539816339744830961566084581987572104929235"),
    ("1", "2", "0.463647609000806116214256231461214402028537054"),
    ("-1", "3", "-0.321750554396642193401404614358661319020755296"),
    ("1e-20", "1", "9.99999999999999999999999999999999999999966667e-21"),
    ("1", "-1e-20", "1.5707963267948966192413216916397514420985847"),
    ("1", "-3", "2.8198420991931510450612387689208415651764141"),
    ("-1", "-3", "-2.8198420991931510450612387689208415651764141"),
    ("-1e-20", "-1", "-3.1415926535897932384526433832795028841971694"),
    ("5", "0", "1.5707963267948966192313216916397514420985847"),
    ("-5", "0", "-1.5707963267948966192313216916397514420985847"),
    ("0", "-2", "3.1415926535897932384626433832795028841971694"),
    ("0.1", "0.7", "0.141897054604163922812851617102553083007781759"),
    ("1e10", "-3.5", "1.57079632714489661923132169162545977543191803"),
    ("-123.456", "0.001", "-1.57078822674305646460359957061243865298451685"),
];

fn decimal(text: &str) -> Rational {
    Rational::from_decimal(text).expect("a decimal")
}

/// |got − want| / |want|, computed exactly.
fn error(got: &Extended, want: &Rational) -> f64 {
    let difference = got.to_rational().expect("finite") - want.clone();
    if want.is_zero() { difference.to_f64().abs() } else { (difference / want.clone()).to_f64().abs() }
}

#[track_caller]
fn check(what: &str, got: &Extended, want: &str) {
    let found = error(got, &decimal(want));
    assert!(found <= 1e-30, "{what}: {found:e}");
}

#[test]
fn extended_functions_have_thirty_digits() {
    check("π", &Extended::pi(), "3.1415926535897932384626433832795028841971693993751");
    for (x, sine, cosine) in SINES {
        let (s, c) = Extended::from(*x).sin_cos();
        check(&format!("sin {x}"), &s, sine);
        check(&format!("cos {x}"), &c, cosine);
    }
    for (x, root) in ROOTS {
        check(&format!("√{x}"), &Extended::rational(&decimal(x)).sqrt(), root);
    }
    for (y, x, angle) in ANGLES {
        let got = Extended::rational(&decimal(y)).atan2(&Extended::rational(&decimal(x)));
        check(&format!("atan2({y}, {x})"), &got, angle);
    }
}

#[test]
fn extended_numbers_at_the_edges_are_as_doubles() {
    let x = |x: f64| Extended::from(x);
    assert_eq!(x(0.0).sqrt().to_f64(), 0.0);
    assert_eq!([x(-2.0), x(0.0), x(3.0)].map(|x| x.sign().to_f64()), [-1.0, 0.0, 1.0]);
    assert!(x(-1.0).sqrt().to_f64().is_nan());
    assert_eq!(x(f64::INFINITY).sqrt().to_f64(), f64::INFINITY);
    assert_eq!(x(1.0).div(&x(0.0)).to_f64(), f64::INFINITY);
    assert_eq!(x(1.0).div(&x(f64::INFINITY)).to_f64(), 0.0);
    assert_eq!(x(f64::INFINITY).add(&x(1.0)).to_f64(), f64::INFINITY);
    assert!(x(f64::INFINITY).sub(&x(f64::INFINITY)).to_f64().is_nan());
    assert_eq!(x(1e300).mul(&x(1e300)).to_f64(), f64::INFINITY);
    assert!(x(2e15).sin_cos().0.to_f64().is_nan());
    assert_eq!(x(0.0).atan2(&x(0.0)).to_f64(), 0.0);
    assert_eq!(x(-0.0).atan2(&x(-0.0)), Extended::pi().neg());
    assert_eq!(x(-0.0).atan2(&x(-1.0)), Extended::pi().neg());
    assert_eq!(x(1.0).atan2(&x(f64::INFINITY)).to_f64(), 0.0);
    assert_eq!(Extended::new(1.0, 1e-20).parts(), [1.0, 1e-20]);
}

/// Enclosures of single operations at places where they are known.
#[test]
fn intervals_know_extrema_and_cuts() {
    let i = Interval::new;
    let range = |lo: f64, hi: f64| Interval::new(lo, hi).sin_cos();
    assert_eq!(range(1.0, 2.0).0.hi, 1.0);
    assert!(range(1.0, 1.5).0.hi < 1.0);
    assert_eq!(range(4.0, 5.0).0.lo, -1.0);
    assert_eq!(range(-0.1, 0.1).1.hi, 1.0);
    assert_eq!(range(3.0, 4.0).1.lo, -1.0);
    assert!(range(3.2, 4.0).1.lo > -1.0);
    assert_eq!(range(0.0, 7.0), (i(-1.0, 1.0), i(-1.0, 1.0)));
    assert_eq!(range(1e22, 1e22), (i(-1.0, 1.0), i(-1.0, 1.0)));
    assert_eq!(Interval::WHOLE.sin_cos(), (i(-1.0, 1.0), i(-1.0, 1.0)));
    let turned = range(1000.0 * PI + 0.1, 1000.0 * PI + 0.2).0;
    assert!(turned.contains(0.15_f64.sin()) && turned.width() < 0.11, "{turned:?}");

    assert_eq!(i(1.0, 2.0).div(&i(-1.0, 1.0)), Interval::WHOLE);
    assert_eq!(i(1.0, 2.0).div(&i(0.0, 1.0)), Interval::WHOLE);
    let ratio = i(5.0, f64::INFINITY).div(&i(2.0, f64::INFINITY));
    assert!(ratio.lo <= 0.0 && ratio.hi == f64::INFINITY);
    assert_eq!(i(0.0, 0.0).mul(&Interval::WHOLE), i(0.0, 0.0));
    assert_eq!(i(-4.0, 0.0).sqrt(), i(0.0, 0.0));
    assert!(i(-4.0, 9.0).sqrt().contains(3.0) && i(-4.0, 9.0).sqrt().lo == 0.0);
    assert_eq!(i(-4.0, -1.0).sqrt(), Interval::WHOLE);
    assert_eq!(
        [i(-4.0, -1.0), i(-1.0, 2.0), i(0.0, 3.0)].map(|x| x.sign()),
        [i(-1.0, -1.0), i(-1.0, 1.0), i(0.0, 1.0)]
    );

    let all = i(-1.0, 1.0).atan2(&i(-2.0, -1.0));
    assert!(all.lo <= -PI && all.hi >= PI);
    assert_eq!(i(0.0, 1.0).atan2(&i(-2.0, -1.0)), all);
    assert_eq!(i(-1.0, 1.0).atan2(&i(-1.0, 1.0)), all);
    let upper = i(1.0, 2.0).atan2(&i(-1.0, 1.0));
    assert!(upper.lo > 0.7 && upper.hi < 2.4, "{upper:?}");
    let right = i(-1.0, 1.0).atan2(&i(1.0, 2.0));
    assert!(right.lo > -0.8 && right.hi < 0.8, "{right:?}");
    // a tenth is between two doubles
    let tenth = Interval::rational(&Rational::new(1, 10));
    assert!(tenth.lo < 0.1 && 0.1 < tenth.hi);
    assert_eq!(Interval::rational(&Rational::new(1, 8)), i(0.125, 0.125));
}

/// Ends of an interval, and a place between them from 0 to 1.
fn placed() -> impl Strategy<Value = (Interval, f64)> {
    let end = || {
        prop_oneof![
            4 => -10.0..10.0_f64,
            1 => Just(0.0),
            1 => any::<f64>().prop_filter("finite", |x| x.is_finite()),
            1 => (-20..20_i32).prop_map(|k| f64::from(k) * PI / 2.0),
            1 => (-300..300_i32).prop_map(|k| 10_f64.powi(k)),
        ]
    };
    let width =
        prop_oneof![Just(0.0), 0.0..0.01_f64, 0.0..20.0_f64, (-300..300_i32).prop_map(|k| 10_f64.powi(k))];
    (end(), width, prop_oneof![Just(0.0), Just(1.0), 0.0..1.0_f64]).prop_map(|(lo, width, at)| {
        let hi = if (lo + width).is_finite() { lo + width } else { lo };
        let point = (lo + at * (hi - lo)).clamp(lo, hi);
        (Interval::new(lo, hi), if point.is_finite() { point } else { lo })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn results_are_inside((a, x) in placed(), (b, y) in placed()) {
        let [ex, ey] = [x, y].map(Extended::from);
        let inside = |what: &str, i: Interval, plain: f64, exact: Option<Extended>| {
            prop_assert!(!i.lo.is_nan() && !i.hi.is_nan() && i.lo <= i.hi, "{}: {:?}", what, i);
            prop_assert!(plain.is_nan() || i.contains(plain), "{what}: {plain:e} of {x:e}, {y:e} in {i:?}");
            // Double-double, where it has the range for it.
            if let Some(e) = exact.filter(|e| (1e-200..1e200).contains(&e.to_f64().abs())) {
                prop_assert!(i.contains(e.to_f64()), "{}: {:?} in {:?}", what, e, i);
            }
            Ok(())
        };
        inside("−", a.neg(), -x, None)?;
        inside("+", a.add(&b), x + y, Some(ex.add(&ey)))?;
        inside("−", a.sub(&b), x - y, Some(ex.sub(&ey)))?;
        inside("·", a.mul(&b), x * y, Some(ex.mul(&ey)))?;
        inside("/", a.div(&b), x / y, Some(ex.div(&ey)))?;
        inside("√", a.sqrt(), x.sqrt(), Some(ex.sqrt()))?;
        inside("sin", a.sin_cos().0, x.sin(), Some(ex.sin_cos().0))?;
        inside("cos", a.sin_cos().1, x.cos(), Some(ex.sin_cos().1))?;
        inside("atan2", a.atan2(&b), x.atan2(y), Some(ex.atan2(&ey)))?;
    }

    /// The double-double sums, products, quotients and roots have their error bounds, by exact arithmetic.
    #[test]
    fn extended_arithmetic(
        [a, b] in [[-1e9..1e9_f64, -1e-9..1e-9_f64], [-1e-3..1e-3_f64, -1e-21..1e-21_f64]],
        (n, d) in (any::<i64>(), 1..i64::MAX),
    ) {
        let (x, y) = (Extended::new(a[0], a[1]), Extended::new(b[0], b[1]));
        let [p, q] = [x, y].map(|e| e.to_rational().expect("finite"));
        prop_assert!(error(&x.add(&y), &(&p + &q)) < 1e-31);
        prop_assert!(error(&x.mul(&y), &(&p * &q)) < 1e-31);
        if !q.is_zero() {
            prop_assert!(error(&x.div(&y), &(&p / &q)) < 1e-31);
        }
        let (root, magnitude) = (if p.is_negative() { x.neg() } else { x }.sqrt(), p.abs());
        let r = root.to_rational().expect("finite");
        prop_assert!(p.is_zero() || ((&(&r * &r) - &magnitude) / magnitude).to_f64().abs() < 1e-31);
        // A rational is the nearest double, and the double nearest to the rest.
        let exact = Rational::new(n, d);
        let [hi, lo] = Extended::rational(&exact).parts();
        prop_assert_eq!(hi, exact.to_f64());
        prop_assert_eq!(lo, (exact - Rational::from_f64(hi).expect("finite")).to_f64());
    }
}

proptest! {
    /// Doubles, singles and double-doubles agree to what they can; intervals contain all of them but singles.
    #[test]
    fn kinds_agree(
        steps in steps(25),
        at in [-3.0..3.0_f32, -3.0..3.0, -3.0..3.0, -3.0..3.0],
        spread in prop_oneof![Just(0.0_f64), Just(1e-6), 0.0..0.5_f64],
    ) {
        let f = random(&steps, 3);
        let names: Vec<_> = f.variables().iter().chain(f.parameters()).copied().collect();
        let input = |s| names.iter().position(|n| *n == s).map(|i| f64::from(at[i]));
        let doubles = f.eval(input).expect("all inputs are given");
        let singles = f.eval(|s| input(s).map(|x| x as f32)).expect("all inputs are given");
        let extended = f.eval(|s| input(s).map(Extended::from)).expect("all inputs are given");
        let intervals =
            f.eval(|s| input(s).map(|x| Interval::new(x - spread, x + spread / 2.0))).expect("all inputs are given");
        for (((d, s), e), i) in doubles.iter().zip(&singles).zip(&extended).zip(&intervals) {
            prop_assert!((d - e.to_f64()).abs() < 1e-12, "{} {}", d, e.to_f64());
            prop_assert!((d - f64::from(*s)).abs() < 1e-3, "{} {}", d, s);
            prop_assert!(i.contains(*d) && i.contains(e.to_f64()), "{d} in {i:?}");
        }
    }
}

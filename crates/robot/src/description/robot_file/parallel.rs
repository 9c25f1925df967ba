//! Files of parallel robots: `kind = "gough-stewart"`, `"delta"` or `"planar-3rrr"`, as `docs/parallel-robots.md` describes them.

use super::fields::{Fields, Reader, clamp};
use super::{Cell, MAX_BYTES, Quantity, Style, parameters};
use crate::description::Parameter;
use crate::description::diagnostic::{Diagnostic, Diagnostics, nearest};
use crate::description::parallel::{DeltaDrive, Family, Parallel, Place};
use crate::geometry::Vector;
use denavit_symbolic::Expr;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

const KINDS: [&str; 3] = ["gough-stewart", "delta", "planar-3rrr"];
const COMMON: &[&str] = &["kind", "name", "source", "parameters", "limits", "poses"];
/// Verbs that serve these robots.
pub const VERBS: &str = "`show`, `fk`, `ik` and `jacobian` serve it";

/// What was read with warnings and notes, or all that was found where there are errors.
pub type ParallelRead = Result<(Parallel, Vec<Diagnostic>), Vec<Diagnostic>>;

/// Reads the file of a parallel robot; nothing of a text that says no `kind`. With what it describes come warnings and notes.
///
/// # Errors
/// All errors of the text (with the warnings and notes), in the order of the text.
pub fn read_parallel(text: &str) -> Option<ParallelRead> {
    if text.len() > MAX_BYTES {
        return None;
    }
    let (table, errors) = DeTable::parse_recoverable(text);
    let fields = Fields::new(table.get_ref(), 0..0);
    let kind = fields.get("kind")?;
    let mut reader = Reader { text, out: Diagnostics::default(), branches: None, loops: None };
    for e in errors {
        let span = clamp(text, e.span().unwrap_or(0..0));
        let message = match e.message() {
            "duplicate key" => format!("`{}` is given twice", &text[span.clone()]),
            message => format!("not TOML: {message}"),
        };
        reader.out.error(span, message);
    }
    if reader.out.has_errors() {
        return Some(reader.out.finish(None));
    }
    let read = reader.parallel(&fields, kind);
    Some(reader.out.finish(read))
}

/// The cells of a file, by what they measure.
#[derive(Default)]
struct Seen {
    lengths: Vec<Cell>,
    angles: Vec<Cell>,
    /// Lengths that are greater than 0, or not less.
    positive: Vec<(Cell, bool)>,
}

impl Reader<'_> {
    fn parallel(&mut self, fields: &Fields, kind: &Spanned<DeValue>) -> Option<Parallel> {
        let given = self.string(Some(kind))?;
        let known = KINDS.into_iter().find(|k| *k == given);
        let own: &[&str] = match known {
            Some("gough-stewart") => &["base", "platform"],
            Some("delta") => &["base_radius", "platform_radius", "upper_arm", "lower_arm", "angles", "slope"],
            Some(_) => &["base", "platform", "proximal", "distal"],
            None => {
                self.unknown_kind(&given, kind.span());
                return None;
            }
        };
        self.unknown_keys(fields, &[COMMON, own].concat(), |key| hint(key, own));
        let name = self.string(fields.get("name")).unwrap_or_else(|| "robot".into());
        let source = self.string(fields.get("source"));
        let declared = self.parameter_names(fields.get("parameters"));
        let names: Vec<String> = declared.iter().map(|p| p.name.clone()).collect();
        let mut seen = Seen::default();
        let place = kind.span();
        let family = match given.as_str() {
            "gough-stewart" => self.stewart(fields, &place, &mut seen),
            "delta" => self.delta(fields, &place, &mut seen),
            _ => self.planar(fields, &place, &mut seen),
        };
        for cell in seen.lengths.iter().chain(&seen.angles) {
            self.constant_of_parameters(cell, &names, 0);
        }
        let uses = parameters::Uses::of_cells(&seen.angles, &seen.lengths);
        let parameters = self.parameter_values(&declared, &uses);
        self.signs(&seen.positive, &parameters);
        let family = family?;
        let limits = self.drive_limits(fields.get("limits"), &family);
        let poses = self.places(fields.get("poses"), &family);
        Some(Parallel { name, source, parameters, family, limits, poses })
    }

    fn unknown_kind(&mut self, given: &str, span: Range<usize>) {
        let plain: String = given.to_lowercase().chars().filter(char::is_ascii_alphanumeric).collect();
        let meant = match plain.as_str() {
            "stewart" | "gough" | "stewartgough" | "goughstewart" | "hexapod" | "stewartplatform"
            | "6ups" | "6sps" | "6spu" => Some("gough-stewart"),
            "3rrr" | "rrr" | "planar3rrr" | "planarrrr" => Some("planar-3rrr"),
            "lineardelta" | "rotarydelta" | "deltarobot" => Some("delta"),
            _ => nearest(given, KINDS),
        };
        let hint = match meant {
            Some("delta") => "kind = \"delta\": with `upper_arm` where arms turn, `slope` where they slide".to_string(),
            Some(meant) => format!("did you mean \"{meant}\"?"),
            None => "a parallel robot is \"gough-stewart\", \"delta\" or \"planar-3rrr\"; other files have no `kind`".into(),
        };
        let shown: String = given.chars().take(40).collect();
        self.out.error(span, format!("unknown kind \"{}\"", shown.escape_debug())).hint(hint);
    }

    /// The value of a key that has to be there.
    fn needed<'a>(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        place: &Range<usize>,
        example: &str,
    ) -> Option<&'a Spanned<DeValue<'a>>> {
        let value = fields.get(key);
        if value.is_none() {
            self.out.error(place.clone(), format!("`{key}` is missing")).hint(format!("{key} = {example}"));
        }
        value
    }

    fn length(&mut self, value: &Spanned<DeValue>, is_positive: bool, seen: &mut Seen) -> Option<Expr> {
        let cell = self.cell(value, &Style::of(Quantity::Length))?;
        seen.lengths.push(cell.clone());
        seen.positive.push((cell.clone(), is_positive));
        Some(cell.expr)
    }

    fn angle(&mut self, value: &Spanned<DeValue>, seen: &mut Seen) -> Option<Expr> {
        let cell = self.cell(value, &Style::of(Quantity::Angle))?;
        seen.angles.push(cell.clone());
        Some(cell.expr)
    }

    /// `count` points of `dimension` coordinates.
    fn points(
        &mut self,
        fields: &Fields,
        key: &str,
        (count, dimension): (usize, usize),
        place: &Range<usize>,
        seen: &mut Seen,
    ) -> Option<Vec<Vec<Expr>>> {
        let point = if dimension == 3 { "[x, y, z]" } else { "[x, y]" };
        let example = format!("[{point}, …], {count} points, metres or with units");
        let value = self.needed(fields, key, place, &example)?;
        let array = self.array(value, key)?;
        if array.len() != count {
            let message = format!("{key} has {count} points {point}, not {}", array.len());
            self.out.error(value.span(), message);
            return None;
        }
        let mut points = vec![];
        for item in array.iter() {
            let what = format!("a point {point}");
            if let Some(cells) = self.list(item, &Style::of(Quantity::Length), &what, dimension) {
                points.push(cells.iter().map(|c| c.expr).collect());
                seen.lengths.extend(cells);
            }
        }
        (points.len() == count).then_some(points)
    }

    fn stewart(&mut self, fields: &Fields, place: &Range<usize>, seen: &mut Seen) -> Option<Family<Expr>> {
        let mut six = |key: &str| -> Option<[Vector<Expr>; 6]> {
            let points = self.points(fields, key, (6, 3), place, seen)?;
            points
                .into_iter()
                .map(|p| Some(Vector(p.try_into().ok()?)))
                .collect::<Option<Vec<_>>>()?
                .try_into()
                .ok()
        };
        let (base, platform) = (six("base"), six("platform"));
        Some(Family::Stewart { base: base?, platform: platform? })
    }

    fn delta(&mut self, fields: &Fields, place: &Range<usize>, seen: &mut Seen) -> Option<Family<Expr>> {
        let mut radius = |key: &str, example: &str, is_positive: bool| {
            let value = self.needed(fields, key, place, example)?;
            self.length(value, is_positive, seen)
        };
        let base_radius = radius("base_radius", "\"0.2 m\", from the middle to the arms' axes", false);
        let platform_radius = radius("platform_radius", "\"45 mm\", from the middle to the rods", false);
        let lower_arm = radius("lower_arm", "\"0.8 m\", the length of the rods", true);
        let drive = match (fields.get("upper_arm"), fields.get("slope")) {
            (Some(arm), None) => self.length(arm, true, seen).map(DeltaDrive::Turns),
            (None, Some(slope)) => self.angle(slope, seen).map(DeltaDrive::Slides),
            (Some(_), Some(slope)) => {
                self.out.error(slope.span(), "`slope` beside `upper_arm`").hint(
                    "arms turn (`upper_arm`, a length) or slide (`slope`, their angle below the horizontal)",
                );
                None
            }
            (None, None) => {
                self.out.error(place.clone(), "how are the arms driven?").hint(
                    "upper_arm = \"0.235 m\" where they turn, slope = \"90 deg\" where they slide: the angle of slides below the horizontal",
                );
                None
            }
        };
        let third = Expr::int(2) * Expr::pi() / Expr::int(3);
        let angles = match fields.get("angles") {
            None => Some([Expr::int(0), third, third + third]),
            Some(value) => self.array(value, "angles").and_then(|array| {
                if array.len() != 3 {
                    self.out.error(value.span(), format!("angles has 3 values, not {}", array.len()));
                    return None;
                }
                let read: Vec<Expr> = array.iter().filter_map(|v| self.angle(v, seen)).collect();
                read.try_into().ok()
            }),
        };
        Some(Family::Delta {
            base_radius: base_radius?,
            platform_radius: platform_radius?,
            lower_arm: lower_arm?,
            angles: angles?,
            drive: drive?,
        })
    }

    fn planar(&mut self, fields: &Fields, place: &Range<usize>, seen: &mut Seen) -> Option<Family<Expr>> {
        let mut three = |key: &str| -> Option<[[Expr; 2]; 3]> {
            let points = self.points(fields, key, (3, 2), place, seen)?;
            points.into_iter().map(|p| p.try_into().ok()).collect::<Option<Vec<_>>>()?.try_into().ok()
        };
        let (base, platform) = (three("base"), three("platform"));
        let mut links = |key: &str, which: &str| -> Option<[Expr; 3]> {
            let value =
                self.needed(fields, key, place, &format!("\"0.2 m\", or one a leg: the length of {which}"))?;
            let DeValue::Array(array) = value.get_ref() else {
                return self.length(value, true, seen).map(|e| [e; 3]);
            };
            if array.len() != 3 {
                self.out.error(value.span(), format!("{key} has 3 values, not {}", array.len()));
                return None;
            }
            let read: Vec<Expr> = array.iter().filter_map(|v| self.length(v, true, seen)).collect();
            read.try_into().ok()
        };
        let (proximal, distal) =
            (links("proximal", "the links that are driven"), links("distal", "the links behind them"));
        Some(Family::Planar3Rrr { base: base?, platform: platform?, proximal: proximal?, distal: distal? })
    }

    /// Reports lengths that are none.
    fn signs(&mut self, lengths: &[(Cell, bool)], parameters: &[Parameter]) {
        for (cell, is_positive) in lengths {
            let value = |s| parameters.iter().find(|p| p.symbol == s)?.number();
            let Ok(x) = cell.expr.eval(value) else { continue };
            if !x.is_finite() || x < 0.0 || (*is_positive && x == 0.0) {
                let wanted = if *is_positive { "greater than 0" } else { "not less than 0" };
                self.out.error(cell.span.clone(), format!("this length is {wanted}"));
            }
        }
    }

    /// One pair of limits for all drives, or one a drive.
    fn drive_limits(&mut self, value: Option<&Spanned<DeValue>>, family: &Family<Expr>) -> Vec<[Expr; 2]> {
        let Some(value) = value else { return vec![] };
        let Some(array) = self.array(value, "limits") else { return vec![] };
        let is_list = |v: &Spanned<DeValue>| matches!(v.get_ref(), DeValue::Array(_));
        let count = family.drives();
        let pairs: Vec<&Spanned<DeValue>> = match array.len() {
            2 if !array.iter().any(is_list) => vec![value],
            n if n == count && array.iter().all(is_list) => array.iter().collect(),
            _ => {
                self.out
                    .error(value.span(), format!("limits are [least, greatest], or {count} of such pairs"))
                    .hint("limits = [\"0.7 m\", \"1.1 m\"]");
                return vec![];
            }
        };
        let mut limits = vec![];
        for pair in pairs {
            let style = Style::plain(family.measure().into());
            let Some(cells) = self.list(pair, &style, "limits", 2) else { continue };
            let numbers: Vec<f64> = cells.iter().filter_map(|c| c.expr.eval(|_| None).ok()).collect();
            if let Some((name, span)) = cells.iter().flat_map(|c| &c.symbols).next() {
                self.out.error(span.clone(), format!("`{name}` stands where a number is needed"));
            } else if numbers.len() != 2
                || numbers[0].is_nan()
                || numbers[1].is_nan()
                || numbers[0] > numbers[1]
            {
                self.out.error(pair.span(), "the first limit is the least, the second the greatest");
            } else {
                limits.push([cells[0].expr, cells[1].expr]);
            }
        }
        limits
    }

    fn places(&mut self, value: Option<&Spanned<DeValue>>, family: &Family<Expr>) -> Vec<(String, Place)> {
        let Some(table) = value.and_then(|v| self.table(v, "poses")) else { return vec![] };
        let mut places = vec![];
        for (name, value) in &table.entries {
            let place = if let DeValue::Table(_) = value.get_ref() {
                self.platform_pose(value, family).map(Place::Platform)
            } else {
                self.drives(value, name, family).map(Place::Drives)
            };
            places.extend(place.map(|p| (name.replace(|c: char| c.is_control(), " "), p)));
        }
        places
    }

    fn drives(&mut self, value: &Spanned<DeValue>, name: &str, family: &Family<Expr>) -> Option<Vec<Expr>> {
        let values = self.array(value, "a pose")?;
        if values.len() != family.drives() {
            let (found, wanted) = (values.len(), family.drives());
            let shown: String = name.chars().take(40).collect();
            self.out
                .error(value.span(), format!("the pose `{}` has {found} values for {wanted} drives", shown.escape_debug()))
                .hint("one value for each drive, or where the platform is: { xyz = [0, 0, 0.8], rpy = [0, 0, 0] }");
            return None;
        }
        let style = Style::plain(family.measure().into());
        let read: Vec<Expr> = values.iter().filter_map(|v| self.constant(v, &style)).collect();
        let is_negative = |e: &Expr| e.eval(|_| None).is_ok_and(|x| x < 0.0);
        if matches!(family, Family::Stewart { .. }) && read.iter().any(is_negative) {
            self.out.error(value.span(), "the length of a leg is not negative");
            return None;
        }
        (read.len() == values.len()).then_some(read)
    }

    fn platform_pose(
        &mut self,
        value: &Spanned<DeValue>,
        family: &Family<Expr>,
    ) -> Option<crate::geometry::Transform<Expr>> {
        let (pose, cells) = self.frame(Some(value), "poses");
        for cell in cells.lengths.iter().chain(&cells.angles).chain(&cells.entries) {
            if let Some((name, span)) = cell.symbols.first() {
                self.out.error(span.clone(), format!("`{name}` stands where a number is needed"));
                return None;
            }
        }
        let pose = pose?;
        let number = |e: Expr| e.eval(|_| None).unwrap_or(f64::NAN);
        let z = pose.rotation.z().map(number);
        let x = pose.rotation.x().map(number);
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        let fault = match family {
            Family::Stewart { .. } => None,
            Family::Delta { .. } => {
                (!near(z[2], 1.0) || !near(x[0], 1.0)).then_some("a delta keeps its orientation: xyz alone")
            }
            Family::Planar3Rrr { .. } => (!near(z[2], 1.0) || !near(number(pose.translation[2]), 0.0))
                .then_some("the platform moves in the plane: xyz = [x, y, 0], rpy = [0, 0, angle]"),
        };
        if let Some(fault) = fault {
            self.out.error(value.span(), fault);
            return None;
        }
        Some(pose)
    }
}

fn hint(key: &str, own: &[&str]) -> Option<String> {
    let is = |k: &str| own.contains(&k);
    let meant = match key {
        "joints" | "convention" | "closures" | "tool" | "axes" | "screws" | "tip" | "frames" => {
            return Some("a file with `kind` is that of a parallel robot, which has no rows".into());
        }
        "lengths" | "legs" | "leg_limits" | "length_limits" => "limits",
        "home" => "poses",
        "base_points" | "anchors" if is("base") => "base",
        "platform_points" | "top" if is("platform") => "platform",
        "arm" | "proximal" | "bicep" if is("upper_arm") => "upper_arm",
        "rod" | "distal" | "forearm" if is("lower_arm") => "lower_arm",
        "base" if is("base_radius") => "base_radius",
        "platform" if is("platform_radius") => "platform_radius",
        "first" | "upper_arm" | "l1" if is("proximal") => "proximal",
        "second" | "lower_arm" | "l2" if is("distal") => "distal",
        _ => return None,
    };
    Some(format!("did you mean `{meant}`?"))
}

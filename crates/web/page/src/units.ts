// Angles and lengths as a person reads and types them. Inside, everything is radians and metres.

export type Measure = "angle" | "length" | "number";

export interface Units {
  angles: "deg" | "rad";
  lengths: "mm" | "m";
}

/** The sign beside a number: `°`, `rad`, `mm`, `m`. */
export function unitOf(measure: Measure, units: Units): string {
  if (measure === "angle") return units.angles === "deg" ? "°" : "rad";
  return measure === "length" ? units.lengths : "";
}

/** The unit in words, for a screen reader. */
export function unitWords(measure: Measure, units: Units): string {
  if (measure === "angle") return units.angles === "deg" ? "degrees" : "radians";
  if (measure === "length") return units.lengths === "mm" ? "millimetres" : "metres";
  return "";
}

/** How many of the shown unit one SI unit is. */
export function factor(measure: Measure, units: Units): number {
  if (measure === "angle") return units.angles === "deg" ? 180 / Math.PI : 1;
  return measure === "length" && units.lengths === "mm" ? 1000 : 1;
}

/** Decimals that show about 0.01° and 0.01 mm. */
function decimals(measure: Measure, units: Units): number {
  if (measure === "angle") return units.angles === "deg" ? 2 : 4;
  if (measure === "length") return units.lengths === "mm" ? 2 : 5;
  return 4;
}

/** A number in the unit shown, without the unit; `−` is the minus sign of print. */
export function format(value: number, measure: Measure, units: Units, places = decimals(measure, units)): string {
  return plain(value, measure, units, places).replace("-", "−");
}

/** The same with its unit: `−90.00°`, `450.00 mm`. */
export function formatWithUnit(value: number, measure: Measure, units: Units, places?: number): string {
  const unit = unitOf(measure, units);
  return format(value, measure, units, places) + (unit === "°" || unit === "" ? unit : ` ${unit}`);
}

/** As `format`, with the hyphen that keyboards have: for text that is edited or copied. */
export function plain(value: number, measure: Measure, units: Units, places = decimals(measure, units)): string {
  if (!Number.isFinite(value)) return "";
  const text = (value * factor(measure, units)).toFixed(places);
  return Number(text) === 0 ? text.replace("-", "") : text;
}

/** A number without trailing zeros: `0.25`, `12`. */
export function short(value: number, places = 3): string {
  if (!Number.isFinite(value)) return "∞";
  return String(Number(value.toFixed(places))).replace("-", "−");
}

/** A value as a robot file has it: `12.5 deg`, `-0.3`. */
export function forFile(value: number, measure: Measure, units: Units): string {
  const places = measure === "angle" ? (units.angles === "deg" ? 4 : 6) : units.lengths === "mm" ? 3 : 6;
  const shown = String(Number((value * factor(measure, units)).toFixed(places)));
  if (measure === "angle" && units.angles === "deg") return `${shown} deg`;
  return measure === "length" && units.lengths === "mm" ? `${shown} mm` : shown;
}

/** The steps of the arrow keys: 1° or 1 mm, ten times as much with shift, a tenth with alt. */
export function keyStep(measure: Measure, event: { shiftKey: boolean; altKey: boolean }): number {
  const one = measure === "angle" ? Math.PI / 180 : measure === "length" ? 0.001 : 0.01;
  return event.shiftKey ? one * 10 : event.altKey ? one / 10 : one;
}

export type Parsed = { value: number } | { problem: string };

/**
 * A typed number in SI units: `45`, `45 deg`, `-90°`, `π/2`, `0.3 m`, `3*(2+1) mm`. Without a unit it is in the unit
 * shown, except that an angle with π in it is in radians.
 */
export function parse(text: string, measure: Measure, units: Units): Parsed {
  const tokens = tokenize(text);
  if (!tokens) return { problem: "This is not a number." };
  if (tokens.length === 0) return { problem: "A number is wanted." };
  const parser = new Parser(tokens);
  const result = parser.whole();
  if (!result) return { problem: parser.problem ?? "This is not a number." };
  if (!Number.isFinite(result.value)) return { problem: "This is not a finite number." };
  if (result.measure === measure) return { value: result.value };
  if (result.measure !== "number") return { problem: `This is ${named(result.measure)}; ${named(measure)} is wanted.` };
  if (measure === "angle" && parser.sawPi) return { value: result.value };
  return { value: result.value / factor(measure, units) };
}

function named(measure: Measure): string {
  return measure === "angle" ? "an angle" : measure === "length" ? "a length" : "a plain number";
}

const UNITS: Record<string, { measure: Measure; factor: number }> = {
  deg: { measure: "angle", factor: Math.PI / 180 },
  degree: { measure: "angle", factor: Math.PI / 180 },
  degrees: { measure: "angle", factor: Math.PI / 180 },
  "°": { measure: "angle", factor: Math.PI / 180 },
  rad: { measure: "angle", factor: 1 },
  mrad: { measure: "angle", factor: 0.001 },
  m: { measure: "length", factor: 1 },
  cm: { measure: "length", factor: 0.01 },
  mm: { measure: "length", factor: 0.001 },
  in: { measure: "length", factor: 0.0254 },
};

function tokenize(text: string): string[] | null {
  // A comma between two digits is the decimal sign of half the world.
  const plainText = text.trim().replace(/[−–]/g, "-").replace(/(\d),(\d)/g, "$1.$2").replace(/[·×]/g, "*");
  const pattern = /\s*(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?|[A-Za-zπ°√]+?(?![A-Za-z])|[-+*/()^])/uy;
  const tokens: string[] = [];
  while (pattern.lastIndex < plainText.length) {
    const match = pattern.exec(plainText);
    if (!match?.[1]) return null;
    tokens.push(match[1]);
  }
  return tokens.length <= 200 ? tokens : null;
}

interface Quantity {
  value: number;
  measure: Measure;
}

/** sum = product (± product)*; product = signed (*|/ signed)*; signed = ± power; power = atom unit? (^ signed)? */
class Parser {
  sawPi = false;
  problem: string | undefined;
  #tokens: string[];
  #at = 0;
  #depth = 0;

  constructor(tokens: string[]) {
    this.#tokens = tokens;
  }

  whole(): Quantity | null {
    const value = this.#sum();
    return value && this.#at === this.#tokens.length ? value : null;
  }

  #take(...wanted: string[]): string | null {
    const token = this.#tokens[this.#at];
    if (token === undefined || !wanted.includes(token)) return null;
    this.#at += 1;
    return token;
  }

  #sum(): Quantity | null {
    let left = this.#product();
    for (let sign = this.#take("+", "-"); left && sign; sign = this.#take("+", "-")) {
      const right = this.#product();
      if (!right) return null;
      if (left.measure !== right.measure) {
        this.problem = `${capital(named(left.measure))} and ${named(right.measure)} cannot be added.`;
        return null;
      }
      left = { value: sign === "+" ? left.value + right.value : left.value - right.value, measure: left.measure };
    }
    return left;
  }

  #product(): Quantity | null {
    let left = this.#signed();
    for (let sign = this.#take("*", "/"); left && sign; sign = this.#take("*", "/")) {
      // In `π/2 rad` the unit belongs to the quotient.
      const right: Quantity | null = this.#signed(sign === "/");
      if (!right) return null;
      if (right.measure !== "number" && (sign === "/" || left.measure !== "number")) return null;
      left = {
        value: sign === "*" ? left.value * right.value : left.value / right.value,
        measure: left.measure === "number" ? right.measure : left.measure,
      };
      left = this.#unit(left);
    }
    return left;
  }

  #signed(bare = false): Quantity | null {
    if (++this.#depth > 100) return null;
    const sign = this.#take("+", "-");
    const value = sign ? this.#signed(bare) : this.#power(bare);
    this.#depth -= 1;
    return value && sign === "-" ? { ...value, value: -value.value } : value;
  }

  #power(bare: boolean): Quantity | null {
    const base = this.#atom();
    if (!base) return null;
    if (this.#take("^")) {
      const exponent = this.#signed();
      if (!exponent || base.measure !== "number" || exponent.measure !== "number") return null;
      return { value: base.value ** exponent.value, measure: "number" };
    }
    return bare ? base : this.#unit(base);
  }

  #atom(): Quantity | null {
    const token = this.#tokens[this.#at];
    if (token === undefined) return null;
    this.#at += 1;
    if (/^[\d.]/.test(token)) {
      const value = Number(token);
      // `2π` and `2 pi`
      return this.#take("π", "pi") ? this.#pi(value) : { value, measure: "number" };
    }
    if (token === "π" || token.toLowerCase() === "pi") return this.#pi(1);
    if (token === "√" || token === "sqrt") {
      const inner = this.#atom();
      return inner?.measure === "number" ? { value: Math.sqrt(inner.value), measure: "number" } : null;
    }
    if (token !== "(") return null;
    if (++this.#depth > 100) return null;
    const inner = this.#sum();
    this.#depth -= 1;
    return inner && this.#take(")") ? inner : null;
  }

  #pi(times: number): Quantity {
    this.sawPi = true;
    return { value: times * Math.PI, measure: "number" };
  }

  #unit(of: Quantity): Quantity {
    const token = this.#tokens[this.#at];
    const unit = token !== undefined && of.measure === "number" ? UNITS[token] : undefined;
    if (!unit || !Object.hasOwn(UNITS, token)) return of;
    this.#at += 1;
    return { value: of.value * unit.factor, measure: unit.measure };
  }
}

function capital(words: string): string {
  return words.charAt(0).toUpperCase() + words.slice(1);
}

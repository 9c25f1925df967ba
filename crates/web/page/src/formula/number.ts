// Numbers beside formulas: always as wide as the next.

/** Seven characters at most: `−12.346`, `0.00012`, `1.2e−7`. */
export function short(x: number | null | undefined): string {
  if (x === null || x === undefined || Number.isNaN(x)) return "–";
  if (!Number.isFinite(x)) return x > 0 ? "∞" : "−∞";
  const size = Math.abs(x);
  // What rounding leaves of a zero.
  if (size < 1e-12) return "0.0000";
  if (size >= 1e5 || size < 1e-3) return signed(x.toExponential(1).replace("e+", "e"));
  return signed(x.toFixed(size >= 1000 ? 1 : size >= 100 ? 2 : size >= 10 ? 3 : 4));
}

/** A hyphen is no minus. */
export function signed(text: string): string {
  return text.replaceAll("-", "−");
}

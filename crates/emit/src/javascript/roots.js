@ head

/**
 * The roots of an equation in one unknown: cosine and sine of an angle, or a number alone.
 *
 * @typedef {object} Roots
 * @property {number} count
 * @property {number} isFree 1 if nothing determines the unknown: one value stands for all
 * @property {number[]} multiplicity
 * @property {number[]} x
 * @property {number[]} y
 */

/** A guard that is this small, times the size to its power, has vanished. */
const GUARD = 2.842170943040401e-14;

/**
 * @param {number} guard
 * @param {number} divisor
 * @param {number} scale
 */
function vanishes(guard, divisor, scale) {
  return Math.abs(guard) <= GUARD * scale || divisor === 0;
}

/**
 * @param {number[]} x
 * @param {number[]} y
 * @returns {Roots}
 */
function roots(x, y) {
  return { count: x.length, isFree: 0, multiplicity: x.map(() => 1), x, y };
}
@ free

/**
 * @param {number} x
 * @returns {Roots}
 */
function freeRoot(x) {
  return { count: 1, isFree: 1, multiplicity: [1], x: [x], y: [0] };
}
@ clamp

/** A discriminant below 0 by less than this, times its terms, is 0: the residual decides. */
const CLAMP = 1e-6;
@ ratio

/**
 * denominator r = numerator.
 *
 * @param {number} numerator
 * @param {number} denominator
 * @param {number} guard
 * @param {number} scale
 */
function ratioRoots(numerator, denominator, guard, scale) {
  if (vanishes(guard, denominator, scale)) {
    return freeRoot(0);
  }
  return roots([numerator / denominator], [0]);
}
@ direction

/**
 * The angle of (x, y), or of (-x, -y) if the sign is negative.
 *
 * @param {number} x
 * @param {number} y
 * @param {number} sign
 * @param {number} guard
 * @param {number} scale
 */
function directionRoots(x, y, sign, guard, scale) {
  const length = Math.sqrt(x * x + y * y);
  if (vanishes(guard, length, scale)) {
    return freeRoot(1);
  }
  const divisor = sign < 0 ? -length : length;
  return roots([x / divisor], [y / divisor]);
}
@ line

/**
 * x sin = y cos: the angle of (x, y) and the opposite one.
 *
 * @param {number} x
 * @param {number} y
 * @param {number} guard
 * @param {number} scale
 */
function lineRoots(x, y, guard, scale) {
  const length = Math.sqrt(x * x + y * y);
  if (vanishes(guard, length, scale)) {
    return freeRoot(1);
  }
  return roots([x / length, -x / length], [y / length, -y / length]);
}
@ length

/**
 * r r = x x + y y.
 *
 * @param {number} x
 * @param {number} y
 * @param {number} guard
 * @param {number} scale
 */
function lengthRoots(x, y, guard, scale) {
  const r = Math.sqrt(x * x + y * y);
  if (vanishes(guard, r, scale)) {
    return { ...roots([r], [0]), multiplicity: [2] };
  }
  return roots([r, -r], [0, 0]);
}
@ sincos

/**
 * a cos + b sin = c, of the discriminant d = a a + b b - c c.
 *
 * @param {number} a
 * @param {number} b
 * @param {number} c
 * @param {number} d
 * @param {number} guard
 * @param {number} scale
 */
function sincosRoots(a, b, c, d, guard, scale) {
  const n = a * a + b * b;
  if (vanishes(guard, n, scale)) {
    return Math.abs(c) <= 1e-9 * scale ? freeRoot(1) : roots([], []);
  }
  if (d > 0) {
    const r = Math.sqrt(d);
    return roots(
      [(a * c - b * r) / n, (a * c + b * r) / n],
      [(b * c + a * r) / n, (b * c - a * r) / n],
    );
  }
  if (d >= -CLAMP * (n + c * c)) {
    // The nearest there is.
    const length = c < 0 ? -Math.sqrt(n) : Math.sqrt(n);
    return { ...roots([a / length], [b / length]), multiplicity: [2] };
  }
  return roots([], []);
}
@ quadratic

/**
 * a r r + 2 b r + c = 0.
 *
 * @param {number} a
 * @param {number} b
 * @param {number} c
 * @param {number} guard
 * @param {number} scale
 */
function quadraticRoots(a, b, c, guard, scale) {
  if (vanishes(guard, a, scale)) {
    if (Math.abs(b) > GUARD * scale) {
      return roots([-c / (2 * b)], [0]);
    }
    return Math.abs(c) <= 1e-9 * scale ? freeRoot(0) : roots([], []);
  }
  const d = b * b - a * c;
  if (d > 0) {
    // b and the root have the same sign in q: nothing cancels.
    const q = b < 0 ? Math.sqrt(d) - b : -Math.sqrt(d) - b;
    return roots(b < 0 ? [q / a, c / q] : [c / q, q / a], [0, 0]);
  }
  if (d >= -CLAMP * (b * b + Math.abs(a * c))) {
    return { ...roots([-b / a], [0]), multiplicity: [2] };
  }
  return roots([], []);
}
@ quartic

/**
 * The value of a polynomial.
 *
 * @param {number[]} p
 * @param {number} x
 */
function polynomial(p, x) {
  return p.reduceRight((value, coefficient) => value * x + coefficient, 0);
}

/**
 * The root of a polynomial between two places of different sign: Newton's steps, or halves.
 *
 * @param {number[]} p
 * @param {number} low
 * @param {number} high
 */
function rootBetween(p, low, high) {
  const rises = polynomial(p, low) < 0;
  let x = 0.5 * (low + high);
  let step = high - low;
  for (let i = 0; i < 100 && step !== 0; i++) {
    let value = 0;
    let slope = 0;
    for (let j = p.length - 1; j >= 0; j--) {
      slope = slope * x + value;
      value = value * x + p[j];
    }
    if (value < 0 === rises) {
      low = x;
    } else {
      high = x;
    }
    let next = x - value / slope;
    if (!(next > low && next < high && Math.abs(next - x) <= 0.5 * Math.abs(step))) {
      next = 0.5 * (low + high);
    }
    step = next - x;
    x = next;
  }
  return x;
}

/**
 * f = cc cos cos + cs cos sin + c cos + s sin + one = 0.
 *
 * A quartic in t = tan(u / 2), where u is measured from the direction opposite to that in which f
 * is largest of eight: its leading coefficient is not small. The roots of each derivative separate
 * those of the one before. Where f touches 0 without changing its sign, two roots come together.
 *
 * @param {number} cc
 * @param {number} cs
 * @param {number} c
 * @param {number} s
 * @param {number} one
 * @param {number} guard
 * @param {number} scale
 */
function quarticRoots(cc, cs, c, s, one, guard, scale) {
  const sizes = [cc, cs, c, s, one].map(Math.abs);
  const largest = Math.max(...sizes);
  if (vanishes(Math.min(Math.abs(guard), largest), largest, scale)) {
    return freeRoot(1);
  }
  const f = (/** @type {number} */ x, /** @type {number} */ y) =>
    cc * x * x + cs * x * y + c * x + s * y + one;
  let [lead, x0, y0] = [0, 1, 0];
  for (let k = 0; k < 8; k++) {
    const [x, y] = [Math.cos((k * Math.PI) / 4), Math.sin((k * Math.PI) / 4)];
    if (Math.abs(f(x, y)) > Math.abs(lead)) {
      [lead, x0, y0] = [f(x, y), -x, -y];
    }
  }

  // The coefficients for u, then those of t and of the derivatives.
  const even = cc * (x0 * x0 - y0 * y0) + 2 * cs * x0 * y0;
  const mixed = cs * (x0 * x0 - y0 * y0) - 2 * cc * x0 * y0;
  const along = c * x0 + s * y0;
  const across = s * x0 - c * y0;
  const rest = one + cc * y0 * y0 - cs * x0 * y0;
  const p = [
    [
      (even + along + rest) / lead,
      (2 * (across + mixed)) / lead,
      (2 * (rest - even)) / lead,
      (2 * (across - mixed)) / lead,
      1,
    ],
  ];
  while (p[0].length > 2) {
    p.unshift(p[0].slice(1).map((coefficient, j) => (j + 1) * coefficient));
  }
  const bound = p[3].reduce((sum, coefficient) => sum + Math.abs(coefficient), 0);

  // Where a derivative has no root between two places, the second place stands for it.
  const sum = sizes.reduce((a, b) => a + b, 0);
  let ends = [-bound, bound];
  let isRoot = [false, false];
  const found = [];
  for (const own of p) {
    const last = own === p[3];
    const next = [-bound];
    const isNext = [false];
    const heights = ends.map((t) => polynomial(own, t));
    const isBelow = heights.map((height) => height < 0);
    for (let k = 1; last && k < 4; k++) {
      // An extremum at the height of rounding is on the side of its neighbours.
      const u = 1 + ends[k] * ends[k];
      const isRounding = isRoot[k] && Math.abs(heights[k] * lead) <= 3.6e-15 * sum * u * u;
      if (isRounding && isBelow[k - 1] === isBelow[k + 1]) {
        isBelow[k] = isBelow[k - 1];
      }
    }
    for (let k = 0; k + 1 < ends.length; k++) {
      const changes = isBelow[k] !== isBelow[k + 1];
      const place = changes ? rootBetween(own, ends[k], ends[k + 1]) : ends[k + 1];
      // An extremum, with no change of sign on either side.
      const isExtremum = last && isRoot[k] && !isNext[k] && !changes;
      const u = 1 + ends[k] * ends[k];
      const isNear = Math.abs(heights[k] * lead) <= CLAMP * sum * u * u;
      const bend = polynomial(p[1], ends[k]);
      if (isExtremum && isNear && (isBelow[k] ? bend <= 0 : bend >= 0)) {
        found.push({ t: ends[k], times: 2, x: 0, y: 0, order: 0 });
      } else if (last && changes) {
        found.push({ t: place, times: 1, x: 0, y: 0, order: 0 });
      }
      next.push(place);
      isNext.push(changes);
    }
    next.push(bound);
    isNext.push(false);
    [ends, isRoot] = [next, isNext];
  }

  for (const root of found) {
    const { t } = root;
    const u = 1 + t * t;
    let x = (x0 * (1 - t * t) - 2 * y0 * t) / u;
    let y = (y0 * (1 - t * t) + 2 * x0 * t) / u;
    for (let i = 0; i < 2; i++) {
      const slope = cs * (x * x - y * y) - 2 * cc * x * y - c * y + s * x;
      const step = f(x, y) / slope;
      if (Math.abs(step) <= 1e-8) {
        [x, y] = [x + y * step, y - x * step];
      }
    }
    const length = Math.sqrt(x * x + y * y);
    root.x = x / length;
    root.y = y / length;
    // 1 - cos grows with the angle above the axis, cos - 1 below.
    root.order = root.y < 0 ? root.x - 1 : 1 - root.x;
  }
  found.sort((a, b) => a.order - b.order);
  return {
    ...roots(
      found.map((root) => root.x),
      found.map((root) => root.y),
    ),
    multiplicity: found.map((root) => root.times),
  };
}
@ keep

/**
 * Adds a solution, or its multiplicity to an equal one.
 *
 * @param {@T@[]} solutions
 * @param {@T@} found
 */
function @keep@(solutions, found) {
  const isAngle = [@angles@];
  const turn = 2 * Math.PI;
  const x = found.@result@;
  if (!x.every((value) => Number.isFinite(value))) {
    return;
  }
  const isSame = (/** @type {@T@} */ known) =>
    known.@result@.every((value, k) => {
      const apart = value - x[k];
      return Math.abs(isAngle[k] ? apart - turn * Math.round(apart / turn) : apart) <= 2e-7;
    });
  const same = solutions.find(isSame);
  if (same) {
    same.multiplicity += found.multiplicity;
  } else {
    solutions.push(found);
  }
}

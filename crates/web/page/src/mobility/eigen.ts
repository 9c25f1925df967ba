// Eigenvalues and eigenvectors of small symmetric matrices, by Jacobi's rotations (Golub and Van Loan, 8.5).

/** Ascending, each with its vector of length 1. */
export function eigen(matrix: number[][]): { value: number; vector: number[] }[] {
  const n = matrix.length;
  const a = matrix.map((row) => [...row]);
  const v = a.map((_, i) => a.map((__, k) => (i === k ? 1 : 0)));
  const size = Math.max(1e-300, ...a.flat().map(Math.abs));
  for (let sweep = 0; sweep < 40; sweep++) {
    let off = 0;
    for (let p = 0; p < n; p++) for (let q = p + 1; q < n; q++) off = Math.max(off, Math.abs(a[p][q]));
    if (off < 1e-15 * size) break;
    for (let p = 0; p < n; p++) {
      for (let q = p + 1; q < n; q++) {
        if (a[p][q] === 0) continue;
        const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const t = Math.sign(theta || 1) / (Math.abs(theta) + Math.sqrt(theta * theta + 1));
        const c = 1 / Math.sqrt(t * t + 1);
        rotate(a, v, p, q, c, t * c);
      }
    }
  }
  const found = a.map((_, k) => ({ value: a[k][k], vector: v.map((row) => row[k]) }));
  return found.sort((one, other) => one.value - other.value);
}

/** a ← Gᵀ a G, v ← v G with a rotation in the plane of p and q. */
function rotate(a: number[][], v: number[][], p: number, q: number, c: number, s: number): void {
  for (const of of [a, v]) for (const row of of) [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
  for (let k = 0; k < a.length; k++) [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
}

/** M Mᵀ */
export function gram(rows: number[][]): number[][] {
  return rows.map((x) => rows.map((y) => x.reduce((sum, value, k) => sum + value * y[k], 0)));
}

export function transposed(rows: number[][]): number[][] {
  return rows[0]?.map((_, k) => rows.map((row) => row[k])) ?? [];
}

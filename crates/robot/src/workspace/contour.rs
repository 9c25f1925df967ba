//! Lines of equal value on a grid: marching squares (Lorensen and Cline 1987, in the plane).

/// Values at the points (i, j) of a grid, row by row, i first; beyond its edges is one value.
#[derive(Clone, Copy, Debug)]
pub struct Field<'a> {
    /// The values.
    pub values: &'a [f64],
    /// How many points a row has.
    pub columns: usize,
    /// The value everywhere else.
    pub outside: f64,
}

impl Field<'_> {
    fn rows(&self) -> usize {
        self.values.len().checked_div(self.columns).unwrap_or(0)
    }

    /// The value at a point of the grid with a frame of one point around it.
    fn framed(&self, i: usize, j: usize) -> f64 {
        if i == 0 || j == 0 || i > self.columns || j > self.rows() {
            return self.outside;
        }
        self.values[(j - 1) * self.columns + i - 1]
    }
}

/// What surrounds the values above `level`: closed lines in coordinates of the grid, what is above on their left
/// (counter-clockwise around, clockwise in holes, where j is upwards).
pub fn contours(field: &Field<'_>, level: f64) -> Vec<Vec<[f64; 2]>> {
    const NONE: u32 = u32::MAX;
    let (wide, high) = (field.columns + 2, field.rows() + 2);
    // An edge to the right of a point and one above it: where the line goes next from each.
    let mut next = vec![NONE; 2 * wide * high];
    let mut starts = vec![];
    for j in 0..high - 1 {
        for i in 0..wide - 1 {
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let value = corners.map(|(i, j)| field.framed(i, j));
            let above = value.map(|v| v > level);
            let case = above.iter().enumerate().map(|(k, &a)| usize::from(a) << k).sum::<usize>();
            let [bottom, right, top, left] = [
                2 * (j * wide + i),
                2 * (j * wide + i + 1) + 1,
                2 * ((j + 1) * wide + i),
                2 * (j * wide + i) + 1,
            ];
            // A saddle is joined where the middle is above.
            let is_joined = value.iter().sum::<f64>() / 4.0 > level;
            let lines: &[(usize, usize)] = match (case, is_joined) {
                (1, _) => &[(bottom, left)],
                (2, _) => &[(right, bottom)],
                (3, _) => &[(right, left)],
                (4, _) => &[(top, right)],
                (5, false) => &[(bottom, left), (top, right)],
                (5, true) => &[(bottom, right), (top, left)],
                (6, _) => &[(top, bottom)],
                (7, _) => &[(top, left)],
                (8, _) => &[(left, top)],
                (9, _) => &[(bottom, top)],
                (10, false) => &[(right, bottom), (left, top)],
                (10, true) => &[(left, bottom), (right, top)],
                (11, _) => &[(right, top)],
                (12, _) => &[(left, right)],
                (13, _) => &[(bottom, right)],
                (14, _) => &[(left, bottom)],
                _ => &[],
            };
            for &(from, to) in lines {
                next[from] = u32::try_from(to).unwrap_or(NONE);
                starts.push(from);
            }
        }
    }
    let mut all = vec![];
    for start in starts {
        let mut line = vec![];
        let mut edge = start;
        while next[edge] != NONE {
            line.push(crossing(field, wide, edge, level));
            let to = next[edge] as usize;
            next[edge] = NONE;
            edge = to;
        }
        if line.len() > 2 {
            all.push(line);
        }
    }
    all
}

/// Where the line crosses an edge, in coordinates of the grid without its frame.
fn crossing(field: &Field<'_>, wide: usize, edge: usize, level: f64) -> [f64; 2] {
    let (i, j) = (edge / 2 % wide, edge / 2 / wide);
    let is_upward = edge % 2 == 1;
    let a = field.framed(i, j);
    let b = if is_upward { field.framed(i, j + 1) } else { field.framed(i + 1, j) };
    let t = ((level - a) / (b - a)).clamp(0.0, 1.0);
    let (x, y) = (i as f64 - 1.0, j as f64 - 1.0);
    if is_upward { [x, y + t] } else { [x + t, y] }
}

/// The area that a closed line surrounds, positive where it runs counter-clockwise.
pub fn area(line: &[[f64; 2]]) -> f64 {
    let following = line.iter().skip(1).chain(line.first());
    line.iter().zip(following).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>() / 2.0
}

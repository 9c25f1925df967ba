
#[test]
fn @f@_agrees() {
    for (v, variables) in @F@_VARIABLES.iter().enumerate() {
@parameters@
        let one = @f@(variables@argument@);
        // The same in every VECTORS-th lane, between the other configurations.
        let lane = |i: usize, j: usize| @F@_VARIABLES[(v + i) % @F@_VARIABLES.len()][j];
        let q: [[f64; LANES]; @n@] = from_fn(|j| from_fn(|i| lane(i, j)));
        let mut block = [[f64::NAN; LANES]; @m@];
        @f@_block(&q@argument@, &mut block);
        for (k, value) in one@flat@.iter().enumerate() {
            let (expected, scale) = (@F@_RESULTS[v][k], @F@_SCALES[k]);
            assert!(
                (value - expected).abs() <= UNITS * f64::EPSILON * scale,
                "configuration {v}, result {k}: {value}, expected {expected}"
            );
            for i in (0..LANES).step_by(@F@_VARIABLES.len()) {
                assert!(same(block[k][i], *value), "configuration {v}, result {k}, lane {i}");
            }
        }
    }
}

/// Beyond the range of the routines without branches.
#[test]
fn @f@_holds_for_every_angle() {
    let v = 0;
@parameters@
    for x in [1e7, -1e15, f64::MAX, f64::INFINITY, f64::NAN] {
        let mut q: [[f64; LANES]; @n@] = from_fn(|j| [@F@_VARIABLES[v][j]; LANES]);
        q.iter_mut().for_each(|row| row[1] = x);
        let mut block = [[0.0; LANES]; @m@];
        @f@_block(&q@argument@, &mut block);
        let one = @f@(&[x; @n@]@argument@);
        for (k, value) in one@flat@.iter().enumerate() {
            assert!(same(block[k][1], *value), "{x}, result {k}");
        }
    }
}

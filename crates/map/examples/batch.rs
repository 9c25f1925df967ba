//! A robot's functions over a record batch of Arrow: `cargo run -p denavit-map --example batch`.

use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use denavit_map::{Frame, Mapping, Request};
use std::error::Error;
use std::sync::Arc;

fn main() -> Result<(), Box<dyn Error>> {
    let joints = (1..=6).map(|k| {
        let values: Vec<f64> = (0..5).map(|row| 0.1 * f64::from(k * row)).collect();
        (format!("q{k}"), Arc::new(Float64Array::from(values)) as ArrayRef)
    });
    let batch = RecordBatch::try_from_iter(joints.collect::<Vec<_>>())?;
    let description = denavit::catalogue::robot("ur5").ok_or("a robot of the catalogue")?;
    let request =
        Request { poses: vec![Frame::tool()], orientation: "rotation-vector".parse()?, ..Request::default() };
    let bound = Mapping::new(&description, &request)?.bind(&batch.schema())?;
    let (poses, counts) = bound.run(&batch)?;
    let z = poses.column_by_name("z").ok_or("a column")?.as_primitive::<Float64Type>();
    println!(
        "{} columns, {} rows, {} without a pose: z = {:?}",
        poses.num_columns(),
        counts.rows,
        counts.faults(),
        z.values()
    );
    Ok(())
}

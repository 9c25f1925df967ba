//! Parquet, a row group a part.

use super::broken::unwritable;
use super::pipeline::{Encoded, Encoder, Sink};
use super::temporary::Temporary;
use super::{Compression, Job};
use crate::{Counts, MapError};
use arrow_array::RecordBatch;
use arrow_schema::{DataType, Schema, SchemaRef};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_writer::{ArrowRowGroupWriterFactory, compute_leaves};
use parquet::basic::{Compression as Codec, GzipLevel};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::ColumnPath;
use std::fs::File;
use std::io::BufWriter;
use std::path::PathBuf;
use std::sync::Arc;

/// A file of Parquet that is written.
pub struct Writing {
    path: PathBuf,
    temporary: Temporary,
    file: File,
    writer: SerializedFileWriter<BufWriter<File>>,
    factory: Arc<ArrowRowGroupWriterFactory>,
    schema: SchemaRef,
}

/// How columns are written: numbers that repeat are rare among those that are measured or computed.
pub fn properties(schema: &Schema, compression: Compression) -> WriterProperties {
    let codec = match compression {
        Compression::Snappy => Codec::SNAPPY,
        Compression::Gzip => Codec::GZIP(GzipLevel::default()),
        Compression::None => Codec::UNCOMPRESSED,
    };
    // In Arrow's own description of the schema, too, which others do not read.
    let said = schema.metadata().iter().filter(|(key, _)| key.starts_with("denavit."));
    let mut said: Vec<KeyValue> = said.map(|(key, text)| KeyValue::new(key.clone(), text.clone())).collect();
    said.sort_by(|a, b| a.key.cmp(&b.key));
    let mut properties = WriterProperties::builder()
        .set_key_value_metadata(Some(said))
        .set_compression(codec)
        .set_max_row_group_row_count(None)
        .set_created_by(format!("denavit {}", env!("CARGO_PKG_VERSION")));
    for field in schema.fields().iter().filter(|f| f.data_type() == &DataType::Float64) {
        properties =
            properties.set_column_dictionary_enabled(ColumnPath::new(vec![field.name().clone()]), false);
    }
    properties.build()
}

impl Writing {
    /// Begins a file.
    ///
    /// # Errors
    /// If it cannot be made.
    pub fn new(job: &Job, schema: &SchemaRef) -> Result<Self, MapError> {
        let path = job.output.clone();
        let (temporary, file) = Temporary::new(&path)?;
        let own = file.try_clone().map_err(|why| unwritable(&path, &why))?;
        let (writer, factory) = begin(own, schema, job.compression).map_err(|why| unwritable(&path, &why))?;
        Ok(Writing { path, temporary, file, writer, factory: Arc::new(factory), schema: schema.clone() })
    }
}

/// Begins a file of this schema.
pub fn begin(
    file: File,
    schema: &SchemaRef,
    compression: Compression,
) -> parquet::errors::Result<(SerializedFileWriter<BufWriter<File>>, ArrowRowGroupWriterFactory)> {
    let properties = properties(schema, compression);
    let file = BufWriter::with_capacity(1 << 20, file);
    ArrowWriter::try_new(file, schema.clone(), Some(properties))?.into_serialized_writer()
}

impl Sink for Writing {
    fn encoder(&self) -> Arc<Encoder> {
        let (factory, schema, path) = (self.factory.clone(), self.schema.clone(), self.path.clone());
        Arc::new(move |_, batch: &RecordBatch, _: &Counts| {
            let encode = || -> parquet::errors::Result<_> {
                let mut writers = factory.create_column_writers(0)?.into_iter();
                let mut chunks = vec![];
                for (field, column) in schema.fields().iter().zip(batch.columns()) {
                    for leaf in compute_leaves(field, column)? {
                        let Some(mut writer) = writers.next() else { continue };
                        writer.write(&leaf)?;
                        chunks.push(writer.close()?);
                    }
                }
                Ok(Encoded::RowGroup(chunks))
            };
            encode().map_err(|why| unwritable(&path, &why))
        })
    }

    fn write(&mut self, part: Encoded) -> Result<(), MapError> {
        let Encoded::RowGroup(chunks) = part else { return Ok(()) };
        let write = || -> parquet::errors::Result<()> {
            let mut group = self.writer.next_row_group()?;
            for chunk in chunks {
                chunk.append_to_row_group(&mut group)?;
            }
            group.close().map(drop)
        };
        write().map_err(|why| unwritable(&self.path, &why))
    }

    fn finish(self: Box<Self>) -> Result<(), MapError> {
        self.writer.close().map_err(|why| unwritable(&self.path, &why))?;
        self.temporary.keep(&self.file)
    }
}

//! A file that several threads read, each where it wants.

use bytes::Bytes;
use parquet::errors::{ParquetError, Result};
use parquet::file::reader::{ChunkReader, Length};
use std::fs::File;
use std::io::{self, BufReader, Read};
use std::sync::Arc;

/// A file without a place of its own.
#[derive(Clone)]
pub struct At {
    file: Arc<File>,
    length: u64,
}

/// Reads on from a place.
pub struct From {
    at: At,
    place: u64,
}

impl At {
    /// A file as long as it is now.
    pub fn new(file: File) -> io::Result<Self> {
        let length = file.metadata()?.len();
        Ok(At { file: Arc::new(file), length })
    }

    /// How many bytes it has.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// The bytes from a place on, as many as there are at once.
    pub fn read_at(&self, into: &mut [u8], place: u64) -> io::Result<usize> {
        #[cfg(unix)]
        return std::os::unix::fs::FileExt::read_at(&*self.file, into, place);
        #[cfg(windows)]
        return std::os::windows::fs::FileExt::seek_read(&*self.file, into, place);
    }

    /// Just these bytes.
    pub fn exactly(&self, place: u64, length: usize) -> io::Result<Vec<u8>> {
        if place.checked_add(length as u64).is_none_or(|end| end > self.length) {
            return Err(io::Error::new(io::ErrorKind::UnexpectedEof, "it ends too early"));
        }
        let mut bytes = vec![0; length];
        self.from(place).read_exact(&mut bytes)?;
        Ok(bytes)
    }

    /// Reads on from a place.
    pub fn from(&self, place: u64) -> From {
        From { at: self.clone(), place }
    }
}

impl Read for From {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.at.read_at(into, self.place)?;
        self.place += count as u64;
        Ok(count)
    }
}

impl Length for At {
    fn len(&self) -> u64 {
        self.length
    }
}

impl ChunkReader for At {
    type T = BufReader<From>;

    fn get_read(&self, start: u64) -> Result<Self::T> {
        Ok(BufReader::new(self.from(start)))
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes> {
        let bytes = self.exactly(start, length).map_err(|e| ParquetError::External(Box::new(e)))?;
        Ok(bytes.into())
    }
}

//! The files in a ZIP archive, stored or deflated, as NumPy packs arrays.

use crate::TableError;
use flate2::read::DeflateDecoder;
use std::io::Read;

/// The most bytes that one file may have when it is unpacked.
const MOST: u64 = 2 << 30;

fn u16_at(b: &[u8], at: usize) -> Option<u64> {
    Some(u64::from(u16::from_le_bytes(b.get(at..at.checked_add(2)?)?.try_into().ok()?)))
}

fn u32_at(b: &[u8], at: usize) -> Option<u64> {
    Some(u64::from(u32::from_le_bytes(b.get(at..at.checked_add(4)?)?.try_into().ok()?)))
}

fn u64_at(b: &[u8], at: usize) -> Option<u64> {
    Some(u64::from_le_bytes(b.get(at..at.checked_add(8)?)?.try_into().ok()?))
}

/// The names and contents of the files.
pub fn files(b: &[u8]) -> Result<Vec<(String, Vec<u8>)>, TableError> {
    let broken =
        |what: &str| TableError::new(format!("the archive is broken: {what}"), "was it copied whole?");
    // The end of the central directory stands within the last 64 KiB.
    let from = b.len().saturating_sub((1 << 16) + 22);
    let end = (from..b.len().saturating_sub(21)).rev().find(|&k| b[k..].starts_with(b"PK\x05\x06"));
    let end = end.ok_or_else(|| broken("it has no directory"))?;
    let get =
        |x: Option<u64>| x.and_then(|x| usize::try_from(x).ok()).ok_or_else(|| broken("it ends too early"));
    let (count, mut at) = (get(u16_at(b, end + 10))?, get(u32_at(b, end + 16))?);
    let mut all = vec![];
    let mut unpacked = 0_u64;
    for _ in 0..count {
        if !b.get(at..).is_some_and(|b| b.starts_with(b"PK\x01\x02")) {
            return Err(broken("an entry of its directory is none"));
        }
        let method = get(u16_at(b, at + 10))?;
        let (mut packed, mut size) = (get(u32_at(b, at + 20))? as u64, get(u32_at(b, at + 24))? as u64);
        let lengths = [get(u16_at(b, at + 28))?, get(u16_at(b, at + 30))?, get(u16_at(b, at + 32))?];
        let mut local = get(u32_at(b, at + 42))? as u64;
        let name = b.get(at + 46..at + 46 + lengths[0]).ok_or_else(|| broken("it ends too early"))?;
        // Sizes beyond 32 bits stand in an extra field.
        let (mut extra, extra_end) = (at + 46 + lengths[0], at + 46 + lengths[0] + lengths[1]);
        while extra + 4 <= extra_end {
            let (id, length) = (get(u16_at(b, extra))?, get(u16_at(b, extra + 2))?);
            if id == 1 {
                let mut field = extra + 4;
                for value in [&mut size, &mut packed, &mut local] {
                    if *value == u64::from(u32::MAX) {
                        *value = u64_at(b, field).ok_or_else(|| broken("it ends too early"))?;
                        field += 8;
                    }
                }
            }
            extra += 4 + length;
        }
        let local = get(Some(local))?;
        let at_local = |k: usize| local.checked_add(k).and_then(|at| u16_at(b, at));
        let (name_length, extra_length) = (get(at_local(26))?, get(at_local(28))?);
        let data = local.checked_add(30 + name_length + extra_length);
        let data = data.ok_or_else(|| broken("it ends too early"))?;
        let packed = get(Some(packed))?;
        let name = String::from_utf8_lossy(name).into_owned();
        let part = data.checked_add(packed).and_then(|end| b.get(data..end));
        let part = part.ok_or_else(|| broken(&format!("{name} is cut off")))?;
        unpacked = unpacked.saturating_add(size.max(part.len() as u64));
        if unpacked > MOST {
            return Err(TableError::new(format!("{name} is too large"), "take a part of the file"));
        }
        let content = match method {
            0 => part.to_vec(),
            8 => {
                let mut content = vec![];
                DeflateDecoder::new(part)
                    .take(size.min(MOST))
                    .read_to_end(&mut content)
                    .map_err(|e| broken(&format!("{name}: {e}")))?;
                content
            }
            _ => {
                return Err(TableError::new(
                    format!("{name} is packed in an unknown way"),
                    "numpy.savez and savez_compressed are read",
                ));
            }
        };
        all.push((name, content));
        at += 46 + lengths.iter().sum::<usize>();
    }
    Ok(all)
}

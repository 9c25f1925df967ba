//! Pointers of C as what they point to.

#![allow(unsafe_code)] // what a caller in C has promised of its pointers is believed here

use crate::trouble::Trouble;
use crate::types::Status;
use std::ffi::{CStr, c_char};
use std::{ptr, slice};

fn checked<T>(pointer: *const T, name: &str) -> Result<(), Trouble> {
    let why = match () {
        () if pointer.is_null() => "is null",
        () if !pointer.is_aligned() => "is not aligned",
        () => return Ok(()),
    };
    Err(Trouble::new(Status::BadPointer, format!("{name} {why}")))
}

/// What a pointer points to.
///
/// # Safety
/// It is null, or points to a value that nobody changes while it is read.
pub unsafe fn object<'a, T>(pointer: *const T, name: &str) -> Result<&'a T, Trouble> {
    checked(pointer, name)?;
    Ok(unsafe { &*pointer })
}

/// What a pointer points to, where it is not null.
///
/// # Safety
/// As [`object`].
pub unsafe fn optional<'a, T>(pointer: *const T, name: &str) -> Result<Option<&'a T>, Trouble> {
    if pointer.is_null() { Ok(None) } else { unsafe { object(pointer, name) }.map(Some) }
}

fn bounded<T>(pointer: *const T, length: usize, name: &str) -> Result<(), Trouble> {
    let most = isize::MAX as usize / size_of::<T>().max(1);
    if length > most {
        return Err(Trouble::new(Status::WrongLength, format!("{name} has {length} entries: too many")));
    }
    checked(pointer, name)
}

/// An array that is read.
///
/// # Safety
/// It is null, or points to so many values that nobody changes while they are read.
pub unsafe fn array<'a, T>(pointer: *const T, length: usize, name: &str) -> Result<&'a [T], Trouble> {
    if length == 0 {
        return Ok(&[]);
    }
    bounded(pointer, length, name)?;
    Ok(unsafe { slice::from_raw_parts(pointer, length) })
}

/// An array that is written.
///
/// # Safety
/// It is null, or points to room for so many values that nobody else reads or changes.
pub unsafe fn room<'a, T>(pointer: *mut T, length: usize, name: &str) -> Result<&'a mut [T], Trouble> {
    if length == 0 {
        return Ok(&mut []);
    }
    bounded(pointer, length, name)?;
    Ok(unsafe { slice::from_raw_parts_mut(pointer, length) })
}

/// A place that is written.
pub struct Place<T>(*mut T);

impl<T> Place<T> {
    /// Where a pointer points to.
    pub fn new(pointer: *mut T, name: &str) -> Result<Self, Trouble> {
        checked(pointer, name)?;
        Ok(Place(pointer))
    }

    /// Where a pointer points to; nowhere if it is null.
    pub fn optional(pointer: *mut T, name: &str) -> Result<Option<Self>, Trouble> {
        if pointer.is_null() { Ok(None) } else { Place::new(pointer, name).map(Some) }
    }

    /// Writes there.
    ///
    /// # Safety
    /// There is room for a value.
    pub unsafe fn put(&self, value: T) {
        unsafe { self.0.write(value) }
    }
}

/// Room for values that may be where others were read.
pub struct Room<T> {
    first: *mut T,
    length: usize,
}

impl<T: Copy> Room<T> {
    /// So many places.
    pub fn new(pointer: *mut T, length: usize, name: &str) -> Result<Self, Trouble> {
        if length > 0 {
            bounded(pointer, length, name)?;
        }
        Ok(Room { first: pointer, length })
    }

    /// Fills it.
    ///
    /// # Safety
    /// There is room for so many values, and nothing of it is borrowed any more.
    pub unsafe fn fill(&self, values: &[T], name: &str) -> Result<(), Trouble> {
        if self.length != values.len() {
            return Err(Trouble::length(name, self.length, values.len()));
        }
        if !values.is_empty() {
            unsafe { ptr::copy(values.as_ptr(), self.first, values.len()) }
        }
        Ok(())
    }
}

/// Whether arrays have something in common.
pub fn overlap<A, B>(a: &[A], b: *const B, length: usize) -> bool {
    let (first, last) = (a.as_ptr() as usize, a.as_ptr() as usize + size_of_val(a));
    let (start, end) = (b as usize, (b as usize).saturating_add(length.saturating_mul(size_of::<B>())));
    first < end && start < last
}

/// A text that ends with a zero byte.
///
/// # Safety
/// It is null, or a text with such an end.
pub unsafe fn text<'a>(pointer: *const c_char, name: &str) -> Result<&'a str, Trouble> {
    checked(pointer, name)?;
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|e| Trouble::new(Status::NotText, format!("{name} is no UTF-8: {e}")))
}

/// A text, where the pointer is not null.
///
/// # Safety
/// As [`text`].
pub unsafe fn optional_text<'a>(pointer: *const c_char, name: &str) -> Result<Option<&'a str>, Trouble> {
    if pointer.is_null() { Ok(None) } else { unsafe { text(pointer, name) }.map(Some) }
}

/// Hands an object to C.
///
/// # Safety
/// As [`Place::put`].
pub unsafe fn give<T>(place: &Place<*mut T>, object: T) {
    unsafe { place.put(Box::into_raw(Box::new(object))) }
}

/// Takes an object back, and drops it.
///
/// # Safety
/// It is null, or came from [`give`] and is not used any more.
pub unsafe fn take<T>(pointer: *mut T) {
    if !pointer.is_null() {
        drop(unsafe { Box::from_raw(pointer) });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_overlaps() {
        let a = [0_u64; 4];
        let at = |i: usize| a[i..].as_ptr().cast::<u32>();
        assert!(overlap(&a[1..3], at(0), 3) && overlap(&a[1..3], at(2), 1) && overlap(&a[1..3], at(0), 100));
        assert!(!overlap(&a[1..3], at(0), 2) && !overlap(&a[1..3], at(3), 2) && !overlap(&a[..0], at(0), 2));
    }

    #[test]
    fn pointers_that_are_none() {
        fn status(found: Result<&[f64], Trouble>) -> Result<&[f64], Status> {
            found.map_err(|why| why.status)
        }
        let a = [1.0, 2.0];
        let aside = a.as_ptr().wrapping_byte_add(1);
        unsafe {
            assert_eq!(status(array(ptr::null(), 0, "a")), Ok(&[][..]));
            assert_eq!(status(array(ptr::null(), 1, "a")), Err(Status::BadPointer));
            assert_eq!(status(array(aside, 1, "a")), Err(Status::BadPointer));
            assert_eq!(status(array(a.as_ptr(), usize::MAX / 8, "a")), Err(Status::WrongLength));
            assert_eq!(status(array(a.as_ptr(), 2, "a")), Ok(&a[..]));
        }
    }
}

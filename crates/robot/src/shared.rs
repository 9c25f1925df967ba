//! Working memory of what many threads use at once: each use has one of its own, which the next one takes over.

use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, PoisonError};

/// Copies of something that changes while it is used, and is as good as new afterwards.
#[derive(Debug)]
pub(crate) struct Shared<T> {
    first: T,
    idle: Mutex<Vec<T>>,
}

/// One of the copies; it goes back when it is dropped.
#[derive(Debug)]
pub(crate) struct Lent<'a, T> {
    from: &'a Shared<T>,
    own: Option<T>,
}

impl<T: Clone> Shared<T> {
    /// Copies of `first`.
    pub fn new(first: T) -> Self {
        Shared { first, idle: Mutex::new(vec![]) }
    }

    /// What all copies begin as.
    pub fn first(&self) -> &T {
        &self.first
    }

    /// A copy that nobody else has.
    pub fn lend(&self) -> Lent<'_, T> {
        let idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner).pop();
        Lent { from: self, own: Some(idle.unwrap_or_else(|| self.first.clone())) }
    }
}

impl<T: Clone> Clone for Shared<T> {
    fn clone(&self) -> Self {
        Shared::new(self.first.clone())
    }
}

impl<T> Deref for Lent<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        self.own.as_ref().expect("it is there until it is dropped")
    }
}

impl<T> DerefMut for Lent<'_, T> {
    fn deref_mut(&mut self) -> &mut T {
        self.own.as_mut().expect("it is there until it is dropped")
    }
}

impl<T> Drop for Lent<'_, T> {
    fn drop(&mut self) {
        // What a panic left behind is not used again.
        if let Some(own) = self.own.take()
            && !std::thread::panicking()
        {
            self.from.idle.lock().unwrap_or_else(PoisonError::into_inner).push(own);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_at_once_have_a_copy_each_and_the_next_one_takes_over() {
        let shared = Shared::new(vec![0]);
        {
            let (mut one, mut other) = (shared.lend(), shared.lend());
            one.push(1);
            other.push(2);
            assert_eq!((&*one, &*other), (&vec![0, 1], &vec![0, 2]));
        }
        assert_eq!(shared.lend().len(), 2, "memory is used again");
        let kept = shared.lend();
        assert_eq!((kept.len(), shared.clone().lend().len()), (2, 1), "a clone begins anew");
    }

    #[test]
    fn what_a_panic_left_behind_is_not_used_again() {
        let shared = Shared::new(0);
        let broken = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            *shared.lend() = 1;
            let mut own = shared.lend();
            *own = 2;
            panic!("halfway");
        }));
        assert!(broken.is_err());
        assert_eq!(*shared.lend(), 0);
    }
}

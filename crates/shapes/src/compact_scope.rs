//! Scopes as shapes store them.

use std::cell::RefCell;
use std::sync::Arc;

use glam::{DMat3, DVec3};

use crate::Scope;

/// A scope that shares its axes with other scopes.
///
/// The axes are more than half of a scope, and most parts of a shape have the same ones.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CompactScope {
    pub origin: DVec3,
    pub size: DVec3,
    axes: Arc<DMat3>,
}

impl From<Scope> for CompactScope {
    fn from(scope: Scope) -> Self {
        Self { origin: scope.origin, size: scope.size, axes: share(&scope.axes) }
    }
}

impl CompactScope {
    /// Returns the scope with its own axes.
    #[inline]
    pub(crate) fn get(&self) -> Scope {
        Scope { origin: self.origin, axes: *self.axes, size: self.size }
    }

    /// Returns the part from `from` to `to` (m) along the axis with this index, as [`Scope::slab`] does.
    pub(crate) fn slab(&self, axis: usize, [from, to]: [f64; 2]) -> Self {
        let mut size = self.size;
        size[axis] = to - from;
        Self { origin: self.origin + self.axes.col(axis) * from, size, axes: Arc::clone(&self.axes) }
    }
}

/// Number of axes that a thread remembers; a power of 2.
const REMEMBERED: usize = 64;

/// Returns axes of the same bits: those of an earlier call of this thread, if it remembers them.
fn share(axes: &DMat3) -> Arc<DMat3> {
    thread_local! {
        static AXES: RefCell<[Option<Arc<DMat3>>; REMEMBERED]> = const { RefCell::new([const { None }; REMEMBERED]) };
    }
    let bits = axes.to_cols_array().map(f64::to_bits);
    let mixed = bits
        .iter()
        .fold(0, |mixed: u64, bits| (mixed.rotate_left(7) ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    AXES.with_borrow_mut(|remembered| {
        let place = &mut remembered[(mixed >> 32) as usize % REMEMBERED];
        match place {
            Some(known) if known.to_cols_array().map(f64::to_bits) == bits => Arc::clone(known),
            _ => Arc::clone(place.insert(Arc::new(*axes))),
        }
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn scopes_keep_their_axes_and_share_equal_ones() {
        let scope = |step: u32| Scope {
            origin: DVec3::X * f64::from(step),
            axes: DMat3::from_rotation_z(f64::from(step % 200) / 200.0 * TAU),
            size: DVec3::ONE,
        };
        for step in 0..1000 {
            assert_eq!(CompactScope::from(scope(step)).get(), scope(step));
        }
        let (one, other) = (CompactScope::from(scope(3)), CompactScope::from(scope(3)));
        assert!(Arc::ptr_eq(&one.axes, &other.axes));
        // Axes that differ only by the sign of a zero stay different.
        let negative = Scope { axes: -DMat3::IDENTITY * -1.0, ..Scope::default() };
        let bits = |scope: Scope| scope.axes.to_cols_array().map(f64::to_bits);
        assert_eq!(bits(CompactScope::from(negative).get()), bits(negative));
        assert_eq!(bits(CompactScope::from(Scope::default()).get()), bits(Scope::default()));
    }

    #[test]
    fn a_slab_is_that_of_the_scope() {
        let axes = DMat3::from_rotation_x(0.3);
        let scope = Scope { origin: DVec3::new(1.0, 2.0, 3.0), axes, size: DVec3::new(4.0, 5.0, 6.0) };
        for axis in 0..3 {
            assert_eq!(CompactScope::from(scope).slab(axis, [0.5, 2.0]).get(), scope.slab(axis, [0.5, 2.0]));
        }
    }
}

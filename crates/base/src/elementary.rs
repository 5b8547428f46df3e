//! C's elementary functions for the whole program, such as sine, exponential and power, with equal results on every
//! platform.
//!
//! IEEE 754 fixes the results of `+`, `-`, `*`, `/`, the square root and the remainder, but not of these functions. The
//! C libraries differ in the last bit, and glibc selects an implementation by processor. The crate [`libm`] uses only
//! the fixed operations.
//!
//! The functions have C's names, so the linker prefers them to the system library. This applies to Rust's `f64::sin`,
//! to Luau, to SQLite and to all crates. `libm` itself calls none of them. The compiler may still evaluate a call with
//! a constant argument, with the functions of the computer that it runs on.
#![allow(
    unsafe_code,
    reason = "the linker finds a function by its name only if the name is exported as it is"
)]

/// Defines C functions by functions of `libm`.
macro_rules! define {
    ($($name:ident($($argument:ident),+): $number:ty;)+) => {$(
        #[doc = concat!("C's `", stringify!($name), "`.")]
        // SAFETY: the name, arguments, result and meaning are those of the C function.
        #[unsafe(no_mangle)]
        pub extern "C" fn $name($($argument: $number),+) -> $number {
            libm::$name($($argument),+)
        }
    )+};
}

define! {
    acos(x): f64;
    acosh(x): f64;
    asin(x): f64;
    asinh(x): f64;
    atan(x): f64;
    atan2(y, x): f64;
    atanh(x): f64;
    cbrt(x): f64;
    cos(x): f64;
    cosh(x): f64;
    exp(x): f64;
    exp10(x): f64;
    exp2(x): f64;
    expm1(x): f64;
    hypot(x, y): f64;
    log(x): f64;
    log10(x): f64;
    log1p(x): f64;
    log2(x): f64;
    pow(x, y): f64;
    sin(x): f64;
    sinh(x): f64;
    tan(x): f64;
    tanh(x): f64;
    acosf(x): f32;
    acoshf(x): f32;
    asinf(x): f32;
    asinhf(x): f32;
    atan2f(y, x): f32;
    atanf(x): f32;
    atanhf(x): f32;
    cbrtf(x): f32;
    cosf(x): f32;
    coshf(x): f32;
    exp10f(x): f32;
    exp2f(x): f32;
    expf(x): f32;
    expm1f(x): f32;
    hypotf(x, y): f32;
    log10f(x): f32;
    log1pf(x): f32;
    log2f(x): f32;
    logf(x): f32;
    powf(x, y): f32;
    sinf(x): f32;
    sinhf(x): f32;
    tanf(x): f32;
    tanhf(x): f32;
}

/// Defines a function that computes sine and cosine together. Compilers call it if a program needs both.
macro_rules! define_pair {
    ($($name:ident: $number:ty, $of:path;)+) => {$(
        #[doc = concat!("The `", stringify!($name), "` of glibc and others.")]
        ///
        /// # Safety
        ///
        /// Both pointers must be valid for writes.
        #[cfg(not(target_vendor = "apple"))]
        // SAFETY: the name, arguments and meaning are those of the C function.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(x: $number, sine: *mut $number, cosine: *mut $number) {
            let (of_sine, of_cosine) = $of(x);
            // SAFETY: guaranteed by the caller.
            unsafe {
                sine.write(of_sine);
                cosine.write(of_cosine);
            }
        }
    )+};
}

define_pair! {
    sincos: f64, libm::sincos;
    sincosf: f32, libm::sincosf;
}

/// Sine and cosine in the layout of Apple's compilers.
#[cfg(target_vendor = "apple")]
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct SineCosine {
    /// Sine.
    pub sine: f64,
    /// Cosine.
    pub cosine: f64,
}

/// Computes sine and cosine together, for Apple's compilers.
#[cfg(target_vendor = "apple")]
// SAFETY: the name, arguments and result are those of the function in Apple's library.
#[unsafe(no_mangle)]
pub extern "C" fn __sincos_stret(x: f64) -> SineCosine {
    let (sine, cosine) = libm::sincos(x);
    SineCosine { sine, cosine }
}

#[cfg(test)]
mod tests {
    use std::hint::black_box;

    #[test]
    fn functions_of_rust_are_those_of_the_crate() {
        for step in -2000_i32..2000 {
            let x = black_box(f64::from(step) * 0.013_7);
            let pairs = [
                (x.sin(), libm::sin(x)),
                (x.cos(), libm::cos(x)),
                (x.sin_cos().0, libm::sin(x)),
                (x.sin_cos().1, libm::cos(x)),
                (x.tan(), libm::tan(x)),
                (x.exp(), libm::exp(x)),
                (x.abs().ln(), libm::log(x.abs())),
                (x.abs().powf(1.37), libm::pow(x.abs(), 1.37)),
                (x.atan2(0.7), libm::atan2(x, 0.7)),
                (x.hypot(2.5), libm::hypot(x, 2.5)),
                (x.tanh(), libm::tanh(x)),
                (x.cbrt(), libm::cbrt(x)),
            ];
            for (index, (found, expected)) in pairs.into_iter().enumerate() {
                assert_eq!(found.to_bits(), expected.to_bits(), "function {index} of {x}");
            }
        }
    }
}

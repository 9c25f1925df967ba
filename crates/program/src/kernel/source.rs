//! The text of the routines, for programs that carry them along.

/// Huge angles.
pub const REDUCE: &str = include_str!("reduce.rs");
/// Sine and cosine without fused multiply-add.
pub const SINCOS_STRICT: &str = include_str!("sincos_strict.rs");
/// Sine and cosine with fused multiply-add; needs [`REDUCE`] and [`SINCOS_STRICT`].
pub const SINCOS_FUSED: &str = include_str!("sincos_fused.rs");
/// The angle of a point without fused multiply-add.
pub const ATAN2_STRICT: &str = include_str!("atan2_strict.rs");
/// The angle of a point with fused multiply-add.
pub const ATAN2_FUSED: &str = include_str!("atan2_fused.rs");

//! The statistics that limpid's own results rest on: running moments, Welch's t test, intervals for a
//! mean, and the distributions behind them.
//!
//! None of this panics. A degree of freedom that is not positive, or an argument that is NaN, gives NaN.

mod distribution;
mod interval;
mod skew;
mod welch;
mod welford;

pub use distribution::{
    normal_cdf, normal_quantile, normal_two_sided, student_t_cdf, student_t_quantile, student_t_two_sided,
};
pub use interval::{MeanInterval, mean_interval};
pub use skew::{skew_corrected_p, skew_corrected_t};
pub use welch::{Welch, sidak_level, sidak_p, welch_test};
pub use welford::Welford;

//! What the system says of this process and its machine. `None` where it does not say.

use std::fs;

/// Clock ticks a second in `/proc`: 100 in the interface of every Linux, whatever the kernel counts with.
const TICKS: f64 = 100.0;

/// CPU seconds in user mode of all threads so far, to 10 ms.
pub fn user_seconds() -> Option<f64> {
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // The second field is the program's name in brackets and may hold anything; utime is the 14th.
    let (_, fields) = stat.rsplit_once(')')?;
    let ticks: f64 = fields.split_whitespace().nth(11)?.parse().ok()?;
    Some(ticks / TICKS)
}

/// The most memory that was in use at once, in bytes.
pub fn peak_memory_bytes() -> Option<u64> {
    kilobytes("/proc/self/status", "VmHWM:")
}

/// Memory that can be had without swapping, in bytes.
pub fn available_memory_bytes() -> Option<u64> {
    kilobytes("/proc/meminfo", "MemAvailable:")
}

fn kilobytes(file: &str, key: &str) -> Option<u64> {
    let text = fs::read_to_string(file).ok()?;
    let value = text.lines().find_map(|line| line.strip_prefix(key))?;
    value.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use std::hint::black_box;
    use std::time::{Duration, Instant};

    use super::*;

    #[test]
    fn work_shows_in_the_user_seconds() {
        let before = user_seconds().expect("Linux says");
        let begin = Instant::now();
        while user_seconds().expect("Linux says") == before {
            (0..1_000_000u64).for_each(|i| {
                black_box(i);
            });
            assert!(begin.elapsed() < Duration::from_secs(60), "no user time in a minute of work");
        }
    }

    #[test]
    fn the_peak_holds_what_was_allocated() {
        const SIZE: usize = 200 << 20;
        let block = black_box(vec![1u8; SIZE]);
        assert!(peak_memory_bytes().expect("Linux says") > SIZE as u64);
        assert!(available_memory_bytes().expect("Linux says") > 0);
        drop(block);
    }
}

//! Bars on a terminal; nothing in a pipe.

use std::sync::atomic::Ordering::Relaxed;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use limpid_renderer::Progress;

use crate::cli::Common;

/// Between two looks at a render's progress.
const INTERVAL: Duration = Duration::from_millis(100);

/// Does `work` behind a bar with the time left and the rays a second.
pub fn with_bar<T>(common: &Common, progress: &Progress, work: impl FnOnce() -> T) -> T {
    let bar = ProgressBar::with_draw_target(Some(1), target(common));
    if bar.is_hidden() {
        return work();
    }
    bar.set_style(style("rendering [{bar:30}] {percent}%, {eta} left, {msg}").progress_chars("=> "));
    let (done, wait) = mpsc::channel::<()>();
    thread::scope(|scope| {
        let bar = &bar;
        scope.spawn(move || {
            let begin = Instant::now();
            while let Err(RecvTimeoutError::Timeout) = wait.recv_timeout(INTERVAL) {
                let mrays = progress.rays.load(Relaxed) as f64 / 1e6;
                bar.set_length(progress.total.load(Relaxed).max(1));
                bar.set_position(progress.samples.load(Relaxed));
                bar.set_message(format!("{:.1} Mrays/s", mrays / begin.elapsed().as_secs_f64()));
            }
            bar.finish_and_clear();
        });
        let result = work();
        drop(done);
        result
    })
}

/// Does `work` behind a sign that something is being done.
pub fn with_spinner<T>(common: &Common, what: &'static str, work: impl FnOnce() -> T) -> T {
    let spinner = ProgressBar::with_draw_target(None, target(common));
    if spinner.is_hidden() {
        return work();
    }
    spinner.set_style(style("{spinner} {msg}"));
    spinner.set_message(what);
    spinner.enable_steady_tick(INTERVAL);
    let result = work();
    spinner.finish_and_clear();
    result
}

fn target(common: &Common) -> ProgressDrawTarget {
    if common.quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("our templates are well formed")
}

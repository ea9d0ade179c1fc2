//! Ctrl-C: while a render runs the first one stops it and keeps what is done; any other ends the program at once.

use std::io::{self, IsTerminal, Write};
use std::process;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::{Arc, Mutex, PoisonError};

use limpid_renderer::Progress;

/// The render that the first Ctrl-C stops.
static RENDER: Mutex<Option<Arc<Progress>>> = Mutex::new(None);

/// Takes over Ctrl-C. Files appear under their names whole or not at all, also where the program ends at once.
pub fn install(quiet: bool) {
    // Where the system gives no handler its own stays: it ends the program, too.
    let _ = ctrlc::set_handler(move || {
        let render = RENDER.lock().unwrap_or_else(PoisonError::into_inner);
        match &*render {
            Some(progress) if !progress.cancel.swap(true, Relaxed) => {
                if !quiet {
                    // On a terminal the line has `^C` and the bar on it.
                    let begin = if io::stderr().is_terminal() { "\n" } else { "" };
                    let _ = writeln!(
                        io::stderr(),
                        "{begin}finishing what was begun; Ctrl-C again to keep nothing"
                    );
                }
            }
            _ => {
                let _nothing_begins = limpid_frame::discard_unfinished();
                process::exit(130)
            }
        }
    });
}

/// From now on the first Ctrl-C cancels this render.
pub fn stop_gently(progress: &Arc<Progress>) {
    *RENDER.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(progress));
}

/// Whether Ctrl-C came since then.
pub fn came() -> bool {
    let render = RENDER.lock().unwrap_or_else(PoisonError::into_inner);
    render.as_ref().is_some_and(|progress| progress.cancel.load(Relaxed))
}

//! Ctrl-C, and the system's request to end: the first stops the render, the second the program.

use std::io::{self, IsTerminal};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::console;
use crate::failure::INTERRUPTED;

/// Asks the renderer to stop at the next tile.
static STOP: AtomicBool = AtomicBool::new(false);
/// There is something that a stop would save.
static RENDERING: AtomicBool = AtomicBool::new(false);
/// Held while a file is written, so that the program does not end in its midst.
static FILES: Mutex<()> = Mutex::new(());

/// Installs the handler. Where the system refuses, Ctrl-C ends the program as ever; that is no fault.
pub(crate) fn install() {
    let _ = ctrlc::set_handler(|| {
        if RENDERING.load(Ordering::SeqCst) && !STOP.swap(true, Ordering::SeqCst) {
            // On a terminal, `^C` stands in the bar's line.
            let start = if io::stderr().is_terminal() { "\n" } else { "" };
            console::log(format_args!("{start}stopping at the next tile; once more to end at once"));
            return;
        }
        // A file that is being written becomes whole first; none is begun after it.
        let _files = hold_files();
        process::exit(i32::from(INTERRUPTED));
    });
}

/// From now on the first interrupt only asks the render to stop.
pub(crate) fn rendering_begins() {
    RENDERING.store(true, Ordering::SeqCst);
}

/// What the renderer looks at.
pub(crate) fn stop() -> &'static AtomicBool {
    &STOP
}

/// To be held while a file is written.
pub(crate) fn hold_files() -> MutexGuard<'static, ()> {
    FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

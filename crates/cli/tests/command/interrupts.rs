//! Ctrl-C: once saves, twice ends.

use std::io::{BufRead, BufReader};
use std::process::{Child, ChildStderr};
use std::thread::sleep;
use std::time::Duration;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use crate::scratch::{Ran, Scratch};

/// A render that would take hours; it ends with the test at the latest.
struct LongRender {
    child: Option<Child>,
    log: BufReader<ChildStderr>,
}

impl LongRender {
    /// Starts it, and waits until it is on its way.
    fn start(s: &Scratch) -> LongRender {
        let mut child = s.command("render room.pbrt --spp 4194304 --json").spawn().unwrap();
        let log = BufReader::new(child.stderr.take().unwrap());
        let mut render = LongRender { child: Some(child), log };
        let mut line = String::new();
        render.log.read_line(&mut line).unwrap();
        assert!(line.starts_with("rendering 64 x 48 pixels"), "{line}");
        sleep(Duration::from_millis(300));
        render
    }
    fn interrupt(&self) {
        let id = self.child.as_ref().unwrap().id();
        kill(Pid::from_raw(i32::try_from(id).unwrap()), Signal::SIGINT).unwrap();
    }
    fn wait(&mut self) -> Ran {
        Ran::from(self.child.take().unwrap().wait_with_output().unwrap())
    }
}

impl Drop for LongRender {
    fn drop(&mut self) {
        if let Some(child) = &mut self.child {
            let _ = child.kill().and_then(|()| child.wait());
        }
    }
}

#[test]
fn the_first_saves_what_is_there() {
    let s = Scratch::new();
    let mut render = LongRender::start(&s);
    render.interrupt();
    let ran = render.wait();
    assert_eq!(ran.code, Some(130), "{ran:?}");
    let json = ran.json();
    assert_eq!((&json["status"], &json["exit_code"]), (&"interrupted".into(), &130.into()));
    let stats = &json["stats"];
    let [samples, per_pixel] = ["samples", "samples_per_pixel"].map(|k| stats[k].as_u64().unwrap());
    assert!(samples > 0 && per_pixel * 64 * 48 <= samples, "{stats}");
    assert_eq!(s.files(), ["named.exr", "named.png", "room.pbrt"]);
    let last = (&mut render.log).lines().map_while(Result::ok).last().unwrap();
    assert!(last.contains("as far as it was rendered"), "{last}");
}

#[test]
fn the_second_ends_at_once_and_leaves_whole_files() {
    let s = Scratch::new();
    let mut render = LongRender::start(&s);
    render.interrupt();
    render.interrupt();
    let ran = render.wait();
    assert_eq!(ran.code, Some(130), "{ran:?}");
    let files = s.files();
    assert!(files.iter().all(|f| !f.ends_with(".tmp")), "{files:?}");
    if files.contains(&"named.exr".to_owned()) {
        assert_eq!(sparrow_image::read_exr(&s.path("named.exr")).unwrap().0.width, 64);
    }
}

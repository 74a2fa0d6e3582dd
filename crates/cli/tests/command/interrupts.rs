//! Ctrl-C: once saves, twice ends.

use std::io::{BufRead, BufReader};
use std::process::Child;
use std::thread::sleep;
use std::time::Duration;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use crate::scratch::{Ran, Scratch};

/// Starts a render that would take hours, and waits until it is on its way.
fn long_render(s: &Scratch) -> (Child, BufReader<std::process::ChildStderr>) {
    let mut child = s.command("render room.pbrt --spp 4000000 --json").spawn().unwrap();
    let mut err = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    err.read_line(&mut line).unwrap();
    assert!(line.starts_with("rendering 64 x 48 pixels"), "{line}");
    sleep(Duration::from_millis(300));
    (child, err)
}

fn interrupt(child: &Child) {
    kill(Pid::from_raw(i32::try_from(child.id()).unwrap()), Signal::SIGINT).unwrap();
}

#[test]
fn the_first_saves_what_is_there() {
    let s = Scratch::new();
    let (child, err) = long_render(&s);
    interrupt(&child);
    let ran = Ran::from(child.wait_with_output().unwrap());
    assert_eq!(ran.code, Some(130), "{ran:?}");
    let json = ran.json();
    assert_eq!((&json["status"], &json["exit_code"]), (&"interrupted".into(), &130.into()));
    let stats = &json["stats"];
    let (samples, per_pixel) =
        (stats["samples"].as_u64().unwrap(), stats["samples_per_pixel"].as_u64().unwrap());
    assert!(samples > 0 && per_pixel * 64 * 48 <= samples, "{stats}");
    assert_eq!(s.files(), ["named.exr", "named.png", "room.pbrt"]);
    let last = err.lines().map_while(Result::ok).last().unwrap();
    assert!(last.contains("as far as it was rendered"), "{last}");
}

#[test]
fn the_second_ends_at_once_and_leaves_whole_files() {
    let s = Scratch::new();
    let (child, _err) = long_render(&s);
    interrupt(&child);
    interrupt(&child);
    let ran = Ran::from(child.wait_with_output().unwrap());
    assert_eq!(ran.code, Some(130), "{ran:?}");
    let files = s.files();
    assert!(files.iter().all(|f| !f.ends_with(".tmp")), "{files:?}");
    if files.contains(&"named.exr".to_owned()) {
        assert_eq!(sparrow_image::read_exr(&s.path("named.exr")).unwrap().0.width, 64);
    }
}

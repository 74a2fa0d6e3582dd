//! The command as scripts see it: exit codes, texts, files.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod compare;
mod errors;
mod groom;
mod info;
#[cfg(unix)]
mod interrupts;
mod lecture;
mod models;
mod plot;
mod race;
mod render;
mod scratch;
mod strategies;

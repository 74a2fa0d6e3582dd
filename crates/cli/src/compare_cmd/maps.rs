//! Pictures of differences.

use std::path::{Path, PathBuf};

use sparrow_image::{Encoding, Image, ImageError, Pixels, write_png};
use sparrow_plot::draw::colour_map;

use crate::interrupt;

/// The files of `-o OUT.png`: FLIP, and the relative error.
pub(super) fn names(output: &Path) -> [PathBuf; 2] {
    let mut relative = output.file_stem().unwrap_or_default().to_os_string();
    relative.push("-relative.png");
    [output.to_path_buf(), output.with_file_name(relative)]
}

/// Writes values in 0..1 in the colours of the plots.
///
/// # Errors
/// Where the file cannot be written.
pub(super) fn save(path: &Path, width: usize, values: &[f64]) -> Result<(), ImageError> {
    let height = values.len() / width;
    let codes = values.iter().flat_map(|v| colour_map::rgb(*v)).map(|c| c.round() as u8).collect();
    let channels = ["R", "G", "B"].map(str::to_owned).to_vec();
    let rgb = Image::new(width, height, channels, Pixels::U8(codes), Encoding::Srgb)?.to_rgb();
    let _files = interrupt::hold_files();
    write_png(path, width, height, &rgb)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_share_their_stem() {
        let [flip, relative] = names(Path::new("a/b.c.png"));
        assert_eq!((flip, relative), ("a/b.c.png".into(), "a/b.c-relative.png".into()));
    }
}

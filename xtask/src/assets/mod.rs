//! Images and meshes of our own scenes, made by formula: small, and the same on every machine.

mod cloth;
mod grid;
mod head;
mod helix;
mod herbert;
mod horse;
mod market;
mod spool;
mod textures;
mod vase;

use std::fs;
use std::path::Path;

use sparrow_image::{Encoding, Image, Pixels, write_png};

/// Files of text, by name.
fn texts() -> Vec<(String, String)> {
    let single = [
        ("meshes/cloth.ply", cloth::ply()),
        ("meshes/helix.ply", helix::ply()),
        ("meshes/herbert.ply", herbert::ply()),
        ("meshes/horse.ply", horse::ply()),
        ("meshes/vase.ply", vase::ply()),
        ("lecture/spool.inc", spool::curve()),
    ];
    let market = market::all().into_iter().map(|(name, text)| (format!("meshes/{name}.ply"), text));
    let head = head::all().map(|(name, text)| (format!("meshes/{name}.ply"), text));
    single.map(|(name, text)| (name.to_owned(), text)).into_iter().chain(market).chain(head).collect()
}

/// Writes `textures/*.png`, `meshes/*.ply` and `lecture/spool.inc` into the folder of the scenes.
///
/// # Errors
/// The file that cannot be written, and why.
pub fn write(scenes: &Path) -> Result<String, String> {
    let mut report = Vec::new();
    for folder in ["textures", "meshes", "lecture"] {
        let folder = scenes.join(folder);
        fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    }
    for (name, side, colour) in textures::ALL {
        let path = scenes.join("textures").join(name);
        png(&path, side, colour)?;
        report.push(path);
    }
    for (name, text) in texts() {
        let path = scenes.join(name);
        fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))?;
        report.push(path);
    }
    Ok(report.iter().map(|p| format!("wrote {}", p.display())).collect::<Vec<_>>().join("\n"))
}

/// A colour of a square image at column `x`, row `y` from the top: sRGB codes.
type Colour = fn(x: u32, y: u32) -> [u8; 3];

fn png(path: &Path, side: u32, colour: Colour) -> Result<(), String> {
    let codes = (0..side * side).flat_map(|i| colour(i % side, i / side)).collect();
    let n = side as usize;
    let channels = ["R", "G", "B"].map(str::to_owned).to_vec();
    let image = Image::new(n, n, channels, Pixels::U8(codes), Encoding::Srgb).map_err(|e| e.to_string())?;
    let linear: Vec<[f32; 3]> = (0..n * n).map(|i| image.rgb(i % n, i / n)).collect();
    write_png(path, n, n, &linear).map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What lies in `scenes` is what the command writes.
    #[test]
    fn committed_assets_are_current() {
        let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
        let fresh = std::env::temp_dir().join(format!("xtask-assets-{}", std::process::id()));
        write(&fresh).expect("assets");
        let mut names: Vec<String> = textures::ALL.iter().map(|(n, ..)| format!("textures/{n}")).collect();
        names.extend(texts().into_iter().map(|(name, _)| name));
        for name in names {
            let [old, new] = [scenes.join(&name), fresh.join(&name)].map(|p| fs::read(p).expect("a file"));
            assert!(old == new, "{name} differs; run `cargo run -p xtask -- assets`");
            assert!(new.len() < 100_000, "{name} has {} bytes", new.len());
        }
        fs::remove_dir_all(&fresh).expect("our own folder");
    }
}

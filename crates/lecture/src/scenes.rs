//! The scenes of the lecture, held in the program: [`SCENES`].

/// Files below `scenes/`.
macro_rules! scenes {
    ($($name:literal)*) => {
        &[$(($name, include_bytes!(concat!("../../../scenes/", $name)).as_slice())),*]
    };
}

/// Path below `scenes/` and contents of each file that the lecture's scenes are made of.
pub(crate) const SCENES: &[(&str, &[u8])] = scenes! {
    "fibres/clip.ply"
    "fibres/herbert.hair"
    "fibres/tress-back.pbrt"
    "fibres/tress-front.pbrt"
    "fibres/tress-side.pbrt"
    "fibres/tress.hair"
    "fibres/tresses.inc"
    "lecture/ball-10.pbrt"
    "lecture/ball-30.pbrt"
    "lecture/ball-45.pbrt"
    "lecture/ball-60.pbrt"
    "lecture/ball-75.pbrt"
    "lecture/ball.inc"
    "lecture/brushed.pbrt"
    "lecture/caustic-behind.pbrt"
    "lecture/caustic-front.pbrt"
    "lecture/caustic.inc"
    "lecture/circular-light.pbrt"
    "lecture/cone.pbrt"
    "lecture/cylinder-around.pbrt"
    "lecture/cylinder-axial.pbrt"
    "lecture/cylinder-axial-lifted.pbrt"
    "lecture/cylinder-helix.pbrt"
    "lecture/disc-grooves.pbrt"
    "lecture/disc-radial.pbrt"
    "lecture/furnace.pbrt"
    "lecture/herbert-chiang.pbrt"
    "lecture/herbert-kajiya-kay.pbrt"
    "lecture/herbert.inc"
    "lecture/highlight.inc"
    "lecture/horse.hair"
    "lecture/model-fibre.pbrt"
    "lecture/model-surface.pbrt"
    "lecture/plate-10.pbrt"
    "lecture/plate-30.pbrt"
    "lecture/plate-45.pbrt"
    "lecture/plate-60.pbrt"
    "lecture/plate-75.pbrt"
    "lecture/plate.inc"
    "lecture/quarterhorse.pbrt"
    "lecture/sphere-meridians.pbrt"
    "lecture/sphere-parallels.pbrt"
    "lecture/spool.inc"
    "lecture/strand-behind.pbrt"
    "lecture/strand.pbrt"
    "lecture/wound-surface.pbrt"
    "lecture/wound.inc"
    "lecture/wound.pbrt"
    "meshes/helix.ply"
    "meshes/herbert.ply"
    "meshes/horse.ply"
    "mis/lamp-0.1.pbrt"
    "mis/lamp-0.3.pbrt"
    "mis/lamp-0.9.pbrt"
    "mis/stage.inc"
    "veach-mis.pbrt"
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_scene_of_the_lecture_is_missing() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/lecture");
        for entry in std::fs::read_dir(folder).unwrap() {
            let name = format!("lecture/{}", entry.unwrap().file_name().display());
            assert!(SCENES.iter().any(|(n, _)| *n == name), "{name} is not in the table");
        }
    }

    #[test]
    fn files_are_small() {
        for (name, bytes) in SCENES {
            assert!(bytes.len() < 1_000_000, "{name} has {} bytes", bytes.len());
        }
    }
}

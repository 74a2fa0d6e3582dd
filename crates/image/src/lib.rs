//! Pixels, image files and image metrics; knows no renderer.
//!
//! - [`Image`] is what is read from PNG, JPEG, TGA, QOI, Radiance HDR, PFM and OpenEXR files. Samples stay as
//!   wide as the file had them; [`Image::value`] gives them as linear numbers.
//! - [`OutputImage`] is what is written as OpenEXR: any channels, windows, a colour space, attributes.
//!   [`write_png`] writes a picture to look at, [`encode_png`] makes its bytes.
//! - [`metrics`] compares two pictures.
//!
//! Row 0 is the top row, whatever the file's order. No function panics on the contents of a file, and no
//! header makes one reserve memory out of proportion to the file's length.
//!
//! ```
//! use sparrow_image::{Encoding, Image, Pixels};
//! let grey = Image::new(2, 1, vec!["Y".into()], Pixels::U8(vec![0, 255]), Encoding::Srgb)?;
//! assert_eq!(grey.rgb(1, 0), [1.0; 3]);
//! # Ok::<(), sparrow_image::ImageError>(())
//! ```

mod atomic;
mod encoding;
mod error;
mod exr_read;
mod exr_write;
mod image;
pub mod metrics;
mod pfm;
mod png;
mod read;

pub use self::encoding::{Encoding, EncodingError};
pub use self::error::ImageError;
pub use self::exr_read::{ExrHeader, read_exr};
pub use self::exr_write::{Attribute, OutputChannel, OutputImage, write_exr};
pub use self::image::{Chromaticities, Image, Pixels};
pub use self::png::{encode_png, write_png};

//! Reading: which format a file has, and the formats of the `image` crate.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use image::codecs::hdr::HdrDecoder;
use image::error::ImageError as DecodeError;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

use crate::error::{Fault, allowed_bytes, check_size};
use crate::{Encoding, Image, ImageError, Pixels, exr_read, pfm};

const KNOWN: &str = "give a PNG, JPEG, TGA, QOI, HDR, PFM or EXR file";

/// A file format, as its first bytes tell it; TGA has no mark and goes by its extension.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Format {
    Exr,
    Hdr,
    Pfm,
    /// What the `image` crate decodes by itself.
    Coded(ImageFormat),
}

fn format_of(bytes: &[u8], path: &Path) -> Option<Format> {
    let tga = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("tga"));
    match bytes {
        [0x76, 0x2f, 0x31, 0x01, ..] => Some(Format::Exr),
        [b'#', b'?', ..] => Some(Format::Hdr),
        [b'P', b'F' | b'f', c, ..] if c.is_ascii_whitespace() => Some(Format::Pfm),
        [0x89, b'P', b'N', b'G', ..] => Some(Format::Coded(ImageFormat::Png)),
        [0xff, 0xd8, ..] => Some(Format::Coded(ImageFormat::Jpeg)),
        [b'q', b'o', b'i', b'f', ..] => Some(Format::Coded(ImageFormat::Qoi)),
        _ if tga => Some(Format::Coded(ImageFormat::Tga)),
        _ => None,
    }
}

impl Image {
    /// Reads an image file; its format is told by its contents.
    ///
    /// `encoding` applies to integer samples and is sRGB where it is `None`. 8-bit samples are kept as they
    /// are; 16-bit ones become linear floats. Of an OpenEXR file the data window is read, all parts of the
    /// size of the first.
    ///
    /// # Errors
    /// [`ImageError`] names the file, the fault and a remedy: unreadable, unknown, damaged or cut short.
    pub fn read(path: &Path, encoding: Option<Encoding>) -> Result<Image, ImageError> {
        let bytes = fs::read(path).map_err(|source| ImageError::Io {
            path: path.to_path_buf(),
            action: "read",
            source,
        })?;
        Image::decode(&bytes, path, encoding)
    }

    /// Like [`Image::read`], for the contents of a file; `path` serves the messages and the extension of TGA.
    ///
    /// # Errors
    /// As [`Image::read`].
    pub fn decode(bytes: &[u8], path: &Path, encoding: Option<Encoding>) -> Result<Image, ImageError> {
        let encoding = encoding.unwrap_or(Encoding::Srgb);
        match format_of(bytes, path) {
            Some(Format::Exr) => exr_read::decode(bytes).map(|(image, _)| image),
            Some(Format::Pfm) => read_pfm(bytes),
            Some(Format::Hdr) => read_hdr(bytes),
            Some(Format::Coded(format)) => read_coded(bytes, format, encoding),
            None if bytes.is_empty() => Err(Fault::damaged("the file is empty")),
            None => Err(Fault::unsupported("this is no image format known here", KNOWN)),
        }
        .map_err(|fault| fault.at(path))
    }
}

/// Channel names by their number, as the `image` crate orders them.
fn channel_names(n: usize) -> Vec<String> {
    let names: &[&str] = match n {
        1 => &["Y"],
        2 => &["Y", "A"],
        3 => &["R", "G", "B"],
        _ => &["R", "G", "B", "A"],
    };
    names.iter().map(|&n| n.to_owned()).collect()
}

/// An image whose decoder vouches for the number of samples.
fn assemble(
    width: usize,
    height: usize,
    n: usize,
    pixels: Pixels,
    encoding: Encoding,
) -> Result<Image, Fault> {
    Image::new(width, height, channel_names(n), pixels, encoding).map_err(|e| Fault::damaged(e.to_string()))
}

fn read_pfm(bytes: &[u8]) -> Result<Image, Fault> {
    let p = pfm::decode(bytes)?;
    assemble(p.width, p.height, p.n_channels, Pixels::F32(p.samples), Encoding::Linear)
}

fn read_hdr(bytes: &[u8]) -> Result<Image, Fault> {
    // The header ends with an empty line; what it says of the colours must be looked at, the decoder does not.
    let end = bytes.windows(2).position(|w| w == b"\n\n").unwrap_or(bytes.len());
    if bytes[..end].windows(16).any(|w| w == b"32-bit_rle_xyze\n")
        || bytes[..end].ends_with(b"32-bit_rle_xyze")
    {
        return Err(Fault::unsupported("the pixels are XYZ, not RGB", "convert it with `ra_xyze -r`"));
    }
    let decoder = HdrDecoder::new_nonstrict(Cursor::new(bytes)).map_err(fault)?;
    decode_with(decoder, bytes.len(), Encoding::Linear)
}

fn read_coded(bytes: &[u8], format: ImageFormat, encoding: Encoding) -> Result<Image, Fault> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::default();
    limits.max_alloc = Some(allowed_bytes(bytes.len()));
    reader.limits(limits);
    decode_with(reader.into_decoder().map_err(fault)?, bytes.len(), encoding)
}

fn decode_with(decoder: impl ImageDecoder, file_len: usize, encoding: Encoding) -> Result<Image, Fault> {
    let (w, h) = decoder.dimensions();
    let pixel_bytes = u64::from(decoder.color_type().bytes_per_pixel());
    let (w, h) = check_size(u64::from(w), u64::from(h), pixel_bytes, file_len)?;
    let decoded = DynamicImage::from_decoder(decoder).map_err(fault)?;
    let n = usize::from(decoded.color().channel_count());
    let pixels = match decoded {
        DynamicImage::ImageLuma8(i) => Pixels::U8(i.into_raw()),
        DynamicImage::ImageLumaA8(i) => Pixels::U8(i.into_raw()),
        DynamicImage::ImageRgb8(i) => Pixels::U8(i.into_raw()),
        DynamicImage::ImageRgba8(i) => Pixels::U8(i.into_raw()),
        DynamicImage::ImageLuma16(i) => sixteen(&i, encoding),
        DynamicImage::ImageLumaA16(i) => sixteen(&i, encoding),
        DynamicImage::ImageRgb16(i) => sixteen(&i, encoding),
        DynamicImage::ImageRgba16(i) => sixteen(&i, encoding),
        DynamicImage::ImageRgb32F(i) => Pixels::F32(i.into_raw()),
        DynamicImage::ImageRgba32F(i) => Pixels::F32(i.into_raw()),
        _ => return Err(Fault::unsupported("the kind of its samples is not known here", KNOWN)),
    };
    assemble(w, h, n, pixels, encoding)
}

/// 16-bit codes as linear floats: an 11-bit half would lose what the file has.
fn sixteen(codes: &[u16], encoding: Encoding) -> Pixels {
    let table: Vec<f32> = (0..=u16::MAX).map(|v| encoding.to_linear(f64::from(v) / 65535.0) as f32).collect();
    Pixels::F32(codes.iter().map(|c| table[usize::from(*c)]).collect())
}

fn fault(e: DecodeError) -> Fault {
    match e {
        DecodeError::Unsupported(e) => Fault::unsupported(e.to_string(), KNOWN),
        e @ (DecodeError::Decoding(_)
        | DecodeError::Encoding(_)
        | DecodeError::Parameter(_)
        | DecodeError::Limits(_)
        | DecodeError::IoError(_)) => Fault::damaged(e.to_string()),
    }
}

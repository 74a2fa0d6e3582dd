//! OpenEXR files out: [`OutputImage`], [`write_exr`].

use std::collections::BTreeSet;
use std::io::Cursor;
use std::path::Path;

use exr::block::writer::{ChunkWriter, ChunksWriter};
use exr::block::{self, BlockIndex, UncompressedBlock};
use exr::image::write::layers::{LayersWriter, WritableLayers};
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Layer};
use exr::math::Vec2;
use exr::meta::MetaData;
use exr::meta::attribute::{self, AttributeValue, Compression, IntegerBounds, LineOrder, Text};
use exr::meta::header::{ImageAttributes, LayerAttributes, standard_names};
use half::f16;
use rayon::prelude::*;

use crate::{Chromaticities, ImageError, Pixels, atomic};

/// A channel to be written.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputChannel {
    /// `R`, `variance.R`, ...: what stands before the last dot is the layer.
    pub name: String,
    /// One sample per pixel of the data window, from the top left. 8-bit samples cannot be written.
    pub samples: Pixels,
}

/// The value of an attribute in the header of an OpenEXR file.
#[derive(Clone, Debug, PartialEq)]
pub enum Attribute {
    /// Text, in UTF-8.
    Text(String),
    /// A whole number.
    Int(i32),
    /// A number.
    Float(f32),
    /// A number in double precision.
    Double(f64),
    /// A transformation of column vectors, `m[row][column]`; the file holds its transpose, as OpenEXR has it.
    Matrix([[f32; 4]; 4]),
}

/// A picture to be written as OpenEXR.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputImage {
    /// Columns of the data window, i.e. of the pixels given.
    pub width: usize,
    /// Rows of the data window.
    pub height: usize,
    /// Column and row of the first pixel given, within the full picture.
    pub origin: [i32; 2],
    /// Width and height of the full picture (the display window).
    pub full_size: [usize; 2],
    /// The channels, in any order; the file has them sorted by name.
    pub channels: Vec<OutputChannel>,
    /// The RGB space of `R`, `G`, `B`.
    pub chromaticities: Option<Chromaticities>,
    /// Camera from world, for column vectors.
    pub world_to_camera: Option<[[f32; 4]; 4]>,
    /// Normalised device coordinates from world, for column vectors.
    pub world_to_ndc: Option<[[f32; 4]; 4]>,
    /// Anything else: `software`, `comments`, or names of one's own.
    pub attributes: Vec<(String, Attribute)>,
}

impl OutputImage {
    /// A picture without channels whose data window is the whole picture.
    pub fn new(width: usize, height: usize) -> OutputImage {
        OutputImage {
            width,
            height,
            origin: [0, 0],
            full_size: [width, height],
            channels: Vec::new(),
            chromaticities: None,
            world_to_camera: None,
            world_to_ndc: None,
            attributes: Vec::new(),
        }
    }

    /// Only the pixels from column and row `origin` on are given, of a picture of `full_size`.
    #[must_use]
    pub fn cropped(mut self, origin: [i32; 2], full_size: [usize; 2]) -> OutputImage {
        (self.origin, self.full_size) = (origin, full_size);
        self
    }

    /// Adds a channel of floats.
    #[must_use]
    pub fn with_f32(mut self, name: &str, samples: Vec<f32>) -> OutputImage {
        self.channels.push(OutputChannel { name: name.to_owned(), samples: Pixels::F32(samples) });
        self
    }

    /// Adds a channel, rounded to half floats; what exceeds them becomes infinite.
    #[must_use]
    pub fn with_f16(mut self, name: &str, samples: &[f32]) -> OutputImage {
        let samples = Pixels::F16(samples.iter().map(|v| f16::from_f32(*v)).collect());
        self.channels.push(OutputChannel { name: name.to_owned(), samples });
        self
    }

    /// Adds the three channels `R`, `G`, `B`, rounded to half floats as in [`with_f16`](Self::with_f16).
    #[must_use]
    pub fn with_rgb_f16(mut self, rgb: &[[f32; 3]]) -> OutputImage {
        for (c, name) in ["R", "G", "B"].into_iter().enumerate() {
            let samples: Vec<f32> = rgb.iter().map(|p| p[c]).collect();
            self = self.with_f16(name, &samples);
        }
        self
    }

    /// Adds the three channels `R`, `G`, `B` of `layer`, which is empty for the picture itself, as floats.
    #[must_use]
    pub fn with_rgb(mut self, layer: &str, rgb: &[[f32; 3]]) -> OutputImage {
        for (c, name) in ["R", "G", "B"].into_iter().enumerate() {
            let name = if layer.is_empty() { name.to_owned() } else { format!("{layer}.{name}") };
            self = self.with_f32(&name, rgb.iter().map(|p| p[c]).collect());
        }
        self
    }

    /// Adds an attribute.
    #[must_use]
    pub fn with_attribute(mut self, name: &str, value: Attribute) -> OutputImage {
        self.attributes.push((name.to_owned(), value));
        self
    }
}

/// Writes an OpenEXR file: scan lines, ZIP compression, the same bytes for the same content.
///
/// # Errors
/// [`ImageError::Mismatch`] where sizes or names cannot be written, [`ImageError::Io`] where the file cannot;
/// in both cases nothing is left behind and an older file stays.
pub fn write_exr(path: &Path, image: &OutputImage) -> Result<(), ImageError> {
    let bytes = encode(image).map_err(|what| ImageError::Mismatch(format!("{}: {what}", path.display())))?;
    atomic::write(path, &bytes)
}

fn encode(image: &OutputImage) -> Result<Vec<u8>, String> {
    let channels = channels_of(image)?;
    let mut own =
        LayerAttributes { layer_position: Vec2(image.origin[0], image.origin[1]), ..Default::default() };
    own.world_to_camera = image.world_to_camera.as_ref().map(rows);
    own.world_to_normalized_device = image.world_to_ndc.as_ref().map(rows);
    add_attributes(&mut own, &image.attributes)?;
    let size = Vec2(image.width, image.height);
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let layer = Layer::new(size, own, encoding, AnyChannels::sort(channels.into()));
    let window = IntegerBounds::from_dimensions(Vec2(image.full_size[0], image.full_size[1]));
    let mut shared = ImageAttributes::new(window);
    shared.chromaticities = image.chromaticities.map(|c| attribute::Chromaticities {
        red: Vec2(c.red[0], c.red[1]),
        green: Vec2(c.green[0], c.green[1]),
        blue: Vec2(c.blue[0], c.blue[1]),
        white: Vec2(c.white[0], c.white[1]),
    });
    let mut file = Cursor::new(Vec::new());
    let headers = layer.infer_headers(&shared);
    let pixels = layer.create_writer(&headers);
    block::write(&mut file, headers, true, |meta, chunks| write_blocks(&pixels, &meta, chunks))
        .map_err(|e| format!("cannot be encoded: {e}"))?;
    let mut bytes = file.into_inner();
    sort_header(&mut bytes).ok_or("cannot be encoded: the header came out damaged")?;
    Ok(bytes)
}

/// Blocks that are packed or unpacked side by side before their bytes go on, one after the other.
pub(crate) fn blocks_at_once() -> usize {
    4 * rayon::current_num_threads()
}

fn write_blocks(
    pixels: &impl LayersWriter,
    meta: &MetaData,
    chunks: &mut ChunkWriter<&mut Cursor<Vec<u8>>>,
) -> exr::error::UnitResult {
    let blocks: Vec<(usize, BlockIndex)> = meta.enumerate_ordered_header_block_indices().collect();
    let pack = |&(place, index): &(usize, BlockIndex)| {
        let data = pixels.extract_uncompressed_block(&meta.headers, index);
        (place, UncompressedBlock { index, data }.compress_to_chunk(&meta.headers))
    };
    for round in blocks.chunks(blocks_at_once()) {
        let packed: Vec<_> = round.par_iter().map(pack).collect();
        for (place, chunk) in packed {
            chunks.write_chunk(place, chunk?)?;
        }
    }
    Ok(())
}

fn channels_of(image: &OutputImage) -> Result<Vec<AnyChannel<FlatSamples>>, String> {
    let n = image.width.checked_mul(image.height).filter(|n| *n > 0);
    let limit = |v: usize| v > 0 && v < 1 << 30;
    if n.is_none() || !image.full_size.into_iter().chain([image.width, image.height]).all(limit) {
        return Err(format!(
            "a window of {} x {} pixels in {} x {} cannot be written",
            image.width, image.height, image.full_size[0], image.full_size[1]
        ));
    }
    if image.channels.is_empty() {
        return Err("there is no channel to write".to_owned());
    }
    let mut seen = BTreeSet::new();
    let mut channels = Vec::with_capacity(image.channels.len());
    for c in &image.channels {
        if Some(c.samples.len()) != n {
            return Err(format!(
                "channel `{}` has {} samples, not one for each of {} x {} pixels",
                c.name,
                c.samples.len(),
                image.width,
                image.height
            ));
        }
        if !seen.insert(&c.name) {
            return Err(format!("two channels are called `{}`", c.name));
        }
        let samples = match &c.samples {
            Pixels::F16(v) => FlatSamples::F16(v.clone()),
            Pixels::F32(v) => FlatSamples::F32(v.clone()),
            Pixels::U8(_) => return Err(format!("channel `{}` is 8-bit; OpenEXR stores floats", c.name)),
        };
        channels.push(AnyChannel::new(name_of(&c.name)?, samples));
    }
    Ok(channels)
}

/// A name as OpenEXR can store it: 1 to 255 bytes of plain ASCII.
fn name_of(name: &str) -> Result<Text, String> {
    let sound = (1..=255).contains(&name.len()) && name.bytes().all(|b| b.is_ascii_graphic() || b == b' ');
    Text::new_or_none(name).filter(|_| sound).ok_or_else(|| {
        format!("`{name}` cannot name a channel or an attribute; use 1 to 255 ASCII characters")
    })
}

fn add_attributes(own: &mut LayerAttributes, attributes: &[(String, Attribute)]) -> Result<(), String> {
    let mut seen = BTreeSet::new();
    for (name, value) in attributes {
        if !seen.insert(name) {
            return Err(format!("two attributes are called `{name}`"));
        }
        let key = name_of(name)?;
        let value = match value {
            Attribute::Text(t) => AttributeValue::Text(Text::from_slice_unchecked(t.as_bytes())),
            Attribute::Int(v) => AttributeValue::I32(*v),
            Attribute::Float(v) => AttributeValue::F32(*v),
            Attribute::Double(v) => AttributeValue::F64(*v),
            Attribute::Matrix(m) => AttributeValue::Matrix4x4(rows(m)),
        };
        match (name.as_str(), value) {
            ("software", AttributeValue::Text(t)) => own.software_name = Some(t),
            ("comments", AttributeValue::Text(t)) => own.comments = Some(t),
            ("owner", AttributeValue::Text(t)) => own.owner = Some(t),
            ("capDate", AttributeValue::Text(t)) => own.capture_date = Some(t),
            _ if standard_names::ALL.contains(&name.as_bytes()) => {
                return Err(format!(
                    "`{name}` has a fixed meaning in OpenEXR and cannot be given as an attribute"
                ));
            }
            (_, value) => {
                own.other.insert(key, value);
            }
        }
    }
    Ok(())
}

/// OpenEXR multiplies row vectors from the left, so it stores the transpose.
fn rows(m: &[[f32; 4]; 4]) -> attribute::Matrix4x4 {
    let mut out = [0.0; 16];
    for (i, v) in out.iter_mut().enumerate() {
        *v = m[i % 4][i / 4];
    }
    out
}

/// Sorts the attributes of the header by name, in place.
///
/// The encoder keeps them in a hash map, whose order differs from run to run; the same picture should give
/// the same file. Each attribute is `name\0 kind\0 length value`, the list ends with a zero byte, and its
/// length does not change, so the offsets behind it stay right.
fn sort_header(file: &mut [u8]) -> Option<()> {
    const START: usize = 8; // The magic number and the version come first.
    let text_end = |from: usize| file.get(from..)?.iter().position(|b| *b == 0).map(|n| from + n + 1);
    let mut found: Vec<&[u8]> = Vec::new();
    let mut at = START;
    while *file.get(at)? != 0 {
        let value = text_end(text_end(at)?)?;
        let length: [u8; 4] = file.get(value..value + 4)?.try_into().ok()?;
        let end = value + 4 + usize::try_from(u32::from_le_bytes(length)).ok()?;
        found.push(file.get(at..end)?);
        at = end;
    }
    found.sort_unstable();
    let sorted = found.concat();
    file.get_mut(START..at)?.copy_from_slice(&sorted);
    Some(())
}

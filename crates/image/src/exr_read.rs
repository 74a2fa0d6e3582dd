//! OpenEXR files in: [`Image::read`](crate::Image::read) and [`read_exr`].

use std::fs;
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use exr::block::chunk::{Chunk, CompressedBlock, TileCoordinates};
use exr::block::lines::LineRef;
use exr::block::{self, BlockIndex, UncompressedBlock};
use exr::math::Vec2;
use exr::meta::MetaData;
use exr::meta::attribute::{AttributeValue, ChannelDescription, Compression, Matrix4x4, SampleType, Text};
use exr::meta::header::{Header, ImageAttributes, LayerAttributes};
use half::f16;
use rayon::prelude::*;

use crate::error::{Fault, check_size};
use crate::exr_write::blocks_at_once;
use crate::image::{rgb_channels, split_layer};
use crate::{Attribute, Chromaticities, Encoding, Image, ImageError, Pixels};

/// What an OpenEXR file says besides its pixels.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ExrHeader {
    /// Column and row of the data window's first pixel, in the display window's coordinates.
    pub origin: [i32; 2],
    /// First pixel of the display window, nearly always `[0, 0]`.
    pub display_origin: [i32; 2],
    /// Width and height of the display window.
    pub display_size: [usize; 2],
    /// Camera from world, for column vectors (`m[row][column]`).
    pub world_to_camera: Option<[[f32; 4]; 4]>,
    /// Normalised device coordinates from world, for column vectors.
    pub world_to_ndc: Option<[[f32; 4]; 4]>,
    /// Texts, numbers and matrices, sorted by name. Kinds that [`Attribute`] lacks are left out.
    pub attributes: Vec<(String, Attribute)>,
}

impl ExrHeader {
    /// The attribute called `name`.
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|(n, _)| n == name).map(|(_, a)| a)
    }
}

/// Reads an OpenEXR file with its windows and attributes.
///
/// # Errors
/// As [`Image::read`]; also where the file is another kind of image.
pub fn read_exr(path: &Path) -> Result<(Image, ExrHeader), ImageError> {
    let bytes = fs::read(path).map_err(|source| ImageError::Io {
        path: path.to_path_buf(),
        action: "read",
        source,
    })?;
    decode(&bytes).map_err(|fault| fault.at(path))
}

/// Decodes a whole file.
pub(crate) fn decode(bytes: &[u8]) -> Result<(Image, ExrHeader), Fault> {
    caught(|| decode_blocks(bytes))
}

/// What `decode` gives.
///
/// The decoder is careful, but some damaged blocks trip its assertions. They are no reason to end a program
/// that has other textures to name, so a panic becomes a fault here; nothing outlives it but the input.
fn caught<T>(decode: impl FnOnce() -> Result<T, Fault>) -> Result<T, Fault> {
    catch_unwind(AssertUnwindSafe(decode)).unwrap_or_else(|_| {
        Err(Fault::damaged("not a sound OpenEXR file: a block of pixels cannot be decoded"))
    })
}

/// The pixels of a block. Faults are told one by one, so that the first block that has one is told of whatever others do.
fn unpacked(chunk: exr::error::Result<Chunk>, meta: &MetaData) -> Result<UncompressedBlock, Fault> {
    caught(|| {
        let chunk = chunk.map_err(fault)?;
        check_dwa(&chunk, meta)?;
        UncompressedBlock::decompress_chunk(chunk, meta, false).map_err(fault)
    })
}

fn decode_blocks(bytes: &[u8]) -> Result<(Image, ExrHeader), Fault> {
    let reader = block::read(Cursor::new(bytes), false).map_err(fault)?;
    let meta = reader.meta_data().clone();
    check_headers(&meta, bytes.len())?;
    let first = meta.headers.first().ok_or_else(|| Fault::damaged("the file has no part"))?;
    let mut canvas = Canvas::new(&meta.headers, first);
    let largest = |_: &MetaData, tile: TileCoordinates, block: BlockIndex| {
        tile.level_index == Vec2(0, 0) && canvas.slots[block.layer].iter().any(Option::is_some)
    };
    let mut chunks = reader.filter_chunks(true, largest).map_err(fault)?;
    loop {
        let round: Vec<_> = chunks.by_ref().take(blocks_at_once()).collect();
        if round.is_empty() {
            break;
        }
        let blocks: Vec<_> = round.into_par_iter().map(|chunk| unpacked(chunk, &meta)).collect();
        for block in blocks {
            let block = block?;
            let channels = &meta.headers[block.index.layer].channels;
            for line in block.lines(channels) {
                canvas.paint(line, channels.list[line.location.channel].sample_type);
            }
        }
    }
    let header = header_of(&first.shared_attributes, &first.own_attributes);
    let mut image = Image::new(canvas.width, canvas.height, canvas.names, canvas.pixels, Encoding::Linear)
        .map_err(|e| Fault::damaged(e.to_string()))?;
    image.chromaticities = first.shared_attributes.chromaticities.map(|c| Chromaticities {
        red: [c.red.x(), c.red.y()],
        green: [c.green.x(), c.green.y()],
        blue: [c.blue.x(), c.blue.y()],
        white: [c.white.x(), c.white.y()],
    });
    Ok((image, header))
}

/// Refuses what the reader below would answer with a wrong picture or with too much memory.
fn check_headers(meta: &MetaData, file_len: usize) -> Result<(), Fault> {
    let mut bytes_per_pixel = 0u64;
    for h in &meta.headers {
        if h.deep {
            return Err(Fault::unsupported("it holds deep data", "flatten it first"));
        }
        if h.channels.list.iter().any(|c| c.sampling.area() != 1) {
            return Err(Fault::unsupported(
                "it has subsampled channels (luminance and chroma)",
                "save it as RGB",
            ));
        }
        bytes_per_pixel += h.channels.bytes_per_pixel as u64;
        check_size(h.layer_size.width() as u64, h.layer_size.height() as u64, bytes_per_pixel, file_len)?;
    }
    Ok(())
}

/// Refuses a DWA block whose header announces more data than its pixels take: the decoder would reserve it.
///
/// The block starts with eleven 64-bit counts; the second to the tenth are sizes
/// (OpenEXR, `internal_dwa_compressor.h`). A block that did not shrink is stored plainly, without them.
fn check_dwa(chunk: &Chunk, meta: &MetaData) -> Result<(), Fault> {
    let header = &meta.headers[chunk.layer_index];
    let data = match &chunk.compressed_block {
        CompressedBlock::ScanLine(b) => &b.compressed_pixels_le,
        CompressedBlock::Tile(b) => &b.compressed_pixels_le,
        CompressedBlock::DeepScanLine(_) | CompressedBlock::DeepTile(_) => return Ok(()),
    };
    if !matches!(header.compression, Compression::DWAA(_) | Compression::DWAB(_)) {
        return Ok(());
    }
    let tile = header.get_block_data_indices(&chunk.compressed_block).map_err(fault)?;
    let size = header.get_absolute_block_pixel_coordinates(tile).map_err(fault)?.size;
    if data.len() == size.area() * header.channels.bytes_per_pixel {
        return Ok(());
    }
    // Transformed in squares of 8 x 8, with at most four bytes a sample and twice that before packing.
    let padded = size.width().next_multiple_of(8) * size.height().next_multiple_of(8);
    let most = (padded * header.channels.list.len() * 8 + 4096) as u64;
    let sizes = data.as_chunks::<8>().0.iter().skip(1).take(9).map(|b| u64::from_le_bytes(*b));
    if sizes.max().is_some_and(|s| s > most) {
        return Err(Fault::damaged("not a sound OpenEXR file: a DWA block is larger than its pixels"));
    }
    Ok(())
}

/// The image being put together: channels of one pixel side by side.
struct Canvas {
    width: usize,
    height: usize,
    names: Vec<String>,
    pixels: Pixels,
    /// Where each channel of each part goes; `None` where it is left out.
    slots: Vec<Vec<Option<usize>>>,
}

impl Canvas {
    /// Takes the channels of all parts that cover the same pixels as the first.
    ///
    /// With several parts, the part's name becomes a layer name, unless the channel's name has it already
    /// (writers do both). Half floats stay half only where all channels are.
    fn new(headers: &[Header], first: &Header) -> Canvas {
        let mut names: Vec<String> = Vec::new();
        let mut all_half = true;
        let mut slots = Vec::with_capacity(headers.len());
        for h in headers {
            let same = h.data_window() == first.data_window();
            let part = h.own_attributes.layer_name.as_ref().filter(|_| headers.len() > 1).map(text_of);
            let place = |c: &ChannelDescription| {
                let own = text_of(&c.name);
                let name = match &part {
                    Some(p) if !p.is_empty() && !own.starts_with(&format!("{p}.")) => format!("{p}.{own}"),
                    Some(_) | None => own,
                };
                if !same || names.contains(&name) {
                    return None;
                }
                all_half &= c.sample_type == SampleType::F16;
                names.push(name);
                Some(names.len() - 1)
            };
            slots.push(h.channels.list.iter().map(place).collect::<Vec<_>>());
        }
        let order = colour_first(&names);
        let mut place_of = vec![0; names.len()];
        order.iter().enumerate().for_each(|(place, i)| place_of[*i] = place);
        slots.iter_mut().flatten().flatten().for_each(|slot| *slot = place_of[*slot]);
        let names = order.iter().map(|i| names[*i].clone()).collect();
        let n = first.layer_size.area() * order.len();
        let pixels = if all_half { Pixels::F16(vec![f16::ZERO; n]) } else { Pixels::F32(vec![0.0; n]) };
        Canvas { width: first.layer_size.width(), height: first.layer_size.height(), names, pixels, slots }
    }

    /// Copies one row of one channel; the decoder hands it over in the byte order of the machine.
    fn paint(&mut self, line: LineRef<'_>, kind: SampleType) {
        let at = line.location;
        let Some(slot) = self.slots[at.layer][at.channel] else { return };
        let n = self.names.len();
        let start = (at.position.y() * self.width + at.position.x()) * n + slot;
        let (pairs, fours) = (line.value.as_chunks::<2>().0.iter(), line.value.as_chunks::<4>().0.iter());
        match &mut self.pixels {
            Pixels::F16(v) => {
                let places = v[start..].iter_mut().step_by(n);
                places.zip(pairs).for_each(|(o, b)| *o = f16::from_ne_bytes(*b));
            }
            Pixels::F32(v) => {
                let places = v[start..].iter_mut().step_by(n);
                match kind {
                    SampleType::F16 => {
                        places.zip(pairs).for_each(|(o, b)| *o = f16::from_ne_bytes(*b).to_f32())
                    }
                    SampleType::F32 => places.zip(fours).for_each(|(o, b)| *o = f32::from_ne_bytes(*b)),
                    SampleType::U32 => {
                        places.zip(fours).for_each(|(o, b)| *o = u32::from_ne_bytes(*b) as f32)
                    }
                }
            }
            Pixels::U8(_) => debug_assert!(false, "a canvas is made of floats"),
        }
    }
}

/// The order of the channels in the image: red, green, blue, the alpha of their layer, then as in the file.
fn colour_first(names: &[String]) -> Vec<usize> {
    let rgb = rgb_channels(names);
    let mut order = Vec::with_capacity(names.len());
    if rgb[0] != rgb[1] {
        order.extend(rgb);
        let layer = split_layer(&names[rgb[0]]).0;
        order.extend(names.iter().position(|n| split_layer(n) == (layer, "A")));
    }
    for i in 0..names.len() {
        if !order.contains(&i) {
            order.push(i);
        }
    }
    order
}

fn header_of(shared: &ImageAttributes, own: &LayerAttributes) -> ExrHeader {
    let mut attributes: Vec<(String, Attribute)> = Vec::new();
    let named = [
        ("software", &own.software_name),
        ("comments", &own.comments),
        ("owner", &own.owner),
        ("capDate", &own.capture_date),
    ];
    for (name, text) in named {
        attributes.extend(text.as_ref().map(|t| (name.to_owned(), Attribute::Text(text_of(t)))));
    }
    for (name, value) in shared.other.iter().chain(&own.other) {
        attributes.extend(attribute_of(value).map(|v| (name.to_string(), v)));
    }
    attributes.sort_by(|a, b| a.0.cmp(&b.0));
    let window = shared.display_window;
    ExrHeader {
        origin: [own.layer_position.x(), own.layer_position.y()],
        display_origin: [window.position.x(), window.position.y()],
        display_size: [window.size.width(), window.size.height()],
        world_to_camera: own.world_to_camera.as_ref().map(columns),
        world_to_ndc: own.world_to_normalized_device.as_ref().map(columns),
        attributes,
    }
}

/// UTF-8, as OpenEXR recommends; older writers left Latin-1, which `Display` decodes.
fn text_of(text: &Text) -> String {
    String::from_utf8(text.as_slice().to_vec()).unwrap_or_else(|_| text.to_string())
}

#[expect(clippy::wildcard_enum_match_arm, reason = "twenty kinds that nobody asks for")]
fn attribute_of(value: &AttributeValue) -> Option<Attribute> {
    match value {
        AttributeValue::Text(t) => Some(Attribute::Text(text_of(t))),
        AttributeValue::I32(v) => Some(Attribute::Int(*v)),
        AttributeValue::F32(v) => Some(Attribute::Float(*v)),
        AttributeValue::F64(v) => Some(Attribute::Double(*v)),
        AttributeValue::Matrix4x4(m) => Some(Attribute::Matrix(columns(m))),
        _ => None,
    }
}

/// OpenEXR multiplies row vectors from the left, we multiply column vectors from the right.
fn columns(m: &Matrix4x4) -> [[f32; 4]; 4] {
    let mut out = [[0.0; 4]; 4];
    for (i, v) in m.iter().enumerate() {
        out[i % 4][i / 4] = *v;
    }
    out
}

fn fault(e: exr::error::Error) -> Fault {
    match e {
        exr::error::Error::NotSupported(what) => Fault::unsupported(
            format!("OpenEXR feature not known here: {what}"),
            "save it with ZIP compression",
        ),
        e @ (exr::error::Error::Aborted | exr::error::Error::Invalid(_) | exr::error::Error::Io(_)) => {
            Fault::damaged(format!("not a sound OpenEXR file: {e}"))
        }
    }
}

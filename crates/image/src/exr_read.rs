//! OpenEXR files in: [`Image::read`](crate::Image::read) and [`read_exr`].

use std::fs;
use std::io::Cursor;
use std::path::Path;

use exr::block;
use exr::image::read::image::ReadLayers;
use exr::image::read::layers::ReadChannels;
use exr::image::{AnyChannels, FlatSamples, Layer};
use exr::meta::MetaData;
use exr::meta::attribute::{AttributeValue, Matrix4x4, SampleType, Text};
use exr::meta::header::{ImageAttributes, LayerAttributes};
use half::f16;

use crate::error::{Fault, check_size};
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
    let reader = block::read(Cursor::new(bytes), false).map_err(fault)?;
    check_headers(reader.meta_data(), bytes.len())?;
    let large = reader.headers().iter().map(|h| h.layer_size.area()).sum::<usize>() > 1 << 18;
    let builder = exr::image::read::read().no_deep_data().largest_resolution_level().all_channels();
    let builder = builder.all_layers().all_attributes();
    // Starting threads costs more than a small picture does.
    let builder = if large { builder } else { builder.non_parallel() };
    let file = builder.from_chunks(reader).map_err(fault)?;

    let layers = &file.layer_data;
    let first = layers.first().ok_or_else(|| Fault::damaged("the file has no part"))?;
    let header = header_of(&file.attributes, &first.attributes);
    let planes = Plane::all(layers, first);
    let names: Vec<String> = planes.iter().map(|p| p.name.clone()).collect();
    let order = colour_first(&names);
    let pixels = interleave(&planes, &order, first.size.area());
    let names = order.iter().map(|i| names[*i].clone()).collect();
    let mut image = Image::new(first.size.width(), first.size.height(), names, pixels, Encoding::Linear)
        .map_err(|e| Fault::damaged(e.to_string()))?;
    image.chromaticities = file.attributes.chromaticities.map(|c| Chromaticities {
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

/// One channel of one part, under the name it gets in the image.
struct Plane<'a> {
    name: String,
    samples: &'a FlatSamples,
}

impl<'a> Plane<'a> {
    /// The channels of all parts that cover the same pixels as the first.
    ///
    /// With several parts, the part's name becomes a layer name, unless the channel's name has it already
    /// (writers do both).
    fn all(
        layers: &'a [Layer<AnyChannels<FlatSamples>>],
        first: &Layer<AnyChannels<FlatSamples>>,
    ) -> Vec<Self> {
        let mut planes: Vec<Plane<'a>> = Vec::new();
        for layer in layers {
            let same = layer.size == first.size
                && layer.attributes.layer_position == first.attributes.layer_position;
            let part = layer.attributes.layer_name.as_ref().filter(|_| layers.len() > 1).map(Text::to_string);
            for channel in layer.channel_data.list.iter().filter(|_| same) {
                let own = channel.name.to_string();
                let name = match &part {
                    Some(p) if !p.is_empty() && !own.starts_with(&format!("{p}.")) => format!("{p}.{own}"),
                    Some(_) | None => own,
                };
                if planes.iter().all(|p| p.name != name) {
                    planes.push(Plane { name, samples: &channel.sample_data });
                }
            }
        }
        planes
    }

    fn sample_type(&self) -> SampleType {
        match self.samples {
            FlatSamples::F16(_) => SampleType::F16,
            FlatSamples::F32(_) => SampleType::F32,
            FlatSamples::U32(_) => SampleType::U32,
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

/// Puts the channels of each pixel side by side; half floats stay half only where all channels are.
fn interleave(planes: &[Plane<'_>], order: &[usize], n_pixels: usize) -> Pixels {
    let n = order.len();
    if planes.iter().all(|p| p.sample_type() == SampleType::F16) {
        let mut out = vec![f16::ZERO; n * n_pixels];
        for (c, &i) in order.iter().enumerate() {
            if let FlatSamples::F16(v) = planes[i].samples {
                out.iter_mut().skip(c).step_by(n).zip(v).for_each(|(o, v)| *o = *v);
            }
        }
        return Pixels::F16(out);
    }
    let mut out = vec![0.0f32; n * n_pixels];
    for (c, &i) in order.iter().enumerate() {
        let places = out.iter_mut().skip(c).step_by(n);
        match planes[i].samples {
            FlatSamples::F16(v) => places.zip(v).for_each(|(o, v)| *o = v.to_f32()),
            FlatSamples::F32(v) => places.zip(v).for_each(|(o, v)| *o = *v),
            FlatSamples::U32(v) => places.zip(v).for_each(|(o, v)| *o = *v as f32),
        }
    }
    Pixels::F32(out)
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
        attributes.extend(text.as_ref().map(|t| (name.to_owned(), Attribute::Text(t.to_string()))));
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

#[expect(clippy::wildcard_enum_match_arm, reason = "twenty kinds that nobody asks for")]
fn attribute_of(value: &AttributeValue) -> Option<Attribute> {
    match value {
        AttributeValue::Text(t) => Some(Attribute::Text(t.to_string())),
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

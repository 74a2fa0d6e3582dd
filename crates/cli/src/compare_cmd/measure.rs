//! The measures by name: [`Measure`], [`Value`], [`Threshold`].

use std::cell::OnceCell;
use std::path::PathBuf;

use clap::ValueEnum;
use serde::Serialize;
use sparrow_image::ImageError;
use sparrow_image::metrics::{self, Pair};
use sparrow_models::suggest::remedy;

use super::maps;
use super::noise::Noise;
use super::pictures::Pictures;

/// A way to compare pictures. The doc comments are the command's help.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Measure {
    /// Mean squared error
    Mse,
    /// Mean of squared error over squared reference plus 0.01
    Relmse,
    /// relMSE without the worst 0.1 % of the pixels
    #[value(name = "relmse-trim0.1")]
    RelmseTrim01,
    /// relMSE without the worst 1 % of the pixels
    #[value(name = "relmse-trim1")]
    RelmseTrim1,
    /// relMSE between means of 8 x 8 pixels: what does not average out
    BlockRelmse,
    /// Mean over mean of the reference, for red, green and blue
    MeanRatio,
    /// Peak signal-to-noise ratio of sRGB values, in dB
    Psnr,
    /// Structural similarity of sRGB values
    Ssim,
    /// FLIP of what a display shows: 0 is alike, 1 the greatest difference
    Flip,
    /// FLIP of the worst of all exposures
    FlipHdr,
    /// Probability that noise alone makes such a difference; needs variances in both files
    ZTest,
}

/// What a measure gives.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Number(f64),
    /// For red, green and blue.
    Channels([f64; 3]),
    Test(Noise),
    /// Not for these pictures, and why.
    Undefined(String),
}

/// What a script allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Threshold {
    pub(super) measure: Measure,
    pub(super) limit: f64,
}

impl Measure {
    pub(super) fn all() -> impl Iterator<Item = Measure> {
        Measure::value_variants().iter().copied()
    }

    pub(super) fn name(self) -> String {
        self.to_possible_value().map(|v| v.get_name().to_owned()).unwrap_or_default()
    }

    /// What stands behind the number.
    pub(super) fn unit(self) -> &'static str {
        match self {
            Measure::RelmseTrim01 => "without the worst 0.1 % of the pixels",
            Measure::RelmseTrim1 => "without the worst 1 % of the pixels",
            Measure::BlockRelmse => "of means over 8 x 8 pixels",
            Measure::MeanRatio => "red, green, blue",
            Measure::Psnr => "dB",
            Measure::Mse
            | Measure::Relmse
            | Measure::Ssim
            | Measure::Flip
            | Measure::FlipHdr
            | Measure::ZTest => "",
        }
    }

    /// The pictures differ more than `limit` allows. What is not a number differs more than anything.
    pub(super) fn exceeds(self, value: &Value, limit: f64) -> bool {
        let within = match (self, value) {
            (Measure::Psnr | Measure::Ssim, Value::Number(v)) => *v >= limit,
            (_, Value::Number(v)) => *v <= limit,
            (_, Value::Channels(ratios)) => ratios.iter().all(|r| (r - 1.0).abs() <= limit),
            (_, Value::Test(noise)) => noise.p >= limit,
            (_, Value::Undefined(_)) => false,
        };
        !within
    }
}

/// Reads `NAME=VALUE`.
pub(super) fn parse_threshold(s: &str) -> Result<Threshold, String> {
    let form = "give NAME=VALUE, such as relmse=0.01";
    let (name, limit) = s.split_once('=').ok_or(form)?;
    let names: Vec<String> = Measure::all().map(Measure::name).collect();
    let measure = Measure::from_str(name, false).map_err(|_| {
        format!("there is no metric `{name}`; {}", remedy(name, names.iter().map(String::as_str)))
    })?;
    match limit.parse::<f64>() {
        Ok(limit) if limit.is_finite() => Ok(Threshold { measure, limit }),
        Ok(_) | Err(_) => Err(format!("`{limit}` is no finite number; {form}")),
    }
}

/// The measures of two pictures; maps that several need are made once.
pub(super) struct Taken<'a> {
    pictures: &'a Pictures,
    pair: Pair<'a>,
    flip: OnceCell<Vec<f64>>,
    flip_hdr: OnceCell<Vec<f64>>,
}

impl<'a> Taken<'a> {
    pub(super) fn new(pictures: &'a Pictures, pair: Pair<'a>) -> Taken<'a> {
        Taken { pictures, pair, flip: OnceCell::new(), flip_hdr: OnceCell::new() }
    }

    pub(super) fn value(&self, measure: Measure) -> Value {
        let pair = &self.pair;
        let trimmed = |share| match metrics::relmse(pair, share) {
            Ok(v) => Value::Number(v),
            Err(e) => Value::Undefined(e.to_string()),
        };
        let sized = |v: Option<f64>, side: &str| {
            v.map_or_else(
                || Value::Undefined(format!("it needs pictures of at least {side} pixels")),
                Value::Number,
            )
        };
        match measure {
            Measure::Mse => Value::Number(metrics::mse(pair)),
            Measure::Relmse => trimmed(0.0),
            Measure::RelmseTrim01 => trimmed(0.001),
            Measure::RelmseTrim1 => trimmed(0.01),
            Measure::BlockRelmse => sized(metrics::block_relmse(pair), "8 x 8"),
            Measure::MeanRatio => Value::Channels(metrics::mean_ratio(pair)),
            Measure::Psnr => Value::Number(metrics::psnr(pair)),
            Measure::Ssim => sized(metrics::ssim(pair), "11 x 11"),
            Measure::Flip => Value::Number(mean(self.flip())),
            Measure::FlipHdr => Value::Number(mean(self.flip_hdr())),
            Measure::ZTest => match self.pictures.variances() {
                Ok(variances) => Value::Test(Noise::between(pair, variances)),
                Err(why) => Value::Undefined(why),
            },
        }
    }

    fn flip(&self) -> &[f64] {
        self.flip.get_or_init(|| metrics::flip_map(&self.pair))
    }
    fn flip_hdr(&self) -> &[f64] {
        self.flip_hdr.get_or_init(|| metrics::flip_hdr_map(&self.pair))
    }

    /// Writes FLIP, for high dynamic range where the reference exceeds white, and the relative error.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub(super) fn save_maps(&self, [flip, relative]: &[PathBuf; 2]) -> Result<(), ImageError> {
        let bright = self.pair.reference().iter().flatten().any(|v| *v > 1.0);
        let width = self.pair.width();
        maps::save(flip, width, if bright { self.flip_hdr() } else { self.flip() })?;
        maps::save(relative, width, &metrics::relative_error_map(&self.pair))
    }
}

fn mean(map: &[f64]) -> f64 {
    map.iter().sum::<f64>() / map.len() as f64
}

impl Serialize for Value {
    fn serialize<S: serde::Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        match self {
            Value::Number(v) => v.serialize(s),
            Value::Channels(v) => v.serialize(s),
            Value::Test(noise) => noise.serialize(s),
            Value::Undefined(_) => s.serialize_none(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thresholds_are_read() {
        let limit = |s| parse_threshold(s).map(|t| (t.measure, t.limit));
        assert_eq!(limit("relmse=0.01"), Ok((Measure::Relmse, 0.01)));
        assert_eq!(limit("relmse-trim0.1=1e-3"), Ok((Measure::RelmseTrim01, 1e-3)));
        for (bad, says) in
            [("relmse", "give NAME"), ("mse=", "finite"), ("mse=nan", "finite"), ("relmes=1", "did you mean")]
        {
            let e = parse_threshold(bad).unwrap_err();
            assert!(e.contains(says), "{bad}: {e}");
        }
    }

    #[test]
    fn worse_is_what_the_measure_says() {
        let n = Value::Number;
        assert!(Measure::Mse.exceeds(&n(0.2), 0.1) && !Measure::Mse.exceeds(&n(0.1), 0.1));
        assert!(Measure::Psnr.exceeds(&n(20.0), 30.0) && !Measure::Psnr.exceeds(&n(f64::INFINITY), 30.0));
        assert!(Measure::Ssim.exceeds(&n(0.8), 0.9) && Measure::Mse.exceeds(&n(f64::NAN), 1e9));
        let ratios = Value::Channels([1.0, 0.97, 1.01]);
        assert!(Measure::MeanRatio.exceeds(&ratios, 0.02) && !Measure::MeanRatio.exceeds(&ratios, 0.04));
    }
}

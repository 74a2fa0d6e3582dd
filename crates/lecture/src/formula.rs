//! A formula with its source and the code that computes it: [`Formula`].

/// A formula with its source and the code that computes it.
#[derive(Clone, Copy, Debug)]
pub struct Formula {
    /// The formula, in the notation of the module `mathml`.
    pub text: &'static str,
    /// Where it stands: `[Key, eq. n]`.
    pub source: &'static str,
    /// File below `crates/` and function that computes it: `models/src/fresnel.rs: conductor`.
    pub code: &'static str,
}

impl Formula {
    /// A formula, its source, its code.
    pub const fn new(text: &'static str, source: &'static str, code: &'static str) -> Formula {
        Formula { text, source, code }
    }
}

//! The header: which elements there are, how many, and of which properties.

use std::io::Read;

use super::input::Input;
use super::{Fault, Place};

/// How the data behind the header are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Ascii,
    Little,
    Big,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Type {
    fn parse(name: &str) -> Option<Type> {
        Some(match name {
            "char" | "int8" => Type::I8,
            "uchar" | "uint8" => Type::U8,
            "short" | "int16" => Type::I16,
            "ushort" | "uint16" => Type::U16,
            "int" | "int32" => Type::I32,
            "uint" | "uint32" => Type::U32,
            "float" | "float32" => Type::F32,
            "double" | "float64" => Type::F64,
            _ => return None,
        })
    }
    /// Bytes in a binary file.
    pub(super) fn size(self) -> u64 {
        match self {
            Type::I8 | Type::U8 => 1,
            Type::I16 | Type::U16 => 2,
            Type::I32 | Type::U32 | Type::F32 => 4,
            Type::F64 => 8,
        }
    }
    /// A whole number.
    pub(super) fn is_whole(self) -> bool {
        !matches!(self, Type::F32 | Type::F64)
    }
}

/// A number, or a count and so many numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Type),
    List { count: Type, item: Type },
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
    /// Where the header declares it.
    pub(super) line: Place,
}

impl Element {
    /// The position of the property called `name`.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.properties.iter().position(|p| p.name == name)
    }
    /// Bytes that one instance takes at least.
    pub(super) fn least_bytes(&self, format: Format) -> u64 {
        let least = |p: &Property| match (format, p.kind) {
            // A digit and a blank.
            (Format::Ascii, _) => 2,
            (Format::Little | Format::Big, Kind::Scalar(t) | Kind::List { count: t, .. }) => t.size(),
        };
        self.properties.iter().map(least).sum()
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) format: Format,
    pub(super) elements: Vec<Element>,
}

/// Elements and properties that a header may declare together; real ones have some tens.
const MOST_DECLARATIONS: usize = 1000;

/// Reads to the end of the line `end_header`.
pub(super) fn read<R: Read>(input: &mut Input<R>) -> Result<Header, Fault> {
    if !input.magic()? {
        return Err(Fault::Damaged {
            place: Place::Line(1),
            fault: "this is no PLY file: its first line is not `ply`".to_owned(),
            remedy: "give a PLY file, plain or gzip-compressed",
        });
    }
    let mut format = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut n_declarations = 0;
    loop {
        let place = input.line();
        let line = input.header_line()?;
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        let bad = |what: &str| Err(Fault::damaged(place, format!("`{}`: {what}", line.escape_debug())));
        match words[..] {
            [] | ["comment" | "obj_info", ..] => {}
            ["format", name, "1.0"] if format.is_none() => {
                format = match name {
                    "ascii" => Some(Format::Ascii),
                    "binary_little_endian" => Some(Format::Little),
                    "binary_big_endian" => Some(Format::Big),
                    _ => return bad("the format must be ascii, binary_little_endian or binary_big_endian"),
                }
            }
            ["element", name, count] => {
                let Ok(count) = count.parse() else { return bad("the count must be a whole number") };
                if elements.iter().any(|e| e.name == name) {
                    return bad("this element is declared twice");
                }
                elements.push(Element { name: name.to_owned(), count, properties: Vec::new(), line: place });
            }
            ["property", ref rest @ ..] => {
                let Some(property) = property(rest) else {
                    return bad("this declares no property PLY knows");
                };
                let Some(element) = elements.last_mut() else { return bad("no element was declared before") };
                if element.find(&property.name).is_some() {
                    return bad("the element has such a property already");
                }
                element.properties.push(property);
            }
            ["end_header"] => break,
            _ => return bad("this line is not understood"),
        }
        n_declarations += 1;
        if n_declarations > MOST_DECLARATIONS {
            return bad("the header is longer than that of any mesh");
        }
    }
    let format =
        format.ok_or_else(|| Fault::damaged(input.line(), "the header has no line `format ... 1.0`"))?;
    Ok(Header { format, elements })
}

/// What follows the word `property`.
fn property(words: &[&str]) -> Option<Property> {
    let (kind, name) = match *words {
        [t, name] => (Kind::Scalar(Type::parse(t)?), name),
        ["list", count, item, name] => {
            let count = Type::parse(count).filter(|t| t.is_whole())?;
            (Kind::List { count, item: Type::parse(item)? }, name)
        }
        _ => return None,
    };
    Some(Property { name: name.to_owned(), kind })
}

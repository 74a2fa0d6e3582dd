//! Tables as CSV text: [`Table`].

use core::fmt::Write;

/// What stands in a field.
#[derive(Clone, Debug, PartialEq)]
pub enum Field {
    /// A number, written so that it reads back as the same `f64`; empty where it is not finite.
    Number(f64),
    /// A text, in quotes where it has to be.
    Text(String),
}

/// A table with a name for every column.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Names of the columns, with their units.
    pub columns: Vec<String>,
    /// As many fields in each row.
    pub rows: Vec<Vec<Field>>,
}

impl Table {
    /// An empty table.
    pub fn new(columns: impl IntoIterator<Item = impl Into<String>>) -> Table {
        Table { columns: columns.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }
    /// Adds a row of numbers.
    pub fn numbers(&mut self, row: impl IntoIterator<Item = f64>) {
        self.rows.push(row.into_iter().map(Field::Number).collect());
    }
    /// Adds a row that begins with a text.
    pub fn named(&mut self, name: &str, row: impl IntoIterator<Item = f64>) {
        let first = core::iter::once(Field::Text(name.to_owned()));
        self.rows.push(first.chain(row.into_iter().map(Field::Number)).collect());
    }
    /// The text, after RFC 4180: fields parted by commas, lines by a line feed.
    pub fn csv(&self) -> String {
        let mut out = String::new();
        let heads: Vec<String> = self.columns.iter().map(|c| quoted(c)).collect();
        let _ = writeln!(out, "{}", heads.join(","));
        for row in &self.rows {
            for (i, field) in row.iter().enumerate() {
                if i > 0 {
                    out.push(',');
                }
                match field {
                    // Writing to a string cannot fail.
                    Field::Number(v) if v.is_finite() => _ = write!(out, "{v:?}"),
                    Field::Number(_) => {}
                    Field::Text(t) => out.push_str(&quoted(t)),
                }
            }
            out.push('\n');
        }
        out
    }
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back_and_texts_are_quoted() {
        let mut t = Table::new(["name", "a, b"]);
        t.named("x \"y\"", [0.1 + 0.2]);
        t.named("z", [f64::NAN]);
        assert_eq!(t.csv(), "name,\"a, b\"\n\"x \"\"y\"\"\",0.30000000000000004\nz,\n");
        assert_eq!("0.30000000000000004".parse::<f64>().unwrap().to_bits(), (0.1f64 + 0.2).to_bits());
    }
}

//! The book: figures gathered, and written as a folder: [`Book`].

mod folder;
mod html;
mod index;
mod page;
mod record;
mod rows;

use std::path::Path;
use std::sync::atomic::AtomicBool;

use crate::entry::{Entry, Topic, select};
use crate::error::LectureError;
use crate::figure::{Content, Figure};
use crate::quality::Quality;
use crate::studio::Studio;

use folder::Folder;
pub use rows::{Row, Standing};

/// A figure that was made.
#[derive(Clone, Debug)]
pub struct Made {
    /// The page it belongs to.
    pub topic: &'static Topic,
    /// What made it.
    pub entry: &'static Entry,
    /// The figure.
    pub figure: Figure,
}

/// The figures of a book.
#[derive(Clone, Debug)]
pub struct Book {
    /// How much work went into it.
    pub quality: Quality,
    /// The slide or figure it was restricted to.
    pub only: Option<String>,
    /// The figures, in the order of the pages.
    pub figures: Vec<Made>,
}

const STYLE: &str = include_str!("style.css");

impl Book {
    /// Makes the figures that `only` names, or all, and writes them to `folder`, which is new, empty, or an older book.
    ///
    /// The folder appears whole or not at all. `watch` is told the title of each figure before it is made, with its number
    /// from 0 and their total; `stop` ends the work.
    ///
    /// # Errors
    /// Where there is no such figure, the folder holds something else, a figure cannot be made, or the work was stopped.
    pub fn write(
        only: Option<&str>,
        quality: Quality,
        folder: &Path,
        stop: &AtomicBool,
        watch: &mut dyn FnMut(&str, usize, usize),
    ) -> Result<Book, LectureError> {
        let chosen = select(only)?;
        let folder = Folder::begin(folder, only.is_some())?;
        let studio = Studio::new(quality, &folder.path("scenes"), stop)?;
        let mut figures = Vec::new();
        for (i, (topic, entry)) in chosen.iter().enumerate() {
            studio.go_on()?;
            watch(entry.title, i, chosen.len());
            figures.push(Made { topic, entry, figure: (entry.make)(&studio)? });
        }
        let book = Book { quality, only: only.map(str::to_owned), figures };
        book.save(&folder)?;
        studio.go_on()?;
        folder.finish()?;
        Ok(book)
    }

    fn save(&self, folder: &Folder) -> Result<(), LectureError> {
        folder.put("style.css", STYLE)?;
        folder.put("index.html", index::html(self))?;
        for topic in self.topics() {
            folder.put(&format!("{}.html", topic.id), page::html(self, topic))?;
        }
        for made in &self.figures {
            for file in made.files() {
                folder.put(&file.0, file.1)?;
            }
        }
        // Last: what tells a book from other folders, and when it was made.
        folder.put(folder::RECORD, record::json(self))
    }

    /// The pages, in their order.
    fn topics(&self) -> Vec<&'static Topic> {
        let mut topics: Vec<&'static Topic> = self.figures.iter().map(|m| m.topic).collect();
        topics.dedup_by_key(|t| t.id);
        topics
    }
}

impl Made {
    /// Name of a picture's file.
    fn picture_file(&self, i: usize) -> String {
        let picture = &self.figure.pictures[i];
        let part = if picture.name.is_empty() { String::new() } else { format!("-{}", picture.name) };
        let ending = match picture.content {
            Content::Svg(_) => "svg",
            Content::Png(_) => "png",
        };
        format!("figures/{}{part}.{ending}", self.entry.id)
    }
    /// Name of the file of numbers.
    fn table_file(&self) -> String {
        format!("data/{}.csv", self.entry.id)
    }
    /// Names and bytes of all its files.
    fn files(&self) -> Vec<(String, Vec<u8>)> {
        let picture = |(i, p): (usize, &crate::figure::Picture)| {
            let bytes = match &p.content {
                Content::Svg(text) => text.clone().into_bytes(),
                Content::Png(bytes) => bytes.clone(),
            };
            (self.picture_file(i), bytes)
        };
        let pictures = self.figure.pictures.iter().enumerate().map(picture);
        let table = self.figure.table.iter().map(|t| (self.table_file(), t.csv().into_bytes()));
        pictures.chain(table).collect()
    }
}

//! The bytes of a PLY file, one small buffer at a time.

use std::io::{self, BufReader, Chain, Cursor, ErrorKind, Read};

use flate2::read::MultiGzDecoder;

use super::{Fault, Place};

const BUFFER: usize = 1 << 17;
/// No number is written with more characters; a longer word is no number.
const LONGEST_WORD: usize = 64;
/// The header's lines are short; a longer one belongs to another format.
const LONGEST_LINE: usize = 4096;

/// A source whose first bytes were looked at and put back.
type Whole<R> = Chain<Cursor<Vec<u8>>, R>;

enum Source<R> {
    Plain(Whole<R>),
    Gzip(Box<MultiGzDecoder<BufReader<Whole<R>>>>),
}

impl<R: Read> Read for Source<R> {
    fn read(&mut self, buf: &mut [u8]) -> io::Result<usize> {
        match self {
            Source::Plain(r) => r.read(buf),
            Source::Gzip(r) => r.read(buf),
        }
    }
}

/// A window that slides over the (uncompressed) file.
pub(super) struct Input<R> {
    source: Source<R>,
    buffer: Box<[u8]>,
    start: usize,
    end: usize,
    /// Bytes of the file before `buffer[0]`.
    before: u64,
    /// Line of `buffer[start]`, kept up to date by the methods that read text.
    line: u64,
    /// What ends a line: a carriage return alone, in files of old Macintoshes, else a line feed.
    newline: u8,
    /// More bytes than the uncompressed file can have.
    limit: u64,
    likely: u64,
}

impl<R: Read> Input<R> {
    /// Looks at the first bytes for the mark of gzip. `length` is that of the file as stored.
    pub(super) fn new(mut source: R, length: u64) -> Result<Input<R>, Fault> {
        let mut mark = Vec::with_capacity(2);
        source.by_ref().take(2).read_to_end(&mut mark)?;
        let zipped = mark == [0x1f, 0x8b];
        let whole = Cursor::new(mark).chain(source);
        // Deflate reaches at most 1032 to 1, and some 3 to 1 on meshes.
        let (source, limit, likely) = if zipped {
            let decoder = MultiGzDecoder::new(BufReader::with_capacity(BUFFER, whole));
            (Source::Gzip(Box::new(decoder)), length.saturating_mul(1032), length.saturating_mul(8))
        } else {
            (Source::Plain(whole), length, length)
        };
        let buffer = vec![0; BUFFER].into_boxed_slice();
        Ok(Input { source, buffer, start: 0, end: 0, before: 0, line: 1, newline: b'\n', limit, likely })
    }

    /// More bytes than the uncompressed file can have.
    pub(super) fn limit(&self) -> u64 {
        self.limit
    }

    /// How many bytes the uncompressed file probably has at most; memory may be set aside for so many.
    pub(super) fn likely(&self) -> u64 {
        self.likely
    }

    /// The byte that is read next, counted from the start of the uncompressed file.
    pub(super) fn offset(&self) -> u64 {
        self.before + self.start as u64
    }

    /// Where the file ends, once that was found out.
    pub(super) fn end(&self) -> u64 {
        self.before + self.end as u64
    }

    /// The line that is read next.
    pub(super) fn line(&self) -> Place {
        Place::Line(self.line)
    }

    /// Sees to it that `n` bytes lie in the buffer, or all that are left.
    fn fill(&mut self, n: usize) -> Result<&[u8], Fault> {
        if self.end - self.start < n {
            self.buffer.copy_within(self.start..self.end, 0);
            self.before += self.start as u64;
            (self.start, self.end) = (0, self.end - self.start);
            while self.end < n {
                match self.source.read(&mut self.buffer[self.end..]) {
                    Ok(0) => break,
                    Ok(got) => self.end += got,
                    Err(e) if e.kind() == ErrorKind::Interrupted => {}
                    Err(e) => return Err(e.into()),
                }
            }
        }
        Ok(&self.buffer[self.start..self.end])
    }

    /// The next `N` bytes; `None` where fewer are left.
    #[inline]
    pub(super) fn take<const N: usize>(&mut self) -> Result<Option<[u8; N]>, Fault> {
        if self.end - self.start < N {
            self.fill(N)?;
        }
        let found = self.buffer[self.start..self.end].first_chunk::<N>().copied();
        self.start += found.map_or(0, |_| N);
        Ok(found)
    }

    /// Whole rows of `row` bytes that lie in the buffer, at most `n`; none where fewer bytes are left.
    pub(super) fn rows(&mut self, row: usize, n: u64) -> Result<&[u8], Fault> {
        let n_whole = self.fill(row)?.len() / row;
        let n = usize::try_from(n).map_or(n_whole, |n| n.min(n_whole));
        Ok(&self.buffer[self.start..self.start + n * row])
    }

    /// Passes over bytes that lie in the buffer.
    pub(super) fn pass(&mut self, n_bytes: usize) {
        self.start += n_bytes;
    }

    /// Passes over `n` bytes; false where fewer are left.
    pub(super) fn skip(&mut self, mut n: u64) -> Result<bool, Fault> {
        while n > 0 {
            let available = self.fill(1)?.len() as u64;
            if available == 0 {
                return Ok(false);
            }
            let step = available.min(n);
            self.start += step as usize;
            n -= step;
        }
        Ok(true)
    }

    /// The next line of the header, without its end.
    pub(super) fn header_line(&mut self) -> Result<String, Fault> {
        let newline = self.newline;
        let window = self.fill(LONGEST_LINE)?;
        let Some(n) = window.iter().take(LONGEST_LINE).position(|b| *b == newline) else {
            let what = if window.len() < LONGEST_LINE {
                "the file ends inside its header"
            } else {
                "a line of the header is longer than any PLY file has"
            };
            return Err(Fault::damaged(self.line(), what));
        };
        let text = String::from_utf8_lossy(&window[..n]).trim_end_matches('\r').to_owned();
        self.start += n + 1;
        self.line += 1;
        Ok(text)
    }

    /// Reads the mark `ply` that begins the file, and learns from what follows how its lines end.
    pub(super) fn magic(&mut self) -> Result<bool, Fault> {
        let (length, newline) = match self.fill(5)? {
            [b'p', b'l', b'y', b'\r', b'\n', ..] => (5, b'\n'),
            [b'p', b'l', b'y', b'\n', ..] => (4, b'\n'),
            [b'p', b'l', b'y', b'\r', ..] => (4, b'\r'),
            _ => return Ok(false),
        };
        self.newline = newline;
        self.start += length;
        self.line += 1;
        Ok(true)
    }

    /// Passes over blanks; false at the end of the file.
    pub(super) fn skip_blanks(&mut self) -> Result<bool, Fault> {
        loop {
            let newline = self.newline;
            let window = self.fill(1)?;
            if window.is_empty() {
                return Ok(false);
            }
            let blanks = window.iter().position(|b| !b.is_ascii_whitespace()).unwrap_or(window.len());
            let lines = window[..blanks].iter().filter(|b| **b == newline).count();
            let found = blanks < window.len();
            self.start += blanks;
            self.line += lines as u64;
            if found {
                return Ok(true);
            }
        }
    }

    /// The next word of the text, `None` at the end of the file; a word too long for a number is cut.
    pub(super) fn word(&mut self) -> Result<Option<&str>, Fault> {
        if !self.skip_blanks()? {
            return Ok(None);
        }
        let window = self.fill(LONGEST_WORD)?;
        let window = &window[..window.len().min(LONGEST_WORD)];
        let n = window.iter().position(u8::is_ascii_whitespace).unwrap_or(window.len());
        let from = self.start;
        self.start += n;
        // What is not ASCII is no number: an empty word is told as such.
        Ok(Some(std::str::from_utf8(&self.buffer[from..from + n]).unwrap_or_default()))
    }
}

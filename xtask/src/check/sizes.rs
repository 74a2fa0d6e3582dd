//! Sizes: the page that the path loop fits on, and the length of files.

use std::path::Path;

use super::{Findings, Source};

const PATH_LOOP: &str = "crates/render/src/integrator/path.rs";
/// Lines of code in the body of `radiance`; blank lines and lines of comment are free.
const MAX_LOOP: usize = 60;
const MAX_FILE: usize = 500;

pub(super) fn path_loop(_: &Path, sources: &[Source], found: &mut Findings) -> Result<(), String> {
    let source = sources.iter().find(|s| s.path == PATH_LOOP).ok_or(format!("{PATH_LOOP} is missing"))?;
    let n = body(&source.text, "fn radiance(").ok_or(format!("{PATH_LOOP} has no function `radiance`"))?;
    if n > MAX_LOOP {
        found.fault(format!("{PATH_LOOP}: `radiance` has {n} lines of code; {MAX_LOOP} fit on a page"));
    }
    Ok(())
}

/// Lines of code between the braces of the first function that begins so, formatted as rustfmt does.
fn body(text: &str, signature: &str) -> Option<usize> {
    let mut lines = text.lines().skip_while(|l| !l.contains(signature));
    let first = lines.next()?;
    let indent = &first[..first.len() - first.trim_start().len()];
    let mut rest = std::iter::once(first).chain(lines).skip_while(|l| !l.ends_with('{'));
    rest.next()?;
    let end = format!("{indent}}}");
    let code = |l: &&str| !l.trim().is_empty() && !l.trim_start().starts_with("//");
    Some(rest.take_while(|l| *l != end).filter(code).count())
}

pub(super) fn files(_: &Path, sources: &[Source], found: &mut Findings) -> Result<(), String> {
    for source in sources.iter().filter(|s| s.path.ends_with(".rs")) {
        let n = source.text.lines().count();
        if n > MAX_FILE {
            found.note(format!("{} has {n} lines; split it by idea where one hides in there", source.path));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_code_alone() {
        let text = "impl X {\n    fn f(\n        a: u8,\n    ) -> u8 {\n        // Why.\n        if a > 1 {\n            return 1;\n        }\n\n        a\n    }\n    fn g() {}\n}\n";
        assert_eq!(body(text, "fn f("), Some(4));
        assert_eq!(body(text, "fn h("), None);
    }
}

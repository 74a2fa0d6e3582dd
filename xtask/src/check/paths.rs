//! What a file points at: nothing of one machine, nothing that is not there.

use std::path::Path;

use super::{Findings, Source};

/// Folders that exist on somebody's machine only. Written in two parts, so that this file does not find itself.
const MACHINE: [&str; 4] =
    [concat!("/ho", "me/"), concat!("/ro", "ot/"), concat!("/wo", "rk/"), concat!("/Us", "ers/")];

pub(super) fn check(root: &Path, sources: &[Source], found: &mut Findings) -> Result<(), String> {
    for source in sources {
        for (number, line) in source.text.lines().enumerate() {
            for path in MACHINE.iter().filter(|p| starts_a_path(line, p)) {
                found.fault(format!("{}:{}: names `{path}`", source.path, number + 1));
            }
        }
        if source.path.ends_with(".md") {
            dead_links(root, source, found);
        }
    }
    Ok(())
}

/// Whether `prefix` stands in the line as the beginning of a path, not inside a longer one or an address.
fn starts_a_path(line: &str, prefix: &str) -> bool {
    line.match_indices(prefix).any(|(at, _)| {
        !line[..at].ends_with(|c: char| c.is_alphanumeric() || matches!(c, '.' | '-' | '_' | '~' | '}'))
    })
}

/// `[text](target)` where the target is a file that does not exist.
fn dead_links(root: &Path, source: &Source, found: &mut Findings) {
    let folder = root.join(&source.path);
    let folder = folder.parent().unwrap_or(root);
    for (number, line) in source.text.lines().enumerate() {
        for target in line.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let file = target.split('#').next().unwrap_or_default();
            if !file.is_empty() && !file.contains("://") && !folder.join(file).exists() {
                found.fault(format!("{}:{}: links to `{file}`, which is not there", source.path, number + 1));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::source;
    use super::*;

    #[test]
    fn machine_paths_and_dead_links_are_found() {
        let bad = concat!("see /ho", "me/someone/x");
        let fine = concat!("https://example.org/ho", "me/page ../ho", "me/x");
        let text =
            format!("{bad}\n{fine}\n[there](lib.rs) [gone](nowhere.md#part) [web](https://example.org)");
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut found = Findings::default();
        check(&root, &[source("A.md", &text)], &mut found).expect("nothing is read");
        assert_eq!(found.faults.len(), 2, "{:?}", found.faults);
        assert!(found.faults[0].starts_with("A.md:1: names"));
        assert!(found.faults[1].contains("`nowhere.md`"));
    }
}

//! "Did you mean": the nearest of a list of names.

/// Damerau-Levenshtein distance (optimal string alignment): insertions, deletions, substitutions and swaps of neighbours.
fn distance(a: &[u8], b: &[u8]) -> usize {
    let mut before = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let differs = usize::from(a[i - 1] != b[j - 1]);
            row[j] = (last[j] + 1).min(row[j - 1] + 1).min(last[j - 1] + differs);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        before = core::mem::replace(&mut last, row);
    }
    last[b.len()]
}

/// The name nearest to `word`, where one is near enough to be meant: a quarter of its letters may differ.
pub fn nearest<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = word.to_ascii_lowercase();
    // Long words are no slips of the finger, and the distance costs the product of the lengths.
    if lower.len() > 64 {
        return None;
    }
    names
        .into_iter()
        .map(|n| (distance(lower.as_bytes(), n.to_ascii_lowercase().as_bytes()), n))
        .filter(|&(d, n)| {
            let len = n.len().max(lower.len());
            d <= (len / 4).clamp(1, 4) && d < len
        })
        .min_by_key(|&(d, _)| d)
        .map(|(_, n)| n)
}

/// More names than this are not listed.
const MAX_LISTED: usize = 20;

/// What to do about an unknown name: `did you mean "x"?`, or a list of what is known where nothing is near.
pub fn remedy<'a>(word: &str, names: impl IntoIterator<Item = &'a str> + Clone) -> String {
    match nearest(word, names.clone()) {
        Some(n) => format!("did you mean \"{n}\"?"),
        None => {
            let mut all: Vec<&str> = names.into_iter().filter(|n| !n.is_empty()).collect();
            all.sort_unstable();
            all.dedup();
            let n = all.len();
            match n {
                0 => "define it".to_string(),
                _ if n > MAX_LISTED => {
                    format!("known are {} and {} more", all[..MAX_LISTED].join(", "), n - MAX_LISTED)
                }
                _ => format!("known are {}", all.join(", ")),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_counts_edits_and_swaps() {
        let d = |a: &str, b: &str| distance(a.as_bytes(), b.as_bytes());
        assert_eq!(d("roughness", "roughness"), 0);
        assert_eq!(d("roughnes", "roughness"), 1);
        assert_eq!(d("rougnhess", "roughness"), 1);
        assert_eq!(d("", "abc"), 3);
        assert_eq!(d("kitten", "sitting"), 3);
    }

    #[test]
    fn nearest_offers_what_was_meant_and_nothing_far_off() {
        let names = ["reflectance", "roughness", "eta", "k"];
        assert_eq!(nearest("reflectence", names), Some("reflectance"));
        assert_eq!(nearest("Roughness", names), Some("roughness"));
        assert_eq!(nearest("displacement", names), None);
        assert_eq!(nearest("z", names), None);
    }

    #[test]
    fn remedy_lists_what_is_known() {
        assert_eq!(remedy("zzzzzz", ["b", "a"]), "known are a, b");
        assert_eq!(remedy("shpere", ["disk", "sphere"]), "did you mean \"sphere\"?");
    }
}

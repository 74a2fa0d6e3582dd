//! "Did you mean": the nearest of a list of names.

/// Damerau-Levenshtein distance (optimal string alignment): insertions, deletions, substitutions and swaps of neighbours.
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let mut d = (last[j + 1] + 1).min(row[j] + 1).min(last[j] + usize::from(a[i] != b[j]));
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                d = d.min(before[j - 1] + 1);
            }
            row.push(d);
        }
        before = core::mem::replace(&mut last, row);
    }
    last[b.len()]
}

/// What to do about an unknown name: the nearest, where one is near enough to be meant, else all that are known.
pub(crate) fn remedy(word: &str, names: &[&str]) -> String {
    let near = |n: &&&str| distance(word, n) <= (n.len().max(word.len()) / 4).clamp(1, 4);
    // Long words are no slips of the finger.
    let best = names.iter().filter(|_| word.len() <= 64).filter(near).min_by_key(|n| distance(word, n));
    match best {
        Some(n) => format!("did you mean `{n}`?"),
        None => format!("known are {}", names.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_found_and_strangers_are_not() {
        let names = ["alpha", "eta", "roughness"];
        assert_eq!(remedy("alpah", &names), "did you mean `alpha`?");
        assert_eq!(remedy("rougness", &names), "did you mean `roughness`?");
        assert_eq!(remedy("colour", &names), "known are alpha, eta, roughness");
        assert_eq!(distance("kitten", "sitting"), 3);
    }
}

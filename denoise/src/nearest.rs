//! Names in the order in which they were probably meant.

/// The names, the likeliest to be meant first; among equals the order stays.
pub(crate) fn nearest_first(name: &str, known: impl Iterator<Item = &'static str>) -> Vec<&'static str> {
    let mut known: Vec<&str> = known.collect();
    known.sort_by_key(|candidate| edit_distance(name, candidate));
    known
}

/// Insertions, deletions and replacements between two words (Levenshtein 1966). Only the first 32
/// characters of `a` count, so that a long word costs nothing.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().take(32).enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(ca != *cb);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

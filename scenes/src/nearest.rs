//! Known names, nearest first, for messages about unknown ones.

/// Names that a message lists.
const MAX_LISTED: usize = 40;

/// `did you mean "diffuse"? known types: diffuse, dielectric, …`
///
/// The first clause only where a name is near enough to be meant.
pub(crate) fn suggest<'a>(unknown: &str, what: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let mut ranked: Vec<_> = known.into_iter().map(|name| (distance(unknown, name), name)).collect();
    ranked.sort();
    ranked.dedup();
    let Some(&(nearest, best)) = ranked.first() else {
        return format!("remove it: there are no {what}");
    };
    let mut list = ranked.iter().take(MAX_LISTED).map(|(_, name)| *name).collect::<Vec<_>>().join(", ");
    if ranked.len() > MAX_LISTED {
        list += ", …";
    }
    if nearest <= 1 + best.chars().count() / 3 {
        format!("did you mean \"{best}\"? known {what}: {list}")
    } else {
        format!("known {what}: {list}")
    }
}

/// Edit distance of Levenshtein 1966, without regard to capitals. Only the first 64 characters count, which bounds the work.
fn distance(a: &str, b: &str) -> usize {
    let chars = |s: &str| s.chars().take(64).flat_map(char::to_lowercase).collect::<Vec<_>>();
    let (a, b) = (chars(a), chars(b));
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(ca != cb);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_name_comes_first() {
        let text = suggest("difuse", "types", ["conductor", "dielectric", "diffuse"]);
        assert!(text.starts_with("did you mean \"diffuse\"? known types: diffuse, "), "{text}");
    }

    #[test]
    fn nothing_is_suggested_for_a_far_name() {
        assert_eq!(suggest("xyzzy", "types", ["conductor"]), "known types: conductor");
    }

    #[test]
    fn long_lists_end_in_dots() {
        let names: Vec<String> = (0..100).map(|i| format!("name{i:02}")).collect();
        let text = suggest("name55", "names", names.iter().map(String::as_str));
        assert!(text.starts_with("did you mean \"name55\"?") && text.ends_with(", …"), "{text}");
        assert_eq!(text.matches("name").count(), 2 + MAX_LISTED, "{text}"); // with "known names"
    }

    #[test]
    fn edit_distance_counts_insertions_deletions_and_substitutions() {
        assert_eq!(distance("kitten", "sitting"), 3);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("Sphere", "sphere"), 0);
    }
}

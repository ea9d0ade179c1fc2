//! A look at XML text before it is parsed: what would cost more than it is worth is refused.

/// Elements inside one another. Real files have about 8.
const MAX_DEPTH: usize = 64;
/// Attributes of one element. Real files have at most 6.
const MAX_ATTRIBUTES: usize = 32;
/// Namespace declarations in a file. Real files have none.
const MAX_NAMESPACES: usize = 16;

/// Checks nesting, attributes and namespaces; the parser takes quadratic time or memory in each of them.
///
/// # Errors
///
/// The byte offset and what is there. Text that is no XML may pass: the parser will say so.
pub(super) fn check(text: &str) -> Result<(), (usize, String)> {
    let bytes = text.as_bytes();
    let (mut depth, mut namespaces) = (0usize, 0usize);
    let mut at = 0;
    while let Some(open) = find(text, at, "<") {
        let rest = &text[open..];
        let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
        if let Some((_, end)) = skipped.iter().find(|(start, _)| rest.starts_with(start)) {
            let Some(end) = find(text, open + 2, end) else { return Ok(()) };
            at = end + 1;
            continue;
        }
        let tag = scan_tag(bytes, open);
        if tag.attributes > MAX_ATTRIBUTES {
            return Err((open, format!("an element with more than {MAX_ATTRIBUTES} attributes")));
        }
        namespaces += rest[..tag.end - open].matches("xmlns").count();
        if namespaces > MAX_NAMESPACES {
            return Err((open, format!("more than {MAX_NAMESPACES} namespaces")));
        }
        if rest.starts_with("</") {
            depth = depth.saturating_sub(1);
        } else if !tag.is_empty {
            depth += 1;
            if depth > MAX_DEPTH {
                return Err((open, format!("elements nested more than {MAX_DEPTH} deep")));
            }
        }
        at = tag.end;
    }
    Ok(())
}

struct Tag {
    attributes: usize,
    /// Ends with `/>`.
    is_empty: bool,
    end: usize,
}

/// Goes to the end of the tag at `open`, over quoted values.
fn scan_tag(bytes: &[u8], open: usize) -> Tag {
    let mut tag = Tag { attributes: 0, is_empty: false, end: bytes.len() };
    let mut quote = None;
    for (i, &byte) in bytes.iter().enumerate().skip(open + 1) {
        match (quote, byte) {
            (Some(end), _) if byte == end => quote = None,
            (Some(_), _) => {}
            (None, b'"' | b'\'') => {
                quote = Some(byte);
                tag.attributes += 1;
            }
            (None, b'>') => {
                tag.is_empty = bytes[i - 1] == b'/';
                tag.end = i + 1;
                return tag;
            }
            _ => {}
        }
    }
    tag
}

fn find(text: &str, from: usize, what: &str) -> Option<usize> {
    Some(from + text.get(from..)?.find(what)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ordinary_files_pass() {
        let text =
            "<?xml version=\"1.0\"?><!-- <a><b> --><scene a='>'>\n<x y=\"</scene>\"/><![CDATA[<<<]]></scene>";
        assert_eq!(check(text), Ok(()));
        assert_eq!(check("no < xml at \" all"), Ok(()));
        assert_eq!(check("<!-- é open"), Ok(()));
        let siblings = format!("<scene>{}</scene>", "<a><b/></a>".repeat(1000));
        assert_eq!(check(&siblings), Ok(()));
    }

    #[test]
    fn what_the_parser_handles_badly_is_refused_where_it_stands() {
        let deep = "<a>".repeat(100_000);
        assert_eq!(check(&deep).unwrap_err().0, 64 * 3);
        let attributes: String = (0..40).map(|i| format!(" a{i}=''")).collect();
        assert_eq!(check(&format!("<x/><b{attributes}/>")).unwrap_err().0, 4);
        let namespaces = "<a xmlns:b='c'/>".repeat(17);
        assert!(check(&namespaces).unwrap_err().1.contains("namespaces"));
    }
}

//! What tests of several modules use.

/// Copies of `original` with a few bytes changed, lost, doubled or moved; always the same ones.
pub(crate) fn mutations(original: &[u8], count: usize) -> impl Iterator<Item = Vec<u8>> {
    // SplitMix64 (Steele et al. 2014)
    let mut state = original.len() as u64;
    let mut below = move |n: usize| {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % n.max(1) as u64) as usize
    };
    (0..count).map(move |_| {
        let mut bytes = original.to_vec();
        for _ in 0..=below(3) {
            let at = below(bytes.len());
            let end = (at + below(12)).min(bytes.len());
            match below(6) {
                0 => bytes.truncate(at),
                1 => drop(bytes.drain(at..end)),
                2 => {
                    let piece = bytes[at..end].to_vec();
                    let to = below(bytes.len());
                    bytes.splice(to..to, piece);
                }
                3 => {
                    // what numbers and markup are made of
                    let word = [
                        &b"-"[..],
                        b"9999999999",
                        b"nan",
                        b"1e39",
                        b"<",
                        b"\"",
                        b"$",
                        b"\xff\xff\xff\xff",
                        b"\0",
                    ];
                    bytes.splice(at..at, word[below(word.len())].iter().copied());
                }
                _ => {
                    if let Some(byte) = bytes.get_mut(at) {
                        *byte ^= 1 << below(8);
                    }
                }
            }
        }
        bytes
    })
}

//! The first four dimensions of the Sobol sequence and their Owen scrambling by a hash.
//!
//! Numbers are 32-bit binary fractions. *Reversed* means that bit 0 is the most significant digit: the form in which the
//! generator matrices and the scrambling work, so that most bit reversals cancel.

/// What each byte of the index contributes to dimension 3, reversed; direction numbers of Joe and Kuo 2008.
static DIM3: [[u32; 256]; 4] = byte_tables(&matrix(&[1, 3], 0b1));
/// The same for dimension 4.
static DIM4: [[u32; 256]; 4] = byte_tables(&matrix(&[1, 3, 1], 0b01));

/// Dimensions 1 and 2 of point `index`, reversed: van der Corput, and the matrix of Pascal's triangle modulo 2.
#[inline]
pub fn first_pair(index: u32) -> [u32; 2] {
    // Digit i of the second number is the sum of the index bits j with i ⊂ j as sets of bits (Lucas), which is a
    // product over the five bits of j.
    let mut y = index;
    y ^= (y >> 1) & 0x5555_5555;
    y ^= (y >> 2) & 0x3333_3333;
    y ^= (y >> 4) & 0x0f0f_0f0f;
    y ^= (y >> 8) & 0x00ff_00ff;
    y ^= y >> 16;
    [index, y]
}

/// Dimensions 3 and 4, reversed.
#[inline]
pub fn second_pair(index: u32) -> [u32; 2] {
    [multiply(&DIM3, index), multiply(&DIM4, index)]
}

#[inline]
fn multiply(tables: &[[u32; 256]; 4], index: u32) -> u32 {
    let [a, b, c, d] = index.to_le_bytes();
    tables[0][a as usize] ^ tables[1][b as usize] ^ tables[2][c as usize] ^ tables[3][d as usize]
}

/// Owen scrambling of a reversed number: each digit is flipped by a hash of the digits before it (Laine and
/// Karras 2011; this permutation: Vegdahl 2021, "Building a better LK hash").
#[inline]
pub fn scramble_reversed(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

/// Owen scrambling of a number that is not reversed; of an index, it shuffles every aligned block of 2^k indices
/// among such blocks and within, so that nets stay nets (Burley 2020).
#[inline]
pub fn scramble(x: u32, seed: u32) -> u32 {
    scramble_reversed(x.reverse_bits(), seed).reverse_bits()
}

/// Columns of a generator matrix, reversed, from the first direction numbers `m` and the coefficients of the primitive
/// polynomial between its highest and its lowest (Bratley and Fox 1988).
const fn matrix(m: &[u32], coefficients: u32) -> [u32; 32] {
    let degree = m.len();
    // Direction number j as a fraction: m_j / 2^j.
    let mut v = [0u32; 32];
    let mut j = 0;
    while j < 32 {
        if j < degree {
            v[j] = m[j] << (31 - j);
        } else {
            let mut x = v[j - degree] ^ (v[j - degree] >> degree);
            let mut k = 1;
            while k < degree {
                if (coefficients >> (degree - 1 - k)) & 1 == 1 {
                    x ^= v[j - k];
                }
                k += 1;
            }
            v[j] = x;
        }
        j += 1;
    }
    let mut j = 0;
    while j < 32 {
        v[j] = v[j].reverse_bits();
        j += 1;
    }
    v
}

const fn byte_tables(columns: &[u32; 32]) -> [[u32; 256]; 4] {
    let mut tables = [[0; 256]; 4];
    let mut byte = 0;
    while byte < 4 {
        let mut value = 0;
        while value < 256 {
            let mut bit = 0;
            while bit < 8 {
                if (value >> bit) & 1 == 1 {
                    tables[byte][value] ^= columns[8 * byte + bit];
                }
                bit += 1;
            }
            value += 1;
        }
        byte += 1;
    }
    tables
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_points_are_those_of_joe_and_kuo() {
        // From the definition: point 2^j has the direction numbers m_{j+1} / 2^{j+1}.
        let fraction = |x: u32| x.reverse_bits() as f64 / 4294967296.0;
        let point = |i| {
            let ([a, b], [c, d]) = (first_pair(i), second_pair(i));
            [a, b, c, d].map(fraction)
        };
        assert_eq!(point(0), [0.0; 4]);
        assert_eq!(point(1), [0.5; 4]);
        assert_eq!(point(2), [0.25, 0.75, 0.75, 0.75]);
        assert_eq!(point(4), [0.125, 0.625, 0.375, 0.125]);
        assert_eq!(point(7), [0.875, 0.875, 0.125, 0.375]);
    }

    #[test]
    fn second_dimension_is_pascals_triangle() {
        for j in 0..32 {
            let column = first_pair(1 << j)[1];
            let truth = (0..=j).filter(|i| i & !j == 0).fold(0, |x: u32, i| x | 1 << i);
            assert_eq!(column, truth, "column {j}");
        }
    }

    #[test]
    fn scrambling_is_a_nested_permutation() {
        // Digit k of the result depends on digits 0..=k alone, and flips with digit k.
        for seed in [0, 1, 0x9e37_79b9, u32::MAX] {
            for x in [0u32, 5, 0x1234_5678, u32::MAX] {
                for bit in 0..32 {
                    let changed = scramble_reversed(x, seed) ^ scramble_reversed(x ^ (1 << bit), seed);
                    assert_eq!(changed.trailing_zeros(), bit);
                }
            }
        }
    }
}

use std::path::Path;
use std::process::Command;

use proptest::prelude::*;

use super::*;
use crate::testing::Random;
use crate::{Fault, Frame};

fn random_record(random: &mut Random) -> SampleRecord {
    let mut rgb = || std::array::from_fn(|_| (2.0 * random.normal()).exp() as f32);
    let [diffuse, specular, emission, albedo] = std::array::from_fn(|_| rgb());
    let hit = f32::from(random.uniform() < 0.7);
    SampleRecord {
        diffuse,
        specular,
        emission,
        albedo,
        normal: std::array::from_fn(|_| random.normal() as f32),
        position: std::array::from_fn(|_| 10.0 * random.normal() as f32),
        depth: hit * (1.0 + random.uniform() as f32),
        hit,
        offset: std::array::from_fn(|_| random.uniform() as f32 - 0.5),
    }
}

/// A tile of random samples.
fn tile(origin: (usize, usize), size: (usize, usize), film: (usize, usize), spp: usize) -> RecordTile {
    let mut random = Random::new(31 + origin.0 as u64);
    let mut tile = RecordTile::new(origin, size, film, spp);
    for s in 0..spp {
        for y in 0..size.1 {
            for x in 0..size.0 {
                tile.set(s, x, y, &random_record(&mut random));
            }
        }
    }
    tile
}

#[test]
fn a_sample_is_read_where_it_was_set() {
    let mut random = Random::new(32);
    let mut tile = RecordTile::new((4, 8), (3, 2), (100, 50), 5);
    let record = random_record(&mut random);
    tile.set(3, 2, 1, &record);
    for s in 0..5 {
        for y in 0..2 {
            for x in 0..3 {
                let expected = if (s, x, y) == (3, 2, 1) { record } else { SampleRecord::default() };
                assert_eq!(tile.get(s, x, y), expected);
            }
        }
    }
    // [sample, channel, y, x]: blue of sample 3 at (2, 1).
    let specular = tile.tensor("radiance.specular").expect("is there");
    assert_eq!(specular[((3 * 3 + 2) * 2 + 1) * 3 + 2], record.specular[2]);
    assert_eq!(tile.tensor("specular"), None);
}

#[test]
fn a_tile_comes_back_as_it_was_and_its_bytes_are_always_the_same() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let tile = tile((16, 8), (5, 4), (21, 12), 3);
    let path = tile.write(&folder.path().join("new/records")).expect("writes");
    assert_eq!(path.file_name().and_then(|n| n.to_str()), Some("tile_00008_00016.safetensors"));
    assert_eq!(RecordTile::read(&path).expect("reads"), tile);
    let bytes = std::fs::read(&path).expect("reads");
    for _ in 0..5 {
        tile.write(&folder.path().join("new/records")).expect("writes");
        assert_eq!(std::fs::read(&path).expect("reads"), bytes);
    }
}

#[test]
fn a_folder_below_a_file_is_the_calls_fault() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("file");
    std::fs::write(&file, b"x").expect("writes");
    let error = tile((0, 0), (1, 1), (1, 1), 1).write(&file.join("records")).expect_err("cannot be");
    assert!(matches!(error, FrameError::OutputPath { .. }), "{error:?}");
    assert_eq!(error.fault(), Fault::Input);
}

#[test]
fn files_that_are_no_records_are_refused_by_name() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.safetensors");
    let empty_header = b"\x02\0\0\0\0\0\0\0{}";
    let cases: [(&[u8], &str); 4] = [
        (b"", "empty"),
        (b"no header here", "no safetensors file"),
        (b"\xff\xff\xff\xff\xff\xff\xff\x7f{}", "no safetensors file"),
        (empty_header, "no records"),
    ];
    for (bytes, words) in cases {
        std::fs::write(&path, bytes).expect("writes");
        let message = RecordTile::read(&path).expect_err("is refused").to_string();
        assert!(message.contains("a.safetensors") && message.contains(words), "{message}");
    }
    let missing = RecordTile::read(&folder.path().join("missing")).expect_err("is missing");
    assert!(matches!(missing, FrameError::CannotRead { .. }), "{missing:?}");
}

proptest! {
    #[test]
    fn a_damaged_file_gives_a_tile_or_an_error(changes in prop::collection::vec((0_usize..1400, any::<u8>()), 1..4), cut in 0_usize..3000) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = tile((0, 0), (2, 2), (2, 2), 1).write(folder.path()).expect("writes");
        let mut bytes = std::fs::read(path).expect("reads");
        for (at, byte) in changes {
            let at = at % bytes.len();
            bytes[at] = byte;
        }
        bytes.truncate(cut.max(1));
        if let Ok(tile) = decode(&bytes) {
            let values: usize = tile.tensors.iter().map(Vec::len).sum();
            prop_assert!(values * 4 <= bytes.len());
        }
    }
}

/// The mean over the samples in double precision and in their order, as the frame's layers are made.
fn means(tiles: &[RecordTile], film: (usize, usize)) -> Frame {
    let mut frame = Frame::new(film.0, film.1);
    for (c, name) in ["R", "G", "B"].into_iter().enumerate() {
        let mut plane = vec![0.0; film.0 * film.1];
        for tile in tiles {
            for y in 0..tile.height {
                for x in 0..tile.width {
                    let samples = (0..tile.spp).map(|s| tile.get(s, x, y));
                    let sum: f64 = samples
                        .map(|r| {
                            f64::from(r.diffuse[c]) + f64::from(r.specular[c]) + f64::from(r.emission[c])
                        })
                        .sum();
                    plane[(tile.y + y) * film.0 + tile.x + x] = (sum / tile.spp as f64) as f32;
                }
            }
        }
        frame.insert(name, plane);
    }
    frame
}

#[test]
fn the_python_example_sums_a_folder_to_the_beauty() {
    if !Command::new("python3").args(["-c", "import numpy"]).output().is_ok_and(|o| o.status.success()) {
        println!("skipped: no python3 with numpy");
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let film = (7, 5);
    let tiles = [
        tile((0, 0), (4, 4), film, 9),
        tile((4, 0), (3, 4), film, 9),
        tile((0, 4), (4, 1), film, 9),
        tile((4, 4), (3, 1), film, 9),
    ];
    for tile in &tiles {
        tile.write(folder.path()).expect("writes");
    }
    let out = folder.path().join("beauty.npy");
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/records.py");
    let run = Command::new("python3").arg(example).arg(folder.path()).arg(&out).output().expect("runs");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));

    // An npy file of version 1: a header of the length at byte 8, then rows of pixels of channels.
    let npy = std::fs::read(out).expect("reads");
    let header = 10 + usize::from(u16::from_le_bytes([npy[8], npy[9]]));
    assert!(String::from_utf8_lossy(&npy[10..header]).contains("(5, 7, 3)"));
    let (values, _) = npy[header..].as_chunks::<4>();
    let expected = means(&tiles, film);
    for (i, value) in values.iter().enumerate() {
        let ours = expected.rgb().expect("has it")[i % 3][i / 3];
        let theirs = f32::from_le_bytes(*value);
        let ulps = ours.to_bits().abs_diff(theirs.to_bits());
        assert!(ulps <= 1, "value {i}: {ours} {theirs}");
    }
    assert_eq!(values.len(), 7 * 5 * 3);
}

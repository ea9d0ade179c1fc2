use std::io::Cursor;
use std::path::{Path, PathBuf};

use exr::prelude::*;
use proptest::prelude::*;

use super::read::{Problem, decode};
use super::*;
use crate::testing::Random;
use crate::{Fault, Frame, FrameError, Layer, Statistic};

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// A frame of noise in several layers, with metadata.
fn sample_frame(width: usize, height: usize) -> Frame {
    let mut random = Random::new(21);
    let mut frame = Frame::new(width, height);
    for layer in [Layer::Beauty, Layer::Normal, Layer::Depth] {
        for statistic in [Statistic::Mean, Statistic::Variance] {
            for name in layer.channel_names(statistic) {
                frame.insert(name, (0..width * height).map(|_| random.normal() as f32).collect());
            }
        }
    }
    frame.metadata.insert("limpid:scene".to_owned(), "Küche 台所 \u{1f373}".to_owned());
    frame.metadata.insert("limpid:settings".to_owned(), "{\"spp\": 64}".to_owned());
    frame.metadata.insert("owner".to_owned(), "nobody".to_owned());
    frame.metadata.insert("limpid:a name of more than thirty-one bytes".to_owned(), String::new());
    frame
}

fn same_bits(a: &Frame, b: &Frame) -> bool {
    let bits = |frame: &Frame| -> Vec<(String, Vec<u32>)> {
        frame.channels().map(|(n, p)| (n.to_owned(), p.iter().map(|v| v.to_bits()).collect())).collect()
    };
    (a.width(), a.height(), &a.metadata) == (b.width(), b.height(), &b.metadata) && bits(a) == bits(b)
}

#[test]
fn a_frame_comes_back_as_it_was() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    for (width, height) in [(1, 1), (37, 53), (16, 16), (5, 33)] {
        let frame = sample_frame(width, height);
        write_exr(&frame, &path).expect("writes");
        assert!(same_bits(&read_exr(&path).expect("reads"), &frame), "{width}x{height}");
    }
}

#[test]
fn the_same_frame_gives_the_same_bytes_for_1_and_8_threads() {
    let folder = folder();
    let frame = sample_frame(64, 300);
    let write = |threads: usize| {
        let path = folder.path().join(format!("{threads}.exr"));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| write_exr(&frame, &path)).expect("writes");
        std::fs::read(path).expect("reads")
    };
    let one = write(1);
    assert_eq!(one, write(8));
    assert_eq!(one, write(1)); // nor does the order of a hash map show
}

proptest! {
    #[test]
    fn any_bits_survive_the_file(
        (width, height) in (1_usize..20, 1_usize..40),
        seed in any::<u64>(),
        special in prop::collection::vec(prop::num::f32::ANY, 1..20),
    ) {
        let mut random = Random::new(seed);
        let mut frame = Frame::new(width, height);
        for name in ["R", "x.y.z", "Z"] {
            let any = |_| match random.bits() % 3 {
                0 => special[random.bits() as usize % special.len()],
                1 => f32::from_bits(random.bits() as u32),
                _ => 1.0,
            };
            frame.insert(name, (0..width * height).map(any).collect());
        }
        let folder = folder();
        let path = folder.path().join("a.exr");
        write_exr(&frame, &path).expect("writes");
        prop_assert!(same_bits(&read_exr(&path).expect("reads"), &frame));
    }
}

#[test]
fn hc45_what_is_not_finite_keeps_its_class_in_float_and_half() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let values = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -0.0, 1e-45, 0.5];
    let mut frame = Frame::new(6, 1);
    frame.insert("R", values.to_vec());
    write_exr(&frame, &path).expect("writes");
    assert!(same_bits(&read_exr(&path).expect("reads"), &frame));
    assert_eq!(write_exr_half(&frame, &path).expect("writes"), Vec::<String>::new());
    let half = read_exr(&path).expect("reads");
    let half = half.channel("R").expect("is there");
    assert!(half[0].is_nan());
    assert_eq!(half[1..], [f32::INFINITY, f32::NEG_INFINITY, -0.0, 0.0, 0.5]);
    assert!(half[3].is_sign_negative());
}

#[test]
fn hc44_a_layer_that_does_not_fit_in_half_is_kept_in_float() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let fits = vec![65504.0, 65519.0, 6e-8, 0.1];
    let mut frame = Frame::new(4, 1);
    for name in ["R", "G", "B", "emission.R", "emission.G"] {
        frame.insert(name, fits.clone());
    }
    frame.insert("emission.B", vec![65520.0, 70000.0, 1e6, 0.1]);
    let kept = write_exr_half(&frame, &path).expect("writes");
    assert_eq!(kept, ["emission.B", "emission.G", "emission.R"]);
    let read = read_exr(&path).expect("reads");
    assert_eq!(read.channel("emission.B"), frame.channel("emission.B"));
    let r = read.channel("R").expect("is there");
    assert_eq!(r[..2], [65504.0, 65504.0]);
    assert_eq!(r[2], 2.0_f32.powi(-24)); // the smallest half, 5.96e-8
    assert!((r[3] - 0.1).abs() < 1e-4 && r[3] != 0.1, "{}", r[3]);
}

/// Writes layers with the exr crate's own writer.
fn write_with_crate(path: &Path, layers: Vec<exr::image::Layer<AnyChannels<FlatSamples>>>) {
    let bounds = IntegerBounds::from_dimensions(layers[0].size);
    let image = Image::from_layers(ImageAttributes::new(bounds), layers);
    image.write().to_file(path).expect("writes");
}

fn layer(
    name: Option<&str>,
    size: (usize, usize),
    encoding: Encoding,
    channels: Vec<AnyChannel<FlatSamples>>,
) -> exr::image::Layer<AnyChannels<FlatSamples>> {
    let attributes = LayerAttributes {
        layer_name: name.map(Text::from),
        layer_position: Vec2(-3, 1000),
        comments: Some(Text::from("by the crate")),
        ..LayerAttributes::default()
    };
    exr::image::Layer::new(size, attributes, encoding, AnyChannels::sort(channels.into()))
}

const COMPRESSIONS: [Compression; 10] = [
    Compression::Uncompressed,
    Compression::RLE,
    Compression::ZIP1,
    Compression::ZIP16,
    Compression::PIZ,
    Compression::PXR24,
    Compression::B44,
    Compression::B44A,
    Compression::DWAA(None),
    Compression::DWAB(None),
];

#[test]
fn other_types_tiles_orders_and_offset_windows_are_read() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let size = (70, 41);
    let n = size.0 * size.1;
    let floats: Vec<f32> = (0..n).map(|i| i as f32 * 0.25).collect();
    let halves: Vec<f16> = (0..n).map(|i| f16::from_f32((i % 1000) as f32)).collect();
    let integers: Vec<u32> = (0..n as u32).collect();
    for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(16, 32))] {
        for line_order in [LineOrder::Increasing, LineOrder::Decreasing] {
            for compression in
                [Compression::Uncompressed, Compression::RLE, Compression::ZIP1, Compression::PIZ]
            {
                let encoding = Encoding { compression, blocks, line_order };
                let channels = vec![
                    AnyChannel::new("ViewLayer.Combined.R", FlatSamples::F32(floats.clone())),
                    AnyChannel::new("h", FlatSamples::F16(halves.clone())),
                    AnyChannel::new("id", FlatSamples::U32(integers.clone())),
                ];
                write_with_crate(&path, vec![layer(Some("only"), size, encoding, channels)]);
                let frame = read_exr(&path).expect("reads");
                assert_eq!((frame.width(), frame.height()), size);
                assert_eq!(frame.channel("ViewLayer.Combined.R").expect("is there"), floats);
                let h = frame.channel("h").expect("is there");
                assert!(h.iter().enumerate().all(|(i, v)| *v == (i % 1000) as f32));
                let id = frame.channel("id").expect("is there");
                assert!(id.iter().enumerate().all(|(i, v)| *v == i as f32));
                assert_eq!(frame.metadata.get("comments").map(String::as_str), Some("by the crate"));
            }
        }
    }
}

#[test]
fn pictures_of_other_programs_are_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/scenes/mitsuba");
    let pictures = [("cornell-box/TungstenRender.exr", 1024, 1024), ("hetvol/hetvol.exr", 768, 576)];
    for (name, width, height) in pictures {
        let path = folder.join(name);
        if !path.exists() {
            println!("skipped: no {}", path.display());
            continue;
        }
        let frame = read_exr(&path).expect("reads");
        assert_eq!((frame.width(), frame.height()), (width, height));
        let rgb = frame.rgb().expect("has colour");
        assert!(rgb.iter().all(|plane| plane.iter().all(|v| v.is_finite() && *v >= 0.0)));
        assert!(rgb.iter().all(|plane| plane.iter().any(|v| *v > 0.1)));
    }
}

fn grey(name: &str, n: usize, value: f32) -> AnyChannel<FlatSamples> {
    AnyChannel::new(name, FlatSamples::F32(vec![value; n]))
}

#[test]
fn parts_become_prefixes_but_for_the_beauty() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let part = |name, channels| layer(Some(name), (4, 3), Encoding::FAST_LOSSLESS, channels);
    let parts = vec![
        part("rgba", vec![grey("R", 12, 1.0)]),
        part("diffuse", vec![grey("R", 12, 2.0)]),
        part("albedo", vec![grey("albedo.R", 12, 3.0)]),
    ];
    write_with_crate(&path, parts);
    let frame = read_exr(&path).expect("reads");
    let channels: Vec<_> = frame.channels().map(|(name, plane)| (name, plane[0])).collect();
    assert_eq!(channels, [("R", 1.0), ("albedo.R", 3.0), ("diffuse.R", 2.0)]);
}

#[test]
fn parts_that_do_not_make_one_frame_are_refused() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let part = |name, (w, h)| layer(Some(name), (w, h), Encoding::FAST_LOSSLESS, vec![grey("R", w * h, 1.0)]);
    write_with_crate(&path, vec![part("a", (4, 3)), part("b", (2, 2))]);
    let message = read_exr(&path).expect_err("sizes differ").to_string();
    assert!(message.contains("4x3") && message.contains("2x2"), "{message}");
    write_with_crate(&path, vec![part("beauty", (4, 3)), part("rgb", (4, 3))]);
    let message = read_exr(&path).expect_err("names clash").to_string();
    assert!(message.contains("`R`"), "{message}");
}

#[test]
fn frames_that_exr_cannot_hold_are_refused_before_anything_is_written() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let with = |channel: &str, attribute: &str| {
        let mut frame = Frame::new(1, 1);
        frame.insert(channel, vec![0.0]);
        frame.metadata.insert(attribute.to_owned(), String::new());
        frame
    };
    let long = "x".repeat(256);
    let frames = [
        Frame::new(2, 2),
        Frame::new(0, 2),
        with("", "a"),
        with("nul\0", "a"),
        with(&long, "a"),
        with("R", "compression"),
        with("R", "name"),
        with("R", ""),
        with("R", &long),
    ];
    for frame in frames {
        let error = write_exr(&frame, &path).expect_err("cannot be held");
        assert!(matches!(error, FrameError::Unwritable { .. }), "{error:?}");
        assert!(!path.exists());
    }
    write_exr(&with(&long[..255], &long[..255]), &path).expect("255 bytes are allowed");
    assert!(read_exr(&path).expect("reads").metadata.contains_key(&long[..255]));
}

#[test]
fn files_that_are_no_exr_are_the_inputs_fault_and_named() {
    let folder = folder();
    let file = |name: &str, bytes: &[u8]| -> PathBuf {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("writes");
        path
    };
    write_exr(&sample_frame(20, 40), &folder.path().join("whole.exr")).expect("writes");
    let whole = std::fs::read(folder.path().join("whole.exr")).expect("reads");
    let cases = [
        (file("empty.exr", b""), "the file is empty"),
        (file("text.exr", b"not a picture at all"), "this is not an EXR file"),
        (file("magic.exr", &whole[..4]), "the EXR file is cut short"),
        (file("header.exr", &whole[..100]), "the EXR file is cut short"),
        (file("pixels.exr", &whole[..whole.len() - 1]), "the EXR file is cut short"),
        (folder.path().join("missing.exr"), "cannot be read"),
        (folder.path().to_owned(), "it is not a regular file"),
    ];
    for (path, words) in cases {
        let error = read_exr(&path).expect_err("is no EXR");
        assert_eq!(error.fault(), Fault::Input);
        let message = error.to_string();
        assert!(message.starts_with(&path.display().to_string()) && message.contains(words), "{message}");
    }
}

#[test]
fn hc46_a_hostile_header_is_refused_by_the_field() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let mut frame = Frame::new(3, 2);
    frame.insert("R", vec![0.0; 6]);
    write_exr(&frame, &path).expect("writes");
    let mut bytes = std::fs::read(&path).expect("reads");
    // Without the number of blocks, whose contradiction the crate would see first.
    let count = b"chunkCount\0int\0\x04\0\0\0\x01\0\0\0";
    let at = bytes.windows(count.len()).position(|w| w == count).expect("is there");
    bytes.drain(at..at + count.len());
    let window = b"dataWindow\0box2i\0\x10\0\0\0";
    let at = bytes.windows(window.len()).position(|w| w == window).expect("is there") + window.len();
    let corners = [
        ([0, 0, 32767, 32767], "dataWindow 32768x32768"),
        ([0, 0, i32::MAX - 1, i32::MAX - 1], "window size"),
        ([0, 0, i32::MAX - 1, 0], "window size"),
        ([0, 0, -1, 5], "dataWindow from (0, 0) to (-1, 5)"),
        ([0, 0, -2, 5], "dataWindow from (0, 0) to (-2, 5)"),
        ([i32::MIN, i32::MIN, i32::MAX, i32::MAX], "window"),
    ];
    for (corner, words) in corners {
        let mut hostile = bytes.clone();
        for (i, v) in corner.iter().enumerate() {
            hostile[at + 4 * i..at + 4 * i + 4].copy_from_slice(&v.to_le_bytes());
        }
        let start = std::time::Instant::now();
        match decode(Cursor::new(&hostile), hostile.len() as u64) {
            Err(Problem::Malformed(problem)) => assert!(problem.contains(words), "{corner:?}: {problem}"),
            other => panic!("{corner:?}: {other:?}"),
        }
        assert!(start.elapsed().as_secs_f64() < 0.1);
    }
}

#[test]
fn an_offset_table_past_the_end_or_pointing_twice_to_one_block_is_refused() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let frame = sample_frame(4, 40); // three blocks
    write_exr(&frame, &path).expect("writes");
    let bytes = std::fs::read(&path).expect("reads");
    // The first offset points behind the table: find the table by that.
    let table = (0..bytes.len() - 8)
        .find(|&i| u64::from_le_bytes(bytes[i..i + 8].try_into().expect("8 bytes")) == i as u64 + 24)
        .expect("is there");
    for offset in [u64::MAX, bytes.len() as u64, 0, u64::from(bytes[table])] {
        let mut broken = bytes.clone();
        broken[table + 8..table + 16].copy_from_slice(&offset.to_le_bytes());
        assert!(decode(Cursor::new(&broken), broken.len() as u64).is_err(), "{offset}");
    }
    let mut twice = bytes.clone();
    twice.copy_within(table..table + 8, table + 8);
    match decode(Cursor::new(&twice), twice.len() as u64) {
        Err(Problem::Malformed(problem)) => assert_eq!(problem, "1 of the EXR file's 3 blocks are missing"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_damaged_file_gives_a_picture_or_an_error() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let mut files = Vec::new();
    write_exr(&sample_frame(9, 20), &path).expect("writes");
    files.push(std::fs::read(&path).expect("reads"));
    let mut random = Random::new(22);
    for compression in COMPRESSIONS {
        for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(5, 4))] {
            let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
            let noise: Vec<f32> = (0..180).map(|_| random.normal() as f32).collect();
            let mut channels = vec![
                grey("G", 180, 0.3),
                AnyChannel::new("R", FlatSamples::F32(noise.clone())),
                AnyChannel::new("Y", FlatSamples::F16(noise.iter().map(|v| f16::from_f32(*v)).collect())),
            ];
            let parts = ["a", "b"].map(|name| layer(Some(name), (9, 20), encoding, channels.clone()));
            write_with_crate(&path, parts.into());
            files.push(std::fs::read(&path).expect("reads"));
            channels.truncate(1);
            write_with_crate(&path, vec![layer(None, (9, 20), encoding, channels)]);
            files.push(std::fs::read(&path).expect("reads"));
        }
    }
    for file in &files {
        decode(Cursor::new(file), file.len() as u64).expect("is whole");
    }
    let (mut readable, mut refused) = (0, 0);
    for round in 0..mutations() {
        let mut bytes = files[round % files.len()].clone();
        for _ in 0..1 + random.bits() % 4 {
            let at = random.bits() as usize % bytes.len();
            match random.bits() % 4 {
                0 => bytes[at] = random.bits() as u8,
                1 => bytes[at] ^= 1 << (random.bits() % 8),
                2 => {
                    let word = [0, 1, u32::MAX, i32::MAX as u32, i32::MIN as u32, 0x7f7f]
                        [random.bits() as usize % 6];
                    let end = (at + 4).min(bytes.len());
                    bytes[at..end].copy_from_slice(&word.to_le_bytes()[..end - at]);
                }
                _ => bytes.truncate(at.max(1)),
            }
        }
        match decode(Cursor::new(&bytes), bytes.len() as u64) {
            Ok(frame) => {
                assert!(frame.len() <= 1 << 24);
                readable += 1;
            }
            Err(_) => refused += 1,
        }
    }
    assert!(readable > 0 && refused > 0, "{readable} {refused}");
}

/// Rounds of damage; the environment may ask for more.
fn mutations() -> usize {
    std::env::var("LIMPID_MUTATIONS").ok().and_then(|n| n.parse().ok()).unwrap_or(3000)
}

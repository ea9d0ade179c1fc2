use std::io::Cursor;
use std::time::{Duration, Instant};

use ::exr::prelude::{AnyChannel, AnyChannels, FlatSamples, Image as ExrImage, WritableImage};
use ::image::{DynamicImage, ImageFormat, Rgb32FImage, RgbImage};

use super::*;
use crate::testing::mutations;

const BYTES: [u8; 18] = [255, 0, 128, 10, 20, 30, 0, 0, 0, 255, 255, 255, 1, 2, 3, 4, 5, 6];

fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// Three texels wide, two high.
fn picture() -> DynamicImage {
    RgbImage::from_raw(3, 2, BYTES.to_vec()).unwrap().into()
}

/// An EXR with these channels, the value of texel i of channel c being `i + 10 c`.
fn exr_file(names: &[&str]) -> Vec<u8> {
    let channel = |(c, name): (usize, &&str)| {
        let values = (0..6).map(|i| (i + 10 * c) as f32).collect();
        AnyChannel::new(*name, FlatSamples::F32(values))
    };
    let channels = AnyChannels::sort(names.iter().enumerate().map(channel).collect());
    let mut bytes = Cursor::new(Vec::new());
    ExrImage::from_channels((3, 2), channels).write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

#[test]
fn bytes_are_kept_and_marked_as_encoded_unless_raw() {
    for format in [ImageFormat::Png, ImageFormat::Bmp] {
        let file = encoded(&picture(), format);
        let srgb = decode(&file, false).unwrap();
        assert_eq!((srgb.width, srgb.height), (3, 2));
        assert_eq!(srgb.texels, Texels::Srgb8(BYTES.to_vec()));
        assert_eq!(decode(&file, true).unwrap().texels, Texels::Linear8(BYTES.to_vec()));
    }
    let Texels::Srgb8(texels) = decode(&encoded(&picture(), ImageFormat::Jpeg), false).unwrap().texels else {
        panic!()
    };
    assert_eq!(texels.len(), BYTES.len());
}

#[test]
fn grey_is_spread_alpha_dropped_and_sixteen_bits_kept() {
    let alpha = picture().to_rgba8();
    assert_eq!(
        decode(&encoded(&alpha.into(), ImageFormat::Png), false).unwrap().texels,
        Texels::Srgb8(BYTES.to_vec())
    );
    let grey = ::image::GrayImage::from_raw(2, 1, vec![7, 9]).unwrap();
    assert_eq!(
        decode(&encoded(&grey.into(), ImageFormat::Png), false).unwrap().texels,
        Texels::Srgb8(vec![7, 7, 7, 9, 9, 9])
    );
    let deep = ::image::ImageBuffer::<::image::Rgb<u16>, _>::from_raw(1, 1, vec![0u16, 257, 65535]).unwrap();
    let file = encoded(&deep.into(), ImageFormat::Png);
    let Texels::Linear32(linear) = decode(&file, false).unwrap().texels else { panic!() };
    let Texels::Linear32(raw) = decode(&file, true).unwrap().texels else { panic!() };
    assert!((raw[1] - 1.0 / 255.0).abs() < 1e-6 && (linear[1] - 1.0 / 255.0 / 12.92).abs() < 1e-7);
    assert_eq!((linear[0], linear[2]), (0.0, 1.0));
}

#[test]
fn radiance_files_are_linear_whether_raw_or_not() {
    let values = vec![0.5, 1.0, 0.25, 1024.0, 512.0, 0.0]; // a texel shares one exponent
    let file = encoded(&Rgb32FImage::from_raw(2, 1, values.clone()).unwrap().into(), ImageFormat::Hdr);
    assert_eq!(decode(&file, false).unwrap().texels, Texels::Linear32(values));
    assert_eq!(decode(&file, true).unwrap(), decode(&file, false).unwrap());
}

#[test]
fn exr_channels_are_found_by_name() {
    let texels = |names: &[&str]| decode(&exr_file(names), false).map(|image| image.texels);
    let interleaved = |offsets: [i32; 3]| {
        Texels::Linear32((0..6).flat_map(|i| offsets.map(|offset| (i + offset) as f32)).collect())
    };
    assert_eq!(texels(&["B", "G", "R"]).unwrap(), interleaved([20, 10, 0]));
    assert_eq!(texels(&["A", "B", "G", "R", "Z"]).unwrap(), interleaved([30, 20, 10]));
    assert_eq!(texels(&["Y"]).unwrap(), interleaved([0, 0, 0]));
    assert_eq!(texels(&["depth"]).unwrap(), interleaved([0, 0, 0]));
    assert!(texels(&["X", "Z"]).unwrap_err().contains("no layer has channels"));
}

#[test]
fn an_exr_that_announces_more_than_it_holds_is_refused_before_memory_is_taken() {
    let mut file = exr_file(&["B", "G", "R"]);
    // the high corner of the data window, and of the display window: 2, 1 become 2^27, 2^27
    let corner = [2i32.to_le_bytes(), 1i32.to_le_bytes()].concat();
    let places: Vec<usize> = (0..file.len() - 8).filter(|&i| file[i..i + 8] == corner).collect();
    assert!(!places.is_empty());
    for place in places {
        file[place..place + 8].copy_from_slice(&[0, 0, 0, 8, 0, 0, 0, 8]);
    }
    let problem = decode(&file, false).unwrap_err();
    assert!(problem.contains("cannot be in a file of"), "{problem}");
}

#[test]
fn a_png_that_announces_more_than_it_holds_is_refused_before_memory_is_taken() {
    let mut file = encoded(&picture(), ImageFormat::Png);
    file[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]); // 65536 x 65536; the checksum that follows is not reached
    assert!(decode(&file, false).is_err());
}

#[test]
fn other_content_is_named() {
    for bytes in [&b""[..], b"what", b"GIF89a"] {
        assert!(decode(bytes, false).unwrap_err().contains("not a PNG"), "{bytes:?}");
    }
}

#[test]
fn mutated_pictures_decode_or_fail_but_never_panic() {
    let start = Instant::now();
    let float = DynamicImage::from(picture().to_rgb32f());
    let files = [
        (encoded(&picture(), ImageFormat::Png), 3_000),
        (encoded(&picture(), ImageFormat::Jpeg), 3_000),
        (encoded(&picture(), ImageFormat::Bmp), 3_000),
        (encoded(&float, ImageFormat::Hdr), 3_000),
        (exr_file(&["B", "G", "R"]), 3_000),
    ];
    for (file, count) in files {
        let good = mutations(&file, count).filter(|mutated| decode(mutated, false).is_ok()).count();
        assert!(good < count, "the mutations are too tame");
    }
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
}

//! How the values of options are written. Each error says what is wrong and how to write it.

use std::path::PathBuf;

use limpid_denoise::{DenoiseError, Method};
use limpid_scenes::Crop;

/// Sums are exact up to this many samples a pixel.
pub const MAX_SPP: u32 = 1 << 24;
/// More threads than any machine has cores would only cost memory.
const MAX_THREADS: usize = 1024;

/// `--spp`
pub fn spp(text: &str) -> Result<u32, String> {
    match whole(text)? {
        0 => Err("need at least 1 sample; for a preview use `--spp 1`".into()),
        n if n > u64::from(MAX_SPP) => {
            Err(format!("at most {MAX_SPP} samples; for more average pictures of several `--seed`s"))
        }
        n => Ok(n as u32),
    }
}

/// `--threads`
pub fn threads(text: &str) -> Result<usize, String> {
    match usize::try_from(whole(text)?) {
        Ok(n @ 1..=MAX_THREADS) => Ok(n),
        _ => Err(format!("from 1 to {MAX_THREADS}; leave it out for all cores")),
    }
}

/// `--max-depth`
pub fn max_depth(text: &str) -> Result<u32, String> {
    match u32::try_from(whole(text)?) {
        Ok(0) => Err("such a path has no edge; 1 shows lights only, 2 direct light".into()),
        Ok(n) => Ok(n),
        Err(_) => Err("too long; leave it out for paths of any length".into()),
    }
}

/// `--size`: `640x360`
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let wrong = || "write width x height in pixels, such as `--size 640x360`".to_owned();
    let (w, h) = text.split_once(['x', 'X']).ok_or_else(wrong)?;
    match (w.parse(), h.parse()) {
        (Ok(0), Ok(_)) | (Ok(_), Ok(0)) => Err("need at least one pixel; such as `--size 640x360`".into()),
        (Ok(w), Ok(h)) => Ok([w, h]),
        _ => Err(wrong()),
    }
}

/// `--pixel`: `12,40`
pub fn pixel(text: &str) -> Result<[u32; 2], String> {
    numbers(text).ok_or_else(|| "write column,row from the top left, such as `--pixel 12,40`".into())
}

/// `--crop`: `0,0,64,64`
pub fn crop(text: &str) -> Result<Crop, String> {
    let wrong = "write x,y,width,height in pixels from the top left, such as `--crop 0,0,64,64`";
    match numbers(text).ok_or(wrong)? {
        [_, _, 0, _] | [_, _, _, 0] => Err("need at least one pixel; such as `--crop 0,0,64,64`".into()),
        [x, y, width, height] => Ok(Crop { x, y, width, height }),
    }
}

/// `--exposure`: beyond ±64 stops nothing but black and white is left.
pub fn exposure(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(ev) if ev.abs() <= 64.0 => Ok(ev),
        _ => Err("write a number of stops from -64 to 64, such as `--exposure 1.5`".into()),
    }
}

/// `--clamp`
pub fn clamp(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(bound) if bound > 0.0 && bound.is_finite() => Ok(bound),
        _ => Err("write a radiance above 0, such as `--clamp 10`; leave it out for no bound".into()),
    }
}

/// `-D`: `NAME=VALUE`
pub fn define(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() => Ok((name.to_owned(), value.to_owned())),
        _ => Err("write NAME=VALUE, such as `-D spp=64`".into()),
    }
}

/// `--denoise` and `--method`
pub fn method(text: &str) -> Result<&'static Method, DenoiseError> {
    limpid_denoise::by_name(text)
}

/// `-o`
pub fn exr_path(text: &str) -> Result<PathBuf, String> {
    path_with(text, "exr", "a frame is an EXR file; for a picture add `--png`")
}

/// `--png`
pub fn png_path(text: &str) -> Result<PathBuf, String> {
    path_with(text, "png", "a picture is a PNG file; for the frame use `-o`")
}

/// `export -o`
pub fn xml_path(text: &str) -> Result<PathBuf, String> {
    path_with(text, "xml", "a Mitsuba scene is an XML file")
}

/// A path whose extension, if it has one, is `extension`: `-o a.png` would be an EXR that no viewer takes for one.
fn path_with(text: &str, extension: &str, why: &str) -> Result<PathBuf, String> {
    if text == "-" {
        return Err("files appear when they are whole, which standard output cannot do; name a file".into());
    }
    let path = PathBuf::from(text);
    match path.extension() {
        Some(other) if !other.eq_ignore_ascii_case(extension) => {
            Err(format!("{why}, or name it `{}`", path.with_extension(extension).display()))
        }
        _ => Ok(path),
    }
}

fn whole(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| "not a whole number above 0".into())
}

fn numbers<const N: usize>(text: &str) -> Option<[u32; N]> {
    let all: Option<Vec<u32>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    all?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_the_help_writes_them() {
        assert_eq!(spp("64"), Ok(64));
        assert_eq!(size("640x360"), Ok([640, 360]));
        assert_eq!(pixel("12,40"), Ok([12, 40]));
        assert_eq!(crop("1, 2, 3, 4"), Ok(Crop { x: 1, y: 2, width: 3, height: 4 }));
        assert_eq!(exposure("-1.5"), Ok(-1.5));
        assert_eq!(define("a=b=c"), Ok(("a".into(), "b=c".into())));
    }

    #[test]
    fn what_makes_no_picture_is_refused_with_a_cure() {
        assert_eq!(spp("0"), Err("need at least 1 sample; for a preview use `--spp 1`".into()));
        for wrong in ["0x4", "4x0", "4", "x", "-4x4", "4x4x4", "4294967296x1"] {
            assert!(size(wrong).expect_err(wrong).contains("--size 640x360"), "{wrong}");
        }
        for wrong in ["", "0,0,0,1", "0,0,1,0", "1,2,3", "1,2,3,4,5", "-1,0,1,1"] {
            assert!(crop(wrong).expect_err(wrong).contains("--crop 0,0,64,64"), "{wrong}");
        }
        for wrong in ["nan", "inf", "65", ""] {
            assert!(exposure(wrong).is_err(), "{wrong}");
        }
        for wrong in ["nan", "inf", "0", "-1"] {
            assert!(clamp(wrong).is_err(), "{wrong}");
        }
        for wrong in ["0", "1025", "99999999999999999999", "-1", "two"] {
            assert!(threads(wrong).is_err(), "{wrong}");
        }
        assert!(define("=3").is_err());
        assert!(max_depth("0").is_err());
    }

    #[test]
    fn a_frame_is_not_given_the_name_of_a_picture() {
        assert!(exr_path("a.png").expect_err("is a PNG's name").contains("`a.exr`"));
        assert!(png_path("a.jpg").expect_err("is a JPEG's name").contains("`a.png`"));
        assert!(exr_path("-").expect_err("is no file").contains("name a file"));
        assert_eq!(exr_path("a.EXR"), Ok("a.EXR".into()));
        assert_eq!(exr_path("/dev/null"), Ok("/dev/null".into()));
    }
}

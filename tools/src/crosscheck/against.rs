//! `--against`: a picture of any renderer in Mitsuba's place.

use std::path::Path;

use limpid_frame::compare::{Estimate, Halves};
use limpid_frame::{Frame, FrameError, read_exr};
use limpid_renderer::Splat;

use crate::error::CliError;

/// A filter that reaches no farther than its pixel.
const OWN_PIXEL: f64 = 0.5;

/// The picture and the variance of its pixels, and what people should know about them.
///
/// A renderer that adds samples to every pixel in the filter's reach makes neighbours that vary together, which the
/// variances of the pixels do not say. They are scaled so that means over many pixels have the variance they should; and
/// the border is left out, where such a filter sees fewer samples than ours.
///
/// # Errors
///
/// Where the files are no such pictures, or have another size than the scene's.
pub fn picture(
    picture: &Path,
    variance: &Path,
    size: [usize; 2],
    splat: Splat,
) -> Result<(Halves, Vec<String>), CliError> {
    let mean = read_exr(picture)?;
    let var = if picture == variance { own_variance(picture, &mean)? } else { read_exr(variance)? };
    for (path, frame) in [(picture, &mean), (variance, &var)] {
        let of = |problem: String| CliError::File { path: path.to_owned(), problem };
        let found = [frame.width(), frame.height()];
        if found != size {
            return Err(of(format!(
                "has {}x{} pixels, and the scene {}x{}; set its size with `--size`",
                found[0], found[1], size[0], size[1]
            )));
        }
        frame.rgb().map_err(|error| of(error.to_string()))?;
    }
    let mut estimate = Estimate::of_frames(&mean, &var).map_err(|error: FrameError| CliError::File {
        path: variance.to_owned(),
        problem: error.to_string(),
    })?;
    let mut notes = Vec::new();
    if splat.radius > OWN_PIXEL && !is_ours(&mean) {
        let border = splat.radius.ceil() as usize;
        estimate.scale_variance(splat.correlation);
        if 2 * border < size[0].min(size[1]) {
            estimate.leave_out_border(border);
        }
        notes.push(format!(
            "the scene's pixel filter reaches {} pixels: neighbours in {} are taken to share samples, so its variance counts \
             {:.2} times and a border of {border} pixels is left out; its variance must come from independent passes",
            splat.radius,
            picture.display(),
            splat.correlation
        ));
    }
    Ok((Halves::One(Box::new(estimate)), notes))
}

/// The variance that a frame of limpid's has beside its picture: for a file that is named as its own variance.
fn own_variance(path: &Path, frame: &Frame) -> Result<Frame, CliError> {
    let mut variance = Frame::new(frame.width(), frame.height());
    for channel in ["R", "G", "B"] {
        let plane = frame.channel(&format!("variance.{channel}")).ok_or_else(|| CliError::File {
            path: path.to_owned(),
            problem: "has no variance beside its picture; render it with `--layers beauty.variance --sampler independent`, \
                      or name the file that has it"
                .into(),
        })?;
        variance.insert(channel, plane.to_vec());
    }
    Ok(variance)
}

/// limpid draws samples from the filter, so that its pixels are independent whatever the filter.
fn is_ours(frame: &Frame) -> bool {
    frame.metadata.contains_key("limpid:version")
}

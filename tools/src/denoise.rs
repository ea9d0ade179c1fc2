//! `limpid denoise`: from a noisy frame to a clean one; and what `render --denoise` shares with it.

use std::path::{Path, PathBuf};
use std::time::Instant;

use limpid_denoise::{Denoiser, Method};
use limpid_frame::{Frame, Layer, LayerRequest, read_exr};
use serde_json::json;

use crate::cli::{Common, Denoise};
use crate::error::CliError;
use crate::output::Pictures;
use crate::progress::with_spinner;
use crate::{system, words};

/// Denoises a frame.
pub fn run(options: &Denoise, common: &Common) -> Result<(), CliError> {
    let pictures = Pictures {
        frame: Some(options.output.clone()),
        png: options.png.clone(),
        exposure: options.exposure,
    };
    pictures.check()?;
    let denoising = Denoising::new(options.method, &options.set)?;
    let begin = Instant::now();
    let noisy = with_spinner(common, "reading", || noisy_frame(options))?;
    let read = begin.elapsed().as_secs_f64();

    let begin = Instant::now();
    let first = options.inputs.first().map_or(Path::new(""), PathBuf::as_path);
    let clean = denoising.run(&noisy, first, common)?;
    let seconds = begin.elapsed().as_secs_f64();

    let begin = Instant::now();
    pictures.write(&clean)?;
    let write = begin.elapsed().as_secs_f64();

    if let Some(lacking) = clean.metadata.get("limpid:denoise").and_then(|record| lacking(record)) {
        let cure = "a frame rendered with `--layers all` has all that the method can use";
        words::note(common, format_args!("note: {lacking}; {cure}"));
    }
    let (width, height, method) = (clean.width(), clean.height(), options.method.name);
    let names = pictures.names().join(", ");
    words::note(common, format_args!("{names}: {width}x{height}, {method}, {seconds:.1} s"));
    if !common.json {
        return Ok(());
    }
    let mut report = json!({
        "output": pictures.frame,
        "png": pictures.png,
        "width": width,
        "height": height,
        "method": method,
        "seconds": { "read": read, "denoise": seconds, "write": write },
    });
    if let Some(bytes) = system::peak_memory_bytes() {
        report["peak_memory_bytes"] = bytes.into();
    }
    words::result(report)
}

/// A method with its parameters set.
pub struct Denoising {
    denoiser: Box<dyn Denoiser>,
    method: &'static Method,
}

impl Denoising {
    /// `assignments` are `key=value`, as `--set` takes them.
    pub fn new(method: &'static Method, assignments: &[String]) -> Result<Self, CliError> {
        let denoiser = method
            .configure(assignments)
            .map_err(|error| CliError::option("--set", assignments.join(" --set "), error))?;
        Ok(Self { denoiser, method })
    }

    /// The layers that the method reads.
    pub fn needs(&self) -> LayerRequest {
        self.denoiser.needs()
    }

    /// The clean frame: denoised `R`, `G`, `B` and components, the noisy picture as `noisy.*`, and all other layers.
    pub fn run(&self, noisy: &Frame, file: &Path, common: &Common) -> Result<Frame, CliError> {
        with_spinner(common, self.method.name, || self.denoiser.denoise(noisy))
            .map_err(|source| CliError::Denoise { path: file.into(), source })
    }
}

/// What a method says in its record that it had to do without.
fn lacking(record: &str) -> Option<String> {
    let without = |part: &&str| part.starts_with("filtered as a whole") || part.starts_with("no ");
    let parts: Vec<&str> = record.split("; ").skip(1).filter(without).collect();
    (!parts.is_empty()).then(|| parts.join("; "))
}

/// The input: all files' channels in one frame.
fn noisy_frame(options: &Denoise) -> Result<Frame, CliError> {
    let mut frame: Option<Frame> = None;
    for path in &options.inputs {
        let part = read_exr(path)?;
        if part.channel("noisy.R").is_some() {
            let problem = "is denoised already; give the frame as it was rendered";
            return Err(CliError::File { path: path.clone(), problem: problem.into() });
        }
        match &mut frame {
            None => frame = Some(part),
            Some(frame) => add(frame, &part, path, |name| Some(name.to_owned()))?,
        }
    }
    let mut frame = frame.unwrap_or_default();
    for (path, layer) in [(&options.albedo, Layer::Albedo), (&options.normal, Layer::Normal)] {
        let Some(path) = path else { continue };
        let part = read_exr(path)?;
        let channels = layer.channels();
        // Normals that were written as a picture: red is x.
        let written = if part.channel(channels[0]).is_some() { channels } else { &["R", "G", "B"] };
        if let Some(missing) = written.iter().find(|name| part.channel(name).is_none()) {
            let problem = format!("has no channel `{missing}`, which is to be `{}`", layer.name());
            return Err(CliError::File { path: path.clone(), problem });
        }
        let name_of = |name: &str| {
            let channel = channels[written.iter().position(|w| *w == name)?];
            Some(format!("{}.{channel}", layer.name()))
        };
        add(&mut frame, &part, path, name_of)?;
    }
    Ok(frame)
}

/// Adds the channels of `part` under the names that `name_of` gives them, without those that have none.
fn add(
    frame: &mut Frame,
    part: &Frame,
    path: &Path,
    name_of: impl Fn(&str) -> Option<String>,
) -> Result<(), CliError> {
    let wrong = |problem| CliError::File { path: path.into(), problem };
    let (size, other) = ((frame.width(), frame.height()), (part.width(), part.height()));
    if size != other {
        return Err(wrong(format!(
            "has {}x{} pixels, the first file {}x{}",
            other.0, other.1, size.0, size.1
        )));
    }
    for (name, plane) in part.channels() {
        let Some(name) = name_of(name) else { continue };
        if frame.channel(&name).is_some() {
            return Err(wrong(format!("has channel `{name}`, and so has a file before it; leave one out")));
        }
        frame.insert(name, plane.to_vec());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(width: usize, channels: &[&str]) -> Frame {
        let mut frame = Frame::new(width, 1);
        for (i, name) in channels.iter().enumerate() {
            frame.insert(*name, vec![i as f32; width]);
        }
        frame
    }

    #[test]
    fn what_a_method_did_without_is_told() {
        let record = "joint-nlm radius=10; filtered as a whole: no components; no features; pixels filled 3";
        assert_eq!(lacking(record).as_deref(), Some("filtered as a whole: no components; no features"));
        assert_eq!(lacking("joint-nlm radius=10; features normal albedo"), None);
    }

    #[test]
    fn parts_add_their_channels_and_refuse_what_does_not_fit() {
        let all = |name: &str| Some(name.to_owned());
        let mut whole = frame(2, &["R", "G", "B"]);
        add(&mut whole, &frame(2, &["albedo.R"]), Path::new("b.exr"), all).expect("fits");
        assert!(whole.channel("albedo.R").is_some());
        let error = add(&mut whole, &frame(2, &["G"]), Path::new("b.exr"), all).expect_err("has G twice");
        assert!(error.to_string().starts_with("b.exr: has channel `G`"), "{error}");
        let error = add(&mut whole, &frame(3, &["Z"]), Path::new("b.exr"), all).expect_err("is wider");
        assert!(error.to_string().contains("3x1") && error.to_string().contains("2x1"), "{error}");
    }
}

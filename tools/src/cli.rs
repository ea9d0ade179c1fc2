//! Every option once: its name, default, help and the reason to use it.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use limpid_denoise::Method;
use limpid_frame::LayerRequest;
use limpid_scenes::Crop;

use crate::values;

/// The denoiser that is good for most pictures.
pub const DEFAULT_METHOD: &str = "joint-nlm";

/// Render a scene, denoise the picture, and see what each step costs.
#[derive(Debug, Parser)]
#[command(name = "limpid", version, max_term_width = 100, arg_required_else_help = true)]
pub struct Cli {
    #[command(flatten)]
    pub common: Common,
    #[command(subcommand)]
    pub command: Command,
}

/// What every subcommand takes.
#[derive(Args, Clone, Debug)]
pub struct Common {
    /// Print one JSON object on one line of standard output, for scripts.
    #[arg(long, global = true, display_order = 1000)]
    pub json: bool,
    /// Say nothing but errors.
    #[arg(long, global = true, display_order = 1001)]
    pub quiet: bool,
    /// Threads to work with [default: all cores]. No picture depends on it.
    #[arg(long, global = true, value_name = "N", value_parser = values::threads,
          allow_negative_numbers = true, display_order = 1002)]
    pub threads: Option<usize>,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render a scene to a frame (EXR) and a picture (PNG).
    Render(Box<Render>),
    /// Denoise a frame.
    Denoise(Denoise),
    /// Show what a scene calls for, or what a frame holds.
    Info(Info),
    /// Measure how far a picture is from its reference.
    Metrics(Metrics),
    /// Write a scene as Mitsuba XML that renders the same picture there (glTF: with the nearest materials).
    Export(Export),
    /// Compare with Mitsuba 3: do both compute the same picture, and how sure is that?
    Crosscheck(Crosscheck),
    /// List every denoiser with its inputs and its source.
    Methods,
}

/// `limpid render`
#[derive(Args, Debug)]
pub struct Render {
    /// Scene file: Mitsuba XML, glTF (.gltf, .glb), OBJ.
    pub scene: PathBuf,
    #[command(flatten)]
    pub reading: Reading,
    /// Frame to write [default: SCENE's name, or its folder's for scene.*, with .exr, here].
    #[arg(short, value_name = "OUT.exr", value_parser = values::exr_path, help_heading = "Output")]
    pub output: Option<PathBuf>,
    /// Picture to write, as a screen shows it (sRGB) [default: beside the frame where -o is not given].
    #[arg(long, value_name = "OUT.png", value_parser = values::png_path, help_heading = "Output")]
    pub png: Option<PathBuf>,
    /// Brightness of the PNG in stops: 1 is twice as bright. The frame keeps the scene's own.
    #[arg(long, value_name = "EV", default_value = "0", allow_negative_numbers = true,
          value_parser = values::exposure, help_heading = "Output")]
    pub exposure: f32,
    /// Layers to write beside the picture, such as albedo,normal,diffuse.variance,beauty.halves, or `all`
    /// (a wrong name gets you the list).
    #[arg(long, value_name = "L,…", value_parser = LayerRequest::parse, help_heading = "Output")]
    pub layers: Option<LayerRequest>,
    /// Write every single sample into this folder, a safetensors file a tile: for training and for research.
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    pub records: Option<PathBuf>,
    /// Render this pixel alone and print its values: to look into a wrong one. X,Y count from the top left of the
    /// whole film; the values are the file's to the bit.
    #[arg(long, value_name = "X,Y", value_parser = values::pixel, conflicts_with_all = ["crop", "denoise"],
          help_heading = "Output")]
    pub pixel: Option<[u32; 2]>,
    /// Denoise the picture with this method (see `limpid methods`); the noisy one is kept as noisy.*.
    #[arg(long, value_name = "METHOD", value_parser = values::method, help_heading = "Denoising")]
    pub denoise: Option<&'static Method>,
    /// Set a parameter of the method.
    #[arg(long = "set", value_name = "KEY=VALUE", requires = "denoise", help_heading = "Denoising")]
    pub set: Vec<String>,
    /// Samples per pixel [default: the scene's]. Four times as many halve the noise.
    #[arg(long, value_name = "N", value_parser = values::spp, allow_negative_numbers = true, help_heading = "Quality")]
    pub spp: Option<u32>,
    /// Size of the picture in pixels [default: the scene's].
    #[arg(long, value_name = "WxH", value_parser = values::size, help_heading = "Quality")]
    pub size: Option<[u32; 2]>,
    /// Part of the film to render, in pixels from its top left: to look at a detail sooner.
    #[arg(long, value_name = "X,Y,W,H", value_parser = values::crop, help_heading = "Quality")]
    pub crop: Option<Crop>,
    /// Another seed gives independent noise.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        allow_negative_numbers = true,
        help_heading = "Quality"
    )]
    pub seed: u64,
    /// Camera to render, where the scene has several [default: its first].
    #[arg(long, value_name = "NAME", help_heading = "Quality")]
    pub camera: Option<String>,
    /// Where random numbers come from: sobol has less noise, independent is for statistical tests, file is what the
    /// scene names [default: sobol].
    #[arg(long, value_name = "S", value_enum, help_heading = "Quality")]
    pub sampler: Option<SamplerChoice>,
    /// Longest path in edges: 1 shows lights only, 2 direct light [default: the scene's].
    #[arg(long, value_name = "N", value_parser = values::max_depth, allow_negative_numbers = true, help_heading = "Quality")]
    pub max_depth: Option<u32>,
    /// Depth from which Russian roulette may end a path: a balance of noise and time [default: the scene's].
    #[arg(long, value_name = "N", allow_negative_numbers = true, help_heading = "Quality")]
    pub rr_depth: Option<u32>,
    /// Upper bound for a sample's radiance: takes fireflies out and light with them, so the picture gets darker.
    #[arg(long, value_name = "L", value_parser = values::clamp, allow_negative_numbers = true, help_heading = "Quality")]
    pub clamp: Option<f32>,
    /// Leave out what limpid does otherwise than Mitsuba on purpose: to compare the two. Takes its near and far clip
    /// (0.01 and 10000) where the file states none.
    #[arg(long, help_heading = "Quality")]
    pub as_mitsuba: bool,
}

/// `limpid crosscheck`
#[derive(Args, Debug)]
pub struct Crosscheck {
    /// Scene files: Mitsuba XML, glTF (.gltf, .glb), OBJ.
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    #[command(flatten)]
    pub reading: Reading,
    /// Size of the pictures in pixels [default: the scene's]. A small one finds most mistakes, but needs more samples
    /// per pixel.
    #[arg(long, value_name = "WxH", value_parser = values::size)]
    pub size: Option<[u32; 2]>,
    /// Camera to compare, where the scene has several [default: its first].
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// Samples per pixel of each picture [default: the scene's; with --power 64 to begin with].
    #[arg(long, value_name = "N", value_parser = values::spp, allow_negative_numbers = true)]
    pub spp: Option<u32>,
    /// Render on until a difference of 0.5 % of the whole picture would show, at most to 65536 samples.
    #[arg(long)]
    pub power: bool,
    /// Compare with this picture (its R, G, B) instead of running Mitsuba; with the scene's own pixel filter.
    #[arg(long, value_name = "REF.exr", requires = "against_variance")]
    pub against: Option<PathBuf>,
    /// The variance of each pixel's mean in that picture, per channel: of independent passes, the variance between
    /// them over their number. A frame of limpid's that has a variance layer may be named twice.
    #[arg(long, value_name = "V.exr", requires = "against")]
    pub against_variance: Option<PathBuf>,
    /// Another seed gives independent noise on both sides.
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true)]
    pub seed: u64,
    /// Folder for the report: index.html, pictures, difference, p values; a folder in it for each of several scenes
    /// [default: SCENE's name with -crosscheck, here; with --json none].
    #[arg(short, value_name = "REPORT")]
    pub output: Option<PathBuf>,
}

/// How a scene file is read.
#[derive(Args, Clone, Debug)]
pub struct Reading {
    /// Refuse a scene with an unused parameter, instead of warning: it is a typo, or another program's word.
    #[arg(long)]
    pub strict: bool,
    /// Value of a parameter of the scene file (its `$NAME`).
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = values::define)]
    pub defines: Vec<(String, String)>,
}

/// `--sampler`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SamplerChoice {
    /// Owen-scrambled Sobol sets.
    Sobol,
    /// Uniform numbers.
    Independent,
    /// What the scene file names.
    File,
}

/// `limpid denoise`
#[derive(Args, Debug)]
pub struct Denoise {
    /// Frame to denoise. Several files are one picture in parts: each adds its channels.
    #[arg(required = true, value_name = "IN.exr")]
    pub inputs: Vec<PathBuf>,
    /// Frame to write.
    #[arg(short, required = true, value_name = "OUT.exr", value_parser = values::exr_path)]
    pub output: PathBuf,
    /// Method (see `limpid methods`).
    #[arg(long, value_name = "METHOD", default_value = DEFAULT_METHOD, value_parser = values::method)]
    pub method: &'static Method,
    /// Set a parameter of the method.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Picture to write, as a screen shows it (sRGB).
    #[arg(long, value_name = "OUT.png", value_parser = values::png_path)]
    pub png: Option<PathBuf>,
    /// Brightness of the PNG in stops: 1 is twice as bright.
    #[arg(long, value_name = "EV", default_value = "0", allow_negative_numbers = true,
          value_parser = values::exposure)]
    pub exposure: f32,
    /// Albedo from a file of its own (its R, G, B).
    #[arg(long, value_name = "FILE.exr")]
    pub albedo: Option<PathBuf>,
    /// Normals in world space from a file of their own (its X, Y, Z or R, G, B).
    #[arg(long, value_name = "FILE.exr")]
    pub normal: Option<PathBuf>,
}

/// `limpid info`
#[derive(Args, Debug)]
pub struct Info {
    /// Scene files and frames.
    #[arg(required = true, value_name = "SCENE|FRAME")]
    pub files: Vec<PathBuf>,
    #[command(flatten)]
    pub reading: Reading,
}

/// `limpid metrics`
#[derive(Args, Debug)]
pub struct Metrics {
    /// Frame to judge (EXR).
    #[arg(value_name = "IMAGE")]
    pub image: PathBuf,
    /// What it should be (EXR); with several the frame is compared to each.
    #[arg(required = true, value_name = "REFERENCE")]
    pub references: Vec<PathBuf>,
}

/// `limpid export`
#[derive(Args, Debug)]
pub struct Export {
    /// Scene file: Mitsuba XML, glTF (.gltf, .glb), OBJ.
    pub scene: PathBuf,
    /// File to write; meshes and pictures go to OUT_files beside it.
    #[arg(short, required = true, value_name = "OUT.xml", value_parser = values::xml_path)]
    pub output: PathBuf,
    #[command(flatten)]
    pub reading: Reading,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn definitions_contradict_nothing() {
        Cli::command().debug_assert();
    }

    #[test]
    fn every_option_says_what_it_is_for() {
        let mut cli = Cli::command();
        cli.build();
        for sub in cli.get_subcommands() {
            for argument in sub.get_arguments() {
                assert!(argument.get_help().is_some(), "{} {}", sub.get_name(), argument.get_id());
            }
        }
    }

    #[test]
    fn common_options_stand_on_either_side_of_the_verb() {
        for line in [["limpid", "--json", "methods"], ["limpid", "methods", "--json"]] {
            assert!(Cli::try_parse_from(line).expect("is a call").common.json);
        }
    }
}

//! What a render came to, for people and for scripts.

use std::collections::BTreeMap;

use limpid_frame::{ErrorEstimate, Frame};
use limpid_renderer::{Called, Counters, Effect, Settings};
use serde::Serialize;
use serde_json::{Value, json};

use super::pixel::{self, Pixel};
use crate::cli::{Common, DEFAULT_METHOD};
use crate::error::CliError;
use crate::output::Pictures;
use crate::{info, system, words};

/// Wall-clock seconds of each stage.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Seconds {
    /// Reading the scene's files.
    pub load: f64,
    /// Acceleration structure and sampling tables.
    pub prepare: f64,
    /// Tracing paths.
    pub render: f64,
    /// Denoising.
    pub denoise: f64,
    /// Writing frame and picture.
    pub write: f64,
}

/// Everything there is to say when a render is done.
pub struct Report<'a> {
    pub pictures: &'a Pictures,
    pub frame: &'a Frame,
    pub settings: &'a Settings,
    pub seconds: Seconds,
    pub render_user_s: Option<f64>,
    /// Of the noisy picture.
    pub error: Option<ErrorEstimate>,
    pub counters: Counters,
    pub rejected: u64,
    pub first_rejected: Option<[u32; 2]>,
    pub effects: &'a [Called],
    /// How many the scene has.
    pub warnings: usize,
    pub interrupted: bool,
    /// Samples that every pixel has.
    pub spp: u32,
    /// The method that was asked for; an interrupted picture is left noisy.
    pub denoise: Option<&'a str>,
    /// `--pixel`
    pub pixel: Option<[u32; 2]>,
}

impl Report<'_> {
    /// Says it: JSON to standard output where it is asked for, else words.
    pub fn tell(&self, common: &Common) -> Result<(), CliError> {
        self.words(common);
        match (common.json, self.pixel) {
            (true, _) => words::result(self.json()),
            (false, Some(_)) => words::result(pixel::table(self.frame)),
            (false, None) => Ok(()),
        }
    }

    /// What is there after Ctrl-C.
    pub fn kept(&self) -> String {
        let written = self.pictures.names();
        if written.is_empty() {
            return "nothing was to be written".into();
        }
        if !self.interrupted {
            return format!("{} had all samples and is whole", written.join(" and "));
        }
        let noisy = if self.denoise.is_some() { ", not denoised" } else { "" };
        format!("{} with the samples that were done{noisy}", written.join(" and "))
    }

    fn denoised(&self) -> Option<&str> {
        self.denoise.filter(|_| !self.interrupted)
    }

    fn rays(&self) -> u64 {
        self.counters.rays + self.counters.shadow_rays
    }

    fn mrays_per_second(&self) -> Option<f64> {
        (self.seconds.render > 0.0).then(|| self.rays() as f64 / 1e6 / self.seconds.render)
    }

    fn words(&self, common: &Common) {
        let Seconds { load, prepare, render, denoise, write } = self.seconds;
        let (width, height) = (self.frame.width(), self.frame.height());
        let spp = match self.settings.spp {
            spp if self.interrupted => {
                format!("{:.1} of {spp}", self.counters.paths as f64 / self.frame.len().max(1) as f64)
            }
            spp => spp.to_string(),
        };
        let names = self.pictures.names().join(", ");
        let what = if names.is_empty() { "rendered" } else { &names };
        let speed = self.mrays_per_second().map_or(String::new(), |s| format!(" at {s:.1} Mrays/s"));
        let mut stages = format!("rendering {}{speed}", duration(render));
        if let Some(method) = self.denoised() {
            stages += &format!(", {method} {}", duration(denoise));
        }
        let all = duration(load + prepare + render + denoise + write);
        words::note(common, format_args!("{what}: {width}x{height}, {spp} spp, {all} ({stages})"));

        if self.rejected > 0 {
            let place = |[x, y]: [u32; 2]| format!("; to look at one: `--pixel {x},{y}`");
            let cure = self.first_rejected.map_or(String::new(), place);
            let count = self.rejected;
            words::note(
                common,
                format_args!("warning: {count} samples were not finite and count as 0{cure}"),
            );
        }
        if self.pixel.is_none() {
            words::note(common, self.noise());
        }
    }

    /// How noisy the result is, and what could be done about it. The noise is the root of relMSE, so a quarter of
    /// relMSE, at four times the samples, is half the noise.
    fn noise(&self) -> String {
        let Some(ErrorEstimate { relmse, low, high }) = self.error else {
            return "noise: unknown with 1 sample a pixel; `--spp 2` or more shows it".into();
        };
        let percent = |relmse: f64| 100.0 * relmse.sqrt();
        let interval = format!("95 % within {:.2}–{:.2} %", percent(low), percent(high));
        let noise = format!("{:.2} % ({interval}; estimated relMSE {relmse:.2e})", percent(relmse));
        if self.denoised().is_some() {
            return format!("noise before denoising: {noise}");
        }
        if self.interrupted {
            return format!("noise: {noise}");
        }
        let (spp, time) = (4 * u64::from(self.settings.spp), duration(4.0 * self.seconds.render));
        format!(
            "noise: {noise}; `--spp {spp}` halves it in {time}, `--denoise {DEFAULT_METHOD}` trades it for a little blur"
        )
    }

    fn json(&self) -> Value {
        let mut counters: BTreeMap<&str, u64> = Effect::ALL.map(|e| (e.name(), self.counters.of(e))).into();
        counters.extend([
            ("paths", self.counters.paths),
            ("rays", self.counters.rays),
            ("shadow_rays", self.counters.shadow_rays),
        ]);
        let mut report = json!({
            "output": self.pictures.frame,
            "png": self.pictures.png,
            "width": self.frame.width(),
            "height": self.frame.height(),
            "spp": self.spp,
            "seconds": self.seconds,
            "render_s": self.seconds.render,
            "rays": self.rays(),
            "mrays_per_second": self.mrays_per_second(),
            "error": self.error,
            "rejected": self.rejected,
            "effects": info::effects(self.effects),
            "counters": counters,
            "warnings": self.warnings,
            "interrupted": self.interrupted,
            "denoised": self.denoised(),
        });
        let optional = [
            ("render_user_s", self.render_user_s.map(Value::from)),
            ("peak_memory_bytes", system::peak_memory_bytes().map(Value::from)),
            ("pixel", self.pixel.map(|place| json!(Pixel::of(self.frame, place)))),
        ];
        for (key, value) in optional {
            if let Some(value) = value {
                report[key] = value;
            }
        }
        report
    }
}

/// Seconds for people.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 0.095 => format!("{:.0} ms", 1000.0 * s),
        s if s < 0.95 => format!("{s:.2} s"),
        s if s < 90.0 => format!("{s:.1} s"),
        s if s < 90.0 * 60.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

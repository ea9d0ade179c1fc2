//! `limpid metrics`: how far a picture is from its reference.

use limpid_frame::{FrameError, Metrics, metrics, read_exr};
use serde_json::{Value, json};

use crate::cli::{Common, Metrics as Options};
use crate::error::CliError;
use crate::words;

/// Compares the picture to each reference.
pub fn run(options: &Options, common: &Common) -> Result<(), CliError> {
    let image = read_exr(&options.image)?;
    let mut all = Vec::new();
    for path in &options.references {
        let reference = read_exr(path)?;
        let found = metrics(&image, &reference).map_err(|error| match error {
            FrameError::MissingChannel { .. } if image.rgb().is_err() => {
                CliError::File { path: options.image.clone(), problem: error.to_string() }
            }
            _ => CliError::File { path: path.clone(), problem: error.to_string() },
        })?;
        if found.left_out > 0 {
            let problem = "pixels are not finite in one of the pictures and are left out";
            words::note(common, format_args!("warning: {}: {} {problem}", path.display(), found.left_out));
        }
        if !common.json {
            words::result(format_args!(
                "{} beside {}\n{}",
                options.image.display(),
                path.display(),
                table(&found)
            ))?;
        }
        let mut object = json!(found);
        object["image"] = json!(options.image);
        object["reference"] = json!(path);
        all.push(object);
    }
    match all.as_slice() {
        _ if !common.json => Ok(()),
        [one] => words::result(one),
        _ => words::result(json!({ "comparisons": Value::from(all) })),
    }
}

fn table(found: &Metrics) -> String {
    let psnr = found.psnr.map_or("infinite: the same to the eye".to_owned(), |db| format!("{db:.2} dB"));
    let Metrics { mse, relmse, relmse_trimmed, smape, .. } = found;
    let rows = [
        ("MSE", format!("{mse:.4e}")),
        ("relMSE", format!("{relmse:.4e}")),
        ("relMSE, trimmed", format!("{relmse_trimmed:.4e}")),
        ("SMAPE", format!("{smape:.4}")),
        ("PSNR", psnr),
    ];
    rows.map(|(name, value)| format!("  {name:<18} {value}")).join("\n")
}

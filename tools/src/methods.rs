//! `limpid methods`: every denoiser with its inputs, its source and its parameters.

use limpid_denoise::{Method, Parameter, methods};
use serde_json::{Value, json};

use crate::cli::Common;
use crate::error::CliError;
use crate::{layers, words};

/// Lists them.
pub fn run(common: &Common) -> Result<(), CliError> {
    if common.json {
        return words::result(json!({ "methods": methods().iter().map(object).collect::<Value>() }));
    }
    words::result(methods().iter().map(paragraph).collect::<Vec<_>>().join("\n\n"))
}

fn object(method: &Method) -> Value {
    let parameter = |p: &Parameter| json!({ "name": p.name, "doc": p.doc, "default": p.default, "min": p.min, "max": p.max });
    json!({
        "name": method.name,
        "kind": method.kind.name(),
        "needs": layers::names(&method.needs()),
        "source": method.source,
        "summary": method.summary,
        "parameters": method.parameters.iter().map(parameter).collect::<Value>(),
    })
}

fn paragraph(method: &Method) -> String {
    let mut text = format!(
        "{} ({})\n  {}\n  source  {}\n  reads   {}",
        method.name,
        method.kind.name(),
        method.summary,
        method.source,
        layers::names(&method.needs()).join(", "),
    );
    for Parameter { name, doc, default, min, max, .. } in method.parameters {
        text += &format!("\n  --set {name}={default}  {doc} ({min} to {max})");
    }
    text
}

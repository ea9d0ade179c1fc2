//! `limpid`: renders a scene, denoises the picture, and shows what each step costs.
//!
//! One module a subcommand; each takes its options and gives back nothing or a [`CliError`], which knows
//! its exit code. What is for machines goes to standard output, what is for people to standard error.

mod cli;
mod crosscheck;
mod denoise;
mod error;
mod export;
mod info;
mod interrupt;
mod layers;
mod methods;
mod metrics;
mod output;
mod progress;
mod render;
mod scene;
mod system;
mod values;
mod words;

use std::process::ExitCode;

use clap::Parser;
use cli::{Cli, Command};
use error::CliError;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(refusal) => match CliError::from_clap(&refusal) {
            Some(error) => return words::fail(&error),
            None => {
                // Help and version too: clap knows where they go. A closed pipe is nobody's error.
                let _ = refusal.print();
                return ExitCode::from(refusal.exit_code() as u8);
            }
        },
    };
    match run(cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => words::fail(&error),
    }
}

fn run(cli: Cli) -> Result<(), CliError> {
    interrupt::install(cli.common.quiet);
    if let Some(threads) = cli.common.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build_global()
            .map_err(|source| CliError::Threads { threads, problem: source.to_string() })?;
    }
    match cli.command {
        Command::Render(options) => render::run(&options, &cli.common),
        Command::Denoise(options) => denoise::run(&options, &cli.common),
        Command::Info(options) => info::run(&options, &cli.common),
        Command::Export(options) => export::run(&options, &cli.common),
        Command::Metrics(options) => metrics::run(&options, &cli.common),
        Command::Crosscheck(options) => crosscheck::run(&options, &cli.common),
        Command::Methods => methods::run(&cli.common),
    }
}

//! Rays per second of the triangle tree, by class of rays, on rays dumped by another tracer; with feature
//! `embree` in turn with Embree on the same rays.
//!
//! ```text
//! cargo bench -p limpid-renderer --features embree --bench traversal -- SCENE.xml RAYS [LIBEMBREE4.so]
//! ```
//!
//! `RAYS` is a folder of `CLASS.rays` and `CLASS.hits` (`bench_embree.py --dump`); the scene's emitters are left out, as
//! there. Speeds are by CPU time of the one tracing thread, medians over rounds in which the tracers take turns.

use std::path::Path;

#[cfg(feature = "embree")]
use limpid_renderer::bench::Embree;
use limpid_renderer::bench::{Hit, NONE, Ours, Ray, cpu_seconds, read_hits, read_rays, triangles};
use limpid_scenes::{LoadOptions, load};

const CLASSES: [&str; 4] = ["primary", "diffuse1", "diffuse3", "shadow"];
/// Rays of one call: about a tile's, the renderer's working set.
const BATCH: usize = 4096;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let [scene, folder, rest @ ..] = &arguments[..] else {
        println!(
            "traversal: no scene and no rays given, nothing measured (see the head of benches/traversal.rs)"
        );
        return;
    };
    let rounds = std::env::var("ROUNDS").ok().and_then(|n| n.parse().ok()).unwrap_or(7);
    let scene = load(Path::new(scene), &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    let triangles = triangles(&scene);
    println!("{}", processor());
    let ours = build(&triangles, rounds.min(5));
    #[cfg(feature = "embree")]
    let embree = rest.first().map(|library| {
        let (embree, seconds) =
            Embree::new(Path::new(library), &triangles).unwrap_or_else(|e| panic!("{library}: {e}"));
        println!("Embree {}: built in {seconds:.2} CPU s", embree.version);
        embree
    });
    #[cfg(not(feature = "embree"))]
    assert!(rest.is_empty(), "feature `embree` is off");

    println!(
        "\n| rays | Mrays per CPU s | to Embree | to its packets of 16 | unlike the dump | unlike scalar |"
    );
    println!("|---|---|---|---|---|---|");
    for class in CLASSES {
        let path = |end: &str| Path::new(folder).join(format!("{class}.{end}"));
        let (Ok(rays), Ok(dumped)) = (read_rays(&path("rays")), read_hits(&path("hits"))) else { continue };
        let (unlike_dump, unlike_scalar) = check(&ours, class, &rays, &dumped);
        let mut tracers: Vec<Box<dyn FnMut() + '_>> = vec![tracer(
            class,
            &rays,
            |rays, hits| ours.closest(rays, hits),
            |rays, blocked| ours.occluded(rays, blocked),
        )];
        #[cfg(feature = "embree")]
        if let Some(embree) = &embree {
            tracers.push(tracer(
                class,
                &rays,
                |rays, hits| embree.closest(rays, hits),
                |rays, blocked| embree.occluded(rays, blocked),
            ));
            tracers.push(tracer(
                class,
                &rays,
                |rays, hits| embree.closest_packets(rays, hits),
                |rays, blocked| embree.occluded_packets(rays, blocked),
            ));
        }
        let seconds = in_turn(rounds, &mut tracers);
        let ratio = |other: usize| match seconds.get(other) {
            Some(theirs) => format!("{:.2}", median(theirs.iter().zip(&seconds[0]).map(|(b, a)| b / a))),
            None => "".into(),
        };
        let speed = median(seconds[0].iter().map(|s| rays.len() as f64 / s / 1e6));
        println!("| {class} | {speed:.2} | {} | {} | {unlike_dump} | {unlike_scalar} |", ratio(1), ratio(2));
    }
}

/// Traces all rays of a class in batches.
fn tracer<'a>(
    class: &str,
    rays: &'a [Ray],
    closest: impl Fn(&[Ray], &mut [Hit]) + 'a,
    occluded: impl Fn(&[Ray], &mut [bool]) + 'a,
) -> Box<dyn FnMut() + 'a> {
    let (mut hits, mut blocked) = (vec![Hit::MISS; BATCH], vec![false; BATCH]);
    let shadow = class == "shadow";
    Box::new(move || {
        for rays in rays.chunks(BATCH) {
            if shadow {
                occluded(rays, &mut blocked[..rays.len()]);
            } else {
                closest(rays, &mut hits[..rays.len()]);
            }
        }
    })
}

/// CPU seconds of each tracer in each round.
fn in_turn(rounds: usize, tracers: &mut [Box<dyn FnMut() + '_>]) -> Vec<Vec<f64>> {
    let mut seconds = vec![Vec::new(); tracers.len()];
    for _ in 0..rounds {
        for (tracer, seconds) in tracers.iter_mut().zip(&mut seconds) {
            let begin = cpu_seconds();
            tracer();
            seconds.push(cpu_seconds() - begin);
        }
    }
    seconds
}

/// Hits that differ from the dumped ones, and from the scalar kernel's by a bit.
fn check(ours: &Ours, class: &str, rays: &[Ray], dumped: &[(f32, u32)]) -> (usize, usize) {
    if class == "shadow" {
        let (mut fast, mut scalar) = (vec![false; rays.len()], vec![false; rays.len()]);
        ours.occluded(rays, &mut fast);
        ours.occluded_scalar(rays, &mut scalar);
        let unlike = fast.iter().zip(dumped).filter(|&(&blocked, &(t, _))| blocked != (t < 0.0)).count();
        return (unlike, fast.iter().zip(&scalar).filter(|(a, b)| a != b).count());
    }
    let (mut fast, mut scalar) = (vec![Hit::MISS; rays.len()], vec![Hit::MISS; rays.len()]);
    ours.closest(rays, &mut fast);
    ours.closest_scalar(rays, &mut scalar);
    let unlike = fast.iter().zip(dumped).filter(|(hit, (_, prim))| hit.prim != *prim).count();
    let bits = |h: &Hit| (h.prim, h.t.to_bits(), h.u.to_bits(), h.v.to_bits());
    debug_assert!(fast.iter().all(|h| h.prim == NONE || h.t.is_finite()));
    (unlike, fast.iter().zip(&scalar).filter(|(a, b)| bits(a) != bits(b)).count())
}

fn build(triangles: &[[glam::Vec3; 3]], rounds: usize) -> Ours {
    // One thread, so that its CPU time is all of it.
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .use_current_thread()
        .build()
        .expect("one thread starts");
    let mut seconds = Vec::new();
    let mut ours = None;
    for _ in 0..rounds {
        let begin = cpu_seconds();
        ours = Some(pool.install(|| Ours::new(triangles)));
        seconds.push(cpu_seconds() - begin);
    }
    let ours = ours.expect("at least one round");
    println!(
        "{} triangles: built in {:.2} CPU s, {:.1} bytes a triangle",
        triangles.len(),
        median(seconds.into_iter()),
        ours.bytes() as f64 / triangles.len() as f64
    );
    ours
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The processor's name and those of its flags that the kernels know.
fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |name: &str| {
        text.lines()
            .find(|line| line.starts_with(name))
            .and_then(|line| line.split(": ").nth(1))
            .unwrap_or("?")
    };
    let flags: Vec<&str> = (field("flags").split(' '))
        .filter(|flag| ["sse2", "avx2", "fma", "bmi1", "avx512f", "avx512vl"].contains(flag))
        .collect();
    format!(
        "processor: {}, family {} model {}; flags: {}",
        field("model name"),
        field("cpu family"),
        field("model\t"),
        flags.join(" ")
    )
}

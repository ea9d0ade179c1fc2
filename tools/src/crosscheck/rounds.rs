//! How many passes of how many samples, and how many more until the picture is known well enough.

use limpid_frame::compare::{Comparison, FALSE_ALARMS, Finding, Halves, Parts, Passes, ROUNDING, compare};

use crate::error::CliError;

/// The whole picture's detectable bias at which a comparison means something.
pub const TARGET: f64 = 0.005;
/// Where `--power` gives up, in samples a pixel.
pub const MAX_SPP: u32 = 1 << 16;
/// The least number of passes: their spread is what the noise is known from.
const PASSES: u32 = 16;
/// The most samples of a pass. Mitsuba adds up in 32 bits: at 1024 it loses 1e-5 of the brightness, at 65536 6e-4.
const MAX_PASS: u32 = 512;
/// A round may take this many times as many samples as there are: a first estimate of the noise may have missed its tail.
const GROWTH: f64 = 8.0;
/// Asked for by `--power` over that.
const MARGIN: f64 = 1.05;
/// What is asked for over what the noise so far calls for, which may have missed its tail.
const SPARE: f64 = 1.1;
/// A difference as clear as this ends `--power` at once: looking up to ten times at a hundredth of the level adds 0.1 %
/// of false alarms.
const CLEAR: f64 = 0.01 * FALSE_ALARMS;

/// Passes and samples of each, at least `spp` samples together; an even number, for two halves.
pub fn plan(spp: u32) -> [u32; 2] {
    let passes = PASSES.max(spp.div_ceil(MAX_PASS)).next_multiple_of(2);
    [passes, spp.div_ceil(passes).max(1)]
}

/// Renders one pass, by its number.
pub type Render<'a> = &'a mut dyn FnMut(u32, u32) -> Result<[Vec<f32>; 3], CliError>;

/// Passes `first..` of one side, in two halves of every other one.
pub fn halves(
    size: [usize; 2],
    first: u32,
    [passes, spp]: [u32; 2],
    pass: Render,
) -> Result<Halves, CliError> {
    let mut halves = [Passes::new(size), Passes::new(size)];
    for i in 0..passes {
        let planes = pass(first + i, spp)?;
        halves[(i & 1) as usize].push(planes.each_ref().map(Vec::as_slice), spp);
    }
    let halves = halves.map(|half| half.estimate().expect("a half has eight passes and more"));
    Ok(Halves::Two(Box::new(halves)))
}

/// A comparison with what it took.
pub struct Outcome {
    /// Ours.
    pub ours: Halves,
    /// The other.
    pub theirs: Halves,
    /// The tests.
    pub comparison: Comparison,
    /// Samples of each pixel on our side.
    pub spp: u32,
    /// Share of the light that comes from pixels that show more than background.
    pub share: f64,
}

/// Where hardly anything is to be seen, it counts as this share of the light.
const LEAST_SHARE: f64 = 0.05;

/// Share of a picture's light that comes from the pixels that are `seen`, of all where none is.
fn share(picture: &Halves, seen: &[bool]) -> f64 {
    let light =
        |p: usize| (0..3).map(|channel| picture.pixel(channel, p)[0]).filter(|x| x.is_finite()).sum::<f64>();
    let all: f64 = (0..seen.len()).map(light).sum();
    let of_seen: f64 = (0..seen.len()).filter(|&p| seen[p]).map(light).sum();
    if all > 0.0 && seen.contains(&true) { (of_seen / all).clamp(LEAST_SHARE, 1.0) } else { 1.0 }
}

impl Outcome {
    /// No difference was found, and one of 0.5 % would have been.
    pub fn agrees(&self) -> bool {
        !self.differs() && self.detectable_bias() <= TARGET
    }

    /// The smallest relative bias that would have shown in the mean of the picture, were all but the background biased. A
    /// sky that is known nearly without noise makes the mean of a picture sure, and says nothing of what is before it.
    pub fn detectable_bias(&self) -> f64 {
        self.comparison.detectable_bias / self.share
    }

    /// A difference was found.
    pub fn differs(&self) -> bool {
        self.comparison.p < FALSE_ALARMS
    }

    /// Samples a pixel for a detectable bias of 0.5 %, a tenth more than the noise so far calls for and a multiple of 16;
    /// `None` where no number will do: there is no light, or the reference is too noisy itself.
    pub fn spp_needed(&self) -> Option<f64> {
        let fixed = matches!(self.theirs, Halves::One(_));
        let whole = self.comparison.family(Parts::Whole)?;
        let target = TARGET * self.share;
        let deciding = |finding: &&Finding| finding.detectable == self.comparison.detectable_bias;
        let finding = whole.findings.iter().find(deciding)?;
        if finding.detectable <= target {
            return Some(f64::from(self.spp));
        }
        let [ours, theirs] = finding.errors.map(|error| error * error);
        // All errors shrink by this factor for the target.
        let shrink = (target - ROUNDING) / (finding.detectable - ROUNDING);
        let allowed = shrink * shrink * (ours + theirs);
        let factor = if fixed { ours / (allowed - theirs) } else { 1.0 / (shrink * shrink) };
        let needed = SPARE * factor * f64::from(self.spp);
        (factor.is_finite() && factor > 0.0).then(|| (needed / 16.0).ceil() * 16.0)
    }
}

/// Both sides of a comparison: `theirs` renders, or is there.
pub enum Theirs<'a> {
    /// Renders passes.
    Renders(Render<'a>),
    /// A picture.
    Fixed(Halves),
}

/// Renders `spp` samples and compares; with `power` until a difference of 0.5 % would show, a clear one does, or there
/// are too many samples. What was rendered is kept. `seen`: pixels that show more than background.
pub fn run(
    seen: &[bool],
    size: [usize; 2],
    spp: u32,
    power: bool,
    ours: Render,
    mut theirs: Theirs,
    tell: &mut dyn FnMut(&Outcome),
) -> Result<Outcome, CliError> {
    let (mut first, mut more) = (0, spp);
    let mut outcome: Option<Outcome> = None;
    loop {
        let plan = plan(more);
        let mut new = halves(size, first, plan, ours)?;
        let mut other = match &mut theirs {
            Theirs::Renders(render) => halves(size, first, plan, *render)?,
            Theirs::Fixed(picture) => picture.clone(),
        };
        first += plan[0];
        let mut spp = plan[0] * plan[1];
        if let Some(before) = outcome.take() {
            spp += before.spp;
            merge(&mut new, before.ours);
            if matches!(theirs, Theirs::Renders(_)) {
                merge(&mut other, before.theirs);
            }
        }
        let comparison = compare(&new, &other);
        let share = share(&new, seen);
        let now = Outcome { ours: new, theirs: other, comparison, spp, share };
        tell(&now);
        let done = now.detectable_bias() <= TARGET || now.comparison.p < CLEAR || spp >= MAX_SPP;
        match now.spp_needed().filter(|_| power && !done) {
            Some(needed) => more = next(spp, needed),
            None => return Ok(now),
        }
        outcome = Some(now);
    }
}

fn merge(new: &mut Halves, before: Halves) {
    new.merge(&before);
}

/// Samples of the next round.
fn next(spp: u32, needed: f64) -> u32 {
    let have = f64::from(spp);
    let more = (MARGIN * needed - have).clamp(0.25 * have, GROWTH * have);
    (more.ceil() as u32).min(MAX_SPP.saturating_sub(spp)).max(PASSES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_hold_the_samples_that_were_asked_for_and_few_more() {
        for spp in [1, 15, 16, 17, 64, 1000, 8192, 8193, 65_536] {
            let [passes, each] = plan(spp);
            assert!(passes >= 16 && passes % 2 == 0 && each <= 512);
            assert!(passes * each >= spp && passes * (each - 1) < spp, "{spp}: {passes} x {each}");
        }
    }

    #[test]
    fn rounds_grow_towards_what_is_needed_and_end_at_the_limit() {
        assert_eq!(next(64, 80.0), 20);
        assert_eq!(next(64, 1e9), 512);
        assert_eq!(next(60_000, 1e9), 5536);
        assert!(next(65_530, 1e9) >= 16);
    }

    /// Passes of a picture of noise, whose spread is 1 for a single sample.
    fn noisy(seed: u32, brightness: f32) -> impl FnMut(u32, u32) -> Result<[Vec<f32>; 3], CliError> {
        move |pass, spp| {
            let mut state = u64::from(seed) << 32 | u64::from(pass);
            let mut uniform = move || {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                ((state >> 40) as f32) / (1 << 24) as f32
            };
            (0..16).for_each(|_| _ = uniform()); // seeds that are alike begin alike
            let scale = 12.0_f32.sqrt() / (spp as f32).sqrt();
            Ok(std::array::from_fn(|_| {
                (0..64 * 64).map(|_| brightness + scale * (uniform() - 0.5)).collect()
            }))
        }
    }

    #[test]
    fn power_renders_until_the_target_and_keeps_what_it_has() {
        let (mut ours, mut theirs) = (noisy(1, 1.0), noisy(2, 1.0));
        let mut rounds = Vec::new();
        let outcome = run(
            &[true; 64 * 64],
            [64, 64],
            16,
            true,
            &mut ours,
            Theirs::Renders(&mut theirs),
            &mut |outcome| {
                rounds.push(outcome.spp);
            },
        );
        let outcome = outcome.expect("renders");
        assert!(outcome.agrees(), "p {}", outcome.comparison.p);
        assert!(rounds.len() >= 2 && rounds.is_sorted());
        // 4.5 standard errors of 1/64 · √(2/spp) at 0.5 %: about 400 samples.
        assert!((200..1000).contains(&outcome.spp), "{rounds:?}");
        assert_eq!(outcome.ours.spp(), f64::from(outcome.spp));
    }

    #[test]
    fn a_clear_difference_ends_the_rounds_early() {
        let (mut ours, mut theirs) = (noisy(1, 1.5), noisy(2, 1.0));
        let outcome =
            run(&[true; 64 * 64], [64, 64], 16, true, &mut ours, Theirs::Renders(&mut theirs), &mut |_| {});
        let outcome = outcome.expect("renders");
        assert!(outcome.differs() && outcome.spp == 16);
    }

    #[test]
    fn what_is_needed_is_what_does() {
        let (mut ours, mut theirs) = (noisy(3, 1.0), noisy(4, 1.0));
        let outcome =
            run(&[true; 64 * 64], [64, 64], 64, false, &mut ours, Theirs::Renders(&mut theirs), &mut |_| {});
        let needed = outcome.expect("renders").spp_needed().expect("there is a number").ceil() as u32;
        let (mut ours, mut theirs) = (noisy(3, 1.0), noisy(4, 1.0));
        let outcome = run(
            &[true; 64 * 64],
            [64, 64],
            needed,
            false,
            &mut ours,
            Theirs::Renders(&mut theirs),
            &mut |_| {},
        );
        let reached = outcome.expect("renders").comparison.detectable_bias;
        assert!((0.9 * TARGET..TARGET).contains(&reached), "{reached}");
    }

    #[test]
    fn a_background_without_noise_does_not_count_as_known() {
        // A quarter of the pixels are noisy, the others a sky of the same brightness.
        let before_sky = |seed: u32| {
            let mut noise = noisy(seed, 1.0);
            move |pass: u32, spp: u32| {
                let mut planes = noise(pass, spp)?;
                planes.iter_mut().for_each(|plane| plane[16 * 64..].fill(1.0));
                Ok(planes)
            }
        };
        let reach = |seen: &[bool]| {
            let (mut ours, mut theirs) = (before_sky(5), before_sky(6));
            let outcome =
                run(seen, [64, 64], 64, false, &mut ours, Theirs::Renders(&mut theirs), &mut |_| {});
            let outcome = outcome.expect("renders");
            (outcome.detectable_bias(), outcome.spp_needed().expect("there is a number"))
        };
        let seen: Vec<bool> = (0..64 * 64).map(|p| p < 16 * 64).collect();
        let ((all, few), (thing, many)) = (reach(&[true; 64 * 64]), reach(&seen));
        assert!((thing / all - 4.0).abs() < 0.1, "{thing} {all}");
        assert!(many > 10.0 * few, "{many} {few}");
    }
}

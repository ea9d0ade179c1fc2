//! How `--layers` is written.

use crate::{FrameError, Layer, LayerRequest, Statistic};

impl LayerRequest {
    /// Reads a list such as `albedo,normal,diffuse.variance,beauty.halves`, or `all`. A plain name means
    /// the layer's mean, `.variance` its variance, `.halves` both its halves; an empty list asks for nothing.
    ///
    /// # Errors
    ///
    /// [`FrameError::UnknownLayer`], which lists the known layers, nearest first, and
    /// [`FrameError::UnknownStatistic`].
    pub fn parse(list: &str) -> Result<Self, FrameError> {
        let mut request = Self::default();
        for item in list.split(',').map(str::trim).filter(|item| !item.is_empty()) {
            if item == "all" {
                request = request.union(&Self::all());
                continue;
            }
            let (name, statistic) = item.split_once('.').map_or((item, None), |(n, s)| (n, Some(s)));
            let Some(layer) = Layer::from_name(name) else {
                return Err(FrameError::UnknownLayer {
                    name: name.to_owned(),
                    known: nearest_first(name, Layer::ALL.iter().map(|l| l.name())),
                });
            };
            request = match statistic {
                None => request.with(layer, Statistic::Mean),
                Some("variance") if layer.has_statistics() => request.with(layer, Statistic::Variance),
                Some("halves") if layer.has_statistics() => {
                    request.with(layer, Statistic::A).with(layer, Statistic::B)
                }
                Some(other) => {
                    let (layer, statistic) = (layer.name(), other.to_owned());
                    return Err(FrameError::UnknownStatistic { layer, statistic });
                }
            };
        }
        Ok(request)
    }
}

/// The names, the likeliest to be meant by `name` first: what an error about an unknown name lists.
pub fn nearest_first(name: &str, known: impl Iterator<Item = &'static str>) -> Vec<&'static str> {
    let mut known: Vec<&str> = known.collect();
    known.sort_by_key(|candidate| edit_distance(name, candidate)); // stable: the table's order among equals
    known
}

/// Insertions, deletions and replacements between two words (Levenshtein 1966). Only the first 32
/// characters of `a` count, so that a long word costs nothing.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().take(32).enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(ca != *cb);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_asks_for_what_it_names_and_no_more() {
        let request =
            LayerRequest::parse("albedo, normal,diffuse.variance,beauty.halves,").expect("is right");
        let asked: Vec<_> = request.iter().collect();
        assert_eq!(
            asked,
            [
                (Layer::Beauty, Statistic::A),
                (Layer::Beauty, Statistic::B),
                (Layer::Diffuse, Statistic::Variance),
                (Layer::Albedo, Statistic::Mean),
                (Layer::Normal, Statistic::Mean),
            ]
        );
        assert_eq!(LayerRequest::parse("").expect("is right"), LayerRequest::default());
    }

    #[test]
    fn all_is_every_layer_with_every_statistic() {
        assert_eq!(LayerRequest::parse("albedo,all").expect("is right"), LayerRequest::all());
    }

    #[test]
    fn every_layer_can_be_asked_for_by_its_name() {
        for layer in Layer::ALL {
            assert!(LayerRequest::parse(layer.name()).expect("is known").contains(layer, Statistic::Mean));
            let halves = LayerRequest::parse(&format!("{}.halves", layer.name()));
            assert_eq!(halves.is_ok(), layer.has_statistics());
        }
    }

    #[test]
    fn an_unknown_layer_lists_the_known_ones_nearest_first() {
        let nearest = |name: &str| match LayerRequest::parse(name) {
            Err(FrameError::UnknownLayer { known, .. }) => known,
            other => panic!("{name} gave {other:?}"),
        };
        assert_eq!(nearest("albdo")[0], "albedo");
        assert_eq!(nearest("normals")[0], "normal");
        assert_eq!(nearest("diffusealbedo.variance")[0], "diffuse_albedo");
        assert_eq!(nearest(&"x".repeat(1 << 20)).len(), Layer::ALL.len());
        let message = LayerRequest::parse("albdo").expect_err("is unknown").to_string();
        assert!(message.starts_with("unknown layer `albdo`; known, nearest first: albedo, "), "{message}");
        assert!(message.ends_with(", all"), "{message}");
    }

    #[test]
    fn a_statistic_that_a_layer_lacks_is_an_error_with_a_cure() {
        let message = |list: &str| LayerRequest::parse(list).expect_err("is wrong").to_string();
        assert_eq!(message("id.variance"), "layer `id` has no `variance`; it has its mean only");
        assert_eq!(message("depth.mean"), "layer `depth` has no `mean`; it has `variance` and `halves`");
    }
}

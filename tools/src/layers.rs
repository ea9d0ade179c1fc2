//! Sets of layers in the words of `--layers`.

use limpid_frame::{Layer, LayerRequest, Statistic};

/// `albedo`, `diffuse.variance`, `beauty.halves`: a list that [`LayerRequest::parse`] reads back.
pub fn names(layers: &LayerRequest) -> Vec<String> {
    let mut names = Vec::new();
    for layer in Layer::ALL {
        let name = layer.name();
        if layers.contains(layer, Statistic::Mean) {
            names.push(name.to_owned());
        }
        if layers.contains(layer, Statistic::Variance) {
            names.push(format!("{name}.variance"));
        }
        if layers.contains(layer, Statistic::A) && layers.contains(layer, Statistic::B) {
            names.push(format!("{name}.halves"));
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back_as_the_same_set() {
        for list in ["all", "beauty", "albedo,normal.variance,diffuse.halves,id"] {
            let layers = LayerRequest::parse(list).expect("is right");
            assert_eq!(LayerRequest::parse(&names(&layers).join(",")).expect("is right"), layers);
        }
    }
}

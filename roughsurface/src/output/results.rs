//! A prediction with comparisons and parameter uncertainties.

use crate::friction::Prediction;
use crate::friction::comparison::Comparison;
use crate::sampling::uncertainty::Propagated;

/// A prediction with comparisons and parameter uncertainties.
#[derive(Clone, Debug)]
pub struct Results {
    pub prediction: Prediction,
    /// The same surface with asperities after models of the literature.
    pub comparisons: Vec<Comparison>,
    /// Changes of the results with the uncertain parameters.
    pub propagated: Option<Propagated>,
}

impl From<Prediction> for Results {
    fn from(prediction: Prediction) -> Self {
        Self { prediction, comparisons: Vec::new(), propagated: None }
    }
}

//! A prediction with comparisons and parameter uncertainties.

use crate::friction::Prediction;
use crate::friction::comparison::Comparison;
use crate::friction::cutoff::AtCutoff;
use crate::sampling::uncertainty::Propagated;

/// A prediction with comparisons and parameter uncertainties.
#[derive(Clone, Debug)]
pub struct Results {
    pub prediction: Prediction,
    /// The same surface with asperities after models of the literature.
    pub comparisons: Vec<Comparison>,
    /// The same topography with other cut-offs, by ascending cut-off; none for a surface file.
    pub cutoffs: Vec<AtCutoff>,
    /// Changes of the results with the uncertain parameters.
    pub propagated: Option<Propagated>,
}

impl From<Prediction> for Results {
    fn from(prediction: Prediction) -> Self {
        Self { prediction, comparisons: Vec::new(), cutoffs: Vec::new(), propagated: None }
    }
}

//! The one list of results: friction.nc, mc.nc, summary, JSON, report and figures loop over it.

use crate::friction::result::Friction;
use crate::friction::slip_curve::SlipState;
use tables::law::Estimate;

use Source::{Share, SteadySliding, WhereKnown, WholeSlide};

/// A result of a rough surface over (pressure or separation, slip rate).
pub struct SurfaceQuantity {
    /// Name in files.
    pub name: &'static str,
    /// Unit as CF conventions write it.
    pub unit: &'static str,
    /// Meaning in words.
    pub long_name: &'static str,
    /// How it is found in the results of a cell.
    pub source: Source,
    /// Whether uncertain parameters are propagated to it.
    pub propagated: bool,
}

/// How a quantity is found in the results of a cell.
pub enum Source {
    /// From the state in steady sliding.
    SteadySliding(fn(&SlipState) -> Estimate),
    /// From the results of the whole slide.
    WholeSlide(fn(&Friction) -> Estimate),
    /// From the results of the whole slide, where the law states it.
    WhereKnown(fn(&Friction) -> Option<Estimate>),
    /// A share from the results of the whole slide, without an error.
    Share(fn(&Friction) -> f64),
}

/// Every result. To add one: a line here.
pub static QUANTITIES: [SurfaceQuantity; 30] = [
    SurfaceQuantity::new("mu", "1", "sliding friction coefficient, mean over the life of the contacts",
        SteadySliding(|s| s.mu)).propagated(),
    SurfaceQuantity::new("mu_steady", "1", "sliding friction coefficient of contacts that last",
        WholeSlide(|f| f.mu_steady)),
    SurfaceQuantity::new("mu_static", "1",
        "friction coefficient where the friction-slip curve of the surface starts to slide",
        WholeSlide(|f| f.mu_static)).propagated(),
    SurfaceQuantity::new("inception_slip", "m", "slip at which static friction is reached",
        WholeSlide(|f| f.inception_slip)),
    SurfaceQuantity::new("Q", "Pa", "friction stress on the nominal area while sliding",
        SteadySliding(|s| s.shear)).propagated(),
    SurfaceQuantity::new("G", "J m-2",
        "energy that the asperities release from full stick to full slip per nominal area",
        WhereKnown(|f| f.energy_release)).propagated(),
    SurfaceQuantity::new("G_weakening", "J m-2",
        "energy of slip weakening per nominal area under the pressure before the slide, from the peak of friction to the end",
        WholeSlide(|f| f.weakening_energy)).propagated(),
    SurfaceQuantity::new("G_weakening_real_area", "J m-2",
        "energy of slip weakening per real contact area while sliding",
        WholeSlide(|f| f.weakening_energy.over(f.sliding.area_fraction))),
    SurfaceQuantity::new("G_real_area", "J m-2",
        "energy that the asperities release from full stick to full slip per real contact area before the slide",
        WhereKnown(|f| Some(f.energy_release?.over(f.pressed.area_fraction)))),
    SurfaceQuantity::new("weakening_distance", "m",
        "slip-weakening distance, that of linear weakening with the same peak, end and integral of the friction coefficient",
        WholeSlide(|f| f.weakening_distance)),
    SurfaceQuantity::new("dmu_dlnV", "1",
        "derivative of the sliding friction coefficient with respect to the logarithm of the slip rate",
        WholeSlide(|f| f.rate_sensitivity)),
    SurfaceQuantity::new("real_area_fraction", "1", "real over nominal contact area while sliding",
        SteadySliding(|s| s.area_fraction)).propagated(),
    SurfaceQuantity::new("real_area_fraction_press", "1", "real over nominal contact area before the slide",
        WholeSlide(|f| f.pressed.area_fraction)),
    SurfaceQuantity::new("separation", "m",
        "distance of the flat from the undisplaced reference plane of the heights before the slide",
        WholeSlide(|f| f.pressed.separation)).propagated(),
    SurfaceQuantity::new("separation_sliding", "m",
        "distance of the flat from the undisplaced reference plane of the heights while sliding",
        SteadySliding(|s| s.separation)),
    SurfaceQuantity::new("mean_plane_displacement", "m",
        "displacement of the reference plane of the heights by the nominal pressure before the slide",
        WholeSlide(|f| f.pressed.displacement)),
    SurfaceQuantity::new("pressure", "Pa", "nominal pressure before the slide", WholeSlide(|f| f.pressed.pressure)),
    SurfaceQuantity::new("pressure_sliding", "Pa", "nominal pressure while sliding", SteadySliding(|s| s.pressure)),
    SurfaceQuantity::new("contact_density", "m-2", "asperities in contact per nominal area while sliding",
        SteadySliding(|s| s.contact_density)),
    SurfaceQuantity::new("contact_density_press", "m-2", "asperities in contact per nominal area before the slide",
        WholeSlide(|f| f.pressed.contact_density)),
    SurfaceQuantity::new("temperature_mean", "K",
        "temperature of the contacts at the end of the slide, mean over the real contact area",
        WhereKnown(|f| f.contacts.temperature_mean)),
    SurfaceQuantity::new("temperature_max", "K",
        "temperature that the hottest point of one contact in a thousand exceeds at the end of the slide",
        WhereKnown(|f| f.contacts.temperature_max)),
    SurfaceQuantity::new("elastic_load_fraction", "1",
        "share of the load on contacts below first yield at the end of the slide",
        Share(|f| f.contacts.elastic_load)),
    SurfaceQuantity::new("elastic_plastic_load_fraction", "1",
        "share of the load on contacts between first yield and 110 times its interference at the end of the slide",
        Share(|f| f.contacts.elastic_plastic_load)),
    SurfaceQuantity::new("fully_plastic_load_fraction", "1",
        "share of the load on contacts above 110 times the interference of first yield at the end of the slide",
        Share(|f| f.contacts.fully_plastic_load)),
    SurfaceQuantity::new("outside_table_fraction", "1",
        "largest share of the load carried above the last interference of the table during the slide",
        Share(|f| f.outside_table)),
    SurfaceQuantity::new("below_table_fraction", "1",
        "share of the load on contacts below the first interference of the table at the end of the slide",
        Share(|f| f.contacts.below_law_load)),
    SurfaceQuantity::new("elastic_fraction", "1",
        "share of the asperities in contact pressed less than first yield needs, at the end of the slide",
        Share(|f| f.contacts.shares.elastic)),
    SurfaceQuantity::new("plastic_fraction", "1",
        "share of the asperities in contact pressed beyond first yield and not melting, at the end of the slide",
        Share(|f| f.contacts.shares.plastic)),
    SurfaceQuantity::new("melting_fraction", "1",
        "share of the asperities in contact whose hottest point has the melting temperature, at the end of the slide",
        Share(|f| f.contacts.shares.melting)),
];

impl SurfaceQuantity {
    const fn new(name: &'static str, unit: &'static str, long_name: &'static str, source: Source) -> Self {
        Self { name, unit, long_name, source, propagated: false }
    }
    const fn propagated(self) -> Self {
        Self { propagated: true, ..self }
    }

    /// The quantity of that name in [`QUANTITIES`].
    ///
    /// # Panics
    /// If there is none.
    pub fn named(name: &str) -> &'static Self {
        QUANTITIES.iter().find(|quantity| quantity.name == name).expect("a name of the list of quantities")
    }

    /// Value and error; none where the law does not state it. A share has no error.
    pub fn of(&self, friction: &Friction) -> Option<Estimate> {
        match self.source {
            Source::SteadySliding(of) => Some(of(&friction.sliding)),
            Source::WholeSlide(of) => Some(of(friction)),
            Source::WhereKnown(of) => of(friction),
            Source::Share(of) => Some(Estimate::exact(of(friction))),
        }
    }

    /// Value and error; NaN where the law does not state it.
    pub fn estimate(&self, friction: &Friction) -> Estimate {
        self.of(friction).unwrap_or(Estimate::UNKNOWN)
    }
}

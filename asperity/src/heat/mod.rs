pub(crate) mod conduction;
pub(crate) mod expected;

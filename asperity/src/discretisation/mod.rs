pub(crate) mod body;
pub(crate) mod collocation;
pub(crate) mod elastic;
pub(crate) mod element;
pub(crate) mod mesh;
pub(crate) mod runs;

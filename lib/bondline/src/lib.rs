//! bondline

//! Pipeline and verification tests (see README.md).

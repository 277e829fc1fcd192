//! particle-file

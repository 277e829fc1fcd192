//! voxels

"""What follows as fast numbers: compiled functions, motion, kernels for grids, error bounds, the cache on disk."""

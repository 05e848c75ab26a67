"""Beyond the linear range: tires, families of steady motions, handling, limit cycles and their basins."""

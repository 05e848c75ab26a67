"""Motion in time by the non-linear equations, and what it says of the linear verdict."""

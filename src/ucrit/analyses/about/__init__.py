"""What there is and who says so: models, vehicles, laws, equations, bond graphs, sources."""

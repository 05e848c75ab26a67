"""Whether a vehicle is stable, up to what value, how it fails, and what to change."""

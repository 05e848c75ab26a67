"""The catalogue of vehicles, one file each; adding a file adds the vehicle."""

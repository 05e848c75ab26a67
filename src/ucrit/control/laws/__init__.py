"""Controllers of the catalogue, one file each: `ls` is the table of contents."""

"""Force laws that vehicles share, as plain functions of floats, arrays or symbols."""

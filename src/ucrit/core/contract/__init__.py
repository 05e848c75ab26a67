"""What a vehicle may declare: parameters, variables, parts, bounds, tolerances, events, a drawing, a file."""

"""What follows from a declaration by algebra: traced equations, the linear object, polynomials, limits."""

"""Algorithms over arrays and polynomials that know no model and no vehicle.

Coefficients of polynomials are in ascending powers everywhere, ``a[0] + a[1] s + ... + a[n] s^n``.
"""

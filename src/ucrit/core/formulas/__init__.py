"""Symbolic formulas that know no model: functions, slopes, factors, determinants, code, typesetting."""

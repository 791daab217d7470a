"""Common parts of stepwise calibrations: readings as a table, steadiness."""

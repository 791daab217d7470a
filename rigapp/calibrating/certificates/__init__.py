"""Certificates of calibration records, the same bytes each time."""

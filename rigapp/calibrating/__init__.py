"""Calibrations as the application does them: what the terminal and the window share.

Sessions with live readings, their journal, the simulated hands of a practice, results, records and
certificates, the records that a rig file names. Knows neither Qt nor a terminal nor an engine: it
is handed a window of signals, and hands back words and numbers.
"""

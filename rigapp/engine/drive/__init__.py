"""Move the spindle: stop and pause sequences, ramps, feeding the watchdog."""

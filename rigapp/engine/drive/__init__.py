"""Control of the spindle: stop and pause sequences, ramps, feeding of the watchdog."""

"""Calibration: fits, checks that name a mistake, uncertainty, procedures, records.

Arrays and plain values in, frozen results out, SI; no files, no devices, nothing of the
application. ``taking`` holds what all calibrations share (readings, steps, steadiness);
``load_cell``, ``probes``, ``channel`` and ``turning`` (readings with a turning spindle) are the
types. A type imports ``taking``, ``problems`` and no other type; ``records`` seals the results.
"""

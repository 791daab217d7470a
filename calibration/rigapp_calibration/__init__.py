"""What a reading is worth: fits, checks that name the mistake, uncertainty, procedures, records.

Arrays and plain values in, frozen results out, SI; no files, no devices, nothing of the
application. ``taking`` is what all calibrations share (readings, steps, steadiness); ``load_cell``,
``probes``, ``channel`` and ``turning`` (what is taken while the spindle turns) are the subjects. A
subject imports ``taking``, ``problems`` and no other subject; ``records`` seals what comes out.
"""

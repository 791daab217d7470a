"""Recorded tests for analysts: datasets with names, units and dates, tables of tests, pictures.

``backend`` lets xarray read the groups of a test file, cut to committed rows; ``recorded`` is what
``rigapp.open`` and ``rigapp.open_many`` return, ``pictures`` what it draws. Analyses read files
through the storage's public modules and share the report's figures; independent of a running rig.
Other packages import ``recorded``.
"""

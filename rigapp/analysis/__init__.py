"""Recorded tests for analysts: datasets with names, units and dates, tables of tests, pictures.

``backend`` lets xarray read the groups of a test file, cut to what is safe; ``recorded`` is what
``rigapp.open`` and ``rigapp.open_many`` return, ``pictures`` what it draws. Analyses see files by
the storage's door and share the report's figures; nothing of a running rig is known here.
Others enter by ``recorded``.
"""

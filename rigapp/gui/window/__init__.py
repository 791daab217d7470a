"""The frame: state bar, controls, questions, the table of tabs, and the start of the program.

Only ``rigapp.commands`` imports it.
"""

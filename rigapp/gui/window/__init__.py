"""The frame: state, controls, questions, the table of tabs, and the start of the program.

Nothing else imports it but ``rigapp.commands``.
"""

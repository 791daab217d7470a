"""Appearance of the window: a table of colours and sizes, a font, icons, and a style sheet.

It imports no widget of rigapp; painting code receives a ``tokens.Theme``.
"""

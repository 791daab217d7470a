"""How the window looks: one table of colours and sizes, a font, icons, and the style sheet of them.

It knows no widget of the house; whoever paints takes a ``tokens.Theme``.
"""

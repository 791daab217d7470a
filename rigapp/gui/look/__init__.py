"""How the window looks: one table of colours and sizes, a font, icons, and the style sheet of them.

It imports no widget of rigapp; what paints receives a ``tokens.Theme``.
"""

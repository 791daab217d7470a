"""The language of the window: what it says in English stands in the source, all else in catalogues.

``words.tr`` says a text, ``catalogue`` chooses a language and loads it, ``collect`` gathers the
texts out of the source (``make translations``). Texts of files, logs and terminals stay English.
"""

"""Common texts of window, page, report and command line: numbers, times, states, results.

It imports no Qt, and reads no file but the catalogues. Texts are English in the source;
``translation`` returns them in the language of the process.
Other packages import ``catalogue``, ``numbers``, ``results``, ``states``, ``times``, ``tokens``,
``translation``.
"""

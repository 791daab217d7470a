"""What window, page, report and command line say alike: numbers, times, states, results.

It knows no Qt, and no file but the catalogues. Texts are English where they stand;
``translation`` gives them in the language of the process.
Others enter by ``catalogue``, ``numbers``, ``results``, ``states``, ``times``, ``tokens``,
``translation``.
"""

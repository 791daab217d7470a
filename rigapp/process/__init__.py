"""What every process of the program needs: its end, its threads and log, its own time and files.

Any package of rigapp may enter; this one imports none of them but schema and the errors of config.
Others enter by ``awake``, ``children``, ``ending``, ``locks``, ``logs``, ``memory``,
``priority``, ``private``, ``processclock``, ``stale_files``, ``threads``.
"""

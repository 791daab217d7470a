"""May it start? One list of checks, for check, window, start, set_limit, queue and resume.

Other packages import ``check`` (one line of the list), ``fit`` (a test on a rig, by their files)
and ``start`` (all that must be right, as files, disk and engine say).
"""

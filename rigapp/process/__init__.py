"""What every process of the program needs: its end, its log, what others left behind, its own time.

Any package of rigapp may enter; this one imports none of them.
"""

"""Work done once on a machine or in a folder before the first start.

System libraries, compiled kernels, example files, the files of a new rig.
Other packages import ``shipped``, ``kernels``, ``folders``, ``real_rig``, ``schemas``.
"""

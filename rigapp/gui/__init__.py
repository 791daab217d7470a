"""The operator's window, the only code that imports Qt.

Its packages, from the top down, each importing only those below it: ``window`` (frame, state bar,
controls, table of tabs), then side by side ``panels`` (contents of the tabs), ``testfile`` (prepare
a test) and ``wizard`` (calibrate), then ``panel`` (interface of a panel), then ``plots`` and
``results`` (recorded tests), then ``widgets``, then ``look``, then ``language``. The data of engine
and test come from ``rigapp.viewer``, without Qt. Other packages import ``window.app`` (open it).
"""

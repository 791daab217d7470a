"""The operator's window, the only code that imports Qt.

Its packages, from the top down, each importing only those below it: ``window`` (the frame, the
state, the controls, the table of tabs), then side by side ``panels`` (what a tab shows),
``testfile`` (prepare a test) and ``wizard`` (calibrate), then ``panel`` (what a panel is), then
``plots`` and ``results`` (recorded tests), then ``widgets``, then ``look``, then ``language``.
The data of engine and test come from ``rigapp.viewer``, without Qt.
Others enter by ``window.app`` (open it).
"""

"""The operator's window, the only code that knows Qt.

Its rooms, from the top down, each knowing only those below it: ``window`` (the frame, the state,
the controls, the table of tabs), then side by side ``panels`` (what a tab shows), ``testfile``
(prepare a test) and ``wizard`` (calibrate), then ``panel`` (what a panel is), then ``plots`` and
``results`` (recorded tests), then ``widgets``, then ``look``, then ``language``.
What they know of an engine and of a test is ``rigapp.viewer``, without Qt.
Others enter by ``window.app`` (open it).
"""

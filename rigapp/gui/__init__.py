"""The operator's window, the only code that knows Qt.

Its rooms, from the top down, each knowing only those below it: ``window`` (the frame, the state,
the controls, the table of tabs), then side by side ``panels`` (what a tab shows), ``testfile``
(prepare a test) and ``wizard`` (calibrate), then ``panel`` (what a panel is), then ``plots`` and
``results`` (recorded tests), then ``widgets`` and ``data``, then ``look``, then ``language``.
Of the engine all of them see what ``rigapp.schema``, ``rigapp.service`` and ``rigapp.replay`` say.
Others enter by ``window.app`` (open it) and ``window.picture`` (draw it), and the page by what is
known without Qt: ``data.channels``, ``data.comparison``, ``data.connection``, ``data.frames``,
``data.judged``, ``data.knownwear``, ``data.levels``, ``data.margins``, ``data.news``,
``data.quantities``, ``data.ranges``, ``data.series``, ``data.shown``, ``data.showntest``,
``data.tasks``, ``look.tokens``.
"""

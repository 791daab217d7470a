"""What is drawn: colours and pens, plots that keep still, and the curves of a test in them.

A plot is given the data of a test and draws what has changed; it asks the engine for nothing.
"""

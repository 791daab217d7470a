"""Plots: colours and pens, plots with stable axes, and the curves of a test in them.

A plot receives the data of a test and draws what has changed; it sends no requests to the engine.
"""

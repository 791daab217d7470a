"""Panels of the tabs for a running or recorded test, one module for each panel.

A panel is made by ``window.tabs`` from its row in the table there and receives the news.
"""

"""What the tabs show of a running or recorded test, one module a panel.

A panel is made by ``window.tabs`` from its row in the table there and is fed with what is new.
"""

"""What certificates say beside the identification, by subject; plots and pages of their own.

Takes the content of a record, gives parts of a page; knows nothing of sessions or records.
"""

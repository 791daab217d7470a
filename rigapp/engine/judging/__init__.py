"""Evaluation of measured values: limits, stop criteria, alarms and their causes."""

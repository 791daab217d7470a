"""Judge what was measured: limits, stop criteria, alarms and their causes."""

"""The two-axis load cell by dead weights: plans, readings, fit, checks, budget, the daily check."""

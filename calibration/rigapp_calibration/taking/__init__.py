"""What all calibrations that are taken step by step share: readings as a table, steadiness."""

"""What a reading is worth: weights, fits, uncertainty, checks, records, procedures."""

"""The page of settings: one card for each kind."""

"""The page of settings: each of them once, in a card with its like."""

"""Documents as plain blocks, and their layout as HTML or PDF."""

"""A page: what a document says, in plain blocks, and how it is set as HTML or PDF."""

"""What is done to a file that is there already: go on with its test, compress it."""

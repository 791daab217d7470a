"""Write a running test in place: make its file, place rows, commit them, keep its name."""

"""Write a running test in place: create its file, write rows, commit them, monitor its path."""

"""What happens once on a machine before the first start: system libraries, compiled kernels."""

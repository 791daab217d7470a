"""The model parallel to the data: a worker process that predicts each measured revolution."""

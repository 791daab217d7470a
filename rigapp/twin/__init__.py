"""The model beside the data: a worker process that predicts each measured revolution."""

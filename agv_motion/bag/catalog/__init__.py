"""A folder of many bags: an index of what is in each, and questions to it."""

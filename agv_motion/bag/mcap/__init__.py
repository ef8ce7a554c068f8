"""Files in MCAP: records, chunks and indexes, read and written."""

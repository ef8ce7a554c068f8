"""Files in sqlite3, the storage of older recordings of rosbag2: read, and saved when damaged."""

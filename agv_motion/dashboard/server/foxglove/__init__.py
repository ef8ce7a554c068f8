"""The endpoint `/foxglove` on its sockets: live, and over a recording."""

"""`agv demo`: one command a demo."""

"""What serves the page: Starlette and uvicorn, no ROS."""

"""The nodes of a vehicle over recorded bags, without middleware."""

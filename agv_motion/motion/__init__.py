"""DECIDE: where the tree wants to be, and the twist that takes it there.

Three rooms, each built on the one before, and what joins them (`README.md` tells the way through):

- :mod:`.command`: the polar command of the tree, its limits, the twist it means;
- :mod:`.navigation`: zones, paths, and reservations where several trees share a zone;
- :mod:`.behavior`: what to do now, and the goal to go to;
- :mod:`.pilot`: an agent decides, a navigator finds the path, one command comes of both.
"""

"""The scene of a path as arrays: its parts expanded, its curves, and its shapes in an increment."""

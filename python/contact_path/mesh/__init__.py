"""Meshes of gmsh as scenes to be completed."""

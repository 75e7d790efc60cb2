"""Figures of paths and studies, by matplotlib."""

"""Makers of the shipped scenes: each module builds one scene, the others are what they share."""

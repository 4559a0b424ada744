"""Figures of the paper of 2003, to stand beside ours: 512x512 pixels on an Athlon of 1.2 GHz."""

from __future__ import annotations

MACHINE = "Athlon, 1.2 GHz, 512 MB"
SIZE = "512x512"

# Table 1, in seconds: the first image, and each of those that follow it.
TABLE_1: dict[str, dict[str, tuple[float, float]]] = {
    "cornell_box_1": {"path": (46.0, 46.0), "rc": (46.0, 13.0), "rc+lv": (47.0, 4.4)},
    "cornell_box_2": {"path": (200.0, 200.0), "rc": (200.0, 11.0), "rc+lv": (201.0, 4.96)},
    "sphere_flake": {"path": (486.0, 486.0), "rc": (486.0, 16.2), "rc+lv": (487.0, 10.7)},
}
# Section 5: time saved by light vectors over the render cache alone.
GAINS = {"cornell_box_1": 0.66, "cornell_box_2": 0.55, "sphere_flake": 0.34}
# Section 5: share of the pixels that the render cache traces anew.
TRACED_SHARE = 0.08

# Section 3.3: seconds a query, with up to so many points and directions.
QUERY_SECONDS = (0.010, 0.015)
QUERY_POINTS = 100_000
QUERY_DIRECTIONS = 1000

# How Table 1 names the modes.
MODES = {"path": "LR", "rc": "LR + RC", "rc+lv": "5D VEI + RC"}

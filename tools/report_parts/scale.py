"""How much a report measures: sizes, times and samples, in full or in a few minutes."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Scale:
    name: str
    width: int
    height: int
    # Error against time.
    first_seconds: float
    doublings: int
    reference_samples: int  # a pixel
    picture_seconds: float  # of each still that is shown
    picture_reference_samples: int
    # Walks.
    frames: int  # 1 degree from one to the next
    walk_reference_samples: int
    frame_times: tuple[float, ...]  # ms, rising
    frame_time: float  # ms, one of them: the one that Table 1 is about
    # Look-ups: of one series after the other; none: all that bench_query knows.
    query_cases: tuple[tuple[str, int, int], ...]  # series, points, directions
    queries: int
    # Hard cases: which tests, as GoogleTest's filter.
    hard_cases: str
    # Worth of the reuse criteria.
    validity_size: int
    validity_records: int
    validity_samples: int
    validity_seconds: float
    validity_scenes: int  # the first so many
    # Rays.
    rays_size: int
    rays_samples: int
    rays_rounds: int
    rays_own_scenes: bool  # those of bench_rays: large ones too

    @property
    def orbit(self) -> float:
        """Degrees that walks turn by in all."""
        return self.frames - 1.0


FULL = Scale(
    name="full",
    width=512,  # the paper's
    height=512,
    first_seconds=1.0,
    doublings=6,
    reference_samples=1024,
    picture_seconds=10.0,
    picture_reference_samples=512,
    frames=30,
    walk_reference_samples=128,
    frame_times=(16.0, 33.0, 66.0, 132.0, 330.0, 660.0),
    frame_time=33.0,
    query_cases=(),
    queries=200_000,
    hard_cases="*",
    validity_size=512,
    validity_records=4000,
    validity_samples=64,
    validity_seconds=10.0,
    validity_scenes=3,
    rays_size=512,
    rays_samples=4,
    rays_rounds=5,
    rays_own_scenes=True,
)

# Pictures have 1/28 of the pixels: frame times are shorter too, or every pixel would be traced anew
# in every frame and nothing reused.
QUICK = Scale(
    name="quick",
    width=96,
    height=96,
    first_seconds=0.25,
    doublings=3,
    reference_samples=256,
    picture_seconds=1.0,
    picture_reference_samples=128,
    frames=10,
    walk_reference_samples=48,
    frame_times=(4.0, 8.0, 16.0, 40.0),
    frame_time=8.0,
    query_cases=(
        ("points", 1_000, 100),
        ("points", 10_000, 100),
        ("points", 30_000, 100),
        ("directions", 10_000, 1),
        ("directions", 10_000, 10),
        ("directions", 10_000, 300),
        ("both", 100, 10),
        ("both", 1_000, 32),
        ("both", 3_000, 100),
    ),
    queries=50_000,
    hard_cases="of/closed_form.black_room/*:of/closed_form.grey_room/*:of/closed_form.white_room/*:"
    "of/leak.wall_of_zero_thickness/*:of/direction.grazing_light/*",
    validity_size=64,
    validity_records=400,
    validity_samples=4,
    validity_seconds=0.5,
    validity_scenes=1,
    rays_size=96,
    rays_samples=1,
    rays_rounds=3,
    rays_own_scenes=False,
)

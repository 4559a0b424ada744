"""The report of tools/report on programs that only pretend to measure."""

from __future__ import annotations

import contextlib
import html.parser
import io
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
REPORT = TOP / "tools" / "report"
sys.path.insert(0, str(TOP / "tools"))

from report_parts.markup import number, seconds  # noqa: E402
from report_parts.plan import PARTS, Plan, find_scene  # noqa: E402
from report_parts.plots import Level, Line, plot  # noqa: E402
from report_parts.progress import Progress  # noqa: E402
from report_parts.results import Reach, percentile, time_to_reach  # noqa: E402
from report_parts.scale import FULL, QUICK  # noqa: E402
from report_parts.steps import Result, Step  # noqa: E402

SECTIONS = ("summary", "errors", "table-1", "query", "walks", "hard-cases", "validity", "rays")
SECTIONS += ("memory", "pictures", "runs")

# Every program: notes its call, and writes what its options ask for.
PROGRAM = r"""#!{python} -S
import json, os, sys
name, words = os.path.basename(sys.argv[0]), sys.argv[1:]
with open({calls!r}, "a") as calls:
    calls.write(" ".join([name, *words]) + "\n")

def option(word):
    return words[words.index(word) + 1]

def write(path, text):
    os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
    with open(path, "w") as file:
        file.write(text)

TERMS = ("emitted", "specular", "direct", "indirect", "caustic", "sum")
if name == "bench_error":
    def render(time):
        errors = {{t: {{"relmse": 0.01 / time, "rmse": 0.1, "below_noise": False}} for t in TERMS}}
        errors["specular"]["relmse"] = None
        return {{"core_seconds": time, "samples_per_pixel": 4 * time, "records": 77,
                "errors": errors}}
    cost = {{"kind": "extrapolated", "core_seconds": 12.5, "path_over_this": 3.25}}
    methods = [{{"method": m, "renders": [render(1.0), render(2.0)],
                "to_target": {{"sum": cost, "indirect": cost}}}}
               for m in ("path", "light-vectors-paper", "light-vectors-hessian")]
    scene = {{"scene": "s", "target": 0.001, "methods": methods,
             "reference": {{"samples": 8, "noise": {{"sum": {{"relmse": 2e-4}}}}}}}}
    figures = {{"scenes": [scene]}}
elif name == "bench_query":
    points, directions = words[1:3]
    case = {{"points": int(points), "directions": int(directions), "records": 5.0,
            "query_median_seconds": 3e-6, "a field of tomorrow": [1]}}
    figures = {{"series": {{"case": [case]}}}}
elif name == "bench_validity":
    variant = {{"variant": "all parts", "records": 90, "relmse": 0.1, "rmse_over_all_parts": 1.0}}
    figures = {{"equal_records": [variant], "equal_time": [{{"variant": "paper",
               "not_available": "of no use here"}}]}}
elif name == "bench_rays":
    figures = {{"scenes": [{{"scene": words[0], "camera": [3e6, 1e6, 2e6], "path": [1e6]}}]}}
elif name == "hard_cases_test":
    print("box <of> glass: light is lost; error 7%, allowed 5%")
    for which, error in (("path", 1.0), ("light-vectors", 7.0)):
        mark = "  <-- too much" if error > 5 else ""
        print("%-52s %-13s %9.4f%% %9.4f%%%s" % ("box <of> glass", which, error, 5.0, mark))
    print("[==========] 2 tests from 1 test suite ran. (3 ms total)")
    print("[  PASSED  ] 1 test.")
elif words == ["--version"]:
    print("lumivec 9.9 (pretended)")
elif words[0] == "walk":
    last = int(option("--frames")) - 1
    write("frames/frame_00000.png", "first")
    write("frames/frame_%05d.png" % last, "last")
    ms = float(option("--frame-time")) if "--frame-time" in words else 100.0
    error = 1.0 / ms if option("--mode") == "rc+lv" else 4.0 / ms
    frames = [{{"seconds": ms * 1e-3, "traced": 50, "relmse": error, "flip": error,
               "change": 0.3, "reference_change": 0.2}}] * (last + 1)
    figures = {{"mode": option("--mode"), "frames": frames, "cache_bytes": 2048}}
elif words[0] == "render":
    write("picture.exr", "layers")
    write("picture.jpg", "jpeg")
    figures = {{"samples": {{"per_pixel": 6}}, "cache": {{"bytes": 4096, "records": 2}}}}
elif words[0] == "compare":
    write("heat.png", "heat")
    print(json.dumps({{"layers": {{"beauty": {{"relmse": 0.25, "flip": 0.125}}}}}}))
if "--json" in words and words[0] != "compare":
    write(option("--json"), json.dumps(figures))
if "--stats" in words:
    write(option("--stats"), json.dumps(figures))
"""
NAMES = ("viewer/lumivec", "tools/bench_error", "tools/bench_query", "tools/bench_rays")
NAMES += ("tools/bench_validity", "tests/hard_cases_test")
VOID = ("meta", "img")


class Page(html.parser.HTMLParser):
    """Fails where elements do not close as they opened."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.words: list[str] = []
        self.feed(text)
        self.close()
        assert not self.open, self.open

    def handle_starttag(self, tag: str, attributes: list) -> None:
        self.handle_startendtag(tag, attributes)
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attributes: list) -> None:
        for name, value in attributes:
            if name == "id":
                self.ids.append(value)
            elif name in ("src", "href"):
                self.links.append(value)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag, tag

    def handle_data(self, data: str) -> None:
        self.words.append(data)


class ReportTest(unittest.TestCase):
    def setUp(self) -> None:
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        self.calls_file = self.folder / "calls"
        for name in NAMES:
            self.make_program(name)

    def make_program(self, name: str, instead: str = "", after: str = "") -> None:
        path = self.folder / "build" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        text = PROGRAM.format(python=sys.executable, calls=str(self.calls_file))
        path.write_text((f"#!/bin/sh\n{instead}\n" if instead else text) + after)
        path.chmod(0o755)

    def command(self, *options: str) -> list[str]:
        own = ["--quick", "--build", "build", "--scene", "cornell_box_1", *options]
        return [sys.executable, "-B", str(REPORT), *own]

    def run_report(self, *options: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            self.command(*options), cwd=self.folder, capture_output=True, text=True, timeout=300
        )

    def calls(self) -> list[str]:
        """Of programs since the last time, but not what asks for a version."""
        lines = self.calls_file.read_text().splitlines() if self.calls_file.exists() else []
        self.calls_file.unlink(missing_ok=True)
        return [line for line in lines if "--version" not in line]

    def page(self) -> str:
        return (self.folder / "report" / "report.html").read_text(encoding="utf-8")

    def figures(self) -> dict:
        return json.loads((self.folder / "report" / "report.json").read_text(encoding="utf-8"))

    def test_page_holds_everything_and_needs_nothing(self) -> None:
        run = self.run_report()
        self.assertEqual(run.returncode, 0, run.stderr)
        text = self.page()
        page = Page(text)
        self.assertEqual(page.ids, list(SECTIONS))
        for link in page.links:
            self.assertTrue(link.startswith(("#", "data:image/")), link[:80])
        for word in ("http", "url(", "@import", "<script"):
            self.assertNotIn(word, text)
        xml.fromstring(text)  # well formed
        drawings = re.findall(r"<svg.*?</svg>", text, re.DOTALL)
        self.assertGreater(len(drawings), 8)
        for drawing in drawings:
            self.assertIsNone(re.search(r"\b(nan|inf)\b", drawing))
        words = "".join(page.words)
        for expected in (
            "lumivec 9.9 (pretended)",
            "66%",  # the paper's gain
            "10 to 15 ms",  # and its queries
            "box <of> glass",
            "known defect",
            "of no use here",
            "bench_error --scene",  # the exact command
        ):
            self.assertIn(expected, words)

    def test_json_holds_the_figures(self) -> None:
        run = self.run_report("--json", "figures.json", "--output", "page.html")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stdout, "page.html\nfigures.json\n")
        Page((self.folder / "page.html").read_text(encoding="utf-8"))
        figures = json.loads((self.folder / "figures.json").read_text(encoding="utf-8"))
        self.assertEqual(set(figures), {"about", *SECTIONS})
        method = figures["errors"]["scenes"][0]["methods"][2]
        self.assertEqual(method["to_target"]["sum"]["core_seconds"], 12.5)
        row = figures["table-1"]["scenes"][0]["rows"][2]
        self.assertEqual(row["paper"]["following_seconds"], 13.0)
        self.assertEqual(row["median_seconds"], QUICK.frame_time * 1e-3)
        error = figures["table-1"]["scenes"][0]["equal_error"]
        self.assertAlmostEqual(error["reference_noise"], 2e-4 * 8 / QUICK.walk_reference_samples)
        self.assertFalse(error["noisy"])
        # Pretended walks: rc needs four times as long as rc+lv for the same FLIP.
        self.assertAlmostEqual(error["rc_by_flip"]["gain"], 0.75, places=6)
        self.assertAlmostEqual(error["rc"]["gain"], 0.75, places=2)
        self.assertAlmostEqual(figures["walks"]["runs"][0]["median_change_ratio"], 1.5)
        self.assertEqual(figures["rays"]["scenes"][0]["camera"], 2e6)
        self.assertEqual(figures["summary"]["hard_cases_with_too_much_error"], 1)
        self.assertEqual(figures["pictures"]["scenes"][0]["stills"][1]["flip"], 0.125)

    def test_second_run_measures_only_what_changed(self) -> None:
        self.assertEqual(self.run_report().returncode, 0)
        first = self.calls()
        self.assertGreater(len(first), 30)
        again = self.run_report()
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(self.calls(), [])
        self.assertIn("are kept from before", again.stderr)
        self.make_program("tools/bench_rays", after="# changed\n")
        self.assertEqual(self.run_report().returncode, 0)
        self.assertEqual([call.split()[0] for call in self.calls()], ["bench_rays"])

    def test_picture_that_is_gone_is_made_again(self) -> None:
        self.assertEqual(self.run_report().returncode, 0)
        self.calls()
        next((self.folder / "report" / "files").glob("*/heat.png")).unlink()
        self.assertEqual(self.run_report().returncode, 0)
        self.assertEqual([call.split()[1] for call in self.calls()], ["compare"])

    def test_shows_a_step_that_failed_and_goes_on(self) -> None:
        self.make_program("tools/bench_error", "echo 'no <light> today' >&2; exit 3")
        run = self.run_report("--keep-going")
        self.assertEqual(run.returncode, 1)
        message = "ended with status 3: no <light> today"
        self.assertIn(f"failed: {message}", run.stderr)
        page = Page(self.page())
        self.assertEqual(page.ids, list(SECTIONS))
        # In the summary, in its section, and among the runs.
        self.assertEqual("".join(page.words).count(message), 3)
        figures = self.figures()
        self.assertEqual(figures["errors"]["unfinished"][0]["message"], message)
        statuses = [run["status"] for run in figures["runs"]["runs"]]
        self.assertEqual(statuses.count("failed"), 1)
        self.assertNotIn("not run", statuses)
        # It is not kept: the next report tries again.
        self.calls()
        self.make_program("tools/bench_error")
        self.assertEqual(self.run_report().returncode, 0)
        self.assertEqual([call.split()[0] for call in self.calls()], ["bench_error"])

    def test_stops_at_a_step_that_failed(self) -> None:
        self.make_program("tools/bench_error", "kill -SEGV $$")
        self.assertEqual(self.run_report().returncode, 1)
        statuses = [run["status"] for run in self.figures()["runs"]["runs"]]
        self.assertEqual(statuses[:2], ["failed", "not run"])
        self.assertIn("was ended by SIGSEGV", self.page())

    def test_tells_a_program_that_is_missing_or_writes_nothing(self) -> None:
        (self.folder / "build" / "tools" / "bench_rays").unlink()
        self.make_program("tools/bench_validity", "exit 0")
        self.make_program("tests/hard_cases_test", "exit 0")
        self.assertEqual(self.run_report("--keep-going").returncode, 1)
        words = "".join(Page(self.page()).words)
        self.assertIn("bench_rays: No such file or directory", words)
        self.assertIn("wrote no JSON (figures.json)", words)

    def test_what_needs_a_failed_step_fails(self) -> None:
        refuse = "case $1 in render) echo no >&2; exit 1;; compare) exit 0;; esac; exit 5"
        self.make_program("viewer/lumivec", refuse)
        self.assertEqual(self.run_report("--keep-going").returncode, 1)
        words = "".join(Page(self.page()).words)
        self.assertIn("needs what failed: still, cornell_box_1, path", words)

    def test_goes_on_after_an_interruption(self) -> None:
        started = self.folder / "started"
        self.make_program("tests/hard_cases_test", f"echo $$ > {started}; exec sleep 600")
        with open(self.folder / "errors", "w+", encoding="utf-8") as errors:
            process = subprocess.Popen(
                self.command(), cwd=self.folder, stdout=subprocess.DEVNULL, stderr=errors
            )
            self.addCleanup(process.kill)
            for _ in range(3000):
                if started.exists() and started.read_text().strip():
                    break
                time.sleep(0.02)
            os.kill(process.pid, signal.SIGTERM)
            self.assertEqual(process.wait(60), 130)
        with self.assertRaises(ProcessLookupError):  # the program has ended too
            os.kill(int(started.read_text()), 0)
        said = (self.folder / "errors").read_text(encoding="utf-8").splitlines()
        self.assertEqual(said[-1], "report: interrupted; the same call goes on from here")
        before = self.calls()
        self.make_program("tests/hard_cases_test")
        self.assertEqual(self.run_report().returncode, 0)
        after = self.calls()
        self.assertEqual(set(before) & set(after), set())
        self.assertIn("hard_cases_test", after[0])

    def test_refuses_in_one_line(self) -> None:
        for options, status, words in (
            (["--size", "12"], 2, "'12' is no size"),
            (["--threads", "many"], 2, "'many' is no number"),
            (["--quik"], 2, "--quik"),
            (["--part", "walking"], 2, "'walking'"),
            (["--frames", "1"], 2, "'1' is no number from 2"),
            (["--scene", "nowhere"], 1, "those are cornell_box_1, cornell_box_2"),
            (["--scene", "cornell_box_1"], 1, "given twice"),
            (["--build", "elsewhere"], 1, "elsewhere/viewer/lumivec is not there"),
            (["--output", "no/page.html"], 1, "the folder no does not exist"),
            (["--json", "build"], 1, "is a folder"),
            (["--folder", "calls/of"], 1, "calls/of: cannot be made"),
        ):
            with self.subTest(options=options):
                self.calls_file.write_text("")
                run = self.run_report(*options)
                self.assertEqual(run.returncode, status, run.stderr)
                self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
                self.assertIn(words, run.stderr)
                self.assertEqual(self.calls(), [])


class FigureTest(unittest.TestCase):
    def test_time_to_reach_lies_between_points(self) -> None:
        curve = [(4.0, 0.25), (1.0, 1.0), (2.0, 0.5)]
        reach = time_to_reach(curve, 2.0**-1.5)
        self.assertAlmostEqual(reach.seconds or 0.0, 2.0**1.5)
        self.assertEqual(time_to_reach(curve, 3.0), Reach(1.0, "<"))
        self.assertEqual(time_to_reach(curve, 0.1), Reach(4.0, ">"))
        self.assertEqual(time_to_reach([], 0.1), Reach(None))

    def test_percentile_is_one_of_the_values(self) -> None:
        self.assertEqual(percentile([3.0, 1.0, 2.0], 0.5), 2.0)
        self.assertIsNone(percentile([], 0.5))

    def test_numbers_are_short(self) -> None:
        for value, text in ((0.12345, "0.123"), (1234.5, "1,234"), (2.5e-6, "2.50e-06"), (0, "0")):
            self.assertEqual(number(value), text)
        self.assertEqual(number(None), "—")
        self.assertEqual(seconds(0.0125), "12.5 ms")

    def test_plot_leaves_out_what_has_no_place(self) -> None:
        line = Line("<a>", [(1.0, 0.0), (2.0, None), (3.0, 0.5), (4.0, 0.25)])
        drawing = xml.fromstring(plot("t", "x", "y", [line], [Level("l", 0.0)]))
        self.assertEqual(len(drawing.findall("polyline")), 1)
        self.assertEqual(len(drawing.findall("circle")), 3)  # two points, and the legend
        self.assertIn("nothing to draw", plot("t", "x", "y", [Line("a", [(1.0, None)])]))

    def test_one_point_and_even_axes_are_drawn(self) -> None:
        for logarithmic in (True, False):
            for value in (0.3, 7.0):
                line = Line("a", [(1.0, value)])
                text = plot("t", "x", "y", [line], (), logarithmic, logarithmic)
                self.assertEqual(len(xml.fromstring(text).findall("circle")), 2)


class ProgressTest(unittest.TestCase):
    def test_says_something_while_a_step_takes_long(self) -> None:
        step = Step("walk", {}, Path("p"), (), "k", Path("f"), None, (), (), 10.0)
        said = io.StringIO()
        with contextlib.redirect_stderr(said), Progress([step, step], 1, beat=0.01) as progress:
            progress.begin(step)
            for _ in range(1000):
                if "so far" in said.getvalue():
                    break
                time.sleep(0.01)
            progress.end(step, Result("ok", seconds=20.0))
            progress.begin(step)
        lines = said.getvalue().splitlines()
        self.assertEqual(lines[0], "report: 1 of 3 steps are kept from before")
        self.assertEqual(lines[1], "report: 1/2 walk; about 20 s left")
        self.assertRegex(lines[2], "^report: 1/2 walk, for 1 s so far; about 20 s left$")
        # The first took twice its estimate.
        self.assertIn("report: 2/2 walk; about 20 s left", lines)


class PlanTest(unittest.TestCase):
    def test_full_plan_asks_for_every_mode_and_frame_time(self) -> None:
        scenes = [find_scene("sphere_flake", TOP / "scenes")]
        for scale in (FULL, QUICK):
            self.assertIn(scale.frame_time, scale.frame_times)
            plan = Plan(Path("build"), Path("report"), scale, scenes, 2)
            walks = [step.name for step in plan.steps if step.kind == "walk"]
            self.assertEqual(len(walks), 2 + 2 * len(scale.frame_times) + 2)  # in image space
            keys = [step.key for step in plan.steps]
            self.assertEqual(len(keys), len(set(keys)))

    def test_plan_of_a_part_holds_that_alone(self) -> None:
        scenes = [find_scene("sphere_flake", TOP / "scenes")]
        everything = Plan(Path("build"), Path("report"), QUICK, scenes, 2)
        parts = [Plan(Path("build"), Path("report"), QUICK, scenes, 2, [part]) for part in PARTS]
        self.assertTrue(all(plan.steps for plan in parts))
        names = [step.name for plan in parts for step in plan.steps]
        self.assertEqual(sorted(names), sorted(step.name for step in everything.steps))

    def test_work_folder_may_be_moved(self) -> None:
        scenes = [find_scene("sphere_flake", TOP / "scenes")]
        plans = [Plan(Path("b"), Path(place), QUICK, scenes, 0) for place in ("/here", "/there/x")]
        keys = [[step.key for step in plan.steps] for plan in plans]
        self.assertEqual(keys[0], keys[1])


if __name__ == "__main__":
    unittest.main()

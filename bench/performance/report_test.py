# SPDX-License-Identifier: Apache-2.0
"""What report.py must do, on small made-up measurements."""
import json
import pathlib
import tempfile
import unittest
import xml.etree.ElementTree as xml

import report
import roofline
from charts import chart, short


def spread(median):
    return {"median": median, "min": 0.5 * median, "max": 2 * median}


def traversal(threads, mrays):
    row = {"isa": "avx2", "mrays": spread(mrays), "ratio": spread(2.5), "robust_ratio": spread(3), "scalar_ratio": spread(0),
           "peer": {"mode": "8 coherent", "mrays": spread(mrays / 4), "ratio": spread(4)}}
    return {"model": "bunny", "rays": "primary", "threads": threads, "fastrt": [row],
            "embree_modes": {"8": 20.0, "8 coherent": 40.0, "robust 8": 99.0, "16": 50.0},
            "embree_best": {"mode": "16", "mrays": spread(mrays / 2.5)}}


COMPARE = {"embree": "3.13", "traversals": [traversal(1, 100), traversal(2, 190)],
           "builds": [{"model": "bunny", "threads": 1, "primitives": 1000, "fastrt_seconds": spread(0.1),
                       "embree_seconds": spread(0.2), "ratio": spread(2), "fastrt_bytes": 50000, "embree_bytes": 70000,
                       "fastrt_peak_bytes": 90000, "embree_peak_bytes": 120000}]}
RUNS = {"runs": [{"model": "bunny", "threads": 2, "program": name, "fault": fault, "seconds": spread(seconds),
                  "cpu_seconds": seconds, "peak_bytes": 5000000, "times_fastrt": spread(seconds / 0.25)}
                 for name, fault, seconds in (("fastrt (ppm)", "", 0.25), ("povray", "", 5), ("tachyon", "no picture", 0))]}
ROOFLINE = {"limits": {"gflops": {"avx2": 100}, "ginstructions": 10, "memory_gb": 20, "copy_gb": 18, "cache_gb": 90,
                       "memory_gb_all": 40, "threads": 2},
            "rays": [{"model": "bunny", "isa": "avx2", "rays": "random", "mrays": 5, "instructions": 500, "flops": 4000,
                      "bytes": 400, "embree_instructions": 0, "sampled_rays": 64}]}
KERNELS = {"benchmarks": [{"name": "slab/avx2", "run_type": "iteration", "s/pair": 2e-9},
                          {"name": "frame/avx2", "run_type": "iteration"}]}


def measured(folder, **parts):
    for name, data in parts.items():
        (folder / f"{name}.json").write_text(json.dumps(data))
        (folder / f"{name}.context").write_text("command: scripts/bench --quick\nmachine: a <fast> one\n")


class Report(unittest.TestCase):
    def run_report(self, page="performance", named=(), **parts):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            measured(folder, **parts)
            code = report.main([str(folder), str(folder / "docs"), *named])
            files = {f.name: f.read_text() for f in folder.glob("docs/**/*.*")}
            return code, files.pop(f"{page}.md", ""), files

    def test_whole_page(self):
        code, page, pictures = self.run_report(compare=COMPARE, runs=RUNS, roofline=ROOFLINE, kernels=KERNELS)
        self.assertEqual(code, 0)
        self.assertIn("| primary | 100 | 40.0 | 16 | 2.50 (1.25-5.00) |", page)
        self.assertIn("| bunny | primary | - | 100 (4.00x) | - |", page)  # beside Embree kept to the ISA
        self.assertIn("| bunny | primary | 2 | 1.90 |", page)
        self.assertIn("| povray | 5.000 | 5.000 | 5 | 20.00 (10.00-40.00) |", page)
        self.assertIn("failed: no picture", page)
        self.assertIn("| slab | - | 2.00 | - |", page)
        self.assertNotIn("frame", page)
        self.assertIn("`scripts/bench --quick`", page)
        for name, svg in pictures.items():
            self.assertIn(f"images/{name}", page)
            xml.fromstring(svg)
        self.assertEqual(len(pictures), 4)

    def test_what_is_not_measured_is_not_there(self):
        _, page, pictures = self.run_report(runs=RUNS)
        self.assertNotIn("Roofline", page)
        self.assertEqual(list(pictures), ["performance-runs.svg"])

    def test_another_name(self):
        _, page, pictures = self.run_report(page="other", named=["other"], runs=RUNS)
        self.assertEqual(list(pictures), ["other-runs.svg"])
        self.assertIn("(images/other-runs.svg)", page)

    def test_nothing_measured(self):
        self.assertEqual(self.run_report()[0], 2)

    def test_shares_of_the_limits(self):
        self.assertEqual(roofline.shares(ROOFLINE["rays"][0], ROOFLINE["limits"]), [20, 25, 10])


class Charts(unittest.TestCase):
    def test_bars_are_in_proportion(self):
        svg = xml.fromstring(chart("a < b", ("one", "two"), [("panel", [("x", [10, 5], ""), ("y", [None, 2.5], "")])]))
        bars = [float(r.get("width")) for r in svg.iter("{http://www.w3.org/2000/svg}rect") if r.get("height") == "11"
                and r.get("y") != "40"]
        self.assertEqual(len(bars), 3)
        self.assertAlmostEqual(bars[0] / bars[1], 2, places=1)
        self.assertAlmostEqual(bars[0] / bars[2], 4, places=1)

    def test_three_digits(self):
        self.assertEqual([short(v) for v in (1234.5, 99.96, 12.34, 1.234, 0.01234, 0)],
                         ["1234", "100", "12.3", "1.23", "0.0123", "0"])


if __name__ == "__main__":
    unittest.main()

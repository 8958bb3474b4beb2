#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Turns what the benchmarks measured into a page and its pictures.

report.py MEASURED DOCS [PAGE]: MEASURED holds compare.json, runs.json, kernels.json and roofline.json, as far as they
were measured, each with a text PART.context of lines "name: value" that says how. Writes DOCS/PAGE.md [performance] and
DOCS/images/PAGE-*.svg. The same input gives the same output."""
import json
import pathlib
import sys

import roofline
import sections

PARTS = ("compare", "runs", "roofline", "kernels")


def read(folder):
    data, contexts = {}, {}
    for part in PARTS:
        file = folder / f"{part}.json"
        if not file.exists():
            continue
        data[part] = json.loads(file.read_text())
        context = folder / f"{part}.context"
        lines = context.read_text().splitlines() if context.exists() else []
        contexts[part] = dict(line.split(": ", 1) for line in lines if ": " in line)
    return data, contexts


def how(contexts):
    rows = [(part, f"`{c.get('command', '?')}`", c.get("machine", "?"), c.get("compiler", "?"), c.get("commit", "?"),
             c.get("date", "?")) for part, c in contexts.items()]
    return ["## How", "", "`scripts/bench --report MODEL...` measures and writes this page and its pictures.", "",
            *sections.table(("part", "command", "machine", "compiler", "commit", "date"), rows)]


def document(data, contexts):
    pictures = {}
    lines = ["<!-- Written by bench/performance/report.py from measurements: do not edit. -->", "# Performance", "",
             "Every number of this page was measured on one machine; the last section says which and how.", ""]
    if "compare" in data:
        compare = data["compare"]
        lines += sections.rays(compare, pictures) + sections.instruction_sets(compare)
        lines += sections.threads(compare) + sections.builds(compare, pictures)
    if "runs" in data:
        lines += sections.whole_runs(data["runs"], pictures)
    if "roofline" in data:
        lines += roofline.roofline(data["roofline"], pictures)
    if "kernels" in data:
        lines += sections.kernels(data["kernels"])
    return "\n".join(lines + how(contexts)), pictures


def main(arguments):
    if len(arguments) not in (2, 3):
        print("usage: report.py MEASURED DOCS [PAGE]", file=sys.stderr)
        return 2
    measured, docs = map(pathlib.Path, arguments[:2])
    name = arguments[2] if len(arguments) == 3 else "performance"
    data, contexts = read(measured)
    if not data:
        print(f"report.py: nothing measured in {measured}", file=sys.stderr)
        return 2
    page, pictures = document(data, contexts)
    (docs / "images").mkdir(parents=True, exist_ok=True)
    (docs / f"{name}.md").write_text(page.replace(sections.IMAGE, f"images/{name}-"))
    for part, svg in pictures.items():
        (docs / "images" / f"{name}-{part}.svg").write_text(svg)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

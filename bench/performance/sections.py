# SPDX-License-Identifier: Apache-2.0
"""The sections of the page. Each takes the numbers of one part of the benchmarks and returns Markdown lines, and puts its
charts into `pictures` under their names."""
from charts import chart, short

WIDEST = ("avx512", "avx2", "sse4.2")
ISAS = ("sse4.2", "avx2", "avx512")


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    return lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows] + [""]


# Where pictures lie, before the page has its name.
IMAGE = "images/PAGE-"


def picture(pictures, name, words, svg):
    pictures[name] = svg
    return [f"![{words}]({IMAGE}{name}.svg)", ""]


def spread(s):
    return f"{s['median']:.2f} ({s['min']:.2f}-{s['max']:.2f})" if s["median"] else "-"


def unique(values):
    return list(dict.fromkeys(values))


def row_of(traversal, isas=WIDEST):
    rows = {row["isa"]: row for row in traversal["fastrt"]}
    return next((rows[isa] for isa in isas if isa in rows), None)


def rays(compare, pictures):
    traversals = [t for t in compare["traversals"] if t["threads"] == 1 and row_of(t)]
    panels, lines = [], []
    for model in unique(t["model"] for t in traversals):
        bars, rows = [], []
        for t in (t for t in traversals if t["model"] == model):
            best = row_of(t)
            ratio = best["ratio"]["median"]
            bars.append((t["rays"], [best["mrays"]["median"], t["embree_best"]["mrays"]["median"] or None],
                         f"{ratio:.2f}x" if ratio else ""))
            rows.append((t["rays"], short(best["mrays"]["median"]), short(t["embree_best"]["mrays"]["median"]),
                         t["embree_best"]["mode"] or "-", spread(best["ratio"]), spread(best["robust_ratio"])))
        panels.append((model, bars))
        lines += [f"**{model}**", ""] + table(
            ("rays", "fastrt", "Embree", "Embree's mode", "ratio", "ratio to robust"), rows)
    svg = chart("Million rays a second, one thread", ("fastrt", f"Embree {compare['embree']}, its fastest mode"), panels)
    return ["## Rays", "",
            "Tracing alone: the rays of one picture, the same for both, in one process and in turn; of slow sets a part, spread "
            "over the picture, and fast ones several times. Both trees are of their library's default quality (Embree's: medium). Embree's mode is the "
            "fastest of those tried anew for every row: packets of 1, 4, 8 and 16 rays, and batches of up to 256 as streams "
            "(`rtcIntersect1M`, `1Mp`, `NM`, `Np`, or `rtcOccluded` of these), each with and without its flag for coherent rays. "
            "Its calls run with denormals flushed to zero, as its manual recommends; fastrt's do not. Times are CPU times of the "
            "thread. Mrays/s; ratios are medians over rounds (smallest-largest).", "",
            "Where the closest hit is asked for (primary, mirror, refracted and random rays) the answers are not the same: fastrt "
            "gives distance and primitive, and finds the place on it and the normal when it shades; Embree gives distance, "
            "primitive, barycentric coordinates and normal.", "",
            *picture(pictures, "rays", "Million rays a second per model and kind of rays", svg), *lines]


def instruction_sets(compare):
    rows = []
    for t in (t for t in compare["traversals"] if t["threads"] == 1):
        cells = [t["model"], t["rays"]]
        for isa in ISAS:
            row = row_of(t, (isa,))
            ratio = row["peer"]["ratio"]["median"] if row else 0
            cells.append((short(row["mrays"]["median"]) + (f" ({ratio:.2f}x)" if ratio else "")) if row else "-")
        rows.append(cells)
    return ["## Instruction sets", "",
            "Mrays/s of one thread, and the ratio to Embree kept to the same instruction set (`isa=` of its device): to the "
            "faster of its two modes whose packets are as wide as the registers (4, 8 and 16 rays). Each has the tree that it "
            "builds for the instruction set, and all are measured in turn.", "",
            *table(("model", "rays", "SSE4.2", "AVX2", "AVX-512"), rows)]


def threads(compare):
    rows, by_key = [], {(t["model"], t["rays"], t["threads"]): t for t in compare["traversals"]}
    for (model, kind, count), t in by_key.items():
        one = by_key.get((model, kind, 1))
        if count == 1 or one is None or row_of(t) is None:
            continue
        embree = one["embree_best"]["mrays"]["median"]
        rows.append((model, kind, count, f"{row_of(t)['mrays']['median'] / row_of(one)['mrays']['median']:.2f}",
                     f"{t['embree_best']['mrays']['median'] / embree:.2f}" if embree else "-",
                     spread(row_of(t)["ratio"])))
    return ["## Threads", "", "How many times the rays of one thread, and the ratio to Embree's fastest mode.", "",
            *table(("model", "rays", "threads", "fastrt", "Embree", "ratio"), rows)] if rows else []


def builds(compare, pictures):
    if not compare["builds"]:
        return []
    bars, rows = {"seconds": [], "bytes a primitive": []}, []
    for b in compare["builds"]:
        label, count = f"{b['model']}, {b['threads']} thr.", b["primitives"]
        ratio = b["ratio"]["median"]
        bars["seconds"].append((label, [b["fastrt_seconds"]["median"], b["embree_seconds"]["median"] or None],
                                f"{ratio:.2f}x" if ratio else ""))
        if b["threads"] == 1:
            bars["bytes a primitive"].append((b["model"], [b["fastrt_bytes"] / count, b["embree_bytes"] / count or None], ""))
        rows.append((b["model"], f"{count:,}", b["threads"], short(b["fastrt_seconds"]["median"]),
                     short(b["embree_seconds"]["median"]), spread(b["ratio"]),
                     *(f"{b[key] / count:.0f}" for key in
                       ("fastrt_bytes", "embree_bytes", "fastrt_peak_bytes", "embree_peak_bytes"))))
    svg = chart("Building the tree", ("fastrt", "Embree, medium quality"), list(bars.items()))
    return ["## Building the tree", "",
            "Seconds by the clock, and bytes a primitive: of the tree with its primitives, and at most while it is built.", "",
            *picture(pictures, "build", "Seconds and bytes of building", svg),
            *table(("model", "primitives", "threads", "fastrt s", "Embree s", "Embree s / fastrt s", "fastrt B", "Embree B",
                    "fastrt peak B", "Embree peak B"), rows)]


def whole_runs(runs, pictures):
    panels, rows = [], []
    keys = unique((r["model"], r["threads"]) for r in runs["runs"])
    for model, count in keys:
        bars = []
        for r in (r for r in runs["runs"] if (r["model"], r["threads"]) == (model, count)):
            if r["fault"]:
                rows.append((model, count, r["program"], f"failed: {r['fault']}", "", "", ""))
                continue
            times = r["times_fastrt"]
            bars.append((r["program"], [r["seconds"]["median"]],
                         "" if r["program"].startswith("fastrt") else f"{times['median']:.1f}x"))
            rows.append((model, count, r["program"], f"{r['seconds']['median']:.3f}", f"{r['cpu_seconds']:.3f}",
                         f"{r['peak_bytes'] / 1e6:.0f}",
                         "" if r["program"].startswith("fastrt") else spread(times)))
        panels.append((f"{model}, {count} thread{'s' if count > 1 else ''}", bars))
    svg = chart("Whole runs: seconds from start to picture", ("seconds",), panels)
    return ["## Whole runs", "",
            "From the start of the program to the finished picture: read, build, render, write; 1024 x 1024 pixels, one "
            "sample. OBJ files: for all the same triangles, one light, shadows, and plain grey surfaces: fastrt and Embree's `pathtracer` "
            "read them from an OBJ file without materials and normals, the others in their own words. `pathtracer` traces paths of length 1. NFF files (the "
            "Standard Procedural Databases): their own view, lights, shadows, mirrors and refraction, five levels; the others get them "
            "in their own words. (Tachyon reads NFF, but shows less of it, at a wider angle, and nothing of gears. It knows no refraction, of which "
            "mount and gears have much, and no cones: these are cylinders.) The others write PPM. The last column is the time divided by that of fastrt writing PNG.", "",
            *picture(pictures, "runs", "Seconds of whole runs", svg),
            *table(("model", "threads", "program", "s", "CPU s", "peak MB", "times fastrt's"), rows)]


def kernels(data):
    rows = {}
    for b in data["benchmarks"]:
        name, _, isa = b["name"].rpartition("/")
        if b.get("run_type") != "aggregate" and "s/pair" in b and isa in ISAS:
            rows.setdefault(name, {})[isa] = f"{b['s/pair'] * 1e9:.2f}"
    return ["## Kernels", "", "Nanoseconds a ray and primitive (or a value, for `pow` and `exp`), one thread. Of the rays 19 % "
            "meet their triangle, 65 % their sphere and 70 % their box.", "",
            *table(("kernel", "SSE4.2", "AVX2", "AVX-512"),
                   [(name, *(cells.get(isa, "-") for isa in ISAS)) for name, cells in rows.items()])]

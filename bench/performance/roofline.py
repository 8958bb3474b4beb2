# SPDX-License-Identifier: Apache-2.0
"""The roofline: what a ray costs, what the machine can do, and the distance."""
from charts import chart, short
from sections import picture, table, unique


def shares(row, limits):
    """Of the machine's limits, in percent: operations, instructions, bytes."""
    per_second = row["mrays"] * 1e6
    return [100 * row["flops"] * per_second / (limits["gflops"][row["isa"]] * 1e9),
            100 * row["instructions"] * per_second / (limits["ginstructions"] * 1e9),
            100 * row["bytes"] * per_second / (limits["memory_gb"] * 1e9)]


def roofline(data, pictures):
    limits, panels, rows = data["limits"], [], []
    for model, isa in unique((r["model"], r["isa"]) for r in data["rays"]):
        bars = []
        for r in (r for r in data["rays"] if (r["model"], r["isa"]) == (model, isa)):
            reached = shares(r, limits)
            bars.append((r["rays"], reached, ""))
            rows.append((model, isa, r["rays"], short(r["mrays"]), short(r["instructions"]), short(r["flops"]),
                         short(r["bytes"]), short(r["flops"] / r["bytes"]) if r["bytes"] else "-",
                         *(f"{share:.0f} %" for share in reached),
                         short(r["embree_instructions"]) if r["embree_instructions"] else "-"))
        panels.append((f"{model}, {isa}", bars))
    gflops = limits["gflops"]
    svg = chart("Share of the machine's limits, one thread, percent",
                ("operations (FMA peak)", "instructions", "bytes (memory)"), panels)
    return ["## Roofline", "",
            "What a ray costs: instructions and single-precision operations (every lane counts, masked or not; comparisons, "
            "minima and maxima count, FMA is two), counted by stepping the processor through batches of rays one "
            "instruction at a time; bytes are the distinct cache lines of nodes and primitives that a batch touches "
            "(256 rays; 64 where they share no origin or direction). Beside it, what one thread of this machine can do at most, measured by loops that do nothing else. A ray that "
            "finds its lines in a cache does not meet the memory's limit, so that share is an upper bound.", "",
            *table(("limit, one thread", "measured"),
                   [*((f"operations, {isa}", f"{value:.0f} GFLOP/s") for isa, value in gflops.items()),
                    ("instructions", f"{limits['ginstructions']:.1f} G/s"),
                    ("reading memory", f"{limits['memory_gb']:.1f} GB/s"),
                    ("copying memory", f"{limits['copy_gb']:.1f} GB/s"),
                    ("reading the second cache level", f"{limits['cache_gb']:.0f} GB/s"),
                    (f"reading memory, {limits['threads']} threads", f"{limits['memory_gb_all']:.1f} GB/s")]),
            *picture(pictures, "roofline", "Share of the machine's limits", svg),
            *table(("model", "ISA", "rays", "Mrays/s", "instr. / ray", "FLOP / ray", "B / ray", "FLOP / B", "of FLOP/s",
                    "of instr./s", "of memory", "Embree's instr. / ray"), rows)]

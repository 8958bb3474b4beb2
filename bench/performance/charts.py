# SPDX-License-Identifier: Apache-2.0
"""Bar charts as SVG text: panels of rows of horizontal bars, each panel with a scale of its own."""
from html import escape

COLOURS = ("#2a6fbb", "#e08a2e", "#5a9e5d", "#9a6bb0")
PANEL, LABEL, BAR, GAP, HEAD = 460, 146, 13, 9, 30  # pixels


def short(value):
    """Three digits that count: 123, 12.3, 1.23, 0.0123."""
    if value == 0:
        return "0"
    digits = 0
    while abs(value) * 10**digits < 99.5 and digits < 6:
        digits += 1
    return f"{value:.{digits}f}"


def text(x, y, words, more=""):
    return f'<text x="{x:g}" y="{y:g}"{more}>{escape(words)}</text>'


def panel_height(panel, series):
    return HEAD + len(panel[1]) * (len(series) * BAR + GAP)


def draw_panel(panel, series, x, y):
    title, rows = panel
    out = [text(x, y + 18, title, ' font-weight="bold"')]
    largest = max((value for _, values, _ in rows for value in values if value), default=0) or 1
    room = PANEL - LABEL - 90  # the rest is for the words behind the bar
    y += HEAD
    for label, values, note in rows:
        middle = y + len(series) * BAR / 2
        out.append(text(x + LABEL - 6, middle + 4, label, ' text-anchor="end"'))
        for i, value in enumerate(values):
            if value is None:
                continue
            length = max(1.0, room * value / largest)
            top = y + i * BAR
            out.append(f'<rect x="{x + LABEL:g}" y="{top:g}" width="{length:.1f}" height="{BAR - 2}"'
                       f' fill="{COLOURS[i]}"/>')
            words = short(value) + (f" ({note})" if i == 0 and note else "")
            out.append(text(x + LABEL + length + 4, top + 10, words, ' font-size="11"'))
        y += len(series) * BAR + GAP
    return out


def chart(title, series, panels):
    """The SVG's text. series: what the bars of a row are. panels: (title, [(label, values, note)]); a value that is
    None has no bar; the note stands behind the first bar."""
    columns = min(2, len(panels))
    heights = [20.0 + 42] * columns  # what is used of each column
    body = []
    for panel in panels:
        column = heights.index(min(heights))
        body += draw_panel(panel, series, 16 + column * (PANEL + 16), heights[column])
        heights[column] += panel_height(panel, series) + 8
    width, height = 16 + columns * (PANEL + 16), max(heights) + 8
    head = [text(16, 26, title, ' font-size="16" font-weight="bold"')]
    x = 16
    for colour, name in zip(COLOURS, series):
        head.append(f'<rect x="{x}" y="40" width="11" height="11" fill="{colour}"/>')
        head.append(text(x + 16, 50, name))
        x += 34 + 7 * len(name)
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}" height="{height:g}"'
        f' viewBox="0 0 {width:g} {height:g}" font-family="sans-serif" font-size="12" fill="#222">',
        '<rect width="100%" height="100%" fill="#ffffff"/>', *head, *body, "</svg>", ""])

"""Boxes, arrows, wires and legible text as SVG, with nothing but the standard library.

A Picture has its own background, so it reads on light and dark pages, and draws the same bytes every time. It looks at itself
before it is written: a text that is too small, leaves its box or the picture, or lies on another text or on a line, is a
Problem that names it. Sizes are in px of a picture that is WIDTH wide.
"""
from xml.sax.saxutils import escape, quoteattr

WIDTH = 1000
SMALLEST_TEXT = 12
PAGE, EDGE, INK, MUTED = "#fbfcfe", "#c5ced8", "#1b2733", "#4a5866"
RED, GREEN, BLUE, ORANGE = "#b91c1c", "#1f7a44", "#1d5fa8", "#a85b00"

# Fill and edge by what a box stands for.
KINDS = {
    "ros": ("#e1ecfb", BLUE),
    "driver": ("#e3f3e8", GREEN),
    "bus": ("#fff1d9", ORANGE),
    "device": ("#eceff3", MUTED),
    "stop": ("#fde6e6", RED),
    "plain": ("#ffffff", EDGE),
    "group": ("#f4f6f9", EDGE),
}

# Width of a character in thousandths of the size, of a wide sans-serif font; what is not listed is as wide as a digit.
_WIDTHS = {400: "fijltI.,:;'!|()[]-/ ", 520: "rsczJ", 1000: "mwMW%@"}
_WIDTH_OF = {character: width for width, characters in _WIDTHS.items() for character in characters}
_CAPITALS = 720


class Problem(Exception):
    """What nobody could read in this picture."""


def text_width(text, size, bold=False, mono=False):
    """How wide a text may become; fonts differ, so it is an upper estimate."""
    if mono:
        return len(text) * size * 0.61
    thousandths = sum(_WIDTH_OF.get(one, _CAPITALS if one.isupper() else 635) for one in text)
    return thousandths * size / 1000 * (1.1 if bold else 1.0)


def _number(value):
    return f"{value:.1f}".rstrip("0").rstrip(".")


def _points(points):
    return " ".join(f"{_number(x)},{_number(y)}" for x, y in points)


def _overlap(one, other):
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def _crosses(start, end, box):
    """Whether a straight line meets a rectangle (Liang and Barsky)."""
    first, last = 0.0, 1.0
    for p, q in ((start[0] - end[0], start[0] - box[0]), (end[0] - start[0], box[2] - start[0]),
                 (start[1] - end[1], start[1] - box[1]), (end[1] - start[1], box[3] - start[1])):
        if p == 0:
            if q < 0:
                return False
        elif p < 0:
            first = max(first, q / p)
        else:
            last = min(last, q / p)
    return first <= last


class Picture:
    """One picture; `title` and `description` are what a screen reader says."""

    def __init__(self, name, height, title, description):
        self.name, self.height = name, height
        self._head = (title, description)
        self._below, self._shapes, self._labels = [], [], []
        self._texts, self._off_lines, self._lines, self._problems = [], [], [], []

    # --- text ---

    def text(self, x, y, text, size=14, anchor="start", bold=False, mono=False, colour=INK, halo=False, within=None):
        """One line with its baseline at y. `halo`: it may lie on a line, which ends around it. `within`: (left, right)."""
        width = text_width(text, size, bold, mono)
        left = {"start": x, "middle": x - width / 2, "end": x - width}[anchor]
        box = (left, y - 0.78 * size, left + width, y + 0.22 * size)
        limits = within or (8, WIDTH - 8)
        if size < SMALLEST_TEXT:
            self._problems.append(f'"{text}" is {size} px high, at least {SMALLEST_TEXT} are legible')
        if box[0] < limits[0] or box[2] > limits[1] or box[1] < 0 or box[3] > self.height:
            self._problems.append(f'"{text}" is {width:.0f} px wide and leaves its place of {limits[1] - limits[0]:.0f} px')
        for other, taken in self._texts:
            if _overlap(box, taken):
                self._problems.append(f'"{text}" lies on "{other}"')
        self._texts.append((text, box))
        if not halo:
            self._off_lines.append((text, box))
        family = "monospace" if mono else "sans-serif"
        weight = ' font-weight="bold"' if bold else ""
        place = "" if anchor == "start" else f' text-anchor="{anchor}"'
        if halo:
            self._labels.append(f'<rect x="{_number(box[0] - 3)}" y="{_number(box[1] - 1)}" width="{_number(width + 6)}" '
                                f'height="{_number(size + 2)}" fill="{halo if isinstance(halo, str) else PAGE}"/>')
        self._labels.append(f'<text x="{_number(x)}" y="{_number(y)}" font-family="{family}" font-size="{_number(size)}"{weight}'
                            f'{place} fill="{colour}">{escape(text)}</text>')

    def lines(self, x, y, lines, size=13, step=None, **how):
        """Several lines of text, the first with its baseline at y."""
        step = step or round(size * 1.35)
        for number, line in enumerate(lines):
            self.text(x, y + number * step, line, size, **how)

    # --- shapes ---

    def box(self, x, y, width, height, lines=(), kind="plain", size=14, title=True, align="middle", radius=8, mono=()):
        """A box with lines of text in its middle; the first is bold (`title`). `mono`: numbers of lines of fixed width."""
        fill, edge = KINDS[kind]
        self._shapes.append(f'<rect x="{_number(x)}" y="{_number(y)}" width="{_number(width)}" height="{_number(height)}" '
                            f'rx="{radius}" fill="{fill}" stroke="{edge}" stroke-width="1.6"/>')
        corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height), (x, y)]
        self._lines += list(zip(corners, corners[1:]))
        sizes = [size + 1 if title and number == 0 else size for number in range(len(lines))]
        steps = [round(one * 1.36) for one in sizes]
        baseline = y + (height - sum(steps)) / 2 + (steps[0] * 0.77 if steps else 0)
        for number, line in enumerate(lines):
            place = {"middle": x + width / 2, "start": x + 12}[align]
            self.text(place, baseline, line, sizes[number], align, bold=title and number == 0, mono=number in mono,
                      within=(x + 3, x + width - 3))
            if number + 1 < len(lines):
                baseline += steps[number + 1]

    def line(self, points, colour=MUTED, width=2.0, arrow="", dash="", below=False):
        """A line through all points. `arrow`: "end", "start" or "both"."""
        self._lines += list(zip(points, points[1:]))
        style = f' stroke-dasharray="{dash}"' if dash else ""
        if arrow in ("end", "both"):
            style += f' marker-end="url(#{self._marker(colour)})"'
        if arrow in ("start", "both"):
            style += f' marker-start="url(#{self._marker(colour)})"'
        (self._below if below else self._shapes).append(
            f'<polyline points="{_points(points)}" fill="none" stroke="{colour}" stroke-width="{_number(width)}" '
            f'stroke-linejoin="round"{style}/>')

    @staticmethod
    def _marker(colour):
        return "arrow" + colour.lstrip("#")

    def dot(self, x, y, colour=INK, radius=4.0):
        self._shapes.append(f'<circle cx="{_number(x)}" cy="{_number(y)}" r="{_number(radius)}" fill="{colour}"/>')

    def circle(self, x, y, radius, fill="#ffffff", edge=MUTED):
        self._shapes.append(f'<circle cx="{_number(x)}" cy="{_number(y)}" r="{_number(radius)}" fill="{fill}" stroke="{edge}" '
                            'stroke-width="1.6"/>')

    def bar(self, x, y, width, height, colour=INK):
        self._shapes.append(f'<rect x="{_number(x)}" y="{_number(y)}" width="{_number(width)}" height="{_number(height)}" '
                            f'rx="3" fill="{colour}"/>')

    def resistor(self, x, top, bottom, label="", side="end", size=13, colour=INK):
        """An upright resistor between two heights, its value beside it (`side`: "end" right, "start" left)."""
        middle, half = (top + bottom) / 2, min(17, (bottom - top) / 2 - 4)
        self.line([(x, top), (x, middle - half)], colour, 2)
        self.line([(x, middle + half), (x, bottom)], colour, 2)
        self._shapes.append(f'<rect x="{_number(x - 6)}" y="{_number(middle - half)}" width="12" height="{_number(2 * half)}" '
                            f'fill="#ffffff" stroke="{colour}" stroke-width="2"/>')
        if label:
            self.text(x + (12 if side == "end" else -12), middle + size * 0.35, label, size,
                      "start" if side == "end" else "end", bold=True)

    def earth(self, x, y, colour=MUTED):
        """Functional earth below a point."""
        self.line([(x, y), (x, y + 10)], colour, 2)
        for number, half in enumerate((11, 7, 3)):
            self.line([(x - half, y + 10 + 5 * number), (x + half, y + 10 + 5 * number)], colour, 2)

    def table(self, x, y, widths, rows, size=13, row_height=24, head=1, mono=()):
        """Rows of texts; the first `head` rows and the first column are bold."""
        total = sum(widths)
        for number, row in enumerate(rows):
            top = y + number * row_height
            fill = KINDS["device"][0] if number < head else ("#ffffff" if number % 2 else KINDS["group"][0])
            self._shapes.append(f'<rect x="{_number(x)}" y="{_number(top)}" width="{_number(total)}" height="{row_height}" '
                                f'fill="{fill}"/>')
            left = x
            for column, cell in enumerate(row):
                self.text(left + 8, top + row_height / 2 + size * 0.36, cell, size, bold=number < head or column == 0,
                          mono=column in mono and number >= head, within=(left, left + widths[column]))
                left += widths[column]
        bottom = y + len(rows) * row_height
        self._shapes.append(f'<rect x="{_number(x)}" y="{_number(y)}" width="{_number(total)}" height="{_number(bottom - y)}" '
                            f'fill="none" stroke="{EDGE}" stroke-width="1.4"/>')
        return bottom

    # --- the whole ---

    def _look(self):
        problems = list(self._problems)
        for text, box in self._off_lines:
            inner = (box[0] + 1, box[1] + 1, box[2] - 1, box[3] - 1)
            if any(_crosses(start, end, inner) for start, end in self._lines):
                problems.append(f'"{text}" lies on a line')
        if problems:
            raise Problem("\n".join(f"{self.name}: {problem}" for problem in problems))

    def svg(self):
        """The text of the file. Raises Problem where somebody could not read it."""
        self._look()
        body = "\n".join(self._below + self._shapes + self._labels)
        colours = sorted({part.split("#arrow")[1].split(")")[0] for part in body.split("url(")[1:] if part.startswith("#arrow")})
        markers = "\n".join(
            f'<marker id="arrow{colour}" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" '
            f'orient="auto-start-reverse"><path d="M0,0.5 L10,5 L0,9.5 z" fill="#{colour}"/></marker>' for colour in colours)
        title, description = self._head
        defs = f"<defs>\n{markers}\n</defs>\n" if markers else ""
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {self.height}" width="{WIDTH}" '
                f'height="{self.height}" role="img" aria-label={quoteattr(title)}>\n'
                f"<title>{escape(title)}</title>\n<desc>{escape(description)}</desc>\n{defs}"
                f'<rect x="1" y="1" width="{WIDTH - 2}" height="{self.height - 2}" rx="10" fill="{PAGE}" stroke="{EDGE}" '
                f'stroke-width="1.6"/>\n{body}\n</svg>\n')

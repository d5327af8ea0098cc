"""Draws the diagrams of docs/concepts.md beside this file, or in OUT. Usage: draw.py [OUT]"""
import math
import pathlib
import sys

OUT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
INK, PALE, BLUE, RED, GREEN = "#2b3440", "#e8eef5", "#2f6fb7", "#c8452f", "#3c8d5a"


class Drawing:
    def __init__(self, width, height):
        self.width, self.height, self.parts = width, height, []

    def polygon(self, points, fill="none", stroke=INK, width=1.4, closed=True, dash=""):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<{"polygon" if closed else "polyline"} points="{path}" fill="{fill}" stroke="{stroke}" '
                          f'stroke-width="{width}" stroke-linejoin="round"{dashes}/>')

    def line(self, a, b, stroke=INK, width=1.4, dash="", arrow=False):
        self.polygon([a, b], stroke=stroke, width=width, closed=False, dash=dash)
        if arrow:
            angle = math.atan2(b[1] - a[1], b[0] - a[0])
            tips = [(b[0] - 9 * math.cos(angle + t), b[1] - 9 * math.sin(angle + t)) for t in (0.4, -0.4)]
            self.polygon([tips[0], b, tips[1]], fill=stroke, stroke=stroke, width=0.5)

    def dot(self, p, fill=INK, radius=4):
        self.parts.append(f'<circle cx="{p[0]:.1f}" cy="{p[1]:.1f}" r="{radius}" fill="{fill}" stroke="white"/>')

    def ellipse(self, p, rx, ry, angle, stroke=BLUE):
        self.parts.append(f'<ellipse cx="{p[0]:.1f}" cy="{p[1]:.1f}" rx="{rx:.1f}" ry="{ry:.1f}" fill="none" '
                          f'stroke="{stroke}" transform="rotate({angle:.1f} {p[0]:.1f} {p[1]:.1f})"/>')

    def text(self, p, words, fill=INK, size=14, anchor="middle", style="normal"):
        self.parts.append(f'<text x="{p[0]:.1f}" y="{p[1]:.1f}" fill="{fill}" font-size="{size}" '
                          f'text-anchor="{anchor}" font-style="{style}">{words}</text>')

    def save(self, name, title):
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" '
                f'width="{self.width}" height="{self.height}" font-family="system-ui, sans-serif" role="img">\n<title>{title}</title>\n'
                f'<rect width="{self.width}" height="{self.height}" rx="8" fill="white"/>\n')
        (OUT / name).write_text(head + "\n".join(self.parts) + "\n</svg>\n", encoding="utf-8")


def ring(centre, count, rx, ry, turn=0.0):
    angles = [turn + 2 * math.pi * k / count for k in range(count)]
    return [(centre[0] + rx * math.cos(angle), centre[1] + ry * math.sin(angle)) for angle in angles]


def collapse():
    d = Drawing(640, 240)
    around = [(60, 120), (100, 55), (170, 40), (235, 60), (265, 125), (225, 190), (150, 205), (90, 185)]
    u, v = (135, 120), (200, 120)
    upper, lower = (170, 40), (150, 205)
    for p in around:
        beside = [w for w in (u, v) if p in (upper, lower) or (p[0] < 160) == (w is u)]
        for w in beside:
            d.line(w, p)
    for triangle in ([u, v, upper], [u, v, lower]):
        d.polygon(triangle, fill="#f4cfc7", stroke=INK)
    d.polygon(around)
    d.line(u, v, stroke=RED, width=3)
    for p, name in ((u, "u"), (v, "v")):
        d.dot(p, RED, 5)
        d.text((p[0] + (-14 if p is u else 14), p[1] + 18), name, RED, style="italic")
    d.line((295, 120), (350, 120), arrow=True, width=2)
    moved = [(x + 315, y) for x, y in around]
    w = (485, 116)
    for p in moved:
        d.line(w, p)
    d.polygon(moved)
    d.dot(w, RED, 5)
    d.text((w[0] + 16, w[1] + 20), "p", RED, style="italic")
    d.text((162, 230), "the pair (u, v) and its two faces")
    d.text((477, 230), "one vertex, two faces less")
    d.save("collapse.svg", "An edge collapse: u and v become one vertex at p")


def one_ring():
    d = Drawing(640, 240)
    left, right = ring((165, 115), 6, 85, 80, 0.3), ring((470, 115), 8, 120, 90, 0.1)
    d.polygon(left, fill=PALE)
    for p in left:
        d.line((165, 115), p)
    d.polygon(left, stroke=BLUE, width=3)
    d.dot((165, 115), INK, 5)
    d.text((179, 135), "v", style="italic")
    d.text((165, 230), "the one-ring of v")
    u, v = (435, 118), (505, 112)
    d.polygon(right, fill=PALE)
    for k, p in enumerate(right):
        if k in (2, 6):
            d.line(u, p), d.line(v, p)
        else:
            d.line(v if k in (0, 1, 7) else u, p)
    d.line(u, v, stroke=RED, width=3)
    d.polygon(right)
    for k in (2, 6):
        d.dot(right[k], GREEN, 6)
    d.dot(u, RED, 5), d.dot(v, RED, 5)
    d.text((475, 230), "link condition: two common neighbours")
    d.save("one-ring.svg", "The one-ring of a vertex, and the link condition of a pair")


def quadric():
    d = Drawing(640, 240)
    corner = (200, 90)
    profile = [(40, 190), (120, 140), corner, (285, 120), (370, 185)]
    for (a, b) in zip(profile[1:3], profile[2:4]):
        t = [(a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])) for s in (-0.7, 1.7)]
        d.line(*t, stroke=BLUE, dash="5 4", width=1)
    d.polygon(profile, closed=False, width=2.5)
    for p in profile:
        d.dot(p)
    for k in (1, 2, 3):
        d.ellipse(corner, 20 * k, 9 * k, 0)
    d.dot(corner, RED, 5)
    d.text((200, 48), "smallest sum of squared distances", RED)
    d.text((200, 228), "planes of faces, seen from the side")
    flat = [(420, 130), (480, 128), (545, 130), (610, 129)]
    d.polygon(flat, closed=False, width=2.5)
    for p in flat:
        d.dot(p)
    for k in (1, 2):
        d.parts.append(f'<path d="M410 {130 - 12 * k} H620 M410 {130 + 12 * k} H620" stroke="{BLUE}" fill="none"/>')
    d.text((515, 195), "flat: all of the plane costs")
    d.text((515, 213), "nothing; an end or the middle")
    d.save("quadric.svg", "A quadric is a sum of squared distances to planes; its minimum is where the new vertex goes")


def virtual_edge():
    d = Drawing(640, 220)
    left = [(40, 60), (120, 40), (205, 55), (215, 105), (200, 160), (110, 175), (45, 150), (130, 105)]
    right = [(245, 50), (330, 35), (420, 60), (425, 155), (330, 180), (240, 165), (252, 108), (340, 108)]
    for shape, middle in ((left, 7), (right, 7)):
        rim = [p for k, p in enumerate(shape) if k != middle]
        d.polygon(rim, fill=PALE, width=2)
        for p in rim:
            d.line(shape[middle], p)
    for a, b in ((left[2], right[0]), (left[3], right[6]), (left[4], right[5])):
        d.line(a, b, stroke=RED, width=2.5, dash="4 3")
        d.dot(a, RED), d.dot(b, RED)
    d.text((232, 210), "open borders with a gap; virtual edges join the nearest vertices")
    d.text((530, 95), "A virtual edge has no", anchor="middle")
    d.text((530, 115), "face. Its collapse", anchor="middle")
    d.text((530, 135), "closes the gap.", anchor="middle")
    d.save("virtual-edge.svg", "Virtual edges join vertices of parts that do not touch")


def mapping():
    d = Drawing(640, 300)
    shape = lambda x: 70 - 30 * math.sin((x - 40) / 85) - 6 * math.sin((x - 40) / 14)
    levels = [(10, 0), (40, 75), (140, 150)]
    names = ["the original, time 0", "some collapses later", "the small mesh"]
    inside = []
    for (step, down), name in zip(levels, names):
        xs = list(range(40, 461, step)) if 420 % step == 0 else [*range(40, 460, step), 460]
        points = [(x, shape(x) + down) for x in xs]
        lower = [(x, y + 14) for x, y in points]
        d.polygon(lower, closed=False, stroke="#9aa7b5", width=1.6)
        d.polygon(points, closed=False, width=2)
        for p in points:
            d.dot(p, radius=2.6)
        d.text((480, 75 + down), name, anchor="start")
        k = max(i for i, x in enumerate(xs[:-1]) if x <= 262)
        (x0, y0), (x1, y1) = points[k], points[k + 1]
        inside.append((262, y0 + (y1 - y0) * (262 - x0) / (x1 - x0)))
    for a, b in zip(inside[::-1], inside[-2::-1]):
        d.line(a, (b[0], b[1] + 5), stroke=RED, width=2, arrow=True)
    for p in inside:
        d.dot(p, RED, 4.5)
    d.text((320, 290), "A point goes back collapse by collapse, on its own side of a thin wall.")
    d.save("mapping.svg", "A point of the small mesh finds its place on the original through the collapse history")


collapse(), one_ring(), quadric(), virtual_edge(), mapping()

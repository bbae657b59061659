# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Plots of the examples, in SVG, without any library."""


class Drawing:
    """A plot in SVG: panels with axes, curves and dots."""

    WIDTH, HEIGHT, LEFT = 420, 300, 60

    def __init__(self, file, panels):
        self.file, self.x0 = file, 0
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{panels * (self.WIDTH + self.LEFT) + 30}" '
                   f'height="{self.HEIGHT + 90}" font-family="sans-serif" font-size="14">\n'
                   '<rect width="100%" height="100%" fill="white"/>\n')

    def panel(self, title, below, x, y, x_marks, y_marks):
        """Functions x and y give the place as a share of the panel, from the lower left."""
        self.x0 = self.x0 + self.WIDTH + self.LEFT if self.x0 else self.LEFT
        self.x = lambda value: self.x0 + self.WIDTH * x(value)
        self.y = lambda value: 30 + self.HEIGHT * (1.0 - y(value))
        low, middle = self.HEIGHT + 30, self.x0 + self.WIDTH / 2
        self.file.write(f'<rect x="{self.x0}" y="30" width="{self.WIDTH}" height="{self.HEIGHT}" fill="none" stroke="black"/>\n')
        self.text(middle, 20, title, "middle")
        self.text(middle, low + 45, below, "middle")
        for value, label in x_marks:
            self.text(self.x(value), low + 20, label, "middle")
            self.line([(self.x(value), low), (self.x(value), low - 5)], "black")
        for value, label in y_marks:
            self.text(self.x0 - 6, self.y(value) + 5, label, "end")
            self.line([(self.x0, self.y(value)), (self.x0 + 5, self.y(value))], "black")

    def close(self):
        self.file.write("</svg>\n")

    def text(self, x, y, words, anchor="start", color="black"):
        self.file.write(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{color}">{words}</text>\n')

    def line(self, points, color, dashes=""):
        places = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.file.write(f'<polyline points="{places}" fill="none" stroke="{color}" stroke-dasharray="{dashes}"/>\n')

    def curve(self, points):
        self.line([(self.x(a), self.y(b)) for a, b in points], "#888", "5 4")

    def dots(self, points, color):
        for a, b in points:
            self.file.write(f'<circle cx="{self.x(a):.1f}" cy="{self.y(b):.1f}" r="4" fill="{color}"/>\n')

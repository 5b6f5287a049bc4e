"""A section of the page: a table of rows that were measured, and a figure of them."""
import dataclasses
import pathlib


@dataclasses.dataclass
class Row:
    """One line of a table."""
    cells: list                # texts
    mistake: str = ""          # which tolerance it leaves, and by how much
    data: object = None        # for the figure

    def markdown(self):
        return "| " + " | ".join(self.cells) + " |"


def within(found, expected, share=0.0, absolute=0.0, what=""):
    """A mistake, or none."""
    allowed = share * abs(expected) + absolute
    if abs(found - expected) <= allowed:
        return ""
    return f"{what}: {found:.6g} instead of {expected:.6g}, more than {allowed:.3g} off"


def percent(found, expected):
    return f"{100 * (found / expected - 1):+.2f} %"


def table(columns, rows):
    ruler = "| " + " | ".join("---" if i == 0 else "---:" for i in range(len(columns))) + " |"
    return "\n".join(["| " + " | ".join(columns) + " |", ruler, *(row.markdown() for row in rows)])


def save(figure, path):
    """Equal figures give equal bytes: no date, no random names."""
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, format="svg", metadata={"Date": None, "Creator": None})
    text = path.read_text(encoding="utf-8")
    path.write_text("\n".join(line.rstrip() for line in text.splitlines()) + "\n", encoding="utf-8")


def pyplot():
    """matplotlib, set up for small files that depend on nothing but what is drawn."""
    import matplotlib
    matplotlib.use("svg")
    matplotlib.rcParams.update({
        "svg.hashsalt": "baraka", "svg.fonttype": "none", "figure.figsize": (6.4, 3.4),
        "figure.constrained_layout.use": True, "axes.grid": True, "grid.alpha": 0.3,
        "axes.spines.top": False, "axes.spines.right": False, "font.size": 9, "lines.markersize": 4,
        "font.family": "DejaVu Sans"})
    from matplotlib import pyplot as plt
    plt.close("all")
    return plt

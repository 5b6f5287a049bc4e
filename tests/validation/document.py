"""A section of the page: a table of rows that were measured, and a figure of them."""
import dataclasses


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

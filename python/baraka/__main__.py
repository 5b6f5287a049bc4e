"""python3 -m baraka FILE [OPTIONS]: runs the controller in a file; what `baraka run` starts."""
import pathlib
import sys

if not __package__:  # run by its place, as in a build
    sys.path[0] = str(pathlib.Path(__file__).resolve().parents[1])

from baraka import main  # noqa: E402
from baraka.loading import controller_in  # noqa: E402
from baraka.reporting import report  # noqa: E402

if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit("usage: python3 -m baraka FILE.py --agents NAME [--help]")
    sys.argv.pop(0)
    try:
        found = controller_in(sys.argv[0])
    except Exception as raised:
        sys.exit(report(type(raised), raised, raised.__traceback__))
    main(found)

"""Controllers in files: `program: my_robot.py` of a scenario."""
import importlib.util
import pathlib
import sys

from .controller import Controller, kind_of
from .reporting import report


def controller_in(file):
    """The class below Controller that a file defines; if several, the one named by `controller = …`."""
    path = pathlib.Path(file)
    if str(path.parent) not in sys.path:
        sys.path.insert(0, str(path.parent))  # so that it finds the files beside it
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[path.stem]
        raise
    named = getattr(module, "controller", None)
    if isinstance(named, type):
        return named
    found = [one for one in vars(module).values()
             if isinstance(one, type) and issubclass(one, Controller) and one.__module__ == path.stem]
    leaves = [one for one in found if not any(other is not one and issubclass(other, one) for other in found)]
    if len(leaves) != 1:
        names = ", ".join(one.__name__ for one in leaves) or "none"
        raise TypeError(f"{file}: must have one class below baraka.Controller, or name one by "
                        f"`controller = …`; it has {names}")
    return leaves[0]


def kind_in_file(file):
    """The kind of the controller in a file, as a capsule for `baraka`. Raises ImportError with one line."""
    try:
        of_class = controller_in(file)
        return kind_of(of_class, pathlib.Path(file).name)
    except BaseException as raised:  # also SystemExit: a file that calls sys.exit()
        text = report(type(raised), raised, raised.__traceback__)
        raise ImportError(text if str(file) in text else f"{file}: {text}") from None

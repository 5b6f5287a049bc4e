"""What a controller raised, as one line with file and line."""
import traceback


def report(kind, value, trace):
    """"my_robot.py:12: in step(): ValueError: why": the innermost line that is not of this package."""
    name = kind.__name__ if kind.__module__ in ("builtins", "__main__") else f"{kind.__module__}.{kind.__name__}"
    text = f"{name}: {value}" if str(value) else name
    if isinstance(value, SyntaxError):
        return f"{value.filename}:{value.lineno}: {type(value).__name__}: {value.msg}"
    frames = traceback.extract_tb(trace)
    own = [frame for frame in frames if not _is_ours(frame.filename)]
    for frame in reversed(own or frames):
        return f"{frame.filename}:{frame.lineno}: in {frame.name}(): {text}"
    return text


def _is_ours(filename):
    return filename.startswith("<frozen") or filename.startswith(__file__.rsplit("/", 1)[0] + "/")

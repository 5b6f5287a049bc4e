"""What the rules of the house look at: every top folder with sources, so that a new one needs no list."""
NOT_OURS = ("build", "templates")  # what is made, and what users fill in


def top_folders(root):
    """Names of the folders of the tree that have C++ in them."""
    return [folder.name for folder in sorted(root.iterdir())
            if folder.is_dir() and folder.name not in NOT_OURS and not folder.name.startswith(".")
            and any(path.suffix in (".h", ".cpp") for path in folder.rglob("*"))]


def sources(root, without=()):
    """The .h and .cpp files of these folders, in order."""
    return [path for top in top_folders(root) if top not in without
            for path in sorted((root / top).rglob("*")) if path.suffix in (".h", ".cpp")]

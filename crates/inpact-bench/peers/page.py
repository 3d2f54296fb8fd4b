"""Runs the commands of a page of figures, and writes what they print beneath them.

    page.py PAGE --program INPACT

A block ```sh of PAGE is run by `sh` in a folder with the sample decks as `decks/`, where `inpact` is INPACT;
the block ```text behind it, if one follows before the next command, becomes what it prints.
Pictures (.svg) that the commands draw are copied beside the page, where it has them.
The commands of a page run one after the other in one folder: what one writes the next can read.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def run(command, folder):
    environment = {**os.environ, "PATH": f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}"}
    done = subprocess.run(["sh", "-eu", "-c", command], cwd=folder, capture_output=True, text=True, env=environment)
    if done.returncode != 0:
        sys.exit(f"{command}\nended with {done.returncode}: {done.stderr}")
    return done.stdout


def remade(page, folder):
    """The text of a page with what its commands print now."""
    parts, end, printed = [], 0, None
    for block in BLOCK.finditer(page):
        parts.append(page[end : block.start()])
        end = block.end()
        kind, text = block.groups()
        if kind == "sh":
            printed = run(text, folder)
        elif kind == "text" and printed is not None:
            text, printed = printed.rstrip("\n") + "\n", None
        parts.append(f"```{kind}\n{text}```")
    return "".join(parts) + page[end:]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=Path)
    parser.add_argument("--program", type=Path, required=True)
    arguments = parser.parse_args()
    decks = Path(__file__).resolve().parents[3] / "decks"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        shutil.copytree(decks, folder / "decks")
        (folder / "bin").mkdir()
        (folder / "bin" / "inpact").symlink_to(arguments.program.resolve())
        page = remade(arguments.page.read_text(), folder)
        for picture in folder.glob("*.svg"):
            if (arguments.page.parent / picture.name).exists():
                shutil.copy(picture, arguments.page.parent)
    arguments.page.write_text(page)


if __name__ == "__main__":
    main()

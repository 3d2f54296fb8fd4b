"""Runs docs/notebooks/spot-weld.py as a notebook and writes spot-weld.ipynb beside it, with what it printed and drew.

With ``--check`` nothing is written: what is printed must be what the notebook shows already, and as many pictures must be drawn.
Needs the wheel with matplotlib and pyarrow, jupytext, nbclient and ipykernel.
"""

from __future__ import annotations

import pathlib
import sys
from typing import Any

import jupytext
import nbformat
from nbclient import NotebookClient

FOLDER = pathlib.Path(__file__).resolve().parent


def made(source: pathlib.Path) -> Any:
    """Run a script as a notebook, and take out of it what differs from run to run."""
    notebook = jupytext.read(source)
    NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(FOLDER)}}).execute()
    for number, cell in enumerate(notebook.cells):
        cell["id"] = f"cell-{number}"
        cell.metadata.pop("execution", None)
    notebook.metadata = {"kernelspec": notebook.metadata["kernelspec"]}
    return notebook


def shown(notebook: Any) -> list[Any]:
    """Give what a notebook shows, picture by name only: their bytes depend on the release of matplotlib."""
    found: list[Any] = []
    for cell in notebook.cells:
        found.append(cell.source)
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            found.append(output.get("text") or ("picture" if "image/png" in data else data.get("text/plain")))
    return found


def main() -> None:
    """Make the notebook, or compare it."""
    source = FOLDER / "spot-weld.py"
    target = source.with_suffix(".ipynb")
    notebook = made(source)
    if "--check" in sys.argv[1:]:
        for before, now in zip(shown(nbformat.read(target, as_version=4)), shown(notebook), strict=True):
            if before != now:
                raise SystemExit(f"{target} is not what it should be; make it again\nshown: {before}\nnow:   {now}")
        return
    nbformat.write(notebook, target)


if __name__ == "__main__":
    main()

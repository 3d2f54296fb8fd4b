"""The page of figures, docs/python-speed.md: each command writes its own section and leaves the others."""

from __future__ import annotations

import os
import pathlib
import platform
import re

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "python-speed.md"


def write(section: str, lines: list[str]) -> None:
    """Replace what stands between the marks of a section, and print it."""
    text = PAGE.read_text(encoding="utf-8")
    begin, end = f"<!-- {section} -->", f"<!-- end of {section} -->"
    pattern = re.compile(f"{re.escape(begin)}.*?{re.escape(end)}", re.DOTALL)
    if not pattern.search(text):
        raise SystemExit(f"{PAGE} has no section `{section}`")
    content = "\n".join([begin, *lines, end])
    PAGE.write_text(pattern.sub(lambda _: content, text), encoding="utf-8")
    print("\n".join(lines))


def machine() -> str:
    """Say where figures are from, and what else the machine did."""
    load = f"{os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "unknown"
    return f"CPython {platform.python_version()}, {os.cpu_count()} cores, load {load} at the end of the run."

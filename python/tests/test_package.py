import doctest
import importlib
import pathlib
import pkgutil
import re
import shutil
import subprocess
import sys

import pytest

import inpact

MODULES = [name for _, name, _ in pkgutil.iter_modules(inpact.__path__, "inpact.") if "_inpact" not in name]


@pytest.mark.parametrize("name", ["inpact", *MODULES])
def test_examples(name: str):
    if name == "inpact.__main__":
        return
    if name == "inpact.dask":
        pytest.importorskip("dask")
    module = importlib.import_module(name)
    assert doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE).failed == 0


def test_everything_public_has_an_example_or_a_page():
    for name in inpact.__all__:
        assert getattr(inpact, name).__doc__, name


@pytest.mark.parametrize("module", ["dataclasses", "inspect", "json", "numpy", "typing"])
def test_importing_takes_nothing_heavy_along(module: str):
    # What the environment has imported before is none of ours.
    code = f"import sys; before = set(sys.modules); import inpact; print('{module}' in set(sys.modules) - before)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "False"


def test_the_command_is_the_program(tmp_path: pathlib.Path):
    command = shutil.which("inpact", path=str(pathlib.Path(sys.executable).parent))
    assert command is not None
    run = subprocess.run([command, "--version"], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stdout.strip()) == (0, f"inpact {inpact.__version__}")
    (tmp_path / "a.inp").write_text("*SURFACE INTERACTION\n")
    for arguments, code in [
        (["check", "a.inp"], 1),
        (["check", "b.inp"], 2),
        (["nonsense"], 2),
        (["explain", "T001"], 0),
    ]:
        run = subprocess.run([command, *arguments], capture_output=True, text=True, check=False, cwd=tmp_path)
        assert run.returncode == code, run.stderr
        assert "Traceback" not in run.stderr
    check = subprocess.run(
        f"{command} explain --all | head -1", shell=True, capture_output=True, text=True, check=False
    )
    assert check.stderr == ""


def test_dependencies_are_those_of_the_program():
    project = pathlib.Path(__file__).resolve().parents[2]
    packages = re.compile(r'name = "([^"]+)"\nversion = "([^"]+)"')
    program, wheel = (set(packages.findall((project / folder / "Cargo.lock").read_text())) for folder in ["", "python"])
    names = {name for name, _ in program}
    assert {(name, version) for name, version in wheel if name in names} - program == set()

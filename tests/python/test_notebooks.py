"""The notebooks of examples/ run from top to bottom, and what they show can be shown."""

import ast
import json
import os
import pathlib

import pytest

NOTEBOOKS = sorted((pathlib.Path(__file__).parents[2] / "examples").glob("*.ipynb"))


def shown(source, names):
    """Runs a cell; its last expression is what a notebook shows."""
    tree = ast.parse(source)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    return eval(compile(ast.Expression(last.value), "cell", "eval"), names) if last else None


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
def test_a_notebook_runs(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    pictures = os.environ.get("MERGE2D_PICTURES")  # a folder, for those who want to look at them
    names, count = {}, 0
    for cell in json.loads(path.read_text())["cells"]:
        if cell["cell_type"] != "code":
            continue
        value = shown("".join(cell["source"]), names)
        if hasattr(value, "_repr_png_"):
            png = value._repr_png_()
            assert png.startswith(b"\x89PNG")
            count += 1
            if pictures:
                (pathlib.Path(pictures) / f"{path.stem}-{count}.png").write_bytes(png)
    assert count > 0


def test_there_is_a_notebook():
    assert NOTEBOOKS

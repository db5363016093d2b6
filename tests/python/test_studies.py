"""The recipes of docs/studies.md for the table of a study, with the programs that are installed."""

import contextlib
import io
import pathlib
import re
import shlex
import shutil
import subprocess

import pytest

import merge2d

PAGE = (pathlib.Path(__file__).parents[2] / "docs" / "studies.md").read_text(encoding="utf-8")
PROGRAM = pathlib.Path(merge2d.__file__).parents[2] / "merge2d"
GRID = """
scenes = ["books"]
modes = ["reference", "merge+sleep"]
steps = 3
[parameters]
merging.velocity = [0.005, 0.01]
"""


def recipe(language, word):
    """The block of the page in this language that has this word."""
    blocks = re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)
    return next(block for block in blocks if word in block)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Has a study of four runs, and is where the recipes run."""
    if not PROGRAM.exists():
        pytest.skip("the program is not built")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "grid.toml").write_text(GRID)
    subprocess.run([PROGRAM, "study", "grid.toml", "-o", "thresholds", "--quiet"], check=True)
    return tmp_path


def test_the_table_is_a_data_frame(folder):
    pytest.importorskip("pandas")
    names, printed = {}, io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(recipe("python", "groupby"), names)
    assert len(names["table"]) == 4
    assert names["table"].key.map(type).eq(str).all()
    assert "merge+sleep" in printed.getvalue()


def test_pandas_makes_parquet_of_it(folder):
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("pyarrow")
    exec(recipe("python", "groupby") + recipe("python", "to_parquet"), {})
    again = pandas.read_parquet("thresholds/study.parquet")
    assert list(again["merging.velocity"]) == [0.005, 0.01] * 2


def test_duckdb_makes_parquet_of_it(folder):
    if not shutil.which("duckdb"):
        pytest.skip("DuckDB is not installed")
    subprocess.run(shlex.split(recipe("sh", "duckdb")), check=True)
    assert (folder / "thresholds" / "study.parquet").read_bytes().startswith(b"PAR1")

"""The notebooks run in Jupyter itself, where nbconvert and a kernel are installed; test_notebooks.py runs
their cells everywhere."""

import importlib.util
import json
import os
import pathlib
import subprocess
import sys

import pytest

NOTEBOOKS = sorted((pathlib.Path(__file__).parents[2] / "examples").glob("*.ipynb"))
MISSING = [name for name in ("nbconvert", "ipykernel") if importlib.util.find_spec(name) is None]

if not MISSING:
    @pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
    def test_a_notebook_is_executed_by_nbconvert(path, tmp_path):
        # A kernel of this very Python: Jupyter's own one may be the system's beside a virtual one.
        kernel = tmp_path / "kernels" / "this" / "kernel.json"
        kernel.parent.mkdir(parents=True)
        kernel.write_text(json.dumps({"display_name": "this", "language": "python", "argv": [
            sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]}))
        command = [sys.executable, "-m", "jupyter", "nbconvert", "--execute", "--to", "notebook",
                   "--ExecutePreprocessor.timeout=300", "--ExecutePreprocessor.kernel_name=this",
                   "--output-dir", str(tmp_path), str(path)]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False,
                              env={**os.environ, "JUPYTER_PATH": str(tmp_path)})
        assert done.returncode == 0, done.stderr
        cells = json.loads((tmp_path / path.name).read_text(encoding="utf-8"))["cells"]
        outputs = [output for cell in cells for output in cell.get("outputs", [])]
        assert not [output for output in outputs if output["output_type"] == "error"]
        assert any("image/png" in output.get("data", {}) for output in outputs)

"""Validates every JSON output of the program against its schema in docs/schemas.

    validate.py PROGRAM SCHEMAS

Each schema must have been used, and each command with --json must have one: an output that is not
described here, or a description that nothing has, is a failure.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

from jsonschema import Draft202012Validator

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
SCHEMAS = pathlib.Path(sys.argv[2]).resolve()

STACK = """format = 1
duration = 0.3
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [10, 1]
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
repeat = { count = [1, 3], spacing = [1, 1] }
"""
LAMP = """format = 1
duration = 0.5
[[body]]
name = "lamp"
circle = 0.1
mass = 2
[[joint]]
kind = "revolute"
bodies = ["lamp"]
at = [0, 0]
break_force = 15
"""
STUDY = """scenes = ["stack.toml"]
modes = ["reference", "merge"]
steps = 5
[parameters]
merging.velocity = [0.01, 0.02]
solver.iterations = [10, 0]
"""

# Schema, and the arguments whose standard output it describes.
OUTPUTS = [
    ("list", ["list"]),
    ("validate", ["validate", "stack.toml"]),
    ("validate", ["validate", "pile"]),
    ("doctor", ["doctor"]),
    ("run", ["run", "stack.toml"]),
    ("run", ["run", "lamp.toml"]),
    ("run", ["run", "stack.toml", "--no-timings", "--reference-error", "--mode", "sleep"]),
    ("cycles", ["cycles", "graph.txt"]),
    ("explain", ["explain", "stack.toml", "--at", "10"]),
    ("explain", ["explain", "books", "--at", "7", "--pair", "cookbook", "diary"]),
    ("explain", ["explain", "tower-platform", "--at", "118"]),
    ("explain", ["explain", "pile", "--at", "295"]),  # pairs wait: their counts are negative
    ("explain-weld", ["explain", "books", "--weld", "cookbook", "diary"]),
    ("render", ["render", "stack.toml", "-r", "160x120", "--seconds", "0.1"]),
    ("render", ["render", "stack.toml", "--format", "svg", "--seconds", "0.1", "-o", "vector"]),
    ("render-stages", ["render", "stack.toml", "--stages", "--at", "3", "-r", "160x120", "-o", "s"]),
    ("lesson", ["lesson", "stack.toml", "--no-live"]),
    ("compare", ["compare", "stack.toml", "--no-charts"]),
    ("compare", ["compare", "lamp.toml", "--no-timings", "--window", "0.1,0.4"]),
    ("study", ["study", "study.toml", "-o", "study"]),
    ("study-report", ["study", "--report", "study"]),
]
# Schema, and the files that the runs above leave.
FILES = [
    ("run-file", "frames/stack/run.json"),
    ("run-file", "vector/run.json"),
    ("study-folder", "study/study.json"),
    ("study-row", "study/rows/*.json"),
    ("reference-end", "study/ends/*.json"),
]
FAILING = {"study"}  # on purpose: one value of the study is out of range


def inlined(node, schemas):
    """The schema with references to others replaced by these."""
    if isinstance(node, dict):
        if "$ref" in node:
            return inlined(schemas[node["$ref"].removesuffix(".schema.json")], schemas)
        return {key: inlined(value, schemas) for key, value in node.items()}
    if isinstance(node, list):
        return [inlined(value, schemas) for value in node]
    return node


class Checker:
    def __init__(self):
        self.schemas = {}
        self.faults = []
        self.used = set()
        for file in sorted(SCHEMAS.glob("*.schema.json")):
            schema = json.loads(file.read_text(encoding="utf-8"))
            Draft202012Validator.check_schema(schema)
            self.schemas[file.name.removesuffix(".schema.json")] = schema

    def check(self, name, text, source):
        self.used.add(name)
        validator = Draft202012Validator(inlined(self.schemas[name], self.schemas))
        for error in validator.iter_errors(json.loads(text)):
            place = "/".join(map(str, error.absolute_path))
            self.faults.append(f"{source}: {place}: {error.message[:200]}")


def run(arguments, folder):
    return subprocess.run([PROGRAM, *arguments], cwd=folder, capture_output=True, text=True,
                          check=False)


def check_trace(checker, folder):
    for scene, more in (("stack.toml", ["--decisions"]), ("lamp.toml", ["--no-timings"]),
                        ("three-discs", ["--decisions", "--steps", "60"])):
        trace = run(["run", scene, "--trace", "-", "--quiet", *more], folder).stdout.splitlines()
        for i, line in enumerate(trace):
            checker.check("trace-step" if i else "trace-header", line, f"{scene}, line {i + 1}")


def check_step(checker, folder):
    script = "step 3\nstage\nwhy\nset step=0.005\nnothing of the kind\n"
    answers = subprocess.run([PROGRAM, "step", "stack.toml", "--json"], cwd=folder, input=script,
                             capture_output=True, text=True, check=False).stdout
    for i, line in enumerate(answers.splitlines()):
        checker.check("step", line, f"merge2d step, answer {i}")


def check_commands(checker, folder):
    """A command that offers --json has an output above."""
    known = {arguments[0] for _, arguments in OUTPUTS}
    text = run(["completion", "bash"], folder).stdout
    for line in text.splitlines():
        command, _, options = line.strip().partition(") options=")
        if "--json" in options and command not in known | {"step"}:  # whose lines are checked alone
            checker.faults.append(f"merge2d {command} --json has no schema")


def main():
    checker = Checker()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for file, text in (("stack.toml", STACK), ("lamp.toml", LAMP), ("study.toml", STUDY),
                           ("graph.txt", "A B 1\nB C 1\nC A 1\nC D 2\n")):
            (folder / file).write_text(text, encoding="utf-8")
        for schema, arguments in OUTPUTS:
            result = run([*arguments, "--json"], folder)
            source = "merge2d " + " ".join(arguments)
            if result.returncode != 0 and arguments[0] not in FAILING:
                checker.faults.append(f"{source}: {result.stderr}")
                continue
            checker.check(schema, result.stdout, source)
        for schema, pattern in FILES:
            for file in sorted(folder.glob(pattern)):
                checker.check(schema, file.read_text(encoding="utf-8"), file.name)
        check_trace(checker, folder)
        check_step(checker, folder)
        check_commands(checker, folder)
    for unused in sorted(set(checker.schemas) - checker.used):
        checker.faults.append(f"{unused}.schema.json describes nothing that was tried")
    print("\n".join(checker.faults) or f"{len(checker.used)} schemas hold")
    return 1 if checker.faults else 0


sys.exit(main())

"""Where the program and the data are, and how much is traced. Set once by `run`."""
import os
import pathlib

root = pathlib.Path(__file__).resolve().parents[1]
bpms = os.environ.get("BPMS", str(root / "build/release/bpms"))
tests = pathlib.Path(os.environ.get("BPMS_TESTS", root / "build/release/tests"))
data = pathlib.Path(os.environ.get("BPMS_DATA", root / "../shared/data")).resolve()
figures = root / "docs/figures/validation"
seed = 11
more = 1  # times the paths

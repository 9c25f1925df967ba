"""What tests share: the program beside which the package is held, and figures of peers."""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
PEERS = ROOT / "crates" / "robot" / "tests" / "peers"
URDF = ROOT / "crates" / "robot" / "tests" / "urdf"
DOCUMENTS = ROOT / "examples" / "documents"


def peers(name):
    return json.loads((PEERS / name).read_text(encoding="utf-8"))


@pytest.fixture(scope="session")
def cli():
    """What the command line prints on standard output; skips where there is none."""
    program = os.environ.get("DENAVIT")
    if not program:
        pytest.skip("DENAVIT names no program")

    def run(*words, may_fail=False):
        done = subprocess.run([program, *words], capture_output=True, text=True, encoding="utf-8")
        assert may_fail or done.returncode == 0, done.stderr
        return done.stdout

    return run

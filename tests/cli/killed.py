#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Kills `arrange --memory` by SIGKILL, which no program hears, and looks at what it leaves.

    killed.py PROGRAM

The moments are given by what it has written so far. While it computes, it has files without names alone: nothing is
left. While it writes its results, these have the names that docs/reference/errors.md states. Old files stay.
"""
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM = str(Path(sys.argv[1]).resolve())
SHARES = (0.02, 0.2, 0.5, 0.9, 0.99)  # of all that a run writes
LINE = ("arrange", "in.obj", "-o", "out/m.pvtp", "-o", "out/m.vtp", "--memory", "1MiB", "--quiet")
MOST_TRIES = 50


def waves(n):
    lines = [f"v {i} {k} {3 * math.sin(i / 9) + math.cos(k / 7):.6f}" for k in range(n + 1) for i in range(n + 1)]
    lines += [f"v {i} {n / 2 + .3 * (k - n / 2):.6f} {.4 * (k - n / 2):.6f}" for k in range(n + 1) for i in range(n + 1)]
    for name, first in (("top", 1), ("fault", 1 + (n + 1) ** 2)):
        lines.append(f"o {name}")
        for k in range(n):
            for i in range(n):
                a = first + k * (n + 1) + i
                lines += [f"f {a} {a + 1} {a + n + 2}", f"f {a} {a + n + 2} {a + n + 1}"]
    return "\n".join(lines) + "\n"


def written(process):
    """Bytes that it has written, to any file; None once it has ended."""
    try:
        return int(re.search(r"wchar: (\d+)", Path(f"/proc/{process.pid}/io").read_text()).group(1))
    except (OSError, AttributeError):
        return None


def run_until(folder, most):
    """Runs the program, and kills it when it has written so much. Returns what it had written, and whether it was killed."""
    process = subprocess.Popen([PROGRAM, *LINE], cwd=folder)
    last = 0
    while process.poll() is None:
        now = written(process)
        last = max(last, now or 0)
        if last >= most:
            process.kill()
            break
    return last, process.wait() < 0


def left(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.iterdir())


def main():
    model = waves(110)
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        (folder / "in.obj").write_text(model)
        (folder / "out").mkdir()
        total, _ = run_until(folder, math.inf)
        assert left(folder / "out") == ["m.pvtp", "m.vtp", "m_pieces"], left(folder / "out")
    for share in SHARES:
        for _ in range(MOST_TRIES):
            with tempfile.TemporaryDirectory() as scratch:
                folder = Path(scratch)
                (folder / "in.obj").write_text(model)
                (folder / "out").mkdir()
                (folder / "out/m.vtp").write_text("old")
                was_killed = run_until(folder, share * total)[1]
                if not was_killed:  # it was too quick for this process
                    continue
                found = [name for name in left(folder / "out") if name != "m.vtp"]
                assert left(folder) == ["in.obj", "out"], left(folder)
                assert (folder / "out/m.vtp").read_text() == "old", share
                assert share > 0.5 or not found, (share, found)
                assert all(re.fullmatch(r"\.(m\.pvtp|m\.vtp|m_pieces)\.\d+-\d+\.part", name) for name in found), found
                break
        else:
            sys.exit(f"killed: it always ended before it had written {share} of all")
    print(f"{len(SHARES)} moments: nothing left but results that were being written")


if __name__ == "__main__":
    main()

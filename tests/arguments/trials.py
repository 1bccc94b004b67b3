# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs calls in another process, which is started anew behind one that crashes or hangs; collects what is wrong."""

import argparse
import json
import os
import queue
import subprocess
import sys
import tempfile
import threading
import time

#: Seconds without a word after which a call counts as hanging.
PATIENCE = 1800


def parse(text, share):
    """Parse the options that all generators of arguments have."""
    parser = argparse.ArgumentParser(description=text.splitlines()[0])
    parser.add_argument("--share", type=float, default=float(os.environ.get("TERRANE_EFFORT", share)))
    parser.add_argument("--seconds", type=float, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--begin", type=int, default=-1, help=argparse.SUPPRESS)
    return parser


def make_calls(options, work, drawn, trial):
    """In the other process: make the calls of a list from one on, then drawn ones; say each, and what is wrong about it."""
    end = time.monotonic() + options.seconds
    number = options.begin
    said = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # a call may print

    def say(what):
        print(json.dumps(what), file=said, flush=True)

    while number < len(work) or time.monotonic() < end:
        call = work[number] if number < len(work) else drawn()
        say([number, *call])
        flaw = trial(*call)
        if flaw:
            say({"flaw": flaw})
        number += 1
    say({"done": number})
    return 0


def _lines(process):
    """Lines of its standard output; None in the end, or when it hangs and is killed."""
    lines = queue.Queue()

    def read():
        with process.stdout:
            for line in process.stdout:
                lines.put(line)
        lines.put(None)

    threading.Thread(target=read, daemon=True).start()
    while True:
        try:
            line = lines.get(timeout=PATIENCE)
        except queue.Empty:
            process.kill()
            line = None
        if line is None:
            return
        yield line


def supervise(script, options, words=()):
    """Have the script make all calls; return their number and a line for each flaw."""
    flaws, begin, tried, end = [], 0, 0, time.monotonic() + options.seconds

    def note(text):
        flaws.append(text)
        print(text, flush=True)

    path = os.pathsep.join([os.path.dirname(os.path.abspath(script)), *sys.path])
    with tempfile.TemporaryDirectory() as scratch:
        while begin is not None:
            command = [sys.executable, "-X", "faulthandler", os.path.abspath(script), f"--begin={begin}", f"--seed={options.seed}",
                       f"--share={options.share}", f"--only={options.only}", f"--seconds={max(0, end - time.monotonic())}", *words]
            last, done = None, False
            with tempfile.TemporaryFile("w+") as errors, subprocess.Popen(
                    command, cwd=tempfile.mkdtemp(dir=scratch), stdout=subprocess.PIPE, stderr=errors, text=True,
                    env={**os.environ, "PYTHONPATH": path}) as running:
                for line in _lines(running):
                    said = json.loads(line)
                    if isinstance(said, list):
                        last, tried = said, tried + 1
                    elif "flaw" in said:
                        note(f"{last[1]}({last[2]}={last[3]}): {said['flaw']}")
                    else:
                        done = True
                status = running.wait()
                errors.seek(0)
                why = errors.read()[-800:]
            begin = None if done or last is None else last[0] + 1
            if not done:
                note(f"{last}: ended with {status}: {why}")
    return tried, flaws


def conclude(tried, flaws):
    print(f"{tried} calls, {len(flaws)} flaws")
    return 1 if flaws or tried == 0 else 0

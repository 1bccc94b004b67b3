#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs a command and sends it a signal at a stated moment, however busy the machine is.

    interrupted.py SIGNAL MOMENT [--then FILE] COMMAND...

SIGNAL is a name without SIG, or a number. MOMENT is a number of processor seconds that the command has used, or "waits":
all its threads sleep, as when it reads a pipe. Either comes only after the program waits for, catches or ignores the signal.
--then makes its standard input a pipe, which gets the contents of FILE once the signal was ignored. The status is
that of the command, as a shell tells it, and the last line of standard error states the processor seconds from the
signal to the end. A command that ends before the signal gives the status 125.
"""
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

LOOKS = 5  # All threads must sleep in this many consecutive looks.


def has_mask(process, number, *names):
    masks = [line.split()[1] for line in Path(f"/proc/{process}/status").read_text().splitlines() if line.startswith(names)]
    return any(int(mask, 16) >> (number - 1) & 1 for mask in masks)


def answers(process, number):
    """Whether the program, and no longer the shell or nohup that starts it, waits for, catches or ignores the signal."""
    is_program = Path(os.readlink(f"/proc/{process}/exe")).name not in ("sh", "bash", "dash", "nohup")
    return is_program and has_mask(process, number, "SigBlk:", "SigCgt:", "SigIgn:")


def sleeps(process):
    states = [(task / "stat").read_text().rpartition(")")[2].split()[0] for task in Path(f"/proc/{process}/task").iterdir()]
    return all(state == "S" for state in states)


def seconds_of(process):
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def wait_for(running, number, moment):
    """Returns the processor seconds that the command has used then, or None if it has ended."""
    asleep = 0
    while running.poll() is None:
        try:
            if answers(running.pid, number):
                used = seconds_of(running.pid)
                asleep = asleep + 1 if sleeps(running.pid) else 0
                if asleep >= LOOKS if moment == "waits" else used >= float(moment):
                    return used
        except (FileNotFoundError, ProcessLookupError):
            pass  # it ends, or a thread of it does
        time.sleep(0.01)
    return None


def main():
    name, moment, *command = sys.argv[1:]
    number = int(name) if name.isdigit() else getattr(signal, "SIG" + name)
    contents = None
    if command[0] == "--then":
        contents, command = Path(command[1]).read_bytes(), command[2:]
    with subprocess.Popen(command, stdin=None if contents is None else subprocess.PIPE) as running:
        used = wait_for(running, number, moment)
        if used is None:
            print("interrupted.py: the command ended before the signal", file=sys.stderr)
            sys.exit(125)
        is_ignored = has_mask(running.pid, number, "SigIgn:")
        running.send_signal(number)
        if contents is not None and is_ignored:
            running.communicate(contents)
        status = running.wait()
    times = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{times.ru_utime + times.ru_stime - used:.2f}", file=sys.stderr)
    sys.exit(status if status >= 0 else 128 - status)


if __name__ == "__main__":
    main()

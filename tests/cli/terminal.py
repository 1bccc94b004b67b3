#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the program on a pseudo-terminal and judges what somebody would see there.

    terminal.py PROGRAM

(1) A long stage shows one line with its share and times, within the width, at most 10 times a second; it is cleared.
(2) Colours are there on a terminal, not with NO_COLOR, TERM=dumb or --color never, and always with --color always.
(3) --quiet shows nothing unless something is wrong.
(4) Ctrl-C clears the line.
(5) Names with escape sequences neither colour nor move the cursor, and tables of wide names are aligned.
(6) Without a terminal there is no escape sequence, and the same text as on one.
"""
import fcntl
import json
import math
import os
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unicodedata
from pathlib import Path

PROGRAM = str(Path(sys.argv[1]).resolve())
ESCAPE = "\x1b"
HORIZON = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nf 1 2 3\nf 1 3 4\n"
FAULT = "v 1 -1 -1\nv 1 5 -1\nv 1 2 3\nf 5 6 7\n"
TURNING = "\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"
HOSTILE = "\x1b[31mred\x1b[2J\x1b]0;title\x07\x9b32m\x7f" + TURNING + "<script>"
LONG = "0.05"  # an edge length with which improving takes far longer than the seconds after which it is interrupted
findings = []


def expect(holds, sentence, seen=""):
    if not holds:
        findings.append(sentence)
        print(f"terminal: {sentence}" + (f": {seen!r}" if seen != "" else ""), file=sys.stderr)


def waves(n):
    """Two surfaces of 2 n^2 triangles each, which cross in many curves."""
    def sheet(name, height, base):
        lines = [f"o {name}"]
        lines += [f"v {i} {j} {height(i, j):.6f}" for j in range(n + 1) for i in range(n + 1)]
        for j in range(n):
            for i in range(n):
                a = base + j * (n + 1) + i
                lines += [f"f {a} {a + 1} {a + n + 2}", f"f {a} {a + n + 2} {a + n + 1}"]
        return lines
    first = sheet("waves", lambda i, j: 3 * math.sin(i / 3) + 3 * math.sin(j / 4), 1)
    second = sheet("swell", lambda i, j: 2 * math.sin(i / 5 + 1) + 2 * math.cos(j / 3), 1 + (n + 1) ** 2)
    return "\n".join(first + second) + "\n"


def environment(**more):
    kept = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "TERM", "COLUMNS")}
    return {**kept, "TERM": "xterm", "LC_ALL": "C.UTF-8", **more}


class Seen:
    """What a run on a terminal wrote: all bytes with their times, and its status."""

    def __init__(self):
        self.chunks, self.status = [], None

    @property
    def text(self):
        return b"".join(data for _, data in self.chunks).decode("utf-8", "replace")

    def lines(self):
        """What stays on the screen, without colours: a line that was cleared has left nothing."""
        screen, line, column = [], [], 0
        for part in re.findall(r"\x1b\[[0-9;]*[A-Za-z]|[^\x1b]|\x1b", self.text):
            if part == "\n":
                screen.append("".join(line))
                line, column = [], 0
            elif part == "\r":
                column = 0
            elif part == "\x1b[K":
                line = line[:column]
            elif not part.startswith(ESCAPE):
                line[column:column + 1] = [part]
                column += 1
        return screen + (["".join(line)] if line else [])


def seconds_of(process):
    """The processor seconds that a process has used."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def on_terminal(*words, width=100, env=None, interrupt_at=None, interrupt_after=math.inf, folder=None):
    """Runs the program with all streams on a terminal. Ctrl-C is typed when a text is seen, or after processor seconds."""
    child, master = pty.fork()
    if child == 0:
        os.chdir(folder)
        os.execve(PROGRAM, [PROGRAM, *words], env or environment())
    fcntl.ioctl(master, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
    seen = Seen()
    while True:
        if seconds_of(child) > interrupt_after:
            os.write(master, b"\x03")
            interrupt_after = math.inf
        if not select.select([master], [], [], 0.1)[0]:
            continue
        try:
            data = os.read(master, 65536)
        except OSError:  # the program has ended
            break
        if not data:
            break
        seen.chunks.append((time.monotonic(), data))
        if interrupt_at and interrupt_at in seen.text:
            os.write(master, b"\x03")
            interrupt_at = None
    seen.status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    os.close(master)
    return seen


def in_pipes(*words, folder, env=None):
    return subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, env=env or environment(), check=False)


def check_progress(folder):
    width = 60
    for length in ("0.35", "0.25", "0.15"):  # the first with which it takes long enough on this machine
        command = ("improve", "waves.obj", "-o", "improved.vtp", "--threads", "2", "--edge-length", length)
        seen = on_terminal(*command, width=width, folder=folder)
        texts = [t for t in re.split(r"\r\x1b\[K|\n", seen.text) if re.match("(improve|measure) .*s", t)]
        if any(t.startswith("improve") for t in texts):
            break
    drawn = [(at, data) for at, data in seen.chunks if b"\r\x1b[K" in data]
    expect(seen.status == 0, "improve ends well on a terminal", seen.text)
    expect(any(re.match(r"improve \d+ % \(\d+ s(, \d+ s left)?\)$", t) for t in texts),
           "progress has a share and the time", texts)
    expect(all(len(t) < width for t in texts), "progress stays within the width", texts)
    gaps = [b - a for (a, _), (b, _) in zip(drawn, drawn[1:])]
    seconds = drawn[-1][0] - drawn[0][0] if drawn else 0
    expect(len(gaps) <= 10 * seconds + 4, "progress is drawn ten times a second at most", len(gaps))
    for stage in ("improve", "measure"):
        left = [int(x) for x in re.findall(stage + r" \d+ % \(\d+ s, (\d+) s left", seen.text)]
        expect(all(a >= b >= 0 for a, b in zip(left, left[1:])), f"the time left of {stage} never rises", left)
    expect(not any(re.search(r" \(\d+ s", line) for line in seen.lines()), "progress is cleared", seen.lines())
    command = (*command[:-1], LONG)
    quiet = on_terminal(*command, "--quiet", interrupt_after=1.25, folder=folder)
    expect(quiet.lines() == ["^Cterrane: interrupted, nothing written"], "there is no progress with --quiet", quiet.lines())
    with subprocess.Popen([PROGRAM, *command], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          env=environment()) as piped:
        while seconds_of(piped.pid) < 1.25:
            time.sleep(0.05)
        piped.send_signal(signal.SIGINT)
        out, err = piped.communicate()
    expect(err == b"terrane: interrupted, nothing written\n", "there is no progress without a terminal", err)
    expect(ESCAPE not in out.decode(), "there is no colour without a terminal", out)
    return command


def check_interrupt(folder, command):
    (folder / "improved.vtp").unlink()
    seen = on_terminal(*command, interrupt_at="\r\x1b[K", folder=folder)
    expect(seen.status == 2, "Ctrl-C ends the program with status 2", seen.status)
    expect(seen.lines()[-1] == "terrane: interrupted, nothing written", "Ctrl-C leaves the line clean", seen.lines())
    expect(not (folder / "improved.vtp").exists(), "Ctrl-C leaves no file")
    seen = on_terminal(*command, interrupt_after=1.25, env=environment(TERM="dumb"), folder=folder)
    expect(seen.status == 2 and ESCAPE not in seen.text, "a dumb terminal gets no sequences", seen.text)


def check_colours(folder):
    arrange = ("arrange", "crossing.obj", "-o", "a.vtp")
    green = f"{ESCAPE}[32mverified:{ESCAPE}[0m"

    def shown(*words, **more):
        return on_terminal(*arrange, *words, folder=folder, env=environment(**more)).text

    expect(green in shown(), "verified is green on a terminal", shown())
    expect(f"{ESCAPE}[1m  surface" in shown(), "headings are bold", shown())
    expect(green in shown(NO_COLOR=""), "an empty NO_COLOR does not count")
    for words, more in (((), {"NO_COLOR": "1"}), ((), {"TERM": "dumb"}), (("--color", "never"), {}),
                        (("--color=never",), {})):
        expect(ESCAPE not in shown(*words, **more), f"no colour with {words} {more}", shown(*words, **more))
    expect(green in shown("--color", "always", NO_COLOR="1"), "--color always is stronger than NO_COLOR")
    plain = in_pipes(*arrange, folder=folder)
    seen = on_terminal(*arrange, folder=folder).lines()
    expect(ESCAPE not in plain.stdout.decode() and plain.stderr == b"", "there is no colour in a pipe", plain)
    expect(seen == plain.stdout.decode().splitlines(), "a terminal shows the same text as a pipe", seen)
    always = in_pipes(*arrange, "--color", "always", folder=folder)
    expect(green in always.stdout.decode(), "--color always colours a pipe", always.stdout)
    without = re.sub(rf"{ESCAPE}\[\d*m", "", always.stdout.decode())
    expect(without == plain.stdout.decode(), "colours change nothing else", without)
    wrong = on_terminal("arrange", "nothing.obj", "-o", "a.vtp", folder=folder)
    expect(wrong.text.startswith(f"{ESCAPE}[31mterrane:{ESCAPE}[0m nothing.obj"), "errors are red", wrong.text)
    warned = on_terminal("convert", "thirds.obj", "a.stl", folder=folder)
    expect(f"{ESCAPE}[33mterrane: warning:{ESCAPE}[0m" in warned.text, "warnings are yellow", warned.text)
    helped = on_terminal("check", "--help", folder=folder)
    expect(f"{ESCAPE}[1mOptions:{ESCAPE}[0m" in helped.text, "headings of help are bold", helped.text)
    expect(ESCAPE not in on_terminal("check", "--color", "never", "--help", folder=folder).text,
           "--color never counts for --help")
    bad = in_pipes(*arrange, "--color", "sometimes", folder=folder)
    expect(bad.returncode == 2 and b"--color" in bad.stderr, "--color takes three words", bad.stderr)


def check_quiet(folder):
    for words in (("arrange", "crossing.obj", "-o", "q.vtp"), ("check", "crossing.obj"),
                  ("convert", "crossing.obj", "q.ts"), ("volume", "body.obj", "-o", "q"),
                  ("improve", "few.obj", "-o", "q.vtp"),
                  ("verify", "certificate.json")):
        seen = on_terminal(*words, "--quiet", folder=folder)
        expect(seen.text == "", f"{words[0]} --quiet shows nothing", seen.text)
        expect(seen.status == (1 if words[0] == "check" else 0), f"{words[0]} --quiet has its status", seen.status)
    wrong = in_pipes("arrange", "nothing.obj", "-o", "q.vtp", "--quiet", folder=folder)
    expect(b"nothing.obj" in wrong.stderr and wrong.stdout == b"", "errors stay with --quiet", wrong.stderr)
    asked = in_pipes("check", "crossing.obj", "--json", "--quiet", folder=folder)
    expect(json.loads(asked.stdout or "{}") != {}, "JSON stays with --quiet", asked.stdout)


def check_names(folder):
    hostile = HOSTILE.encode("utf-8", "surrogateescape").replace("\x9b".encode(), b"\x9b\xc2\x9b")
    (folder / "hostile.obj").write_bytes(b"o " + hostile + b"\n" + HORIZON.encode() +
                                         b"o \xc2\x9b31m\x01\n" + FAULT.encode())
    (folder / "fold\x1b[31m.obj").write_bytes((folder / "hostile.obj").read_bytes())
    runs = [("arrange", "hostile.obj", "-o", "h.vtp", "--certificate", "h.json"), ("verify", "h.json"),
            ("check", "hostile.obj"), ("check", "hostile.obj", "--json"), ("fill", "hostile.obj", "--list"),
            ("volume", "hostile.obj", "-o", "h"), ("volume", "hostile.obj", "--suggest-seal"),
            ("improve", "hostile.obj", "-o", "h.vtp", "--passes", "1"),
            ("arrange", "hostile.obj", "-o", "h.vtp", "--box", "-1,-1,-1,3,3,1"),
            ("arrange", "hostile.obj", "-o", "h.vtp", "--role", "\x1b[31m=fault"), ("\x1b[31m",),
            ("arrange", "\x1b[31m.obj", "-o", "\x1b[31m.vtp"), ("check", "--\x1b[31m"),
            ("arrange", "fold\x1b[31m.obj", "-o", "fold\x1b[31m.ts"), ("convert", "hostile.obj", "\x9b31m.ts")]
    for words in runs:
        done = in_pipes(*words, folder=folder)
        said = done.stdout + done.stderr
        expect(not re.search(rb"[\x00-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]", said), f"{words} shows no control", said)
        expect(not re.search(rb"(?<![\x80-\xf4])[\x80-\x9f]", said), f"{words} shows no 8-bit control", said)
        expect(not set(TURNING) & set(said.decode("utf-8", "replace")), f"{words} lets no name turn the text round", said)
        seen = on_terminal(*words, folder=folder).text
        expect(not set(TURNING) & set(seen), f"{words} lets no name turn the text round on a terminal", seen)
        colours = set(re.findall(r"\x1b.{0,4}", re.sub(r"\x1b\[(1|3[123]|0)m|\r\x1b\[K", "", seen)))
        expect(not colours, f"{words} sends sequences of names to a terminal", colours)
        expect(f"{ESCAPE}[31mred" not in seen, f"{words} lets a name choose its colour", seen)
    found = in_pipes("check", "hostile.obj", "--json", folder=folder).stdout
    names = [surface["name"] for surface in json.loads(found)["surfaces"]]
    for turning in TURNING:
        expect(rb"\u%04x" % ord(turning) in found and any(turning in name for name in names),
               "JSON holds the name, with an escape", names)


def check_tables(folder):
    names = ["砂岩層", "e\u0301tage", "basin", "\u200fright", "x" * 10000, "<script>'\"", "ﬀ" * 3]
    text, base = "", 0
    for k, name in enumerate(names):
        text += f"o {name}\nv {9 * k} 0 0\nv {9 * k + 1} 0 0\nv {9 * k} 1 0\nf {base + 1} {base + 2} {base + 3}\n"
        base += 3
    (folder / "names.obj").write_text(text, encoding="utf-8")

    def width(line):
        zero = ("Mn", "Me", "Cf")
        return sum(0 if unicodedata.category(c) in zero else 2 if unicodedata.east_asian_width(c) in "WF" else 1
                   for c in line)

    for words in ((), ("--box", "-1,-1,-1,99,3,1")):
        said = in_pipes("arrange", "names.obj", "-o", "n.vtp", *words, folder=folder).stdout.decode()
        for row in (r"  \S.*?  +\d+  (?= )", r"  \S.*?  +[\d.]+ of ")[:1 + bool(words)]:
            rows = [found.group() for found in map(re.compile(row).match, said.splitlines())
                    if found and "xxx" not in found.group()]
            expect(len(rows) >= len(names) - 1, "each surface has a row", rows)
            expect(len({width(row) for row in rows}) == 1, "columns behind names are aligned", rows)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "waves.obj").write_text(waves(40))
        (folder / "few.obj").write_text(waves(20))
        (folder / "crossing.obj").write_text("o horizon\n" + HORIZON + "o fault\n" + FAULT)
        (folder / "thirds.obj").write_text("o third\nv 0.1 0 0\nv 1 0.2 0\nv 0 1 0.3\nf 1 2 3\n")
        (folder / "body.obj").write_text("o body\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                         "f 1 2 3\nf 1 2 4\nf 2 3 4\nf 1 3 4\n")
        in_pipes("arrange", "crossing.obj", "-o", "c.vtp", "--certificate", "certificate.json", folder=folder)
        check_interrupt(folder, check_progress(folder))
        for check in (check_colours, check_quiet, check_names, check_tables):
            check(folder)
    print(f"{len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())

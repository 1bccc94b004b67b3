#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Completes command lines in bash and fish, and in zsh on a pseudo-terminal, with the scripts that the program prints.

    completion.py PROGRAM

(1) Each command that --help lists, and each of its options, is completed by each shell.
(2) Values are completed: words, files by their endings, folders. Names of files with blanks stay one word.
A shell that is not installed is left out, and named.
"""
import os
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM = str(Path(sys.argv[1]).resolve())
FILES = ("a.ts", "b c.OBJ", "d.vtu", "e.json", "f.md", "g.shp", "h.pl", "folder/i.ts")
findings = []

# A command line, and the words that complete its last one; "..." stands for others.
CASES = (
    (("terrane", "arr"), {"arrange"}),
    (("terrane", "completion", ""), {"bash", "zsh", "fish"}),
    (("terrane", "manual", "tetra"), {"tetrahedralize"}),
    (("terrane", "arrange", "--search", "m"), {"mixed"}),
    (("terrane", "arrange", "--color", ""), {"auto", "always", "never"}),
    (("terrane", "layer", "--keep", ""), {"upper", "lower"}),
    (("terrane", "fill", "--method", "k"), {"kriging"}),
    (("terrane", "tetrahedralize", "--mesher", ""), {"auto", "tetgen", "gmsh"}),
    (("terrane", "check", "--input-format", "z"), {"zmap", "zycor"}),
    (("terrane", "arrange", ""), {"a.ts", "b c.OBJ", "d.vtu", "h.pl", "folder/"}),
    (("terrane", "arrange", "a.ts", "b"), {"b c.OBJ"}),
    (("terrane", "arrange", "folder/"), {"folder/i.ts"}),
    (("terrane", "arrange", "--certificate", ""), {"e.json", "folder/"}),
    (("terrane", "arrange", "-o", ""), {"a.ts", "b c.OBJ", "h.pl", "folder/"}),
    (("terrane", "tetrahedralize", "--output", ""), {"d.vtu", "folder/"}),
    (("terrane", "volume", "-o", ""), {"folder/"}),
    (("terrane", "build", ""), {"e.json", "folder/"}),
    (("terrane", "verify", "e"), {"e.json"}),
    (("terrane", "arrange", "--polygon", "g"), {"g.shp"}),
    (("terrane", "arrange", "--threads", ""), set()),
)


def expect(holds, sentence, seen=""):
    if not holds:
        findings.append(sentence)
        print(f"completion: {sentence}" + (f": {seen!r}" if seen != "" else ""), file=sys.stderr)


def said(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=True).stdout


def options_of_commands():
    """The commands of --help, each with the options of its --help."""
    listed = said("--help").split("Subcommands:\n")[1].split("\n\n")[0]
    found = {}
    for command in (line.split()[0] for line in listed.splitlines()):
        lines = re.findall(r"^  (-\S+)", said(command, "--help"), re.M)
        found[command] = {name for line in lines for name in line.split(",")}
        if len(found[command]) < 1 + 2 * (command not in ("completion", "manual")):
            raise SystemExit(f"completion: no options are found in the help of {command}")
    return found


def questions(commands):
    """Command lines to complete, with the words that must be among the answers or, if `whole`, are all of them."""
    asked = [(("terrane", ""), set(commands), False)]
    asked += [(("terrane", command, "-"), options, False) for command, options in commands.items()]
    return asked + [(line, words, True) for line, words in CASES]


def judge(shell, line, wanted, whole, answers):
    if whole:
        expect(answers == wanted, f"{shell}: {line} is completed by {sorted(wanted)}", sorted(answers))
    else:
        expect(wanted <= answers, f"{shell}: {line} lacks {sorted(wanted - answers)}", sorted(answers))


def check_bash(folder, commands):
    """One bash completes all lines as readline does: it sets COMP_WORDS, and reads COMPREPLY."""
    (folder / "terrane.bash").write_text(said("completion", "bash"))
    asked = questions(commands)
    # readline takes = for a word of its own
    asked += [(("terrane", "arrange", "--search", "=", "gr"), {"grid"}, True),
              (("terrane", "arrange", "--search", "="), {"grid", "brute"}, False)]
    lines = ["source ./terrane.bash", "complete -p terrane || exit 1"]
    for line, _, _ in asked:
        words = " ".join(f"'{word}'" for word in line)
        lines += [f"COMP_WORDS=({words}); COMP_CWORD={len(line) - 1}; COMPREPLY=(); _terrane",
                  "printf '%s\\n' \"${COMPREPLY[@]}\" ----"]
    done = subprocess.run(["bash", "--norc", "-u", "-c", "\n".join(lines)], cwd=folder, capture_output=True, text=True, check=False)
    expect(done.returncode == 0 and done.stderr == "", "bash: the script runs without a word", done.stderr)
    blocks = done.stdout.split("\n", 1)[1].split("----\n")
    for (line, wanted, whole), block in zip(asked, blocks):
        answers = {word + "/" if (folder / word).is_dir() and word else word for word in block.splitlines()} - {""}
        judge("bash", line, wanted, whole, answers)


def check_fish(folder, commands):
    script = folder / "terrane.fish"
    script.write_text(said("completion", "fish"))
    asked = questions(commands) + [(("terrane", "arrange", "--search=gr"), {"--search=grid"}, True),
                                   (("terrane", "arrange", "--certificate=e"), {"--certificate=e.json"}, True)]
    lines = [f"source {script}"]
    for line, _, _ in asked:
        lines += [f"complete -C '{' '.join(line)}'", "echo ----"]
    env = {**os.environ, "HOME": str(folder), "LC_ALL": "C.UTF-8"}
    done = subprocess.run(["fish", "--no-config", "-c", "\n".join(lines)], cwd=folder, env=env, capture_output=True, text=True,
                          check=False)
    expect(done.returncode == 0 and done.stderr == "", "fish: the script runs without a word", done.stderr)
    for (line, wanted, whole), block in zip(asked, done.stdout.split("----\n")):
        answers = {row.split("\t")[0].replace("\\ ", " ") for row in block.splitlines()}
        judge("fish", line, wanted, whole, answers)


ZSH_START = r"""
PS1= PS2= LISTMAX=-1
autoload -U compinit; compinit -D -u; source ./_terrane
nothing_shown() { compstate[insert]= compstate[list]= }
compadd() { # notes what matches
    if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then builtin compadd "$@"; return; fi
    local -a matches
    builtin compadd -A matches "$@"
    if (( $#matches )); then print -rl -- $matches >>answers; fi
    comppostfuncs+=(nothing_shown)
    builtin compadd "$@"
}
end_of_answer() { print -- ---- >>answers; zle kill-whole-line }
zle -N end_of_answer
bindkey -e
bindkey '^T' end_of_answer
"""


def typed_in_zsh(folder, lines):
    """Types lines into a zsh, each with a tab and ^T, and returns the file in which it notes the answers."""
    (folder / ".dots").mkdir()
    (folder / ".dots/.zshrc").write_text(ZSH_START)
    answers = folder / "answers"
    answers.touch()
    child, master = pty.fork()
    if child == 0:
        os.chdir(folder)
        env = {**os.environ, "ZDOTDIR": str(folder / ".dots"), "TERM": "dumb", "LC_ALL": "C.UTF-8"}
        os.execvpe("zsh", ["zsh", "-d", "-i"], env)
    for number, line in enumerate(lines):
        os.write(master, line.encode() + b"\t\x14")
        while answers.read_text().count("----") <= number:
            if select.select([master], [], [], 0.002)[0]:
                os.read(master, 65536)
    os.kill(child, 9)
    os.waitpid(child, 0)
    os.close(master)
    noted = answers.read_text()
    answers.unlink()
    shutil.rmtree(folder / ".dots")
    return noted


def check_zsh(folder, commands):
    (folder / "_terrane").write_text(said("completion", "zsh"))
    parsed = subprocess.run(["zsh", "-n", folder / "_terrane"], capture_output=True, text=True, check=False)
    expect(parsed.returncode == 0 and parsed.stderr == "", "zsh: the script is parsed", parsed.stderr)
    asked = questions(commands)
    noted = typed_in_zsh(folder, [" ".join(line) for line, _, _ in asked])
    expect(noted.count("----") == len(asked), "zsh: all lines are answered", noted[-200:])
    for (line, wanted, whole), block in zip(asked, noted.split("----\n")):
        before = line[-1][:line[-1].rfind("/") + 1]
        answers = {before + word.replace("\\ ", " ") for word in block.splitlines()}
        answers = {word + "/" if word and (folder / word).is_dir() else word for word in answers}
        judge("zsh", line, wanted, whole, answers)


def main():
    commands = options_of_commands()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "folder").mkdir()
        for file in FILES:
            (folder / file).touch()
        shells = {"bash": check_bash, "fish": check_fish, "zsh": check_zsh}
        for shell, check in shells.items():
            if shutil.which(shell):
                check(folder, commands)
            else:
                print(f"skipped: {shell} is not installed")
    print(f"{len(commands)} commands, {sum(map(len, commands.values()))} options, {len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())

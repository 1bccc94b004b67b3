#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes the Debian packages of a build tree, unpacks and installs them, and uses them.

    packages.py --build BUILD --source SOURCE --work FOLDER

(1) Each package has the fields that it must have, the right ones depend on each other, and no file is in two.
(2) The program arranges surfaces and, where terrane-tetgen was made, fills them with tetrahedra by it.
(3) The example in C compiles against the headers and the shared library alone, by pkg-config and by CMake.
(4) The Python package is imported, and finds the helper, too.
This is done in a folder into which the packages are unpacked, and then
(5) as users have them: dpkg installs them into a root of its own, a copy of the machine's that is written to memory,
    with their dependencies checked; they are used there without any path being named, and removed without a trace.
Nothing is installed into the machine. scripts/packages.sh does (5) in a Debian that has nothing else.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

NEEDED = {"libterrane-dev"}
PAGES = ("man/man1/terrane.1.gz", "man/man1/terrane-arrange.1.gz", "bash-completion/completions/terrane",
         "zsh/vendor-completions/_terrane", "fish/vendor_completions.d/terrane.fish")
FIELDS = ("Package", "Version", "Architecture", "Maintainer", "Section", "Description", "Installed-Size")


def run(*command, **more):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **more)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(c) for c in command)}: status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def fields_of(package):
    text = run("dpkg-deb", "--field", package)
    return dict(re.findall(r"^([\w-]+): (.*(?:\n .*)*)", text, re.M))


def files_of(package):
    lines = run("dpkg-deb", "--contents", package).splitlines()
    return {re.split(r" -> ", line.split(None, 5)[5])[0] for line in lines if not line.startswith("d")}


def judge_packages(packages):
    """A sentence for each flaw of the packages, and their names."""
    flaws, owner, versions, depends = [], {}, set(), {}
    for package in packages:
        fields = fields_of(package)
        name = fields.get("Package", package.name)
        flaws += [f"{name} has no field {field}" for field in FIELDS if not fields.get(field)]
        versions.add(fields.get("Version"))
        depends[name] = fields.get("Depends", "")
        for file in files_of(package):
            if file in owner:
                flaws.append(f"{file} is in {name} and in {owner[file]}")
            owner[file] = name
            if not file.startswith("./usr/"):
                flaws.append(f"{name} has {file}, outside of /usr")
        for needed in ("copyright", "changelog.gz", "changelog.Debian.gz"):
            if owner.get(f"./usr/share/doc/{name}/{needed}") != name:
                flaws.append(f"{name} has no {needed}")
        if name not in ("libterrane-dev", "python3-terrane") and "libc6" not in depends[name]:
            flaws.append(f"{name} does not depend on the libraries that it is linked with")
    flaws += [f"there is no package {name}" for name in sorted(NEEDED - depends.keys())]
    for page in PAGES if "terrane" in depends else ():
        if owner.get(f"./usr/share/{page}") != "terrane":
            flaws.append(f"terrane has no {page}")
    if "terrane-mpi" in depends and owner.get("./usr/share/man/man1/terrane-mpi.1.gz") != "terrane-mpi":
        flaws.append("terrane-mpi has no manual page")
    if any("openmpi" in needed for name, needed in depends.items() if name != "terrane-mpi"):
        flaws.append("another package than terrane-mpi depends on MPI")
    shared = [name for name in depends if name.startswith("libterrane-c")]
    for name in shared:
        if f"{name} (= " not in depends["libterrane-dev"]:
            flaws.append(f"libterrane-dev does not depend on {name} of its version")
    if len(versions) != 1:
        flaws.append(f"the versions differ: {versions}")
    return flaws, set(depends)


def use_program(root, data, work):
    """The helper is found beside the program, wherever the folder is."""
    program = root / "usr/bin/terrane"
    environment = {name: value for name, value in os.environ.items() if not name.startswith("TERRANE_")}
    run(program, "arrange", data / "top.ts", data / "fault.ts", "-o", work / "arranged.vtp", env=environment)
    if (root / "usr/libexec/terrane/terrane-tetgen").exists():
        run(program, "tetrahedralize", data / "body.ts", "-o", work / "body.vtu", env=environment)


def use_c(root, source, work):
    pc = next((root / "usr/lib").rglob("terrane_c.pc"))
    lib = pc.parent.parent
    environment = {**os.environ, "PKG_CONFIG_PATH": str(pc.parent), "LD_LIBRARY_PATH": str(lib)}
    flags = run("pkg-config", "--cflags", "--libs", "terrane_c", env=environment).split()
    example = source / "docs/examples/c"
    run("cc", "-std=c11", example / "blocks.c", *flags, "-o", work / "blocks", env=environment)
    run("cmake", "-S", example, "-B", work / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={root / 'usr'}")
    run("cmake", "--build", work / "build")
    for program in (work / "blocks", work / "build/blocks"):
        printed = run(program, "top.ts", "base.ts", "fault.ts", cwd=source / "docs/data", env=environment)
        if "is in block 2" not in printed:
            sys.exit(f"{program} printed\n{printed}")


def use_python(root, data):
    """The module finds the helper of terrane-tetgen, which is another package, as the program does."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("TERRANE_")}
    environment["PYTHONPATH"] = str(root / "usr/lib/python3/dist-packages")
    code = "import sys, terrane; m = terrane.model(terrane.read(sys.argv[1])); print(terrane.__file__); "
    if (root / "usr/libexec/terrane/terrane-tetgen").exists():
        code += "assert len(terrane.tetrahedralize(m).tetrahedra) > 0"
    printed = run("/usr/bin/python3", "-B", "-c", code, data / "body.ts", env=environment)
    if not printed.startswith(str(root)):
        sys.exit(f"another module was used: {printed}")


INSTALL = """
mount -t tmpfs tmpfs "$1"
mkdir "$1/upper" "$1/work" "$1/root"
mount -t overlay overlay -o "lowerdir=/,upperdir=$1/upper,workdir=$1/work" "$1/root"
mount --rbind /dev "$1/root/dev"
mount --rbind /proc "$1/root/proc" # by which the program finds its helpers
mkdir -p "$1/root/made"
mount --bind "$2" "$1/root/made"
mkdir -p "$1/root/project"
mount --bind "$3" "$1/root/project"
echo "the root is made"
exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 chroot "$1/root" sh -euc "$4"
"""
IN_ROOT = """
! find /usr -name '*terrane*' | grep . || { echo 'Terrane is installed on this machine'; exit 1; }
dpkg --install /made/packages/*.deb >/made/dpkg.log
installed=$(dpkg-query --show --showformat '${Package} ' '*terrane*')
dpkg --verify $installed
cd /project/docs/data
terrane arrange top.ts fault.ts -o /made/installed.vtp >/dev/null
if [ -e /usr/libexec/terrane/terrane-tetgen ]; then terrane tetrahedralize body.ts -o /made/installed.vtu >/dev/null; fi
if [ -e /usr/bin/terrane-mpi ]; then terrane-mpi manual >/dev/null; fi
if pkg-config --exists terrane_c; then
    cc -std=c11 ../examples/c/blocks.c $(pkg-config --cflags --libs terrane_c) -o /made/installed
    /made/installed top.ts base.ts fault.ts | grep -q 'is in block 2'
fi
if [ -e /usr/lib/python3/dist-packages/terrane ]; then
    /usr/bin/python3 -c 'import terrane; assert len(terrane.model(terrane.read("body.ts")).blocks) > 0'
fi
dpkg --purge $installed >>/made/dpkg.log
! find /usr /etc /var/lib/dpkg/info -name '*terrane*' | grep . || { echo 'these files stay'; exit 1; }
"""


def install_in_root(work, source):
    """Returns what was done. A machine that lets nobody mount, as some containers do, has only what was unpacked."""
    (work / "memory").mkdir()
    why = ""
    for unshare in (("unshare", "--mount"), ("unshare", "--mount", "--user", "--map-root-user")):
        done = subprocess.run([*unshare, "sh", "-euc", INSTALL, "sh", work / "memory", work, source, IN_ROOT],
                              capture_output=True, text=True)
        if "the root is made" in done.stdout:
            if done.returncode != 0:
                sys.exit(f"in a root of its own: status {done.returncode}\n{done.stdout}{done.stderr}")
            return "installed by dpkg, used and removed"
        why = done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"status {done.returncode}"
    return f"unpacked and used; not installed, as no root of its own can be made here ({why})"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("build", "source", "work"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    options = parser.parse_args()
    work, source = options.work.resolve(), options.source.resolve()
    shutil.rmtree(work, ignore_errors=True)
    (work / "root").mkdir(parents=True)
    # The fastest compression that dpkg knows, as these packages are unpacked at once.
    run("cpack", "-G", "DEB", "-B", work / "packages", "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip",
        "-D", "CPACK_PACKAGE_CONTACT=The tests <tests@host.invalid>", cwd=options.build)
    packages = sorted((work / "packages").glob("*.deb"))
    flaws, names = judge_packages(packages)
    for package in packages:
        run("dpkg-deb", "--extract", package, work / "root")
    if "terrane" in names:
        use_program(work / "root", source / "docs/data", work)
    if any(name.startswith("libterrane-c") for name in names):
        use_c(work / "root", source, work)
    if "python3-terrane" in names:
        use_python(work / "root", source / "docs/data")
    how = install_in_root(work, source)
    for flaw in flaws:
        print(f"packages: {flaw}", file=sys.stderr)
    print(f"{len(packages)} packages {how}: {', '.join(sorted(names))}")
    return 1 if flaws else 0


if __name__ == "__main__":
    sys.exit(main())

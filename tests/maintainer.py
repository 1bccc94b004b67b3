#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that no package is made that names nobody who answers for it."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


class Maintainer(unittest.TestCase):
    def made(self, cached, given=None):
        """Run the script where the build tree says no more than this; return what it complains about."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "scripts").mkdir()
            (folder / "build").mkdir()
            script = folder / "scripts/packages.sh"
            script.write_text((ROOT / "scripts/packages.sh").read_text())
            (folder / "build/CMakeCache.txt").write_text(f"CMAKE_INSTALL_PREFIX:PATH=/usr\nTERRANE_MAINTAINER:STRING={cached}\n")
            environment = {k: v for k, v in os.environ.items() if k != "TERRANE_MAINTAINER"}
            if given is not None:
                environment["TERRANE_MAINTAINER"] = given
            done = subprocess.run(["bash", script, *(["build"] if given is None else [])], capture_output=True, text=True,
                                  env=environment)
            self.assertNotEqual(done.returncode, 0)  # there is nothing to pack
            return done.stderr

    NOBODY = ("", "Somebody", "somebody@example.org", "Somebody <somebody>", "<somebody@example.org>",
              "Terrane maintainers <maintainers@terrane.invalid>")
    SOMEBODY = "Somebody Else <somebody@example.org>"

    def test_script(self):
        refused = 'TERRANE_MAINTAINER="NAME <ADDRESS>" must name who answers for the packages'
        for contact in self.NOBODY:
            self.assertIn(refused, self.made(contact), contact)
            self.assertIn(refused, self.made("", contact), contact)
        self.assertNotIn(refused, self.made(self.SOMEBODY))
        self.assertNotIn(refused, self.made("", self.SOMEBODY))

    def test_cpack(self):
        for contact, generator, good in [(c, "DEB", False) for c in self.NOBODY[:-1]] + [(self.SOMEBODY, "DEB", True), ("", "TGZ", True)]:
            done = subprocess.run(["cmake", f"-DCPACK_PACKAGE_CONTACT={contact}", f"-DCPACK_GENERATOR={generator}", "-P",
                                   ROOT / "scripts/cmake/maintainer.cmake"], capture_output=True, text=True)
            self.assertEqual((done.returncode == 0, "TERRANE_MAINTAINER" in done.stderr), (good, not good), contact)

    def test_nobody_is_made_up(self):
        self.assertIn('set(TERRANE_MAINTAINER "" CACHE', (ROOT / "scripts/cmake/packages.cmake").read_text())


if __name__ == "__main__":
    unittest.main()

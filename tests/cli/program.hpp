// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Runs the program as a user would: through a shell, in a folder of its own.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "support/files.hpp"
#include "support/paths.hpp"

namespace program_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Outcome {
    int status = -1;      ///< exit status, or 128 + signal if a signal ended it
    std::string out, err; ///< standard output and error
};

inline std::string contents_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// A new empty folder, removed at the end, for the files of a test and its runs of the program.
class Folder {
public:
    Folder() {
        fs::create_directory(path_ / "in");
        fs::create_directory(path_ / "io");
    }

    /// Writes a file into in/; returns its name for the command line.
    std::string input(const std::string& name, const std::string& text) const {
        std::ofstream(path_ / "in" / name, std::ios::binary) << text;
        return "in/" + name;
    }
    [[nodiscard]] std::string read(const std::string& name) const {
        return contents_of(path_ / name);
    }
    /// Returns the names of all that runs left behind, without in/ and the recorded streams.
    [[nodiscard]] std::set<std::string> left() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(path_))
            names.insert(entry.path().filename().string());
        names.erase("in");
        names.erase("io");
        return names;
    }
    /// Runs a line of the shell, in which $T is the program, $D is tests/data, and
    /// $K SIGNAL MOMENT COMMAND interrupts a command (tests/support/interrupted.py).
    [[nodiscard]] Outcome shell(const std::string& line) const {
        const auto command = "cd '" + path_.string() +
                             "' && export XDG_STATE_HOME=\"$PWD/io/state\" && T='" +
                             test_support::program() + "' && D='" + test_support::test_data() +
                             "' && K=\"$D/../support/interrupted.py\" && { " + line +
                             " ; } >io/out 2>io/err </dev/null";
        const int code = std::system(command.c_str());
        Outcome outcome;
        outcome.status = WIFEXITED(code) ? WEXITSTATUS(code) : 128 + WTERMSIG(code);
        outcome.out = read("io/out");
        outcome.err = read("io/err");
        return outcome;
    }
    [[nodiscard]] Outcome run(const std::string& arguments) const {
        return shell("$T " + arguments);
    }

private:
    test_support::TemporaryFolder folder_;
    const fs::path& path_ = folder_.path();
};

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Returns an object of OBJ, a polygon with these corners: "x y z, x y z, ...".
inline std::string polygon(const std::string& name, const std::string& corners) {
    std::string text = name.empty() ? "" : "o " + name + "\n", face = "f";
    std::size_t count = 1;
    for (std::size_t at = 0, end = 0; end != std::string::npos; at = end + 2, ++count) {
        end = corners.find(',', at);
        text += "v " + corners.substr(at, end - at) + "\n";
    }
    while (--count > 0) face += " -" + std::to_string(count);
    return text + face + "\n";
}

/// A level square at this height, which reaches beyond the box from 0 to 8.
inline std::string level(const std::string& name, const std::string& z) {
    return polygon(name, "-1 -1 " + z + ", 9 -1 " + z + ", 9 9 " + z + ", -1 9 " + z);
}

/// The box from 0 to 8.
inline constexpr auto cube = R"(v 0 0 0
v 8 0 0
v 8 8 0
v 0 8 0
v 0 0 8
v 8 0 8
v 8 8 8
v 0 8 8
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)";

/// A horizon of two triangles, and a fault of one that crosses it.
inline constexpr auto crossing = R"(o horizon
v 0 0 0
v 4 0 0
v 4 4 0
v 0 4 0
f 1 2 3
f 1 3 4
o fault
v 1 -1 -1
v 1 5 -1
v 1 2 3
f 5 6 7
)";

/// Returns triangles so small, compared with their coordinates, that rounding their crossings to
/// the nearest doubles gives no conforming mesh.
inline std::string tiny_triangles() {
    std::string text = "OFF\n30 10 0\n", faces;
    unsigned state = 7;
    const auto next = [&] {
        state = (state * 1103515245U + 12345U) % (1U << 31U);
        return (state >> 16U) % 64U;
    };
    for (unsigned v = 0; v < 30; ++v) {
        char line[128];
        const auto coordinate = [&] { return 4194304 + std::ldexp(next(), -30); };
        const double x = coordinate(), y = coordinate(), z = coordinate();
        std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", x, y, z);
        text += line;
    }
    for (unsigned t = 0; t < 10; ++t)
        faces += "3 " + std::to_string(3 * t) + " " + std::to_string(3 * t + 1) + " " +
                 std::to_string(3 * t + 2) + "\n";
    return text + faces;
}

} // namespace program_test

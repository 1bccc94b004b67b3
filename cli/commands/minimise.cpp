// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/fuzzing/minimise.hpp>

#include <filesystem>
#include <fstream>
#include <memory>
#include <span>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/stages/attempts.hpp>

namespace terrane::cli {
namespace {

struct MinimiseCommand {
    FileOptions files;
    std::string input, test;
    double seconds = 10;
};

constexpr auto minimise_footer =
    R"(Triangles are left out, edges contracted and numbers replaced by simpler ones, as long as COMMAND
ends as it does with IN: with the same status, by the same signal, or not within --time. It must not
end with status 0 there. Each attempt is a file in the format of OUT, in a temporary folder. What
COMMAND prints is discarded.

Exit status: 0 OUT is written; 1 COMMAND ends with status 0; 2 bad input or usage, interrupted;
3 internal.

Examples:
  terrane minimise --test my_engine model.obj -o small.obj
  terrane minimise --test 'my_engine {} out.obj && terrane judge out.obj {}' model.obj -o small.obj
  terrane minimise --test '! my_engine {} 2>&1 | grep "not closed"' model.off -o small.off)";

/// A folder for the files of the attempts; it and what COMMAND wrote there go away at the end.
class AttemptFolder {
public:
    AttemptFolder() {
        std::error_code none;
        std::string name = (std::filesystem::temp_directory_path(none) / "terrane-XXXXXX").string();
        if (none || mkdtemp(name.data()) == nullptr)
            refuse(ErrorCode::cannot_open, "no temporary folder can be made", "TMPDIR");
        path_ = name;
    }
    AttemptFolder(const AttemptFolder&) = delete;
    AttemptFolder& operator=(const AttemptFolder&) = delete;
    ~AttemptFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

fuzzing::Soup soup_of(std::span<const Surface> surfaces) {
    fuzzing::Soup soup;
    for (const Surface& s : surfaces) {
        fuzzing::Part& part = soup.emplace_back();
        for (const Point3& p : s.vertices) part.points.push_back({p.x, p.y, p.z});
        part.triangles = s.triangles;
    }
    return soup;
}

/// Returns the parts that have triangles, with the names and roles of the surfaces.
Mesh mesh_of(const fuzzing::Soup& soup, std::span<const Surface> named) {
    std::vector<Surface> surfaces;
    for (std::size_t i = 0; i < soup.size(); ++i) {
        if (soup[i].triangles.empty()) continue;
        Surface& s = surfaces.emplace_back();
        s.name = named[i].name;
        s.role = named[i].role;
        for (const fuzzing::Point& p : soup[i].points) s.vertices.push_back({p.x, p.y, p.z});
        s.triangles = soup[i].triangles;
    }
    return concatenate(surfaces);
}

ExitStatus minimise_file(const MinimiseCommand& command) {
    Session session(1);
    FileOptions files = command.files;
    files.inputs = {command.input};
    const Output output = plan_outputs(files, OutputKind::surfaces).front();
    const Inputs inputs = read_inputs(files, session);
    const AttemptFolder folder;
    const auto file =
        folder.path() / ("attempt" + std::filesystem::path(output.path).extension().string());
    const WriteOptions as_output{.format = output.format, .ascii = files.ascii};
    const Attempts attempts(command.test, file, command.seconds, session.run().stop);
    std::size_t count = 0;
    const auto end_with = [&](const fuzzing::Soup& soup) {
        ++count;
        const std::string text =
            must(format_mesh(mesh_of(soup, inputs.surfaces), output.format, as_output));
        std::ofstream(file, std::ios::binary)
            << text; // not one of the files that appear at the end
        return must(attempts.run());
    };
    session.begin("minimise", Phase::computing);
    const fuzzing::Soup soup = soup_of(inputs.surfaces);
    const std::string end = end_with(soup);
    if (end == "status 126" || end == "status 127")
        refuse("the shell cannot run this command", "--test");
    if (end == "status 0") {
        session.end_stage();
        say(stderr, "terrane: " + command.input + ": the command of --test ends with status 0\n");
        return ExitStatus::negative;
    }
    const auto least = fuzzing::minimise(
        soup, [&](const fuzzing::Soup& changed) { return end_with(changed) == end; });
    session.end_stage();
    write_output(mesh_of(least, inputs.surfaces), output, as_output, session);
    say(summary_stream(files),
        fmt::format("{}: {} of {} after {}, {}\n", output.path, triangle_count(least),
                    counted(inputs.triangles, "triangle"), counted(count, "attempt"), end));
    return ExitStatus::done;
}

} // namespace

Command minimise_command(CLI::App& program) {
    auto options = std::make_shared<MinimiseCommand>();
    auto* app = program.add_subcommand("minimise", "Reduce a mesh with which any program fails");
    add_value(*app, "IN", options->input, "FILE", "The mesh; - is standard input")->required();
    add_value(
        *app, "--test", options->test, "COMMAND",
        "A line of the shell that fails with IN; {} is the file, which is appended without it")
        ->required();
    add_output(*app, options->files, "The smallest mesh with which COMMAND ends as with IN");
    add_value(*app, "--format", options->files.format, "FORMAT",
              "Format of whatever is -: ts, ml, obj, off, stl, ply, vtp, vtu, vtk, msh, inp, "
              "mesh, poly, smesh");
    add_reading(*app, options->files);
    app->add_flag("--ascii", options->files.ascii, "STL as text, with doubles, not float32");
    add_value(*app, "--time", options->seconds, "S",
              "Seconds that COMMAND may take each time; 10 unless given")
        ->check(positive());
    app->footer(minimise_footer);
    return {app, [options] { return minimise_file(*options); }};
}

} // namespace terrane::cli

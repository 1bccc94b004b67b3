// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/mpi/agreement.hpp>

#include <algorithm>
#include <climits>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <mpi.h>

#include <terrane/algorithms/core/sha256.hpp>

namespace terrane::cli {

namespace {

std::string broadcast(std::string text, int from) {
    std::uint64_t size = text.size();
    MPI_Bcast(&size, 1, MPI_UINT64_T, from, MPI_COMM_WORLD);
    text.resize(size);
    MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, from, MPI_COMM_WORLD);
    return text;
}

int own_rank() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

/// Describes a file, so that two descriptions are the same if the files are, as far as that shows soon.
std::string description(const std::filesystem::path& path) {
    constexpr std::uint64_t part = std::uint64_t{1} << 16U;
    std::error_code failed;
    if (!std::filesystem::is_regular_file(path, failed))
        return failed ? failed.message() : "it is no regular file";
    const std::uint64_t size = std::filesystem::file_size(path, failed);
    std::ifstream file(path, std::ios::binary);
    if (failed || !file) return "it cannot be read";
    std::string ends(std::min(size, 2 * part), '\0');
    const auto first = static_cast<std::streamsize>(std::min<std::uint64_t>(ends.size(), part));
    const auto last = static_cast<std::streamsize>(ends.size()) - first;
    file.read(ends.data(), first);
    file.seekg(-last, std::ios::end);
    file.read(ends.data() + first, last);
    return fmt::format("{} bytes, SHA-256 of the ends {:.12}", size, hexadecimal(sha256(ends)));
}

} // namespace

Status agreed(const Status& own) {
    const int here = own ? INT_MAX : own_rank();
    int first = INT_MAX;
    MPI_Allreduce(&here, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (first == INT_MAX) return Done{};
    Error error = own ? Error{} : own.error();
    int code = static_cast<int>(error.code);
    MPI_Bcast(&code, 1, MPI_INT, first, MPI_COMM_WORLD);
    error.code = static_cast<ErrorCode>(code);
    error.sentence = broadcast(error.sentence, first);
    error.place = broadcast(error.place, first);
    return error;
}

Status check_same_command(std::span<const char* const> words) {
    std::string own = "terrane-mpi " TERRANE_VERSION;
    for (const char* word : words) own.append(1, '\0').append(word); // shown as spaces
    const std::string first = broadcast(own, 0);
    if (own == first) return agreed(Done{});
    return agreed(Error{ErrorCode::bad_option,
                        fmt::format("process {} was started as {}, and process 0 as {}; give all "
                                    "processes the same version and command line",
                                    own_rank(), own, first),
                        ""});
}

Status check_same_files(std::span<const std::string> files) {
    for (const std::string& file : files) {
        const std::string own = description(file), first = broadcast(own, 0);
        const Error other{
            ErrorCode::cannot_open,
            fmt::format("process {} does not see the same file as process 0: {}, not {}",
                        own_rank(), own, first),
            file};
        if (auto same = agreed(own == first ? Status(Done{}) : other); !same) return same;
    }
    return Done{};
}

} // namespace terrane::cli

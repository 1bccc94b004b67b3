// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>

#include <terrane/algorithms/core/result.hpp>

namespace terrane::tiles::detail {

/// A file without a name. The system frees it when it is closed, or when the process ends, in whatever way.
class UnnamedFile {
public:
    /// Makes a file on the disk of a folder. Errors: cannot_open.
    static Result<UnnamedFile> create(const std::filesystem::path& folder);
    UnnamedFile(UnnamedFile&& other) noexcept;
    UnnamedFile& operator=(UnnamedFile&&) = delete;
    ~UnnamedFile();

    /// Write and read bytes at a place, which then is the one behind them. Return whether all were
    /// written or read.
    [[nodiscard]] bool write(const void* bytes, std::size_t size, std::uint64_t& at) const;
    [[nodiscard]] bool read(void* bytes, std::size_t size, std::uint64_t& at) const;
    /// Frees what the file has.
    [[nodiscard]] bool clear() const;

private:
    explicit UnnamedFile(int number) : number_(number) {}

    int number_;
};

/// The parts of a file that are not in use.
class FreeSpace {
public:
    /// Takes the lowest `size` free bytes that lie together, and returns where they begin.
    std::uint64_t take(std::uint64_t size);
    /// Frees bytes that were taken.
    void give_back(std::uint64_t at, std::uint64_t size);

private:
    std::map<std::uint64_t, std::uint64_t> ends_{
        {0, UINT64_MAX}}; ///< of free parts, by their beginnings
};

} // namespace terrane::tiles::detail

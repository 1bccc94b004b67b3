// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tiles/detail/unnamed_file.hpp>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace terrane::tiles::detail {

namespace {

/// Some file systems can't make a file without a name. There it has one until it is open.
int open_unnamed(const std::filesystem::path& folder) {
#ifdef O_TMPFILE
    const int made = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (made >= 0) return made;
#endif
    std::string name = (folder / ".terrane-XXXXXX").string();
    const int file = ::mkostemp(name.data(), O_CLOEXEC);
    if (file >= 0) ::unlink(name.c_str());
    return file;
}

/// Calls `transfer(done)`, which returns how many bytes it transferred, until all are.
template <class Transfer>
bool transfer_all(std::size_t size, std::uint64_t& at, const Transfer& transfer) {
    for (std::size_t done = 0; done < size;) {
        const auto count = transfer(done, std::min(size - done, std::size_t{1} << 30));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        done += static_cast<std::size_t>(count);
        at += static_cast<std::size_t>(count);
    }
    return true;
}

} // namespace

Result<UnnamedFile> UnnamedFile::create(const std::filesystem::path& folder) {
    const int number = open_unnamed(folder);
    if (number >= 0) return UnnamedFile(number);
    return Error{ErrorCode::cannot_open,
                 "no file can be made for what does not fit into memory: " +
                     std::generic_category().message(errno),
                 folder.string()};
}

UnnamedFile::UnnamedFile(UnnamedFile&& other) noexcept :
    number_(std::exchange(other.number_, -1)) {}

UnnamedFile::~UnnamedFile() {
    if (number_ >= 0) ::close(number_);
}

bool UnnamedFile::write(const void* bytes, std::size_t size, std::uint64_t& at) const {
    return transfer_all(size, at, [&](std::size_t done, std::size_t count) {
        return ::pwrite(number_, static_cast<const char*>(bytes) + done, count,
                        static_cast<off_t>(at));
    });
}

bool UnnamedFile::read(void* bytes, std::size_t size, std::uint64_t& at) const {
    return transfer_all(size, at, [&](std::size_t done, std::size_t count) {
        return ::pread(number_, static_cast<char*>(bytes) + done, count, static_cast<off_t>(at));
    });
}

bool UnnamedFile::clear() const {
    return ::ftruncate(number_, 0) == 0;
}

std::uint64_t FreeSpace::take(std::uint64_t size) {
    const auto part = std::find_if(ends_.begin(), ends_.end(),
                                   [&](const auto& p) { return p.second - p.first >= size; });
    const auto [at, end] = *part; // the last part has no end
    ends_.erase(part);
    if (end - at > size) ends_.emplace(at + size, end);
    return at;
}

void FreeSpace::give_back(std::uint64_t at, std::uint64_t size) {
    if (size == 0) return;
    auto next = ends_.upper_bound(at);
    std::uint64_t end = at + size;
    if (next != ends_.end() && next->first == end) {
        end = next->second;
        next = ends_.erase(next);
    }
    if (next != ends_.begin() && std::prev(next)->second == at)
        std::prev(next)->second = end;
    else
        ends_.emplace_hint(next, at, end);
}

} // namespace terrane::tiles::detail

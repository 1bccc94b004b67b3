// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/opened_file.hpp>

#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace terrane::cli {

OpenedFile::OpenedFile(OpenedFile&& other) noexcept :
    number_(std::exchange(other.number_, -1)), info_(other.info_) {}

OpenedFile::~OpenedFile() {
    if (number_ >= 0) ::close(number_);
}

Result<OpenedFile> OpenedFile::open(const std::filesystem::path& path, mode_t kind,
                                    const char* other) {
    OpenedFile opened(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (opened.number_ < 0 || ::fstat(opened.number_, &opened.info_) != 0) {
        const int code = errno;
        return Error{ErrorCode::cannot_open,
                     code == ELOOP ? "is a link"
                                   : "cannot be read: " + std::generic_category().message(code),
                     path.string()};
    }
    if ((opened.info_.st_mode & S_IFMT) != kind)
        return Error{ErrorCode::cannot_open, other, path.string()};
    return opened;
}

Result<OpenedFile> OpenedFile::file(const std::filesystem::path& path) {
    return open(path, S_IFREG, "is no regular file");
}

Result<OpenedFile> OpenedFile::folder(const std::filesystem::path& path) {
    return open(path, S_IFDIR, "is no folder");
}

std::string OpenedFile::bytes(std::size_t offset, std::size_t count) const {
    std::string text(count, '\0');
    std::size_t used = 0;
    while (used < count) {
        const auto read =
            ::pread(number_, text.data() + used, count - used, static_cast<off_t>(offset + used));
        if (read < 0 && errno == EINTR) continue;
        if (read <= 0) break;
        used += static_cast<std::size_t>(read);
    }
    text.resize(used);
    return text;
}

} // namespace terrane::cli

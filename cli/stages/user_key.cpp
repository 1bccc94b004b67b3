// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/user_key.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <system_error>

#include <fcntl.h>
#include <nettle/hmac.h>
#include <nettle/memops.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/cli/stages/opened_file.hpp>

namespace terrane::cli {

namespace fs = std::filesystem;

namespace {

constexpr mode_t of_others = S_IRWXG | S_IRWXO;

Error no_key(const fs::path& path, const std::string& why) {
    return {ErrorCode::cannot_open, why, path.string()};
}

Error no_key(const fs::path& path, int code) {
    return no_key(path, "cannot be made: " + std::generic_category().message(code));
}

/// Returns the folder for the state of this user's programs; empty: there is none. A program with
/// other rights than its caller has none. Relative paths do not count, by the XDG specification.
fs::path state_folder() {
    const auto named = [](const char* variable) {
        const char* const value = ::secure_getenv(variable);
        const fs::path path = value == nullptr ? "" : value;
        return path.is_absolute() ? path : fs::path();
    };
    if (fs::path state = named("XDG_STATE_HOME"); !state.empty()) return state;
    const fs::path home = named("HOME");
    std::error_code ignored;
    return fs::is_directory(home, ignored) ? home / ".local" / "state" : fs::path();
}

/// Makes the folders of a path that are missing, for this user alone.
Status make_folders(const fs::path& path) {
    fs::path made;
    for (const fs::path& name : path) {
        made /= name;
        if (::mkdir(made.c_str(), S_IRWXU) == 0 || errno == EEXIST) continue;
        const int code = errno; // EROFS comes before EEXIST on some systems
        std::error_code ignored;
        if (!fs::is_directory(made, ignored)) return no_key(made, code);
    }
    return Done{};
}

/// Tells whether a file or folder is this user's alone.
Status check_owner(const fs::path& path, const struct stat& info) {
    if (info.st_uid != ::geteuid()) return no_key(path, "belongs to another user");
    if ((info.st_mode & of_others) != 0)
        return no_key(path, "others may use it; run chmod go= on it");
    return Done{};
}

/// Writes a new file for this user alone. Returns 0, or errno.
int write_new(const fs::path& path, std::span<const std::uint8_t> bytes) {
    const int file =
        ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
    if (file < 0) return errno;
    const auto written = ::write(file, bytes.data(), bytes.size());
    int code = written < 0 ? errno : 0;
    if (code == 0 && written != static_cast<ssize_t>(bytes.size())) code = ENOSPC;
    if (code == 0 && ::fsync(file) != 0) code = errno;
    if (::close(file) != 0 && code == 0) code = errno;
    return code;
}

/// Draws a key and gives it its name, unless another process was first.
Status make_key(const fs::path& path) {
    std::array<std::uint8_t, 32 + 8> random{};
    if (::getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size()))
        return no_key(path, errno);
    const std::span<const std::uint8_t> all(random);
    Hash name{};
    std::copy(all.begin() + 32, all.end(), name.begin());
    const fs::path temporary =
        path.parent_path() / (".stages.key." + hexadecimal(name).substr(0, 16));
    int code = write_new(temporary, all.first(32));
    if (code == 0 && ::link(temporary.c_str(), path.c_str()) != 0 && errno != EEXIST) code = errno;
    ::unlink(temporary.c_str());
    if (code != 0) return no_key(path, code);
    return Done{};
}

} // namespace

Result<UserKey> UserKey::read_or_make() {
    const fs::path state = state_folder();
    if (state.empty())
        return Error{ErrorCode::cannot_open,
                     "neither XDG_STATE_HOME nor HOME names a folder for a key", ""};
    const fs::path folder = state / "terrane", path = folder / "stages.key";
    if (auto made = make_folders(folder); !made) return made.error();
    const auto opened = OpenedFile::folder(folder);
    if (!opened) return opened.error();
    if (auto own = check_owner(folder, opened->info()); !own) return own.error();
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(path, ignored)))
        if (auto made = make_key(path); !made) return made.error();
    const auto file = OpenedFile::file(path);
    if (!file) return file.error();
    if (auto own = check_owner(path, file->info()); !own) return own.error();
    UserKey key;
    const std::string bytes = file->bytes(0, key.bytes_.size());
    if (file->size() != key.bytes_.size() || bytes.size() != key.bytes_.size())
        return no_key(path, "is no key of 32 bytes; remove it");
    std::copy(bytes.begin(), bytes.end(), key.bytes_.begin());
    return key;
}

std::string UserKey::code_of(std::string_view text) const {
    hmac_sha256_ctx state{};
    hmac_sha256_set_key(&state, bytes_.size(), bytes_.data());
    hmac_sha256_update(&state, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
    Hash code{};
    hmac_sha256_digest(&state, code.size(), code.data());
    return hexadecimal(code);
}

bool UserKey::is_code_of(std::string_view code, std::string_view text) const {
    const std::string right = code_of(text);
    return code.size() == right.size() && memeql_sec(code.data(), right.data(), right.size()) != 0;
}

} // namespace terrane::cli
